//! Figures of lines, areas and people, by name.

use super::{Crossing, Figures, Inside, Line, flow, steady_flow};
use crate::Cell;

impl Line {
    /// Returns the figures of the crossings of the line, by name: metres, seconds, people a second, and people a second
    /// and metre. `steady_` flows leave out the first and the last twentieth of the crossings.
    ///
    /// ```
    /// use throng_record::{Cell, pedestrian::Line};
    /// let line = Line { from: glam::DVec2::ZERO, to: glam::DVec2::X };
    /// assert_eq!(line.cells(&[])[1], ("crossed", Cell::Whole(0)));
    /// ```
    pub fn cells(&self, crossings: &[Crossing]) -> [(&'static str, Cell); 9] {
        let time = |crossing: Option<&Crossing>| crossing.map_or(f64::NAN, |crossing| crossing.time);
        [
            ("length", self.length().into()),
            ("crossed", crossings.len().into()),
            ("leftwards", crossings.iter().filter(|crossing| crossing.leftwards).count().into()),
            ("first", time(crossings.first()).into()),
            ("last", time(crossings.last()).into()),
            ("flow", flow(crossings).into()),
            ("steady_flow", steady_flow(crossings).into()),
            ("specific_flow", (flow(crossings) / self.length()).into()),
            ("steady_specific_flow", (steady_flow(crossings) / self.length()).into()),
        ]
    }
}

impl Inside {
    /// Returns the means of the figures of an area over all times at which they are known, by name: people a square
    /// metre, and m/s.
    pub fn cells(of: &[Self]) -> [(&'static str, Cell); 4] {
        [
            ("density", Self::mean(of, |at| at.density).into()),
            ("speed", Self::mean(of, |at| at.speed).into()),
            ("voronoi_density", Self::mean(of, |at| at.voronoi_density).into()),
            ("voronoi_speed", Self::mean(of, |at| at.voronoi_speed).into()),
        ]
    }
}

impl Figures {
    /// Returns the contacts and the lanes of the people, by name.
    pub fn cells(&self) -> [(&'static str, Cell); 7] {
        [
            ("nearest", self.contacts.least.into()),
            ("separation", self.contacts.separation.into()),
            ("collisions", self.contacts.collisions.into()),
            ("near_misses", self.contacts.near_misses.into()),
            ("time_to_collision", self.contacts.least_time.into()),
            ("lane_order", self.mean(|at| at.lane_order).into()),
            ("steady_lane_order", self.steady_lane_order().into()),
        ]
    }
}
