//! Painted maps of numbers.

use super::paint::{CELL, brush};
use super::picture::{Pixels, read};
use crate::assemble::limits::{Limit, check};
use crate::error::Kind;
use crate::file::Problem;
use crate::registry::FieldContext;
use crate::scene::flow;
use std::sync::Arc;
use throng_field::Map;

impl FieldContext<'_> {
    pub(super) fn map(&self, said: &flow::Map) -> Result<Arc<Map>, Problem> {
        let [low, high] = self.corners(said.min, said.max)?;
        let strokes = said.strokes.as_deref().unwrap_or_default();
        let mut map = match &said.file {
            Some(_) if said.cell.is_some() => {
                let message = "the pixels of the picture are its cells";
                let problem = Problem::new(&self.path.key("cell"), Kind::Conflict, message);
                return Err(problem.hint("leave out `cell`, or `file`"));
            }
            Some(file) => {
                let picture = read(self, file)?;
                let grey = |pixel: [f32; 4]| (pixel[0] + pixel[1] + pixel[2]) / 3.0 * pixel[3];
                let Pixels { low, cell, columns, values } = picture.over(self, [low, high], grey)?;
                Map::new(low, cell, columns, values)
            }
            None => {
                let cell = said.cell.unwrap_or(CELL);
                check(&self.path.key("cell"), cell, Limit::Positive)?;
                Map::over(low, high, cell)
            }
        }
        .map_err(|error| self.refused(&error))?;
        if said.file.is_none() && strokes.is_empty() {
            self.note("a map without strokes is 0 everywhere");
        }
        for (i, stroke) in strokes.iter().enumerate() {
            let at = self.key("strokes").index(i);
            let (points, value) = (at.places("points", &stroke.points)?, stroke.value.unwrap_or(1.0));
            check(&at.path.key("value"), value, Limit::Finite)?;
            let brush = brush(stroke.radius, stroke.strength, stroke.hardness);
            map.paint(&brush, &points, value as f32).map_err(|error| at.refused(&error))?;
        }
        Ok(Arc::new(map))
    }
}
