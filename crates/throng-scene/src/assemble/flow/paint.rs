//! Painted fields.

use super::sampled::covered;
use super::sketch::SPEED;
use crate::assemble::limits::{Limit, check};
use crate::file::Problem;
use crate::registry::{BuildField, FieldContext, Flow};
use crate::scene::flow::Paint;
use glam::Vec3;
use std::sync::Arc;
use throng::field::Field;
use throng_field::{Brush, Covered, Map, Sampled, Uniform};

/// Default width of the cells, metres.
pub(super) const CELL: f64 = 0.5;

impl BuildField for Paint {
    fn make(&self, at: &FieldContext) -> Result<Arc<dyn Field>, Problem> {
        let corners = at.corners(self.min, self.max)?;
        let base = self.on.as_ref().map(|flow| at.key("on").make(flow)).transpose()?;
        let cell = self.cell.unwrap_or(CELL);
        let mut field = at.sampled(base.as_deref().unwrap_or(&Uniform(Vec3::ZERO)), corners, Some(cell))?;
        let mut cover = Map::over(corners[0], corners[1], cell).map_err(|error| at.refused(&error))?;
        for (i, stroke) in self.strokes.iter().enumerate() {
            let at = at.key("strokes").index(i);
            let brush = brush(stroke.radius, stroke.strength, stroke.hardness);
            let (points, speed) = (at.places("points", &stroke.points)?, stroke.speed.unwrap_or(SPEED));
            check(&at.path.key("speed"), speed, Limit::Between(-1000.0, 1000.0))?;
            let erases = stroke.erase.unwrap_or(false);
            let painted = if erases { field.rub_out(&brush, &points) } else { field.paint(&brush, &points, speed) };
            let covered = cover.paint(&brush, &points, if erases { 0.0 } else { 1.0 });
            painted.and(covered).map_err(|error| at.refused(&error))?;
        }
        if let Some(base) = base {
            return Ok(covered(field, &*base));
        }
        // partly covered cells guide with a lower weight, not with a lower speed
        let full =
            field.velocities().iter().zip(cover.values()).map(|(&v, &cover)| if cover > 0.0 { v / cover } else { v });
        let field = Sampled::new(field.low(), field.cell(), field.columns(), full.collect());
        let field = Arc::new(field.map_err(|error| at.refused(&error))?);
        Ok(Arc::new(Covered { field, cover: Arc::new(cover) }))
    }

    fn parts(&self) -> Vec<(&'static str, &Flow)> {
        self.on.iter().map(|on| ("on", &**on)).collect()
    }
}

/// Returns a brush with the given values, or the library's defaults.
pub(super) fn brush(radius: Option<f64>, strength: Option<f64>, hardness: Option<f64>) -> Brush {
    let standard = Brush::default();
    Brush {
        radius: radius.unwrap_or(standard.radius),
        strength: strength.unwrap_or(standard.strength),
        hardness: hardness.unwrap_or(standard.hardness),
    }
}
