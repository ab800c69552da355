//! A pack chases one that wanders; who catches it begins anew somewhere round it (OpenSteer's "multiple pursuit").

use super::{on_ring, touch};
use throng::{Agent, Error, Rules, World};

/// Who of the group `pack` touches the only one of `wanderer` begins anew on a ring round it.
#[derive(Clone, Copy, Debug)]
pub struct MultiplePursuit {
    /// Inner and outer radius of the ring, metres.
    pub ring: (f64, f64),
}

impl Default for MultiplePursuit {
    fn default() -> Self {
        Self { ring: (20.0, 30.0) }
    }
}

/// How much nearer than touching is near enough to catch, a part of the radii: the guard keeps bodies from touching.
const REACH: f64 = 0.05;

impl Rules for MultiplePursuit {
    fn figures(&self) -> Vec<String> {
        vec!["catches".into()]
    }

    fn begin(&self, world: &mut World, _: &mut [f64]) -> Result<(), Error> {
        world.group_named("pack").and(world.group_named("wanderer")).map(drop)
    }

    fn act(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        let pack = world.members(world.group_named("pack")?);
        for quarry in world.members(world.group_named("wanderer")?) {
            for (hunter, k) in pack.iter().copied().zip(0..) {
                if !touch(world, hunter, quarry, REACH) {
                    continue;
                }
                let (Some(agent), Some(center)) = (world.agent(hunter), world.position(quarry)) else { continue };
                let position = on_ring(world, 1000 * k, center, self.ring, agent.radius);
                let heading = world.draw(1000 * k + 999) * std::f32::consts::TAU;
                world.replace(
                    hunter,
                    Agent { position, heading: Some(heading), velocity: Default::default(), ..agent },
                )?;
                figures[0] += 1.0;
            }
        }
        Ok(())
    }

    fn standing(&self, _: &World, figures: &[f64]) -> String {
        if figures[0] == 1.0 { "1 catch".into() } else { format!("{} catches", figures[0]) }
    }
}
