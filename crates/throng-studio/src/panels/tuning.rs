//! Controls for the parameters of the groups.

use super::bar::named;
use crate::document::{Document, Edit};
use crate::tune::{Parameter, ParameterKind, Section, Tunable, apply_preset, edit_paths};
use eframe::egui::{
    CollapsingHeader, Color32, ComboBox, DragValue, RichText, Role, ScrollArea, Sense, Slider, SliderClamping, Ui,
};
use std::sync::Arc;
use throng_scene::{AboutPreset, Scene};

/// How often the way to a refused value is halved in search of the limit.
const HALVINGS: u32 = 8;

/// The panel of parameters.
#[derive(Default)]
pub struct Tuning {
    tunable: Option<Tunable>,
    /// The parameters of the current scene.
    sections: Option<(Arc<Scene>, Vec<Section>)>,
    /// The path of the dragged slider or colour, and the last value that gives a valid scene.
    dragged: Option<(String, TuningRequest)>,
    shows: Shows,
    refused: Option<Refused>,
}

/// The parameters of a panel.
#[derive(Clone, Copy, Default, PartialEq)]
enum Shows {
    /// What the scene names, and the parameters of the groups.
    #[default]
    All,
    /// Only the presets and the sliders that the scene names.
    Named,
    /// The look of pictures and films.
    Look,
}

/// The last change, if it was refused.
struct Refused {
    /// The path, or the name of the preset.
    path: String,
    /// The value of the slider, if it was one.
    value: Option<f64>,
    /// Why.
    says: String,
}

/// When a change is requested.
#[derive(Clone, Copy, PartialEq)]
enum Moment {
    /// While a slider is dragged.
    Dragging,
    /// When the slider is released.
    Released,
    /// At once.
    Once,
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
#[derive(Clone, PartialEq)]
enum TuningRequest {
    Number(f64, bool),
    Colour([u8; 3]),
    Switch(bool),
    Choose(String, Option<String>),
    /// Removes the key.
    Forget,
}

impl Tuning {
    /// Creates a panel of only the presets and sliders that the scene names.
    pub fn brief() -> Self {
        Self { shows: Shows::Named, ..Self::default() }
    }

    /// Creates a panel of the look of pictures and films.
    pub fn look() -> Self {
        Self { shows: Shows::Look, ..Self::default() }
    }

