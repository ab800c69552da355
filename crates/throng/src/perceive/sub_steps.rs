//! The number of sub-steps of a step.

use super::Perceive;
use crate::SubSteps;
use crate::sleep::SleepBlocks;
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

/// Greatest distance that an agent moves in a sub-step, as a part of the smallest clearance radius: while no two agents
/// are near each other, and in a crowd.
const FREE_MOVE: f32 = 0.25;
const CROWD_MOVE: f32 = 0.125;

impl Perceive {
    /// Returns the number of sub-steps of the next step.
    pub fn sub_steps(&mut self, state: &State, sleep: &mut SleepBlocks) -> u32 {
        let parts = match state.settings.sub_steps {
            SubSteps::Fixed(parts) => return parts,
            SubSteps::Auto => {
                let agents = &state.agents;
                let smallest = agents.bodies().map(|body| body.clearance_radius()).fold(f32::INFINITY, f32::min);
                let fastest = agents.max_speed.values().iter().copied().fold(0.0, f32::max);
                let part = if self.is_crowded(state, sleep) { CROWD_MOVE } else { FREE_MOVE };
                // an empty or motionless world: 0 / inf or 0 / x
                (state.settings.step as f32 * fastest / (part * smallest) - 1e-3).ceil()
            }
        };
        (parts as u32).clamp(1, 10_000)
    }

    /// Whether any two bodies are within a body's width of each other.
    fn is_crowded(&mut self, state: &State, sleep: &mut SleepBlocks) -> bool {
        if sleep.unchanged() {
            return self.close_pair.is_some();
        }
        let agents = &state.agents;
        let widest = agents.bodies().map(|body| body.bounding_radius()).fold(0.0, f32::max) * 2.0;
        let any_flies = agents.any_flies();
        let close = |row: usize, other: usize, distance_squared: f32| {
            let above = if any_flies { agents.above(row, other) } else { 0.0 };
            row != other && distance_squared + above * above <= 4.0 * widest * widest
        };
        // the pair that was close before is most likely still close
        if let Some((row, other)) = self.close_pair
            && row.max(other) < agents.len()
        {
            let d = agents.position[other] - agents.position[row];
            if close(row, other, d.x * d.x + d.y * d.y) {
                return true;
            }
        }
        self.grid.rebuild(&agents.position, &agents.number, widest.max(0.1) * 2.0);
        let grid = &self.grid;
        self.close_pair = (0..agents.len()).find_map(|row| {
            let mut partner = None;
            grid.within(agents.position[row], widest * 2.0, |near| {
                let other = near.row as usize;
                if close(row, other, near.distance_squared) {
                    partner = Some((row, other));
                }
            });
            partner
        });
        self.close_pair.is_some()
    }
}
