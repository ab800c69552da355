//! Explore: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Wander".

use glam::{USizeVec3, Vec3};
use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, TraceRecorder};

/// Sweeps a region: goes to the place that it has visited least.
///
/// The region is divided into cells. The behaviour remembers for how many seconds the agent was in each cell. It seeks
/// the least visited cell, the nearest of several, and gives up a cell that it does not reach in four times the
/// expected time.
///
/// ```
/// use glam::{USizeVec3, Vec3};
/// use throng::steer::Behaviour;
/// use throng_steer::Explore;
/// let search = Explore { low: Vec3::ZERO, high: Vec3::new(40.0, 20.0, 0.0), cells: USizeVec3::new(8, 4, 1) };
/// assert_eq!(search.memory(), 34);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Explore {
    /// The corner of the region with the least coordinates, metres.
    pub low: Vec3,
    /// The corner with the greatest coordinates, metres. Limit: not below the least.
    pub high: Vec3,
    /// Number of cells along each axis. Limit: 1 to 4096 cells in all.
    pub cells: USizeVec3,
}

/// Factor on the time at the top speed after which a cell is given up.
const PATIENCE: f32 = 4.0;

impl Behaviour for Explore {
    /// The cell that is sought, counted from 1; the seconds until it is given up; the seconds in each cell.
    fn memory(&self) -> usize {
        2 + self.cells.element_product()
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
        let size = (self.high - self.low).min_element();
        Error::unless(size >= 0.0 && size.is_finite(), "size of the region to explore", size, "0 or more and finite")?;
        let cells = self.cells.element_product();
        Error::unless((1..=4096).contains(&cells), "cells to explore", cells as f64, "from 1 to 4096")
    }
}

impl Explore {
    /// Returns the cell of a place; the nearest cell if the place is outside.
    fn cell(&self, place: Vec3) -> usize {
        let part = (place - self.low) / (self.high - self.low).max(Vec3::splat(f32::MIN_POSITIVE));
        let at = (part * self.cells.as_vec3()).max(Vec3::ZERO).as_usizevec3().min(self.cells - 1);
        (at.z * self.cells.y + at.y) * self.cells.x + at.x
    }

    fn center(&self, cell: usize) -> Vec3 {
        let (x, rest) = (cell % self.cells.x, cell / self.cells.x);
        let at = USizeVec3::new(x, rest % self.cells.y, rest / self.cells.y);
        self.low + (self.high - self.low) * (at.as_vec3() + 0.5) / self.cells.as_vec3()
    }
}
