//! The power law of human interaction: Karamouzas, Skinner, Guy, Universal power law governing pedestrian interactions,
//! Physical Review Letters 113:238701, 2014 (arXiv 1412.1082), with the implicit step of Karamouzas, Sohre, Narain,
//! Guy, Implicit crowds, ACM Transactions on Graphics 36(4), 2017, applied to each agent separately.
//!
//! In recorded data the interaction energy of two pedestrians depends only on the time `t` to their collision:
//! `E = k t^-2 exp(-t / t0)` per unit of mass. Its negative gradient with respect to the position is an acceleration.
//! Two agents that walk abreast, or apart, do not interact. The force is stiff just before a collision, so the step is
//! implicit: the model takes the velocity `v` that minimises
//!
//! ```text
//! |v - v_now|^2 / (2 step) + |v - preferred|^2 / (2 xi) + sum R(t) + sum eta / gap
//! ```
//!
//! over neighbours, which keep their velocities, and the wall that would be touched first; `t` is the time to collision
//! after the step. `R = k t^-3 exp(-x) (x + 2) / (x + 3)`, `x = t / t0`. Its gradient with respect to the velocity is
//! the force of 2014 to within 2.2 %: the gradients of `t` with respect to velocity and position differ by the factor
//! `t`. `gap` is the least distance between the bodies in the step, so that bodies cannot pass through each other.
//! Inverse times are smooth where bodies graze, and the power law holds up to 10 per second. Beyond that, and at
//! contact, energies grow linearly.

use super::imminence::{LEAST_GAP, of_disc, of_segment};
use super::{AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, Cause, LocalModel, Workspace, descent};
use crate::Error;
use crate::parameters::{Value, parameters};
use glam::Vec2;

/// The power law of human interaction with an implicit step (Karamouzas, Skinner, Guy, 2014; Karamouzas, Sohre, Narain,
/// Guy, 2017): accelerations by the time to a collision.
///
/// ```
/// use throng::avoid::PowerLaw;
/// let shy = PowerLaw { strength: 3.0, ..PowerLaw::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// Strength of the interaction, m^2 (the paper's k over the mass).
    #[parameter(default = 1.5, unit = "m²", least = 0)]
    pub strength: f32,
    /// Seconds beyond which collisions are screened off (the paper's tau0).
    #[parameter(default = 3.0, unit = "s", above = 0)]
    pub time_horizon: f32,
    /// Seconds to reach the preferred velocity (the paper's xi).
    #[parameter(default = 0.54, unit = "s", above = 0)]
    pub relaxation_time: f32,
    /// The part of the radii within which a collision counts as grazing (epsilon).
    #[parameter(default = 0.2, least = 0.01, most = 0.9)]
    pub grazing: f32,
    /// Strength of the repulsion at contact, m^3/s^3 (eta).
    #[parameter(default = 0.01, unit = "m³/s³", least = 0)]
    pub contact: f32,
}

/// Greatest inverse time to collision for which the power law is used, 1/s.
const MOST_IMMINENT: f32 = 10.0;

