//! The scene's text: edited, checked as it is written, applied, saved.

use crate::document::Document;
use crate::play::Trouble;
use eframe::egui::{
    Button, Color32, Id, Key, KeyboardShortcut, Modifiers, RichText, Role, ScrollArea, TextEdit, Ui, WidgetInfo,
};

/// What the text's panel asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// Plays what the text says.
    Apply,
    /// Writes it to its file.
    Save,
}

const APPLY: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Enter);

/// Shows the text, and what is wrong with it; `trouble` is what the player found wrong.
pub fn text(ui: &mut Ui, document: &mut Document, trouble: Option<&Trouble>) -> Option<Asked> {
    let mut asked = None;
    ui.horizontal(|ui| {
        ui.label(
            RichText::new(format!("{}{}", document.origin(), if document.changed() { " •" } else { "" })).strong(),
        );
    });
    ui.horizontal(|ui| {
        let sound = document.scene().is_ok();
        let shortcut = ui.input_mut(|input| input.consume_shortcut(&APPLY));
        if ui.add_enabled(sound, Button::new("Apply")).on_hover_text("play what it says (Ctrl Enter)").clicked()
            || (shortcut && sound)
        {
            asked = Some(Asked::Apply);
        }
        if ui
            .add_enabled(document.changed(), Button::new("Save"))
            .on_hover_text("write it to its file (Ctrl S)")
            .clicked()
        {
            asked = Some(Asked::Save);
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
    // by name: whoever writes goes on writing when what is wrong appears above
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

/// What is wrong: with the text, or else with what it says.
fn wrong(document: &Document, trouble: Option<&Trouble>) -> Option<String> {
    match document.scene() {
        Err(error) => Some(error.to_string()),
        Ok(_) => trouble.map(ToString::to_string),
    }
}
