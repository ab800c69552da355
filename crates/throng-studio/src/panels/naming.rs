//! The dialog for a file name.

use eframe::egui::{Align2, Context, Key, TextEdit, Window};

/// The dialog for a file name.
#[derive(Clone, Debug)]
pub struct Naming {
    title: &'static str,
    verb: &'static str,
    hint: &'static str,
    /// The typed name, while the dialog is open.
    pub name: Option<String>,
    /// Why the last name was refused.
    pub refused: Option<String>,
}

impl Naming {
    /// Creates the dialog with its title, the label of its button, and the hint of its empty field.
    pub fn new(title: &'static str, verb: &'static str, hint: &'static str) -> Self {
        Self { title, verb, hint, name: None, refused: None }
    }

    /// Opens the dialog with an initial name.
    pub fn open(&mut self, name: &str) {
        (self.name, self.refused) = (Some(name.to_owned()), None);
    }

    /// Shows the dialog while it is open. Returns the name once it is confirmed.
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

    /// Closes the dialog, or shows why the name was refused.
    pub fn answer(&mut self, answer: Result<(), String>) {
        match answer {
            Ok(()) => self.name = None,
            Err(says) => self.refused = Some(says),
        }
    }
}
