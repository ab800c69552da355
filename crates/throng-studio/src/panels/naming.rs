//! The dialog for a file name.

use crate::outside::{Asks, Dialog};
use eframe::egui::{Align2, Button, Context, Id, Key, RichText, ScrollArea, TextEdit, Ui, Window};

/// The height of the lists of files, points of the screen.
const LISTS: f32 = 300.0;

/// The dialog for a file name.
#[derive(Debug)]
pub struct Naming {
    title: &'static str,
    verb: &'static str,
    hint: &'static str,
    /// What the dialog of the system asks for.
    asks: Asks,
    /// The dialog of the system, while it is open.
    dialog: Option<Dialog>,
    /// Whether the field is about to get the focus.
    focuses: bool,
    /// The typed name, while the dialog is open.
    pub name: Option<String>,
    /// Why the last name was refused.
    pub refused: Option<String>,
}

/// A name that the user gave.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    /// The name.
    pub name: String,
    /// Whether the user agreed to replace a file of this name.
    pub replaces: bool,
}

/// The files that the dialog offers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Offered {
    /// The folder of the typed name.
    pub folder: String,
    /// The names in the folder: folders end with `/`.
    pub names: Vec<String>,
    /// Files that were opened or saved last, the last first.
    pub recent: Vec<String>,
}

impl Naming {
    /// Creates the dialog with its title, the label of its button, the hint of its empty field, and what the dialog of the
    /// system asks for. A dialog for files to read has lists of files to choose from.
    pub fn new(title: &'static str, verb: &'static str, hint: &'static str, asks: Asks) -> Self {
        Self { title, verb, hint, asks, dialog: None, focuses: false, name: None, refused: None }
    }

    /// Returns the title.
    pub fn title(&self) -> &'static str {
        self.title
    }

    /// Opens the dialog with an initial name.
    pub fn open(&mut self, name: &str) {
        (self.name, self.refused, self.focuses) = (Some(name.to_owned()), None, true);
    }

    /// Shows the dialog while it is open. Returns the name once it is confirmed.
    pub fn ui(&mut self, ctx: &Context, offered: &Offered) -> Option<Named> {
        let name = self.name.as_mut()?;
        let (mut said, mut open, mut replaces) = (false, true, false);
        if let Some(answer) = self.dialog.as_ref().and_then(Dialog::answer) {
            self.dialog = None;
            match answer {
                Ok(path) => (*name, said, replaces) = (path.display().to_string(), true, true),
                Err(says) => self.refused = says.map(Into::into),
            }
        }
        let window = Window::new(self.title).collapsible(false).resizable(false).open(&mut open);
        window.anchor(Align2::CENTER_CENTER, [0.0, -60.0]).show(ctx, |ui| {
            ui.set_width(420.0);
            ui.label(RichText::new(format!("in {}", offered.folder)).weak());
            let id = Id::unique(("name", self.title));
            let field = TextEdit::singleline(name).id(id).desired_width(f32::INFINITY).hint_text(self.hint);
            let field = ui.add(field);
            if std::mem::take(&mut self.focuses) {
                field.request_focus();
            }
            if let Some(says) = &self.refused {
                ui.colored_label(ui.visuals().error_fg_color, says);
            }
            ui.horizontal(|ui| {
                said |= ui.button(self.verb).clicked()
                    || (field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)));
                if Dialog::EXISTS {
                    let browse = ui.add_enabled(self.dialog.is_none(), Button::new("Browse..."));
                    if browse.on_hover_text("the file dialog of the system").clicked() {
                        self.dialog = Dialog::open(self.title, self.asks, name, ctx);
                    }
                }
            });
            if let Some(chosen) = (self.asks == Asks::Open).then(|| lists(ui, offered)).flatten() {
                said = !chosen.ends_with('/');
                *name = joined(name, &chosen);
                self.focuses = true;
            }
        });
        let name = name.trim().to_owned();
        if !open || ctx.input(|input| input.key_pressed(Key::Escape)) {
            (self.name, self.dialog) = (None, None);
        }
        (said && !name.is_empty()).then_some(Named { name, replaces })
    }

    /// Closes the dialog, or shows why the name was refused.
    pub fn answer(&mut self, answer: Result<(), String>) {
        match answer {
            Ok(()) => (self.name, self.dialog) = (None, None),
            Err(says) => (self.refused, self.focuses) = (Some(says), true),
        }
    }
}

/// A name that the user chose in the lists.
enum Chosen {
    /// A whole path.
    Path(String),
    /// A name in the folder.
    Name(String),
}

impl Chosen {
    fn ends_with(&self, end: char) -> bool {
        matches!(self, Self::Name(name) if name.ends_with(end))
    }
}

/// Returns the typed path with a chosen name in place of its last part.
fn joined(typed: &str, chosen: &Chosen) -> String {
    match chosen {
        Chosen::Path(path) => path.clone(),
        Chosen::Name(name) => {
            let folder = typed.rfind(['/', '\\']).map_or("", |end| &typed[..=end]);
            format!("{folder}{name}")
        }
    }
}

/// Shows the files last used and the files of the folder.
fn lists(ui: &mut Ui, offered: &Offered) -> Option<Chosen> {
    let mut chosen = None;
    ui.separator();
    ScrollArea::vertical().max_height(LISTS).auto_shrink([false, true]).show(ui, |ui| {
        if !offered.recent.is_empty() {
            ui.label(RichText::new("opened or saved last").small().strong());
        }
        for path in &offered.recent {
            if ui.button(path).clicked() {
                chosen = Some(Chosen::Path(path.clone()));
            }
        }
        ui.label(RichText::new("in this folder").small().strong());
        if offered.names.is_empty() {
            ui.label(RichText::new("no scenes and no trajectories").weak());
        }
        for name in &offered.names {
            if ui.button(name).clicked() {
                chosen = Some(Chosen::Name(name.clone()));
            }
        }
    });
    chosen
}
