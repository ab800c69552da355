//! Status messages, the requested trace, and the published state.

use super::App;
use crate::panels::Explained;
use crate::play::{Command, RunMoment, Trouble};
use crate::state::State;
use crate::view::Mode;
use eframe::egui::{Context, Label, RichText, Sense, Ui, vec2};

/// How long a passing message is shown, seconds.
const PASSING: f64 = 6.0;

impl App {
    /// Shows a message for some seconds.
    pub(super) fn pass(&mut self, says: String) {
        self.passing = Some((says, self.ctx.input(|input| input.time) + PASSING));
    }

    /// Returns the message that is shown for some seconds.
    fn passing(&mut self, now: f64) -> Option<String> {
        let (says, until) = self.passing.take().filter(|(_, until)| *until > now)?;
        self.ctx.request_repaint_after_secs((until - now) as f32);
        self.passing.insert((says, until)).0.clone().into()
    }

    /// Shows the current error, or else the current message. A click dismisses the message.
    pub(super) fn said(&mut self, ui: &mut Ui, trouble: Option<&Trouble>) {
        let Some(says) = self.saying(trouble) else { return };
        let wrong = self.wrong(trouble).is_some();
        let color = if wrong { ui.visuals().error_fg_color } else { ui.visuals().hyperlink_color };
        let line = RichText::new(says.lines().next().unwrap_or_default()).color(color);
        if ui.add(Label::new(line).truncate().sense(Sense::click())).on_hover_text(&says).clicked() {
            (self.notice, self.passing) = (None, None);
        }
    }

    /// Returns the current error, or else the current message.
    pub(super) fn saying(&mut self, trouble: Option<&Trouble>) -> Option<String> {
        let passing = self.passing(self.ctx.input(|input| input.time));
        let reading = || self.reading.map(|_| format!("reading {} …", self.settings.scene));
        self.wrong(trouble).or_else(reading).or(passing).or_else(|| self.notice.clone())
    }

    /// Fills the place of the view while nothing plays, with the error if there is one.
    pub(super) fn nothing(&self, ui: &mut Ui, trouble: Option<&Trouble>) {
        ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
        if self.wrong(trouble).is_some() {
            let says = format!("{} cannot be played: its text has an error.", self.document.name);
            ui.centered_and_justified(|ui| ui.label(RichText::new(says).heading()));
        }
    }

    /// Shows the window that explains the selected agent.
    pub(super) fn show_why(&mut self, ctx: &Context, shown: &RunMoment) {
        let (view, selected) = (self.place, self.views[0].selected);
        let projector = self.views[0].eye.projector(glam::Vec2::new(view.width(), view.height()));
        let body = selected.and_then(|number| shown.frame.bodies.iter().find(|body| body.number == number));
        let at = body.and_then(|body| projector.pixel(body.center())).map(|at| view.min + vec2(at.x, at.y));
        let (settings, typeface) = (&self.settings, &self.options.typeface);
        let mut open = settings.panels.why;
        if self.why.ui(ctx, &mut open, &Explained { shown, selected, at, view, settings, typeface }) {
            self.views[0].select_next(shown);
        }
        self.settings.panels.why = open;
    }

    /// Requests the decision trace of the selected agent if any layer or panel shows it.
    pub(super) fn explain(&mut self) {
        let wanted = self.views[0]
            .selected
            .filter(|_| self.settings.annotations || self.settings.panels.why || self.settings.layers.paths);
        if wanted != self.explained {
            self.explained = wanted;
            self.player.command(Command::Explain(wanted));
        }
    }

    /// Requests people if any view draws them.
    pub(super) fn ask_people(&mut self, shown: Option<&RunMoment>) {
        let draws = |shown: &RunMoment, plan: bool| self.settings.draws_people(&shown.scene, plan);
        let wanted =
            shown.is_some_and(|shown| self.views.iter().any(|view| draws(shown, view.eye.mode() == Mode::Plan)));
        if wanted != self.people {
            self.people = wanted;
            self.player.command(Command::People(wanted));
        }
    }

    /// Returns the error of the text, or else the error of the run.
    pub(super) fn wrong(&self, trouble: Option<&Trouble>) -> Option<String> {
        self.document.scene().err().map(ToString::to_string).or_else(|| trouble.map(ToString::to_string))
    }

    pub(super) fn tell(&mut self, shown: &RunMoment, trouble: Option<&Trouble>) {
        let state = State {
            frames: self.ctx.cumulative_frame_nr(),
            selected: self.views[0].selected,
            trouble: self.wrong(trouble),
            unsaved: self.document.changed(),
            why: self.settings.panels.why,
            asks: self.asks().map(|(to, of, name)| to.says(of, &name)).or_else(|| self.naming()),
            ..State::new(shown)
        };
        let told = state.json();
        if told != self.told {
            crate::outside::tell(&self.options, &told);
            self.told = told;
        }
    }
}
