//! Comparison of two models: the choice of the second model, and the labels of the views.

use super::bar::named;
use crate::play::models_of;
use eframe::egui::{Align2, ComboBox, FontId, Rect, Role, Ui};
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
