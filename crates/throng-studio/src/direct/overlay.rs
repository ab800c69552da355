//! Drawing over the view while the scene is edited: handles, outlines and the gesture under way.

use super::fields::AHEAD;
use super::parts::{Handle, Look, OutlineKind, Parts};
use super::{DirectedWorld, Director, Event, Gesture, REACH, Snap, Tool};
use crate::document::Document;
use crate::style::color;
use crate::view::ground;
use eframe::egui::{self, CursorIcon, vec2};
use eframe::egui::{Align2, FontId, Key, Painter, Pos2, Rect, Response, Shape, Stroke, Ui};
use glam::{DVec2, Vec2};
use throng_draw::{Color, Projector, Theme};
use throng_scene::Scene;

/// The most handles drawn. More would be too dense to take with the pointer.
const MANY: usize = 3000;

/// The projection and colours of the view.
#[derive(Clone, Copy)]
pub struct Sight<'a> {
    /// The projection from the world to the view.
    pub projector: &'a Projector,
    /// The colours.
    pub theme: &'a Theme,
}

impl Director {
    /// Handles input in the view of `response` and draws over it. Returns whether the document was edited.
    ///
    /// # Errors
    /// As [`Director::point`].
    pub fn ui(
        &mut self,
        ui: &Ui,
        response: &Response,
        document: &mut Document,
        mut stage: DirectedWorld<'_>,
        sight: Sight<'_>,
    ) -> Result<bool, String> {
        if self.tool == Tool::Hand {
            return Ok(false);
        }
        let rect = response.rect;
        let pointer = response.interact_pointer_pos().or(response.hover_pos());
        let at = pointer.and_then(|at| ground(sight.projector, Vec2::new(at.x - rect.min.x, at.y - rect.min.y)));
        let mut edited = Ok(false);
        if let Some(at) = at {
            stage.scale = sight.projector.scale(at.extend(0.0)).max(1e-6);
            let (pressed, released, enter) = ui.input(|input| {
                let pointer = &input.pointer;
                (pointer.primary_pressed(), pointer.primary_released(), input.key_pressed(Key::Enter))
            });
            self.type_size(ui);
            let (straight, free) = ui.input(|input| (input.modifiers.shift, input.modifiers.alt));
            let at = self.aim(document, at, (straight, free), stage.scale);
            let typed = self.gesture.as_ref().is_some_and(|gesture| !gesture.typed.is_empty());
            // a typed corner is a click there, and the size of a drag ends it
            let by_enter = match (typed, self.tool.clicks()) {
                (true, true) => Event::Press,
                (true, false) => Event::Release,
                (false, _) => Event::Finish,
            };
            let events = [
                (pressed && response.contains_pointer(), Event::Press),
                (true, Event::Move),
                (released, Event::Release),
                (enter, by_enter),
            ];
            for (_, event) in events.into_iter().filter(|(happens, _)| *happens) {
                if let Some(done) = Some(self.point(document, at, event, stage)).filter(|done| *done != Ok(false)) {
                    edited = done;
                }
            }
            ui.ctx().set_cursor_icon(if self.tool == Tool::Select {
                CursorIcon::Default
            } else {
                CursorIcon::Crosshair
            });
        }
        self.draw(&ui.painter_at(rect), rect, document, at, stage, sight);
        edited
    }

    /// Takes what the user types as the size of the gesture. Escape cancels the gesture.
    fn type_size(&mut self, ui: &Ui) {
        if !self.takes_numbers() {
            return;
        }
        let (typed, back, leave) = ui.input(|input| {
            let typed = input.events.iter().filter_map(|event| match event {
                egui::Event::Text(text) => Some(text.as_str()),
                _ => None,
            });
            (typed.collect::<String>(), input.key_pressed(Key::Backspace), input.key_pressed(Key::Escape))
        });
        self.write(&typed, back);
        if leave {
            self.cancel();
        }
    }

