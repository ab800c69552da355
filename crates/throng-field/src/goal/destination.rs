//! The goals of a flow.

use super::cover;
use super::terrain::{TOUCH, Terrain};
use glam::DVec2;
use throng::Error;
use throng::space::{check_polygon, is_inside, nearest_on_outline};

/// A goal of a flow. Metres, from the origin.
#[derive(Clone, Debug, PartialEq)]
pub enum Destination {
    /// A point: the flow slows down close to it and stops there.
    Point {
        /// Position of the point.
        at: DVec2,
        /// Distance within which the point counts as reached. Limit: >= 0.
        tolerance: f64,
    },
    /// A disc. It counts as reached wherever it is entered.
    Disc {
        /// Its centre.
        center: DVec2,
        /// Its radius. Limit: > 0.
        radius: f64,
    },
    /// An area. It counts as reached wherever it is entered.
    Area {
        /// The corners of a simple polygon, in either orientation.
        corners: Vec<DVec2>,
    },
}

/// Distance from a goal, in cells, within which a front starts at its exact distance: there its curvature is too high
/// for the differences.
const BAND: f64 = 5.0;

impl Destination {
    pub(super) fn check(&self) -> Result<(), Error> {
        match self {
            Self::Point { at, tolerance } => {
                Error::unless_finite("place of a goal", at.element_sum())?;
                let holds = *tolerance >= 0.0 && tolerance.is_finite();
                Error::unless(holds, "tolerance of a goal", *tolerance, "at least 0 and finite")
            }
            Self::Disc { center, radius } => {
                Error::unless_finite("place of a goal", center.element_sum())?;
                let holds = *radius > 0.0 && radius.is_finite();
                Error::unless(holds, "radius of a goal", *radius, "greater than 0 and finite")
            }
            Self::Area { corners } => check_polygon("the area of a goal", corners),
        }
    }

    /// Returns the point of the goal that is nearest to `p`; `p` itself if it is in the goal.
    pub(super) fn nearest(&self, p: DVec2) -> DVec2 {
        match self {
            Self::Point { at, .. } => *at,
            Self::Disc { center, radius } => *center + (p - center).clamp_length_max(*radius),
            Self::Area { corners } if is_inside(corners, p) => p,
            Self::Area { corners } => nearest_on_outline(corners, p),
        }
    }

    /// Returns a place in or at the goal, for messages.
    pub(super) fn place(&self) -> DVec2 {
        match self {
            Self::Point { at, .. } => *at,
            Self::Disc { center, .. } => *center,
            Self::Area { corners } => corners.first().copied().unwrap_or_default(),
        }
    }

    /// Returns the bounding box of the goal.
    fn bounds(&self) -> (DVec2, DVec2) {
        match self {
            Self::Point { at, .. } => (*at, *at),
            Self::Disc { center, radius } => (*center - *radius, *center + *radius),
            Self::Area { corners } => {
                corners.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), corner| {
                    (low.min(*corner), high.max(*corner))
                })
            }
        }
    }

    /// Adds the open cells of a terrain from which fronts start, each with the nearest point of the goal: the cells in
    /// the goal, and the cells close to it with a free line to it.
    pub(super) fn starts(&self, terrain: &Terrain, starts: &mut Vec<(u32, DVec2)>) {
        let cell = terrain.cell();
        let band = BAND * cell;
        let mut inside = Vec::new();
        let ground = (terrain.low + 0.5 * cell, &terrain.lattice);
        match self {
            Self::Point { .. } => {}
            Self::Disc { center, radius } => cover::disc((*center, *radius), ground, |cell| inside.push(cell)),
            Self::Area { corners } => cover::fill(corners, ground, |cell| inside.push(cell)),
        }
        inside.sort_unstable();
        let (low, high) = self.bounds();
        cover::within((low - band, high + band), ground, |node| {
            if !terrain.is_open(node) {
                return;
            }
            let place = terrain.middle(node);
            if inside.binary_search(&node).is_ok() {
                starts.push((node as u32, place));
                return;
            }
            let nearest = self.nearest(place);
            let close = nearest.distance_squared(place) <= band * band && terrain.cell_at(nearest).is_some();
            if close && terrain.walls.keep_off((place, nearest), TOUCH) {
                starts.push((node as u32, nearest));
            }
        });
    }
}
