//! The bar below the view: the timeline, playback, speed, camera, colours and seed.

use super::camera_keys::CameraRequest;
use super::icon::Icon;
use super::row::row;
use super::timeline::Timeline;
use crate::play::{Command, RunMoment, Speed};
use crate::settings::Settings;
use crate::view::{Coloring, Marks, Mode, ViewOptions};
use eframe::egui::{ComboBox, DragValue, Response, RichText, Role, Ui, WidgetInfo};
use throng_scene::CameraKey;

/// A control of the bar.
#[derive(Clone, Copy, PartialEq)]
enum Control {
    Restart,
    Back,
    Play,
    Step,
    Time,
    Speed,
    Camera,
    Key,
    Coloring,
    Shape,
    Seed,
}

/// All controls. Those at the end are hidden first in a narrow window.
const CONTROLS: [Control; 11] = [
    Control::Restart,
    Control::Back,
    Control::Play,
    Control::Step,
    Control::Time,
    Control::Speed,
    Control::Camera,
    Control::Key,
    Control::Coloring,
    Control::Shape,
    Control::Seed,
];

/// What the button of keys of the camera does.
const KEY: &str = "key the camera: films of the scene look from here at this time (Insert)";

/// The space before a named control, points.
const SPACE: f32 = 6.0;

/// What the user requests in the bar.
#[derive(Clone, Debug, Default)]
pub struct Asked {
    /// The commands for the player.
    pub commands: Vec<Command>,
    /// The request about the keys of the camera.
    pub camera: Option<CameraRequest>,
}

/// Shows the bar. `keys` are those of the scene's camera, `None` if they cannot be edited.
pub fn bar(
    ui: &mut Ui,
    shown: &RunMoment,
    settings: &mut Settings,
    view: &mut ViewOptions,
    timeline: &mut Timeline,
    keys: Option<&[CameraKey]>,
) -> Asked {
    let mut all = Asked::default();
    timeline.ui(ui, shown, keys.unwrap_or_default(), &mut all);
    let Asked { commands: asked, camera } = &mut all;
    let keyed = keys.is_some() && view.eye.mode() != Mode::Plan;
    let show = |ui: &mut Ui, control: Control| match control {
        Control::Restart => button(ui, Icon::Restart, "restart (R)", Command::Restart, asked),
        Control::Back => button(ui, Icon::Back, "one step back (Left)", Command::Back, asked),
        Control::Play if shown.playing => button(ui, Icon::Pause, "pause (Space)", Command::Pause, asked),
        Control::Play => button(ui, Icon::Run, "run (Space)", Command::Run, asked),
        Control::Step => button(ui, Icon::Step, "one step forward (Right)", Command::Step, asked),
        Control::Time => {
            ui.label(RichText::new(format!("{:6.2} s", shown.time())).monospace()).on_hover_text("time in the scene");
        }
        Control::Speed => {
            let before = settings.speed;
            let all = Speed::ALL.map(|speed| (speed, speed.label().to_string()));
            choice(ui, ("speed", "speed of playback (F)"), &mut settings.speed, 78.0, &all);
            if settings.speed != before {
                asked.push(Command::Speed(settings.speed));
            }
        }
        Control::Camera => {
            let mut mode = view.eye.mode();
            let all = Mode::ALL.map(|mode| (mode, mode.label().to_owned()));
            choice(ui, ("camera", "camera (C)"), &mut mode, 108.0, &all);
            if mode != view.eye.mode() {
                view.eye.set_mode(mode);
            }
        }
        Control::Key => {
            if Icon::Key.button(ui, KEY).clicked() {
                *camera = Some(CameraRequest::Key);
            }
        }
        Control::Coloring => {
            let all = Coloring::ALL.map(|coloring| (coloring, coloring.label().to_owned()));
            choice(ui, ("colour", "quantity that colours the agents"), &mut settings.coloring, 98.0, &all);
        }
        Control::Shape => {
            let all = Marks::ALL.map(|marks| (marks, marks.label().to_owned()));
            choice(ui, ("shape", "shape of the agents"), &mut settings.marks, 84.0, &all);
        }
        Control::Seed if shown.reel.is_some() => {
            ui.label("replay").on_hover_text("recorded trajectories of a file");
        }
        Control::Seed => seed(ui, shown, asked),
    };
    let controls: Vec<Control> = CONTROLS.into_iter().filter(|control| *control != Control::Key || keyed).collect();
    row(ui, "bar", &controls, show, |_| {});
    all
}

fn button(ui: &mut Ui, icon: Icon, says: &str, command: Command, asked: &mut Vec<Command>) {
    if icon.button(ui, says).clicked() {
        asked.push(command);
    }
}

fn seed(ui: &mut Ui, shown: &RunMoment, asked: &mut Vec<Command>) {
    let mut seed = shown.seed;
    ui.add_space(SPACE);
    let label = ui.label(RichText::new("seed").weak());
    let field = DragValue::new(&mut seed).range(0..=i64::MAX as u64).update_while_editing(false);
    if ui.add(field).labelled_by(label.id).on_hover_text("seed of all random numbers").changed() {
        asked.push(Command::Seed(seed));
    }
}

/// Shows a choice behind its name.
fn choice<T: PartialEq + Copy>(
    ui: &mut Ui,
    (name, says): (&str, &str),
    chosen: &mut T,
    width: f32,
    all: &[(T, String)],
) {
    ui.add_space(SPACE);
    ui.label(RichText::new(name).weak());
    let label = all.iter().find(|(one, _)| one == chosen).map_or("", |(_, label)| label);
    let combo = ComboBox::from_id_salt(name).width(width).selected_text(label).show_ui(ui, |ui| {
        for (one, label) in all {
            ui.selectable_value(chosen, *one, label);
        }
    });
    named(&combo.response, Role::ComboBox, name);
    combo.response.on_hover_text(says);
}

/// Gives a control an accessible name for screen readers.
pub(super) fn named(response: &Response, role: Role, name: &str) {
    response.widget_info(|| WidgetInfo::labeled(role, true, name));
}
