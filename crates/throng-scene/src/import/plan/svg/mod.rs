//! SVG, vector graphics: rectangles, circles, ellipses, lines, polygons and paths, by the labels and ids of the
//! enclosing elements.

mod elements;
mod outline;
mod stroke;
mod style;
mod viewport;

use super::drawing::{Drawing, FilePosition};
use crate::error::{Error, Kind};
use crate::geometry::DVec2;
use elements::Elements;
use roxmltree::{Document, ParsingOptions};

/// The default length of a pixel, or of a unit of the view box, metres.
const PIXEL: f64 = 0.01;

/// The maximum number of elements and texts of a file.
const MOST: u32 = 1_000_000;

/// Reads the shapes of an SVG text. The bottom of the picture is at y = 0.
///
/// # Errors
/// The text is not XML or not SVG, or a number, a path or a transform is wrong. The error has line and column.
pub(super) fn read(text: &str, unit: Option<f64>) -> Result<Drawing, Error> {
    let options = ParsingOptions { allow_dtd: true, nodes_limit: MOST, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| super::super::no_xml(text, &error))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let message = format!("this XML has the root <{}>, not <svg>", root.tag_name().name());
        return Err(Error::new(Kind::Syntax, message)
            .hint("a plan in SVG begins with <svg xmlns=\"http://www.w3.org/2000/svg\">"));
    }
    let mut drawing = Drawing::default();
    let unit = unit.unwrap_or_else(|| {
        drawing.notes.whole(format!(
            "a pixel, or unit of the view box, is taken to be {PIXEL} m: --plan-unit METRES, in a scene `unit`, changes it"
        ));
        PIXEL
    });
    let elements = Elements::new(text, &document, unit);
    elements.read(&mut drawing)?;
    let [corner, size] = elements.view()?;
    let bottom = corner.y + size.y;
    drawing.map(|p| DVec2::new(p.x, bottom - p.y) * unit);
    drawing.unit = unit;
    Ok(drawing)
}
