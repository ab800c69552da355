//! Painted fields.

use super::sketch::SPEED;
use super::{At, Made, Make};
use crate::build::limits::{Limit, check};
use crate::file::Problem;
use crate::scene::flow::Paint;
use std::sync::Arc;
use throng::field::{Brush, Uniform};

/// Width of the cells, metres, where nothing is said.
pub(super) const CELL: f64 = 0.5;

impl Make for Paint {
    fn make(&self, at: &At) -> Result<Made, Problem> {
        let corners = at.corners(self.min, self.max)?;
        let mut made = match &self.on {
            Some(flow) => at.key("on").make(flow)?,
            None => Made::of(Uniform(glam::Vec3::ZERO)),
        };
        let mut field = at.sampled(&*made.field, corners, Some(self.cell.unwrap_or(CELL)))?;
        for (i, stroke) in self.strokes.iter().enumerate() {
            let at = at.key("strokes").index(i);
            let brush = brush(stroke.radius, stroke.strength, stroke.hardness);
            let (points, speed) = (at.places("points", &stroke.points)?, stroke.speed.unwrap_or(SPEED));
            check(&at.path.key("speed"), speed, Limit::Between(-1000.0, 1000.0))?;
            let painted = match stroke.erase {
                Some(true) => field.rub_out(&brush, &points),
                Some(false) | None => field.paint(&brush, &points, speed),
            };
            painted.map_err(|error| at.refused(&error))?;
        }
        made.field = Arc::new(field);
        Ok(made)
    }
}

/// A brush: as said, or the library's own.
pub(super) fn brush(radius: Option<f64>, strength: Option<f64>, hardness: Option<f64>) -> Brush {
    let standard = Brush::default();
    Brush {
        radius: radius.unwrap_or(standard.radius),
        strength: strength.unwrap_or(standard.strength),
        hardness: hardness.unwrap_or(standard.hardness),
    }
}
