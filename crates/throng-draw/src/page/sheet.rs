//! Plots on one picture, side by side.

use super::Plot;
use super::plot::{CORNER, ROOM, SIZE};
use crate::{Anchor, Color, Error, Figure, Primitive, Stroke, Theme, palette};
use glam::Vec2;

/// The margin around the picture and between plots, and the height above each plot for its title.
const MARGIN: f32 = 24.0;
const HEAD: f32 = 34.0;
/// The heights of the title and of the row of the key.
const TITLE: f32 = 40.0;
const KEY: f32 = 26.0;
/// The widths of an entry of the key and of its line sample, pixels.
const ENTRY: f32 = 190.0;
const SAMPLE: f32 = 26.0;
/// The number of plots in a row.
const COLUMNS: usize = 2;
const TYPE: f32 = 13.0;

/// Returns a picture of plots under a title, with a key of line colours.
///
/// # Errors
/// There are so many plots that the picture is too high.
pub fn figure(title: &str, key: &[(usize, &str)], plots: &[Plot]) -> Result<Figure, Error> {
    let theme = Theme::light();
    let cell = Vec2::new(SIZE[0] as f32, SIZE[1] as f32 + HEAD);
    let rows = plots.len().div_ceil(COLUMNS);
    let top = MARGIN + TITLE + KEY;
    let size = Vec2::new(COLUMNS as f32 * (cell.x + MARGIN) + MARGIN, top + rows as f32 * (cell.y + MARGIN));
    let mut marks = vec![text(title, Vec2::new(MARGIN, MARGIN + 18.0), Anchor::Start, 20.0, theme.text)];
    for (k, (line, name)) in key.iter().enumerate() {
        let at = Vec2::new(MARGIN + ENTRY * k as f32, MARGIN + TITLE + 10.0);
        let stroke = Stroke::plain(2.0, palette(*line));
        marks.push(Primitive::Line {
            points: vec![at - 4.0 * Vec2::Y, at + Vec2::new(SAMPLE, -4.0)],
            closed: false,
            stroke,
        });
        marks.push(text(name, at + Vec2::new(SAMPLE + 8.0, 0.0), Anchor::Start, TYPE, theme.quiet));
    }
    for (k, plot) in plots.iter().enumerate() {
        let place = Vec2::new((k % COLUMNS) as f32, (k / COLUMNS) as f32);
        marks.extend(marks_of(plot, Vec2::new(MARGIN, top) + place * (cell + MARGIN), &theme));
    }
    Figure::of((size.x as u32, size.y as u32), theme.ground, marks)
}

/// Returns the primitives of a plot with its upper left corner at `corner`.
fn marks_of(plot: &Plot, corner: Vec2, theme: &Theme) -> Vec<Primitive> {
    let scales = plot.scales();
    let low = corner + Vec2::new(0.0, HEAD);
    let at = |x: f64, y: f64| low + Vec2::new(x as f32, y as f32);
    let (left, right, base) = (CORNER[0], SIZE[0] - ROOM[0], SIZE[1] - CORNER[1]);
    let thin = |from: Vec2, to: Vec2, color: Color| Primitive::Line {
        points: vec![from, to],
        closed: false,
        stroke: Stroke::plain(1.0, color),
    };
    let name = if plot.unit.is_empty() { plot.title.to_string() } else { format!("{}, {}", plot.title, plot.unit) };
    let mut marks = vec![text(&name, corner + Vec2::new(0.0, 16.0), Anchor::Start, 15.0, theme.text)];
    for (tick, label) in scales.up.ticks() {
        let y = scales.y(tick);
        marks.push(thin(at(left, y), at(right, y), theme.edge.alpha(0.45)));
        marks.push(text(&label, at(left - 7.0, y + 4.0), Anchor::End, TYPE, theme.quiet));
    }
    for (tick, label) in scales.across() {
        let x = scales.x(tick);
        marks.push(thin(at(x, base), at(x, base + 4.0), theme.edge));
        marks.push(text(&label, at(x, base + 18.0), Anchor::Middle, TYPE, theme.quiet));
    }
    marks.push(thin(at(left, base), at(right, base), theme.edge));
    marks.push(text(plot.axis, at(right, SIZE[1] - 4.0), Anchor::End, TYPE, theme.quiet));
    for (k, line) in plot.lines.iter().enumerate() {
        let piece = |piece: Vec<[f64; 2]>| Primitive::Line {
            points: piece.into_iter().map(|[x, y]| at(x, y)).collect(),
            closed: false,
            stroke: Stroke::plain(1.8, palette(k % 8)),
        };
        marks.extend(scales.pieces(line).into_iter().filter(|piece| piece.len() > 1).map(piece));
    }
    if let Some((value, meaning)) = plot.mark {
        let y = scales.y(value);
        marks.push(thin(at(left, y), at(right, y), theme.quiet));
        marks.push(text(meaning, at(left + 6.0, y + 15.0), Anchor::Start, TYPE, theme.quiet));
    }
    marks
}

fn text(text: &str, at: Vec2, anchor: Anchor, size: f32, color: Color) -> Primitive {
    Primitive::Text { text: text.to_owned(), at, anchor, size, color }
}
