//! Encodes and decodes frames.

use super::pack::{Rest, pack};
use super::state::{COLUMNS, RecState};

/// The kind of a key frame, which does not depend on other frames.
pub(super) const KEY: u8 = b'K';
/// The kind of a frame that stores changes since the frame before.
pub(super) const NEXT: u8 = b'N';

/// All agents at a time, by number.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct RecMoment {
    pub(super) time: f64,
    pub(super) states: Vec<RecState>,
}

/// Memory that is reused.
#[derive(Debug, Default)]
pub(super) struct Memory {
    values: Vec<i64>,
    /// For each agent, the state from which its state is predicted: its own in the frame before, or, for an agent that
    /// was absent, that of the preceding agent.
    before: Vec<Before>,
}

#[derive(Clone, Copy, Debug)]
enum Before {
    /// The index in the frame before.
    Itself(usize),
    Neighbour,
}

impl Memory {
    /// Finds the agents in the frame before.
    fn match_up(&mut self, states: &[RecState], last: Option<&RecMoment>) {
        let last: &[RecState] = last.map_or(&[], |last| &last.states);
        let mut at = 0;
        self.before.clear();
        self.before.extend(states.iter().map(|state| {
            while last.get(at).is_some_and(|other| other.number < state.number) {
                at += 1;
            }
            let itself = last.get(at).is_some_and(|other| other.number == state.number);
            if itself { Before::Itself(at) } else { Before::Neighbour }
        }));
    }

    /// Returns the state that predicts an agent's state, and its age in seconds.
    fn before(&self, row: usize, states: &[RecState], last: Option<&RecMoment>, seconds: f64) -> (RecState, f64) {
        match (self.before[row], last) {
            (Before::Itself(at), Some(last)) => (last.states[at], seconds),
            _ => (row.checked_sub(1).map_or_else(RecState::default, |front| states[front]), 0.0),
        }
    }

    /// Appends a frame; without a frame before it, a key frame.
    pub(super) fn write(&mut self, moment: &RecMoment, last: Option<&RecMoment>, out: &mut Vec<u8>) {
        let states = &moment.states;
        out.push(if last.is_some() { NEXT } else { KEY });
        out.extend(moment.time.to_le_bytes());
        let numbers = |states: &[RecState]| states.iter().map(|state| state.number).collect::<Vec<_>>();
        let same = last.is_some_and(|last| numbers(&last.states) == numbers(states));
        out.push(u8::from(same));
        if !same {
            out.extend((states.len() as u32).to_le_bytes());
            self.values.clear();
            let mut next = 0;
            for state in states {
                self.values.push(i64::from(state.number) - next);
                next = i64::from(state.number) + 1;
            }
            pack(&self.values, out);
        }
        self.match_up(states, last);
        let seconds = last.map_or(0.0, |last| moment.time - last.time);
        for column in 0..COLUMNS {
            self.values.clear();
            for row in 0..states.len() {
                let (before, ago) = self.before(row, states, last, seconds);
                self.values.push(states[row].news(column, &before, ago));
            }
            pack(&self.values, out);
        }
    }

    /// Reads a frame. Returns `None` if the bytes are invalid, or the frame before is missing.
    pub(super) fn read(&mut self, bytes: &[u8], last: Option<&RecMoment>) -> Option<RecMoment> {
        let mut rest = Rest(bytes);
        let last = match rest.array()? {
            [KEY] => None,
            [NEXT] => Some(last?),
            _ => return None,
        };
        let time = f64::from_le_bytes(rest.array()?);
        let same = rest.array()? != [0];
        let mut states = Vec::new();
        if same {
            states.extend(last?.states.iter().map(|state| RecState { number: state.number, ..RecState::default() }));
        } else {
            let count = u32::from_le_bytes(rest.array()?) as usize;
            rest.unpack(count, &mut self.values)?;
            let mut next = 0i64;
            for skipped in &self.values {
                let number = u32::try_from(next.checked_add(*skipped).filter(|&number| number >= next)?).ok()?;
                states.push(RecState { number, ..RecState::default() });
                next = i64::from(number) + 1;
            }
        }
        self.match_up(&states, last);
        let seconds = last.map_or(0.0, |last| time - last.time);
        for column in 0..COLUMNS {
            rest.unpack(states.len(), &mut self.values)?;
            for row in 0..states.len() {
                let (before, ago) = self.before(row, &states, last, seconds);
                states[row].learn(column, self.values[row], &before, ago);
            }
        }
        (rest.0.is_empty() && time.is_finite()).then_some(RecMoment { time, states })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn moment() -> impl Strategy<Value = RecMoment> {
        let states = proptest::collection::btree_map(any::<u32>(), any::<[i16; COLUMNS]>(), 0..80);
        (0.0..100.0, states).prop_map(|(time, states)| RecMoment {
            time,
            states: states
                .into_iter()
                .map(|(number, values)| RecState { number, values: values.map(i64::from) })
                .collect(),
        })
    }

    proptest! {
        #[test]
        fn moments_come_back(mut first in moment(), second in moment(), stay: bool, wrong: (u16, u8)) {
            // headings are within half a turn
            let mut second = if stay { RecMoment { time: second.time, ..first.clone() } } else { second };
            for state in first.states.iter_mut().chain(&mut second.states) {
                state.values[3] = i64::from(state.values[3] as i8);
            }
            let (mut memory, mut key, mut next) = (Memory::default(), Vec::new(), Vec::new());
            memory.write(&first, None, &mut key);
            memory.write(&second, Some(&first), &mut next);
            prop_assert_eq!(memory.read(&key, None), Some(first.clone()));
            prop_assert_eq!(memory.read(&next, Some(&first)), Some(second));
            prop_assert_eq!(memory.read(&next, None), None);
            for end in 0..next.len() {
                prop_assert_eq!(memory.read(&next[..end], Some(&first)), None);
            }
            // decoding changed bytes does not panic
            let at = usize::from(wrong.0) % next.len();
            next[at] ^= wrong.1;
            let _ = memory.read(&next, Some(&first)).map(|m| m.states.iter().filter_map(|s| s.spot(0.0)).count());
        }
    }
}
