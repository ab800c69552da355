//! The anticipation velocity model, compared with its paper's formulas in f64.

use crate::avoid::common::{choose, other, vector, view};
use crate::avoid::repulsion::edges_of;
use glam::{DVec2, Vec2};
use proptest::prelude::*;
use throng::Obstacle;
use throng::avoid::{AnticipationVelocity, AvoidanceInput, LocalModel, Workspace};

/// Equations 1 to 7 of the paper and the speed of a walking agent; `None` where the last bit decides.
fn as_written(all: &[(Vec2, Vec2)], velocity: Vec2, preferred: Vec2, step: f64) -> Option<DVec2> {
    let [velocity, preferred] = [velocity, preferred].map(|v| v.as_dvec2());
    let (e0, e) = (preferred.normalize(), velocity.normalize());
    let mut sum = e0;
    for (offset, theirs) in all {
        let (x, theirs) = (offset.as_dvec2(), theirs.as_dvec2());
        let towards = x.normalize();
        let future = x + theirs;
        let sharp = [e0.dot(towards), e.dot(towards), e0.perp_dot(future), e0.perp_dot(x)];
        if sharp.iter().any(|x| x.abs() < 0.01) || theirs.length() < 0.01 {
            return None;
        }
        if e0.dot(towards) < 0.0 && e.dot(towards) < 0.0 {
            continue;
        }
        let gap = (x.length() - 0.4 - (velocity - theirs).dot(towards)).max(0.0);
        let strength = 8.0 * (1.0 + 0.5 * (1.0 - e0.dot(theirs.normalize()))) * (-gap / 0.1).exp();
        sum += e0.perp() * if e0.perp_dot(future) > 0.0 { -strength } else { strength };
    }
    let wanted = sum.normalize();
    let back = e0.dot(wanted) * e0.dot(e);
    let relaxed = e + (wanted - e) * (1.0 - (-step / 0.3).exp());
    let direction = if back < 0.0 { wanted } else { relaxed.normalize() };
    let mut spacing = f64::INFINITY;
    for (offset, _) in all {
        let x = offset.as_dvec2();
        let (along, across) = (direction.dot(x), direction.perp_dot(x).abs());
        if along.abs() < 1e-3 || (across - 0.4).abs() < 1e-3 || back.abs() < 1e-4 || relaxed.length() < 0.05 {
            return None;
        }
        if along > 0.0 && across < 0.4 {
            spacing = spacing.min(x.length() - 0.4);
        }
    }
    Some(direction * (spacing / 1.06).clamp(0.0, preferred.length()))
}

proptest! {
    #[test]
    fn it_chooses_as_the_paper_says(
        all in prop::collection::vec((vector(3.0), vector(1.0)), 0..6), velocity in vector(1.0), preferred in vector(1.0),
        step in 0.01f32..0.2,
    ) {
        prop_assume!(preferred.length() > 0.1 && velocity.length() > 0.1);
        prop_assume!(all.iter().all(|(offset, _)| offset.length() > 0.4));
        let expected = as_written(&all, velocity, preferred, step.into());
        prop_assume!(expected.is_some());
        let neighbours: Vec<_> = all.iter().map(|&(offset, theirs)| other(offset, theirs, 0.4, 0.5)).collect();
        let view = AvoidanceInput { step, ..view(velocity, preferred, 1.5, &neighbours) };
        let chosen = AnticipationVelocity::default().velocity(&view, &mut Workspace::default());
        prop_assert!(chosen.as_dvec2().distance(expected.unwrap_or_default()) < 2e-3, "{chosen} {expected:?}");
    }
}

/// A neighbour that crosses to the left is passed on the right, and the other way round.
#[test]
fn agents_pass_behind_those_that_cross() {
    for (crossing, side) in [(1.0, -1.0), (-1.0, 1.0)] {
        let crosses = [other(Vec2::new(1.2, -0.4 * crossing), Vec2::new(0.0, crossing), 0.4, 0.5)];
        let chosen = choose(&AnticipationVelocity::default(), Vec2::X, Vec2::X, &crosses);
        assert!(chosen.y * side > 0.01, "{crossing}: {chosen}");
    }
}

/// Within the buffer an agent does not walk towards a wall, but along it and a little away; farther off it does.
#[test]
fn agents_glide_along_walls() {
    let model = AnticipationVelocity::default();
    for (distance, glides) in [(0.29, true), (0.31, false)] {
        let points = vec![DVec2::new(-5.0, distance), DVec2::new(5.0, distance)];
        let edges = edges_of(&Obstacle::Wall { points }, DVec2::ZERO);
        let along = Vec2::new(0.8, 0.6);
        let view = AvoidanceInput { edges: &edges, ..view(along, along, 1.5, &[]) };
        let chosen = model.velocity(&view, &mut Workspace::default());
        let expected = if glides { Vec2::new(0.8, -0.3).normalize() } else { along };
        assert!(chosen.distance(expected) < 1e-4, "{distance} m: {chosen}");
    }
}
