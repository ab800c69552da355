//! Turns the traces of agents into lines, with one layer for each kind of annotation.

use super::pen::AnnotationPen;
use super::{Annotation, Annotations};
use crate::plan::middle;
use crate::primitive::Primitive;
use crate::{Look, Painter, Projector, Theme, Trails};
use glam::{DVec2, DVec3, Vec3};
use std::f32::consts::PI;
use throng::Trace;
use throng::motion::Basis;
use throng::steer::SteeringReason;
use throng_record::{Body, Frame};

/// The duration of motion that arrows of velocities show (seconds), and the factor of accelerations (seconds²).
const WAY: f64 = 0.5;
const PUSH: f64 = 0.25;
/// The number of segments of a circle.
const ROUND: usize = 48;
/// With more annotated agents than this, lines are thinner and paler.
const MANY: usize = 24;

/// An annotated agent.
struct Annotated<'a> {
    body: &'a Body,
    /// The middle of the body, where lines begin.
    at: DVec3,
    account: Option<&'a Trace>,
}

impl Annotated<'_> {
    /// Returns the agent's reasons of a kind, without duplicates.
    fn reasons(&self, kind: Annotation) -> Vec<SteeringReason> {
        let mut reasons: Vec<SteeringReason> = Vec::new();
        for told in self.account.into_iter().flat_map(|account| &account.entries) {
            if kind.shows(&told.reason) && !reasons.contains(&told.reason) {
                reasons.push(told.reason);
            }
        }
        reasons
    }
}

/// Draws annotations of agents.
#[derive(Clone, Copy, Debug)]
pub struct Annotator<'a> {
    /// The kinds, and the agents they are drawn for.
    pub annotations: &'a Annotations,
    /// The colours of lines.
    pub theme: &'a Theme,
    /// The colours of agents.
    pub look: &'a Look,
    /// The trails of agents.
    pub ways: &'a Trails,
    /// The projection from the world to pixels.
    pub projector: Projector,
    /// The width of a thin line, pixels.
    pub unit: f32,
    /// The origin of the positions in traces.
    pub origin: DVec2,
}

impl Painter {
    /// Returns the annotations of agents.
    pub(crate) fn annotations(&self, frame: &Frame) -> Vec<Primitive> {
        let annotator = Annotator {
            annotations: &self.style.annotations,
            theme: &self.style.theme,
            look: &self.look,
            ways: &self.ways,
            projector: self.projector(),
            unit: self.layout.unit,
            origin: self.origin,
        };
        annotator.marks(frame)
    }
}

impl Annotator<'_> {
    /// Returns the annotations of agents at a moment, in pixels.
    pub fn marks(&self, frame: &Frame) -> Vec<Primitive> {
        let wanted = self.annotations;
        let account = |number: u32| {
            let found = frame.accounts.binary_search_by_key(&number, |account| account.number);
            found.ok().map(|index| &frame.accounts[index])
        };
        let agents: Vec<Annotated<'_>> = (frame.bodies.iter())
            .filter(|body| wanted.concern(body) && body.center().is_finite())
            .map(|body| Annotated { body, at: middle(body), account: account(body.number) })
            .collect();
        let strength = if agents.len() > MANY { 0.55 } else { 0.9 };
        let mut marks = Vec::new();
        for kind in Annotation::ALL.into_iter().filter(|kind| wanted.kinds.contains(kind)) {
            let color = kind.color(self.theme);
            let mut pen = AnnotationPen {
                projector: &self.projector,
                unit: self.unit,
                color: color.alpha(strength * f32::from(color.a) / 255.0),
                width: kind.width() * if agents.len() > MANY { 0.7 } else { 1.0 },
                dashed: kind.is_dashed(),
                marks: &mut marks,
            };
            agents.iter().for_each(|agent| self.annotate(kind, agent, frame, &mut pen));
        }
        marks
    }

    fn annotate(&self, kind: Annotation, agent: &Annotated<'_>, frame: &Frame, pen: &mut AnnotationPen<'_>) {
        let (body, at) = (agent.body, agent.at);
        let place = |local: Vec3| local.as_dvec3() + self.origin.extend(0.0);
        let velocity = |velocity: Vec3| velocity.as_dvec3() * WAY;
        match (kind, agent.account) {
            (Annotation::Velocity, _) => pen.arrow(at, velocity(body.velocity.extend(body.vertical_velocity))),
            (Annotation::Trails, _) => {
                if let Some(track) = self.ways.tracks.get(&body.number) {
                    let color = std::mem::replace(&mut pen.color, self.look.color(body).alpha(0.8));
                    pen.line(track.points.iter().map(|&(_, point)| point));
                    pen.color = color;
                }
            }
            (Annotation::Preferred, Some(account)) => pen.arrow(at, velocity(account.preferred)),
            (Annotation::Force, Some(account)) => pen.arrow(at, account.steering.as_dvec3() * PUSH),
            (Annotation::Paths, _) => {
                let via = |reason| if let SteeringReason::Via(corner) = reason { Some(place(corner)) } else { None };
                pen.line(agent.reasons(kind).into_iter().filter_map(via));
            }
            _ => {}
        }
        for reason in agent.reasons(kind) {
            match reason {
                SteeringReason::Aim(aim) => {
                    pen.line([at, place(aim)]);
                    pen.ring(place(aim), 3.0);
                    pen.dot(place(aim), 1.0);
                }
                SteeringReason::Expects(there) => {
                    pen.line([at, place(there)]);
                    pen.ring(place(there), 2.2);
                }
                SteeringReason::Feels(end) => {
                    pen.line([at, place(end)]);
                    pen.dot(place(end), 1.4);
                }
                SteeringReason::Wishes(wish) => pen.arrow(at, velocity(wish)),
                SteeringReason::Looks { distance, angle } => pen.line(sector(body, at, f64::from(distance), angle)),
                SteeringReason::Regards(number) => {
                    if let Ok(index) = frame.bodies.binary_search_by_key(&number, |body| body.number) {
                        pen.line([at, middle(&frame.bodies[index])]);
                    }
                }
                SteeringReason::Threat { own, theirs, .. } => {
                    pen.line([at, place(own), place(theirs)]);
                    pen.ring(place(own), 2.2);
                    pen.dot(place(theirs), 2.2);
                }
                _ => {}
            }
        }
    }
}

/// Returns the outline of what a body sees: a circle, or a sector with its straight sides.
fn sector(body: &Body, at: DVec3, distance: f64, angle: f32) -> Vec<DVec3> {
    let upright = || Basis::facing(DVec2::from_angle(f64::from(body.heading)).as_vec2().extend(0.0));
    let basis = body.basis.unwrap_or_else(upright);
    let out = |k: usize| {
        let (sin, cos) = (angle * (2.0 * k as f32 / ROUND as f32 - 1.0)).sin_cos();
        at + (basis.forward * cos + basis.side * sin).as_dvec3() * distance
    };
    let center = (angle < PI - 1e-3).then_some(at);
    center.into_iter().chain((0..=ROUND).map(out)).chain(center).collect()
}
