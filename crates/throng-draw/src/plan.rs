//! A moment in plan view.

use crate::insect::{Crowd, Insect};
use crate::primitive::Primitive;
use crate::rounded::{NOTCH_LEAST_RADIUS, Rounded};
use crate::{AgentShape, Camera, Color, Painter, shape};
use glam::{DVec3, Vec2};
use throng_record::{Body, Frame};

/// The least radius of an agent, pixels.
pub(crate) const LEAST_RADIUS: f32 = 1.5;
/// The offset of a shadow along both axes, relative to the altitude; and its opacity.
const SHADOW: f32 = 0.12;
pub(crate) const SHADOW_OPACITY: f32 = 0.13;

impl Painter {
    /// Returns trails, shadows and agents.
    pub(crate) fn plan(&self, camera: &Camera, frame: &Frame) -> Vec<(&'static str, Vec<Primitive>)> {
        let bodies = stacked(frame);
        let crowd = self.crowd(frame);
        let shadows = bodies.iter().filter_map(|body| self.shade(body, camera, crowd)).collect();
        let mut agents = Vec::with_capacity(bodies.len());
        bodies.into_iter().for_each(|body| self.mark(body, camera, crowd, frame.time, &mut agents));
        let mut trails = vec![Primitive::Trails(self.trails(frame.time))];
        if self.look.has(AgentShape::Insect) {
            let insects = frame.bodies.iter().filter(|body| self.look.form(body) == AgentShape::Insect);
            trails.push(Primitive::Streaks(self.streaks(insects, frame.time, crowd)));
        }
        vec![("trails", trails), ("shadows", shadows), ("agents", agents)]
    }

    /// Adds an agent in its form.
    fn mark(&self, body: &Body, camera: &Camera, crowd: Crowd, time: f64, out: &mut Vec<Primitive>) {
        match self.look.form(body) {
            AgentShape::Body => out.push(Primitive::Agent(self.rounded(body, camera))),
            AgentShape::Ball => out.push(Primitive::Agent(Rounded { notch: None, ..self.rounded(body, camera) })),
            AgentShape::Shaped(shape) => {
                if let Some(symbol) = self.vehicles.symbol(body, &self.look, &self.projector()) {
                    return out.extend(symbol);
                }
                let strides = (&self.strides, time);
                out.extend(shape::marks(shape, body, strides, self.look.coat(body), &self.projector()));
            }
            AgentShape::Insect => {
                let growth = (crowd.least / camera.length(f64::from(body.radius))).max(1.0);
                let insect = Insect::of(body, growth, self.look.coat(body), &self.projector(), time);
                out.extend(insect.map(Primitive::Insect));
            }
        }
    }

    /// Returns the shadow of an agent in the air.
    fn shade(&self, body: &Body, camera: &Camera, crowd: Crowd) -> Option<Primitive> {
        let mark = shadow(body, camera)?;
        match mark {
            // `Mark::Agent` is cheaper than a path, and insects can be many.
            Primitive::Disc { center, fill, .. } if self.look.form(body) == AgentShape::Insect => {
                let radius = (0.6 * crowd.least).max(camera.length(f64::from(body.radius)));
                Some(Primitive::Agent(Rounded::spot(center, radius, fill.alpha(SHADOW_OPACITY * crowd.left))))
            }
            mark => Some(mark),
        }
    }

    /// Returns the disc or rounded rectangle of an agent.
    fn rounded(&self, body: &Body, camera: &Camera) -> Rounded {
        let coat = self.look.coat(body);
        let radius = camera.length(f64::from(body.radius)).max(LEAST_RADIUS);
        let core = body.core.as_dvec2() * camera.scale;
        let clearance_radius = radius + core.min_element() as f32;
        let notch = self.style.headings && clearance_radius >= NOTCH_LEAST_RADIUS;
        let notch = notch.then(|| self.style.theme.notch.alpha(0.92));
        let (sin, cos) = body.heading.sin_cos();
        let rim_width =
            if body.status == throng::Status::Stranded { 0.34 * clearance_radius } else { 0.13 * clearance_radius };
        Rounded {
            center: camera.pixel(body.position),
            core: core.as_vec2(),
            // Up in the world is down in the rows of a picture.
            along: Vec2::new(cos, -sin),
            radius,
            fill: coat.fill,
            // A dark edge would hide the colour of a small disc.
            rim: coat.fill.mix(coat.rim, (0.4 * (clearance_radius - 1.2)).clamp(0.0, 1.0)),
            rim_width: rim_width.clamp(0.6, 3.0 * self.layout.unit),
            notch,
        }
    }
}

/// Returns the middle of a body; bodies on the ground stand on it.
pub(crate) fn middle(body: &Body) -> DVec3 {
    let up = if body.altitude > 0.0 { 0.0 } else { f64::from(body.radius) };
    body.center() + DVec3::Z * up
}

/// Returns all bodies by altitude, lowest first; those of equal altitude keep the order of the frame.
pub(crate) fn stacked(frame: &Frame) -> Vec<&Body> {
    let mut bodies: Vec<&Body> = frame.bodies.iter().collect();
    bodies.sort_by(|a, b| a.altitude.total_cmp(&b.altitude));
    bodies
}

/// Returns the shadow on the ground of an agent in the air; its offset grows with the altitude.
fn shadow(body: &Body, camera: &Camera) -> Option<Primitive> {
    let off = SHADOW * body.altitude * camera.scale as f32;
    let radius = camera.length(f64::from(body.radius)).max(LEAST_RADIUS);
    let center = camera.pixel(body.position) + Vec2::new(off, off);
    let fill = Color::rgb(0).alpha(SHADOW_OPACITY);
    (body.altitude > 0.0 && center.is_finite()).then_some(Primitive::Disc { center, radius, fill })
}
