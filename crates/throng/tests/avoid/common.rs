//! What the tests of all models share.

use glam::Vec2;
use proptest::prelude::*;
use throng::avoid::{LocalModel, Neighbour, Outline, View, Workspace};

pub fn vector(range: f32) -> impl Strategy<Value = Vec2> {
    (-range..range, -range..range).prop_map(|(x, y)| Vec2::new(x, y))
}

pub fn view(velocity: Vec2, preferred: Vec2, max_speed: f32, neighbours: &[Neighbour]) -> View<'_> {
    View { velocity, preferred, max_speed, neighbours, ..View::default() }
}

/// Another, avoided for a share, with the room that goes with it.
pub fn other(offset: Vec2, velocity: Vec2, radii: f32, share: f32) -> Neighbour {
    Neighbour {
        offset,
        above: 0.0,
        climb: 0.0,
        velocity,
        preferred: velocity,
        radii,
        outline: Outline::POINT,
        share,
        room: 1.0 - share,
        aside: Vec2::X,
    }
}

/// What somebody no faster than 1.5 m/s chooses.
pub fn choose(model: &dyn LocalModel, velocity: Vec2, preferred: Vec2, neighbours: &[Neighbour]) -> Vec2 {
    model.velocity(&view(velocity, preferred, 1.5, neighbours), &mut Workspace::default())
}

/// As [`choose`], with no limit of speed in the way.
pub fn choose_freely(model: &dyn LocalModel, velocity: Vec2, preferred: Vec2, neighbours: &[Neighbour]) -> Vec2 {
    model.velocity(&view(velocity, preferred, 100.0, neighbours), &mut Workspace::default())
}

/// Velocities of a fine grid within a speed.
pub fn grid(speed: f32) -> impl Iterator<Item = Vec2> {
    let all = (-75..=75).flat_map(move |i| (-75..=75).map(move |j| Vec2::new(i as f32, j as f32) * (speed / 75.0)));
    all.filter(move |v| v.length() <= speed)
}
