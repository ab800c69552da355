//! The keys of the scene's camera, as marks above the timeline.

use eframe::egui::{
    Color32, CursorIcon, Id, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2,
};
use throng_scene::CameraKey;

/// Half the size of a mark, points.
const SIZE: f32 = 5.0;
/// The height of the marks, in heights of a button.
const HEIGHT: f32 = 0.75;

/// A request about the keys of the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CameraRequest {
    /// Makes the view a key at the shown time.
    Key,
    /// Goes to the time of a key.
    Seek(usize),
    /// Goes to the time of a key, and to its camera.
    Look(usize),
    /// Makes the view the camera of a key.
    Replace(usize),
    /// Makes the film cut to a key, or move to it.
    Cut(usize),
    /// Removes a key.
    Remove(usize),
    /// Moves a key to a time, seconds.
    Move(usize, f64),
}

/// The place of the marks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rail {
    /// The rectangle, from the first to the last step.
    pub place: Rect,
    /// The length of a step, seconds.
    pub step: f64,
    /// The last step.
    pub last: u64,
}

impl Rail {
    fn x(&self, time: f64) -> f32 {
        let share = (time / self.step / self.last as f64).clamp(0.0, 1.0);
        self.place.left() + self.place.width() * share as f32
    }

    /// Returns the time of the step at a place, seconds.
    fn time(&self, x: f32) -> f64 {
        let share = ((x - self.place.left()) / self.place.width().max(1.0)).clamp(0.0, 1.0);
        (f64::from(share) * self.last as f64).round() * self.step
    }

    fn end(&self) -> f64 {
        self.last as f64 * self.step
    }
}

/// Allocates the place above the timeline.
pub(super) fn lane(ui: &mut Ui) -> Rect {
    let height = HEIGHT * ui.spacing().interact_size.y;
    ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover()).0
}

/// Shows the keys. `now` is the shown time, seconds.
pub(super) fn camera_keys(ui: &Ui, rail: &Rail, keys: &[CameraKey], now: f64) -> Option<CameraRequest> {
    let mut asked = None;
    let middle = rail.place.center().y;
    let visuals = ui.visuals();
    // lines join the keys of a shot
    for pair in keys.windows(2).filter(|pair| !pair[1].cut) {
        let line = [pair[0].time, pair[1].time].map(|time| pos2(rail.x(time), middle));
        ui.painter().line_segment(line, Stroke::new(1.0, visuals.weak_text_color()));
    }
    for (k, key) in keys.iter().enumerate() {
        let place = Rect::from_center_size(pos2(rail.x(key.time), middle), vec2(2.4 * SIZE, rail.place.height()));
        let response = ui.interact(place, Id::unique(("camera key", k)), Sense::click_and_drag());
        let name = format!("camera key at {:.2} s", key.time);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
        let dragged = response.interact_pointer_pos().map(|at| rail.time(at.x));
        let dragged = dragged.filter(|_| response.dragged() || response.drag_stopped());
        let time = dragged.unwrap_or(key.time);
        let color = match (time - now).abs() < 0.5 * rail.step {
            true => visuals.hyperlink_color,
            false if response.hovered() || dragged.is_some() => visuals.strong_text_color(),
            false if key.time > rail.end() => visuals.weak_text_color(),
            false => visuals.text_color(),
        };
        mark(ui.painter(), pos2(rail.x(time), middle), key.cut, color);
        if let Some(time) = dragged {
            response.show_tooltip_text(format!("{time:.2} s"));
            if response.drag_stopped() && (time - key.time).abs() > 0.5 * rail.step {
                asked = Some(CameraRequest::Move(k, time));
            }
        }
        if response.clicked() {
            asked = Some(CameraRequest::Seek(k));
        }
        response.context_menu(|ui| asked = asked.or(menu(ui, k, key)));
        let cut = if key.cut { ", after a cut" } else { "" };
        let says = format!("{name}{cut}: click to go there, drag to another time, right click for more");
        response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text(says);
    }
    asked
}

/// Shows the menu of a key.
fn menu(ui: &mut Ui, k: usize, key: &CameraKey) -> Option<CameraRequest> {
    let cut = if key.cut { "Move to it" } else { "Cut before it" };
    let all = [
        ("Look from here", "go to its time and its camera", CameraRequest::Look(k)),
        ("Replace by the present camera", "the key has the camera of the view then", CameraRequest::Replace(k)),
        (cut, "whether the film cuts to this key, or moves to it from the key before", CameraRequest::Cut(k)),
        ("Remove", "remove the key", CameraRequest::Remove(k)),
    ];
    let clicked = all.into_iter().filter(|(label, says, _)| ui.button(*label).on_hover_text(*says).clicked());
    clicked.last().map(|(.., request)| request)
}

/// Draws a diamond; behind a cut, its right half with a line.
fn mark(painter: &Painter, at: Pos2, cut: bool, color: Color32) {
    let left = if cut { 0.0 } else { -SIZE };
    let corners = [vec2(0.0, -SIZE), vec2(SIZE, 0.0), vec2(0.0, SIZE), vec2(left, 0.0)];
    painter.add(Shape::convex_polygon(corners.map(|corner| at + corner).to_vec(), color, Stroke::NONE));
    if cut {
        let x = at.x - 1.5;
        painter.line_segment([pos2(x, at.y - SIZE - 1.0), pos2(x, at.y + SIZE + 1.0)], Stroke::new(1.5, color));
    }
}
