//! The export window: what a file is for, the settings of its recording, and the progress. The studio stays usable while
//! it records.

use super::Chosen;
use super::bar::named;
use super::purposes::{purpose_of, purposes};
use super::request::{RecordRequest, WIDEST};
use crate::play::{RunMoment, models_of};
use crate::record::{Format, Which};
use eframe::egui::{
    Align2, Button, ComboBox, Context, DragValue, Grid, Pos2, ProgressBar, RichText, Role, TextEdit, Ui, Window, vec2,
};
use std::path::{Path, PathBuf};

/// The width of texts, points.
const WIDTH: f32 = 320.0;

/// The recording window.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// Whether the window is open.
    pub open: bool,
    /// The values of the fields.
    pub wish: RecordRequest,
    /// The name of the scene that the fields are for.
    of: String,
    /// The outcome of the last recording: a message or an error.
    pub said: Option<Result<String, String>>,
}

/// A request of the user.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recorded {
    /// Starts a recording.
    Begin,
    /// Completes the recording with the frames that exist.
    Finish,
    /// Cancels the recording and removes its file.
    Cancel,
}

/// The context of the window.
pub struct Beside<'a> {
    /// The shown moment.
    pub shown: &'a RunMoment,
    /// Width and height of the view, pixels.
    pub size: [u32; 2],
    /// The upper right corner of the view.
    pub corner: Pos2,
    /// The description of the camera.
    pub camera: &'a str,
    /// The completed share of the recording under way.
    pub share: Option<f32>,
    /// Returns an unused file name for a name and an ending.
    pub unused: &'a dyn Fn(&str, &str) -> PathBuf,
}

impl Record {
    /// Opens or closes the window.
    pub fn toggle(&mut self) {
        self.open = !self.open;
        self.said = None;
    }

    /// Shows the window while it is open. Returns the request of the user.
    pub fn ui(&mut self, ctx: &Context, beside: &Beside<'_>) -> Option<Recorded> {
        if *self.of != *beside.shown.name || (self.open && self.wish.file.is_empty()) {
            let rate = beside.shown.scene.view.fps.unwrap_or(self.wish.rate);
            let (chosen, size) = match *self.of == *beside.shown.name {
                true => (self.wish.chosen.clone(), self.wish.size),
                // another scene has other groups, and its own size of pictures
                false => (Chosen::default(), beside.shown.scene.view.size),
            };
            self.wish = RecordRequest { from: 0.0, to: None, rate, size, chosen, ..self.wish.clone() };
            self.of = beside.shown.name.to_string();
            self.name(beside);
        }
        let mut open = self.open;
        let window = Window::new("Export").open(&mut open).collapsible(false).resizable(false);
        let window = window.pivot(Align2::RIGHT_TOP).default_pos(beside.corner + vec2(-12.0, 12.0));
        let asked = window.show(ctx, |ui| {
            ui.add_enabled_ui(beside.share.is_none(), |ui| self.fields(ui, beside));
            ui.add_space(6.0);
            self.below(ui, beside)
        });
        self.open &= open;
        asked.and_then(|asked| asked.inner.flatten())
    }

    /// Chooses an unused file name.
    fn name(&mut self, beside: &Beside<'_>) {
        self.name_as(beside, self.wish.format.ending());
    }

    /// Chooses an unused file name with an ending.
    fn name_as(&mut self, beside: &Beside<'_>, ending: &str) {
        let path = (beside.unused)(&beside.shown.name, ending);
        self.wish.file = path.display().to_string();
    }

    fn fields(&mut self, ui: &mut Ui, beside: &Beside<'_>) {
        let now = purpose_of(self.wish.format, self.wish.file.trim());
        let mut chosen = now;
        Grid::new("record").num_columns(2).spacing([14.0, 6.0]).show(ui, |ui| {
            let wish = &mut self.wish;
            ui.label("for");
            let title = now.map_or(wish.format.label(), |purpose| purpose.title);
            let combo = ComboBox::from_id_salt("format").width(206.0).selected_text(title).show_ui(ui, |ui| {
                for purpose in purposes() {
                    ui.selectable_value(&mut chosen, Some(purpose), purpose.title).on_hover_text(purpose.says);
                }
            });
            named(&combo.response, Role::ComboBox, "format");
            ui.end_row();
            let label = ui.label("file");
            ui.add(TextEdit::singleline(&mut wish.file).desired_width(206.0)).labelled_by(label.id);
            ui.end_row();
            span(ui, wish, beside);
            models(ui, wish, beside);
            match wish.format {
                Format::Trajectories => {
                    wish.chosen.fields(ui, &beside.shown.setting, Path::new(wish.file.trim()));
                }
                _ => pictures(ui, wish, beside),
            }
        });
        if let Some(purpose) = chosen {
            ui.set_max_width(WIDTH);
            ui.label(RichText::new(purpose.says).weak());
        }
        if let Some(purpose) = chosen.filter(|_| chosen != now) {
            self.wish.format = purpose.format;
            self.name_as(beside, purpose.ending);
        } else if let Ok(format) = Format::of(Path::new(self.wish.file.trim())) {
            // a typed ending selects the format
            self.wish.format = format;
        }
    }

