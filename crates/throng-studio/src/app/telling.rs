//! What is asked of the player, and what is told of it.

use super::App;
use crate::play::{Command, Shown, Trouble};
use crate::state::State;

impl App {
    /// Asks the selected agent for what is to be seen of it.
    pub(super) fn explain(&mut self) {
        let wanted = self.view.selected.filter(|_| self.settings.annotations || self.settings.panels.why);
        if wanted != self.explained {
            self.explained = wanted;
            self.player.command(Command::Explain(wanted));
        }
    }

    /// What is wrong with the text, or else with what it says.
    pub(super) fn wrong(&self, trouble: Option<&Trouble>) -> Option<String> {
        self.document.scene().err().map(ToString::to_string).or_else(|| trouble.map(ToString::to_string))
    }

    pub(super) fn tell(&mut self, shown: &Shown, trouble: Option<&Trouble>) {
        let told = State::new(shown, self.view.selected, self.wrong(trouble)).json();
        if told != self.told {
            crate::outside::tell(&self.options, &told);
            self.told = told;
        }
    }
}
