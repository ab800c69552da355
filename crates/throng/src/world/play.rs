//! Rules: what happens after each step, and what is remembered of it.

use super::World;
use crate::random::{Dice, Purpose};
use crate::{Error, Rules};
use std::sync::Arc;

/// The rules of a world, and their figures.
#[derive(Clone, Debug, Default)]
pub(super) struct Game {
    rules: Option<Arc<dyn Rules>>,
    names: Vec<String>,
    pub figures: Vec<f64>,
    /// What the world last refused them.
    refused: Option<Error>,
}

impl Game {
    /// The figures by name, to be saved.
    pub fn saved(&self) -> Vec<(String, f64)> {
        self.names.iter().cloned().zip(self.figures.iter().copied()).collect()
    }

    /// Whether these are the names of its figures, in this order.
    pub fn has<'a>(&self, names: impl Iterator<Item = &'a String>) -> bool {
        self.names.iter().eq(names)
    }
}

impl World {
    /// Lets a game be played by these rules from now on, its figures at zero.
    ///
    /// # Errors
    /// What the rules miss in this world; then it has none.
    pub fn set_rules(&mut self, rules: Arc<dyn Rules>) -> Result<(), Error> {
        let names = rules.figures();
        let mut figures = vec![0.0; names.len()];
        self.game = Game::default();
        rules.begin(self, &mut figures)?;
        self.game = Game { rules: Some(rules), names, figures, refused: None };
        Ok(())
    }

    /// After a step.
    pub(super) fn play(&mut self) {
        let Some(rules) = self.game.rules.take() else { return };
        // the old ones stay to be seen while the rules make the new ones
        let mut figures = self.game.figures.clone();
        if let Err(error) = rules.act(self, &mut figures) {
            self.game.refused = Some(error);
        }
        // unless the rules have put others in their place
        if self.game.rules.is_none() {
            self.game.figures = figures;
            self.game.rules = Some(rules);
        }
    }

    /// The figures of the rules: names and values, in the order of [`Rules::figures`]. None without rules.
    pub fn figures(&self) -> impl ExactSizeIterator<Item = (&str, f64)> {
        self.game.names.iter().zip(&self.game.figures).map(|(name, &value)| (name.as_str(), value))
    }

    /// A figure of the rules, by name.
    pub fn figure(&self, name: &str) -> Option<f64> {
        self.figures().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    /// How the game stands, a few words; empty where there is nothing to say.
    pub fn standing(&self) -> String {
        self.game.rules.as_ref().map_or_else(String::new, |rules| rules.standing(self, &self.game.figures))
    }

    /// What the world last refused its rules, if anything.
    pub fn refused(&self) -> Option<&Error> {
        self.game.refused.as_ref()
    }

    /// The `k`-th random number in [0, 1) of the rules after this step: the same for the same seed and step.
    pub fn draw(&self, k: u32) -> f32 {
        Dice { seed: self.settings.seed, number: u32::MAX, step: self.steps }.nth(k, Purpose::Rules)
    }
}
