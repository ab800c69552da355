//! Status messages, the requested trace, and the published state.

use super::App;
use crate::play::{Command, RunMoment, Trouble};
use crate::state::State;
use crate::view::Mode;
use eframe::egui::{Label, RichText, Sense, Ui};

impl App {
    /// Shows the current error, or else the current message. A click dismisses the message.
    pub(super) fn said(&mut self, ui: &mut Ui, trouble: Option<&Trouble>) {
        let wrong = self.wrong(trouble);
        let color = if wrong.is_some() { ui.visuals().error_fg_color } else { ui.visuals().hyperlink_color };
        let reading = || self.reading.map(|_| format!("reading {} …", self.settings.scene));
        let Some(says) = wrong.or_else(reading).or_else(|| self.notice.clone()) else { return };
        let line = RichText::new(says.lines().next().unwrap_or_default()).color(color);
        if ui.add(Label::new(line).truncate().sense(Sense::click())).on_hover_text(&says).clicked() {
            self.notice = None;
        }
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
    pub(super) fn ask_people(&mut self) {
        let wanted = self.views.iter().any(|view| self.settings.draws_people(view.eye.mode() == Mode::Plan));
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
            selected: self.views[0].selected,
            trouble: self.wrong(trouble),
            unsaved: self.document.changed(),
            asks: self.asks().map(|(to, of, name)| to.says(of, &name)),
            ..State::new(shown)
        };
        let told = state.json();
        if told != self.told {
            crate::outside::tell(&self.options, &told);
            self.told = told;
        }
    }
}
