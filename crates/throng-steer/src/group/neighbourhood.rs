//! The neighbourhood of an agent in a flock.

use std::f32::consts::PI;
use throng::parameters::{Angle, parameters};
use throng::steer::{GroupFilter, SteeringInput, SteeringNeighbour, SteeringReason, TraceRecorder};

/// The neighbours that a behaviour takes into account, of those that the agent's neighbour search finds.
///
/// The agents within a range and an angle, or the nearest few. Metric (Reynolds 1987 and 1999; OpenSteer's inBoidNeighborhood): a distance and an angle. Topological (Ballerini et
/// al., PNAS 105, 2008): the six or seven nearest, at any distance; such flocks do not break when they are stretched.
///
/// ```
/// use throng::parameters::Angle;
/// use throng_steer::Neighbourhood;
/// let starling = Neighbourhood { most: 7, ..Neighbourhood::default() };
/// let angle = Angle::degrees(135.0);
/// let opensteer = Neighbourhood { distance: 5.0, angle, always: 3.0, ..Neighbourhood::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbourhood {
    /// Reach, metres between centres. Without it, that of the neighbour search.
    #[parameter(default = f32::INFINITY, unit = "m", above = 0, infinite)]
    pub distance: f32,
    /// Half the angle of view, degrees from straight ahead; 180: all round.
    #[parameter(default = ALL_ROUND, unit = "°", least = 0, most = 180)]
    pub angle: Angle,
    /// Within this many of its own radii all neighbours count, at any angle.
    #[parameter(least = 0)]
    pub always: f32,
    /// Greatest number of neighbours, the nearest first. Without it, all.
    #[parameter(default = usize::MAX, least = 1)]
    pub most: usize,
    /// The agents that count.
    pub groups: GroupFilter,
}

/// Half the angle of view of an agent that sees all round.
const ALL_ROUND: Angle = Angle::from_radians(PI);

impl Neighbourhood {
    /// Returns the neighbours that belong to it, nearest first.
    pub fn of<'v, 'a>(&'v self, view: &'v SteeringInput<'a>) -> impl Iterator<Item = &'a SteeringNeighbour> + 'v {
        let (sight, most) = (self.sight(view.radius), self.most);
        let belongs = move |other: &&SteeringNeighbour| {
            let ahead = view.forward().dot(other.offset);
            self.groups.counts(view, other) && sight.reaches(other.offset.length_squared(), ahead)
        };
        view.neighbours.iter().filter(belongs).take(most)
    }

    /// Returns the bounds for an agent with this radius.
    pub(super) fn sight(&self, radius: f32) -> SquaredBounds {
        let always = self.always * radius;
        let squared = |cosine: f32| cosine * cosine.abs();
        SquaredBounds {
            range_squared: self.distance * self.distance,
            always_squared: always * always,
            cosine: if self.angle < ALL_ROUND { squared(libm::cosf(self.angle.radians())) } else { -2.0 },
        }
    }

    /// Records the neighbourhood and the neighbours that belong to it.
    pub(super) fn tell(&self, view: &SteeringInput<'_>, why: &mut TraceRecorder<'_>) {
        if why.is_requested() {
            why.note(|| SteeringReason::Looks { distance: self.distance, angle: self.angle.radians() });
            self.of(view).for_each(|other| why.note(|| SteeringReason::Regards(other.number)));
        }
    }
}

/// The bounds of a neighbourhood, squared, so that no square root is needed.
#[derive(Clone, Copy, Debug)]
pub(super) struct SquaredBounds {
    /// Square of the range.
    pub range_squared: f32,
    /// Square of the distance within which all agents belong to it.
    pub always_squared: f32,
    /// Square of the cosine of the angle, with the sign of the cosine.
    pub cosine: f32,
}

impl SquaredBounds {
    /// Whether a neighbour is within the bounds, by the square of its distance and its distance ahead.
    fn reaches(&self, distance_squared: f32, ahead: f32) -> bool {
        let in_sight = distance_squared <= self.range_squared && ahead * ahead.abs() >= self.cosine * distance_squared;
        distance_squared < self.always_squared || in_sight
    }
}
