//! Both social force models, compared with their papers: forces as gradients of potentials by finite differences in
//! f64, and the formulas of 2009 by angles.

use crate::avoid::common::{other, vector, view};
use crate::avoid::repulsion::edges_of;
use glam::{DVec2, Vec2};
use proptest::prelude::*;
use throng::Obstacle;
use throng::avoid::{AvoidanceInput, AvoidanceReason, Cause, LocalModel, Moussaid2009, SocialForce, Workspace};

/// The accelerations by neighbours.
fn pushes(model: &dyn LocalModel, view: &AvoidanceInput<'_>) -> Vec<DVec2> {
    let push = |reason| {
        if let AvoidanceReason::Push(Cause::Neighbour(_), push) = reason { Some(push.as_dvec2()) } else { None }
    };
    model.explain(view, &mut Workspace::default()).into_iter().filter_map(push).collect()
}

/// The repulsive potential of a neighbour at the offset `r` from it: equations 3 and 4 of 1995.
fn potential(r: DVec2, theirs: DVec2) -> f64 {
    let way = theirs * 2.0;
    let sum = r.length() + (r - way).length();
    2.1 * (-0.5 * (sum * sum - way.length_squared()).sqrt() / 0.3).exp()
}

fn gradient(f: impl Fn(DVec2) -> f64, at: DVec2) -> DVec2 {
    const H: f64 = 1e-6;
    let along = |axis: DVec2| (f(at + axis * H) - f(at - axis * H)) / (2.0 * H);
    DVec2::new(along(DVec2::X), along(DVec2::Y))
}