    fn draw(
        &self,
        painter: &Painter,
        rect: Rect,
        document: &Document,
        at: Option<DVec2>,
        stage: DirectedWorld<'_>,
        sight: Sight<'_>,
    ) {
        let Ok(scene) = document.scene() else { return };
        let pen = Pen { painter, rect, sight, stage };
        let preview = self.gesture.as_ref().map(|gesture| {
            document.preview(|edit| self.apply(edit, scene, gesture, stage).map(drop)).map_err(|says| (gesture, says))
        });
        match preview {
            None => pen.parts(self, scene, at),
            Some(Ok(scene)) => pen.parts(self, &scene, None),
            Some(Err((gesture, says))) => {
                pen.parts(self, scene, None);
                // an outline drawn click by click is no error before it is complete
                if !self.tool.clicks() && gesture.dragged(stage.scale) {
                    pen.says(gesture.at, says.lines().next().unwrap_or_default());
                }
            }
        }
        if let Some((at, snap)) = self.snap.filter(|_| self.tool.snaps()) {
            pen.snap(at, snap);
        }
        if let Some(gesture) = &self.gesture {
            pen.gesture(self, gesture);
        } else if let Some(at) = at.filter(|_| self.tool.brushes()) {
            pen.round(at, self.brush.radius, pen.sight.theme.palette[0]);
        }
    }
}

/// Draws in world coordinates.
struct Pen<'a> {
    painter: &'a Painter,
    rect: Rect,
    sight: Sight<'a>,
    stage: DirectedWorld<'a>,
}

