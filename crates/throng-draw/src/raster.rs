//! Draws primitives on pictures by tiny-skia.

use crate::Color;
use crate::image::Image;
use crate::insect;
use crate::primitive::{Primitive, Stroke};
use crate::text::Type;
use crate::trail::TrailLayer;
use glam::Vec2;
use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, PixmapMut, Stroke as SkiaStroke, StrokeDash, Transform,
};

/// Draws primitives in order.
pub(crate) fn draw(image: &mut Image, typeface: &mut Type, marks: &[Primitive]) {
    for mark in marks {
        match mark {
            Primitive::Area { rings, fill } => {
                let mut path = PathBuilder::new();
                rings.iter().for_each(|ring| trace(&mut path, ring, true));
                fill_path(image, path.finish(), *fill);
            }
            Primitive::Line { points, closed, stroke } => {
                let mut path = PathBuilder::new();
                trace(&mut path, points, *closed);
                stroke_path(image, path.finish(), *stroke);
            }
            Primitive::Disc { center, radius, fill } => fill_path(image, circle(*center, *radius), *fill),
            Primitive::Agent(disc) => disc.draw(image),
            Primitive::Insect(insect) => insect.draw(image),
            Primitive::Streaks(streaks) => insect::lay(streaks, image),
            Primitive::Trails(trails) => {
                let mut layer = TrailLayer::new(image.width(), image.height());
                trails.iter().for_each(|trail| layer.draw(trail));
                layer.lay(image);
            }
            Primitive::Ring { center, radius, stroke } => stroke_path(image, circle(*center, *radius), *stroke),
            Primitive::Within { low, high, marks } => {
                let mut whole = image.clone();
                draw(&mut whole, typeface, marks);
                image.copy_within(&whole, *low, *high);
            }
            Primitive::Pixels(layer) => image.lay_over(layer),
            Primitive::Text { text, at, anchor, size, color } => {
                let shift = Vec2::new(typeface.width(text, *size) * anchor.part(), 0.0);
                typeface.draw(image, text, *at - shift, *size, *color);
            }
        }
    }
}

fn circle(center: Vec2, radius: f32) -> Option<Path> {
    if !center.is_finite() {
        return None;
    }
    PathBuilder::from_circle(center.x, center.y, radius)
}

fn trace(path: &mut PathBuilder, points: &[Vec2], closed: bool) {
    let mut points = points.iter().filter(|p| p.is_finite());
    let Some(first) = points.next() else { return };
    path.move_to(first.x, first.y);
    points.for_each(|p| path.line_to(p.x, p.y));
    if closed {
        path.close();
    }
}

fn paint(color: Color) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(color.r, color.g, color.b, color.a);
    paint
}

fn pixels(image: &mut Image) -> PixmapMut<'_> {
    let (width, height) = (image.width(), image.height());
    PixmapMut::from_bytes(image.data_mut(), width, height).expect("the number of bytes matches the size of the image")
}

fn fill_path(image: &mut Image, path: Option<Path>, color: Color) {
    if let Some(path) = path {
        pixels(image).fill_path(&path, &paint(color), FillRule::EvenOdd, Transform::identity(), None);
    }
}

fn stroke_path(image: &mut Image, path: Option<Path>, stroke: Stroke) {
    let Some(path) = path else { return };
    let (line_cap, dash) = match stroke.dash {
        Some(length) => (LineCap::Butt, StrokeDash::new(vec![length, length], 0.0)),
        None => (LineCap::Round, None),
    };
    let style = SkiaStroke { width: stroke.width, line_cap, line_join: LineJoin::Round, dash, ..SkiaStroke::default() };
    pixels(image).stroke_path(&path, &paint(stroke.color), &style, Transform::identity(), None);
}
