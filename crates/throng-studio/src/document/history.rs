//! The undo history of a text.

use std::collections::VecDeque;

/// The most edits that can be undone.
const MOST: usize = 200;

/// The texts before each edit and after each undone edit. The oldest text is dropped beyond `MOST`.
#[derive(Clone, Debug, Default)]
pub struct EditHistory {
    before: VecDeque<String>,
    after: Vec<String>,
}

impl EditHistory {
    /// Records the text that an edit replaced.
    pub fn push(&mut self, text: String) {
        self.after.clear();
        self.before.push_back(text);
        if self.before.len() > MOST {
            self.before.pop_front();
        }
    }

    /// Returns the text before the last edit. `now` is the current text.
    pub fn undo(&mut self, now: &str) -> Option<String> {
        let text = self.before.pop_back()?;
        self.after.push(now.to_owned());
        Some(text)
    }

    /// Returns the text that was undone last. `now` is the current text.
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
        let mut history = EditHistory::default();
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
