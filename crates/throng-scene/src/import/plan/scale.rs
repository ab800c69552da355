//! Checks whether a plan is large enough for people.

use super::drawing::Drawing;
use crate::geometry::DVec2;

/// The least size of a plan for people, metres.
const LEAST: f64 = 1.0;
/// The usual size of a plan for people, metres.
const USUAL: std::ops::RangeInclusive<f64> = 2.0..=100.0;
/// The units of plans: names, and lengths in metres.
const UNITS: [(&str, f64); 3] = [("metres", 1.0), ("centimetres", 0.01), ("millimetres", 0.001)];

/// Returns a message if a plan is too small for a person: its unit is likely to be wrong.
pub(super) fn doubt(drawing: &Drawing) -> Option<String> {
    let points = drawing.items.iter().flat_map(|item| item.form.points());
    let (low, high) = points.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    let size = (high - low).max_element();
    if !(0.0..LEAST).contains(&size) {
        return None;
    }
    let found = format!("the whole plan is only {} m wide: its unit is likely wrong", rounded(size));
    let likely = UNITS.iter().find(|(_, length)| USUAL.contains(&(size / drawing.unit * length)));
    Some(match likely {
        Some((name, length)) => {
            let wide = rounded(size / drawing.unit * length);
            format!("{found}; in {name} it is {wide} m wide: --plan-unit {length}, in a scene `unit`, changes it")
        }
        None => format!("{found}; --plan-unit METRES, in a scene `unit`, changes it"),
    })
}

/// Rounds a length to three significant digits.
fn rounded(length: f64) -> f64 {
    let step = 10.0_f64.powf(length.log10().floor() - 2.0);
    (length / step).round() * step
}
