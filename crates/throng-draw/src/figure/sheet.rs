//! The layout of a figure: its parts, and the texts around them.

use super::velocities::Entry;
use crate::primitive::{Anchor, Primitive, Stroke};
use crate::text::Type;
use crate::{Color, Style};
use glam::Vec2;

/// A rectangle of the picture, pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rect {
    pub low: Vec2,
    pub high: Vec2,
}

impl Rect {
    pub(super) fn around(center: Vec2, half: Vec2) -> Self {
        Self { low: center - half, high: center + half }
    }

    pub(super) fn inset(self, by: f32) -> Self {
        Self { low: self.low + by, high: self.high - by }
    }

    pub(super) fn overlaps(&self, other: &Self) -> bool {
        self.low.cmplt(other.high).all() && other.low.cmplt(self.high).all()
    }

    pub(super) fn contains(&self, other: &Self) -> bool {
        self.low.cmple(other.low).all() && other.high.cmple(self.high).all()
    }

    /// Returns the part of the primitives inside this rectangle.
    pub(super) fn clip(self, marks: Vec<Primitive>) -> Primitive {
        Primitive::Within { low: self.low, high: self.high, marks }
    }

    /// Returns the nearest rectangle of whole pixels.
    fn whole(self) -> Self {
        Self { low: self.low.round(), high: self.high.max(self.low).round() }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.low.cmpge(self.high).any()
    }

    pub(super) fn corners(&self) -> Vec<Vec2> {
        vec![self.low, Vec2::new(self.high.x, self.low.y), self.high, Vec2::new(self.low.x, self.high.y)]
    }
}

/// The layout of a figure.
pub(super) struct FigureLayout<'a> {
    pub style: &'a Style,
    pub typeface: Type,
    /// The scale of everything: 1 for 1200 by 760 pixels.
    pub unit: f32,
    /// The size of the type.
    pub size: f32,
    /// The panel of the agent and what is near it. Empty in a narrow figure.
    pub near: Rect,
    /// The panel of its velocities.
    pub plot: Rect,
    margin: f32,
    caption: Vec<String>,
    key: Vec<Vec<Entry>>,
}

/// The sizes of the parts, in units.
const MARGIN: f32 = 26.0;
const HEAD: f32 = 84.0;
const LINE: f32 = 22.0;
/// The space for the numbers of the axes: beside and below the plot.
const BESIDE: f32 = 44.0;
const BELOW: f32 = 36.0;
const GAP: f32 = 26.0;
/// The width of a sample in the key.
const SAMPLE: f32 = 30.0;
/// The least side of the plot. The key yields to it, from its last row on, and so do the surroundings.
const LEAST: f32 = 170.0;

impl<'a> FigureLayout<'a> {
    pub(super) fn new(style: &'a Style, unit: f32, caption: Vec<String>, key: Vec<Entry>) -> Self {
        let (width, height) = (style.width as f32, style.height as f32);
        let (typeface, size, margin) = (Type::of(&style.typeface), super::LETTERS * unit, MARGIN * unit);
        let wrapped =
            caption.iter().flat_map(|text| wrap(text, width - 2.0 * margin, |text| typeface.width(text, size)));
        let caption: Vec<String> = wrapped.collect();
        let mut key = rows(key, width - 2.0 * margin, |entry| entry_width(entry, &typeface, size, unit));
        let top = margin + HEAD * unit;
        let bottom = |rows: usize| height - margin - (BELOW + LINE * (caption.len() + rows) as f32 + 12.0) * unit;
        while bottom(key.len()) - top < LEAST * unit && key.pop().is_some() {}
        let bottom = bottom(key.len());
        let between = (BESIDE + GAP) * unit;
        let (half, whole) = (0.5 * (width - 2.0 * margin - between), width - 2.0 * margin - BESIDE * unit);
        let side = (bottom - top).min(if half < LEAST * unit { whole } else { half }).max(1.0);
        let right = width - margin;
        let plot = Rect { low: Vec2::new(right - side, top), high: Vec2::new(right, top + side) };
        let near = Rect { low: Vec2::new(margin, top), high: Vec2::new(right - side - between, top + side) };
        let near = if half < LEAST * unit { Rect { high: near.low, ..near } } else { near };
        let (near, plot) = (near.whole(), plot.whole());
        Self { style, typeface, unit, size, near, plot, margin, caption, key }
    }

