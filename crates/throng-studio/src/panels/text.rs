//! The text of the scene: edited, checked while it is typed, applied and saved.

use super::code;
use crate::document::Document;
use crate::play::Trouble;
use eframe::egui::{Button, Id, Key, KeyboardShortcut, Label, Modifiers, RichText, ScrollArea, Sense, Ui};
use throng_scene::Error;

/// A request of the text panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextRequest {
    /// Plays the scene of the text.
    Apply,
    /// Writes the text to its file.
    Save,
    /// The user has chosen whether edits restart the scene.
    Restarts,
}

const APPLY: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Enter);

/// Shows the text and its error. `restarts` is whether edits restart the scene, `trouble` is the error of the player.
pub fn text(
    ui: &mut Ui,
    document: &mut Document,
    restarts: &mut bool,
    trouble: Option<&Trouble>,
) -> Option<TextRequest> {
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
        let undone = ui.button("Undo").on_hover_text("undo the last edit (Ctrl Z)").clicked() && document.undo();
        let redone = ui.button("Redo").on_hover_text("redo (Ctrl Y)").clicked() && document.redo();
        let says = "whether edits that the run cannot follow start the scene again";
        if ui.checkbox(restarts, "restart").on_hover_text(says).changed() {
            asked = Some(TextRequest::Restarts);
        }
        if (undone || redone || past(ui, document)) && document.scene().is_ok() {
            asked = Some(TextRequest::Apply);
        }
    });
    let wrong = wrong(document, trouble);
    let mut goes = false;
    if let Some(Wrong { says, .. }) = &wrong {
        let says = RichText::new(says).monospace().color(code::error(ui.visuals().dark_mode));
        let label = ui.add(Label::new(says).sense(Sense::click())).on_hover_text("click: go to the line");
        goes = label.clicked();
    }
    let line = wrong.and_then(|wrong| wrong.line);
    let mut text = document.text().to_owned();
    ScrollArea::vertical().id_salt("text").auto_shrink(false).show(ui, |ui| {
        // while the user types, the text does not jump to an error elsewhere
        let writes = ui.memory(|memory| memory.has_focus(Id::unique("text of the scene")));
        let known: Option<usize> =
            ui.data_mut(|data| std::mem::replace(data.get_temp_mut_or_default(Id::unique("marked line")), line));
        let scroll = goes || line != known && !writes;
        if code::code(ui, &mut text, line, scroll).changed() {
            document.edit(text);
        }
    });
    asked
}

/// Shows the menu of the last edits. Returns whether the user went back to one.
fn past(ui: &mut Ui, document: &mut Document) -> bool {
    let menu = ui.add_enabled_ui(document.is_edited(), |ui| {
        ui.menu_button("Edits", |ui| {
            ui.label(RichText::new("undo up to").small().strong());
            let mut steps = 0;
            for edit in document.edits() {
                steps += edit.steps;
                if ui.button(edit.says).clicked() {
                    return steps;
                }
            }
            0
        })
    });
    let steps = menu.inner.inner.unwrap_or_default();
    (0..steps).for_each(|_| _ = document.undo());
    steps > 0
}

/// An error, and its line in the text, counted from 1.
struct Wrong {
    says: String,
    line: Option<usize>,
}

/// Returns the error of the text, or else the error of the player.
fn wrong(document: &Document, trouble: Option<&Trouble>) -> Option<Wrong> {
    // the editor marks the place, so the message has no excerpt
    let of = |error: &Error| {
        let plain = Error { line: None, ..error.clone() };
        Wrong { says: plain.to_string(), line: error.at.map(|(line, _)| line) }
    };
    match (document.scene(), trouble) {
        (Err(error), _) => Some(of(error)),
        (Ok(_), Some(Trouble::Scene(error))) => Some(of(error)),
        (Ok(_), trouble) => trouble.map(|trouble| Wrong { says: trouble.to_string(), line: None }),
    }
}
