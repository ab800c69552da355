//! Fields from files of other programs.

use crate::error::{Error, Kind};
use crate::file::{Problem, read_text};
use crate::geometry::DVec2;
use crate::import::vectors::{Vectors, csv, menge};
use crate::registry::{BuildField, FieldContext};
use crate::scene::flow::Table;
use std::path::Path as File;
use std::sync::Arc;
use throng::field::Field;
use throng_field::Sampled;

impl BuildField for Table {
    fn make(&self, at: &FieldContext) -> Result<Arc<dyn Field>, Problem> {
        let path = at.path.key("file");
        let file = at.scene.folder().join(&self.file);
        let problem = |error: Error| {
            let problem = Problem::new(&path, error.kind, error.message);
            Problem { hint: error.hint, ..problem }
        };
        let text = read_text(&file).map_err(problem)?;
        let is_csv = File::new(&self.file).extension().is_some_and(|name| name.eq_ignore_ascii_case("csv"));
        let read = if is_csv { csv(&text) } else { menge(&text) };
        let shown = file.display();
        let Vectors { low, cell, columns, velocities } = read.map_err(|error| {
            let line = error.at.map_or_else(String::new, |(line, _)| format!("{line}:"));
            problem(Error { message: format!("{shown}:{line} {}", error.message), ..error })
        })?;
        let low = DVec2::from_array(low) - at.scene.origin();
        let field = Sampled::new(low, cell, columns, velocities)
            .map_err(|error| Problem::new(&path, Kind::Geometry, format!("{shown}: {error}")))?;
        Ok(Arc::new(field))
    }
}