    fn below(&mut self, ui: &mut Ui, beside: &Beside<'_>) -> Option<Recorded> {
        if let Some(share) = beside.share {
            ui.add(ProgressBar::new(share).desired_width(WIDTH).show_percentage());
            let buttons = ui.horizontal(|ui| {
                let finish = ui.button("Finish now").on_hover_text("completes the file with the frames so far");
                let finish = finish.clicked().then_some(Recorded::Finish);
                finish.or(ui.button("Cancel").clicked().then_some(Recorded::Cancel))
            });
            return buttons.inner;
        }
        ui.set_max_width(WIDTH);
        match &self.said {
            Some(Ok(says)) => _ = ui.label(says),
            Some(Err(says)) => _ = ui.colored_label(ui.visuals().error_fg_color, says),
            None => {}
        }
        let selection = ui.visuals().selection;
        let button = Button::new(RichText::new("Export").color(selection.stroke.color)).fill(selection.bg_fill);
        let ready = ui.add_enabled(!self.wish.file.trim().is_empty(), button);
        ready.on_hover_text("plays the scene from its start and records it").clicked().then(|| {
            self.said = None;
            Recorded::Begin
        })
    }
}

/// Returns a field for seconds.
fn seconds(value: &mut f64) -> DragValue<'_> {
    DragValue::new(value).speed(0.05).max_decimals(2).suffix(" s")
}

/// Shows the start and the end of the recording.
fn span(ui: &mut Ui, wish: &mut RecordRequest, beside: &Beside<'_>) {
    let (now, limit) = (beside.shown.frame.time, beside.shown.scene.time.limit);
    let label = ui.label("from");
    ui.horizontal(|ui| {
        ui.add(seconds(&mut wish.from).range(0.0..=limit)).labelled_by(label.id);
        if ui.button("start").clicked() {
            wish.from = 0.0;
        }
        if ui.button("now").on_hover_text("the current time").clicked() {
            wish.from = now;
        }
    });
    ui.end_row();
    let label = ui.label("to");
    ui.horizontal(|ui| {
        match &mut wish.to {
            Some(to) => _ = ui.add(seconds(to).range(wish.from..=limit)).labelled_by(label.id),
            None => _ = ui.label("the end"),
        }
        if wish.to.is_some() && ui.button("end").clicked() {
            wish.to = None;
        }
        if ui.button("now ").on_hover_text("the current time").clicked() {
            wish.to = Some(now.max(wish.from));
        }
        if wish.to.is_none() && ui.button("after 10 s").clicked() {
            wish.to = Some((wish.from + 10.0).min(limit));
        }
    });
    ui.end_row();
}

/// Shows the choice between two models.
fn models(ui: &mut Ui, wish: &mut RecordRequest, beside: &Beside<'_>) {
    let Some(other) = &beside.shown.beside else { return };
    let [own, other] = [&beside.shown.scene, &other.scene].map(|scene| models_of(scene));
    let mut all = vec![(Which::Own, own), (Which::Other, other)];
    if wish.format != Format::Trajectories {
        all.insert(0, (Which::Both, "both, side by side".into()));
    }
    ui.label("models");
    let now = wish.which();
    let shown = all.iter().find(|(which, _)| *which == now).map_or("", |(_, name)| name).to_owned();
    let combo = ComboBox::from_id_salt("models").width(206.0).selected_text(shown).show_ui(ui, |ui| {
        for (which, name) in all {
            if ui.selectable_label(which == now, name).clicked() {
                wish.which = which;
            }
        }
    });
    named(&combo.response, Role::ComboBox, "models");
    ui.end_row();
}

/// Shows the rate, size and style of pictures.
fn pictures(ui: &mut Ui, wish: &mut RecordRequest, beside: &Beside<'_>) {
    let label = ui.label("pictures per second");
    ui.add(DragValue::new(&mut wish.rate).speed(0.2).range(0.1..=120.0)).labelled_by(label.id);
    ui.end_row();
    let label = ui.label("speed");
    ui.add(DragValue::new(&mut wish.speed_up).speed(0.05).range(0.01..=1000.0).suffix(" ×"))
        .labelled_by(label.id)
        .on_hover_text("seconds of the scene per second of video");
    ui.end_row();
    ui.label("size");
    ui.horizontal(|ui| {
        let mut size = wish.size_beside(beside.shown, beside.size);
        let [width, height] = &mut size;
        let field = |ui: &mut Ui, side, name| {
            let field = ui.add(DragValue::new(side).range(16..=WIDEST));
            named(&field, Role::SpinButton, name);
            field.changed()
        };
        let changed = field(ui, width, "width") | {
            ui.label("×");
            field(ui, height, "height")
        };
        if changed {
            wish.size = Some(size);
        }
        if wish.size.is_some() && ui.button("as the view").clicked() {
            wish.size = None;
        }
    });
    ui.end_row();
    ui.label("camera");
    ui.label(beside.camera).on_hover_text("the view as it is when the recording begins");
    ui.end_row();
    ui.label("");
    ui.checkbox(&mut wish.legend, "title, time and key");
    ui.end_row();
}
