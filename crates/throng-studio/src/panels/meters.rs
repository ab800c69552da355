//! Meters on the ground: drawn with the mouse and shown over the view.

use crate::play::{Command, Meter};
use crate::style;
use crate::view::{Eye, ground};
use eframe::egui::{Align2, Color32, FontId, Painter, Rect, Response, Shape, Stroke, Ui, pos2, vec2};
use glam::{DVec2, Vec2};
use throng_draw::{Projector, palette};

/// The shape of the next meter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeterTool {
    /// A line.
    Line,
    /// A rectangle.
    Area,
}

/// The meters, and the meter that is being drawn.
#[derive(Clone, Debug, Default)]
pub struct Meters {
    all: Vec<Meter>,
    tool: Option<MeterTool>,
    /// The position on the ground where the mouse was pressed.
    begun: Option<DVec2>,
}

/// Returns the colour of a meter, in the view and in the plots.
pub(super) fn color(index: usize) -> Color32 {
    style::color(palette([1, 2, 3, 7, 0][index % 5]))
}

impl Meters {
    /// Returns the shape of the next meter, if one is to be drawn.
    pub fn tool(&self) -> Option<MeterTool> {
        self.tool
    }

    /// Selects the shape of the next meter.
    pub fn take_up(&mut self, tool: Option<MeterTool>) {
        (self.tool, self.begun) = (tool, None);
    }

    /// Whether there are no meters.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Removes all meters.
    pub fn clear(&mut self) -> Command {
        *self = Self::default();
        self.command()
    }

    /// Shows the meters over the view of this response and handles the drawing of a meter. Returns the command for the
    /// player when a meter is complete.
    pub fn ui(&mut self, ui: &Ui, view: &Response, eye: &Eye) -> Option<Command> {
        let rect = view.rect;
        let projector = eye.projector(Vec2::new(rect.width(), rect.height()).max(Vec2::ONE));
        let painter = ui.painter_at(rect);
        for (index, meter) in self.all.iter().enumerate() {
            draw(&painter, rect, &projector, *meter, index);
        }
        let tool = self.tool?;
        ui.ctx().set_cursor_icon(eframe::egui::CursorIcon::Crosshair);
        let at =
            |pointer: eframe::egui::Pos2| ground(&projector, Vec2::new(pointer.x - rect.min.x, pointer.y - rect.min.y));
        if view.drag_started() {
            self.begun = ui.input(|input| input.pointer.press_origin()).and_then(at);
        }
        let ends = [self.begun?, view.interact_pointer_pos().and_then(at)?];
        let meter = match tool {
            MeterTool::Line => Meter::Line(ends),
            MeterTool::Area => Meter::Area(ends),
        };
        draw(&painter, rect, &projector, meter, self.all.len());
        if !view.drag_stopped() {
            return None;
        }
        self.take_up(None);
        // a click without a drag draws no meter
        (meter.extent() > 1e-3).then(|| {
            self.all.push(meter);
            self.command()
        })
    }

    fn command(&self) -> Command {
        Command::Meters(self.all.as_slice().into())
    }
}

fn draw(painter: &Painter, rect: Rect, projector: &Projector, meter: Meter, index: usize) {
    let color = color(index);
    let stroke = Stroke::new(2.5, color);
    let at = |point: DVec2| projector.pixel(point.extend(0.0)).map(|at| pos2(rect.min.x + at.x, rect.min.y + at.y));
    let corners = match meter {
        Meter::Line(ends) => ends.to_vec(),
        Meter::Area([a, b]) => vec![a, DVec2::new(b.x, a.y), b, DVec2::new(a.x, b.y)],
    };
    let Some(corners) = corners.into_iter().map(at).collect::<Option<Vec<_>>>() else { return };
    let label = corners[0] + vec2(6.0, -6.0);
    match meter {
        Meter::Line(_) => {
            corners.iter().for_each(|&end| _ = painter.circle_filled(end, 4.0, color));
            painter.line_segment([corners[0], corners[1]], stroke);
        }
        Meter::Area(_) => {
            painter.add(Shape::convex_polygon(corners, color.gamma_multiply(0.12), stroke));
        }
    }
    painter.text(label, Align2::LEFT_BOTTOM, index + 1, FontId::proportional(14.0), color);
}
