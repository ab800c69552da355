//! Who belongs to the neighbourhood that an agent flocks with.

use crate::Error;
use crate::steer::{Neighbour, Reason, View, Who, Why};
use std::f32::consts::PI;

/// Whom a behaviour takes into account: those near enough and ahead enough, or the nearest few.
///
/// Metric (Reynolds 1987 and 1999; OpenSteer's inBoidNeighborhood): a distance and an angle. Topological (Ballerini et al.,
/// PNAS 105, 2008): the six or seven nearest, however far; flocks then do not break when they are stretched.
///
/// ```
/// use throng::steer::Neighbourhood;
/// let starling = Neighbourhood { most: 7, ..Neighbourhood::default() };
/// let opensteer = Neighbourhood { distance: 5.0, angle: 2.36, always: 3.0, ..Neighbourhood::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbourhood {
    /// How far it reaches, metres between centres; infinite for as far as the agent sees. Limit: > 0.
    pub distance: f32,
    /// How far to either side of ahead, radians; pi for all round. Limit: 0 to pi.
    pub angle: f32,
    /// Within so many times its own radius everybody belongs to it, at any angle. Limit: >= 0.
    pub always: f32,
    /// How many at most, the nearest. Limit: >= 1.
    pub most: usize,
    /// Who at all.
    pub who: Who,
}

impl Default for Neighbourhood {
    fn default() -> Self {
        Self { distance: f32::INFINITY, angle: PI, always: 0.0, most: usize::MAX, who: Who::Anybody }
    }
}

impl Neighbourhood {
    /// Those who belong to it, nearest first.
    pub fn of<'v, 'a>(&'v self, view: &'v View<'a>) -> impl Iterator<Item = &'a Neighbour> + 'v {
        let (sight, most) = (self.sight(view.radius), self.most);
        let belongs = move |other: &&Neighbour| {
            let ahead = view.forward().dot(other.offset);
            self.who.counts(view, other) && sight.reaches(other.offset.length_squared(), ahead)
        };
        view.neighbours.iter().filter(belongs).take(most)
    }

    /// What one of this radius sees of it.
    pub(super) fn sight(&self, radius: f32) -> Sight {
        let cosine = libm::cosf(self.angle);
        let always = self.always * radius;
        Sight {
            range_squared: self.distance * self.distance,
            always_squared: always * always,
            cosine: if self.angle < PI { cosine * cosine.abs() } else { -2.0 },
        }
    }

    /// Tells who belongs to it.
    pub(super) fn tell(&self, view: &View<'_>, why: &mut Why<'_>) {
        if why.is_asked() {
            why.note(|| Reason::Looks { distance: self.distance, angle: self.angle });
            self.of(view).for_each(|other| why.note(|| Reason::Regards(other.number)));
        }
    }

    /// What is wrong with the numbers, if anything is.
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

/// Whom a neighbourhood reaches, as squares: so it takes no root.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight {
    /// Square of its distance.
    pub range_squared: f32,
    /// Square of the distance within which everybody belongs to it.
    pub always_squared: f32,
    /// Square of the cosine of its angle, with the sign of the cosine.
    pub cosine: f32,
}

impl Sight {
    /// Whether it reaches somebody so far off, squared, and so far ahead.
    fn reaches(&self, distance_squared: f32, ahead: f32) -> bool {
        let in_sight = distance_squared <= self.range_squared && ahead * ahead.abs() >= self.cosine * distance_squared;
        distance_squared < self.always_squared || in_sight
    }
}
