//! What a flow leads to.

use super::cover;
use super::terrain::{TOUCH, Terrain};
use crate::Error;
use crate::space::{check_polygon, is_inside, nearest_on_outline};
use glam::DVec2;

/// What a flow leads to. Metres, from the world's origin.
#[derive(Clone, Debug, PartialEq)]
pub enum Destination {
    /// A point: who comes near slows down, and stops there.
    Point {
        /// Where.
        at: DVec2,
        /// Distance that counts as there. Limit: >= 0.
        tolerance: f64,
    },
    /// A disc, entered anywhere.
    Disc {
        /// Its centre.
        center: DVec2,
        /// Its radius. Limit: > 0.
        radius: f64,
    },
    /// An area, entered anywhere.
    Area {
        /// The corners of a simple polygon, either way round.
        corners: Vec<DVec2>,
    },
}

/// Cells from a goal within which a front starts at its exact distance: nearer, it is too round for the differences.
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

    /// The point of it that is nearest to another; that one itself if it is in it.
    pub(super) fn nearest(&self, p: DVec2) -> DVec2 {
        match self {
            Self::Point { at, .. } => *at,
            Self::Disc { center, radius } => *center + (p - center).clamp_length_max(*radius),
            Self::Area { corners } if is_inside(corners, p) => p,
            Self::Area { corners } => nearest_on_outline(corners, p),
        }
    }

    /// A place in or at it, for messages.
    pub(super) fn place(&self) -> DVec2 {
        match self {
            Self::Point { at, .. } => *at,
            Self::Disc { center, .. } => *center,
            Self::Area { corners } => corners.first().copied().unwrap_or_default(),
        }
    }

    /// The box round it.
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

    /// Adds the open cells of a terrain from which fronts start, each with the nearest point of the goal: those in it, and those close
    /// to it that see it.
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
