//! The choice of recorded trajectories: sampling rate, agents, groups and columns.

use super::bar::named;
use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{DragValue, PopupCloseBehavior, Role, TextEdit, Ui};
use std::path::Path;
use throng_record::{Choice, Column, Format, Setting};

/// The first sampling rate, samples per second.
const RATE: f64 = 10.0;

/// The choice of recorded trajectories.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chosen {
    /// Samples per second. `None` for every step.
    pub rate: Option<f64>,
    /// The numbers of the recorded agents, as typed. Empty for all agents.
    pub agents: String,
    /// The names of the recorded groups. Empty for all groups.
    pub groups: Vec<String>,
    /// The columns of a table, in this order. Empty for all columns.
    pub columns: Vec<Column>,
}

impl Chosen {
    /// Returns the choice for a time span, seconds. Columns apply only if the format of the file has columns.
    ///
    /// # Errors
    /// The agents are no list of numbers.
    pub fn choice(&self, [from, to]: [f64; 2], file: &Path) -> Result<Choice, String> {
        let parts = self.agents.split(',').map(str::trim).filter(|part| !part.is_empty());
        let agents = parts.map(Choice::numbers).collect::<Result<_, _>>().map_err(|says| format!("agents: {says}"))?;
        let columns = if has_columns(file) { self.columns.clone() } else { Vec::new() };
        Ok(Choice { from, to, rate: self.rate, agents, groups: self.groups.clone(), columns, ..Choice::default() })
    }

    /// Shows the fields as rows of a grid, for trajectories of a file of this name.
    pub(super) fn fields(&mut self, ui: &mut Ui, setting: &Setting, file: &Path) {
        let label = ui.label("samples per second");
        ui.horizontal(|ui| match &mut self.rate {
            Some(rate) => {
                ui.add(DragValue::new(rate).speed(0.2).range(0.01..=1000.0)).labelled_by(label.id);
                if ui.button("every step").clicked() {
                    self.rate = None;
                }
            }
            None => {
                ui.label("every step");
                if ui.button("fewer").on_hover_text("agents move along straight lines between samples").clicked() {
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

/// Whether the format of the file has selectable columns.
fn has_columns(file: &Path) -> bool {
    Format::of(file).is_some_and(Format::has_columns)
}

/// Shows a menu with a checkbox for each item. The chosen items are in the order of their selection.
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
