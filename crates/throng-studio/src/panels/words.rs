//! What a scene says to viewers.

use eframe::egui::{RichText, Ui};
use throng_scene::About;

/// Shows texts of a scene, each under its key.
pub fn words(ui: &mut Ui, about: &About, keys: &[&str]) {
    for (key, text) in about.texts().filter(|(key, _)| keys.contains(key)) {
        ui.label(RichText::new(key.replace('_', " ")).strong());
        ui.label(text);
    }
}
