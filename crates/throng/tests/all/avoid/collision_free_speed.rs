//! The collision-free speed model, compared with its paper's formulas in f64, and with single files computed by hand.

use crate::avoid::common::{choose, other, vector, view};
use crate::avoid::repulsion::edges_of;
use glam::{DVec2, Vec2};
use proptest::prelude::*;
use throng::avoid::{AvoidanceInput, CollisionFreeSpeed, LocalModel, Workspace};
use throng::{Error, Obstacle};

/// Direction and speed by the paper's formulas; `None` where the last bit decides.
fn as_written(all: &[(Vec2, Vec2)], preferred: Vec2) -> Option<DVec2> {
    let e0 = preferred.as_dvec2().normalize();
    let mut sum = e0;
    for (offset, _) in all {
        let x = offset.as_dvec2();
        if e0.perp_dot(x).abs() < 0.01 {
            return None;
        }
        sum -= x.normalize() * 8.0 * ((0.4 - x.length()) / 0.1).exp();
    }
    let e = sum.normalize();
    let mut spacing = f64::INFINITY;
    for (offset, _) in all {
        let x = offset.as_dvec2();
        let (along, across) = (e.dot(x), e.perp_dot(x).abs());
        if sum.length() < 1e-2 || along.abs() < 1e-3 || (across - 0.4).abs() < 1e-3 {
            return None;
        }
        if along > 0.0 && across < 0.4 {
            spacing = spacing.min(x.length() - 0.4);
        }
    }
    Some(e * spacing.clamp(0.0, preferred.as_dvec2().length()))
}

proptest! {
    #[test]
    fn it_chooses_as_the_paper_says(
        all in prop::collection::vec((vector(2.0), vector(1.0)), 0..6), velocity in vector(1.0), preferred in vector(1.0),
    ) {
        prop_assume!(preferred.length() > 0.1 && all.iter().all(|(offset, _)| offset.length() > 0.4));
        let expected = as_written(&all, preferred);
        prop_assume!(expected.is_some());
        let neighbours: Vec<_> = all.iter().map(|&(offset, theirs)| other(offset, theirs, 0.4, 0.5)).collect();
        let chosen = choose(&CollisionFreeSpeed::default(), velocity, preferred, &neighbours);
        prop_assert!(chosen.as_dvec2().distance(expected.unwrap_or_default()) < 2e-3, "{chosen} {expected:?}");
    }
}

/// Single file: the speed is the gap over the time gap, for any motion of the leader, and never above the preferred
/// speed.
#[test]
fn in_single_file_the_speed_is_the_gap_over_the_time_gap() {
    for (time_gap, distance, expected) in
        [(1.0, 1.0, 0.6), (0.5, 0.8, 0.8), (1.06, 1.46, 1.0), (0.5, 3.0, 1.3), (1.0, 0.4, 0.0)]
    {
        let model = CollisionFreeSpeed { time_gap, ..CollisionFreeSpeed::default() };
        // one neighbour ahead, one behind, and one beside the file
        let file = [
            other(Vec2::new(distance, 0.0), Vec2::ZERO, 0.4, 0.0),
            other(Vec2::new(-0.5, 0.0), Vec2::X, 0.4, 0.0),
            other(Vec2::new(0.3, 0.6), Vec2::X, 0.4, 0.0),
        ];
        let chosen = choose(&model, Vec2::X, Vec2::X * 1.3, &file);
        assert!(chosen.distance(Vec2::X * expected) < 2e-3, "{time_gap} s, {distance} m: {chosen}");
    }
}

/// A wall at 0.25 m, at an angle: 5 exp(-0.05 / 0.02) away from it in addition to the preferred direction.
#[test]
fn walls_turn_the_direction() {
    let points = vec![DVec2::new(-5.0, 0.25), DVec2::new(5.0, 0.25)];
    let edges = edges_of(&Obstacle::Wall { points }, DVec2::ZERO);
    let preferred = Vec2::new(1.0, 0.5);
    let view = AvoidanceInput { edges: &edges, ..view(Vec2::X, preferred, 1.5, &[]) };
    let chosen = CollisionFreeSpeed::default().velocity(&view, &mut Workspace::default());
    let expected = (preferred.normalize() - Vec2::Y * 5.0 * (-2.5f32).exp()).normalize() * preferred.length();
    assert!(chosen.distance(expected) < 1e-4, "{chosen} instead of {expected}");
}

#[test]
fn parameters_out_of_their_limits_are_named() {
    let wrong = |model: CollisionFreeSpeed| match model.check() {
        Err(Error::Limit { what, .. }) => what,
        _ => "nothing",
    };
    let right = CollisionFreeSpeed::default();
    assert_eq!(wrong(right), "nothing");
    assert_eq!(wrong(CollisionFreeSpeed { time_gap: 0.0, ..right }), "time_gap");
    assert_eq!(wrong(CollisionFreeSpeed { strength: -1.0, ..right }), "strength");
    assert_eq!(wrong(CollisionFreeSpeed { range: 0.0, ..right }), "range");
    assert_eq!(wrong(CollisionFreeSpeed { strength_obstacles: f32::NAN, ..right }), "strength_obstacles");
    assert_eq!(wrong(CollisionFreeSpeed { range_obstacles: f32::INFINITY, ..right }), "range_obstacles");
}