    /// Shows the parameters and applies changes to the text of the document.
    pub fn ui(&mut self, ui: &mut Ui, document: &mut Document) -> Option<Tuned> {
        let Ok(scene) = document.scene().cloned() else {
            ui.label("Fix the errors in the scene text first.");
            return None;
        };
        let tunable = self.tunable.get_or_insert_with(|| Tunable::new(document.plugins()));
        let known = self.sections.take().filter(|(of, _)| Arc::ptr_eq(of, &scene));
        let (of, sections) = known.unwrap_or_else(|| {
            let look = self.shows == Shows::Look;
            (scene.clone(), if look { tunable.look(document) } else { tunable.sections(document) })
        });
        let presets = if self.shows == Shows::Look { &[][..] } else { &scene.about.presets[..] };
        let (mut wish, mut chosen) = (None, None);
        // brief sliders are among other controls that scroll
        ScrollArea::vertical().auto_shrink([false, self.shows == Shows::Named]).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                for preset in presets {
                    if ui.button(&preset.name).on_hover_text(changes(preset)).clicked() {
                        chosen = Some(preset);
                    }
                }
            });
            presets.iter().for_each(|preset| self.refusal(ui, &preset.name));
            // the section that the scene names is the first
            for section in sections.iter().take(if self.shows == Shows::Named { 1 } else { sections.len() }) {
                let header = CollapsingHeader::new(RichText::new(&section.name).strong()).default_open(true);
                header.show(ui, |ui| self.section(ui, section, &mut wish));
            }
        });
        self.sections = Some((of, sections));
        if let Some(preset) = chosen {
            let done = document.change(|edit| apply_preset(edit, &scene, preset));
            return self.done(&preset.name, None, Moment::Once, done.map(|()| Tuned::Changed));
        }
        let (path, mut wish, moment) = wish?;
        let beyond = self.refused(&path).and_then(|refused| refused.value);
        if let (Moment::Released, TuningRequest::Number(value, whole), Some(beyond)) = (moment, &mut wish, beyond) {
            *value = limit([*value, beyond], *whole, |value| {
                let wish = TuningRequest::Number(value, *whole);
                document.tried(|edit| apply(edit, &scene, &path, &wish)).is_ok()
            });
        }
        let change = |edit: &mut Edit| apply(edit, &scene, &path, &wish);
        let done = match moment {
            Moment::Dragging => document.tried(change).map(Tuned::Dragged),
            Moment::Released | Moment::Once => document.change(change).map(|()| Tuned::Changed),
        };
        if let (Moment::Dragging, Ok(_)) = (moment, &done) {
            self.dragged = Some((path.clone(), wish.clone()));
        }
        let value = if let TuningRequest::Number(value, _) = wish { Some(value) } else { None };
        self.done(&path, value, moment, done)
    }

    /// Notes why a change was refused. A released slider has the last valid value, and the reason stays visible.
    fn done(&mut self, path: &str, value: Option<f64>, moment: Moment, done: Result<Tuned, String>) -> Option<Tuned> {
        match &done {
            Err(says) => self.refused = Some(Refused { path: path.to_owned(), value, says: says.clone() }),
            Ok(_) if moment == Moment::Released => {}
            Ok(_) => self.refused = None,
        }
        done.ok()
    }

    /// Returns the refused change of a path.
    fn refused(&self, path: &str) -> Option<&Refused> {
        self.refused.as_ref().filter(|refused| refused.path == path)
    }

    /// Shows why the last change of this path was refused.
    fn refusal(&self, ui: &mut Ui, path: &str) {
        if let Some(refused) = self.refused(path) {
            ui.colored_label(ui.visuals().error_fg_color, &refused.says);
        }
    }

    fn section(&mut self, ui: &mut Ui, section: &Section, wish: &mut Option<(String, TuningRequest, Moment)>) {
        for parameter in &section.parameters {
            if let Some((asked, last)) = self.parameter(ui, parameter) {
                *wish = Some((parameter.path.clone(), asked, last));
            }
        }
        for (at, inner) in section.sections.iter().enumerate() {
            let header = CollapsingHeader::new(title(inner)).id_salt((at, &inner.name));
            // a single section beside a choice holds the options of that choice, so it starts open
            let chosen = section.sections.len() == 1 && section.parameters.len() == 1;
            let open = chosen || ["avoid", "speed", "steer", "sun"].contains(&inner.name.as_str());
            let shown = header.default_open(open).show(ui, |ui| self.section(ui, inner, wish));
            shown.header_response.on_hover_text(&inner.about);
        }
    }

    /// Shows a parameter. Returns the requested change, and when it is requested.
    fn parameter(&mut self, ui: &mut Ui, parameter: &Parameter) -> Option<(TuningRequest, Moment)> {
        let Parameter { path, about, given, acts, kind, .. } = parameter;
        let name = parameter.name.replace('_', " ") + if *acts { "" } else { " (no effect here)" };
        let name = if *given && *acts { RichText::new(name) } else { RichText::new(name).weak() };
        let mut asked = None;
        ui.horizontal(|ui| {
            let mut slider_response = None;
            match kind {
                ParameterKind::Number { value, low, high, whole } => {
                    let pending = self.dragged.as_ref().filter(|(at, _)| at == path).map(|(_, wish)| wish.clone());
                    let mut now = if let Some(TuningRequest::Number(now, _)) = pending { now } else { *value };
                    ui.spacing_mut().slider_width = 110.0;
                    let mut slider = Slider::new(&mut now, *low..=*high).clamping(SliderClamping::Never);
                    if let Some(unit) = &about.unit {
                        slider = slider.suffix(format!(" {unit}"));
                    }
                    if *whole {
                        slider = slider.integer();
                    }
                    let response = ui.add(slider).on_hover_text(&about.text);
                    slider_response = Some(response.clone());
                    let dragging = response.dragged();
                    if let Some(last) = pending.filter(|_| !dragging) {
                        self.dragged = None;
                        asked = Some((last, Moment::Released));
                    } else if response.changed() && self.refused(path).is_none_or(|refused| refused.value != Some(now))
                    {
                        let moment = if dragging { Moment::Dragging } else { Moment::Once };
                        asked = Some((TuningRequest::Number(now, *whole), moment));
                    }
                }
                ParameterKind::Unset { says, first, whole } => {
                    let value = format!(
                        "set: {first}{}",
                        about.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"))
                    );
                    if ui.button(says).on_hover_text(value).clicked() {
                        asked = Some((TuningRequest::Number(*first, *whole), Moment::Once));
                    }
                }
                ParameterKind::Colour { value } => {
                    let pending = self.dragged.as_ref().filter(|(at, _)| at == path).map(|(_, wish)| wish.clone());
                    let usual = value.unwrap_or_default();
                    let mut now = if let Some(TuningRequest::Colour(now)) = pending { now } else { usual };
                    let changed = colour(ui, &mut now, &parameter.name);
                    let dragging = ui.input(|input| input.pointer.any_down());
                    if let Some(last) = pending.filter(|_| !dragging) {
                        self.dragged = None;
                        asked = Some((last, Moment::Released));
                    } else if changed {
                        asked =
                            Some((TuningRequest::Colour(now), if dragging { Moment::Dragging } else { Moment::Once }));
                    }
                }
                ParameterKind::Switch { value } => {
                    let mut now = value.unwrap_or_default();
                    let known = value.is_some();
                    let mark = eframe::egui::Checkbox::without_text(&mut now).indeterminate(!known);
                    if ui.add(mark).on_hover_text(&about.text).changed() {
                        asked = Some((TuningRequest::Switch(now), Moment::Once));
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
                        asked = Some((TuningRequest::Choose(now, table.then(|| value.clone())), Moment::Once));
                    }
                }
            }
            let label = ui.label(name).on_hover_text(&about.text);
            if let Some(slider) = slider_response {
                slider.labelled_by(label.id);
            }
            let removable = *given && self.shows == Shows::Look;
            if removable && ui.small_button("default").on_hover_text("remove this key").clicked() {
                asked = Some((TuningRequest::Forget, Moment::Once));
            }
            label.context_menu(|ui| {
                if ui.add_enabled(*given, eframe::egui::Button::new("remove this key")).clicked() {
                    asked = Some((TuningRequest::Forget, Moment::Once));
                    ui.close();
                }
            });
        });
        self.refusal(ui, path);
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
}

