//! Unsaved text in the storage of the studio.

use crate::document::Document;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// An unsaved text and its origin, stored while a document has changes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Draft {
    name: String,
    file: Option<String>,
    text: String,
}

impl Draft {
    /// The storage key of the draft of the open document.
    pub const KEY: &str = "draft";
    /// The storage key of the drafts of other documents, which wait until the user opens them.
    pub const ASIDE: &str = "drafts";

    /// Returns the draft of a document that has changes.
    pub fn of(document: &Document) -> Option<Self> {
        document.changed().then(|| Self {
            name: document.name.to_string(),
            file: document.path.as_ref().map(|path| path.to_string_lossy().into_owned()),
            text: document.text().to_owned(),
        })
    }

    /// Returns the name of the document.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the file, or else the name: what opens the document without its changes.
    pub fn origin(&self) -> &str {
        self.file.as_deref().unwrap_or(&self.name)
    }

    /// Returns the document with its changes. `open` opens the original, which may no longer exist.
    pub fn restore(self, open: impl Fn(&str) -> Result<Document, String>) -> Document {
        let mut document = open(self.origin()).unwrap_or_else(|_| match &self.file {
            Some(file) => Document::of_file(Path::new(file), ""),
            None => Document::new(&self.name, ""),
        });
        document.edit(self.text);
        document
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_saved_comes_back_even_when_its_file_is_gone() {
        let mut document = Document::of_file(Path::new("scenes/ring.toml"), "title = \"a\"\n");
        assert_eq!(Draft::of(&document), None);
        document.edit("title = \"b\"\n".into());
        let draft = Draft::of(&document).unwrap();
        let there = draft.clone().restore(|path| Ok(Document::of_file(Path::new(path), "title = \"c\"\n")));
        let gone = draft.restore(|_| Err("no such file".into()));
        for mut back in [there, gone] {
            assert_eq!((back.text(), back.path.as_deref()), (document.text(), document.path.as_deref()));
            assert!(back.changed() && back.undo() && !back.changed());
        }
    }
}
