//! A pack chases a wanderer; an agent that catches it starts again on a ring around it (OpenSteer's "multiple
//! pursuit").

use super::{on_ring, touch};
use throng::{Agent, AgentRef, Error, Rules, World};

/// An agent of the group `pack` that touches the only agent of `wanderer` starts again on a ring around it.
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

/// How near an agent must be to catch, beyond contact, as a part of the sum of the radii: the guard keeps bodies from
/// touching.
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
                let (Some(agent), Some(center)) = (world.agent(hunter).map(AgentRef::to_agent), world.position(quarry))
                else {
                    continue;
                };
                let position = on_ring(world, 1000 * k, center.truncate(), self.ring, agent.radius);
                let heading = world.draw(1000 * k + 999) * std::f32::consts::TAU;
                world.replace(
                    hunter,
                    Agent {
                        position: position.extend(0.0),
                        heading: Some(heading),
                        velocity: Default::default(),
                        ..agent
                    },
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
