//! Menge's generator `hex_lattice`: rows in which every agent has six neighbours at the same distance.

use super::xml::Xml;
use crate::error::{Error, Kind};
use crate::geometry::DVec2;
use crate::import::short;
use roxmltree::Node;

/// Returns the places of a lattice: as many whole rows as are needed for more than the population, as in Menge.
///
/// # Errors
/// An attribute is missing or wrong, or there would be more than `most` places.
pub(super) fn places(xml: &Xml, node: Node, most: f64) -> Result<Vec<DVec2>, Error> {
    let wrong = |message: String| xml.wrong(node, Kind::OutOfRange, message);
    let number = |name: &str| xml.needed(node, name);
    let (density, width, population) = (number("density")?, number("width")?, number("population")?);
    if density <= 0.0 {
        return Err(wrong(format!("a lattice of {density} people on a square metre")));
    }
    // the densest packing of discs that touch
    let apart = (2.0 / (density * 3f64.sqrt())).sqrt();
    let rows_apart = apart * 0.75f64.sqrt();
    let in_rows = match xml.text(node, "row_direction")? {
        "x" => true,
        "y" => false,
        other => return Err(wrong(format!("row_direction is `{}`, which is neither x nor y", short(other)))),
    };
    let along = if in_rows { apart } else { rows_apart };
    let across = (width / along).floor().max(1.0);
    if population < 0.0 || population + 2.0 * across > most {
        return Err(wrong(format!("a lattice of {population} agents, {across} in a row: at most {most}")));
    }
    let (across, population) = (across as usize, population as usize);
    let local: Vec<DVec2> = if in_rows {
        // rows alternate between `across` and one place less
        let pair = 2 * across - 1;
        let whole = (population / pair + 1) * pair;
        let count = if whole - (across - 1) > population { whole - (across - 1) } else { whole };
        let place = |i: usize| match (i / pair * 2, i % pair) {
            (row, column) if column < across => DVec2::new(column as f64 * apart, row as f64 * rows_apart),
            (row, column) => DVec2::new((column - across) as f64 * apart + 0.5 * apart, (row + 1) as f64 * rows_apart),
        };
        (0..count).map(place).collect()
    } else {
        let each = population / across + 1;
        let place = |(column, i): (usize, usize)| {
            DVec2::new(column as f64 * rows_apart, (i as f64 + 0.5 * (column % 2) as f64) * apart)
        };
        (0..across).flat_map(|column| (0..each).map(move |i| (column, i))).map(place).collect()
    };
    let part = match xml.text(node, "alignment")? {
        "left" => 0.0,
        "center" => 0.5,
        "right" => 1.0,
        other => return Err(wrong(format!("alignment is `{}`: it should be left, center or right", short(other)))),
    };
    let start = DVec2::new(part * (across - 1) as f64 * along, 0.0);
    let (sin, cos) = libm::sincos(xml.number(node, "rotation")?.unwrap_or(0.0).to_radians());
    let turn = DVec2::new(cos, sin);
    let anchor = DVec2::new(number("anchor_x")?, number("anchor_y")?);
    Ok(local.into_iter().map(|p| anchor + turn.rotate(p - start)).collect())
}
