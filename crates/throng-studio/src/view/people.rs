//! Agents drawn as walking people: bodies at levels of detail, moved by the matrices of their joints.

use super::geometry::paint;
use crate::play::{Poses, RunMoment};
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec2};
use std::sync::Arc;
use throng_draw::{Color, Projector};
use throng_figure::{Build, Level};

/// All builds of bodies.
pub const BUILDS: [Build; 3] = [Build::Woman, Build::Man, Build::Child];

/// The number of bodies: of each build at each level.
pub const BODIES: usize = BUILDS.len() * Level::ALL.len();

/// The least height of a person at each level but the last, pixels.
const LEAST: [f32; Level::ALL.len() - 1] = [140.0, 60.0, 22.0];

/// A person nearer to the eye than this is not drawn: the eye is in its head, metres.
const NEAREST: f64 = 0.6;

/// A person that is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct DrawnPerson {
    /// The numbers among the poses before and now (-1: there is none before); the number of the look; 0.
    pub who: [f32; 4],
    /// The colour of the top. Without opacity, it is that of the look.
    pub top: [u8; 4],
}

/// The people of a view.
#[derive(Clone, Debug)]
pub struct DrawnPeople {
    /// The poses between which the people are.
    pub poses: [Arc<Poses>; 2],
    /// Interpolation weight between the poses.
    pub share: f32,
    /// The people with each body, in the order of [`body`].
    pub bodies: [Vec<DrawnPerson>; BODIES],
}

/// Returns the number of a body.
pub fn body(build: Build, level: Level) -> usize {
    build as usize * Level::ALL.len() + level as usize
}

/// Returns the level for a height on the screen, pixels.
fn level(height: f32) -> Level {
    Level::ALL[LEAST.iter().take_while(|&&least| height < least).count()]
}

impl DrawnPeople {
    /// Returns the people that are seen. `tops` are the colours of their tops, in the order of the poses; those without a
    /// colour have that of their look. `unit` is the number of pixels per point of the screen.
    pub fn seen(
        shown: &RunMoment,
        tops: &[Option<Color>],
        share: f32,
        (projector, size, unit): (&Projector, Vec2, f32),
    ) -> Option<Self> {
        let parts = shown.people.len().checked_sub(1)?;
        let at = (share * parts as f32).clamp(0.0, parts as f32);
        let part = (at as usize).min(parts.checked_sub(1)?);
        let poses = [part, part + 1].map(|part| shown.people[part].clone());
        let mut bodies: [Vec<DrawnPerson>; BODIES] = Default::default();
        let mut before = 0;
        let mut moving = shown.frame.bodies.iter();
        for (now, ((number, person), top)) in poses[1].people.iter().zip(tops).enumerate() {
            // all lists are sorted by number
            let known = &poses[0].people;
            before += known[before..].iter().take_while(|(other, _)| other < number).count();
            let had = known.get(before).is_some_and(|(other, _)| other == number);
            let Some(agent) = moving.find(|body| body.number == *number) else { break };
            let middle = agent.position.extend(0.5 * person.height);
            let Some(height) = seen(projector, size, middle, person.height) else { continue };
            let before = if had { before as f32 } else { -1.0 };
            bodies[body(person.build, level(height * unit))].push(DrawnPerson {
                who: [before, now as f32, person.look.into(), 0.0],
                top: top.map_or([0; 4], paint),
            });
        }
        Some(Self { poses, share: at - part as f32, bodies })
    }

    /// Returns the size of the buffers in bytes, without poses.
    pub fn bytes(&self) -> usize {
        self.bodies.iter().map(|people| size_of_val(people.as_slice())).sum()
    }
}

/// Returns the height of a person on the screen, points, `None` outside of the view and at the eye.
fn seen(projector: &Projector, size: Vec2, middle: DVec3, height: f64) -> Option<f32> {
    if let Projector::Perspective(lens) = projector {
        let beside = lens.eye - middle;
        if beside.truncate().length() < NEAREST && beside.z.abs() < 0.5 * height + NEAREST {
            return None;
        }
    }
    let at = projector.pixel(middle)?;
    let tall = (projector.scale(middle) * height) as f32;
    let inside = at.cmpge(Vec2::splat(-tall)) & at.cmple(size + tall);
    inside.all().then_some(tall)
}
