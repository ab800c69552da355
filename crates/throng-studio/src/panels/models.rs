//! Comparison of two models: the choice of the second model, and the labels of the views.

use super::bar::named;
use crate::play::{RunMoment, models_of};
use eframe::egui::{Align2, ComboBox, FontId, Rect, RichText, Role, Ui};
use throng_scene::{Models, Scene};

/// Shows the choice of one of `models`, which runs beside the model of the scene. Returns whether it changed.
pub fn beside_by(ui: &mut Ui, models: &Models, model: &mut String) -> bool {
    let before = model.clone();
    let shown = if model.is_empty() { "one model" } else { model.as_str() };
    let combo = ComboBox::from_id_salt("beside").width(96.0).selected_text(shown).show_ui(ui, |ui| {
        ui.selectable_value(model, String::new(), "one model");
        for name in models.names() {
            ui.selectable_value(model, name.to_owned(), name);
        }
    });
    named(&combo.response, Role::ComboBox, "beside");
    combo.response.on_hover_text("runs the scene with a second model side by side, on the same clock");
    *model != before
}

/// Shows the time and the arrivals of one of two runs, and their differences from the `other` run.
pub fn figures_of_models(ui: &mut Ui, shown: &RunMoment, other: &RunMoment) {
    let (frame, against) = (&shown.frame, &other.frame);
    let ended = if shown.over { ", ended" } else { "" };
    ui.label(RichText::new(format!("{:.2} s{ended}", frame.time)).strong());
    ui.label(format!("{} of {} arrived", frame.arrived, frame.total));
    let differences = [
        difference(frame.arrived as f64 - against.arrived as f64, 0, "", ["more", "fewer"]),
        difference(frame.time - against.time, 2, " s", ["later", "sooner"]),
    ];
    let differences: Vec<String> = differences.into_iter().flatten().collect();
    if !differences.is_empty() {
        let says = format!("{} than {}", differences.join(", "), models_of(&other.scene));
        ui.label(RichText::new(says).weak());
    }
}

/// Returns a difference in words, `None` if there is none.
fn difference(by: f64, decimals: usize, unit: &str, [above, below]: [&str; 2]) -> Option<String> {
    let size = format!("{:.decimals$}", by.abs());
    let differs = size.contains(|digit: char| ('1'..='9').contains(&digit));
    differs.then(|| format!("{size}{unit} {}", if by > 0.0 { above } else { below }))
}

/// Shows the models of the groups in a corner of a view.
pub fn name_of_models(ui: &Ui, rect: Rect, scene: &Scene) {
    let at = rect.min + eframe::egui::vec2(12.0, 10.0);
    ui.painter_at(rect).text(
        at,
        Align2::LEFT_TOP,
        models_of(scene),
        FontId::proportional(17.0),
        ui.visuals().text_color(),
    );
}
