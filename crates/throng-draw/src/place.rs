//! The marks of a place: ground, obstacles, goals.

use crate::mark::{Mark, Stroke};
use crate::{Camera, Style};
use glam::{DVec2, Vec2};
use throng::{Goal, Obstacle};
use throng_record::Setting;

/// More point goals than this are drawn faint, so that a goal for each agent does not fill the picture.
const MANY_GOALS: usize = 40;

/// Everything that does not change, from the ground up.
pub(crate) fn marks(setting: &Setting, style: &Style, camera: &Camera, unit: f32) -> Vec<Mark> {
    let mut marks = Vec::new();
    ground(setting, style, camera, unit, &mut marks);
    if style.goals {
        goal_areas(setting, style, camera, unit, &mut marks);
    }
    obstacles(setting, style, camera, unit, &mut marks);
    if style.goals {
        goal_points(setting, style, camera, unit, &mut marks);
    }
    marks
}

fn pixels(camera: &Camera, points: &[DVec2]) -> Vec<Vec2> {
    points.iter().map(|&p| camera.pixel(p)).collect()
}

fn ground(setting: &Setting, style: &Style, camera: &Camera, unit: f32, marks: &mut Vec<Mark>) {
    let theme = &style.theme;
    for walkable in &setting.walkable {
        let rings: Vec<_> = std::iter::once(&walkable.outer)
            .chain(&walkable.holes)
            .filter(|ring| ring.len() >= 3)
            .map(|ring| pixels(camera, ring))
            .collect();
        marks.push(Mark::Area { rings, fill: theme.ground });
    }
    // Edges of areas that share a side would cross the ground between them: only a single area has a full outline.
    let edge = Stroke::plain(1.2 * unit, theme.edge);
    for walkable in &setting.walkable {
        if setting.walkable.len() == 1 {
            marks.push(Mark::Line { points: pixels(camera, &walkable.outer), closed: true, stroke: edge });
        }
        for hole in &walkable.holes {
            marks.push(Mark::Area { rings: vec![pixels(camera, hole)], fill: theme.obstacle });
            marks.push(Mark::Line { points: pixels(camera, hole), closed: true, stroke: edge });
        }
    }
}

fn obstacles(setting: &Setting, style: &Style, camera: &Camera, unit: f32, marks: &mut Vec<Mark>) {
    let theme = &style.theme;
    let edge = Stroke::plain(unit, theme.edge);
    for obstacle in &setting.obstacles {
        match obstacle {
            Obstacle::Circle { center, radius } => {
                let (center, radius) = (camera.pixel(*center), camera.length(*radius));
                marks.push(Mark::Disc { center, radius, fill: theme.obstacle });
                // Edges lie inside, so that bodies touch the obstacle and not its edge.
                let radius = (radius - 0.5 * unit).max(0.5 * unit);
                marks.push(Mark::Ring { center, radius, stroke: edge });
            }
            Obstacle::Polygon { corners } => {
                let corners = pixels(camera, corners);
                marks.push(Mark::Area { rings: vec![corners.clone()], fill: theme.obstacle });
                marks.push(Mark::Line { points: corners, closed: true, stroke: edge });
            }
            Obstacle::Wall { points } => {
                let stroke = Stroke::plain(2.0 * unit, theme.edge);
                marks.push(Mark::Line { points: pixels(camera, points), closed: false, stroke });
            }
        }
    }
}

fn goal_areas(setting: &Setting, style: &Style, camera: &Camera, unit: f32, marks: &mut Vec<Mark>) {
    let color = style.theme.goal;
    for goal in &setting.goals {
        let (corners, tint) = match goal {
            Goal::Point { .. } => continue,
            Goal::Area { corners } => (corners, 0.10),
            Goal::Exit { corners } => (corners, 0.24),
        };
        let points = pixels(camera, corners);
        marks.push(Mark::Area { rings: vec![points.clone()], fill: color.alpha(tint) });
        let stroke = Stroke { width: 1.1 * unit, color: color.alpha(0.8), dash: Some(4.0 * unit) };
        marks.push(Mark::Line { points, closed: true, stroke });
    }
}

fn goal_points(setting: &Setting, style: &Style, camera: &Camera, unit: f32, marks: &mut Vec<Mark>) {
    let mut rings: Vec<(Vec2, f32)> = setting
        .goals
        .iter()
        .filter_map(|goal| match goal {
            Goal::Point { at, tolerance } => Some((camera.pixel(*at), camera.length(f64::from(*tolerance)))),
            _ => None,
        })
        .filter(|(center, radius)| center.is_finite() && radius.is_finite())
        .collect();
    // One ring for goals in one place.
    rings.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.0.y.total_cmp(&b.0.y)).then(a.1.total_cmp(&b.1)));
    rings.dedup();
    let many = rings.len() > MANY_GOALS;
    let opacity = if many { 0.35 } else { 0.9 };
    let stroke = Stroke::plain(if many { 0.9 } else { 1.3 } * unit, style.theme.goal.alpha(opacity));
    let least = if many { 1.8 } else { 4.0 } * unit;
    for (center, radius) in rings {
        let radius = radius.max(least);
        marks.push(Mark::Ring { center, radius, stroke });
        if !many {
            marks.push(Mark::Disc { center, radius: 1.1 * unit, fill: style.theme.goal.alpha(opacity) });
        }
    }
}
