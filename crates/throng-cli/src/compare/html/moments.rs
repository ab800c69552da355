//! Pictures of the three consecutive moments of a run in which velocities swing most, around the agent with the largest
//! swing.

use glam::{DVec2, Vec2};
use std::fmt::Write;
use throng::Obstacle;
use throng_record::series::swing;
use throng_record::{Body, Frame, Setting};

/// The side of a picture: in pixels, and in radii of the agent in its middle.
const SIDE: f64 = 240.0;
const RADII: f64 = 14.0;
/// The length of arrows, in seconds of motion.
const SECONDS: f64 = 0.5;

/// Returns the moments as three SVG elements with captions. `colors` are the colours of the groups.
pub fn pictures(frames: &[Frame; 3], setting: &Setting, colors: &[String]) -> String {
    let Some(middle) = wildest(frames) else { return String::new() };
    let view = |frame: &Frame| at(frame, middle).map(|body| body.position);
    let center = view(&frames[1]).unwrap_or_default();
    let radius = at(&frames[1], middle).map_or(0.2, |body| f64::from(body.shape().bounding_radius()));
    let window = Window { center, scale: SIDE / (RADII * radius) };
    let mut out = String::new();
    for (k, frame) in frames.iter().enumerate() {
        let before = k.checked_sub(1).map(|k| &frames[k]);
        let _ =
            write!(out, "<figure><svg viewBox=\"0 0 {SIDE} {SIDE}\" role=\"img\" aria-label=\"{:.2} s\">", frame.time);
        window.obstacles(setting, &mut out);
        let near: Vec<&Body> = frame.bodies.iter().filter(|body| window.sees(body)).collect();
        for body in &near {
            let color = colors.get(body.group as usize).map_or("#888", String::as_str);
            let class = if body.number == middle { "body middle" } else { "body" };
            window.body(body, &format!("class=\"{class}\" fill=\"{color}\" stroke=\"{color}\""), &mut out);
        }
        for body in &near {
            let wild = if body.number == middle { " wild" } else { "" };
            if let Some(last) = before.and_then(|frame| at(frame, body.number)) {
                window.arrow(body.position, last.velocity, &format!("arrow ghost{wild}"), &mut out);
            }
            window.arrow(body.position, body.velocity, &format!("arrow{wild}"), &mut out);
        }
        let _ = writeln!(out, "</svg><figcaption>{:.2} s</figcaption></figure>", frame.time);
    }
    out
}

/// Returns the number of the walking agent with the largest swing of its velocity.
fn wildest(frames: &[Frame; 3]) -> Option<u32> {
    let swings = frames[2].bodies.iter().filter(|body| body.status == throng::Status::Walking).filter_map(|body| {
        let (a, b) = (at(&frames[0], body.number)?, at(&frames[1], body.number)?);
        Some((swing(a.velocity, b.velocity, body.velocity), body.number))
    });
    swings.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))).map(|(_, number)| number)
}

fn at(frame: &Frame, number: u32) -> Option<&Body> {
    frame.bodies.iter().find(|body| body.number == number)
}

struct Window {
    center: DVec2,
    /// Pixels per metre.
    scale: f64,
}

impl Window {
    fn pixel(&self, point: DVec2) -> (f64, f64) {
        let offset = (point - self.center) * self.scale;
        (0.5 * SIDE + offset.x, 0.5 * SIDE - offset.y)
    }

    fn sees(&self, body: &Body) -> bool {
        let reach = 0.5 * SIDE / self.scale + f64::from(body.shape().bounding_radius());
        (body.position - self.center).abs().max_element() < reach
    }

    fn body(&self, body: &Body, look: &str, out: &mut String) {
        let (x, y) = self.pixel(body.position);
        let r = f64::from(body.radius) * self.scale;
        let [a, b] = <[f32; 2]>::from(body.core).map(|half| f64::from(half) * self.scale + r);
        let turn = -body.heading.to_degrees();
        let place = format!("x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"", x - a, y - b, 2.0 * a, 2.0 * b);
        let _ = write!(out, "<rect {look} {place} rx=\"{r:.1}\" transform=\"rotate({turn:.1} {x:.1} {y:.1})\"/>");
    }

    fn arrow(&self, from: DVec2, velocity: Vec2, class: &str, out: &mut String) {
        let way = velocity.as_dvec2() * SECONDS;
        if way.length() * self.scale < 4.0 {
            return;
        }
        let ((x, y), (tx, ty)) = (self.pixel(from), self.pixel(from + way));
        let (along, across) = (way.normalize() * 7.0, way.normalize().perp() * 4.0);
        let wing = |side: f64| (tx - along.x + side * across.x, ty + along.y - side * across.y);
        let ((ax, ay), (bx, by)) = (wing(1.0), wing(-1.0));
        let head = format!("M{ax:.1} {ay:.1}L{tx:.1} {ty:.1}L{bx:.1} {by:.1}");
        let _ = write!(out, "<path class=\"{class}\" d=\"M{x:.1} {y:.1}L{tx:.1} {ty:.1}{head}\"/>");
    }

    fn obstacles(&self, setting: &Setting, out: &mut String) {
        let line = |points: &[DVec2]| -> String {
            let pixels = points.iter().map(|&point| self.pixel(point));
            pixels.map(|(x, y)| format!("{x:.1},{y:.1} ")).collect()
        };
        for obstacle in &setting.obstacles {
            let _ = match obstacle {
                Obstacle::Circle { center, radius } => {
                    let ((x, y), r) = (self.pixel(*center), radius * self.scale);
                    write!(out, "<circle class=\"solid\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r:.1}\"/>")
                }
                Obstacle::Polygon { corners } => write!(out, "<polygon class=\"solid\" points=\"{}\"/>", line(corners)),
                Obstacle::Wall { points } => write!(out, "<polyline class=\"wall\" points=\"{}\"/>", line(points)),
            };
        }
        for ring in setting.walkable.iter().flat_map(|area| std::iter::once(&area.outer).chain(&area.holes)) {
            let _ = write!(out, "<polygon class=\"wall\" points=\"{}\"/>", line(ring));
        }
    }
}
