//! Groups in the world's local coordinates.
//!
//! The places in a [`Group`] are relative to the group's own origin, and the step works relative to the world's. They are
//! converted once, when a group enters the world.

use crate::agent::{Group, Guidance};
use crate::error::Error;
use crate::field::{Adaptive, FactorMap, Field, FieldSpine, Governed};
use crate::motion::{Steering, WrapAround};
use crate::space::surface::{Barrier, Moved, Pose};
use crate::steer::{
    AgentQuery, Barriers, Behaviour, BoxedBehaviour, FlockBatch, Kinematics, SteeringInput, Stimulus, TraceRecorder,
};
use glam::{DVec2, Vec2, Vec3};
use std::sync::Arc;

/// Returns a group with all its places relative to `origin` instead of its own origin.
pub(super) fn localized(group: &Group, origin: DVec2) -> Result<Group, Error> {
    let group = group.clone();
    // from the world's local coordinates to those of the group
    let by = origin - group.origin;
    if by == DVec2::ZERO || !group.has_places() {
        return Ok(group);
    }
    let shift = by.as_vec2().extend(0.0);
    let pose = Pose::at(-shift)?;
    let moved = |barrier: Barrier<_>| Barrier::new(Arc::new(Moved::new(barrier.surface, pose)) as _, barrier.seen_from);
    Ok(Group {
        origin,
        guidance: Guidance {
            behaviour: group.guidance.behaviour.map(|behaviour| ShiftedBehaviour { behaviour, shift }.into()),
            field: group.guidance.field.map(|field| Governed {
                field: Arc::new(ShiftedField { field: field.field, by }),
                map: field.map.map(|map| Arc::new(ShiftedMap { map, by }) as _),
                ..field
            }),
        },
        wrap_around: group.wrap_around.map(|ball| WrapAround { center: ball.center - shift, ..ball }),
        solid: Barriers(group.solid.0.into_iter().map(moved).collect()),
        ..group
    })
}

/// A field in other coordinates: `by` is added to a place before the field is asked.
#[derive(Clone)]
struct ShiftedField {
    field: Arc<dyn Field>,
    by: DVec2,
}

impl ShiftedField {
    fn inner(&self) -> &dyn Adaptive {
        self.field.adaptive().expect("only an adaptive field is used as one")
    }
}

impl Field for ShiftedField {
    fn velocity(&self, place: Vec3, time: f64) -> Vec3 {
        self.field.velocity(place + self.by.as_vec2().extend(0.0), time)
    }

    fn row(&self, (first, step): (DVec2, f64), from: usize, time: f64, out: &mut [Vec2]) {
        self.field.row((first + self.by, step), from, time, out);
    }

    fn adaptive(&self) -> Option<&dyn Adaptive> {
        self.field.adaptive().map(|_| self as _)
    }

    fn spine(&self) -> Option<FieldSpine> {
        let mut spine = self.field.spine()?;
        spine.points.iter_mut().for_each(|point| *point -= self.by.as_vec2().extend(0.0));
        Some(spine)
    }
}

impl Adaptive for ShiftedField {
    fn check(&self) -> Result<(), Error> {
        self.inner().check()
    }

    fn interval(&self) -> f64 {
        self.inner().interval()
    }

    fn memory(&self) -> Vec<f32> {
        self.inner().memory()
    }

    fn notice(&self, memory: &mut [f32], people: &[Vec2]) {
        let shift = self.by.as_vec2();
        let people: Vec<Vec2> = people.iter().map(|&person| person + shift).collect();
        self.inner().notice(memory, &people);
    }

    fn adapted(&self, memory: &[f32]) -> Arc<dyn Field> {
        Arc::new(Self { field: self.inner().adapted(memory), by: self.by })
    }
}

/// A factor map in other coordinates: `by` is added to a place before the map is asked.
struct ShiftedMap {
    map: Arc<dyn FactorMap>,
    by: DVec2,
}

impl FactorMap for ShiftedMap {
    fn at(&self, place: DVec2) -> f32 {
        self.map.at(place + self.by)
    }
}

/// A behaviour in other coordinates: `shift` is added to the places of its input and taken from those of its reasons.
#[derive(Debug)]
struct ShiftedBehaviour {
    behaviour: BoxedBehaviour,
    shift: Vec3,
}

/// Finds agents in shifted coordinates.
#[derive(Debug)]
struct ShiftedAgents<'a> {
    agents: &'a dyn AgentQuery,
    shift: Vec3,
}

impl AgentQuery for ShiftedAgents<'_> {
    fn find(&self, number: u32) -> Option<Kinematics> {
        let found = self.agents.find(number)?;
        Some(Kinematics { position: found.position + self.shift, ..found })
    }

    fn slot(&self, number: u32) -> usize {
        self.agents.slot(number)
    }
}

impl Behaviour for ShiftedBehaviour {
    fn memory(&self) -> usize {
        self.behaviour.words()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let shift = self.shift;
        let stimuli: Vec<Stimulus> =
            view.stimuli.iter().map(|&it| Stimulus { position: it.position + shift, ..it }).collect();
        let mut view = SteeringInput {
            goal: view.goal.map(|goal| goal + shift),
            others: &ShiftedAgents { agents: view.others, shift },
            stimuli: &stimuli,
            ..*view
        };
        view.motion.position += shift;
        why.shifted(-shift, |why| self.behaviour.steer(&view, memory, why))
    }

    // a flock is the same everywhere
    fn is_flock(&self) -> bool {
        self.behaviour.is_flock()
    }

    fn steer_flock(&self, batch: &mut FlockBatch<'_>) {
        self.behaviour.steer_flock(batch);
    }

    fn perception_range(&self) -> Option<f32> {
        self.behaviour.perception_range()
    }

    fn check(&self) -> Result<(), Error> {
        self.behaviour.check()
    }
}