/// The acceleration by a neighbour, by angles: equations of 2009. The angle is that from the interaction to the
/// neighbour.
fn moussaid(x: DVec2, relative: DVec2) -> Option<DVec2> {
    let interaction = relative * 2.0 + x.normalize();
    let (towards, range) = (interaction.y.atan2(interaction.x), 0.35 * interaction.length());
    let theta = (x.y.atan2(x.x) - towards + 3.0 * std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
        - std::f64::consts::PI;
    let side = theta + range * 0.005;
    if side.abs() < 1e-4 || theta.abs() > 3.1 || range < 0.02 {
        return None;
    }
    let brake = 4.5 * (-x.length() / range - (3.0 * range * theta).powi(2)).exp();
    let turn = 4.5 * side.signum() * (-x.length() / range - (2.0 * range * theta).powi(2)).exp();
    let (sin, cos) = towards.sin_cos();
    // to the right of the interaction if the neighbour is on the left
    Some(DVec2::new(-brake * cos + turn * sin, -brake * sin - turn * cos))
}

proptest! {
    #[test]
    fn the_force_of_1995_is_minus_the_gradient_of_its_potential(
        offset in vector(2.0), theirs in vector(1.3), preferred in vector(1.0),
    ) {
        let r = -offset.as_dvec2();
        let way = theirs.as_dvec2() * 2.0;
        let axis = (r.length() + (r - way).length()).powi(2) - way.length_squared();
        prop_assume!(axis > 0.01 && r.length() > 0.1 && (r - way).length() > 0.1 && preferred.length() > 0.1);
        let ahead = preferred.normalize().as_dvec2();
        prop_assume!(ahead.perp_dot(offset.as_dvec2()).abs() > 0.01);
        let force = -gradient(|r| potential(r, theirs.as_dvec2()), r);
        let cosine = ahead.dot(-force.normalize()) - 100.0f64.to_radians().cos();
        prop_assume!(cosine.abs() > 1e-3);
        let expected = force * if cosine > 0.0 { 1.0 } else { 0.5 };
        let neighbours = [other(offset, theirs, 0.4, 0.5)];
        let found = pushes(&SocialForce::default(), &view(Vec2::X, preferred, 1.5, &neighbours))[0];
        prop_assert!(found.distance(expected) < 2e-3 * (1.0 + expected.length()), "{found} instead of {expected}");
    }

    #[test]
    fn the_force_of_2009_is_as_written(offset in vector(3.0), velocity in vector(1.3), theirs in vector(1.3)) {
        prop_assume!(offset.length() > 0.1);
        let expected = moussaid(offset.as_dvec2(), (velocity - theirs).as_dvec2());
        prop_assume!(expected.is_some());
        let neighbours = [other(offset, theirs, 0.4, 0.5)];
        let found = pushes(&Moussaid2009::default(), &view(velocity, Vec2::X, 1.5, &neighbours))[0];
        prop_assert!(found.distance(expected.unwrap_or_default()) < 2e-3, "{found} instead of {expected:?}");
    }

    /// In a short step the velocity changes by the accelerations and (p - v) / tau.
    #[test]
    fn accelerations_add_up(
        all in prop::collection::vec((vector(2.0), vector(1.0)), 0..4), velocity in vector(0.9), preferred in vector(0.9),
    ) {
        prop_assume!(all.iter().all(|(offset, _)| offset.length() > 0.5));
        let neighbours: Vec<_> = all.iter().map(|&(offset, theirs)| other(offset, theirs, 0.4, 0.5)).collect();
        let view = AvoidanceInput { step: 1e-3, ..view(velocity, preferred, 9.0, &neighbours) };
        let models: [(&dyn LocalModel, f64); 2] = [(&SocialForce::default(), 0.5), (&Moussaid2009::default(), 0.54)];
        for (model, relaxation) in models {
            let chosen = model.velocity(&view, &mut Workspace::default());
            let sum: DVec2 = pushes(model, &view).into_iter().sum();
            let expected = sum + (preferred - velocity).as_dvec2() / relaxation;
            let found = (chosen - velocity).as_dvec2() / 1e-3;
            prop_assert!(found.distance(expected) < 0.01 * (1.0 + expected.length()), "{:?}: {} {}", model, found, expected);
        }
    }
}

/// The purpose of the paper's epsilon: ties go to the right, or to the left where that is preferred.
#[test]
fn ties_go_to_the_preferred_side() {
    let meets = [other(Vec2::new(2.0, 0.0), -Vec2::X, 0.4, 0.5)];
    for (side_preference, sign) in [(0.005, -1.0), (-0.005, 1.0)] {
        let model = Moussaid2009 { side_preference, ..Moussaid2009::default() };
        let push = pushes(&model, &view(Vec2::X, Vec2::X, 1.5, &meets))[0];
        assert!(push.y * sign > 0.1 && push.x < 0.0, "{push}");
    }
}

/// Walls repel from their nearest point: minus the gradient of 10 exp(-d / 0.2) in 1995, and 3 exp(-d / 0.1) in 2009.
#[test]
fn walls_push_as_written() {
    for (place, away) in [(DVec2::new(0.4, 0.3), DVec2::Y), (DVec2::new(1.3, -0.4), DVec2::new(0.6, -0.8))] {
        // the end of the wall is at (1, 0)
        let points = vec![DVec2::new(-3.0, 0.0), DVec2::new(1.0, 0.0)];
        let edges = edges_of(&Obstacle::Wall { points }, place);
        let view = AvoidanceInput { edges: &edges, ..view(Vec2::X, Vec2::X, 1.5, &[]) };
        let push = |model: &dyn LocalModel| -> DVec2 {
            let of = |reason| {
                if let AvoidanceReason::Push(Cause::Edge(_), push) = reason { Some(push.as_dvec2()) } else { None }
            };
            model.explain(&view, &mut Workspace::default()).into_iter().filter_map(of).sum()
        };
        let distance = if place.x < 1.0 { place.y } else { place.distance(DVec2::X) };
        let of_1995 = 10.0 / 0.2 * (-distance / 0.2).exp() * away;
        let of_2009 = 3.0 * (-distance / 0.1).exp() * away;
        for (found, expected) in [(push(&SocialForce::default()), of_1995), (push(&Moussaid2009::default()), of_2009)] {
            assert!(found.distance(expected) < 1e-5 * expected.length(), "{found} instead of {expected}");
        }
    }
}
