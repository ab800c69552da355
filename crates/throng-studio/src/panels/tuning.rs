//! Controls for the parameters of the groups.

use super::bar::named;
use crate::document::{Document, Edit};
use crate::tune::{Parameter, ParameterKind, Section, Tunable, apply_preset, edit_paths};
use eframe::egui::{CollapsingHeader, ComboBox, RichText, Role, ScrollArea, Slider, SliderClamping, Ui};
use std::sync::Arc;
use throng_scene::{AboutPreset, Scene};

/// The panel of parameters.
#[derive(Default)]
pub struct Tuning {
    tunable: Option<Tunable>,
    /// The parameters of the current scene.
    sections: Option<(Arc<Scene>, Vec<Section>)>,
    /// The path and the current value of the dragged slider.
    dragged: Option<(String, f64)>,
    /// Why the last change was refused.
    refused: Option<String>,
}

/// A change by the user.
#[derive(Clone, Debug, PartialEq)]
pub enum Tuned {
    /// The text has changed.
    Changed,
    /// The slider is still dragged. The text changes on release; meanwhile the run uses this scene.
    Dragged(Arc<Scene>),
}

/// A requested change.
#[derive(Clone)]
enum TuningRequest {
    Number(f64, bool),
    Switch(bool),
    Choose(String, Option<String>),
    /// Removes the key.
    Forget,
}

