//! The annotations of the selected agent, drawn over the view.

use eframe::egui::{Painter, Rect, Shape, Stroke, pos2};
use glam::{DVec2, Vec2};
use throng_draw::{Annotations, Annotator, Look, Primitive, Projector, Theme, Trails};
use throng_record::Frame;

/// The annotations, and the projection of the annotated agents.
pub struct Thinker<'a> {
    /// The annotations and their agents.
    pub annotations: &'a Annotations,
    /// The trails of these agents.
    pub ways: &'a Trails,
    /// The origin of the positions in traces.
    pub origin: DVec2,
    /// The projection from the world to points of the screen.
    pub projector: Projector,
    /// The colours of agents.
    pub look: &'a Look,
    /// The colours of lines.
    pub theme: &'a Theme,
}

/// Draws annotations over the view in `rect`.
pub fn draw(painter: &Painter, rect: Rect, frame: &Frame, thinker: Thinker<'_>) {
    let Thinker { annotations, ways, origin, projector, look, theme } = thinker;
    let annotator = Annotator { annotations, theme, look, ways, projector, unit: 1.2, origin };
    let at = |point: Vec2| pos2(rect.min.x + point.x, rect.min.y + point.y);
    painter.extend(annotator.marks(frame).into_iter().filter_map(|mark| shape(mark, &at)).flatten());
}

/// Converts a primitive of an annotation to shapes of the panels' painter.
fn shape(mark: Primitive, at: &impl Fn(Vec2) -> eframe::egui::Pos2) -> Option<Vec<Shape>> {
    let color = crate::style::color;
    match mark {
        Primitive::Line { points, closed, stroke } => {
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
        Primitive::Area { rings, fill } => {
            let ring = rings.into_iter().next()?.into_iter().map(at).collect();
            Some(vec![Shape::convex_polygon(ring, color(fill), Stroke::NONE)])
        }
        Primitive::Disc { center, radius, fill } => Some(vec![Shape::circle_filled(at(center), radius, color(fill))]),
        Primitive::Ring { center, radius, stroke } => {
            Some(vec![Shape::circle_stroke(at(center), radius, Stroke::new(stroke.width, color(stroke.color)))])
        }
        _ => None,
    }
}
