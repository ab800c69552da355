//! A contact sheet: stills of many recordings in one picture, each with its name, in sections.

use crate::image::Image;
use crate::picture::Picture;
use crate::primitive::{Anchor, Primitive, Stroke};
use crate::sink::Kind;
use crate::text::{Type, Typeface};
use crate::{Color, Error, Painter, Theme, raster, svg};
use glam::Vec2;
use std::path::Path;
use throng_record::{Frame, Output};

/// The background of the sheet.
const PAPER: Color = Color::rgb(0xfdfcfa);
/// The width of panels, the margin and the gap between panels, in units of [`Contact::unit`].
const PANEL: f32 = 250.0;
const MARGIN: f32 = 18.0;
const GAP: f32 = 12.0;
/// The height above the panels of a row with headings.
const HEADING: f32 = 34.0;
/// The height below a panel with one line of type, and of each further line.
const CAPTION: f32 = 30.0;
const LINE: f32 = 18.0;
/// The sizes of names and of times.
const NAME: f32 = 15.0;
const TIME: f32 = 13.0;
/// The widest time that a first line leaves room for.
const LONGEST_TIME: &str = "0000 s";

/// A heading and the names of the panels under it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Section {
    /// The heading; empty for none.
    pub heading: String,
    /// The names of the panels.
    pub names: Vec<String>,
}

/// A contact sheet under construction. [`create`](Self::create) determines the size of its panels;
/// [`finish`](Self::finish) takes a painter of that size and a frame for each panel.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("sheet.png");
/// use throng_draw::{Contact, Painter, Section, Style};
/// use throng_record::{Frame, Setting};
/// let sections = [Section { heading: "letters".into(), names: vec!["a".into(), "b".into()] }];
/// let contact = Contact::create(&path, &sections, 800, 2)?;
/// let (width, height) = contact.panel();
/// let style = Style { width, height, legend: false, ..Style::default() };
/// let still = || Painter::new(&Setting::default(), &style, &Frame::default()).map(|painter| (painter, Frame::default()));
/// contact.finish(vec![still()?, still()?])?;
/// assert!(path.exists());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Contact {
    kind: Kind,
    output: Output,
    size: (u32, u32),
    panel: (u32, u32),
    /// The scale of everything: 1 for panels [`PANEL`] pixels wide.
    unit: f32,
    /// The lines of the name and the upper left corner of each panel.
    places: Vec<(Vec<String>, (u32, u32))>,
    /// The headings, and the starts of their baselines.
    headings: Vec<(String, Vec2)>,
}

impl Contact {
    /// Creates `path`, a `.png` or `.svg` `width` pixels wide with `columns` panels side by side. A section starts a
    /// new row, unless all of it fits into the rest of the row before.
    ///
    /// # Errors
    /// The name has another ending, the folder does not exist or is not writable, or the panels or the sheet are too
    /// small or too large.
    pub fn create(path: impl AsRef<Path>, sections: &[Section], width: u32, columns: usize) -> Result<Self, Error> {
        let path = path.as_ref();
        let kind = Kind::of(path)?;
        if !matches!(kind, Kind::Png | Kind::Svg) {
            return Err(Error::Still { path: path.to_path_buf() });
        }
        let columns = columns.max(1);
        let share = width as f32 / columns as f32;
        let unit = (share / (PANEL + GAP)).clamp(0.6, 2.5);
        let side = ((width as f32 - (2.0 * MARGIN + (columns - 1) as f32 * GAP) * unit) / columns as f32).max(0.0);
        let panel = (side as u32, (0.75 * side) as u32);
        Error::check_size(panel.0, panel.1)?;
        let cells = cells(sections, columns);
        let typeface = Type::of(&Typeface::default());
        let room = side - typeface.width(LONGEST_TIME, TIME * unit) - 8.0 * unit;
        let lines = |name: &String| typeface.wrap(name, NAME * unit, (room, side));
        let names: Vec<Vec<Vec<String>>> =
            sections.iter().map(|section| section.names.iter().map(lines).collect()).collect();
        let tops = tops(sections, &cells, &names, (panel.1 as f32, unit));
        let x = |column: usize| (MARGIN * unit + column as f32 * (side + GAP * unit)).round();
        let (mut places, mut headings) = (Vec::new(), Vec::new());
        for ((section, cells), names) in sections.iter().zip(&cells).zip(names) {
            if let (Some(&(row, column)), false) = (cells.first(), section.heading.is_empty()) {
                headings.push((section.heading.clone(), Vec2::new(x(column), tops[row] - 12.0 * unit)));
            }
            let places_of = |&(row, column): &(usize, usize)| (x(column) as u32, tops[row] as u32);
            places.extend(names.into_iter().zip(cells.iter().map(places_of)));
        }
        let size = (width, tops.last().copied().unwrap_or_default() as u32);
        Error::check_size(size.0, size.1)?;
        Ok(Self { kind, output: Output::create(path)?, size, panel, unit, places, headings })
    }

    /// Returns width and height of a panel, pixels.
    pub fn panel(&self) -> (u32, u32) {
        self.panel
    }

