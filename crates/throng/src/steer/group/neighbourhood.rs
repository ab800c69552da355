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
        let cosine = if self.angle < PI { libm::cosf(self.angle) } else { -2.0 };
        let belongs = move |other: &&Neighbour| {
            let distance = other.offset.length();
            let in_sight = || distance <= self.distance && view.forward().dot(other.offset) > cosine * distance;
            self.who.counts(view, other) && (distance < self.always * view.radius || in_sight())
        };
        view.neighbours.iter().filter(belongs).take(self.most)
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
