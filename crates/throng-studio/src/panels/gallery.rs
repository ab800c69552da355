//! The gallery: every scene that comes with the project, by group; search finds names, titles and texts.

use eframe::egui::{CollapsingHeader, Key, Response, RichText, ScrollArea, TextEdit, Ui};
use throng_scene::gallery;

/// The gallery's panel.
#[derive(Clone, Debug, Default)]
pub struct Gallery {
    /// What is searched for.
    pub search: String,
}

impl Gallery {
    /// Shows the gallery, where `open` is the name of the scene that is open; the name of the one that is asked for.
    pub fn ui(&mut self, ui: &mut Ui, open: &str) -> Option<&'static str> {
        let mut asked = None;
        let search = ui.add(TextEdit::singleline(&mut self.search).hint_text("search").desired_width(f32::INFINITY));
        let entered = search.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        ui.add_space(4.0);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for (group, names) in gallery::groups() {
                let found: Vec<&'static str> = names.filter(|name| self.finds(name)).collect();
                if found.is_empty() {
                    continue;
                }
                if entered && asked.is_none() {
                    asked = found.first().copied();
                }
                CollapsingHeader::new(RichText::new(group).strong()).default_open(true).show(ui, |ui| {
                    for name in found {
                        if entry(ui, name, name == open).clicked() {
                            asked = Some(name);
                        }
                    }
                });
            }
        });
        asked
    }

    /// Whether a scene has every word that is searched for.
    fn finds(&self, name: &str) -> bool {
        let title = gallery::title(name).unwrap_or_default().to_lowercase();
        let text = gallery::text(name).unwrap_or_default().to_lowercase();
        let words = self.search.to_lowercase();
        words.split_whitespace().all(|word| name.contains(word) || title.contains(word) || text.contains(word))
    }
}

fn entry(ui: &mut Ui, name: &'static str, open: bool) -> Response {
    let title = gallery::title(name).unwrap_or(name);
    let response = ui.selectable_label(open, name);
    response.on_hover_text(title)
}

/// The scene of the gallery that comes `by` places after the one of this name; the first after the last.
pub fn beside(name: &str, by: isize) -> Option<&'static str> {
    let names: Vec<&'static str> = gallery::names().collect();
    let now = names.iter().position(|&known| known == name);
    let next = now.map_or(0, |now| (now as isize + by).rem_euclid(names.len() as isize) as usize);
    names.get(next).copied()
}