    /// Draws the panels, in the order of their names, and completes the file.
    ///
    /// # Errors
    /// The file cannot be written.
    ///
    /// # Panics
    /// The number of stills differs from the number of names.
    pub fn finish(self, mut stills: Vec<(Painter, Frame)>) -> Result<(), Error> {
        assert_eq!(stills.len(), self.places.len(), "a still for each name");
        let mut typeface = Type::of(&Typeface::default());
        let marks = self.marks(&stills);
        let places = self.places.iter().map(|(_, corner)| *corner);
        let picture = if self.kind == Kind::Svg {
            stills.iter_mut().for_each(|(painter, frame)| painter.settle(frame));
            let panels = stills.iter().zip(places).map(|((painter, frame), corner)| (painter, frame, corner));
            Picture::Vector(svg::sheet(self.size, PAPER, &marks, panels))
        } else {
            let mut image = Image::new(self.size.0, self.size.1, PAPER);
            raster::draw(&mut image, &mut typeface, &marks);
            stills
                .iter_mut()
                .zip(places)
                .for_each(|((painter, frame), corner)| image.lay(painter.paint(frame), corner));
            Picture::Pixels(image)
        };
        picture.write(self.output)
    }

    /// Returns the type and a line around each panel.
    fn marks(&self, stills: &[(Painter, Frame)]) -> Vec<Primitive> {
        let theme = Theme::light();
        let (unit, (width, height)) = (self.unit, (self.panel.0 as f32, self.panel.1 as f32));
        let text = |text, at, anchor, size: f32, color| Primitive::Text { text, at, anchor, size: size * unit, color };
        let heading = |(heading, at): &(String, Vec2)| text(heading.clone(), *at, Anchor::Start, 19.0, theme.quiet);
        let mut marks: Vec<Primitive> = self.headings.iter().map(heading).collect();
        for ((lines, (x, y)), (_, frame)) in self.places.iter().zip(stills) {
            let (low, high) = (Vec2::new(*x as f32, *y as f32), Vec2::new(*x as f32 + width, *y as f32 + height));
            let (a, b) = (low - 0.5, high + 0.5);
            let points = vec![a, Vec2::new(b.x, a.y), b, Vec2::new(a.x, b.y)];
            let stroke = Stroke::plain(1.0, theme.outside);
            marks.push(Primitive::Line { points, closed: true, stroke });
            let baseline = |line: usize| high.y + (19.0 + LINE * line as f32) * unit;
            for (k, line) in lines.iter().enumerate() {
                marks.push(text(line.clone(), Vec2::new(low.x, baseline(k)), Anchor::Start, NAME, theme.text));
            }
            let time = format!("{:.0} s", frame.time);
            marks.push(text(time, Vec2::new(high.x, baseline(0)), Anchor::End, TIME, theme.quiet));
        }
        marks
    }
}

/// Returns row and column of each panel of each section.
fn cells(sections: &[Section], columns: usize) -> Vec<Vec<(usize, usize)>> {
    let mut next = 0;
    let place = |section: &Section| {
        if next % columns + section.names.len() > columns {
            next = next.next_multiple_of(columns);
        }
        let first = next;
        next += section.names.len();
        (first..next).map(|k| (k / columns, k % columns)).collect()
    };
    sections.iter().map(place).collect()
}

/// Returns the top of the panels of each row, followed by the height of everything; `names` are the lines of the names,
/// `scale` is the height of a panel and the unit of other lengths.
fn tops(
    sections: &[Section],
    cells: &[Vec<(usize, usize)>],
    names: &[Vec<Vec<String>>],
    (height, unit): (f32, f32),
) -> Vec<f32> {
    let rows = cells.iter().flatten().map(|(row, _)| row + 1).max().unwrap_or(0);
    let begins = |row: usize| {
        let mut sections = sections.iter().zip(cells).filter(|(section, _)| !section.heading.is_empty());
        sections.any(|(_, cells)| cells.first().is_some_and(|cell| cell.0 == row))
    };
    let further = |row: usize| {
        let places = cells.iter().flatten().zip(names.iter().flatten());
        let lines = places.filter(|(cell, _)| cell.0 == row).map(|(_, lines)| lines.len());
        lines.max().unwrap_or(0).saturating_sub(1) as f32
    };
    let mut y = MARGIN * unit;
    let mut tops = Vec::new();
    for row in 0..rows {
        y += if begins(row) { HEADING * unit } else { 0.0 };
        tops.push(y.round());
        y += height + (CAPTION + LINE * further(row)) * unit;
    }
    tops.push((y + 0.5 * MARGIN * unit).round());
    tops
}

#[cfg(test)]
mod tests {
    use super::*;

    fn section(heading: &str, count: usize) -> Section {
        Section { heading: heading.into(), names: (0..count).map(|k| k.to_string()).collect() }
    }

    #[test]
    fn a_section_shares_a_row_only_if_all_of_it_fits() {
        let sections = [section("a", 2), section("b", 1), section("c", 4), section("d", 3)];
        let cells = cells(&sections, 3);
        assert_eq!(cells[0], [(0, 0), (0, 1)]);
        assert_eq!(cells[1], [(0, 2)]);
        assert_eq!(cells[2], [(1, 0), (1, 1), (1, 2), (2, 0)]);
        assert_eq!(cells[3], [(3, 0), (3, 1), (3, 2)]);
    }

    #[test]
    fn only_rows_with_headings_have_room_for_them() {
        let sections = [section("", 2), section("b", 4)];
        let mut names: Vec<Vec<Vec<String>>> =
            sections.iter().map(|s| vec![vec!["one".into()]; s.names.len()]).collect();
        let cells = cells(&sections, 2);
        let one = tops(&sections, &cells, &names, (100.0, 1.0));
        let row = 100.0 + CAPTION;
        assert_eq!(
            one,
            [MARGIN, MARGIN + row + HEADING, MARGIN + 2.0 * row + HEADING, 1.5 * MARGIN + 3.0 * row + HEADING]
        );
        // a name of two lines in the second row moves what is below
        names[1][0].push("two".into());
        let two = tops(&sections, &cells, &names, (100.0, 1.0));
        assert_eq!(two, [one[0], one[1], one[2] + LINE, one[3] + LINE]);
    }
}
