//! The agent and what is near it, to scale.

use super::arrow::{Quantity, thin};
use super::labels::{Labels, beside};
use super::sheet::FigureLayout;
use super::tint::{self, ACCENT};
use crate::primitive::{Anchor, Primitive, Stroke};
use crate::rounded::{NOTCH_LEAST_RADIUS, Rounded};
use crate::{Camera, Color, WorldBox, legend, place};
use glam::{DVec2, Vec2};
use throng::Explanation;
use throng_record::{Body, Frame, Setting};

/// The velocities drawn at the agent. The plot shows all of them.
const SHOWN: [Quantity; 3] = [Quantity::Now, Quantity::Preferred, Quantity::Chosen];

/// Returns the primitives of the panel, which can extend beyond its edges, and those below the panel.
pub(super) fn marks(setting: &Setting, frame: &Frame, why: &Explanation, sheet: &FigureLayout) -> [Vec<Primitive>; 2] {
    let camera = camera(why, sheet);
    let (place, own) = around(setting, frame, why);
    let mut marks = place::marks(&place, sheet.style, &camera, sheet.unit, &own);
    let mut labels = Labels::new(sheet.near.inset(3.0 * sheet.unit));
    let theme = &sheet.style.theme;
    let mut numbers = Vec::new();
    let mut ways = Vec::new();
    for body in &frame.bodies {
        let (at, radius) = (camera.pixel(body.position), camera.length(f64::from(body.shape().clearance_radius())));
        let index = why.neighbours.iter().position(|other| other.number == body.number);
        let own = (body.number == why.number).then_some(ACCENT);
        let color = own.or(index.map(tint::neighbour));
        marks.push(Primitive::Agent(rounded(body, color, at, &camera, sheet)));
        labels.keep(at, radius);
        let Some(color) = color else { continue };
        numbers.push((body.number, color, at, radius));
        if index.is_some() {
            let (from, to) = way(body.velocity, at, radius, &camera);
            ways.push((from, to, color.mix(theme.text, 0.25)));
            labels.keep_line(from, to, 2.0 * sheet.unit);
        }
    }
    for (from, to, color) in ways {
        thin(from, to, color, sheet.unit, &mut marks);
    }
    let (at, radius) = (camera.pixel(why.position), camera.length(f64::from(why.radius)));
    for quantity in SHOWN {
        let (from, to) = way(quantity.of(why), at, radius, &camera);
        if from.distance(to) > 2.0 * sheet.unit {
            quantity.draw(from, to, sheet, &mut marks);
        }
    }
    let half = Vec2::splat(tint::badge_radius(sheet));
    for (number, color, at, radius) in numbers {
        let away = at - camera.pixel(why.position);
        if radius >= half.x {
            marks.push(tint::inscribed(number, color, at, radius, sheet));
        } else if let Some(center) = labels.place(half, beside(at, half, radius + 3.0 * sheet.unit, away)) {
            tint::badge(number, color, center, sheet, &mut marks);
        }
    }
    [marks, scale_bar(&camera, sheet)]
}

/// Returns the motion of the front of a body in one second.
fn way(velocity: Vec2, at: Vec2, radius: f32, camera: &Camera) -> (Vec2, Vec2) {
    let way = Vec2::new(velocity.x, -velocity.y) * camera.scale as f32;
    let front = at + way.normalize_or_zero() * radius;
    (front, front + way)
}

/// Returns a view that holds the agent, its neighbours, and their positions after one second.
fn camera(why: &Explanation, sheet: &FigureLayout) -> Camera {
    let mut view = WorldBox::NOTHING;
    let mut show = |at: DVec2, velocity: Vec2, radius: f32| {
        view.add(at, f64::from(radius));
        view.add(at + velocity.as_dvec2(), f64::from(radius));
    };
    SHOWN.iter().for_each(|quantity| show(why.position, quantity.of(why), why.radius));
    for other in &why.neighbours {
        show(why.position + other.seen.offset.as_dvec2(), other.velocity, other.radius);
    }
    let room = sheet.near.inset(26.0 * sheet.unit);
    Camera::fit(view.at_least(4.0), room.low, room.high)
}

/// Returns the place with only the agent's own goal, and a frame with only the agent.
fn around(setting: &Setting, frame: &Frame, why: &Explanation) -> (Setting, Frame) {
    let own = frame.bodies.iter().find(|body| body.number == why.number);
    let goal = own.and_then(|body| setting.goals.get(body.goal? as usize)).cloned();
    let bodies = own.map(|body| Body { goal: None, ..*body });
    let place = Setting { goals: goal.into_iter().collect(), ..setting.clone() };
    (place, Frame { bodies: bodies.into_iter().collect(), ..Frame::default() })
}

/// Returns the shape of a body. The notch is left out where a number needs the space.
fn rounded(body: &Body, color: Option<Color>, center: Vec2, camera: &Camera, sheet: &FigureLayout) -> Rounded {
    let theme = &sheet.style.theme;
    let (sin, cos) = body.heading.sin_cos();
    let (radius, core) = (camera.length(f64::from(body.radius)), body.core * camera.scale as f32);
    let notched = radius + core.min_element() >= NOTCH_LEAST_RADIUS
        && (color.is_none() || radius + core.min_element() < tint::badge_radius(sheet));
    let notch = notched.then(|| theme.notch.alpha(0.92));
    let fill = color.unwrap_or(theme.edge);
    let along = Vec2::new(cos, -sin);
    Rounded { center, core, along, radius, fill, rim: fill.mix(theme.text, 0.42), rim_width: sheet.unit, notch }
}

/// Returns a bar of a round number of metres below the panel.
fn scale_bar(camera: &Camera, sheet: &FigureLayout) -> Vec<Primitive> {
    let unit = sheet.unit;
    let metres = legend::round_length(f64::from(sheet.near.high.x - sheet.near.low.x) / 5.0 / camera.scale);
    let left = Vec2::new(sheet.near.low.x, sheet.near.high.y + 16.0 * unit);
    let right = left + Vec2::new(camera.length(metres), 0.0);
    let tick = Vec2::new(0.0, 4.0 * unit);
    let quiet = sheet.style.theme.quiet;
    let line = vec![left - tick, left, right, right - tick];
    let at = right + Vec2::new(8.0 * unit, 2.0 * unit);
    vec![
        Primitive::Line { points: line, closed: false, stroke: Stroke::plain(1.2 * unit, quiet) },
        sheet.text(format!("{metres} m; arrows: motion in 1 s"), at, Anchor::Start, quiet),
    ]
}
