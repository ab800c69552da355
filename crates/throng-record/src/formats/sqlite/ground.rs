//! The walkable area in the form that JuPedSim requires: one geometry with holes in place of the obstacles.

use crate::Setting;
use crate::formats::place;
use glam::DVec2;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
use throng::{Obstacle, Walkable};

/// Half the width of a wall, metres.
const HALF: f64 = 0.005;
/// Margin of a bounding box, metres.
const ROUND: f64 = 1.0;

type Ring = Vec<[f64; 2]>;

/// Returns the walkable areas without the obstacles, as WKT. Without walkable areas, returns a box around the obstacles
/// and the two corners `seen`.
pub(super) fn free(setting: &Setting, seen: [DVec2; 2]) -> String {
    let mut areas: Vec<Ring> = Vec::new();
    for area in &setting.walkable {
        areas.push(turned(&area.outer, 1.0));
        areas.extend(area.holes.iter().map(|hole| turned(hole, -1.0)));
    }
    let solids: Vec<Ring> = setting.obstacles.iter().flat_map(solid).collect();
    if setting.walkable.is_empty() {
        let corners = solids.iter().flatten().map(|&p| DVec2::from(p));
        let [low, high] = corners.fold(seen, |[low, high], p| [low.min(p), high.max(p)]);
        let [low, high] = if low.cmple(high).all() { [low - ROUND, high + ROUND] } else { [DVec2::ZERO, DVec2::ONE] };
        areas.push(vec![[low.x, low.y], [high.x, low.y], [high.x, high.y], [low.x, high.y]]);
    }
    let shapes = if solids.is_empty() && setting.walkable.len() < 2 {
        vec![areas]
    } else {
        areas.overlay(&solids, OverlayRule::Difference, FillRule::NonZero)
    };
    let points = |ring: Ring| ring.into_iter().map(DVec2::from).collect();
    let area = |shape: Vec<Ring>| {
        let mut rings = shape.into_iter().map(points);
        Walkable { outer: rings.next().unwrap_or_default(), holes: rings.collect() }
    };
    place::ground(&shapes.into_iter().map(area).collect::<Vec<_>>())
}

/// Returns the outlines of an obstacle, counter-clockwise.
fn solid(obstacle: &Obstacle) -> Vec<Ring> {
    let corners = place::corners(obstacle);
    let Obstacle::Wall { .. } = obstacle else { return vec![turned(&corners, 1.0)] };
    let strip = |ends: &[DVec2]| {
        let along = (ends[1] - ends[0]).normalize_or_zero() * HALF;
        let (from, to, left) = (ends[0] - along, ends[1] + along, along.perp());
        turned(&[from - left, to - left, to + left, from + left], 1.0)
    };
    corners.windows(2).map(strip).collect()
}

/// Returns corners counter-clockwise, or clockwise for `way` -1.
fn turned(corners: &[DVec2], way: f64) -> Ring {
    let next = corners.iter().cycle().skip(1);
    let area: f64 = corners.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum();
    let mut ring: Ring = corners.iter().map(|p| p.to_array()).collect();
    if area * way < 0.0 {
        ring.reverse();
    }
    ring
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f64, high: f64) -> Vec<DVec2> {
        [(low, low), (low, high), (high, high), (high, low)].map(DVec2::from).to_vec()
    }

    fn area(areas: &[Walkable]) -> f64 {
        let ring = |ring: &Vec<DVec2>| {
            let next = ring.iter().cycle().skip(1);
            (ring.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() / 2.0).abs()
        };
        areas.iter().map(|area| ring(&area.outer) - area.holes.iter().map(ring).sum::<f64>()).sum()
    }

    #[test]
    fn obstacles_are_subtracted() {
        let mut setting = Setting {
            walkable: vec![Walkable { outer: square(0.0, 10.0), holes: vec![square(1.0, 2.0)] }],
            obstacles: vec![
                Obstacle::Polygon { corners: square(9.0, 11.0) },
                Obstacle::Wall { points: vec![DVec2::new(4.0, 5.0), DVec2::new(6.0, 5.0)] },
            ],
            ..Setting::default()
        };
        let free_area = |setting: &Setting| area(&place::read(&free(setting, [DVec2::ZERO; 2])).unwrap().0);
        let want = 100.0 - 1.0 - 1.0 - 2.01 * 0.01;
        assert!((free_area(&setting) - want).abs() < 1e-3, "{}", free_area(&setting));
        setting.walkable.clear();
        // 13 m wide: 0 to 11, and 1 m on each side
        assert!((free_area(&setting) - (169.0 - 4.0 - 2.01 * 0.01)).abs() < 1e-3, "{}", free_area(&setting));
    }
}
