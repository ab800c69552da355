//! Functions that the tests of all models share.

use glam::Vec2;
use proptest::prelude::*;
use throng::avoid::{AvoidanceInput, AvoidanceNeighbour, LocalModel, Outline, Workspace};

pub fn vector(range: f32) -> impl Strategy<Value = Vec2> {
    (-range..range, -range..range).prop_map(|(x, y)| Vec2::new(x, y))
}

pub fn view(velocity: Vec2, preferred: Vec2, max_speed: f32, neighbours: &[AvoidanceNeighbour]) -> AvoidanceInput<'_> {
    AvoidanceInput { velocity, preferred, max_speed, neighbours, ..AvoidanceInput::default() }
}

/// A neighbour, avoided for a share, with the matching share of free space.
pub fn other(offset: Vec2, velocity: Vec2, radii: f32, share: f32) -> AvoidanceNeighbour {
    AvoidanceNeighbour {
        offset,
        above: 0.0,
        vertical_velocity: 0.0,
        velocity,
        preferred: velocity,
        radii,
        outline: Outline::POINT,
        share,
        room: 1.0 - share,
        aside: Vec2::X,
    }
}

/// The chosen velocity of an agent with a top speed of 1.5 m/s.
pub fn choose(model: &dyn LocalModel, velocity: Vec2, preferred: Vec2, neighbours: &[AvoidanceNeighbour]) -> Vec2 {
    model.velocity(&view(velocity, preferred, 1.5, neighbours), &mut Workspace::default())
}

/// As [`choose`], with a top speed that does not matter.
pub fn choose_freely(
    model: &dyn LocalModel,
    velocity: Vec2,
    preferred: Vec2,
    neighbours: &[AvoidanceNeighbour],
) -> Vec2 {
    model.velocity(&view(velocity, preferred, 100.0, neighbours), &mut Workspace::default())
}

/// The velocities of a fine grid within a speed.
pub fn grid(speed: f32) -> impl Iterator<Item = Vec2> {
    let all = (-75..=75).flat_map(move |i| (-75..=75).map(move |j| Vec2::new(i as f32, j as f32) * (speed / 75.0)));
    all.filter(move |v| v.length() <= speed)
}
