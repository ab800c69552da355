//! SIMD version of [`step`](super::step) for many vehicles of the same kind, with the same bits.

use super::step::{CURVATURE_TIME, GRAVITY, REST, ROLL_TIME};
use super::{Attitude, Forces, Integrator, Locomotion, Vehicle, part_in};
use crate::simd::{LANES, Vec3s, WORDS, load_records, store_records};
use fearless_simd::prelude::*;
use glam::Vec3;

/// The motions of a SIMD vector of vehicles.
#[derive(Clone, Copy)]
pub(crate) struct Motions<S: Simd> {
    pub position: Vec3s<S>,
    pub velocity: Vec3s<S>,
    pub attitude: Attitudes<S>,
}

/// The attitudes of a SIMD vector of vehicles.
#[derive(Clone, Copy)]
pub(crate) struct Attitudes<S: Simd> {
    pub forward: Vec3s<S>,
    side: Vec3s<S>,
    up: Vec3s<S>,
    acceleration: Vec3s<S>,
    curvature: Vec3s<S>,
}

impl<S: Simd> Attitudes<S> {
    /// Loads at most one SIMD vector of attitudes and fills the remaining elements with zeros.
    #[inline(always)]
    pub fn load(simd: S, all: impl Iterator<Item = Attitude>) -> Self {
        let mut records = [[0.0; WORDS]; LANES];
        records.iter_mut().zip(all).for_each(|(record, attitude)| *record = attitude.record());
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, _] = load_records(simd, &records);
        Self {
            forward: Vec3s { x: a, y: b, z: c },
            side: Vec3s { x: d, y: e, z: f },
            up: Vec3s { x: g, y: h, z: i },
            acceleration: Vec3s { x: j, y: k, z: l },
            curvature: Vec3s { x: m, y: n, z: o },
        }
    }

    /// Stores as many attitudes as `all` holds.
    #[inline(always)]
    pub fn store(&self, simd: S, all: &mut [Attitude]) {
        let Self { forward, side, up, acceleration, curvature } = *self;
        let mut words = [forward.x; WORDS];
        for (at, v) in [forward, side, up, acceleration, curvature].into_iter().enumerate() {
            (words[3 * at], words[3 * at + 1], words[3 * at + 2]) = (v.x, v.y, v.z);
        }
        let mut records = [[0.0; WORDS]; LANES];
        store_records(simd, words, &mut records);
        all.iter_mut().zip(&records).for_each(|(attitude, record)| *attitude = Attitude::of_record(record));
    }
}

/// A step of vehicles of one kind that the SIMD version supports.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stepping {
    vehicle: Vehicle,
    seconds: f32,
    urgency: f32,
    smoothing: f32,
    roll: f32,
    bend: f32,
}

impl Stepping {
    /// Returns the step of `seconds`, or `None` for vehicles with limits of turning or of forces along single axes.
    pub fn of(vehicle: &Vehicle, seconds: f32) -> Option<Self> {
        let plain = vehicle.low_speed == 0.0
            && vehicle.max_turn_rate.radians().is_infinite()
            && vehicle.forces == Forces::default();
        plain.then(|| Self {
            vehicle: *vehicle,
            seconds,
            urgency: vehicle.urgency(seconds),
            smoothing: part_in(seconds, vehicle.smoothing),
            roll: part_in(seconds, ROLL_TIME),
            bend: part_in(seconds, CURVATURE_TIME),
        })
    }

    /// SIMD version of [`Vehicle::step`] for vehicles that face their direction of motion.
    #[inline(always)]
    pub fn step<S: Simd>(&self, simd: S, before: &Motions<S>, force: Vec3s<S>) -> Motions<S> {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let (vehicle, seconds) = (&self.vehicle, splat(self.seconds));
        let ground = vehicle.locomotion == Locomotion::Ground;
        let flat = |v: Vec3s<S>| if ground { Vec3s { z: splat(0.0), ..v } } else { v };
        let force = self.circling(simd, before, flat(force)).clamp_length_max(splat(vehicle.max_force));
        let acceleration = force.over(splat(vehicle.mass));
        let acceleration = before.attitude.acceleration.lerp(simd, acceleration, self.smoothing);
        let chosen = flat(before.velocity + acceleration * seconds).clamp_length_max(splat(vehicle.max_speed));
        let (has_direction, direction) = chosen.try_normalize(simd);
        let moves = chosen.length().simd_gt(splat(REST * vehicle.max_speed)) & has_direction;
        let forward = Vec3s::select(moves, direction, before.attitude.forward);
        let velocity = if vehicle.min_speed > 0.0 {
            let least = splat(vehicle.min_speed);
            let slow = Vec3s::select(has_direction, direction, forward) * least;
            Vec3s::select(chosen.length().simd_lt(least), slow, chosen)
        } else {
            chosen
        };
        let moved = match vehicle.integrator {
            Integrator::SemiImplicit => velocity,
            Integrator::Euler => before.velocity,
        };
        let position = before.position + moved * seconds;
        let (side, up) = self.basis(simd, &before.attitude, forward, acceleration);
        let after =
            Motions { position, velocity, attitude: Attitudes { forward, side, up, acceleration, ..before.attitude } };
        let curvature = self.curvature(simd, before, &after);
        Motions { attitude: Attitudes { curvature, ..after.attitude }, ..after }
    }

