//! The menu of visible layers.

use crate::settings::Settings;
use crate::view::{Heat, Streams};
use eframe::egui::containers::menu::{MenuButton, MenuConfig};
use eframe::egui::{Grid, PopupCloseBehavior, RichText, ScrollArea, Ui, vec2};
use throng_draw::Annotation;
use throng_record::Setting;

/// The averaging windows of the heat map, seconds.
const WINDOWS: [f32; 5] = [0.0, 2.0, 5.0, 10.0, 60.0];

/// Shows the button of the menu, and the menu while it is open. `setting` is the shown setting, if there is one.
pub fn layers(ui: &mut Ui, settings: &mut Settings, setting: Option<&Setting>) {
    let stays = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    MenuButton::new("View").config(stays).ui(ui, |ui| {
        let screen = ui.ctx().content_rect();
        ui.set_width(360.0_f32.min(screen.width() - 40.0));
        ScrollArea::vertical().max_height(screen.height() - 100.0).show(ui, |ui| {
            switches(ui, settings);
            ui.separator();
            Grid::new("layers").num_columns(2).spacing([12.0, 6.0]).show(ui, |ui| choices(ui, settings, setting));
        });
    });
}

fn switches(ui: &mut Ui, settings: &mut Settings) {
    ui.checkbox(&mut settings.dark, "dark (D)");
    ui.checkbox(&mut settings.grid, "grid");
    let mut trails = settings.trails > 0.0;
    if ui.checkbox(&mut trails, "trails (T)").changed() {
        settings.trails = if trails { 1.5 } else { 0.0 };
    }
    let layers = &mut settings.layers;
    ui.checkbox(&mut layers.shadows, "shadows");
    ui.checkbox(&mut layers.people, "walking people").on_hover_text(
        "agents on the ground with a radius of at most 0.5 m are people, in a view in space with the shape `fitting`",
    );
    ui.checkbox(&mut settings.annotations, "annotations of the selected agent (A)");
    if settings.annotations {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
            Annotation::ALL.into_iter().for_each(|kind| switch(ui, &mut settings.kinds, kind));
        });
    }
    ui.checkbox(&mut layers.paths, "planned path of the selected agent");
    ui.checkbox(&mut layers.mesh, "navigation mesh")
        .on_hover_text("triangles used for path planning, for the selected agent's body; needs walls");
    ui.checkbox(&mut layers.key, "key of colours and lines");
}

/// Shows a switch for a kind of annotation.
fn switch(ui: &mut Ui, kinds: &mut Vec<String>, kind: Annotation) {
    let shown = kinds.iter().any(|name| name == kind.name());
    if ui.selectable_label(shown, kind.says()).clicked() {
        if shown {
            kinds.retain(|name| name != kind.name());
        } else {
            kinds.push(kind.name().to_owned());
        }
    }
}

/// Shows the choices side by side, because a nested menu would close this menu.
fn choices(ui: &mut Ui, settings: &mut Settings, setting: Option<&Setting>) {
    let layers = &mut settings.layers;
    ui.label("heat map").on_hover_text("density or speed of the crowd, as colour on the ground");
    row(ui, &mut layers.heat, Heat::ALL.map(|heat| (heat, heat.label().to_owned())));
    if layers.heat != Heat::None {
        ui.label("mean of").on_hover_text("the last seconds");
        let label = |window: f32| if window > 0.0 { format!("{window} s") } else { "now".into() };
        row(ui, &mut layers.window, WINDOWS.map(|window| (window, label(window))));
    }
    let Some(setting) = setting.filter(|setting| !setting.flows.is_empty()) else {
        ui.label(RichText::new("field").weak());
        ui.label(RichText::new("no group follows one").weak());
        ui.end_row();
        return;
    };
    ui.label("field").on_hover_text("the velocities that groups follow");
    row(ui, &mut layers.streams, Streams::ALL.map(|streams| (streams, streams.label().to_owned())));
    ui.label("");
    ui.checkbox(&mut layers.stream_speed, "speed as colour");
    ui.end_row();
    if setting.flows.len() > 1 {
        ui.label("of");
        let whose = (0..).zip(&setting.flows).map(|(at, flow)| (Some(at), led(setting, &flow.groups)));
        row(ui, &mut layers.field, std::iter::once((None, "all".to_owned())).chain(whose));
    }
}

/// Shows a row of the menu with a choice between items.
fn row<T: PartialEq>(ui: &mut Ui, chosen: &mut T, all: impl IntoIterator<Item = (T, String)>) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        all.into_iter().for_each(|(one, label)| _ = ui.selectable_value(chosen, one, label));
    });
    ui.end_row();
}

/// Returns the names of the groups that follow a field.
fn led(setting: &Setting, groups: &[u32]) -> String {
    let names: Vec<&str> =
        groups.iter().filter_map(|&group| setting.groups.get(group as usize)).map(String::as_str).collect();
    names.join(", ")
}
