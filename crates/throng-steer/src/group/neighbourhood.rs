//! The neighbourhood of an agent in a flock.

use std::f32::consts::PI;
use throng::Error;
use throng::steer::{GroupFilter, SteeringInput, SteeringNeighbour, SteeringReason, TraceRecorder};

/// The neighbours that a behaviour takes into account: the agents within a range and an angle, or the nearest few.
///
/// Metric (Reynolds 1987 and 1999; OpenSteer's inBoidNeighborhood): a distance and an angle. Topological (Ballerini et
/// al., PNAS 105, 2008): the six or seven nearest, at any distance; such flocks do not break when they are stretched.
///
/// ```
/// use throng_steer::Neighbourhood;
/// let starling = Neighbourhood { most: 7, ..Neighbourhood::default() };
/// let opensteer = Neighbourhood { distance: 5.0, angle: 2.36, always: 3.0, ..Neighbourhood::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbourhood {
    /// Range between centres, metres; infinite for the agent's whole perception range. Limit: > 0.
    pub distance: f32,
    /// Angle to either side of the forward direction, radians; pi for all round. Limit: 0 to pi.
    pub angle: f32,
    /// A neighbour within this multiple of the agent's radius belongs to it at any angle. Limit: >= 0.
    pub always: f32,
    /// Greatest number of neighbours; the nearest count. Limit: >= 1.
    pub most: usize,
    /// The groups that count.
    pub groups: GroupFilter,
}

impl Default for Neighbourhood {
    fn default() -> Self {
        Self { distance: f32::INFINITY, angle: PI, always: 0.0, most: usize::MAX, groups: GroupFilter::All }
    }
}

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
            cosine: if self.angle < PI { squared(libm::cosf(self.angle)) } else { -2.0 },
        }
    }

    /// Records the neighbourhood and the neighbours that belong to it.
    pub(super) fn tell(&self, view: &SteeringInput<'_>, why: &mut TraceRecorder<'_>) {
        if why.is_requested() {
            why.note(|| SteeringReason::Looks { distance: self.distance, angle: self.angle });
            self.of(view).for_each(|other| why.note(|| SteeringReason::Regards(other.number)));
        }
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// [`Error::Limit`] names the number.
    pub fn check(&self) -> Result<(), Error> {
        Error::unless(self.distance > 0.0, "distance of neighbours", self.distance, "greater than 0")?;
        Error::unless((0.0..=PI).contains(&self.angle), "angle of neighbours", self.angle, "from 0 to pi")?;
        Error::unless(self.always >= 0.0, "radii that always count", self.always, "0 or more")?;
        Error::unless(self.most > 0, "number of neighbours", self.most as f64, "1 or more")
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
