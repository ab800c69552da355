//! Saving under another name: a small dialog.

use eframe::egui::{Align2, Context, Key, TextEdit, Window};

/// The dialog.
#[derive(Clone, Debug, Default)]
pub struct SaveAs {
    /// The name that is written, while the dialog is open.
    pub name: Option<String>,
    /// Why the last name was no good.
    pub refused: Option<String>,
}

impl SaveAs {
    /// Opens it with a name to begin with.
    pub fn open(&mut self, name: &str) {
        *self = Self { name: Some(format!("{name}.toml")), refused: None };
    }

    /// Shows it while it is open; the name once it is said.
    pub fn ui(&mut self, ctx: &Context) -> Option<String> {
        let name = self.name.as_mut()?;
        let (mut said, mut open) = (false, true);
        let window = Window::new("Save as").collapsible(false).resizable(false).open(&mut open);
        window.anchor(Align2::CENTER_CENTER, [0.0, -60.0]).show(ctx, |ui| {
            let field = ui.add(TextEdit::singleline(name).desired_width(300.0).hint_text("name.toml"));
            if !field.has_focus() && !field.lost_focus() {
                field.request_focus();
            }
            if let Some(says) = &self.refused {
                ui.colored_label(ui.visuals().error_fg_color, says);
            }
            said =
                ui.button("Save").clicked() || (field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)));
        });
        let name = name.trim().to_owned();
        if !open || ctx.input(|input| input.key_pressed(Key::Escape)) {
            self.name = None;
        }
        Some(name).filter(|name| said && !name.is_empty())
    }

    /// The name was good, or was not.
    pub fn answer(&mut self, answer: Result<(), String>) {
        match answer {
            Ok(()) => self.name = None,
            Err(says) => self.refused = Some(says),
        }
    }
}
