//! Where a run has been: saved states, within a bound of memory.

/// Saved states of a run by step, oldest first. When they grow too many, every second one is let go and the next ones are
/// taken half as often, so the whole run stays within reach: going back is loading the nearest before, and stepping on.
#[derive(Clone, Debug)]
pub struct History {
    states: Vec<(u64, Vec<u8>)>,
    /// Steps from one state to the next.
    stride: u64,
    /// Bytes held, and how many at most.
    bytes: usize,
    most: usize,
}

/// Steps between states at first: what is re-stepped to go one step back is never noticed.
const STRIDE: u64 = 8;

impl History {
    /// Nothing yet; it will hold at most so many bytes, or two states.
    pub fn new(most: usize) -> Self {
        Self { states: Vec::new(), stride: STRIDE, bytes: 0, most }
    }

    /// Whether the state at this step is wanted.
    pub fn wants(&self, step: u64) -> bool {
        step.is_multiple_of(self.stride) && self.states.last().is_none_or(|&(last, _)| last < step)
    }

    /// Keeps the state at a step that is [wanted](Self::wants).
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

    /// The last state at a step or before it.
    pub fn nearest(&self, step: u64) -> Option<&[u8]> {
        let after = self.states.partition_point(|&(at, _)| at <= step);
        Some(&self.states[after.checked_sub(1)?].1)
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_run_stays_within_reach_and_within_the_bound() {
        let mut history = History::new(1000);
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
        assert_eq!(History::new(9).nearest(3), None);
    }
}
