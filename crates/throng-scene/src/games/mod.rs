//! The games of the gallery: scenes with rules that a file cannot express. Each game is one file: the rules, and the
//! behaviours of its players that the library lacks. The scene file places the players. The games use the interface
//! that every program has (`docs/rules.md`).

mod capture;
mod map_drive;
mod multiple_pursuit;
mod soccer;

use crate::registry::{Behaviours, Rulebook};
use glam::{DVec2, Vec2};
use throng::parameters::parameters;
use throng::{AgentId, AgentRef, World};

/// Adds the rules of all games to a rulebook.
pub fn rules(book: &mut Rulebook) {
    book.add_own(
        "multiple-pursuit",
        "An agent of the pack that touches the wanderer starts again on a ring around it.",
        |_| Ok(multiple_pursuit::MultiplePursuit::default()),
    );
    book.add_own("soccer", "Two teams kick the ball by touching it, and its goals count.", |_| {
        Ok(soccer::Soccer::default())
    });
    book.add_own(
        "capture-the-flag",
        "A seeker runs for a base, and defenders tag it by touching it; after each run all start again.",
        |_| Ok(capture::CaptureTheFlag::default()),
    );
    book.add_own(
        "map-drive",
        "Counts the laps of a car on its route, and puts it back there if it is stuck.",
        map_drive::rules,
    );
}

/// Adds the behaviours of the players to a registry.
pub fn register(behaviours: &mut Behaviours) {
    behaviours.add_with("soccer-player", |_: SoccerPlayer, names| soccer::player(names));
    behaviours.add_with("capture-seeker", |_: CaptureSeeker, names| capture::seeker(names));
    behaviours.add_with("capture-defender", |_: CaptureDefender, names| capture::defender(names));
    behaviours.add_with("map-driver", |_: MapDriver, names| map_drive::driver(names));
}

/// Kicks the ball to the goal of the other team, in the scene `soccer`.
#[parameters]
struct SoccerPlayer;

/// Runs to the flag past the defenders, in the scene `capture-the-flag`.
#[parameters]
struct CaptureSeeker;

/// Catches the seeker, in the scene `capture-the-flag`.
#[parameters]
struct CaptureDefender;

/// Follows the route of the scene `map-drive` and avoids obstacles by a map of them.
#[parameters]
struct MapDriver;

/// Whether two agents touch, or are nearer than the sum of their radii times (1 + `more`).
fn touch(world: &World, a: AgentId, b: AgentId, more: f64) -> bool {
    let (Some(a), Some(b)) = (world.agent(a).map(AgentRef::to_agent), world.agent(b).map(AgentRef::to_agent)) else {
        return false;
    };
    a.position.distance(b.position) <= f64::from(a.radius + b.radius) * (1.0 + more)
}

/// Returns a position on a ring around `center`: the first of several draws at which a disc of this radius is free, or
/// the last draw if none is. `first` is the number of the first draw.
fn on_ring(world: &World, first: u32, center: DVec2, (inner, outer): (f64, f64), radius: f32) -> DVec2 {
    /// The number of positions tried.
    const TRIES: u32 = 32;
    let place = |k: u32| {
        let (turn, part) = (world.draw(first + 2 * k), world.draw(first + 2 * k + 1));
        let (sin, cos) = libm::sincosf(turn * std::f32::consts::TAU);
        center + Vec2::new(cos, sin).as_dvec2() * (inner + (outer - inner) * f64::from(part))
    };
    let free = |at: &DVec2| world.is_free(at.extend(0.0), radius);
    (0..TRIES).map(place).find(free).unwrap_or_else(|| place(TRIES))
}
