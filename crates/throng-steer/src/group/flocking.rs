//! Flocking: Reynolds, Steering behaviors for autonomous characters, GDC 1999; OpenSteer's Boids demo.

use super::{Alignment, Cohesion, Falloff, Neighbourhood, Separation, flocking_simd};
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Angle, Value, parameters};
use throng::steer::{Behaviour, FlockBatch, GroupFilter, SteeringInput, SteeringReason, TraceRecorder};

/// A rule of a flock.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Its force, as a part of the vehicle's greatest force.
    #[parameter(required, least = 0)]
    pub weight: f32,
    /// Reach, metres.
    #[parameter(required, unit = "m", above = 0, infinite)]
    pub distance: f32,
    /// Half the angle of view, degrees from straight ahead.
    #[parameter(required, unit = "°", least = 0, most = 180)]
    pub angle: Angle,
}

/// Separation, alignment and cohesion together (Reynolds 1999).
///
/// The defaults are those of OpenSteer's boids, which have a top speed of 9 m/s, a top force of 27 N and a radius of
/// 0.5 m. As in OpenSteer each rule has its full force however small the correction is. For a gradual force use a
/// [`WeightedSum`](crate::WeightedSum) of [`Separation`], [`Alignment`] and [`Cohesion`].
///
/// ```
/// use throng_steer::{Flocking, Rule};
/// let flocking = Flocking::default();
/// let close = Flocking { cohesion: Rule { weight: 0.6, ..flocking.cohesion }, ..flocking };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flocking {
    /// Separation. Without it, weight 0.444, 5 m, 135°.
    #[parameter(default = Rule { weight: 12.0 / 27.0, distance: 5.0, angle: Angle::from_radians(2.356) })]
    pub separation: Rule,
    /// Alignment. Without it, weight 0.296, 7.5 m, 45.6°.
    #[parameter(default = Rule { weight: 8.0 / 27.0, distance: 7.5, angle: Angle::from_radians(0.795) })]
    pub alignment: Rule,
    /// Cohesion. Without it, weight 0.296, 9 m, 98.6°.
    #[parameter(default = Rule { weight: 8.0 / 27.0, distance: 9.0, angle: Angle::from_radians(1.721) })]
    pub cohesion: Rule,
    /// Within this many of its own radii all neighbours count, at any angle.
    #[parameter(default = 3.0, least = 0)]
    pub always: f32,
    /// The agents of the flock.
    #[parameter(default = GroupFilter::OwnGroup)]
    pub groups: GroupFilter,
}

impl Behaviour for Flocking {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let [separation, alignment, cohesion] = self.near();
        let separation =
            Separation { near: separation, falloff: Falloff::Inverse, full: 0.0 }.steer(view, &mut [], why);
        let alignment = Alignment { near: alignment, full: 0.0 }.steer(view, &mut [], why);
        let cohesion = Cohesion { near: cohesion, full: 0.0 }.steer(view, &mut [], why);
        if separation.is_none() && alignment.is_none() && cohesion.is_none() {
            return None;
        }
        let part = |rule: &Rule, said: Option<Steering>| said.map_or(Vec3::ZERO, |said| said.force * rule.weight);
        let terms =
            [part(&self.separation, separation), part(&self.alignment, alignment), part(&self.cohesion, cohesion)];
        terms.iter().for_each(|&term| why.note(|| SteeringReason::Adds(term / view.vehicle.mass)));
        Some((terms[0] + terms[1] + terms[2]).into())
    }

    fn is_flock(&self) -> bool {
        true
    }

    fn steer_flock(&self, batch: &mut FlockBatch<'_>) {
        flocking_simd::steer(self, batch);
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

impl Flocking {
    /// Returns the neighbourhoods of the three rules.
    pub(super) fn near(&self) -> [Neighbourhood; 3] {
        [self.separation, self.alignment, self.cohesion].map(|Rule { distance, angle, .. }| Neighbourhood {
            distance,
            angle,
            always: self.always,
            groups: self.groups,
            ..Neighbourhood::default()
        })
    }
}
