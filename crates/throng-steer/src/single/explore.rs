//! Explore: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Wander".

use glam::{USizeVec3, Vec3};
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{SpacePlace, Value, parameters};
use throng::steer::{Behaviour, SteeringInput, TraceRecorder};

/// Sweeps a region (Reynolds 1999).
///
/// It goes to the place that it has visited least. The region is divided into cells. The behaviour remembers for how many seconds the agent was in each cell. It seeks
/// the least visited cell, the nearest of several, and gives up a cell that it does not reach in four times the
/// expected time.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::Behaviour;
/// use throng_steer::Explore;
/// let search = Explore { min: Vec3::ZERO, max: Vec3::new(40.0, 20.0, 0.0), columns: 8, rows: 4, levels: 1 };
/// assert_eq!(search.memory(), 34);
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Explore {
    /// The corner of the region with the least coordinates.
    #[parameter(required, from = SpacePlace, unit = "m")]
    pub min: Vec3,
    /// The corner with the greatest coordinates. Limit: not below `min`.
    #[parameter(required, from = SpacePlace, unit = "m")]
    pub max: Vec3,
    /// Number of cells along x; at most 4096 cells in all.
    #[parameter(required, least = 1, most = 4096)]
    pub columns: usize,
    /// Number of cells along y.
    #[parameter(required, least = 1, most = 4096)]
    pub rows: usize,
    /// Number of cells along z.
    #[parameter(default = 1, least = 1, most = 4096)]
    pub levels: usize,
}

/// Factor on the time at the top speed after which a cell is given up.
const PATIENCE: f32 = 4.0;

impl Behaviour for Explore {
    /// The cell that is sought, counted from 1; the seconds until it is given up; the seconds in each cell.
    fn memory(&self) -> usize {
        2 + self.cells().element_product()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let [aim, left, visits @ ..] = memory else { return None };
        let here = self.cell(view.position());
        visits[here] += view.seconds;
        *left -= view.seconds;
        if *aim == 0.0 || *aim == (here + 1) as f32 || *left < 0.0 {
            if *aim > 0.0 && *left < 0.0 {
                // counts as if the agent had been there as long as it tried
                visits[*aim as usize - 1] += PATIENCE;
            }
            let distance = |cell: usize| view.to(self.center(cell)).length();
            let others = (0..visits.len()).filter(|&cell| cell != here || visits.len() == 1);
            let next = others.min_by(|&a, &b| {
                visits[a].total_cmp(&visits[b]).then(distance(a).total_cmp(&distance(b))).then(a.cmp(&b))
            })?;
            *aim = (next + 1) as f32;
            *left = PATIENCE * (distance(next) / view.vehicle.max_speed + 1.0);
        }
        view.seek(self.center(*aim as usize - 1), why)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        let size = (self.max - self.min).min_element();
        Error::unless(size >= 0.0 && size.is_finite(), "size of the region to explore", size, "0 or more and finite")?;
        let cells = self.cells().element_product();
        Error::unless((1..=4096).contains(&cells), "cells to explore", cells as f64, "from 1 to 4096")
    }
}

impl Explore {
    /// Returns the number of cells along each axis.
    fn cells(&self) -> USizeVec3 {
        USizeVec3::new(self.columns, self.rows, self.levels)
    }

    /// Returns the cell of a place; the nearest cell if the place is outside.
    fn cell(&self, place: Vec3) -> usize {
        let cells = self.cells();
        let part = (place - self.min) / (self.max - self.min).max(Vec3::splat(f32::MIN_POSITIVE));
        let at = (part * cells.as_vec3()).max(Vec3::ZERO).as_usizevec3().min(cells - 1);
        (at.z * cells.y + at.y) * cells.x + at.x
    }

    fn center(&self, cell: usize) -> Vec3 {
        let (x, rest) = (cell % self.columns, cell / self.columns);
        let at = USizeVec3::new(x, rest % self.rows, rest / self.rows);
        self.min + (self.max - self.min) * (at.as_vec3() + 0.5) / self.cells().as_vec3()
    }
}
