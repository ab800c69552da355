//! The primitives of a place: ground, obstacles, goals.

use crate::primitive::{Primitive, Stroke};
use crate::ribbon::Ribbon;
use crate::{Camera, Color, Style, Theme};
use glam::{DVec2, DVec3, Vec2, Vec3};
use throng::{Goal, Obstacle, Walkable};
use throng_record::{Frame, Setting};

/// With more point goals than this they are drawn faint, so that one goal per agent does not fill the picture.
const MANY_GOALS: usize = 40;
/// The least radius of bodies, pixels, with which so many goals are drawn: smaller rings would be specks.
const SMALL_BODY: f32 = 2.0;

/// Goal areas smaller than this, in units of the layout, get a ring around them. An exit of some metres in the plan of
/// a station would be a speck.
const SMALL_AREA: f32 = 12.0;

/// The opacity of the outlines of goal areas.
pub(crate) const GOAL: f32 = 0.8;

/// The width of the lines on the ground, in units of the layout.
pub(crate) const LINE: f32 = 1.2;

/// The width of the lines that cover the seams between neighbouring faces, pixels.
pub(crate) const SEAM: f32 = 0.6;

/// Returns everything below the drawings on the ground.
pub(crate) fn floor(setting: &Setting, theme: &Theme, camera: &Camera, unit: f32) -> Vec<Primitive> {
    let mut marks = Vec::new();
    ground(setting, theme, camera, &mut marks);
    shells(setting, true, theme, camera, unit, &mut marks);
    marks
}

/// Returns the solids.
pub(crate) fn solids(setting: &Setting, theme: &Theme, camera: &Camera, unit: f32) -> Vec<Primitive> {
    let mut marks = Vec::new();
    shells(setting, false, theme, camera, unit, &mut marks);
    obstacles(setting, theme, camera, unit, &mut marks);
    marks
}

/// Returns everything constant on the floor, from the ground up. `first` is the first moment.
pub(crate) fn marks(setting: &Setting, style: &Style, camera: &Camera, unit: f32, first: &Frame) -> Vec<Primitive> {
    let mut marks = Vec::new();
    let theme = &style.theme;
    let edge = Stroke::plain(1.2 * unit, theme.edge);
    let borders = areas(setting, camera).into_iter().flatten();
    marks.extend(borders.map(|points| Primitive::Line { points, closed: true, stroke: edge }));
    let stroke = Stroke::plain(LINE * unit, theme.edge);
    marks.extend(style.lines.iter().map(|line| Primitive::Line {
        points: pixels(camera, line),
        closed: false,
        stroke,
    }));
    shells(setting, false, theme, camera, unit, &mut marks);
    paths(setting, style, camera, unit, &mut marks);
    if style.goals {
        goal_areas(setting, style, camera, unit, &mut marks);
    }
    obstacles(setting, theme, camera, unit, &mut marks);
    if style.goals {
        goal_points(setting, style, camera, unit, first, &mut marks);
    }
    marks
}

fn pixels(camera: &Camera, points: &[DVec2]) -> Vec<Vec2> {
    points.iter().map(|&p| camera.pixel(p)).collect()
}

/// Returns the rings of each area, the outer one first. Larger areas come first, so that an area inside a hole of
/// another is drawn after it.
fn areas(setting: &Setting, camera: &Camera) -> Vec<Vec<Vec<Vec2>>> {
    let mut areas: Vec<_> = setting.walkable.iter().map(|area| (size(&area.outer), area)).collect();
    areas.sort_by(|a, b| b.0.total_cmp(&a.0));
    let rings = |area: &Walkable| -> Vec<Vec<Vec2>> {
        let rings = std::iter::once(&area.outer).chain(&area.holes).filter(|ring| ring.len() >= 3);
        rings.map(|ring| pixels(camera, ring)).collect()
    };
    areas.into_iter().map(|(_, area)| rings(area)).collect()
}

fn ground(setting: &Setting, theme: &Theme, camera: &Camera, marks: &mut Vec<Primitive>) {
    for rings in areas(setting, camera) {
        let holes =
            rings.iter().skip(1).map(|hole| Primitive::Area { rings: vec![hole.clone()], fill: theme.obstacle });
        marks.extend(holes);
        marks.push(Primitive::Area { rings, fill: theme.ground });
    }
}

