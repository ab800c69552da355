//! What keeps an agent from getting on.

use serde::{Deserialize, Serialize};

/// What keeps an agent that is on its way to a goal from getting on, judged by how its remaining way has changed.
///
/// An agent *gets on* when its remaining way becomes shorter, by a radius of its body, than it ever was on this leg.
/// Seconds below are for agents that walk a radius in half a second or less; they are longer in proportion for slower
/// ones. Agents that steer, that a field leads, or that follow a script are not judged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Hindrance {
    /// Nothing: it gets on, or has arrived, or is not judged.
    #[default]
    None,
    /// It takes more than a second to get on, and is in a queue that moves: an agent close ahead goes the same way, and that
    /// agent, or one with the same goal that it waits for in turn, has got on in the last 10 seconds.
    Queueing,
    /// No place is free in the area where its journey ends: it waits outside, or behind agents that do.
    WaitingForRoom,
    /// It has not got on for 10 seconds, and no queue that moves explains it.
    Blocked,
    /// It has not got on for 10 seconds and has walked all the while: at least a radius a second.
    Oscillating,
}

/// How many agents present are hindered, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hindered {
    /// Agents in a queue that moves.
    pub queueing: usize,
    /// Agents that wait outside their area because no place in it is free.
    pub waiting_for_room: usize,
    /// Agents that do not get on, which no queue explains.
    pub blocked: usize,
    /// Agents that walk without getting on.
    pub oscillating: usize,
}

impl Hindered {
    /// Counts hindrances.
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
}

/// When an agent last got on, and what hinders it since.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProgressMark {
    /// Metres of way that were left then; infinite: not yet looked.
    pub(crate) remaining: f32,
    /// Metres walked in all until then.
    pub(crate) walked: f32,
    /// Half seconds since then.
    pub(crate) ticks: u16,
    /// Half seconds since its queue moved: since the agent, or one with the same goal that it waits for, got on; 255 at most.
    pub(crate) queue_ticks: u8,
    /// What hinders it.
    pub hindrance: Hindrance,
}

impl Default for ProgressMark {
    fn default() -> Self {
        Self { remaining: f32::INFINITY, walked: 0.0, ticks: 0, queue_ticks: 0, hindrance: Hindrance::None }
    }
}
