//! Measurement areas, and the pedestrians in them.

use super::people::{People, PeopleMoment};
use super::speed::Velocities;
use glam::DVec2;

/// A polygon without holes, in which figures are measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    corners: Vec<DVec2>,
}

impl Area {
    /// Creates a polygon from its corners, in either order, metres; `None` if it has no area.
    pub fn new(mut corners: Vec<DVec2>) -> Option<Self> {
        let signed = signed_area(&corners);
        if signed < 0.0 {
            corners.reverse();
        }
        (signed.abs() > 1e-12 && signed.is_finite()).then_some(Self { corners })
    }

    /// Creates a rectangle from its lower left corner, width and height, metres; `None` if it has no area.
    pub fn rectangle([x, y, width, height]: [f64; 4]) -> Option<Self> {
        let corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)];
        Self::new(corners.map(DVec2::from).to_vec())
    }

    /// Returns the corners, counter-clockwise.
    pub fn corners(&self) -> &[DVec2] {
        &self.corners
    }

    /// Returns the area, m².
    pub fn size(&self) -> f64 {
        signed_area(&self.corners)
    }

    /// Whether a point is inside.
    pub fn contains(&self, place: DVec2) -> bool {
        winds(&self.corners, place)
    }

    /// Returns the classic density: the number of pedestrians inside over the area, 1/m².
    ///
    /// ```
    /// use throng_record::pedestrian::Area;
    /// let area = Area::rectangle([0.0, 0.0, 4.0, 2.0]).unwrap();
    /// assert_eq!((area.size(), area.contains(glam::DVec2::ONE)), (8.0, true));
    /// ```
    pub fn density(&self, people: &People, moment: &PeopleMoment) -> f64 {
        moment.here.iter().filter(|&&here| self.contains(people.place(here))).count() as f64 / self.size()
    }

    /// Returns the mean speed of the pedestrians inside with a known velocity, m/s; NaN if there are none.
    pub fn speed(&self, people: &People, moment: &PeopleMoment, velocities: &Velocities) -> f64 {
        let inside = moment.here.iter().filter(|&&here| self.contains(people.place(here)));
        let speeds = inside.filter_map(|&here| velocities.at(here)).map(DVec2::length);
        let (sum, count) = speeds.fold((0.0, 0u32), |(sum, count), speed| (sum + speed, count + 1));
        sum / f64::from(count)
    }
}

/// Returns the area of a polygon, positive for counter-clockwise corners.
pub fn signed_area(corners: &[DVec2]) -> f64 {
    let Some(&origin) = corners.first() else { return 0.0 };
    let next = corners.iter().cycle().skip(1);
    0.5 * corners.iter().zip(next).map(|(a, b)| (a - origin).perp_dot(b - origin)).sum::<f64>()
}

/// Whether a point is in a polygon, by counting the sides that a ray from the point crosses.
pub fn winds(corners: &[DVec2], place: DVec2) -> bool {
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let crossed = sides.filter(|(a, b)| {
        let spans = (a.y > place.y) != (b.y > place.y);
        spans && place.x < a.x + (place.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}
