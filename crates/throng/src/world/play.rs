//! Rules: their state in a world, and their call after each step.

use super::World;
use crate::random::{Purpose, Rng};
use crate::{Error, Rules};
use std::sync::Arc;

/// The rules of a world, and their figures.
#[derive(Clone, Debug, Default)]
pub(crate) struct RulesState {
    rules: Option<Arc<dyn Rules>>,
    names: Vec<String>,
    pub figures: Vec<f64>,
    /// The last error of a change that the world refused.
    refused: Option<Error>,
}

impl RulesState {
    /// Whether there are rules.
    pub fn has_rules(&self) -> bool {
        self.rules.is_some()
    }

    /// Returns the figures with their names, for saving.
    pub fn saved(&self) -> Vec<(String, f64)> {
        self.names.iter().cloned().zip(self.figures.iter().copied()).collect()
    }

    /// Whether these are the names of its figures, in this order.
    pub fn has<'a>(&self, names: impl Iterator<Item = &'a String>) -> bool {
        self.names.iter().eq(names)
    }
}

impl World {
    /// Sets the rules of the world, with all figures at zero.
    ///
    /// # Errors
    /// What the rules lack in this world. The world then has no rules.
    pub fn set_rules(&mut self, rules: Arc<dyn Rules>) -> Result<(), Error> {
        let names = rules.figures();
        let mut figures = vec![0.0; names.len()];
        self.state.game = RulesState::default();
        rules.begin(self, &mut figures)?;
        self.state.game = RulesState { rules: Some(rules), names, figures, refused: None };
        Ok(())
    }

    /// Lets the rules act after a step.
    pub(super) fn play(&mut self) {
        let Some(rules) = self.state.game.rules.take() else { return };
        // the old figures stay readable while the rules compute the new ones
        let mut figures = self.state.game.figures.clone();
        if let Err(error) = rules.act(self, &mut figures) {
            self.state.game.refused = Some(error);
        }
        // unless the rules have replaced themselves
        if self.state.game.rules.is_none() {
            self.state.game.figures = figures;
            self.state.game.rules = Some(rules);
        }
    }

    /// Returns the names and values of the figures, in the order of [`Rules::figures`]. Empty without rules.
    pub fn figures(&self) -> impl ExactSizeIterator<Item = (&str, f64)> {
        self.state.game.names.iter().zip(&self.state.game.figures).map(|(name, &value)| (name.as_str(), value))
    }

    /// Returns a figure of the rules by name.
    pub fn figure(&self, name: &str) -> Option<f64> {
        self.figures().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    /// Returns the state of the game in a few words; empty without rules, or if the rules have nothing to say.
    pub fn standing(&self) -> String {
        self.state.game.rules.as_ref().map_or_else(String::new, |rules| rules.standing(self, &self.state.game.figures))
    }

    /// Returns the last error of a change that the world refused its rules, if any.
    pub fn refused(&self) -> Option<&Error> {
        self.state.game.refused.as_ref()
    }

    /// Returns the `k`-th random number in [0, 1) of the rules after this step: the same for the same seed and step.
    pub fn draw(&self, k: u32) -> f32 {
        Rng { seed: self.state.settings.seed, number: u32::MAX, step: self.state.steps }.nth(k, Purpose::Rules)
    }
}
