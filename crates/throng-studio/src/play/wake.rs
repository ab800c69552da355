//! The wake of a run: the moments on the way to a step, through which views draw trails.

use std::sync::Arc;
use throng_record::Frame;

/// The length of a wake, seconds of the run.
const LENGTH: f64 = 10.0;
/// The most agents of all moments of a wake. The wake of a large crowd is shorter.
const MOST: usize = 200_000;

/// The last moments before a step that a run went to as fast as possible. Views have not seen them.
#[derive(Clone, Debug, Default)]
pub(super) struct Wake {
    moments: Vec<Arc<Frame>>,
    /// Whether the run has arrived at the step. The next moment begins another wake.
    complete: bool,
}

impl Wake {
    /// Returns how many steps of `step` seconds the wake of so many agents takes.
    pub fn steps(step: f64, agents: usize) -> u64 {
        // the cast maps what is too large to the largest number
        ((LENGTH / step) as u64).min((MOST / agents.max(1)) as u64)
    }

    /// Takes a moment so many steps before the step to reach. A single step leaves no wake.
    pub fn pass(&mut self, moment: &Arc<Frame>, ahead: u64) {
        if self.complete {
            *self = Self::default();
        }
        self.complete |= ahead == 0;
        if ahead > 0 || !self.moments.is_empty() {
            self.moments.push(moment.clone());
        }
    }

    /// Takes the last moment as the goal.
    pub fn arrive(&mut self) {
        self.complete = true;
    }

    /// Returns the moments once the run has arrived, oldest first.
    pub fn moments(&self) -> &[Arc<Frame>] {
        if self.complete { &self.moments } else { &[] }
    }
}
