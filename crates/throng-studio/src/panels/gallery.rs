//! The gallery: the scenes of the project and of plug-ins, in groups, and what the open scene says to viewers. The search
//! covers names, titles and texts.

use super::thumbnails::Thumbnails;
use super::words;
use eframe::egui::text::{LayoutJob, TextWrapping};
use eframe::egui::{
    CollapsingHeader, CornerRadius, FontId, Key, Rect, Response, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind,
    TextEdit, Ui, WidgetInfo, pos2, vec2,
};
use std::sync::Arc;
use throng_scene::{About, Plugins, gallery};

/// The width of a tile, points of the screen, and the aspect ratio (width over height) of its picture.
const TILE: f32 = 99.0;
const ASPECT: f32 = 1.5;

/// The panel of the gallery.
#[derive(Default)]
pub struct Gallery {
    /// The search text.
    pub search: String,
    thumbnails: Thumbnails,
}

impl Gallery {
    /// Shows the gallery. `open` is the name of the open scene, `about` what it says to viewers. Returns the name of the
    /// scene to open.
    pub fn ui(&mut self, ui: &mut Ui, plugins: &Arc<Plugins>, open: &str, about: &About) -> Option<String> {
        let mut asked = None;
        let search = ui.add(TextEdit::singleline(&mut self.search).hint_text("search").desired_width(f32::INFINITY));
        search.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, "search"));
        let entered = search.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        ui.add_space(4.0);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if about.texts().next().is_some() {
                let title = RichText::new(plugins.title(open).unwrap_or(open)).strong();
                let header =
                    CollapsingHeader::new(title).id_salt("about").default_open(true).show_unindented(ui, |ui| {
                        words(ui, about, &["see", "look_for", "try"]);
                    });
                header.header_response.on_hover_text("what the open scene shows");
            }
            let papers = gallery::papers().iter().map(|&(name, _)| name).collect();
            for (group, names) in plugins.groups().into_iter().chain([(gallery::PAPERS, papers)]) {
                let found: Vec<&str> = names.into_iter().filter(|name| finds(plugins, name, &self.search)).collect();
                if found.is_empty() {
                    continue;
                }
                if entered && asked.is_none() {
                    asked = found.first().map(|&name| name.to_owned());
                }
                CollapsingHeader::new(RichText::new(group).strong()).default_open(true).show_unindented(ui, |ui| {
                    ui.horizontal_wrapped(|ui| {
                        ui.spacing_mut().item_spacing = vec2(6.0, 6.0);
                        for name in found {
                            if self.tile(ui, plugins, name, name == open).clicked() {
                                asked = Some(name.to_owned());
                            }
                        }
                    });
                });
            }
        });
        asked
    }

    fn tile(&mut self, ui: &mut Ui, plugins: &Arc<Plugins>, name: &str, open: bool) -> Response {
        let title = plugins.title(name).unwrap_or(name);
        let picture = vec2(TILE, TILE / ASPECT);
        let (rect, response) = ui.allocate_exact_size(picture + vec2(0.0, 17.0), Sense::click());
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, open, title));
        if ui.is_rect_visible(rect) {
            let (visuals, painter) = (ui.visuals(), ui.painter());
            let frame = Rect::from_min_size(rect.min, picture);
            painter.rect_filled(frame, CornerRadius::same(4), visuals.faint_bg_color);
            if let Some(texture) = self.thumbnails.of(name, plugins, ui.ctx()) {
                let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                painter.image(texture.id(), frame, whole, eframe::egui::Color32::WHITE);
            }
            let edge = match (open, response.hovered()) {
                (true, _) => Stroke::new(2.0, visuals.hyperlink_color),
                (false, true) => Stroke::new(1.0, visuals.text_color()),
                (false, false) => visuals.window_stroke,
            };
            painter.rect_stroke(frame, CornerRadius::same(4), edge, StrokeKind::Outside);
            let color = if open { visuals.text_color() } else { visuals.weak_text_color() };
            let at = frame.left_bottom() + vec2(1.0, 3.0);
            let mut line = LayoutJob::simple_singleline(title.to_owned(), FontId::proportional(11.0), color);
            line.wrap = TextWrapping::truncate_at_width(TILE);
            painter.galley(at, painter.layout_job(line), color);
        }
        response.on_hover_text(format!("{title} ({name})"))
    }
}

/// Whether a scene contains every word of the search.
fn finds(plugins: &Plugins, name: &str, search: &str) -> bool {
    let words = search.to_lowercase();
    let title = plugins.title(name).unwrap_or_default().to_lowercase();
    let text = || plugins.text(name).unwrap_or_default().to_lowercase();
    words.split_whitespace().all(|word| name.contains(word) || title.contains(word) || text().contains(word))
}

/// Returns the scene `by` places after the named one. The list wraps around.
pub fn beside(plugins: &Plugins, name: &str, by: isize) -> Option<String> {
    let names = plugins.names();
    let now = names.iter().position(|&known| known == name);
    let next = now.map_or(0, |now| (now as isize + by).rem_euclid(names.len() as isize) as usize);
    names.get(next).map(|&name| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_found_wherever_they_stand() {
        let finds = |search| finds(&Plugins::new(), "circle", search);
        assert!(finds("ring 36") && finds("CIRC") && finds("") && !finds("drones"));
    }

    #[test]
    fn after_the_last_comes_the_first() {
        let beside = |name, by| beside(&Plugins::new(), name, by).unwrap();
        let last = gallery::names().last().unwrap();
        assert_eq!((beside(last, 1).as_str(), beside("columns", -1).as_str()), ("columns", last));
        assert_eq!(beside("a file", 1), "columns");
    }
}
