//! Static geometry: the ground, obstacles, paths and goals; and the grid.

use super::geometry::{Disc, Geometry, Stroke};
use crate::play::RunMoment;
use glam::{DVec2, Vec2, Vec3};
use throng::Obstacle;
use throng_draw::{Color, Projector, Theme, points_to_go};
use throng_record::{Frame, Setting};
use throng_scene::Scene;

/// Beyond this number, goals are drawn fainter.
const MANY_GOALS: usize = 40;
/// The height of obstacles in a view in space, metres, and the number of corners of round obstacles.
const HEIGHT: f32 = 1.2;
const ROUND: usize = 40;
/// The direction to the light that shades surfaces.
pub(super) const LIGHT: Vec3 = Vec3::new(-0.48, -0.36, 0.8);
/// The least spacing of grid lines, points of the screen.
const CELL: f64 = 36.0;

/// Returns the ground.
pub fn floor(setting: &Setting, theme: &Theme) -> Geometry {
    let mut floor = Geometry::default();
    for area in &setting.walkable {
        let rings: Vec<Vec<DVec2>> = std::iter::once(&area.outer).chain(&area.holes).cloned().collect();
        for hole in &area.holes {
            floor.area(std::slice::from_ref(hole), setting.origin, theme.obstacle);
        }
        floor.area(&rings, setting.origin, theme.ground);
    }
    floor
}

/// Returns obstacles, paths and goals.
pub fn place(setting: &Setting, scene: &Scene, theme: &Theme, first: &Frame) -> Geometry {
    let mut place = Geometry::default();
    let local = |point: DVec2| (point - setting.origin).as_vec2().extend(0.0);
    let ring = |points: &[DVec2]| points.iter().map(|&point| local(point)).collect::<Vec<Vec3>>();
    let edge = Stroke::plain(1.2, theme.edge);
    for area in &setting.walkable {
        std::iter::once(&area.outer).chain(&area.holes).for_each(|corners| place.line(&ring(corners), true, edge));
    }
    for points in &scene.view.lines {
        let points: Vec<DVec2> = points.iter().copied().map(DVec2::from).collect();
        place.line(&ring(&points), false, edge);
    }
    for path in &setting.paths {
        for segment in path.segments() {
            place.line(&[segment.start, segment.end], false, Stroke { width: 1.2, color: theme.goal, dash: 5.0 });
        }
    }
    for facet in setting.shells.iter().filter(|shell| shell.hollow).flat_map(|shell| &shell.facets) {
        // the edges of a container lie between the viewer and the agents
        place.line(facet, true, Stroke::plain(1.0, theme.edge.alpha(0.4)));
    }
    for obstacle in &setting.obstacles {
        match obstacle {
            Obstacle::Circle { center, radius } => {
                let rim = (1.0, theme.edge);
                place.discs.push(Disc::round(local(*center), *radius as f32, theme.obstacle, rim, 0.0));
            }
            Obstacle::Polygon { corners } => {
                place.area(std::slice::from_ref(corners), setting.origin, theme.obstacle);
                place.line(&ring(corners), true, Stroke::plain(1.0, theme.edge));
            }
            Obstacle::Wall { points } => place.line(&ring(points), false, Stroke::plain(2.0, theme.edge)),
        }
    }
    if scene.view.goals.unwrap_or(true) {
        goals(setting, theme, first, &mut place);
    }
    place
}

/// Returns the surfaces of solid things from above.
pub fn roofs(setting: &Setting, theme: &Theme) -> Geometry {
    let mut roofs = Geometry::default();
    for facet in solid_facets(setting) {
        roofs.facet(facet, theme.obstacle);
        roofs.line(facet, true, Stroke::plain(1.0, theme.edge));
    }
    roofs
}

/// Returns what is solid in space: surfaces, and obstacles, walls and holes of the ground, with a height below eye level.
pub fn solids(setting: &Setting, theme: &Theme) -> Geometry {
    let mut solids = Geometry { deep: true, ..Geometry::default() };
    let holes = setting.walkable.iter().flat_map(|area| &area.holes);
    holes.for_each(|hole| prism(hole, true, setting.origin, theme, &mut solids));
    for obstacle in &setting.obstacles {
        match obstacle {
            Obstacle::Circle { center, radius } => {
                let out = |k: usize| DVec2::from_angle(k as f64 * std::f64::consts::TAU / ROUND as f64) * *radius;
                let corners: Vec<DVec2> = (0..ROUND).map(|k| *center + out(k)).collect();
                prism(&corners, true, setting.origin, theme, &mut solids);
            }
            Obstacle::Polygon { corners } => prism(corners, true, setting.origin, theme, &mut solids),
            Obstacle::Wall { points } => prism(points, false, setting.origin, theme, &mut solids),
        }
    }
    for facet in solid_facets(setting) {
        let normal = (facet[1] - facet[0]).cross(facet[2] - facet[1]).normalize_or_zero();
        let light = normal.dot(LIGHT).max(0.0);
        solids.facet(facet, theme.obstacle.mix(theme.edge, 0.6 * (1.0 - light)));
        solids.line(facet, true, Stroke::plain(1.0, theme.edge));
    }
    solids
}

