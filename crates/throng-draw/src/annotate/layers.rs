//! Turns the traces of agents into lines, with one layer for each kind of annotation.

use super::pen::AnnotationPen;
use super::{Annotation, Annotations, constructions, obstacles};
use crate::plan::middle;
use crate::primitive::Primitive;
use crate::{Look, Painter, Projector, Theme, Trails};
use glam::{DVec2, DVec3, Vec3};
use throng::Trace;
use throng::steer::SteeringReason;
use throng_record::{Body, Frame};

/// The number of seconds between long ticks on trails.
const LONG: i64 = 5;
/// The duration of motion that arrows of velocities show (seconds), and the factor of accelerations (seconds²).
const WAY: f64 = 0.5;
const PUSH: f64 = 0.25;
/// With more annotated agents than this, lines are thinner and paler.
const MANY: usize = 24;
/// Up to this number of annotated agents, lines are strong enough for a slide.
const FEW: usize = 4;
/// The factor on the widths of lines and the sizes of marks of few agents, and of many agents.
const STRONG: f32 = 1.6;
const THIN: f32 = 0.7;

/// An annotated agent.
pub(super) struct Annotated<'a> {
    pub body: &'a Body,
    /// The middle of the body, where lines begin.
    pub at: DVec3,
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
        let strength = if agents.len() > MANY { 0.55 } else { 1.0 };
        let size = match agents.len() {
            ..=FEW => STRONG,
            n if n > MANY => THIN,
            _ => 1.0,
        };
        let mut marks = Vec::new();
        for kind in Annotation::ALL.into_iter().filter(|kind| wanted.kinds.contains(kind)) {
            let color = kind.color(self.theme);
            let mut pen = AnnotationPen {
                projector: &self.projector,
                unit: self.unit * size,
                color: color.faded(strength),
                width: kind.width(),
                dashed: kind.is_dashed(),
                marks: &mut marks,
            };
            // agents on the same path share its stretches, agents with the same leader its rectangle
            let mut all: Vec<SteeringReason> = Vec::new();
            for agent in &agents {
                let mut reasons = agent.reasons(kind);
                reasons.retain(|reason| {
                    let shared = is_shared(reason);
                    let drawn = shared && all.contains(reason);
                    all.extend((shared && !drawn).then_some(*reason));
                    !drawn
                });
                self.annotate(kind, agent, &reasons, frame, &mut pen);
            }
        }
        marks
    }

    fn annotate(
        &self,
        kind: Annotation,
        agent: &Annotated<'_>,
        reasons: &[SteeringReason],
        frame: &Frame,
        pen: &mut AnnotationPen<'_>,
    ) {
        let (body, at) = (agent.body, agent.at);
        let place = |local: Vec3| local.as_dvec3() + self.origin.extend(0.0);
        let velocity = |velocity: Vec3| velocity.as_dvec3() * WAY;
        match (kind, agent.account) {
            (Annotation::Velocity, _) => pen.arrow(at, velocity(body.velocity.extend(body.vertical_velocity))),
            (Annotation::Trails, _) => {
                if let Some(track) = self.ways.tracks.get(&body.number) {
                    let color = std::mem::replace(&mut pen.color, self.look.color(body).alpha(0.8));
                    pen.line(track.points.iter().map(|&(_, point)| point));
                    for (second, place) in track.seconds() {
                        pen.dot(place, if second % LONG == 0 { 2.6 } else { 1.5 });
                    }
                    pen.color = color;
                }
            }
            (Annotation::Preferred, Some(account)) => pen.arrow(at, velocity(account.preferred)),
            (Annotation::Force, Some(account)) => pen.arrow(at, account.steering.as_dvec3() * PUSH),
            (Annotation::Terms, Some(account)) => {
                let mut from = at;
                for term in terms(account) {
                    let along = term.as_dvec3() * PUSH;
                    pen.arrow(from, along);
                    from += along;
                }
            }
            (Annotation::VelocityObstacles, _) => {
                let of = |why: &throng::Explanation| why.number;
                if let Ok(index) = frame.explanations.binary_search_by_key(&body.number, of) {
                    obstacles::draw(&frame.explanations[index], at, pen);
                }
            }
            (Annotation::Paths, _) => {
                let via = |reason: &SteeringReason| match *reason {
                    SteeringReason::Via(corner) => Some(place(corner)),
                    _ => None,
                };
                pen.line(reasons.iter().filter_map(via));
                for (line, radius) in stretches(reasons) {
                    let line: Vec<DVec3> = line.into_iter().map(place).collect();
                    constructions::tube(&line, f64::from(radius), pen);
                }
            }
            _ => {}
        }
        for reason in reasons {
            match *reason {
                SteeringReason::Aim(aim) => {
                    pen.line([at, place(aim)]);
                    pen.ring(place(aim), 3.0);
                    pen.dot(place(aim), 1.0);
                }
                SteeringReason::Expects { now, then } => {
                    pen.line([place(now), place(then)]);
                    pen.ring(place(then), 2.2);
                }
                SteeringReason::Shuns(there) => pen.cross(place(there), 2.6),
                SteeringReason::Projects { from, to } => {
                    pen.line([place(from), place(to)]);
                    pen.dot(place(to), 1.8);
                }
                SteeringReason::Hits { point, normal } => constructions::hit(place(point), normal.as_dvec3(), pen),
                SteeringReason::Circle { center, radius } => {
                    pen.dot(place(center), 0.9);
                    constructions::circle(agent, place(center), f64::from(radius), pen);
                }
                SteeringReason::Rectangle(corners) => constructions::area(&corners.map(place), pen),
                SteeringReason::Cylinder { from, to, radius } => {
                    constructions::tube(&[place(from), place(to)], f64::from(radius), pen);
                }
                SteeringReason::Samples { place: there, velocity: flow } => {
                    pen.dot(place(there), 1.8);
                    pen.arrow(place(there), velocity(flow));
                }
                SteeringReason::Feels(end) => {
                    pen.line([at, place(end)]);
                    pen.dot(place(end), 1.4);
                }
                SteeringReason::Wishes(wish) => pen.arrow(at, velocity(wish)),
                SteeringReason::Looks { distance, angle } => {
                    constructions::sector(agent, f64::from(distance), angle, pen);
                }
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

/// Joins the stretches of paths that continue each other with the same radius to lines.
fn stretches(reasons: &[SteeringReason]) -> Vec<(Vec<Vec3>, f32)> {
    let mut lines: Vec<(Vec<Vec3>, f32)> = Vec::new();
    for reason in reasons {
        let SteeringReason::Stretch { from, to, radius } = *reason else { continue };
        match lines.last_mut() {
            Some((line, same)) if *same == radius && line.last() == Some(&from) => line.push(to),
            _ => lines.push((vec![from, to], radius)),
        }
    }
    lines
}

/// Whether a reason is drawn in the same way for all agents that have it.
fn is_shared(reason: &SteeringReason) -> bool {
    matches!(reason, SteeringReason::Stretch { .. } | SteeringReason::Rectangle(_) | SteeringReason::Circle { .. })
}

/// Returns the terms of the steering force: those of the sum nearest to the root of the tree of behaviours.
fn terms(account: &Trace) -> Vec<Vec3> {
    let adds = || {
        let entries = account.entries.iter();
        entries.filter_map(|told| match told.reason {
            SteeringReason::Adds(term) => Some((told.depth, term)),
            _ => None,
        })
    };
    let root = adds().map(|(depth, _)| depth).min();
    adds().filter(|&(depth, _)| Some(depth) == root).map(|(_, term)| term).collect()
}
