//! Saved states of a run, within a memory limit.

/// Saved states of a run by step, oldest first. Beyond the memory limit, every second state is dropped and the interval
/// of new states doubles, so the whole run stays reachable. Going back loads the nearest earlier state and steps
/// forward from it.
#[derive(Clone, Debug)]
pub struct StateHistory {
    states: Vec<(u64, Vec<u8>)>,
    /// Steps between states.
    stride: u64,
    /// The bytes held, and the memory limit.
    bytes: usize,
    most: usize,
}

/// The first interval between states, in steps. Repeating so few steps is not noticeable.
const STRIDE: u64 = 8;

impl StateHistory {
    /// Creates an empty history with a memory limit of `most` bytes. It holds at least two states.
    pub fn new(most: usize) -> Self {
        Self { states: Vec::new(), stride: STRIDE, bytes: 0, most }
    }

    /// Whether the state at this step is to be saved.
    pub fn wants(&self, step: u64) -> bool {
        step.is_multiple_of(self.stride) && self.states.last().is_none_or(|&(last, _)| last < step)
    }

    /// Saves the state at a step that is [wanted](Self::wants).
    pub fn push(&mut self, step: u64, state: Vec<u8>) {
        self.bytes += state.len();
        self.states.push((step, state));
        while self.bytes > self.most && self.states.len() > 2 {
            self.stride *= 2;
            let stride = self.stride;
            self.states.retain(|(step, _)| step.is_multiple_of(stride));
            self.bytes = self.states.iter().map(|(_, state)| state.len()).sum();
        }
    }

    /// Returns the last state at or before a step.
    pub fn nearest(&self, step: u64) -> Option<&[u8]> {
        let after = self.states.partition_point(|&(at, _)| at <= step);
        Some(&self.states[after.checked_sub(1)?].1)
    }

    /// Drops the states at a step and after it.
    pub fn forget_from(&mut self, step: u64) {
        self.states.retain(|&(at, _)| at < step);
        self.bytes = self.states.iter().map(|(_, state)| state.len()).sum();
    }

    /// Returns the bytes held.
    pub fn bytes(&self) -> usize {
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_run_stays_within_reach_and_within_the_bound() {
        let mut history = StateHistory::new(1000);
        for step in 0..5000 {
            if history.wants(step) {
                history.push(step, (step as u32).to_le_bytes().repeat(10));
            }
        }
        assert!(history.bytes() <= 1000);
        for step in [0, 7, 8, 2500, 4999] {
            let state = history.nearest(step).unwrap();
            let found = u64::from(u32::from_le_bytes(state[..4].try_into().unwrap()));
            assert!(found <= step && step - found < 2 * 5000 / 12, "{found} for {step}");
        }
        assert_eq!(StateHistory::new(9).nearest(3), None);
    }
}
