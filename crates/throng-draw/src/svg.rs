//! Moments as vector pictures.

use crate::insect::{Insect, Wing};
use crate::primitive::{Anchor, Primitive, Stroke};
use crate::rounded::{NOTCH_FROM, NOTCH_HALF_WIDTH, NOTCH_TO, Rounded};
use crate::sink::png_bytes;
use crate::trail::Trail;
use crate::{Color, Painter};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use glam::Vec2;
use std::fmt::{self, Write};
use throng_record::Frame;

impl Painter {
    /// Returns the moment as an SVG document, with the look of [`paint`](Self::paint).
    pub fn svg(&mut self, frame: &Frame) -> String {
        self.follow(frame);
        self.settle(frame);
        let size = (self.style.width, self.style.height);
        document(size, self.base(), |out| self.write_content(out, frame, ""))
    }

    /// Writes the content of the document; `tag` is appended to the names of its parts.
    fn write_content(&self, out: &mut String, frame: &Frame, tag: &str) -> fmt::Result {
        match &self.flows {
            Some(flows) => {
                group(out, "floor", tag, |out| write_marks(out, &self.floor))?;
                group(out, "flow", tag, |out| write_marks(out, &flows.marks))?;
                group(out, "place", tag, |out| write_marks(out, &self.place))?;
            }
            None => group(out, "place", tag, |out| {
                write_marks(out, &self.floor)?;
                write_marks(out, &self.place)
            })?,
        }
        let parts = self.moment(frame).into_iter().filter(|(_, marks)| !marks.is_empty());
        parts.into_iter().try_for_each(|(name, marks)| group(out, name, tag, |out| write_marks(out, &marks)))
    }
}

fn write_trails(out: &mut String, trails: &[Trail]) -> fmt::Result {
    writeln!(out, r#"<g fill="none" stroke-linecap="butt">"#)?;
    for Trail { ends, color } in trails {
        for pair in ends.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let stroke = Stroke::plain(a.half + b.half, color.alpha(0.5 * (a.opacity + b.opacity)));
            let (a, b) = (a.at, b.at);
            write!(out, r#"<path d="M{} {}L{} {}" "#, n(a.x), n(a.y), n(b.x), n(b.y))?;
            writeln!(out, "{}/>", self::stroke(stroke))?;
        }
    }
    writeln!(out, "</g>")
}

/// Returns primitives as an SVG document.
pub(crate) fn picture(size: (u32, u32), base: Color, marks: &[Primitive]) -> String {
    document(size, base, |out| write_marks(out, marks))
}

/// Returns pictures on a sheet; `(x, y)` are their upper left corners.
pub(crate) fn sheet<'a>(
    size: (u32, u32),
    paper: Color,
    title: &[Primitive],
    pictures: impl Iterator<Item = (&'a Painter, &'a Frame, (u32, u32))>,
) -> String {
    document(size, paper, |out| {
        write_marks(out, title)?;
        for (k, (painter, frame, (x, y))) in pictures.enumerate() {
            let (w, h) = (painter.style.width, painter.style.height);
            writeln!(out, r#"<svg x="{x}" y="{y}" width="{w}" height="{h}">"#)?;
            write_base(out, (w, h), painter.base())?;
            painter.write_content(out, frame, &format!("-{}", k + 1))?;
            writeln!(out, "</svg>")?;
        }
        Ok(())
    })
}

fn document(size: (u32, u32), base: Color, content: impl FnOnce(&mut String) -> fmt::Result) -> String {
    let (w, h) = size;
    let mut out = String::new();
    let write = |out: &mut String| {
        writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
        writeln!(
            out,
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}" font-family="Ubuntu, 'Helvetica Neue', Arial, sans-serif" font-weight="300">"#
        )?;
        write_base(out, size, base)?;
        content(out)?;
        writeln!(out, "</svg>")
    };
    write(&mut out).expect("writing to a string does not fail");
    out
}

