//! The power law, compared with its paper's force; its gradient, compared with finite differences; and its implicit
//! step.

use crate::avoid::common::{other, vector, view};
use crate::avoid::repulsion::edges_of;
use glam::{DVec2, Vec2};
use proptest::prelude::*;
use throng::Obstacle;
use throng::avoid::{AvoidanceInput, LocalModel, PowerLaw, Workspace, time_to_disc};

/// Seconds until two discs touch, in f64.
fn time(x: DVec2, v: DVec2) -> Option<f64> {
    let (b, c) = (x.dot(v), x.length_squared() - 0.16);
    let d = b * b - v.length_squared() * c;
    (b > 0.0 && d > 0.0).then(|| c / (b + d.sqrt()))
}

/// The acceleration of Karamouzas, Skinner, Guy 2014: minus the gradient by the own position of `1.5 t^-2 exp(-t / 3)`,
/// by finite differences.
fn force(x: DVec2, v: DVec2) -> Option<DVec2> {
    const H: f64 = 1e-5;
    let energy = |x: DVec2| time(x, v).map(|t| 1.5 / (t * t) * (-t / 3.0).exp());
    // the own position moves by h, so the offset of the neighbour changes by -h
    let along = |axis: DVec2| Some((energy(x - axis * H)? - energy(x + axis * H)?) / (2.0 * H));
    Some(-DVec2::new(along(DVec2::X)?, along(DVec2::Y)?))
}

proptest! {
    /// Up to nine tenths of the radii off the centre: for grazing bodies the force of 2014 jumps and this force is
    /// smooth.
    #[test]
    fn in_a_short_step_the_force_is_that_of_2014(
        angle in 0.0f32..6.2, apart in 0.5f32..6.0, off in -0.9f32..0.9, speed in 0.2f32..2.5, theirs in vector(1.5),
    ) {
        let offset = Vec2::from_angle(angle) * apart;
        // the line of the relative velocity passes the centre of the neighbour at this part of the radii
        let relative = Vec2::from_angle(angle + (off * 0.4 / apart).asin()) * speed;
        let (x, v) = (offset.as_dvec2(), relative.as_dvec2());
        prop_assume!(time(x, v).is_some_and(|t| t > 0.15 && t < 8.0));
        let expected = force(x, v);
        prop_assume!(expected.is_some());
        let expected = expected.unwrap_or_default();
        let neighbours = [other(offset, theirs, 0.4, 0.5)];
        let model = PowerLaw { contact: 0.0, ..PowerLaw::default() };
        let view = AvoidanceInput { step: 1e-4, ..view(theirs + relative, Vec2::ZERO, 9.0, &neighbours) };
        let found = -model.energy(&view, theirs + relative).1.as_dvec2();
        let most = 0.03 * expected.length() + 1e-3;
        prop_assert!(found.distance(expected) < most, "{found} instead of {expected}");
    }

    /// The gradient matches the energy in every regime: grazing, contact, walls.
    #[test]
    fn the_gradient_is_that_of_the_energy(
        all in prop::collection::vec((vector(1.5), vector(1.0)), 1..4), velocity in vector(1.3), place in vector(1.0),
        step in 0.01f32..0.2, walls in any::<bool>(),
    ) {
        prop_assume!(all.iter().all(|(offset, _)| offset.length() > 0.2));
        let points = [(0.3, 0.2), (0.8, -0.9), (-1.0, -0.8)].map(|(x, y)| DVec2::new(x, y)).to_vec();
        let edges = if walls { edges_of(&Obstacle::Polygon { corners: points }, place.as_dvec2() * 2.0) } else { vec![] };
        let neighbours: Vec<_> = all.iter().map(|&(offset, theirs)| other(offset, theirs, 0.4, 0.5)).collect();
        let view = AvoidanceInput { step, edges: &edges, ..view(velocity, Vec2::ZERO, 9.0, &neighbours) };
        let model = PowerLaw { contact: 0.1, ..PowerLaw::default() };
        let (value, gradient) = model.energy(&view, velocity);
        let energy = |v: Vec2| f64::from(model.energy(&view, v).0);
        for axis in [Vec2::X, Vec2::Y] {
            // the slope on one side of a kink or the other; in f32, so with a wide step
            let h = 2e-3 / (1.0 + gradient.length() / (1.0 + value)).min(10.0);
            let ahead = (energy(velocity + axis * h) - f64::from(value)) / f64::from(h);
            let behind = (f64::from(value) - energy(velocity - axis * h)) / f64::from(h);
            let (low, high) = (ahead.min(behind), ahead.max(behind));
            let slope = f64::from(gradient.dot(axis));
            let most = 0.02 * f64::from(gradient.length() + value) + 0.02;
            prop_assert!(slope > low - most && slope < high + most, "{slope} is not from {low} to {high}");
        }
    }

    /// Descent from the choice in small steps finds no lower cost: the choice is a minimum at any time step. A lower
    /// minimum may lie 1 cm/s away, behind a ridge.
    #[test]
    fn the_choice_is_a_valley(
        all in prop::collection::vec((vector(3.0), vector(1.0)), 1..5), velocity in vector(1.0), preferred in vector(1.0),
        step in 0.02f32..0.2,
    ) {
        prop_assume!(all.iter().all(|(offset, _)| offset.length() > 0.45));
        let neighbours: Vec<_> = all.iter().map(|&(offset, theirs)| other(offset, theirs, 0.4, 0.5)).collect();
        let view = AvoidanceInput { step, ..view(velocity, preferred, 9.0, &neighbours) };
        let model = PowerLaw::default();
        let cost = |v: Vec2| {
            let off = (v - velocity).length_squared() / (2.0 * step) + (v - preferred).length_squared() / 1.08;
            off + model.energy(&view, v).0
        };
        let chosen = model.velocity(&view, &mut Workspace::default());
        let beside = |v: Vec2| (0..16).map(move |k| v + Vec2::from_angle(k as f32 * 0.39) * 0.001);
        let lower = |v: &Vec2| beside(*v).min_by(|a, b| cost(*a).total_cmp(&cost(*b))).filter(|w| cost(*w) < cost(*v));
        let end = std::iter::successors(Some(chosen), lower).take(1000).last().unwrap();
        let least = cost(end);
        prop_assert!(cost(chosen) <= least + 1e-3 * (1.0 + least.abs()), "{} at {chosen}, {least} at {end}", cost(chosen));
    }
}

