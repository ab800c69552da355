//! Flocking: Reynolds, Steering behaviors for autonomous characters, GDC 1999; OpenSteer's Boids demo.

use super::{Alignment, Cohesion, Falloff, Neighbourhood, Separation, flocking_simd};
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, FlockBatch, GroupFilter, SteeringInput, TraceRecorder};

/// One of the three rules of a flock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Force, as a part of the vehicle's top force. Limit: >= 0.
    pub weight: f32,
    /// Range, metres. Limit: > 0.
    pub distance: f32,
    /// Angle to either side of the forward direction, radians. Limit: 0 to pi.
    pub angle: f32,
}

/// Separation, alignment and cohesion together, by nine numbers. The defaults are those of OpenSteer's boids, which
/// have a top speed of 9 m/s, a top force of 27 N and a radius of 0.5 m.
///
/// As in OpenSteer each rule has its full force however small the correction is. For a gradual force use a
/// [`WeightedSum`](crate::WeightedSum) of [`Separation`], [`Alignment`] and [`Cohesion`].
///
/// ```
/// use throng_steer::{Flocking, Rule};
/// let flocking = Flocking::default();
/// let close = Flocking { cohesion: Rule { weight: 0.6, ..flocking.cohesion }, ..flocking };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flocking {
    /// Away from the neighbours.
    pub separation: Rule,
    /// To the mean forward direction of the neighbours.
    pub alignment: Rule,
    /// To the mean position of the neighbours.
    pub cohesion: Rule,
    /// A neighbour within this multiple of the agent's radius counts at any angle. Limit: >= 0.
    pub always: f32,
    /// The agents of the flock.
    pub groups: GroupFilter,
}

impl Default for Flocking {
    fn default() -> Self {
        Self {
            separation: Rule { weight: 12.0 / 27.0, distance: 5.0, angle: 2.356 },
            alignment: Rule { weight: 8.0 / 27.0, distance: 7.5, angle: 0.795 },
            cohesion: Rule { weight: 8.0 / 27.0, distance: 9.0, angle: 1.721 },
            always: 3.0,
            groups: GroupFilter::OwnGroup,
        }
    }
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
        let sum =
            part(&self.separation, separation) + part(&self.alignment, alignment) + part(&self.cohesion, cohesion);
        Some(sum.into())
    }

    fn is_flock(&self) -> bool {
        true
    }

    fn steer_flock(&self, batch: &mut FlockBatch<'_>) {
        flocking_simd::steer(self, batch);
    }

    fn check(&self) -> Result<(), Error> {
        for rule in [self.separation, self.alignment, self.cohesion] {
            Error::unless(rule.weight >= 0.0, "weight", rule.weight, "0 or more")?;
        }
        self.near().iter().try_for_each(Neighbourhood::check)
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
