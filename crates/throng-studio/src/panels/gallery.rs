//! The gallery: the scenes of the project and of plug-ins by topics, and what the open scene says to viewers. The search
//! covers names, titles and texts.

use super::thumbnails::Thumbnails;
use super::tile::{Tile, tiles, tiles_height};
use super::topics::{TOPICS, Topic, sections};
use super::words;
use eframe::egui::{CollapsingHeader, Key, RichText, Role, ScrollArea, TextEdit, Ui, WidgetInfo};
use std::sync::Arc;
use throng_scene::{About, Plugins};

/// The least width of a tile, points.
const TILE: f32 = 104.0;
/// The least width of the card of a topic, points.
const CARD: f32 = 160.0;

/// The panel of the gallery.
#[derive(Default)]
pub struct Gallery {
    /// The search text.
    pub search: String,
    /// The scene that was open last.
    open: String,
    thumbnails: Thumbnails,
}

impl Gallery {
    /// Shows the gallery. `open` is the name of the open scene, `about` what it says to viewers. Returns the name of the
    /// scene to open.
    pub fn ui(&mut self, ui: &mut Ui, plugins: &Arc<Plugins>, open: &str, about: &About) -> Option<String> {
        // a scene that was opened elsewhere is not to be hidden
        if self.open != open && !self.open.is_empty() && !finds(plugins, open, &self.search) {
            self.search.clear();
        }
        open.clone_into(&mut self.open);
        let mut asked = None;
        let entered = self.field(ui);
        let all = sections(plugins).into_iter();
        let sections: Vec<(&str, Vec<&str>)> = all
            .map(|(title, names)| {
                (title, names.into_iter().filter(|name| finds(plugins, name, &self.search)).collect())
            })
            .filter(|(_, names): &(_, Vec<_>)| !names.is_empty())
            .collect();
        if sections.is_empty() {
            ui.label(format!("No scene has all words of “{}” in its name, title or text.", self.search.trim()));
        }
        if entered {
            asked = sections.first().and_then(|(_, names)| names.first()).map(|&name| name.to_owned());
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if about.texts().next().is_some() {
                let title = RichText::new(plugins.title(open).unwrap_or(open)).strong();
                let header =
                    CollapsingHeader::new(title).id_salt("about").default_open(true).show_unindented(ui, |ui| {
                        words(ui, about, &["see", "look_for", "try"]);
                    });
                header.header_response.on_hover_text("what the open scene shows");
            }
            for (section, names) in sections {
                CollapsingHeader::new(RichText::new(section).strong()).default_open(true).show_unindented(ui, |ui| {
                    asked = asked.take().or(self.scenes(ui, plugins, &names, open));
                });
            }
        });
        asked
    }

    /// Shows the search field and the button that clears it. Returns whether the user pressed Enter.
    fn field(&mut self, ui: &mut Ui) -> bool {
        let field = ui.horizontal(|ui| {
            let clear = if self.search.is_empty() { 0.0 } else { 58.0 };
            let width = ui.available_width() - clear;
            let field = ui.add(TextEdit::singleline(&mut self.search).hint_text("search").desired_width(width));
            field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, "search"));
            if clear > 0.0 && ui.button("Clear").on_hover_text("show all scenes").clicked() {
                self.search.clear();
            }
            field
        });
        ui.add_space(4.0);
        field.inner.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter))
    }

    /// Shows tiles of scenes. Returns the name of the clicked one.
    pub fn scenes(&mut self, ui: &mut Ui, plugins: &Arc<Plugins>, names: &[&str], open: &str) -> Option<String> {
        let tile = |&scene| {
            let title = plugins.title(scene).unwrap_or(scene);
            Tile { scene, title, says: "", open: scene == open }
        };
        let all: Vec<Tile<'_>> = names.iter().map(tile).collect();
        tiles(ui, TILE, &all, &mut self.thumbnails, plugins).map(|k| names[k].to_owned())
    }

    /// Shows a card for each of [`TOPICS`]. Returns the index of the clicked one.
    pub fn topics(&mut self, ui: &mut Ui, plugins: &Arc<Plugins>) -> Option<usize> {
        let all = TOPICS.map(|Topic { title, says, first, .. }| Tile { scene: first, title, says, open: false });
        tiles(ui, CARD, &all, &mut self.thumbnails, plugins)
    }
}

/// Returns the height of the cards of all topics in this width.
pub fn cards_height(ui: &Ui, width: f32) -> f32 {
    tiles_height(ui, width, CARD, TOPICS.len(), 2)
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
    use throng_scene::gallery;

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
