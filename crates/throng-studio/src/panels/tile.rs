//! A picture of a scene with its title, to click.

use super::thumbnails::Thumbnails;
use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    Color32, CornerRadius, Rect, Response, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo, pos2, vec2,
};
use std::sync::Arc;
use throng_scene::Plugins;

/// The aspect ratio of the picture, width over height.
const ASPECT: f32 = 1.5;
/// The gap between tiles, and between the picture and its title, points.
const GAP: f32 = 6.0;

/// A tile.
pub struct Tile<'a> {
    /// The scene of the picture.
    pub scene: &'a str,
    /// The text under the picture.
    pub title: &'a str,
    /// A second, pale text. Empty for none.
    pub says: &'a str,
    /// Whether the scene is open.
    pub open: bool,
}

impl Tile<'_> {
    /// Shows the tile with this width.
    pub fn ui(&self, ui: &mut Ui, width: f32, thumbnails: &mut Thumbnails, plugins: &Arc<Plugins>) -> Response {
        let color = if self.open { ui.visuals().hyperlink_color } else { ui.visuals().text_color() };
        let title = text(ui, self.title, color, width);
        let says = (!self.says.is_empty()).then(|| text(ui, self.says, ui.visuals().weak_text_color(), width));
        let words = title.size().y + says.as_ref().map_or(0.0, |says| says.size().y);
        let picture = vec2(width, width / ASPECT);
        let (rect, response) = ui.allocate_exact_size(picture + vec2(0.0, words + 0.5 * GAP), Sense::click());
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, self.open, self.title));
        if ui.is_rect_visible(rect) {
            let (visuals, painter) = (ui.visuals(), ui.painter());
            let frame = Rect::from_min_size(rect.min, picture);
            painter.rect_filled(frame, CornerRadius::same(4), visuals.faint_bg_color);
            if let Some(texture) = thumbnails.of(self.scene, plugins, ui.ctx()) {
                let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                painter.image(texture.id(), frame, whole, Color32::WHITE);
            }
            let edge = match (self.open || response.has_focus(), response.hovered()) {
                (true, _) => Stroke::new(2.0, visuals.hyperlink_color),
                (false, true) => Stroke::new(1.0, visuals.text_color()),
                (false, false) => visuals.window_stroke,
            };
            painter.rect_stroke(frame, CornerRadius::same(4), edge, StrokeKind::Outside);
            let at = frame.left_bottom() + vec2(1.0, 0.5 * GAP);
            let below = at + vec2(0.0, title.size().y);
            painter.galley(at, title, color);
            says.into_iter().for_each(|says| painter.galley(below, says, color));
        }
        response
    }
}

/// Shows tiles in rows over the whole width, each at least `least` wide. Returns the index of the clicked one.
pub fn tiles(
    ui: &mut Ui,
    least: f32,
    all: &[Tile<'_>],
    thumbnails: &mut Thumbnails,
    plugins: &Arc<Plugins>,
) -> Option<usize> {
    let (columns, width) = columns(ui.available_width(), least, all.len());
    let mut clicked = None;
    ui.spacing_mut().item_spacing = Vec2::splat(GAP);
    for (row, line) in all.chunks(columns).enumerate() {
        ui.horizontal_top(|ui| {
            for (k, tile) in line.iter().enumerate() {
                let response = tile.ui(ui, width, thumbnails, plugins);
                if response.has_focus() {
                    response.scroll_to_me(None);
                }
                if response.on_hover_text(format!("{} ({})", tile.title, tile.scene)).clicked() {
                    clicked = Some(row * columns + k);
                }
            }
        });
    }
    clicked
}

/// Returns the height of this many tiles in rows of the width `whole`, with a title and `lines` lines below it.
pub fn tiles_height(ui: &Ui, whole: f32, least: f32, count: usize, lines: usize) -> f32 {
    let (columns, width) = columns(whole, least, count);
    let line = ui.text_style_height(&TextStyle::Body);
    count.div_ceil(columns) as f32 * (width / ASPECT + (lines + 1) as f32 * line + 1.5 * GAP)
}

/// Returns the number of columns, and the width of a tile. Fewer tiles than columns stay small.
fn columns(whole: f32, least: f32, count: usize) -> (usize, f32) {
    let columns = (((whole + GAP) / (least + GAP)).floor() as usize).clamp(1, count.max(1));
    (columns, ((whole + GAP) / columns as f32 - GAP).min(2.0 * least))
}

/// Lays out a text in at most two lines.
fn text(ui: &Ui, text: &str, color: Color32, width: f32) -> Arc<eframe::egui::Galley> {
    let font = TextStyle::Body.resolve(ui.style());
    let mut job = LayoutJob::simple(text.to_owned(), font, color, width);
    job.wrap = TextWrapping { max_rows: 2, ..TextWrapping::wrap_at_width(width) };
    ui.painter().layout_job(job)
}
