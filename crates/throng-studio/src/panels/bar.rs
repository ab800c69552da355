//! The bar below the view: playback, timeline, speed, seed, camera and colours.

use super::icon::Icon;
use crate::play::{Command, RunMoment, Speed};
use crate::settings::Settings;
use crate::view::{Coloring, Marks, Mode, ViewOptions};
use eframe::egui::{Align, ComboBox, DragValue, Layout, Response, RichText, Role, Slider, Ui, WidgetInfo};

/// Shows the bar. Returns the commands for the player.
pub fn bar(ui: &mut Ui, shown: &RunMoment, settings: &mut Settings, view: &mut ViewOptions) -> Vec<Command> {
    let mut asked = Vec::new();
    ui.horizontal(|ui| {
        if Icon::Restart.button(ui, "restart (R)").clicked() {
            asked.push(Command::Restart);
        }
        if Icon::Back.button(ui, "one step back (Left)").clicked() {
            asked.push(Command::Back);
        }
        let (play, icon, says) = match shown.playing {
            true => (Command::Pause, Icon::Pause, "pause (Space)"),
            false => (Command::Run, Icon::Run, "run (Space)"),
        };
        if icon.button(ui, says).clicked() {
            asked.push(play);
        }
        if Icon::Step.button(ui, "one step forward (Right)").clicked() {
            asked.push(Command::Step);
        }
        ui.separator();
        timeline(ui, shown, &mut asked);
        ui.separator();
        speeds(ui, settings, &mut asked);
        match &shown.reel {
            Some(_) => _ = ui.label("replay").on_hover_text("recorded trajectories of a file"),
            None => seed(ui, shown, &mut asked),
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| looks(ui, settings, view));
    });
    asked
}

/// Shows the time and the timeline. A drag seeks to a step.
fn timeline(ui: &mut Ui, shown: &RunMoment, asked: &mut Vec<Command>) {
    let time = &shown.scene.time;
    ui.label(RichText::new(format!("{:6.2} s", shown.time())).monospace().size(15.0));
    let last = (time.limit / time.step).round().max(1.0) as u64;
    let mut step = shown.step;
    let last = last.max(step);
    ui.spacing_mut().slider_width = (ui.available_width() - 660.0).clamp(60.0, 420.0);
    let slider = ui.add(Slider::new(&mut step, 0..=last).show_value(false));
    named(&slider, Role::Slider, "step");
    if slider.on_hover_text(format!("step {} of at most {last}", shown.step)).changed() {
        asked.push(Command::Seek(step));
    }
}

fn seed(ui: &mut Ui, shown: &RunMoment, asked: &mut Vec<Command>) {
    let mut seed = shown.seed;
    let label = ui.label("seed");
    let field = DragValue::new(&mut seed).range(0..=i64::MAX as u64).update_while_editing(false);
    if ui.add(field).labelled_by(label.id).on_hover_text("seed of all random numbers").changed() {
        asked.push(Command::Seed(seed));
    }
}

fn speeds(ui: &mut Ui, settings: &mut Settings, asked: &mut Vec<Command>) {
    let before = settings.speed;
    let combo = ComboBox::from_id_salt("speed").width(78.0).selected_text(before.label()).show_ui(ui, |ui| {
        for speed in Speed::ALL {
            ui.selectable_value(&mut settings.speed, speed, speed.label());
        }
    });
    named(&combo.response, Role::ComboBox, "speed");
    if settings.speed != before {
        asked.push(Command::Speed(settings.speed));
    }
}

fn looks(ui: &mut Ui, settings: &mut Settings, view: &mut ViewOptions) {
    let mut mode = view.eye.mode();
    let combo = ComboBox::from_id_salt("camera").width(108.0).selected_text(mode.label()).show_ui(ui, |ui| {
        for other in Mode::ALL {
            ui.selectable_value(&mut mode, other, other.label());
        }
    });
    named(&combo.response, Role::ComboBox, "camera");
    if mode != view.eye.mode() {
        view.eye.set_mode(mode);
    }
    let combo =
        ComboBox::from_id_salt("colour").width(98.0).selected_text(settings.coloring.label()).show_ui(ui, |ui| {
            for other in Coloring::ALL {
                ui.selectable_value(&mut settings.coloring, other, other.label());
            }
        });
    named(&combo.response, Role::ComboBox, "colour");
    ui.label("by");
    let combo = ComboBox::from_id_salt("marks").width(84.0).selected_text(settings.marks.label()).show_ui(ui, |ui| {
        for other in Marks::ALL {
            ui.selectable_value(&mut settings.marks, other, other.label());
        }
    });
    named(&combo.response, Role::ComboBox, "marks");
}

/// Gives a control an accessible name for screen readers.
pub(super) fn named(response: &Response, role: Role, name: &str) {
    response.widget_info(|| WidgetInfo::labeled(role, true, name));
}