/// Returns the area of a polygon.
fn size(corners: &[DVec2]) -> f64 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    0.5 * edges.map(|(a, b)| a.perp_dot(*b)).sum::<f64>().abs()
}

fn obstacles(setting: &Setting, theme: &Theme, camera: &Camera, unit: f32, marks: &mut Vec<Primitive>) {
    let edge = Stroke::plain(unit, theme.edge);
    for obstacle in &setting.obstacles {
        match obstacle {
            Obstacle::Circle { center, radius } => {
                let (center, radius) = (camera.pixel(*center), camera.length(*radius));
                marks.push(Primitive::Disc { center, radius, fill: theme.obstacle });
                // Edges lie inside, so that bodies touch the obstacle and not its edge.
                let radius = (radius - 0.5 * unit).max(0.5 * unit);
                marks.push(Primitive::Ring { center, radius, stroke: edge });
            }
            Obstacle::Polygon { corners } => {
                let corners = pixels(camera, corners);
                marks.push(Primitive::Area { rings: vec![corners.clone()], fill: theme.obstacle });
                marks.push(Primitive::Line { points: corners, closed: true, stroke: edge });
            }
            Obstacle::Wall { points } => {
                let stroke = Stroke::plain(2.0 * unit, theme.edge);
                marks.push(Primitive::Line { points: pixels(camera, points), closed: false, stroke });
            }
        }
    }
}

/// Adds surfaces in plan view: solids like obstacles, or hollow ones by their outlines.
fn shells(setting: &Setting, hollow: bool, theme: &Theme, camera: &Camera, unit: f32, marks: &mut Vec<Primitive>) {
    let pixel = |corner: &Vec3| camera.pixel(corner.truncate().as_dvec2() + setting.origin);
    let fill = if hollow { theme.ground } else { theme.obstacle };
    for shell in setting.shells.iter().filter(|shell| shell.hollow == hollow) {
        // Higher facets cover lower ones, so that only the outer edges stay visible.
        let mut facets: Vec<&Vec<Vec3>> = shell.facets.iter().collect();
        facets.sort_by(|a, b| highest(a).total_cmp(&highest(b)));
        let rings: Vec<Vec<Vec2>> = facets.iter().map(|facet| facet.iter().map(pixel).collect()).collect();
        let outline = |width: f32, color: Color| {
            let stroke = Stroke::plain(width, color);
            move |points: &Vec<Vec2>| Primitive::Line { points: points.clone(), closed: true, stroke }
        };
        marks.extend(rings.iter().map(outline(2.0 * unit, theme.edge)));
        marks.extend(rings.iter().map(|ring| Primitive::Area { rings: vec![ring.clone()], fill }));
        let flat = facets.iter().zip(&rings).filter(|(facet, _)| is_level(facet));
        marks.extend(flat.map(|(_, ring)| ring).map(outline(SEAM, fill)));
    }
}

fn highest(facet: &[Vec3]) -> f32 {
    facet.iter().map(|corner| corner.z).fold(f32::NEG_INFINITY, f32::max)
}

/// Whether a facet covers ground: upright facets are lines in plan view.
fn is_level(facet: &[Vec3]) -> bool {
    let edges = facet.iter().zip(facet.iter().cycle().skip(1));
    edges.map(|(a, b)| a.truncate().perp_dot(b.truncate())).sum::<f32>().abs() > 1e-3
}

/// Adds paths: their width in a faint tone, and a thin spine.
fn paths(setting: &Setting, style: &Style, camera: &Camera, unit: f32, marks: &mut Vec<Primitive>) {
    let pixel = |point: DVec3| camera.pixel(point.truncate());
    for path in &setting.paths {
        let ribbon = Ribbon::new(path, setting.origin);
        let areas = ribbon.areas.iter().map(|area| vec![area.iter().copied().map(pixel).collect()]);
        marks.extend(areas.map(|rings| Primitive::Area { rings, fill: Ribbon::tone(&style.theme) }));
        let points = ribbon.spine.into_iter().map(pixel).collect();
        marks.push(Primitive::Line { points, closed: false, stroke: Ribbon::stroke(&style.theme, unit) });
    }
}