/// Returns the last value that fits, on the way from a value that fits to one that does not.
fn limit([mut good, mut bad]: [f64; 2], whole: bool, fits: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (good + bad);
        let middle = if whole { middle.round() } else { middle };
        if middle == good || middle == bad {
            break;
        }
        *(if fits(middle) { &mut good } else { &mut bad }) = middle;
    }
    // the round number that lies there
    let rounded = [1.0, 10.0, 100.0, 1000.0].into_iter().map(|scale| (0.5 * (good + bad) * scale).round() / scale);
    let inside = rounded.filter(|value| (good.min(bad)..=good.max(bad)).contains(value));
    inside.take(2).find(|&value| fits(value)).unwrap_or(good)
}

/// Returns the title of a section: its name, and its choice if it begins with one.
fn title(section: &Section) -> String {
    let name = section.name.replace('_', " ");
    match section.parameters.first().map(|first| (&first.name, &first.kind)) {
        Some((first, ParameterKind::Choice { value, .. })) if *first == section.name && *value != section.name => {
            format!("{name}: {}", value.replace('_', " "))
        }
        _ => name,
    }
}

/// Returns the changes of a preset, one in a line.
fn changes(preset: &AboutPreset) -> String {
    let lines: Vec<String> = preset.with.iter().map(|(path, value)| format!("{path} = {value}")).collect();
    lines.join("\n")
}

/// Shows a colour and fields for its red, green and blue. Returns whether it has changed.
fn colour(ui: &mut Ui, rgb: &mut [u8; 3], name: &str) -> bool {
    let (place, _) = ui.allocate_exact_size(ui.spacing().interact_size, Sense::hover());
    let [r, g, b] = *rgb;
    ui.painter().rect_filled(place, 3.0, Color32::from_rgb(r, g, b));
    let mut changed = false;
    for (part, value) in ["red", "green", "blue"].into_iter().zip(rgb) {
        let field = ui.add(DragValue::new(value).speed(1.0).range(0..=255));
        named(&field, Role::SpinButton, &format!("{name}: {part}"));
        changed |= field.changed();
    }
    changed
}

/// Returns a colour as in files.
fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn apply(edit: &mut Edit, scene: &Scene, path: &str, wish: &TuningRequest) -> Result<(), String> {
    edit_paths(scene, path).iter().try_for_each(|path| apply_to(edit, path, wish.clone()))
}

fn apply_to(edit: &mut Edit, path: &str, wish: TuningRequest) -> Result<(), String> {
    match wish {
        TuningRequest::Number(value, true) => edit.set(path, value.round() as i64),
        // rounds to five decimals, because further digits of a slider are noise
        TuningRequest::Number(value, false) => edit.set(path, format!("{value:.5}").parse().unwrap_or(value)),
        TuningRequest::Colour(rgb) => edit.set(path, hex(rgb)),
        TuningRequest::Switch(value) => edit.set(path, value),
        TuningRequest::Choose(option, None) => edit.set(path, option),
        TuningRequest::Choose(option, Some(_)) => {
            edit.remove(path)?;
            edit.set(path, toml_edit::InlineTable::from_iter([(option.as_str(), toml_edit::InlineTable::new())]))
        }
        TuningRequest::Forget => edit.remove(path).map(drop),
    }
}
