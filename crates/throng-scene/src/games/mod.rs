//! The games of the gallery: scenes whose rules no file can say. Each is one file: the rules, and the behaviours of its
//! players where the library has none; the scene's file says who is where. They are written as a program's own would be
//! (`docs/rules.md`).

mod capture;
mod map_drive;
mod multiple_pursuit;
mod soccer;

use crate::scene::{Behaviours, Rulebook};
use glam::{DVec2, Vec2};
use throng::{AgentId, World};

/// Adds the rules of all games to a book.
pub fn rules(book: &mut Rulebook) {
    book.add("multiple-pursuit", |_| Ok(multiple_pursuit::MultiplePursuit::default()));
    book.add("soccer", |_| Ok(soccer::Soccer::default()));
    book.add("capture-the-flag", |_| Ok(capture::CaptureTheFlag::default()));
    book.add("map-drive", map_drive::rules);
}

/// The players that scene files can name.
pub fn behaviours() -> Behaviours {
    let mut behaviours = Behaviours::default();
    behaviours.add("soccer-player", soccer::player);
    behaviours.add("capture-seeker", capture::seeker);
    behaviours.add("capture-defender", capture::defender);
    behaviours.add("map-driver", map_drive::driver);
    behaviours
}

/// Whether two touch, or are nearer than a part of the sum of their radii more.
fn touch(world: &World, a: AgentId, b: AgentId, more: f64) -> bool {
    let (Some(a), Some(b)) = (world.agent(a), world.agent(b)) else { return false };
    a.position.distance(b.position) <= f64::from(a.radius + b.radius) * (1.0 + more)
}

/// A place on a ring round another, by the first of some draws where a disc of this radius is free; the last if none is.
/// `first` is the number of the first of its draws.
fn on_ring(world: &World, first: u32, center: DVec2, (inner, outer): (f64, f64), radius: f32) -> DVec2 {
    /// How many places it tries.
    const TRIES: u32 = 32;
    let place = |k: u32| {
        let (turn, part) = (world.draw(first + 2 * k), world.draw(first + 2 * k + 1));
        let (sin, cos) = libm::sincosf(turn * std::f32::consts::TAU);
        center + Vec2::new(cos, sin).as_dvec2() * (inner + (outer - inner) * f64::from(part))
    };
    let free = |at: &DVec2| world.is_free(at.extend(0.0), radius);
    (0..TRIES).map(place).find(free).unwrap_or_else(|| place(TRIES))
}
