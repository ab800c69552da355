//! What of a scene trajectories have: how often, who, and which columns.

use super::bar::named;
use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{DragValue, PopupCloseBehavior, Role, TextEdit, Ui};
use std::path::Path;
use throng_record::{Choice, Column, Format, Setting};

/// Moments a second, to begin with.
const RATE: f64 = 10.0;

/// What people choose of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chosen {
    /// Moments a second; `None`: every step.
    pub rate: Option<f64>,
    /// The numbers of those who are written, as people write them; empty: everybody.
    pub agents: String,
    /// The names of the groups that are written; empty: all.
    pub groups: Vec<String>,
    /// The columns of a table, in this order; empty: all.
    pub columns: Vec<Column>,
}

impl Chosen {
    /// What is chosen, from a time to another, seconds; columns where a file of this name has them.
    ///
    /// # Errors
    /// The agents are no numbers; what to write.
    pub fn choice(&self, [from, to]: [f64; 2], file: &Path) -> Result<Choice, String> {
        let parts = self.agents.split(',').map(str::trim).filter(|part| !part.is_empty());
        let agents = parts.map(Choice::numbers).collect::<Result<_, _>>().map_err(|says| format!("agents: {says}"))?;
        let columns = if has_columns(file) { self.columns.clone() } else { Vec::new() };
        Ok(Choice { from, to, rate: self.rate, agents, groups: self.groups.clone(), columns })
    }

    /// Shows its fields, rows of a grid, for trajectories of a file of this name.
    pub(super) fn fields(&mut self, ui: &mut Ui, setting: &Setting, file: &Path) {
        let label = ui.label("moments a second");
        ui.horizontal(|ui| match &mut self.rate {
            Some(rate) => {
                ui.add(DragValue::new(rate).speed(0.2).range(0.01..=1000.0)).labelled_by(label.id);
                if ui.button("every step").clicked() {
                    self.rate = None;
                }
            }
            None => {
                ui.label("every step");
                if ui.button("fewer").on_hover_text("between steps everybody goes straight on").clicked() {
                    self.rate = Some(RATE);
                }
            }
        });
        ui.end_row();
        let label = ui.label("agents");
        let field = TextEdit::singleline(&mut self.agents).hint_text("all, or 1,5,10-20").desired_width(206.0);
        ui.add(field).labelled_by(label.id);
        ui.end_row();
        if setting.groups.len() > 1 {
            let names = (0..setting.groups.len() as u32).map(|group| setting.group_name(group).into_owned());
            ui.label("groups");
            let shown = if self.groups.is_empty() { "all".into() } else { self.groups.join(", ") };
            menu(ui, "groups", shown, &mut self.groups, names.map(|name| (name.clone(), name)));
            ui.end_row();
        }
        if has_columns(file) {
            ui.label("columns");
            let written: Vec<&str> = self.columns.iter().map(|column| column.name()).collect();
            let shown = if written.is_empty() { "all".into() } else { written.join(", ") };
            let all = Column::ALL.into_iter().map(|column| (column, column.name().to_owned()));
            menu(ui, "columns", shown, &mut self.columns, all);
            ui.end_row();
        }
    }
}

/// Whether columns can be chosen of a file of this name.
fn has_columns(file: &Path) -> bool {
    Format::of(file).is_some_and(Format::has_columns)
}

/// A menu in which some of several are chosen, in the order in which they are.
fn menu<T: PartialEq>(
    ui: &mut Ui,
    name: &str,
    shown: String,
    chosen: &mut Vec<T>,
    all: impl Iterator<Item = (T, String)>,
) {
    let stays = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (menu, _) = MenuButton::new(shown).config(stays).ui(ui, |ui| {
        for (one, label) in all {
            let mut is = chosen.contains(&one);
            if ui.checkbox(&mut is, label).clicked() {
                chosen.retain(|other| *other != one);
                chosen.extend(is.then_some(one));
            }
        }
    });
    named(&menu, Role::Button, name);
}
