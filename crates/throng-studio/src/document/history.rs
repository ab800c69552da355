//! Texts to go back to.

use std::collections::VecDeque;

/// So many edits can be undone.
const MOST: usize = 200;

/// What a text was before each edit, and after each that was undone: bounded, the oldest is forgotten first.
#[derive(Clone, Debug, Default)]
pub struct History {
    before: VecDeque<String>,
    after: Vec<String>,
}

impl History {
    /// An edit replaced this text.
    pub fn push(&mut self, text: String) {
        self.after.clear();
        self.before.push_back(text);
        if self.before.len() > MOST {
            self.before.pop_front();
        }
    }

    /// The text before the last edit, where the text is `now`.
    pub fn undo(&mut self, now: &str) -> Option<String> {
        let text = self.before.pop_back()?;
        self.after.push(now.to_owned());
        Some(text)
    }

    /// The text that was undone last, where the text is `now`.
    pub fn redo(&mut self, now: &str) -> Option<String> {
        let text = self.after.pop()?;
        self.before.push_back(now.to_owned());
        Some(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_is_forgotten_and_an_edit_ends_redoing() {
        let mut history = History::default();
        (0..MOST + 5).for_each(|k| history.push(k.to_string()));
        let mut now = "end".to_owned();
        let mut undone = 0;
        while let Some(text) = history.undo(&now) {
            (now, undone) = (text, undone + 1);
        }
        assert_eq!((now.as_str(), undone), ("5", MOST));
        assert_eq!(history.redo(&now).as_deref(), Some("6"));
        history.push(now);
        assert_eq!(history.redo("x"), None);
    }
}
