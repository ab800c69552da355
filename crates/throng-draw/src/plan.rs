//! A moment from straight above.

use crate::insect::{Crowd, Insect};
use crate::mark::Mark;
use crate::rounded::{NOTCH_LEAST_RADIUS, Rounded};
use crate::{Camera, Color, Form, Painter, shape};
use glam::{DVec3, Vec2};
use throng_record::{Body, Frame};

/// The least radius an agent is drawn with, pixels.
pub(crate) const LEAST_RADIUS: f32 = 1.5;
/// How far aside, along both axes, a shadow lies, in altitudes; and its opacity.
const SHADOW: f32 = 0.12;
pub(crate) const SHADOW_OPACITY: f32 = 0.13;

impl Painter {
    /// Trails, shadows and agents.
    pub(crate) fn plan(&self, camera: &Camera, frame: &Frame) -> Vec<(&'static str, Vec<Mark>)> {
        let bodies = stacked(frame);
        let crowd = self.crowd(frame);
        let shadows = bodies.iter().filter_map(|body| self.shade(body, camera, crowd)).collect();
        let mut agents = Vec::with_capacity(bodies.len());
        bodies.into_iter().for_each(|body| self.mark(body, camera, crowd, frame.time, &mut agents));
        let mut trails = vec![Mark::Trails(self.trails(frame.time))];
        if self.look.has(Form::Insect) {
            trails.push(Mark::Streaks(self.streaks(frame, crowd)));
        }
        vec![("trails", trails), ("shadows", shadows), ("agents", agents)]
    }

    /// Adds an agent as what it looks like.
    fn mark(&self, body: &Body, camera: &Camera, crowd: Crowd, time: f64, out: &mut Vec<Mark>) {
        match self.look.form(body) {
            Form::Body => out.push(Mark::Agent(self.rounded(body, camera))),
            Form::Shaped(shape) => {
                let strides = (&self.strides, time);
                out.extend(shape::marks(shape, body, strides, self.look.coat(body), &self.projector()));
            }
            Form::Insect => {
                let growth = (crowd.least / camera.length(f64::from(body.radius))).max(1.0);
                let insect = Insect::of(body, growth, self.look.coat(body), &self.projector(), time);
                out.extend(insect.map(Mark::Insect));
            }
        }
    }

    /// The shadow of who is in the air.
    fn shade(&self, body: &Body, camera: &Camera, crowd: Crowd) -> Option<Mark> {
        let mark = shadow(body, camera)?;
        match mark {
            // insects are too many for paths
            Mark::Disc { center, fill, .. } if self.look.form(body) == Form::Insect => {
                let radius = (0.6 * crowd.least).max(camera.length(f64::from(body.radius)));
                Some(Mark::Agent(Rounded::spot(center, radius, fill.alpha(SHADOW_OPACITY * crowd.left))))
            }
            mark => Some(mark),
        }
    }

    /// How an agent is drawn.
    fn rounded(&self, body: &Body, camera: &Camera) -> Rounded {
        let coat = self.look.coat(body);
        let radius = camera.length(f64::from(body.radius)).max(LEAST_RADIUS);
        let core = body.core.as_dvec2() * camera.scale;
        let girth = radius + core.min_element() as f32;
        let notch = self.style.headings && girth >= NOTCH_LEAST_RADIUS;
        let notch = notch.then(|| self.style.theme.notch.alpha(0.92));
        let (sin, cos) = body.heading.sin_cos();
        let rim_width = if body.status == throng::Status::Stranded { 0.34 * girth } else { 0.13 * girth };
        Rounded {
            center: camera.pixel(body.position),
            core: core.as_vec2(),
            // Up in the world is down in the rows of a picture.
            along: Vec2::new(cos, -sin),
            radius,
            fill: coat.fill,
            // The edge of a small disc would take its colour away.
            rim: coat.fill.mix(coat.rim, (0.4 * (girth - 1.2)).clamp(0.0, 1.0)),
            rim_width: rim_width.clamp(0.6, 3.0 * self.layout.unit),
            notch,
        }
    }
}

/// The middle of a body as it stands: who is on the ground stands on it.
pub(crate) fn middle(body: &Body) -> DVec3 {
    let up = if body.altitude > 0.0 { 0.0 } else { f64::from(body.radius) };
    body.center() + DVec3::Z * up
}

/// Everybody, the lower first, of those at one altitude by number.
pub(crate) fn stacked(frame: &Frame) -> Vec<&Body> {
    let mut bodies: Vec<&Body> = frame.bodies.iter().collect();
    bodies.sort_by(|a, b| a.altitude.total_cmp(&b.altitude));
    bodies
}

/// The shadow of who is in the air, on the ground: the farther off, the higher.
fn shadow(body: &Body, camera: &Camera) -> Option<Mark> {
    let off = SHADOW * body.altitude * camera.scale as f32;
    let radius = camera.length(f64::from(body.radius)).max(LEAST_RADIUS);
    let center = camera.pixel(body.position) + Vec2::new(off, off);
    let fill = Color::rgb(0).alpha(SHADOW_OPACITY);
    (body.altitude > 0.0 && center.is_finite()).then_some(Mark::Disc { center, radius, fill })
}