    /// SIMD version of [`circling`](super::limit).
    #[inline(always)]
    fn circling<S: Simd>(&self, simd: S, before: &Motions<S>, force: Vec3s<S>) -> Vec3s<S> {
        let vehicle = &self.vehicle;
        if vehicle.min_speed == 0.0 {
            return force;
        }
        let splat = |value: f32| S::f32s::splat(simd, value);
        let (zero, forward) = (splat(0.0), before.attitude.forward);
        let least = (splat(vehicle.min_speed) - before.velocity.dot(forward)).min(zero) * splat(vehicle.mass)
            / splat(self.seconds);
        let leads_to = before.velocity + force.over(splat(self.urgency));
        let circles = force.dot(forward).simd_lt(least) & leads_to.dot(forward).simd_lt(zero);
        if !circles.any_true() {
            return force;
        }
        let most = force.clamp_length_max(splat(vehicle.max_force));
        let (some, aside) = most.reject_from_normalized(forward).try_normalize(simd);
        let aside = Vec3s::select(some, aside, before.attitude.side);
        let part = (most.dot(most) - least * least).max(zero).sqrt();
        Vec3s::select(circles, forward * least + aside * part, force)
    }

    /// Returns the side and up vectors after the step.
    #[inline(always)]
    fn basis<S: Simd>(
        &self,
        simd: S,
        before: &Attitudes<S>,
        forward: Vec3s<S>,
        acceleration: Vec3s<S>,
    ) -> (Vec3s<S>, Vec3s<S>) {
        let upright = Vec3s::splat(simd, Vec3::Z);
        let nothing = Vec3s::splat(simd, Vec3::ZERO);
        let to = match self.vehicle.locomotion {
            Locomotion::Ground => return (turned_to(simd, before, forward, upright).0, upright),
            Locomotion::Level => upright,
            Locomotion::Banking => {
                let lean = acceleration.reject_from_normalized(forward).over(S::f32s::splat(simd, GRAVITY)) + upright;
                let (some, lean) = lean.try_normalize(simd);
                Vec3s::select(some, lean, nothing)
            }
        };
        turned_to(simd, before, forward, before.up.lerp(simd, to, self.roll))
    }

    /// Returns the curvature after the step.
    #[inline(always)]
    fn curvature<S: Simd>(&self, simd: S, before: &Motions<S>, after: &Motions<S>) -> Vec3s<S> {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let length = (after.position - before.position).length();
        let (set_out, from) = before.velocity.try_normalize(simd);
        let (goes, to) = after.velocity.try_normalize(simd);
        let both = splat(1.0) + from.dot(to);
        let bends = set_out & goes & both.simd_ge(splat(1e-3)) & !length.simd_eq(splat(0.0));
        let curvature = before.attitude.curvature;
        let carried = curvature - (from + to) * (curvature.dot(to) / both);
        let bent = carried.lerp(simd, (to - from).reject_from_normalized(to).over(length), self.bend);
        Vec3s::select(bends, bent, Vec3s::splat(simd, Vec3::ZERO))
    }
}

/// SIMD version of [`Basis::turned_to`]: returns the side and up vectors.
#[inline(always)]
fn turned_to<S: Simd>(simd: S, before: &Attitudes<S>, forward: Vec3s<S>, up: Vec3s<S>) -> (Vec3s<S>, Vec3s<S>) {
    let splat = |value: f32| S::f32s::splat(simd, value);
    let least = splat(1e-6) * up.dot(up);
    let across = up.cross(forward);
    let tells = across.dot(across).simd_gt(least);
    let side = Vec3s::select(tells, across, before.side.reject_from_normalized(forward));
    let (some, side) = side.try_normalize(simd);
    // as `Vec3::any_orthonormal_vector`
    let sign = splat(1.0).copysign(forward.z);
    let a = splat(-1.0) / (sign + forward.z);
    let any = Vec3s { x: forward.x * forward.y * a, y: sign + forward.y * forward.y * a, z: -forward.y };
    let side = Vec3s::select(some, side, any);
    (side, forward.cross(side))
}
