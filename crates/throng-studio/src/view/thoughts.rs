//! What the selected agent has in mind: the lines of pictures, laid over the view.

use eframe::egui::{Painter, Rect, Shape, Stroke, pos2};
use glam::{DVec2, Vec2};
use throng_draw::{Annotation, Annotations, Annotator, Look, Mark, Projector, Theme, Trails};
use throng_record::Frame;

/// Who has something in mind, and how it is seen.
pub struct Thinker<'a> {
    /// Its number.
    pub number: u32,
    /// What places that agents tell are relative to.
    pub origin: DVec2,
    /// From the world to points of the screen.
    pub projector: Projector,
    /// The colours of agents.
    pub look: &'a Look,
    /// The colours of lines.
    pub theme: &'a Theme,
}

/// Draws what an agent has in mind at a moment over the view in `rect`.
pub fn draw(painter: &Painter, rect: Rect, frame: &Frame, thinker: Thinker<'_>) {
    let Thinker { number, origin, projector, look, theme } = thinker;
    let annotations = Annotations { kinds: Annotation::ALL.to_vec(), agents: Some(vec![number]) };
    let annotator = Annotator {
        annotations: &annotations,
        theme,
        look,
        // the view has trails of its own
        ways: &Trails::default(),
        projector,
        unit: 1.2,
        origin,
    };
    let at = |point: Vec2| pos2(rect.min.x + point.x, rect.min.y + point.y);
    painter.extend(annotator.marks(frame).into_iter().filter_map(|mark| shape(mark, &at)).flatten());
}

/// A mark as shapes of the panels' painter: of the kinds that annotations are made of.
fn shape(mark: Mark, at: &impl Fn(Vec2) -> eframe::egui::Pos2) -> Option<Vec<Shape>> {
    let color = crate::style::color;
    match mark {
        Mark::Line { points, closed, stroke } => {
            let mut points: Vec<_> = points.into_iter().map(at).collect();
            if closed {
                points.extend(points.first().copied());
            }
            let line = Stroke::new(stroke.width, color(stroke.color));
            Some(match stroke.dash {
                Some(dash) => Shape::dashed_line(&points, line, dash, dash),
                None => vec![Shape::line(points, line)],
            })
        }
        Mark::Area { rings, fill } => {
            let ring = rings.into_iter().next()?.into_iter().map(at).collect();
            Some(vec![Shape::convex_polygon(ring, color(fill), Stroke::NONE)])
        }
        Mark::Disc { center, radius, fill } => Some(vec![Shape::circle_filled(at(center), radius, color(fill))]),
        Mark::Ring { center, radius, stroke } => {
            Some(vec![Shape::circle_stroke(at(center), radius, Stroke::new(stroke.width, color(stroke.color)))])
        }
        _ => None,
    }
}