    pub(super) fn text(&self, text: impl Into<String>, at: Vec2, anchor: Anchor, color: Color) -> Primitive {
        Primitive::Text { text: text.into(), at, anchor, size: self.size, color }
    }

    /// Returns half the size of a label.
    pub(super) fn half(&self, text: &str) -> Vec2 {
        Vec2::new(0.5 * self.typeface.width(text, self.size) + 2.0 * self.unit, 0.62 * self.size)
    }

    /// Draws a label around `center` on a translucent background.
    pub(super) fn label(&self, text: &str, center: Vec2, marks: &mut Vec<Primitive>) {
        let theme = &self.style.theme;
        let chip = Rect::around(center, self.half(text));
        marks.push(Primitive::Area { rings: vec![chip.corners()], fill: theme.ground.alpha(0.78) });
        marks.push(self.text(text, center + Vec2::new(0.0, 0.34 * self.size), Anchor::Middle, theme.text));
    }

    /// Returns the edges, titles, key and caption.
    pub(super) fn frame(&self, [title, subtitle]: [String; 2]) -> Vec<Primitive> {
        let (theme, unit) = (&self.style.theme, self.unit);
        let panels = [self.near, self.plot];
        let stroke = Stroke::plain(unit, theme.edge);
        let edge = |rect: Rect| Primitive::Line { points: rect.corners(), closed: true, stroke };
        let mut marks: Vec<Primitive> = panels.into_iter().filter(|panel| !panel.is_empty()).map(edge).collect();

        let (left, room) = (self.margin, self.style.width as f32 - 2.0 * self.margin);
        let mut line = |text: &str, at: Vec2, size: f32, room: f32, color: Color| {
            let text = self.typeface.clip(text, size, room);
            marks.push(Primitive::Text { text, at, anchor: Anchor::Start, size, color });
        };
        line(&title, Vec2::new(left, self.margin + 16.0 * unit), 1.45 * self.size, room, theme.text);
        line(&subtitle, Vec2::new(left, self.margin + 39.0 * unit), self.size, room, theme.quiet);
        let named = panels.iter().zip(["surroundings", "velocities, m/s"]);
        for (panel, name) in named.filter(|(panel, _)| !panel.is_empty()) {
            let at = panel.low - Vec2::new(0.0, 8.0 * unit);
            line(name, at, self.size, panel.high.x - panel.low.x, theme.quiet);
        }
        let first = self.plot.high.y + (BELOW + LINE) * unit;
        let caption = first + (LINE * self.key.len() as f32 + 6.0) * unit;
        for (k, text) in self.caption.iter().enumerate() {
            line(text, Vec2::new(left, caption + LINE * k as f32 * unit), self.size, room, theme.text);
        }
        for (k, row) in self.key.iter().enumerate() {
            let mut at = Vec2::new(left, first + LINE * k as f32 * unit);
            for entry in row {
                let middle = at - Vec2::new(0.0, 0.34 * self.size);
                entry.sample(middle, middle + Vec2::new(SAMPLE * unit, 0.0), self, &mut marks);
                let from = at + Vec2::new((SAMPLE + 7.0) * unit, 0.0);
                marks.push(self.text(entry.says(), from, Anchor::Start, theme.quiet));
                at.x += entry_width(entry, &self.typeface, self.size, unit);
            }
        }
        marks
    }
}

fn entry_width(entry: &Entry, typeface: &Type, size: f32, unit: f32) -> f32 {
    typeface.width(entry.says(), size) + (SAMPLE + 7.0 + 20.0) * unit
}

/// Breaks a text at its spaces into lines of a maximum width.
fn wrap(text: &str, room: f32, width: impl Fn(&str) -> f32) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        let longer = lines.last().map(|line| format!("{line} {word}")).filter(|line| width(line) <= room);
        match (longer, lines.last_mut()) {
            (Some(longer), Some(line)) => *line = longer,
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Distributes entries to rows of a maximum width.
fn rows<T>(all: Vec<T>, room: f32, width: impl Fn(&T) -> f32) -> Vec<Vec<T>> {
    let (mut rows, mut used): (Vec<Vec<T>>, f32) = (Vec::new(), f32::INFINITY);
    for entry in all {
        let wide = width(&entry);
        used += wide;
        match rows.last_mut() {
            Some(row) if used <= room => row.push(entry),
            _ => {
                rows.push(vec![entry]);
                used = wide;
            }
        }
    }
    rows
}
