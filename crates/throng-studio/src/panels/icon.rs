//! The icons of the playback bar. They are drawn, because not every typeface has them.

use eframe::egui::{Color32, Painter, Pos2, Rect, Response, Sense, Shape, Stroke, Ui, Vec2, pos2, vec2};

/// An icon of the playback bar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    /// Restart.
    Restart,
    /// One step back.
    Back,
    /// Run.
    Run,
    /// Pause.
    Pause,
    /// One step forward.
    Step,
    /// A key of the camera.
    Key,
}

impl Icon {
    /// Shows a button with the icon. `says` is its accessible name and tooltip.
    pub fn button(self, ui: &mut Ui, says: &str) -> Response {
        let large = matches!(self, Self::Run | Self::Pause);
        // a finger needs more room
        let side = ui.spacing().interact_size.y.max(28.0) + if large { 6.0 } else { 0.0 };
        let (rect, response) = ui.allocate_exact_size(Vec2::splat(side), Sense::click());
        response.widget_info(|| eframe::egui::WidgetInfo::labeled(eframe::egui::Role::Button, true, says));
        let visuals = ui.style().interact(&response);
        let fill = if large { ui.visuals().selection.bg_fill } else { visuals.weak_bg_fill };
        ui.painter().circle_filled(rect.center(), 0.5 * side, fill);
        if response.hovered() {
            ui.painter().circle_stroke(
                rect.center(),
                0.5 * side - 0.5,
                Stroke::new(1.0, ui.visuals().weak_text_color()),
            );
        }
        let color = if large { ui.visuals().selection.stroke.color } else { visuals.fg_stroke.color };
        self.draw(ui.painter(), rect.shrink(side * 0.32), color);
        response.on_hover_text(says)
    }

    fn draw(self, painter: &Painter, rect: Rect, color: Color32) {
        let at = |x: f32, y: f32| rect.min + rect.size() * vec2(x, y);
        let triangle = |corners: [Pos2; 3]| painter.add(Shape::convex_polygon(corners.to_vec(), color, Stroke::NONE));
        let bar =
            |x: f32, width: f32| painter.rect_filled(Rect::from_min_max(at(x, 0.0), at(x + width, 1.0)), 1.0, color);
        match self {
            Self::Run => _ = triangle([at(0.1, -0.1), at(1.1, 0.5), at(0.1, 1.1)]),
            Self::Pause => _ = (bar(0.08, 0.3), bar(0.62, 0.3)),
            Self::Step => _ = (triangle([at(0.0, 0.0), at(0.75, 0.5), at(0.0, 1.0)]), bar(0.82, 0.18)),
            Self::Back => _ = (triangle([at(1.0, 0.0), at(0.25, 0.5), at(1.0, 1.0)]), bar(0.0, 0.18)),
            Self::Key => {
                let corners = [at(0.5, -0.15), at(1.15, 0.5), at(0.5, 1.15), at(-0.15, 0.5)];
                painter.add(Shape::closed_line(corners.to_vec(), Stroke::new(1.6, color)));
            }
            Self::Restart => {
                let (center, radius) = (rect.center(), 0.55 * rect.width());
                let around = |k: usize| {
                    let (sin, cos) = (-0.9 + k as f32 * 5.0 / 24.0).sin_cos();
                    pos2(center.x + radius * cos, center.y + radius * sin)
                };
                painter.add(Shape::line((0..=24).map(around).collect(), Stroke::new(1.6, color)));
                let tip = around(0);
                triangle([tip + vec2(-1.0, -3.6), tip + vec2(2.4, 2.4), tip + vec2(-4.2, 1.6)]);
            }
        }
    }
}