/// The known property of the power law: no force without a collision ahead.
#[test]
fn abreast_and_apart_agents_do_not_interact() {
    let model = PowerLaw { contact: 0.0, ..PowerLaw::default() };
    for (offset, theirs) in
        [(Vec2::new(0.1, 0.6), Vec2::X), (Vec2::new(1.0, 0.0), Vec2::X * 1.2), (Vec2::new(-1.0, 0.0), Vec2::ZERO)]
    {
        let neighbours = [other(offset, theirs, 0.4, 0.5)];
        assert_eq!(model.energy(&view(Vec2::X, Vec2::X, 1.5, &neighbours), Vec2::X).1, Vec2::ZERO, "{offset}");
    }
}

/// At any time step, a body that moves towards a neighbour, or a wall, does not reach it within the step.
#[test]
fn long_steps_are_safe() {
    let model = PowerLaw::default();
    let points = vec![DVec2::new(0.45, -3.0), DVec2::new(0.45, 3.0)];
    let edges = edges_of(&Obstacle::Wall { points }, DVec2::ZERO);
    for step in [0.04, 0.1, 0.2] {
        let stands = [other(Vec2::new(0.7, 0.03), Vec2::ZERO, 0.4, 0.5)];
        let meets = AvoidanceInput { step, ..view(Vec2::X * 1.3, Vec2::X * 1.3, 1.5, &stands) };
        let chosen = model.velocity(&meets, &mut Workspace::default());
        assert!(time_to_disc(stands[0].offset, chosen, 0.4) > step, "{step} s: {chosen}");
        let walks = AvoidanceInput { step, edges: &edges, ..view(Vec2::X * 1.3, Vec2::X * 1.3, 1.5, &[]) };
        let chosen = model.velocity(&walks, &mut Workspace::default());
        assert!(chosen.x * step < 0.25, "{step} s: {chosen}");
    }
}

/// A wall that is met at any of its points costs as much as a disc that is met head-on at the same time.
#[test]
fn a_wall_costs_what_a_disc_does_that_is_met_at_the_same_time() {
    let model = PowerLaw { contact: 0.0, ..PowerLaw::default() };
    for (angle, off, time) in [(0.3, -0.5, 0.8), (2.0, 0.0, 2.0), (4.0, 1.5, 3.0), (5.5, 0.7, 1.2)] {
        // the wall is 6 m long; the agent walks along x, at an angle to it
        let (normal, velocity) = (DVec2::from_angle(angle), Vec2::from_angle(angle as f32 + 0.4) * 1.2);
        let way = f64::from(velocity.dot(normal.as_vec2())) * time + 0.2;
        let touched = velocity.as_dvec2() * time + normal * 0.2;
        let ends = [-3.0 + off, 3.0 + off].map(|along| touched + normal.perp() * along);
        assert!((touched.dot(normal) - way).abs() < 1e-6);
        let edges = edges_of(&Obstacle::Wall { points: ends.to_vec() }, DVec2::ZERO);
        let neighbours = [other(velocity * time as f32 + velocity.normalize() * 0.4, Vec2::ZERO, 0.4, 0.5)];
        let step = 1e-4;
        let wall = AvoidanceInput { step, edges: &edges, radius: 0.2, ..view(velocity, Vec2::ZERO, 9.0, &[]) };
        let disc = AvoidanceInput { step, ..view(velocity, Vec2::ZERO, 9.0, &neighbours) };
        let [wall, disc] = [wall, disc].map(|view| model.energy(&view, velocity).0);
        assert!((wall / disc - 1.0).abs() < 0.01, "at {angle}: {wall}, a disc {disc}");
    }
}
