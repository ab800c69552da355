//! Agents at the displayed moment, interpolated between two states.

use super::people::person;
use crate::play::RunMoment;
use glam::{DVec3, Vec2};
use throng_draw::Projector;
use throng_figure::Person;
use throng_record::{Body, Frame};

/// The distance beyond the edge of an agent at which the pointer selects it, points of the screen.
const REACH: f32 = 12.0;

/// Returns an agent in the previous and in the current state. An agent that has just entered has its current state
/// twice.
pub fn pair(shown: &RunMoment, number: u32) -> Option<(&Body, &Body)> {
    let find = |bodies: &[Body]| bodies.binary_search_by_key(&number, |body| body.number).ok();
    let now = &shown.frame.bodies[find(&shown.frame.bodies)?];
    Some((find(&shown.before.bodies).map_or(now, |k| &shown.before.bodies[k]), now))
}

/// Returns all agents in the previous and in the current state.
pub fn pairs(shown: &RunMoment) -> impl Iterator<Item = (&Body, &Body)> {
    let before = &shown.before.bodies;
    let mut k = 0;
    shown.frame.bodies.iter().map(move |now| {
        // both lists are sorted by number
        while before.get(k).is_some_and(|other| other.number < now.number) {
            k += 1;
        }
        (before.get(k).filter(|other| other.number == now.number).unwrap_or(now), now)
    })
}

/// Returns all agents at their displayed positions, with the traces of the current state.
pub fn interpolated(shown: &RunMoment, share: f32) -> Frame {
    let bodies = pairs(shown).map(|(before, now)| mixed(before, now, share));
    Frame {
        bodies: bodies.collect(),
        accounts: shown.frame.accounts.clone(),
        explanations: shown.frame.explanations.clone(),
        ..Frame::default()
    }
}

/// Returns an agent at its displayed position. `share` is the interpolation weight.
pub fn between(shown: &RunMoment, number: u32, share: f32) -> Option<Body> {
    let (before, now) = pair(shown, number)?;
    Some(mixed(before, now, share))
}

/// Interpolates position, altitude and heading. Other values are those of the current state.
fn mixed(before: &Body, now: &Body, share: f32) -> Body {
    let Body { position, altitude, heading, .. } = before.between(now, share.into());
    Body { position, altitude, heading, ..*now }
}

/// Returns the agent nearest to a pixel. Of agents at the pixel it is that nearest to the eye. `people` are drawn as tall
/// as they are, the others as their bodies on the ground.
pub fn nearest(
    shown: &RunMoment,
    projector: &Projector,
    at: Vec2,
    share: f32,
    people: &[(u32, Person)],
) -> Option<u32> {
    // how far the pixel is beyond the edge of an agent, and how near the agent is
    let away = |body: &Body| {
        let center: DVec3 = body.center();
        let scale = projector.scale(center) as f32;
        let foot = projector.pixel(center)?;
        let up = |person: &Person| projector.pixel(center + DVec3::Z * (person.height - f64::from(body.radius)));
        let along = person(people, body.number).and_then(up).unwrap_or(foot) - foot;
        let part = ((at - foot).dot(along) / along.length_squared().max(1e-9)).clamp(0.0, 1.0);
        let beyond = (foot + along * part).distance(at) - scale * body.shape().bounding_radius();
        (beyond <= REACH).then_some((beyond.max(0.0), -scale))
    };
    // filters by the current position first: an agent far from the pointer was also far one step ago
    let near = shown.frame.bodies.iter().filter(|body| away(body).is_some());
    let found = near.filter_map(|body| Some((away(&between(shown, body.number, share)?)?, body.number)));
    found.min_by(|(a, _), (b, _)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|(_, number)| number)
}