/// Returns the facets of surfaces that are seen from outside.
fn solid_facets(setting: &Setting) -> impl Iterator<Item = &Vec<Vec3>> {
    setting.shells.iter().filter(|shell| !shell.hollow).flat_map(|shell| &shell.facets)
}

/// Adds the walls over a ring of corners, or over a line if not `closed`.
fn prism(corners: &[DVec2], closed: bool, origin: DVec2, theme: &Theme, solids: &mut Geometry) {
    let local = |point: DVec2, z: f32| (point - origin).as_vec2().extend(z);
    let sides = if closed { corners.len() } else { corners.len().saturating_sub(1) };
    for k in 0..sides {
        let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
        // shading by direction, independent of the order of the corners
        let light = (b - a).perp().normalize_or_zero().dot(DVec2::new(0.6, 0.8)).abs() as f32;
        let color = theme.obstacle.mix(theme.edge, 0.25 + 0.45 * light);
        solids.facet(&[local(a, 0.0), local(b, 0.0), local(b, HEIGHT), local(a, HEIGHT)], color);
        solids.line(&[local(a, HEIGHT), local(b, HEIGHT)], false, Stroke::plain(1.0, theme.edge));
    }
    if closed {
        solids.area_at(&[corners.to_vec()], origin, HEIGHT, theme.obstacle);
    }
}

fn goals(setting: &Setting, theme: &Theme, first: &Frame, place: &mut Geometry) {
    let local = |point: DVec2| (point - setting.origin).as_vec2().extend(0.0);
    for corners in setting.goals.iter().filter_map(|goal| goal.corners()) {
        let ring: Vec<Vec3> = corners.iter().map(|&corner| local(corner)).collect();
        place.area(&[corners.to_vec()], setting.origin, theme.goal.alpha(0.10));
        place.line(&ring, true, Stroke { width: 1.1, color: theme.goal.alpha(0.8), dash: 4.0 });
    }
    let points: Vec<(DVec2, f64)> = points_to_go(setting, first).collect();
    let (opacity, width, least) = if points.len() > MANY_GOALS { (0.35, 0.9, 1.8) } else { (0.9, 1.3, 4.0) };
    let color = theme.goal.alpha(opacity);
    for (at, tolerance) in points.into_iter().filter(|(at, _)| at.is_finite()) {
        place.discs.push(Disc::round(local(at), tolerance as f32, color.alpha(0.0), (width, color), least));
    }
}

/// Returns the cell size of the grid for a scale, points of the screen per metre: 1, 2 or 5 times a power of ten.
pub fn cell(scale: f64) -> f64 {
    let least = CELL / scale;
    let power = 10f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].into_iter().map(|step| step * power);
    steps.filter(|&step| step >= least).fold(10.0 * power, f64::min)
}

/// Returns the visible grid on the ground.
pub fn grid_seen(projector: &Projector, size: Vec2, shown: &RunMoment, theme: &Theme) -> Geometry {
    let color = theme.edge.alpha(0.28);
    let origin = shown.setting.origin;
    match projector {
        Projector::Plan(camera) => {
            let corners = [camera.point(Vec2::new(0.0, size.y)), camera.point(Vec2::new(size.x, 0.0))];
            grid(corners, cell(camera.scale), origin, color)
        }
        Projector::Perspective(lens) => {
            let bounds = shown.bounds;
            let (middle, half) = ((bounds.min + bounds.max) * 0.5, (bounds.max - bounds.min).max_element().max(2.0));
            let cell = cell(lens.scale(middle.extend(0.0)));
            let corners = [middle - half, middle + half].map(|corner| (corner / cell).round() * cell);
            grid(corners, cell, origin, color)
        }
    }
}

/// Returns grid lines at a spacing of `cell` between two corners, relative to `origin`. Every fifth line is stronger.
pub fn grid([low, high]: [DVec2; 2], cell: f64, origin: DVec2, color: Color) -> Geometry {
    let mut grid = Geometry::default();
    let (from, to) = ((low / cell).ceil(), (high / cell).floor());
    let mut lines = |from: f64, to: f64, ends: &dyn Fn(f64) -> [DVec2; 2]| {
        // bounds the number of lines; a denser grid would not be legible
        for k in 0..=((to - from).clamp(0.0, 400.0) as i64) {
            let at = from + k as f64;
            let strength = if at.rem_euclid(5.0) == 0.0 { 1.0 } else { 0.45 };
            let points = ends(at * cell).map(|point| (point - origin).as_vec2().extend(0.0));
            grid.line(&points, false, Stroke::plain(1.0, color.faded(strength)));
        }
    };
    lines(from.x, to.x, &|x| [DVec2::new(x, low.y), DVec2::new(x, high.y)]);
    lines(from.y, to.y, &|y| [DVec2::new(low.x, y), DVec2::new(high.x, y)]);
    grid
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_is_never_too_dense() {
        for (scale, want) in [(36.0, 1.0), (30.0, 2.0), (10.0, 5.0), (5.0, 10.0), (400.0, 0.1)] {
            assert!((cell(scale) - want).abs() < 1e-9, "{scale}: {}", cell(scale));
        }
        let lines = grid([DVec2::ZERO, DVec2::splat(4.0)], 1.0, DVec2::ZERO, Color::rgb(0)).lines.len();
        assert_eq!(lines, 10);
    }
}
