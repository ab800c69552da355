//! From what agents tell to lines: one layer for each kind.

use super::pen::Pen;
use super::{Annotation, Annotations};
use crate::mark::Mark;
use crate::plan::middle;
use crate::{Look, Painter, Projector, Theme, Trails};
use glam::{DVec2, DVec3, Vec3};
use std::f32::consts::PI;
use throng::Account;
use throng::motion::Basis;
use throng::steer::Reason;
use throng_record::{Body, Frame};

/// Seconds of way that arrows of velocities show, and seconds² of accelerations.
const WAY: f64 = 0.5;
const PUSH: f64 = 0.25;
/// Corners of a circle.
const ROUND: usize = 48;
/// Of more agents than this the lines step back.
const MANY: usize = 24;

/// One who is annotated.
struct Annotated<'a> {
    body: &'a Body,
    /// Where it is, and where lines begin.
    at: DVec3,
    account: Option<&'a Account>,
}

impl Annotated<'_> {
    /// What it tells of a kind, each once.
    fn reasons(&self, kind: Annotation) -> Vec<Reason> {
        let mut reasons: Vec<Reason> = Vec::new();
        for told in self.account.into_iter().flat_map(|account| &account.told) {
            if kind.shows(&told.reason) && !reasons.contains(&told.reason) {
                reasons.push(told.reason);
            }
        }
        reasons
    }
}

/// What it takes to draw what agents have in mind.
#[derive(Clone, Copy, Debug)]
pub struct Annotator<'a> {
    /// What, beside whom.
    pub annotations: &'a Annotations,
    /// The colours of lines.
    pub theme: &'a Theme,
    /// The colours of agents.
    pub look: &'a Look,
    /// Where they have been.
    pub ways: &'a Trails,
    /// From the world to pixels.
    pub projector: Projector,
    /// Pixels of a thin line.
    pub unit: f32,
    /// What places that agents tell are relative to.
    pub origin: DVec2,
}

impl Painter {
    /// The lines beside agents.
    pub(crate) fn annotations(&self, frame: &Frame) -> Vec<Mark> {
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
    /// The lines beside agents at a moment, pixels.
    pub fn marks(&self, frame: &Frame) -> Vec<Mark> {
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
            let mut pen = Pen {
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

    fn annotate(&self, kind: Annotation, agent: &Annotated<'_>, frame: &Frame, pen: &mut Pen<'_>) {
        let (body, at) = (agent.body, agent.at);
        let place = |local: Vec3| local.as_dvec3() + self.origin.extend(0.0);
        let velocity = |velocity: Vec3| velocity.as_dvec3() * WAY;
        match (kind, agent.account) {
            (Annotation::Velocity, _) => pen.arrow(at, velocity(body.velocity.extend(body.climb))),
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
                let via = |reason| if let Reason::Via(corner) = reason { Some(place(corner)) } else { None };
                pen.line(agent.reasons(kind).into_iter().filter_map(via));
            }
            _ => {}
        }
        for reason in agent.reasons(kind) {
            match reason {
                Reason::Aim(aim) => {
                    pen.line([at, place(aim)]);
                    pen.ring(place(aim), 3.0);
                    pen.dot(place(aim), 1.0);
                }
                Reason::Expects(there) => {
                    pen.line([at, place(there)]);
                    pen.ring(place(there), 2.2);
                }
                Reason::Feels(end) => {
                    pen.line([at, place(end)]);
                    pen.dot(place(end), 1.4);
                }
                Reason::Wishes(wish) => pen.arrow(at, velocity(wish)),
                Reason::Looks { distance, angle } => pen.line(sector(body, at, f64::from(distance), angle)),
                Reason::Regards(number) => {
                    if let Ok(index) = frame.bodies.binary_search_by_key(&number, |body| body.number) {
                        pen.line([at, middle(&frame.bodies[index])]);
                    }
                }
                Reason::Threat { own, theirs, .. } => {
                    pen.line([at, place(own), place(theirs)]);
                    pen.ring(place(own), 2.2);
                    pen.dot(place(theirs), 2.2);
                }
                _ => {}
            }
        }
    }
}

/// The outline of what a body sees: a circle, or a part of one with its straight sides.
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
