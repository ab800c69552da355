//! Everybody at the moment that is shown, between two states.

use crate::play::Shown;
use glam::{DVec3, Vec2};
use throng_draw::Projector;
use throng_record::{Body, Frame};

/// How near to an agent one must point, points of the screen beyond its edge.
const REACH: f32 = 12.0;

/// An agent in the state before and in the state now; one who has just entered is where it is.
pub fn pair(shown: &Shown, number: u32) -> Option<(&Body, &Body)> {
    let find = |bodies: &[Body]| bodies.binary_search_by_key(&number, |body| body.number).ok();
    let now = &shown.frame.bodies[find(&shown.frame.bodies)?];
    Some((find(&shown.before.bodies).map_or(now, |k| &shown.before.bodies[k]), now))
}

/// Everybody in the state before and in the state now.
pub fn pairs(shown: &Shown) -> impl Iterator<Item = (&Body, &Body)> {
    let before = &shown.before.bodies;
    let mut k = 0;
    shown.frame.bodies.iter().map(move |now| {
        // both are by number
        while before.get(k).is_some_and(|other| other.number < now.number) {
            k += 1;
        }
        (before.get(k).filter(|other| other.number == now.number).unwrap_or(now), now)
    })
}

/// Everybody where they are shown, and what they told in the state now.
pub fn interpolated(shown: &Shown, share: f32) -> Frame {
    let bodies = pairs(shown).map(|(before, now)| mixed(before, now, share));
    Frame { bodies: bodies.collect(), accounts: shown.frame.accounts.clone(), ..Frame::default() }
}

/// An agent where it is shown, a share of the way from the state before to the state now.
pub fn between(shown: &Shown, number: u32, share: f32) -> Option<Body> {
    let (before, now) = pair(shown, number)?;
    Some(mixed(before, now, share))
}

/// All but where it is and where it faces is as it is now.
fn mixed(before: &Body, now: &Body, share: f32) -> Body {
    let Body { position, altitude, heading, .. } = before.between(now, share.into());
    Body { position, altitude, heading, ..*now }
}

/// The agent that is nearest to a pixel.
pub fn nearest(shown: &Shown, projector: &Projector, at: Vec2, share: f32) -> Option<u32> {
    let away = |body: &Body| {
        let center: DVec3 = body.center();
        let edge = projector.scale(center) as f32 * body.shape().bound();
        let beyond = projector.pixel(center)?.distance(at) - edge;
        (beyond <= REACH).then_some(beyond)
    };
    // who is far from the pointer now was far a step ago
    let near = shown.frame.bodies.iter().filter(|body| away(body).is_some());
    let found = near.filter_map(|body| Some((away(&between(shown, body.number, share)?)?, body.number)));
    found.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, number)| number)
}