/// Writes the background.
fn write_base(out: &mut String, (w, h): (u32, u32), base: Color) -> fmt::Result {
    writeln!(out, r#"<rect width="{w}" height="{h}" {}/>"#, fill(base))
}

fn group(out: &mut String, id: &str, tag: &str, content: impl FnOnce(&mut String) -> fmt::Result) -> fmt::Result {
    writeln!(out, r#"<g id="{id}{tag}">"#)?;
    content(out)?;
    writeln!(out, "</g>")
}

fn write_marks(out: &mut String, marks: &[Primitive]) -> fmt::Result {
    marks.iter().try_for_each(|mark| write_mark(out, mark))
}

fn write_body(out: &mut String, body: &Rounded) -> fmt::Result {
    let (c, core) = (body.center, body.core);
    // The edge lies inside.
    let inner = body.radius - 0.5 * body.rim_width;
    let (x, y, r) = (n(c.x), n(c.y), n(inner.max(0.0)));
    let rim = stroke(Stroke::plain(body.rim_width, body.rim));
    if core == Vec2::ZERO {
        writeln!(out, r#"<circle cx="{x}" cy="{y}" r="{r}" {} {rim}/>"#, fill(body.fill))?;
    } else {
        let half = (core + inner).max(Vec2::ZERO);
        let (left, top, width, height) = (n(-half.x), n(-half.y), n(2.0 * half.x), n(2.0 * half.y));
        let turn = n(body.along.y.atan2(body.along.x).to_degrees());
        write!(out, r#"<rect x="{left}" y="{top}" width="{width}" height="{height}" rx="{r}" "#)?;
        writeln!(out, r#"transform="translate({x} {y}) rotate({turn})" {} {rim}/>"#, fill(body.fill))?;
    }
    if let Some(color) = body.notch {
        let (c, r) = (body.front(), body.clearance_radius());
        let (a, b) = (c + body.along * (NOTCH_FROM * r), c + body.along * (NOTCH_TO * r));
        let notch = stroke(Stroke::plain((2.0 * NOTCH_HALF_WIDTH * r).max(1.2), color));
        write!(out, r#"<path d="M{} {}L{} {}" "#, n(a.x), n(a.y), n(b.x), n(b.y))?;
        writeln!(out, r#"stroke-linecap="round" {notch}/>"#)?;
    }
    Ok(())
}

fn write_insect(out: &mut String, insect: &Insect) -> fmt::Result {
    let root = insect.root;
    for Wing { tip, chord, color } in insect.wings.iter().copied() {
        // A leaf: two curves from root to tip.
        let (middle, side) = (root.lerp(tip, 0.7), (tip - root).perp().normalize_or_zero() * (1.7 * chord));
        let (a, b) = (middle + side, middle - side);
        write!(out, r#"<path d="M{} {}Q{} {} {} {}"#, n(root.x), n(root.y), n(a.x), n(a.y), n(tip.x), n(tip.y))?;
        writeln!(out, r#"Q{} {} {} {}Z" {}/>"#, n(b.x), n(b.y), n(root.x), n(root.y), fill(color))?;
    }
    let body = stroke(Stroke::plain(2.0 * insect.waist.max(0.55), insect.body));
    let (head, tail) = (insect.head, insect.tail);
    write!(out, r#"<path d="M{} {}L{} {}" "#, n(tail.x), n(tail.y), n(head.x), n(head.y))?;
    writeln!(out, r#"stroke-linecap="round" {body}/>"#)
}

fn write_mark(out: &mut String, mark: &Primitive) -> fmt::Result {
    match mark {
        Primitive::Area { rings, fill: color } => {
            let path: String = rings.iter().map(|ring| path(ring, true)).collect();
            writeln!(out, r#"<path d="{path}" fill-rule="evenodd" {}/>"#, fill(*color))
        }
        Primitive::Line { points, closed, stroke: line } => {
            let cap = if line.dash.is_some() { "butt" } else { "round" };
            let ends = format!(r#"fill="none" stroke-linejoin="round" stroke-linecap="{cap}""#);
            writeln!(out, r#"<path d="{}" {ends} {}/>"#, path(points, *closed), stroke(*line))
        }
        Primitive::Disc { center, radius, fill: color } => {
            writeln!(out, r#"<circle cx="{}" cy="{}" r="{}" {}/>"#, n(center.x), n(center.y), n(*radius), fill(*color))
        }
        Primitive::Agent(disc) => write_body(out, disc),
        Primitive::Insect(insect) => write_insect(out, insect),
        Primitive::Trails(trails) | Primitive::Streaks(trails) => write_trails(out, trails),
        Primitive::Ring { center, radius, stroke: line } => {
            let (x, y, r) = (n(center.x), n(center.y), n(*radius));
            writeln!(out, r#"<circle cx="{x}" cy="{y}" r="{r}" fill="none" {}/>"#, stroke(*line))
        }
        Primitive::Within { low, high, marks } => {
            // A nested document clips to its view box.
            let size = *high - *low;
            let (x, y, w, h) = (n(low.x), n(low.y), n(size.x), n(size.y));
            writeln!(out, r#"<svg x="{x}" y="{y}" width="{w}" height="{h}" viewBox="{x} {y} {w} {h}">"#)?;
            write_marks(out, marks)?;
            writeln!(out, "</svg>")
        }
        Primitive::Pixels(image) => {
            let (w, h) = (image.width(), image.height());
            let bytes = BASE64_STANDARD.encode(png_bytes(image));
            writeln!(out, r#"<image width="{w}" height="{h}" href="data:image/png;base64,{bytes}"/>"#)
        }
        Primitive::Text { text, at, anchor, size, color } => {
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            let (x, y, size) = (n(at.x), n(at.y), n(*size));
            write!(out, r#"<text x="{x}" y="{y}" text-anchor="{anchor}" font-size="{size}" "#)?;
            writeln!(out, "{}>{}</text>", fill(*color), escape(text))
        }
    }
}

fn path(points: &[Vec2], closed: bool) -> String {
    let mut path = String::new();
    for point in points.iter().filter(|p| p.is_finite()) {
        path.push(if path.is_empty() { 'M' } else { 'L' });
        path.push_str(&format!("{} {}", n(point.x), n(point.y)));
    }
    if closed && !path.is_empty() {
        path.push('Z');
    }
    path
}

/// Rounds a number to two digits after the point.
fn n(value: f32) -> f32 {
    let rounded = (value * 100.0).round() / 100.0;
    if rounded.is_finite() { rounded + 0.0 } else { 0.0 }
}

fn fill(color: Color) -> String {
    match color.a {
        255 => format!(r#"fill="{}""#, color.hex()),
        a => format!(r#"fill="{}" fill-opacity="{}""#, color.hex(), n(f32::from(a) / 255.0)),
    }
}

fn stroke(stroke: Stroke) -> String {
    let mut text = format!(r#"stroke="{}" stroke-width="{}""#, stroke.color.hex(), n(stroke.width));
    if stroke.color.a < 255 {
        text.push_str(&format!(r#" stroke-opacity="{}""#, n(f32::from(stroke.color.a) / 255.0)));
    }
    if let Some(dash) = stroke.dash {
        text.push_str(&format!(r#" stroke-dasharray="{}""#, n(dash)));
    }
    text
}

/// Escapes text for XML, between tags.
pub(crate) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
