//! The undo history of a text.

use std::collections::VecDeque;

/// The most edits that can be undone.
const MOST: usize = 200;
/// The most edits of a list, and the most letters of a line in it.
const LISTED: usize = 16;
const WORDS: usize = 40;

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

    /// Whether there is no edit to undo.
    pub fn is_empty(&self) -> bool {
        self.before.is_empty()
    }

    /// Returns the last edits, the last first. Successive edits of the same line are one. `now` is the current text.
    pub fn edits(&self, now: &str) -> Vec<PastEdit> {
        let mut found: Vec<PastEdit> = Vec::new();
        let mut after = now;
        for before in self.before.iter().rev() {
            let (edit, full) = (TextChange::new(before, after), found.len() == LISTED);
            match found.last_mut().filter(|last| edit.line.is_some() && last.line == edit.line) {
                Some(last) => last.steps += 1,
                None if full => break,
                None => found.push(PastEdit { says: edit.says(), steps: 1, line: edit.line }),
            }
            after = before;
        }
        found
    }

    /// Returns the text that was undone last. `now` is the current text.
    pub fn redo(&mut self, now: &str) -> Option<String> {
        let text = self.after.pop()?;
        self.before.push_back(now.to_owned());
        Some(text)
    }
}

/// Edits that are undone together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PastEdit {
    /// What was changed, in words.
    pub says: String,
    /// The number of edits.
    pub steps: usize,
    /// The line, if a single line was changed.
    line: Option<usize>,
}

/// The lines in which two texts differ.
struct TextChange<'a> {
    /// The first line, counted from 1.
    first: usize,
    removed: Vec<&'a str>,
    added: Vec<&'a str>,
    /// The line, if it is a single one in both.
    line: Option<usize>,
}

impl<'a> TextChange<'a> {
    fn new(before: &'a str, after: &'a str) -> Self {
        let (before, after): (Vec<&str>, Vec<&str>) = (before.lines().collect(), after.lines().collect());
        let same = before.iter().zip(&after).take_while(|(a, b)| a == b).count();
        let rest = before.len().min(after.len()) - same;
        let end = before.iter().rev().zip(after.iter().rev()).take(rest).take_while(|(a, b)| a == b).count();
        let [removed, added] = [before, after].map(|lines| lines[same..lines.len() - end].to_vec());
        let line = (removed.len() == 1 && added.len() == 1).then_some(same + 1);
        Self { first: same + 1, removed, added, line }
    }

    fn says(&self) -> String {
        let Self { first, removed, added, .. } = self;
        let lines = |count: usize| if count == 1 { "a line".to_owned() } else { format!("{count} lines") };
        let words = |all: &[&str]| {
            let all = all.iter().map(|line| line.trim()).find(|line| !line.is_empty()).unwrap_or_default();
            let short: String = all.chars().take(WORDS).collect();
            if short.len() < all.len() { format!("{short}…") } else { short }
        };
        match (removed.len(), added.len()) {
            (0, 0) => "line ends".into(),
            (0, count) => format!("added {} at {first}: {}", lines(count), words(added)),
            (count, 0) => format!("removed {} at {first}: {}", lines(count), words(removed)),
            (1, 1) => format!("line {first}: {}", words(added)),
            (_, count) => format!("changed {} at {first}: {}", lines(count), words(added)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_have_names() {
        let texts = [
            "a = 1\nb = 2\n",
            "a = 1\nb = 25\n",
            "a = 1\nb = 257\n",
            "a = 1\nb = 257\n[c]\nd = 1\n",
            "b = 257\n[c]\nd = 1\n",
        ];
        let mut history = EditHistory::default();
        texts[..4].iter().for_each(|text| history.push((*text).to_owned()));
        let edits = history.edits(texts[4]);
        let found: Vec<(&str, usize)> = edits.iter().map(|edit| (edit.says.as_str(), edit.steps)).collect();
        assert_eq!(found, [("removed a line at 1: a = 1", 1), ("added 2 lines at 3: [c]", 1), ("line 2: b = 257", 2)]);
        assert_eq!(EditHistory::default().edits("x"), []);
    }

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
