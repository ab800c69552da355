//! The text of the scene: edited, checked while it is typed, applied and saved.

use crate::document::Document;
use crate::play::Trouble;
use eframe::egui::{
    Button, Color32, Id, Key, KeyboardShortcut, Modifiers, RichText, Role, ScrollArea, TextEdit, Ui, WidgetInfo,
};

/// A request of the text panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextRequest {
    /// Plays the scene of the text.
    Apply,
    /// Writes the text to its file.
    Save,
}

const APPLY: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Enter);

/// Shows the text and its error. `trouble` is the error of the player.
pub fn text(ui: &mut Ui, document: &mut Document, trouble: Option<&Trouble>) -> Option<TextRequest> {
    let mut asked = None;
    ui.horizontal(|ui| {
        ui.label(
            RichText::new(format!("{}{}", document.origin(), if document.changed() { " •" } else { "" })).strong(),
        );
    });
    ui.horizontal(|ui| {
        let sound = document.scene().is_ok();
        let shortcut = ui.input_mut(|input| input.consume_shortcut(&APPLY));
        if ui.add_enabled(sound, Button::new("Apply")).on_hover_text("play this scene (Ctrl Enter)").clicked()
            || (shortcut && sound)
        {
            asked = Some(TextRequest::Apply);
        }
        if ui
            .add_enabled(document.changed(), Button::new("Save"))
            .on_hover_text("write the text to its file (Ctrl S)")
            .clicked()
        {
            asked = Some(TextRequest::Save);
        }
        if ui.button("Undo").clicked() {
            document.undo();
        }
        if ui.button("Redo").clicked() {
            document.redo();
        }
    });
    if let Some(says) = wrong(document, trouble) {
        let red = if ui.visuals().dark_mode {
            Color32::from_rgb(0xf0, 0x8a, 0x80)
        } else {
            Color32::from_rgb(0xa8, 0x2c, 0x22)
        };
        ui.label(RichText::new(says).monospace().color(red));
    }
    let mut text = document.text().to_owned();
    // a fixed id, so that the field keeps the focus when an error message appears above it
    ScrollArea::both().id_salt("text").auto_shrink(false).show(ui, |ui| {
        let edit = TextEdit::multiline(&mut text).id(Id::unique("text of the scene"));
        let edit = edit.code_editor().desired_width(f32::INFINITY).desired_rows(30);
        let edit = ui.add(edit);
        edit.widget_info(|| WidgetInfo::labeled(Role::MultilineTextInput, true, "text of the scene"));
        if edit.changed() {
            document.edit(text);
        }
    });
    asked
}

/// Returns the error of the text, or else the error of the player.
fn wrong(document: &Document, trouble: Option<&Trouble>) -> Option<String> {
    match document.scene() {
        Err(error) => Some(error.to_string()),
        Ok(_) => trouble.map(ToString::to_string),
    }
}
