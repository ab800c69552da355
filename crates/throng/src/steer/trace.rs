//! The reasons of a steering, as data that a viewer can draw.

use crate::motion::Steering;
use glam::Vec3;

/// One reason of a steering. Places are absolute, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SteeringReason {
    /// The place that the agent aims at.
    Aim(Vec3),
    /// A prediction: what is at the first place now will be at the second one.
    Expects {
        /// The place now.
        now: Vec3,
        /// The predicted place; the same if the behaviour does not predict.
        then: Vec3,
    },
    /// The place that the agent moves away from.
    Shuns(Vec3),
    /// The point at which the agent will touch a surface, and the unit normal there, on the agent's side.
    Hits {
        /// The point.
        point: Vec3,
        /// The normal.
        normal: Vec3,
    },
    /// The nearest point on a path or a wall.
    Projects {
        /// The point that is projected.
        from: Vec3,
        /// Its projection.
        to: Vec3,
    },
    /// A circle that the behaviour constructs; a sphere for agents that fly.
    Circle {
        /// The centre.
        center: Vec3,
        /// The radius, metres.
        radius: f32,
    },
    /// The cylinder that the agent will sweep.
    Cylinder {
        /// The start of its axis.
        from: Vec3,
        /// The end of its axis.
        to: Vec3,
        /// The radius, metres.
        radius: f32,
    },
    /// A straight stretch of the path that the agent follows.
    Stretch {
        /// The start of its axis.
        from: Vec3,
        /// The end of its axis.
        to: Vec3,
        /// The radius of the path, metres.
        radius: f32,
    },
    /// A rectangle that the behaviour constructs.
    Rectangle([Vec3; 4]),
    /// The velocity of a field at a place.
    Samples {
        /// The place.
        place: Vec3,
        /// The velocity, m/s.
        velocity: Vec3,
    },
    /// A preferred velocity.
    Wishes(Vec3),
    /// A term of a sum of forces, divided by the mass, m/s². The terms of the same depth add up.
    Adds(Vec3),
    /// Number of an agent that the behaviour takes into account.
    Regards(u32),
    /// An agent that will come too near.
    Threat {
        /// Number of the agent.
        number: u32,
        /// Seconds until the closest approach.
        seconds: f32,
        /// The agent's own position at that time.
        own: Vec3,
        /// The other agent's position at that time.
        theirs: Vec3,
    },
    /// A neighbourhood that the behaviour evaluates.
    Looks {
        /// Range, metres.
        distance: f32,
        /// Angle to either side of the forward direction, radians.
        angle: f32,
    },
    /// End of a probe that starts at the agent's centre.
    Feels(Vec3),
    /// A corner of the path that the agent follows; corners are recorded in order.
    Via(Vec3),
    /// The state that a behaviour with several states is in.
    State(usize),
    /// A value kept from an earlier step, recorded again.
    Keeps(Vec3),
    /// A part of the behaviour ran. The reasons of the part follow, one level deeper.
    Part {
        /// Index of the part.
        index: usize,
        /// The steering that the part returned.
        said: Option<Steering>,
    },
}

impl SteeringReason {
    /// Adds a vector to its places.
    fn translate(&mut self, by: Vec3) {
        match self {
            Self::Aim(place)
            | Self::Shuns(place)
            | Self::Feels(place)
            | Self::Via(place)
            | Self::Keeps(place)
            | Self::Hits { point: place, .. }
            | Self::Circle { center: place, .. }
            | Self::Samples { place, .. } => *place += by,
            Self::Expects { now: from, then: to }
            | Self::Projects { from, to }
            | Self::Cylinder { from, to, .. }
            | Self::Stretch { from, to, .. }
            | Self::Threat { own: from, theirs: to, .. } => {
                *from += by;
                *to += by;
            }
            Self::Rectangle(corners) => corners.iter_mut().for_each(|corner| *corner += by),
            Self::Wishes(_)
            | Self::Adds(_)
            | Self::Regards(_)
            | Self::Looks { .. }
            | Self::State(_)
            | Self::Part { .. } => {}
        }
    }
}

/// A reason and its depth in the tree of behaviours; the root has depth 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceEntry {
    /// Depth in the tree.
    pub depth: usize,
    /// The reason.
    pub reason: SteeringReason,
}

/// Records reasons if a trace is requested; otherwise a call costs nothing.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};
/// use throng_steer::Seek;
/// let mut entries = Vec::new();
/// let seek = Seek { target: Target::Point(Vec3::X) };
/// seek.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::requested(&mut entries));
/// assert_eq!(entries[0].reason, SteeringReason::Aim(Vec3::X));
/// ```
#[derive(Debug, Default)]
pub struct TraceRecorder<'a> {
    entries: Option<&'a mut Vec<TraceEntry>>,
    depth: usize,
}

impl<'a> TraceRecorder<'a> {
    /// Returns a recorder that adds reasons to this list. [`TraceRecorder::default`] records nothing.
    pub fn requested(entries: &'a mut Vec<TraceEntry>) -> Self {
        Self { entries: Some(entries), depth: 0 }
    }

    /// Whether a trace is requested.
    #[inline]
    pub fn is_requested(&self) -> bool {
        self.entries.is_some()
    }

    /// Records a reason; `reason` is called only if a trace is requested.
    pub fn note(&mut self, reason: impl FnOnce() -> SteeringReason) {
        let depth = self.depth;
        if let Some(entries) = &mut self.entries {
            entries.push(TraceEntry { depth, reason: reason() });
        }
    }

    /// Calls `steer`, and adds `by` to the places that it records.
    pub(crate) fn shifted<R>(&mut self, by: Vec3, steer: impl FnOnce(&mut Self) -> R) -> R {
        let first = self.entries.as_ref().map_or(0, |entries| entries.len());
        let said = steer(self);
        let entries = self.entries.iter_mut().flat_map(|entries| &mut entries[first..]);
        entries.for_each(|entry| entry.reason.translate(by));
        said
    }

    /// Records the steering of a part before the reasons of the part.
    pub(super) fn part(&mut self, index: usize, steer: impl FnOnce(&mut Self) -> Option<Steering>) -> Option<Steering> {
        let place = self.entries.as_ref().map_or(0, |entries| entries.len());
        self.note(|| SteeringReason::Part { index, said: None });
        self.depth += 1;
        let said = steer(self);
        self.depth -= 1;
        if let Some(entries) = &mut self.entries {
            entries[place].reason = SteeringReason::Part { index, said };
        }
        said
    }
}
