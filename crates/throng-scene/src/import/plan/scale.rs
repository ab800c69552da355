//! Whether a plan is as large as a place for people.

use super::drawing::Drawing;
use crate::geometry::DVec2;

/// A plan that is smaller is none of a place for people, metres.
const LEAST: f64 = 1.0;
/// How large a plan for people mostly is, metres.
const USUAL: std::ops::RangeInclusive<f64> = 2.0..=100.0;
/// Units that plans are drawn in: what they are called, and their length in metres.
const UNITS: [(&str, f64); 3] = [("metres", 1.0), ("centimetres", 0.01), ("millimetres", 0.001)];

/// What to tell of a plan that is smaller than a person has room in: its unit is likely another than the file says.
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

/// A length to a hundredth of itself.
fn rounded(length: f64) -> f64 {
    let step = 10.0_f64.powf(length.log10().floor() - 2.0);
    (length / step).round() * step
}