impl Tuning {
    /// Shows the parameters of the groups and applies changes to the text of the document.
    pub fn ui(&mut self, ui: &mut Ui, document: &mut Document) -> Option<Tuned> {
        let Ok(scene) = document.scene().cloned() else {
            ui.label("Fix the errors in the scene text first.");
            return None;
        };
        let tunable = self.tunable.get_or_insert_with(|| Tunable::new(document.plugins()));
        let known = self.sections.take().filter(|(of, _)| Arc::ptr_eq(of, &scene));
        let (of, sections) = known.unwrap_or_else(|| (scene.clone(), tunable.sections(document)));
        if let Some(says) = &self.refused {
            ui.colored_label(ui.visuals().error_fg_color, says);
        }
        let (mut wish, mut chosen) = (None, None);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                for preset in &scene.about.presets {
                    if ui.button(&preset.name).on_hover_text(changes(preset)).clicked() {
                        chosen = Some(preset);
                    }
                }
            });
            for section in &sections {
                let header = CollapsingHeader::new(RichText::new(&section.name).strong()).default_open(true);
                header.show(ui, |ui| self.section(ui, section, &mut wish));
            }
        });
        self.sections = Some((of, sections));
        if let Some(preset) = chosen {
            let done = document.change(|edit| apply_preset(edit, &scene, preset));
            self.refused = done.as_ref().err().cloned();
            return done.ok().map(|()| Tuned::Changed);
        }
        let (path, wish, last) = wish?;
        let done = if last { self.make(document, &path, wish) } else { self.preview(document, &path, wish) };
        self.refused = done.as_ref().err().cloned();
        done.ok()
    }

    fn section(&mut self, ui: &mut Ui, section: &Section, wish: &mut Option<(String, TuningRequest, bool)>) {
        for parameter in &section.parameters {
            if let Some((asked, last)) = self.parameter(ui, parameter) {
                *wish = Some((parameter.path.clone(), asked, last));
            }
        }
        for inner in &section.sections {
            let header = CollapsingHeader::new(inner.name.replace('_', " ")).id_salt(&inner.name);
            // a single section beside a choice holds the options of that choice, so it starts open
            let chosen = section.sections.len() == 1 && section.parameters.len() == 1;
            let open = chosen || ["avoid", "speed", "steer"].contains(&inner.name.as_str());
            let shown = header.default_open(open).show(ui, |ui| self.section(ui, inner, wish));
            shown.header_response.on_hover_text(&inner.about);
        }
    }

    /// Shows a parameter. Returns the requested change, and whether it is final.
    fn parameter(&mut self, ui: &mut Ui, parameter: &Parameter) -> Option<(TuningRequest, bool)> {
        let Parameter { path, about, given, kind, .. } = parameter;
        let name = RichText::new(parameter.name.replace('_', " "));
        let name = if *given { name } else { name.weak() };
        let mut asked = None;
        ui.horizontal(|ui| {
            match kind {
                ParameterKind::Number { value, low, high, whole } => {
                    let pending = self.dragged.as_ref().filter(|(at, _)| at == path).map(|&(_, value)| value);
                    let mut now = pending.unwrap_or(*value);
                    ui.spacing_mut().slider_width = 110.0;
                    let mut slider = Slider::new(&mut now, *low..=*high).clamping(SliderClamping::Never);
                    if let Some(unit) = &about.unit {
                        slider = slider.suffix(format!(" {unit}"));
                    }
                    if *whole {
                        slider = slider.integer();
                    }
                    let response = ui.add(slider).on_hover_text(&about.text);
                    let dragging = response.dragged();
                    if response.changed() {
                        self.dragged = dragging.then(|| (path.clone(), now));
                        asked = Some((TuningRequest::Number(now, *whole), !dragging));
                    } else if let Some(last) = pending.filter(|_| !dragging) {
                        self.dragged = None;
                        asked = Some((TuningRequest::Number(last, *whole), true));
                    }
                }
                ParameterKind::Switch { value } => {
                    let mut now = value.unwrap_or_default();
                    let known = value.is_some();
                    let mark = eframe::egui::Checkbox::without_text(&mut now).indeterminate(!known);
                    if ui.add(mark).on_hover_text(&about.text).changed() {
                        asked = Some((TuningRequest::Switch(now), true));
                    }
                }
                ParameterKind::Choice { value, options } => {
                    let mut now = value.clone();
                    let combo = ComboBox::from_id_salt(path).selected_text(&now).width(110.0).show_ui(ui, |ui| {
                        for (option, says) in options {
                            ui.selectable_value(&mut now, option.clone(), option).on_hover_text(says);
                        }
                    });
                    named(&combo.response, Role::ComboBox, &parameter.name);
                    if now != *value {
                        let table = self.is_table(path, value);
                        asked = Some((TuningRequest::Choose(now, table.then(|| value.clone())), true));
                    }
                }
            }
            let label = ui.label(name).on_hover_text(&about.text);
            label.context_menu(|ui| {
                if ui.add_enabled(*given, eframe::egui::Button::new("remove this key")).clicked() {
                    asked = Some((TuningRequest::Forget, true));
                    ui.close();
                }
            });
        });
        asked
    }

    /// Whether the choice selects a table with options, instead of a plain name.
    fn is_table(&self, path: &str, value: &str) -> bool {
        let inside = format!("{path}.{value}");
        fn any(section: &Section, inside: &str) -> bool {
            section.parameters.iter().any(|parameter| parameter.path.starts_with(inside))
                || section.sections.iter().any(|section| any(section, inside))
        }
        path.ends_with(".avoid") || self.sections.iter().any(|(_, all)| all.iter().any(|section| any(section, &inside)))
    }

    fn make(&mut self, document: &mut Document, path: &str, wish: TuningRequest) -> Result<Tuned, String> {
        let scene = document.scene().map_err(ToString::to_string)?.clone();
        document.change(|edit| apply(edit, &scene, path, &wish))?;
        Ok(Tuned::Changed)
    }

    fn preview(&self, document: &Document, path: &str, wish: TuningRequest) -> Result<Tuned, String> {
        let mut preview = document.clone();
        let scene = document.scene().map_err(ToString::to_string)?;
        preview.change(|edit| apply(edit, scene, path, &wish))?;
        preview.scene().map(|scene| Tuned::Dragged(scene.clone())).map_err(ToString::to_string)
    }
}

/// Returns the changes of a preset, one in a line.
fn changes(preset: &AboutPreset) -> String {
    let lines: Vec<String> = preset.with.iter().map(|(path, value)| format!("{path} = {value}")).collect();
    lines.join("\n")
}

fn apply(edit: &mut Edit, scene: &Scene, path: &str, wish: &TuningRequest) -> Result<(), String> {
    edit_paths(scene, path).iter().try_for_each(|path| apply_to(edit, path, wish.clone()))
}

fn apply_to(edit: &mut Edit, path: &str, wish: TuningRequest) -> Result<(), String> {
    match wish {
        TuningRequest::Number(value, true) => edit.set(path, value.round() as i64),
        // rounds to five decimals, because further digits of a slider are noise
        TuningRequest::Number(value, false) => edit.set(path, format!("{value:.5}").parse().unwrap_or(value)),
        TuningRequest::Switch(value) => edit.set(path, value),
        TuningRequest::Choose(option, None) => edit.set(path, option),
        TuningRequest::Choose(option, Some(_)) => {
            edit.remove(path)?;
            edit.set(path, toml_edit::InlineTable::from_iter([(option.as_str(), toml_edit::InlineTable::new())]))
        }
        TuningRequest::Forget => edit.remove(path).map(drop),
    }
}
