//! Measurement areas, and how many are in them.

use super::people::{Moment, People};
use super::speed::Velocities;
use glam::DVec2;

/// A polygon without holes in which is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    corners: Vec<DVec2>,
}

impl Area {
    /// A polygon by its corners, either way round, metres; `None` for one that encloses nothing.
    pub fn new(mut corners: Vec<DVec2>) -> Option<Self> {
        let signed = signed_area(&corners);
        if signed < 0.0 {
            corners.reverse();
        }
        (signed.abs() > 1e-12 && signed.is_finite()).then_some(Self { corners })
    }

    /// A rectangle by its lower left corner, width and height, metres; `None` for one that encloses nothing.
    pub fn rectangle([x, y, width, height]: [f64; 4]) -> Option<Self> {
        let corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)];
        Self::new(corners.map(DVec2::from).to_vec())
    }

    /// Its corners, counter-clockwise.
    pub fn corners(&self) -> &[DVec2] {
        &self.corners
    }

    /// How large it is, m².
    pub fn size(&self) -> f64 {
        signed_area(&self.corners)
    }

    /// Whether a place is in it.
    pub fn contains(&self, place: DVec2) -> bool {
        winds(&self.corners, place)
    }

    /// Classic density: how many are in it over its size, 1/m².
    ///
    /// ```
    /// use throng_record::pedestrian::Area;
    /// let area = Area::rectangle([0.0, 0.0, 4.0, 2.0]).unwrap();
    /// assert_eq!((area.size(), area.contains(glam::DVec2::ONE)), (8.0, true));
    /// ```
    pub fn density(&self, people: &People, moment: &Moment) -> f64 {
        moment.here.iter().filter(|&&here| self.contains(people.place(here))).count() as f64 / self.size()
    }

    /// Mean speed of those who are in it and have one, m/s; not a number for none.
    pub fn speed(&self, people: &People, moment: &Moment, velocities: &Velocities) -> f64 {
        let inside = moment.here.iter().filter(|&&here| self.contains(people.place(here)));
        let speeds = inside.filter_map(|&here| velocities.at(here)).map(DVec2::length);
        let (sum, count) = speeds.fold((0.0, 0u32), |(sum, count), speed| (sum + speed, count + 1));
        sum / f64::from(count)
    }
}

/// The area of a polygon, positive for one whose corners run counter-clockwise.
pub fn signed_area(corners: &[DVec2]) -> f64 {
    let Some(&origin) = corners.first() else { return 0.0 };
    let next = corners.iter().cycle().skip(1);
    0.5 * corners.iter().zip(next).map(|(a, b)| (a - origin).perp_dot(b - origin)).sum::<f64>()
}

/// Whether a place is in a polygon, by counting the sides that a ray from it crosses.
pub fn winds(corners: &[DVec2], place: DVec2) -> bool {
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let crossed = sides.filter(|(a, b)| {
        let spans = (a.y > place.y) != (b.y > place.y);
        spans && place.x < a.x + (place.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}