fn goal_areas(setting: &Setting, style: &Style, camera: &Camera, unit: f32, marks: &mut Vec<Primitive>) {
    let color = style.theme.goal;
    for goal in &setting.goals {
        let (corners, tint) = match goal {
            Goal::Point { .. } | Goal::Air { .. } => continue,
            Goal::Area { corners } => (corners, 0.10),
            Goal::Exit { corners } => (corners, 0.24),
        };
        let points = pixels(camera, corners);
        marks.push(Primitive::Area { rings: vec![points.clone()], fill: color.alpha(tint) });
        let low = points.iter().copied().fold(Vec2::INFINITY, Vec2::min);
        let high = points.iter().copied().fold(Vec2::NEG_INFINITY, Vec2::max);
        let stroke = Stroke { width: 1.1 * unit, color: color.alpha(GOAL), dash: Some(4.0 * unit) };
        marks.push(Primitive::Line { points, closed: true, stroke });
        if (high - low).max_element() < SMALL_AREA * unit {
            let stroke = Stroke::plain(1.6 * unit, color);
            marks.push(Primitive::Ring { center: (low + high) * 0.5, radius: 0.75 * SMALL_AREA * unit, stroke });
        }
    }
}

/// Returns the visible point goals with their tolerances, metres. Leaves out goals where an agent of the goal already
/// waits at the `first` moment.
pub fn points_to_go(setting: &Setting, first: &Frame) -> impl Iterator<Item = (DVec2, f64)> {
    spots_to_go(setting, first).map(|(at, tolerance)| (at.truncate(), tolerance))
}

/// Returns the same as [`points_to_go`] in space; goals that are not in the air are on the ground.
pub(crate) fn spots_to_go(setting: &Setting, first: &Frame) -> impl Iterator<Item = (DVec3, f64)> {
    let mut waits = vec![false; setting.goals.len()];
    for body in &first.bodies {
        let goal = body.goal.map(|goal| goal as usize).filter(|&goal| goal < waits.len());
        if let Some(goal) = goal
            && setting.goals[goal].tolerance().is_some()
        {
            waits[goal] |= setting.goals[goal].holds(body.center());
        }
    }
    setting.goals.iter().zip(waits).filter_map(|(goal, waits)| {
        let tolerance = goal.tolerance().filter(|_| !waits)?;
        Some((goal.middle().extend(goal.altitude().unwrap_or(0.0)), f64::from(tolerance)))
    })
}

fn goal_points(
    setting: &Setting,
    style: &Style,
    camera: &Camera,
    unit: f32,
    first: &Frame,
    marks: &mut Vec<Primitive>,
) {
    let mut rings: Vec<(Vec2, f32)> = points_to_go(setting, first)
        .map(|(at, tolerance)| (camera.pixel(at), camera.length(tolerance)))
        .filter(|(center, radius)| center.is_finite() && radius.is_finite())
        .collect();
    // One ring for equal goals.
    rings.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.0.y.total_cmp(&b.0.y)).then(a.1.total_cmp(&b.1)));
    rings.dedup();
    let many = rings.len() > MANY_GOALS;
    // Rings are no larger than bodies.
    let body = first.bodies.iter().map(|body| camera.length(f64::from(body.radius))).fold(0.0, f32::max);
    if many && body > 0.0 && body < SMALL_BODY {
        return;
    }
    let most = if body > 0.0 { (0.8 * body).max(1.8) } else { f32::INFINITY };
    let opacity = if many { 0.35 } else { 0.9 };
    let stroke = Stroke::plain(if many { 0.9 } else { 1.3 } * unit, style.theme.goal.alpha(opacity));
    let least = if many { 1.8 } else { 4.0 } * unit;
    for (center, radius) in rings {
        // A tolerance larger than a body is drawn to scale.
        let radius = radius.max(least.min(most));
        marks.push(Primitive::Ring { center, radius, stroke });
        if !many && radius > 3.0 * unit {
            marks.push(Primitive::Disc { center, radius: 1.1 * unit, fill: style.theme.goal.alpha(opacity) });
        }
    }
}
