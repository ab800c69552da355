//! Groups by their names.

use std::collections::HashMap;

/// The names that come while a file is read, in the order in which they come.
#[derive(Debug, Default)]
pub(super) struct Names {
    names: Vec<String>,
    index: HashMap<String, u32>,
}

impl Names {
    /// The index of a name.
    pub(super) fn index(&mut self, name: &str) -> u32 {
        if let Some(&index) = self.index.get(name) {
            return index;
        }
        let index = self.names.len() as u32;
        self.index.insert(name.to_owned(), index);
        self.names.push(name.to_owned());
        index
    }

    pub(super) fn into_names(self) -> Vec<String> {
        self.names
    }
}
