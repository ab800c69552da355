//! Notes about parts of a file that were left out or changed.

/// Notes, each about parts of a file or about the whole file.
#[derive(Debug, Default)]
pub(crate) struct Notes(Vec<(Vec<String>, String)>);

/// The maximum number of parts that a note names. Further parts with the same note are counted.
const NAMED: usize = 3;

impl Notes {
    /// Adds a note about the whole file, a sentence.
    pub(crate) fn whole(&mut self, text: impl Into<String>) {
        self.0.push((vec![], text.into()));
    }

    /// Adds a note about a part. The text must suit several parts as well as one.
    pub(crate) fn about(&mut self, id: &str, text: impl Into<String>) {
        let text = text.into();
        let same = self.0.iter_mut().find(|(ids, known)| !ids.is_empty() && *known == text);
        match same {
            Some((ids, _)) if ids.iter().any(|known| known == id) => {}
            Some((ids, _)) => ids.push(id.to_owned()),
            None => self.0.push((vec![id.to_owned()], text)),
        }
    }

    /// Returns the notes, one a line.
    pub(crate) fn lines(self) -> Vec<String> {
        let line = |(ids, text): (Vec<String>, String)| match ids.as_slice() {
            [] => text,
            [one] => format!("{one}: {text}"),
            [some @ .., last] if ids.len() <= NAMED => format!("{} and {last}: {text}", some.join(", ")),
            [first, second, rest @ ..] => format!("{first}, {second} and {} more: {text}", rest.len()),
        };
        self.0.into_iter().map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_with_the_same_note_share_it() {
        let lines = |ids: &[&str]| {
            let mut notes = Notes::default();
            notes.whole("all");
            ids.iter().for_each(|id| notes.about(id, "left out"));
            notes.about("z", "made larger");
            notes.lines()
        };
        assert_eq!(lines(&["a", "a"]), ["all", "a: left out", "z: made larger"]);
        assert_eq!(lines(&["a", "b", "c"])[1], "a, b and c: left out");
        assert_eq!(lines(&["a", "b", "c", "d", "e"])[1], "a, b and 3 more: left out");
    }
}
