//! What hinders the progress of an agent.

use serde::{Deserialize, Serialize};

/// What hinders the progress of an agent that walks to a goal, judged by the change of its remaining distance.
///
/// An agent *makes progress* when its remaining distance becomes shorter, by a radius of its body, than ever before on
/// this leg. The seconds below apply to agents that walk a radius in half a second or less; they are longer in
/// proportion for slower agents. Agents that steer, are governed by a field, or follow a script are not judged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Hindrance {
    /// Nothing: it makes progress, has arrived, or is not judged.
    #[default]
    None,
    /// It has made no progress for more than a second, and is in a queue that moves: an agent close ahead goes the same
    /// way, and that agent, or an agent with the same goal that it waits for in turn, has made progress in the last 10
    /// seconds.
    Queueing,
    /// No place is free in the area where its journey ends: it waits outside, or behind agents that wait.
    WaitingForRoom,
    /// It has made no progress for 10 seconds, and no queue that moves explains it.
    Blocked,
    /// It has made no progress for 10 seconds and has walked all the time, at least a radius a second.
    Oscillating,
}

/// Numbers of hindered agents present, by the hindrance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hindered {
    /// Agents in a queue that moves.
    pub queueing: usize,
    /// Agents that wait outside their area because no place in it is free.
    pub waiting_for_room: usize,
    /// Agents without progress that no queue explains.
    pub blocked: usize,
    /// Agents that walk without progress.
    pub oscillating: usize,
}

impl Hindered {
    /// Returns the counts of the hindrances.
    pub fn of(all: impl Iterator<Item = Hindrance>) -> Self {
        all.fold(Self::default(), |mut counts, hindrance| {
            match hindrance {
                Hindrance::None => {}
                Hindrance::Queueing => counts.queueing += 1,
                Hindrance::WaitingForRoom => counts.waiting_for_room += 1,
                Hindrance::Blocked => counts.blocked += 1,
                Hindrance::Oscillating => counts.oscillating += 1,
            }
            counts
        })
    }

    /// Adds other counts.
    pub(crate) fn merge(&mut self, other: Self) {
        self.queueing += other.queueing;
        self.waiting_for_room += other.waiting_for_room;
        self.blocked += other.blocked;
        self.oscillating += other.oscillating;
    }
}

/// When an agent last made progress, and what has hindered it since.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProgressMark {
    /// Remaining distance at that time, metres; infinite before the first check.
    pub(crate) remaining: f32,
    /// Distance walked in all until then, metres.
    pub(crate) walked: f32,
    /// Half seconds since then.
    pub(crate) ticks: u16,
    /// Half seconds since its queue moved: since the agent, or an agent with the same goal that it waits for, made
    /// progress; at most 255.
    pub(crate) queue_ticks: u8,
    /// What hinders it.
    pub hindrance: Hindrance,
}

impl Default for ProgressMark {
    fn default() -> Self {
        Self { remaining: f32::INFINITY, walked: 0.0, ticks: 0, queue_ticks: 0, hindrance: Hindrance::None }
    }
}
