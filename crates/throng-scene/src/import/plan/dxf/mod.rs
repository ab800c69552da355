//! DXF, the drawings of CAD programs: lines, polylines, arcs, circles, ellipses, splines, solids, hatches and blocks of
//! them, by their layers. Has its own reader: a plan needs a dozen of the format's hundred kinds, all of them pairs of
//! a number and a value, and errors that name the line.

mod hatch;
mod pairs;
mod shapes;
mod spline;

use super::drawing::{Drawing, UNIT};
use crate::error::{Error, Kind};
use crate::geometry::DVec2;
use pairs::{Entity, Pairs};
use shapes::Shapes;

/// Reads the shapes of a DXF text. The unit is that of the drawing (`$INSUNITS`), or metres.
///
/// # Errors
/// The text does not consist of pairs, a number is wrong, or blocks insert each other too deeply. The error has the
/// line.
pub(super) fn read(text: &str, unit: Option<f64>) -> Result<Drawing, Error> {
    if text.starts_with("AutoCAD Binary DXF") {
        return Err(Error::new(Kind::Syntax, "this is a binary DXF").hint("save it as ASCII DXF"));
    }
    let pairs = Pairs::read(text)?;
    let mut drawing = Drawing::default();
    let unit = match (unit, pairs.header("$INSUNITS").and_then(|pair| pair.value.parse().ok())) {
        (Some(unit), _) => unit,
        (None, Some(code)) if code != 0 => length(code).ok_or_else(|| {
            let message = format!("its unit has the code {code} ($INSUNITS), which is no length that is known");
            Error::new(Kind::OutOfRange, message).hint(UNIT)
        })?,
        _ => {
            drawing.notes.whole("the drawing does not say its unit: taken for metres; --plan-unit METRES, in a scene `unit`, changes it");
            1.0
        }
    };
    Shapes::new(&pairs, unit).read(&mut drawing)?;
    drawing.map(|p: DVec2| p * unit);
    drawing.unit = unit;
    Ok(drawing)
}

/// The length of a unit by the format's code, metres.
fn length(code: u32) -> Option<f64> {
    Some(match code {
        1 => 0.0254,
        2 => 0.3048,
        3 => 1609.344,
        4 => 1e-3,
        5 => 1e-2,
        6 => 1.0,
        7 => 1e3,
        10 => 0.9144,
        13 => 1e-6,
        14 => 0.1,
        15 => 10.0,
        16 => 100.0,
        21 => 1200.0 / 3937.0,
        _ => return None,
    })
}
