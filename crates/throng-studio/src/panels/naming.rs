//! Asking for the name of a file: a small dialog.

use eframe::egui::{Align2, Context, Key, TextEdit, Window};

/// The dialog.
#[derive(Clone, Debug)]
pub struct Naming {
    title: &'static str,
    verb: &'static str,
    hint: &'static str,
    /// The name that is written, while the dialog is open.
    pub name: Option<String>,
    /// Why the last name was no good.
    pub refused: Option<String>,
}

impl Naming {
    /// One of this title, with what its button says, and what stands in its empty field.
    pub fn new(title: &'static str, verb: &'static str, hint: &'static str) -> Self {
        Self { title, verb, hint, name: None, refused: None }
    }

    /// Opens it with a name to begin with.
    pub fn open(&mut self, name: &str) {
        (self.name, self.refused) = (Some(name.to_owned()), None);
    }

    /// Shows it while it is open; the name once it is said.
    pub fn ui(&mut self, ctx: &Context) -> Option<String> {
        let name = self.name.as_mut()?;
        let (mut said, mut open) = (false, true);
        let window = Window::new(self.title).collapsible(false).resizable(false).open(&mut open);
        window.anchor(Align2::CENTER_CENTER, [0.0, -60.0]).show(ctx, |ui| {
            let field = ui.add(TextEdit::singleline(name).desired_width(300.0).hint_text(self.hint));
            if !field.has_focus() && !field.lost_focus() {
                field.request_focus();
            }
            if let Some(says) = &self.refused {
                ui.colored_label(ui.visuals().error_fg_color, says);
            }
            said = ui.button(self.verb).clicked()
                || (field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)));
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