impl Pen<'_> {
    fn at(&self, point: DVec2) -> Option<Pos2> {
        let pixel = self.sight.projector.pixel(point.extend(0.0))?;
        Some(self.rect.min + vec2(pixel.x, pixel.y))
    }

    fn line(&self, points: &[DVec2], closed: bool, stroke: Stroke) {
        let mut line: Vec<Pos2> = points.iter().filter_map(|&point| self.at(point)).collect();
        if closed {
            line.extend(line.first().copied());
        }
        self.painter.add(Shape::line(line, stroke));
    }

    fn round(&self, at: DVec2, radius: f64, tone: Color) {
        let rim = |k: usize| at + DVec2::from_angle(k as f64 * std::f64::consts::TAU / 48.0) * radius;
        self.line(&(0..48).map(rim).collect::<Vec<_>>(), true, Stroke::new(1.2, color(tone.alpha(0.8))));
    }

    fn arrow(&self, from: DVec2, to: DVec2, stroke: Stroke) {
        let (Some(from), Some(to)) = (self.at(from), self.at(to)) else { return };
        let way = (to - from).normalized();
        self.painter.line_segment([from, to - way * 6.0], stroke);
        let tip = vec![to, to - way * 9.0 + way.rot90() * 4.0, to - way * 9.0 - way.rot90() * 4.0];
        self.painter.add(Shape::convex_polygon(tip, stroke.color, Stroke::NONE));
    }

    fn says(&self, at: DVec2, words: &str) {
        let Some(at) = self.at(at) else { return };
        let red = self.painter.ctx().global_style().visuals.error_fg_color;
        self.painter.text(at + vec2(14.0, -14.0), Align2::LEFT_BOTTOM, words, FontId::proportional(14.0), red);
    }

    fn parts(&self, director: &Director, scene: &Scene, pointer: Option<DVec2>) {
        let parts = Parts::of(scene);
        let theme = self.sight.theme;
        for outline in &parts.outlines {
            let (tone, width) = match outline.kind {
                OutlineKind::Place(g) => (theme.group(g).alpha(if g == director.group { 0.9 } else { 0.5 }), 1.2),
                OutlineKind::Obstacle => (theme.text.alpha(0.7), 1.4),
                OutlineKind::Goal => (theme.goal, 1.4),
                OutlineKind::Field => (theme.palette[0].alpha(0.75), 1.6),
            };
            let stroke = Stroke::new(width, color(tone));
            self.line(&outline.points, outline.closed, stroke);
            if let (OutlineKind::Field, false, [.., from, to]) =
                (outline.kind, outline.closed, outline.points.as_slice())
            {
                self.arrow(*from, *to, stroke);
            }
        }
        let hovered = pointer.filter(|_| director.tool == Tool::Select);
        let hovered = hovered.and_then(|at| parts.at(at, REACH / self.stage.scale)).map(|handle| handle.at);
        for handle in parts.handles.iter().take(MANY) {
            self.handle(handle, hovered == Some(handle.at));
        }
        if let Some(at) = director.selected.as_ref().and_then(|(at, _)| self.at(*at)) {
            self.painter.circle_stroke(at, 9.0, Stroke::new(2.0, color(self.sight.theme.palette[0])));
        }
    }

    fn handle(&self, handle: &Handle, hovered: bool) {
        let Some(at) = self.at(handle.at) else { return };
        let theme = self.sight.theme;
        let (fill, edge) = (color(theme.ground), Stroke::new(1.5, color(theme.text.alpha(0.85))));
        let more = if hovered { 1.5 } else { 0.0 };
        match handle.look {
            // not filled, so that the agent below remains visible
            Look::Dot if hovered => _ = self.painter.circle(at, 6.0, color(self.sight.theme.palette[0]), edge),
            Look::Dot => _ = self.painter.circle_stroke(at, 4.5, edge),
            Look::Corner => {
                let square = Rect::from_center_size(at, vec2(1.0, 1.0) * (7.0 + 2.0 * more));
                self.painter.rect(
                    square,
                    1.0,
                    if hovered { color(self.sight.theme.palette[0]) } else { fill },
                    edge,
                    egui::StrokeKind::Middle,
                );
            }
            Look::Arrow(from) => {
                self.arrow(from, handle.at, Stroke::new(2.2 + more, color(self.sight.theme.palette[0])));
            }
        }
    }

    /// Draws the gesture under way: the corners so far, the path of the brush, or a velocity.
    fn gesture(&self, director: &Director, gesture: &Gesture) {
        let stroke = Stroke::new(1.6, color(self.sight.theme.palette[0]));
        let start = gesture.points.first().copied().unwrap_or(gesture.at);
        match director.tool {
            Tool::Polygon | Tool::Wall => {
                let line: Vec<DVec2> = gesture.points.iter().copied().chain([gesture.at]).collect();
                self.line(&line, false, stroke);
                for at in gesture.points.iter().filter_map(|&at| self.at(at)) {
                    self.painter.circle_filled(at, 4.0, stroke.color);
                }
                let by = gesture.at - gesture.points.last().copied().unwrap_or(gesture.at);
                if by != DVec2::ZERO {
                    self.size(gesture, &format!("{:.2} m, {:.0}°", by.length(), by.to_angle().to_degrees()));
                }
            }
            Tool::Brush | Tool::Eraser => {
                let width = (2.0 * director.brush.radius * self.stage.scale) as f32;
                let tone =
                    if director.tool == Tool::Brush { self.sight.theme.palette[0] } else { self.sight.theme.text };
                self.line(&gesture.points, false, Stroke::new(width, color(tone.alpha(0.2))));
                self.round(gesture.at, director.brush.radius, tone);
            }
            Tool::Anchor => {
                let speed = gesture.by().length() / AHEAD;
                self.note(gesture.at, &format!("{speed:.2} m/s"));
            }
            Tool::Disc | Tool::Vortex | Tool::Source | Tool::Sink | Tool::Saddle => {
                self.line(&[start, gesture.at], false, Stroke::new(1.0, stroke.color));
                self.size(gesture, &format!("{:.2} m", gesture.by().length()));
            }
            Tool::Rectangle | Tool::Goal | Tool::Exit if gesture.dragged(self.stage.scale) => {
                let size = gesture.by().abs();
                self.size(gesture, &format!("{:.2} x {:.2} m", size.x, size.y));
            }
            _ => {}
        }
    }

    /// Writes the size of the gesture at the pointer, and what the user types.
    fn size(&self, gesture: &Gesture, size: &str) {
        match gesture.typed.as_str() {
            "" => self.note(gesture.at, size),
            typed => self.note(gesture.at, &format!("{typed}_   {size}")),
        }
    }

    /// Marks what the pointer has snapped to: a square around points, a cross on edges and the grid.
    fn snap(&self, at: DVec2, snap: Snap) {
        let Some(at) = self.at(at) else { return };
        let stroke = Stroke::new(1.5, color(self.sight.theme.palette[0]));
        match snap {
            Snap::Point => {
                let square = Rect::from_center_size(at, vec2(12.0, 12.0));
                self.painter.rect_stroke(square, 0.0, stroke, egui::StrokeKind::Middle);
            }
            Snap::Edge | Snap::Grid | Snap::Direction => {
                for half in [vec2(5.0, 0.0), vec2(0.0, 5.0)] {
                    self.painter.line_segment([at - half, at + half], stroke);
                }
            }
        }
    }

    fn note(&self, at: DVec2, words: &str) {
        let Some(at) = self.at(at) else { return };
        let tone = color(self.sight.theme.text);
        self.painter.text(at + vec2(14.0, 14.0), Align2::LEFT_TOP, words, FontId::proportional(14.0), tone);
    }
}
