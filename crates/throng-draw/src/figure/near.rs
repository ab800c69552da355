//! The agent and what is near it, to scale.

use super::arrow::{Quantity, thin};
use super::labels::{Labels, beside};
use super::sheet::Sheet;
use super::tint::{self, ACCENT};
use crate::disc::{Disc, NOTCH_LEAST_RADIUS};
use crate::mark::{Anchor, Mark, Stroke};
use crate::{Camera, Color, WorldBox, legend, place};
use glam::{DVec2, Vec2};
use throng::Explanation;
use throng_record::{Body, Frame, Setting};

/// What is shown of the agent itself: the others stand in the plot.
const SHOWN: [Quantity; 3] = [Quantity::Now, Quantity::Preferred, Quantity::Chosen];

pub(super) fn marks(setting: &Setting, frame: &Frame, why: &Explanation, sheet: &Sheet) -> Vec<Mark> {
    let camera = camera(why, sheet);
    let (place, body) = around(setting, frame, why);
    let mut marks = place::marks(&place, sheet.style, &camera, sheet.unit, &body);
    let mut labels = Labels::new(sheet.near.inset(3.0 * sheet.unit));
    let seen = |body: &Body| why.neighbours.iter().position(|other| other.number == body.number);
    let radius = |body: &Body| camera.length(f64::from(body.radius));
    let tip = |at: DVec2, velocity: Vec2| camera.pixel(at + velocity.as_dvec2());

    for body in &frame.bodies {
        let color = match seen(body) {
            _ if body.number == why.number => ACCENT,
            Some(index) => tint::neighbour(index),
            None => sheet.style.theme.edge,
        };
        marks.push(Mark::Agent(disc(body, color, camera.pixel(body.position), radius(body), sheet)));
        labels.keep(camera.pixel(body.position), radius(body));
    }
    for (index, other) in why.neighbours.iter().enumerate() {
        let at = why.position + other.seen.offset.as_dvec2();
        let (from, to) = (camera.pixel(at), tip(at, other.velocity));
        let color = tint::neighbour(index).mix(sheet.style.theme.text, 0.25);
        thin(from, to, color, sheet.unit, &mut marks);
        labels.keep_line(from, to, 2.0 * sheet.unit);
    }
    let at = camera.pixel(why.position);
    for quantity in SHOWN {
        let to = tip(why.position, quantity.of(why));
        quantity.draw(at, to, sheet, &mut marks);
        labels.keep_line(at, to, 2.0 * sheet.unit);
    }
    marks.extend(scale_bar(&camera, sheet, &mut labels));
    for (index, other) in why.neighbours.iter().enumerate() {
        let at = camera.pixel(why.position + other.seen.offset.as_dvec2());
        let (color, radius) = (tint::neighbour(index), camera.length(f64::from(other.radius)));
        let half = tint::badge_radius(sheet);
        let gap = radius + 3.0 * sheet.unit;
        let away = Vec2::new(other.seen.offset.x, -other.seen.offset.y);
        if let Some(center) = labels.place(Vec2::splat(half), beside(at, Vec2::splat(half), gap, away)) {
            tint::badge(other.number, color, center, sheet, &mut marks);
        }
    }
    marks
}

/// A view that holds the agent, its neighbours, and where they are in a second.
fn camera(why: &Explanation, sheet: &Sheet) -> Camera {
    let mut view = WorldBox::NOTHING;
    let mut show = |at: DVec2, velocity: Vec2, radius: f32| {
        view.add(at, f64::from(radius));
        view.add(at + velocity.as_dvec2(), 0.0);
    };
    SHOWN.iter().for_each(|quantity| show(why.position, quantity.of(why), why.radius));
    for other in &why.neighbours {
        show(why.position + other.seen.offset.as_dvec2(), other.velocity, other.radius);
    }
    let room = sheet.near.inset(26.0 * sheet.unit);
    Camera::fit(view.at_least(4.0), room.low, room.high)
}

/// The place with the agent's own goal only, and a moment with the agent only.
fn around(setting: &Setting, frame: &Frame, why: &Explanation) -> (Setting, Frame) {
    let own = frame.bodies.iter().find(|body| body.number == why.number);
    let goal = own.and_then(|body| setting.goals.get(body.goal? as usize)).cloned();
    let bodies = own.map(|body| Body { goal: None, ..*body });
    let place = Setting { goals: goal.into_iter().collect(), ..setting.clone() };
    (place, Frame { bodies: bodies.into_iter().collect(), ..Frame::default() })
}

fn disc(body: &Body, fill: Color, center: Vec2, radius: f32, sheet: &Sheet) -> Disc {
    let theme = &sheet.style.theme;
    let (sin, cos) = body.heading.sin_cos();
    let notch = (radius >= NOTCH_LEAST_RADIUS).then(|| (Vec2::new(cos, -sin), theme.notch.alpha(0.92)));
    Disc { center, radius, fill, rim: fill.mix(theme.text, 0.42), rim_width: sheet.unit, notch }
}

/// A bar of a round number of metres, bottom left.
fn scale_bar(camera: &Camera, sheet: &Sheet, labels: &mut Labels) -> Vec<Mark> {
    let unit = sheet.unit;
    let metres = legend::round_length(f64::from(sheet.near.high.x - sheet.near.low.x) / 5.0 / camera.scale);
    let left = Vec2::new(sheet.near.low.x, sheet.near.high.y) + Vec2::new(12.0, -12.0) * unit;
    let right = left + Vec2::new(camera.length(metres), 0.0);
    let tick = Vec2::new(0.0, 4.0 * unit);
    let stroke = Stroke::plain(1.2 * unit, sheet.style.theme.quiet);
    labels.keep_line(left, right, 16.0 * unit);
    let at = (left + right) * 0.5 - Vec2::new(0.0, 6.0 * unit);
    vec![
        Mark::Line { points: vec![left - tick, left, right, right - tick], closed: false, stroke },
        sheet.text(format!("{metres} m"), at, Anchor::Middle, sheet.style.theme.quiet),
    ]
}
