//! Fields sampled on grids.

use super::sketch::{CELL, CELLS, width};
use crate::assemble::limits::{Limit, check_some};
use crate::file::Problem;
use crate::geometry::DVec2;
use crate::registry::{BuildField, FieldContext, Flow};
use crate::scene::flow::Sampled;
use std::sync::Arc;
use throng::field::Field;
use throng_field::Covered;

impl BuildField for Sampled {
    fn make(&self, at: &FieldContext) -> Result<Arc<dyn Field>, Problem> {
        let made = at.key("of").make(&self.of)?;
        let [low, high] = at.scene.bounds().map(|corner| corner.to_array());
        let corners = at.corners(self.min.unwrap_or(low), self.max.unwrap_or(high))?;
        Ok(covered(at.sampled(&*made, corners, self.cell)?, &*made))
    }

    fn parts(&self) -> Vec<(&'static str, &Flow)> {
        vec![("of", &self.of)]
    }
}

/// Returns a field with the cover of another field.
pub(super) fn covered(field: throng_field::Sampled, of: &dyn Field) -> Arc<dyn Field> {
    match of.cover() {
        Some(cover) => Arc::new(Covered { field: Arc::new(field), cover }),
        None => Arc::new(field),
    }
}

impl FieldContext<'_> {
    /// Samples a field on a grid over a box, with the given or a sufficient resolution.
    pub(super) fn sampled(
        &self,
        field: &dyn Field,
        [low, high]: [DVec2; 2],
        cell: Option<f64>,
    ) -> Result<throng_field::Sampled, Problem> {
        check_some(&self.path.key("cell"), cell, Limit::Positive)?;
        let size = (high - low).max(DVec2::splat(CELL));
        let cell = cell.unwrap_or_else(|| width([low, high], CELLS));
        throng_field::Sampled::of(field, low, low + size, cell, 0.0).map_err(|error| self.refused(&error))
    }
}
