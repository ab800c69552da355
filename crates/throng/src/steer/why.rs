//! Why a behaviour steers as it does, as data that a viewer can draw.

use crate::motion::Steering;
use glam::Vec3;

/// One of the things that led to a steering. Places are absolute, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    /// The place it aims at.
    Aim(Vec3),
    /// Where it expects somebody or something to be.
    Expects(Vec3),
    /// A velocity it would like.
    Wishes(Vec3),
    /// Somebody it takes into account, by number.
    Regards(u32),
    /// A threat: somebody who will come too near.
    Threat {
        /// Whom, by number.
        number: u32,
        /// When the two are nearest, seconds from now.
        seconds: f32,
        /// Where it is itself then.
        own: Vec3,
        /// Where the other is then.
        theirs: Vec3,
    },
    /// A neighbourhood it looks at.
    Looks {
        /// How far, metres.
        distance: f32,
        /// How far to either side of ahead, radians.
        angle: f32,
    },
    /// A line it feels its way along, from its centre to here.
    Feels(Vec3),
    /// A corner of the path it follows; corners are told in order.
    Via(Vec3),
    /// The state that a [`Switch`](super::Switch) is in.
    State(usize),
    /// What it keeps from an earlier step, as if it were said now.
    Keeps(Vec3),
    /// A part was asked, and what it said; the reasons of the part follow, one deeper.
    Part {
        /// Which.
        index: usize,
        /// What it said.
        said: Option<Steering>,
    },
}

/// A reason, and how deep in the tree of behaviours it was given: 0 by the root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Told {
    /// How deep.
    pub depth: usize,
    /// The reason.
    pub reason: Reason,
}

/// Takes down reasons, if anybody asks for them: else it costs nothing.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, Reason, Seek, Target, View, Why};
/// let mut told = Vec::new();
/// let seek = Seek { target: Target::Point(Vec3::X) };
/// seek.steer(&View::default(), &mut [], &mut Why::asked(&mut told));
/// assert_eq!(told[0].reason, Reason::Aim(Vec3::X));
/// ```
#[derive(Debug, Default)]
pub struct Why<'a> {
    told: Option<&'a mut Vec<Told>>,
    depth: usize,
}

impl<'a> Why<'a> {
    /// Adds reasons to this list. [`Why::default`] is for when nobody asks.
    pub fn asked(told: &'a mut Vec<Told>) -> Self {
        Self { told: Some(told), depth: 0 }
    }

    /// Whether anybody asks.
    pub fn is_asked(&self) -> bool {
        self.told.is_some()
    }

    /// Takes a reason down; it is made only if somebody asks.
    pub fn note(&mut self, reason: impl FnOnce() -> Reason) {
        let depth = self.depth;
        if let Some(told) = &mut self.told {
            told.push(Told { depth, reason: reason() });
        }
    }

    /// Takes down what a part says, before its reasons.
    pub(super) fn part(&mut self, index: usize, steer: impl FnOnce(&mut Self) -> Option<Steering>) -> Option<Steering> {
        let place = self.told.as_ref().map_or(0, |told| told.len());
        self.note(|| Reason::Part { index, said: None });
        self.depth += 1;
        let said = steer(self);
        self.depth -= 1;
        if let Some(told) = &mut self.told {
            told[place].reason = Reason::Part { index, said };
        }
        said
    }
}
