//! The number of sub-steps of a step.

use crate::SubSteps;
use crate::world::State;

/// A sub-step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SubStep {
    /// Whether it is the first sub-step of its step, and whether it is the last.
    pub first: bool,
    pub last: bool,
    /// Its duration.
    pub seconds: f32,
    /// The time at its end, seconds since the start.
    pub now: f64,
}

impl SubStep {
    /// Returns a sub-step of the next step, which is divided into `parts`.
    pub fn new(state: &State, part: u32, parts: u32) -> Self {
        let step = state.settings.step;
        let seconds = (step / f64::from(parts)) as f32;
        let now = state.time() + step * f64::from(part + 1) / f64::from(parts);
        Self { first: part == 0, last: part + 1 == parts, seconds, now }
    }
}

/// Greatest distance, in clearance radii, between an agent's position after a sub-step and the position to which its
/// velocity before leads. This is how far its neighbours misjudge it. Agents that walk without looking ahead jam at full
/// speed, and may stop or turn within a sub-step: they move no farther than this.
const DEVIATION: f32 = 1.0 / 6.0;
/// Greatest distance that an agent moves in a sub-step, in clearance radii: an agent that looks ahead, and an
/// agent that steers or that a field governs. Behaviours and fields act once in a sub-step: errors of the path that they
/// describe add up, and only behaviours keep agents off surfaces.
const WALKED: f32 = 1.0;
const STEERED: f32 = 0.375;

impl State {
    /// Returns the number of sub-steps of the next step; `longest` returns the longest sub-step, seconds.
    pub(crate) fn sub_steps(&self, longest: impl FnOnce() -> f32) -> u32 {
        match self.settings.sub_steps {
            SubSteps::Fixed(parts) => parts,
            // no agents, or motionless agents: x / inf
            SubSteps::Auto => {
                let parts = (self.settings.step as f32 / longest() - 1e-3).ceil();
                (parts as u32).clamp(1, 10_000)
            }
        }
    }

    /// Returns the longest sub-step in which no agent deviates or moves too far, seconds. Scripted agents do not count:
    /// their positions are exact in sub-steps of any length.
    pub(crate) fn longest_sub_step(&self) -> f32 {
        let Self { agents, local_groups: groups, .. } = self;
        let alike = agents.radius.uniform().is_some()
            && agents.core.uniform().is_some()
            && agents.max_speed.uniform().is_some()
            && agents.max_acceleration.uniform().is_some()
            && agents.vehicle.uniform().is_some()
            && agents.group.uniform().is_some()
            && agents.script.uniform().is_some();
        let rows = if alike { agents.len().min(1) } else { agents.len() };
        let longest_squared = |row: usize| {
            let group = &groups[agents.group[row].index()];
            let by_force = agents.vehicle[row].map_or(f32::INFINITY, |vehicle| vehicle.max_force / vehicle.mass);
            let travel = match group.guidance.is_journey() {
                false => STEERED,
                true if group.look_ahead => WALKED,
                true => DEVIATION,
            };
            let radius = agents.body(row).clearance_radius();
            let radius_time = radius / agents.max_speed[row];
            // within t the velocity changes by at most acceleration * t, and by at most the top speed
            let by_acceleration = DEVIATION * radius / agents.max_acceleration[row].min(by_force);
            let by_speed = DEVIATION * radius_time;
            let by_travel = travel * radius_time;
            by_acceleration.max(by_speed * by_speed).min(by_travel * by_travel)
        };
        let counted = (0..rows).filter(|&row| agents.script[row].is_none());
        counted.map(longest_squared).fold(f32::INFINITY, f32::min).sqrt()
    }
}