impl LocalModel for PowerLaw {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        let (inertia, drive) = (1.0 / view.step, 1.0 / self.relaxation_time);
        // without interactions this is the minimum
        let free = (view.velocity * inertia + view.preferred * drive) / (inertia + drive);
        let ends = descent::least(free, 1.0 / (inertia + drive), |v| self.cost(view, v));
        ends.clamp_length_max(view.max_speed)
    }

    fn relaxes(&self) -> bool {
        true
    }

    fn parts_bodies(&self) -> bool {
        true
    }

    /// Returns 10: the distance that two agents walk towards each other within the time horizon.
    fn neighbour_distance(&self) -> f32 {
        10.0
    }

    fn explain(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec<AvoidanceReason> {
        let chosen = self.velocity(view, workspace);
        let pushes = self.interactions(view, chosen).map(|(cause, (_, gradient))| (cause, -gradient));
        pushes.filter(|(_, push)| *push != Vec2::ZERO).map(|(cause, push)| AvoidanceReason::Push(cause, push)).collect()
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        self.time_horizon * max_speed + radius
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

/// An energy and its gradient with respect to the velocity.
type Energy = (f32, Vec2);

impl PowerLaw {
    /// Returns the cost that the velocity minimises, and its gradient.
    fn cost(&self, view: &AvoidanceInput<'_>, v: Vec2) -> Energy {
        let (change, off) = (v - view.velocity, v - view.preferred);
        let inertia = (change.length_squared() / (2.0 * view.step), change / view.step);
        let relaxation = self.relaxation_time;
        let drive = (off.length_squared() / (2.0 * relaxation), off / relaxation);
        self.interactions(view, v).fold(add(inertia, drive), |sum, (_, energy)| add(sum, energy))
    }

    /// Returns the energy of interaction of an agent with this velocity, m^2/s^3, and its gradient with respect to the
    /// velocity: the negative acceleration by neighbours and walls, m/s^2.
    pub fn energy(&self, view: &AvoidanceInput<'_>, velocity: Vec2) -> (f32, Vec2) {
        self.interactions(view, velocity).fold((0.0, Vec2::ZERO), |sum, (_, energy)| add(sum, energy))
    }

    fn interactions(&self, view: &AvoidanceInput<'_>, v: Vec2) -> impl Iterator<Item = (Cause, Energy)> {
        let neighbours = view.others().map(move |(cause, other)| {
            let (energy, gradient) = self.with_neighbour(&other, v, view.step);
            let weight = 2.0 * other.share;
            (cause, (energy * weight, gradient * weight))
        });
        neighbours.chain(self.with_wall(view, v))
    }

    fn with_neighbour(&self, other: &AvoidanceNeighbour, v: Vec2, step: f32) -> Energy {
        let (distance, away) = other.separation();
        // for bodies that are not discs, the point of the core that is nearest now
        let (offset, relative) = (away * -distance.max(0.0), v - other.velocity);
        let time = (offset.dot(relative) / relative.length_squared().max(1e-9)).clamp(0.0, step);
        let nearest = offset - relative * time;
        let outward = nearest.normalize_or(-away);
        let contact = self.at_gap(nearest.length() - other.radii, outward * time, other.radii);
        let (rate, by_velocity) = of_disc(offset, relative, other.radii, step, self.grazing);
        let (energy, by_rate) = self.at_rate(rate);
        add(contact, (energy, by_velocity * by_rate))
    }

    /// Returns the energy of the wall that would be touched first. A corner shared by two edges counts once.
    fn with_wall(&self, view: &AvoidanceInput<'_>, v: Vec2) -> Option<(Cause, Energy)> {
        let (step, radius) = (view.step, view.radius);
        let edges =
            view.edges.iter().enumerate().map(|(index, near)| {
                (Cause::Edge(index), of_segment(near.start, near.end, v, radius, step, self.grazing))
            });
        let discs = view.discs.iter().enumerate().map(|(index, near)| {
            let body = AvoidanceNeighbour { outline: near.outline, ..AvoidanceNeighbour::resting(near.offset, 0.0) };
            let (distance, away) = body.separation();
            let radii = radius + near.disc.radius as f32;
            (Cause::Disc(index), of_disc(away * -distance.max(0.0), v, radii, step, self.grazing))
        });
        let first = edges.chain(discs).reduce(|a, b| if b.1.0 > a.1.0 { b } else { a })?;
        let (cause, (rate, by_velocity)) = first;
        let (energy, by_rate) = self.at_rate(rate);
        Some((cause, add((energy, by_velocity * by_rate), self.at_walls(view, v))))
    }

    /// Returns the repulsion at contact by the nearest wall that the agent approaches.
    fn at_walls(&self, view: &AvoidanceInput<'_>, v: Vec2) -> Energy {
        let approached = view.walls().filter(|(_, _, away)| v.dot(*away) < 0.0);
        let gaps = approached.map(|(_, distance, away)| (distance - view.radius + v.dot(away) * view.step, away));
        let nearest = gaps.reduce(|a, b| if b.0 < a.0 { b } else { a });
        nearest.map_or((0.0, Vec2::ZERO), |(gap, away)| self.at_gap(gap, -away * view.step, view.radius))
    }

    /// Returns the energy at a gap. `closing` is the negative gradient of the gap with respect to the velocity.
    fn at_gap(&self, gap: f32, closing: Vec2, radii: f32) -> Energy {
        let least = LEAST_GAP * radii;
        let reached = gap.max(least);
        let slope = self.contact / (reached * reached);
        (self.contact / reached + slope * (reached - gap), closing * slope)
    }

    /// Returns the energy at an inverse time to collision, and its derivative with respect to the inverse time.
    fn at_rate(&self, rate: f32) -> (f32, f32) {
        let reached = rate.min(MOST_IMMINENT);
        let screened = 1.0 / (reached * self.time_horizon);
        // beyond 20 horizons the energy is negligible
        if reached <= 0.0 || screened > 20.0 {
            return (0.0, 0.0);
        }
        let part = self.strength * libm::expf(-screened) * reached * reached;
        let slope = part * (screened + 2.0 - screened / ((screened + 3.0) * (screened + 3.0)));
        (part * reached * (screened + 2.0) / (screened + 3.0) + slope * (rate - reached), slope)
    }
}

fn add(a: Energy, b: Energy) -> Energy {
    (a.0 + b.0, a.1 + b.1)
}
