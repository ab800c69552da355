//! Arrows on a regular grid.

use super::blade::arrow;
use super::{Lay, Vec2};
use crate::primitive::Primitive;

/// The spacing of arrows, the length of the longest over the spacing, and half the width of shafts; spacing and width
/// in units of the layout.
const SPACING: f32 = 21.0;
const LONGEST: f32 = 0.88;
const HALF: f32 = 0.75;
/// The least length of arrows, in units of the layout.
const LEAST: f32 = 2.5;

/// Returns an arrow in the middle of each cell where the field is drawn.
pub(super) fn arrows(lay: &Lay<'_>) -> Vec<Primitive> {
    let unit = lay.canvas.unit;
    let spacing = SPACING * unit * lay.style.spread();
    let counts = (lay.canvas.size / spacing).floor().max(Vec2::ONE);
    // The grid is centred in the picture; the grids of several fields are shifted against each other.
    let (turn, of) = lay.turn;
    let low = (lay.canvas.size - counts * spacing) * 0.5 + spacing * (0.5 + turn as f32) / of as f32;
    let cells = (0..counts.y as usize).flat_map(|row| (0..counts.x as usize).map(move |column| (column, row)));
    let draw = |(column, row): (usize, usize)| {
        let center = low + Vec2::new(column as f32, row as f32) * spacing;
        let flow = lay.flow(center);
        let part = lay.part(flow);
        let way = flow.normalize_or_zero() * (LONGEST * spacing / (of as f32).sqrt() * part.sqrt());
        let fill = lay.ink.alpha(0.4 + 0.5 * part);
        let half = HALF * unit * (0.7 + 0.3 * part);
        (way.length() >= LEAST * unit).then(|| arrow(center - way * 0.5, center + way * 0.5, half, fill)).flatten()
    };
    cells.filter_map(draw).collect()
}
