//! Measures the swarms of a run for its summary.

use crate::measure::{Measured, mean, short};
use crate::report::number;
use serde_json::{Value, json};
use throng::World;
use throng_record::swarm::Swarm;
use throng_record::{Frame, moment};
use throng_scene::Scene;

/// The least time between measurements, seconds: a frame of 30 per second.
const SPACING: f64 = 1.0 / 30.0;
/// The longest lag of the autocorrelation of velocities, seconds.
const LAG: f64 = 2.0;

/// The groups of a scene that steer as swarms, and their figures.
pub struct Swarms {
    groups: Vec<(u32, Measured)>,
    frame: Frame,
    next: f64,
}

impl Swarms {
    /// Returns the swarms of a scene, not yet measured; none unless `wanted`.
    pub fn of(scene: &Scene, wanted: bool) -> Self {
        let groups = scene
            .groups
            .iter()
            .enumerate()
            .filter(|(_, group)| group.steer.as_ref().is_some_and(|steer| steer.name == "swarm"));
        let begin = |name: &str| Measured { name: name.to_owned(), swarm: Swarm::new(LAG) };
        let groups = groups.map(|(k, group)| (k as u32, begin(&group.name)));
        Self { groups: groups.filter(|_| wanted).collect(), frame: Frame::default(), next: 0.0 }
    }

    /// Measures the world after a step of `step` seconds.
    pub fn push(&mut self, world: &World, step: f64) {
        // Half a step of tolerance keeps rounding from leaving out a moment.
        if self.groups.is_empty() || world.time() + 0.5 * step < self.next {
            return;
        }
        self.next = world.time() + SPACING;
        moment::capture(world, &mut self.frame);
        for (group, measured) in &mut self.groups {
            measured.swarm.push_frame(&self.frame, *group);
        }
    }

    /// Returns the figures of the swarms that had agents.
    pub fn finish(self) -> Vec<Measured> {
        let groups = self.groups.into_iter().map(|(_, measured)| measured);
        groups.filter(|group| group.swarm.speed().count() > 0).collect()
    }
}

/// Returns a swarm's line of the summary.
pub fn line(Measured { name, swarm }: &Measured) -> String {
    let (speed, nearest, size) = (swarm.speed(), swarm.nearest().mean(), mean(swarm, |moment| moment.size()));
    let polarisation = short(mean(swarm, |moment| moment.polarisation));
    let keep = swarm.correlation().time().map_or_else(|| format!("over {LAG:.0}"), short);
    let [mean, deviation, nearest, size] = [speed.mean(), speed.deviation(), nearest, size].map(short);
    format!(
        "{name}: {mean} m/s (sd {deviation}), nearest neighbour {nearest} m, radius of gyration {size} m, \
         polarisation {polarisation}, velocities last {keep} s"
    )
}

/// Returns a swarm's figures as JSON.
pub fn json(Measured { name, swarm }: &Measured) -> Value {
    let acceleration = swarm.acceleration().iter().map(|all| all.rms() * all.rms()).sum::<f64>().sqrt();
    json!({
        "name": name,
        "speed": number(swarm.speed().mean()),
        "speed_sd": number(swarm.speed().deviation()),
        "acceleration": number(acceleration),
        "nearest": number(swarm.nearest().mean()),
        "size": number(mean(swarm, |moment| moment.size())),
        "polarisation": number(mean(swarm, |moment| moment.polarisation)),
        "correlation_time": swarm.correlation().time().map_or(Value::Null, number),
    })
}
