//! The velocity space of the selected agent: the figure of `throng explain`, updated live.

use super::NARROW;
use crate::play::RunMoment;
use crate::settings::Settings;
use eframe::egui::{
    Align2, ColorImage, Context, Id, Pos2, Rect, TextureHandle, TextureOptions, Ui, Vec2, Window, vec2,
};
use std::sync::Arc;
use throng::Explanation;
use throng_draw::{Figure, Style, Typeface};

/// The first size of the figure, points of the screen.
const SIZE: Vec2 = vec2(780.0, 640.0);
/// The size of its letters, points of the screen. The smallest, of numbers, have 0.85 of it: 14 points.
const LETTERS: f32 = 16.5;
/// The size of the frame of the window around the figure, points of the screen.
const FRAME: Vec2 = vec2(14.0, 48.0);
/// The distance that the window keeps from the agent and from the edge of the view, points of the screen.
const MARGIN: f32 = 14.0;

/// The window of the figure.
#[derive(Default)]
pub struct ExplanationWindow {
    drawn: Option<Drawn>,
    /// The rectangle of the window in the last frame.
    rect: Option<Rect>,
}

/// A drawn figure, and what it was drawn for.
struct Drawn {
    why: Arc<Explanation>,
    dark: bool,
    /// Width and height, pixels.
    size: [u32; 2],
    texture: TextureHandle,
}

/// What the window explains.
#[derive(Clone, Copy, Debug)]
pub struct Explained<'a> {
    /// The shown moment.
    pub shown: &'a RunMoment,
    /// The selected agent.
    pub selected: Option<u32>,
    /// The position of the selected agent on the screen.
    pub at: Option<Pos2>,
    /// The rectangle of the view.
    pub view: Rect,
    /// The settings of the user.
    pub settings: &'a Settings,
    /// The typeface of the figure.
    pub typeface: &'a Typeface,
}

impl ExplanationWindow {
    /// Shows the window while it is `open`. Returns whether the user lets the studio choose an agent.
    pub fn ui(&mut self, ctx: &Context, open: &mut bool, of: &Explained<'_>) -> bool {
        if !*open {
            self.rect = None;
            return false;
        }
        let title = match of.selected {
            Some(number) => format!("Why agent {number} moves as it does"),
            None => "Why an agent moves as it does".into(),
        };
        let window = Window::new(title).id(Id::unique("why")).open(open).resizable(true);
        let window = match self.place(ctx, of) {
            Some(place) => window.current_pos(place.min).default_size(place.size() - FRAME),
            None => window,
        };
        let shown = window.show(ctx, |ui| self.content(ui, of));
        self.rect = shown.as_ref().map(|shown| shown.response.rect);
        shown.and_then(|shown| shown.inner).unwrap_or_default()
    }

    /// Returns a new place for the window if it has none, or if it covers the agent: beside, below or above the agent,
    /// where it has the most room. It may cover panels.
    fn place(&self, ctx: &Context, of: &Explained<'_>) -> Option<Rect> {
        let covers = |rect: Rect| of.at.is_some_and(|at| rect.expand(MARGIN).contains(at));
        // the user may be moving the window
        if self.rect.is_some_and(|rect| !covers(rect)) || ctx.input(|input| input.pointer.any_down()) {
            return None;
        }
        let size = self.rect.map_or(SIZE + FRAME, |rect| rect.size());
        let screen = ctx.content_rect();
        // on a phone, the view alone is too low
        let high = if screen.width() < NARROW { screen.y_range() } else { of.view.y_range() };
        let room = Rect::from_x_y_ranges(screen.x_range(), high).shrink(0.5 * MARGIN);
        let at = of.at.unwrap_or(room.left_bottom());
        let [before, after] = [at - Vec2::splat(MARGIN + 1.0), at + Vec2::splat(MARGIN + 1.0)];
        let sides = [
            (room.with_min_x(after.x), Align2::RIGHT_TOP),
            (room.with_max_x(before.x), Align2::LEFT_TOP),
            (room.with_min_y(after.y), Align2::RIGHT_BOTTOM),
            (room.with_max_y(before.y), Align2::RIGHT_TOP),
        ];
        let fit = |side: &(Rect, Align2)| (side.0.size() / size).min_elem().min(1.0);
        let best = sides.into_iter().reduce(|best, next| if fit(&next) > fit(&best) { next } else { best });
        best.map(|(side, corner)| corner.align_size_within_rect(size.min(side.size()).max(Vec2::ZERO), side))
    }

    fn content(&mut self, ui: &mut Ui, of: &Explained<'_>) -> bool {
        let (shown, selected) = (of.shown, of.selected);
        if shown.reel.is_some() {
            ui.label("A file of trajectories has no decisions: only agents of a scene can be explained.");
            return false;
        }
        let Some(number) = selected else {
            ui.label("Select an agent: click it in the view, or press S.");
            return ui.button("Explain an agent").clicked();
        };
        match shown.explanation.as_ref().filter(|why| why.number == number) {
            Some(why) => self.figure(ui, why, of),
            None if shown.frame.bodies.iter().any(|body| body.number == number) => _ = ui.label("…"),
            None => _ = ui.label(format!("Agent {number} is not in the scene at this time.")),
        }
        false
    }

    fn figure(&mut self, ui: &mut Ui, why: &Arc<Explanation>, of: &Explained<'_>) {
        // no larger than the screen of a phone
        let least = (SIZE * 0.6).min(of.view.size() - FRAME - Vec2::splat(MARGIN)).max(Vec2::splat(1.0));
        let (room, unit, dark) = (ui.available_size().max(least), ui.ctx().pixels_per_point(), of.settings.dark);
        let size = [room.x, room.y].map(|side| (side * unit) as u32);
        let same = |old: &Drawn| Arc::ptr_eq(&old.why, why) && old.dark == dark && old.size == size;
        if !self.drawn.as_ref().is_some_and(same) {
            let texture = image(why, size, LETTERS * unit, of)
                .map(|image| ui.ctx().load_texture("why", image, TextureOptions::LINEAR));
            self.drawn = texture.map(|texture| Drawn { why: why.clone(), dark, size, texture });
        }
        if let Some(Drawn { texture, .. }) = &self.drawn {
            ui.image((texture.id(), room));
        }
    }
}

fn image(why: &Explanation, [width, height]: [u32; 2], letters: f32, of: &Explained<'_>) -> Option<ColorImage> {
    let typeface = of.typeface.clone();
    let style = Style { width, height, typeface, theme: of.settings.theme(), ..Style::said(&of.shown.scene) };
    let figure = Figure::explain_in_letters(&of.shown.setting, &of.shown.frame, why, &style, letters);
    let image = figure.ok()?.image();
    let size = [image.width() as usize, image.height() as usize];
    Some(ColorImage::from_rgba_unmultiplied(size, image.data()))
}
