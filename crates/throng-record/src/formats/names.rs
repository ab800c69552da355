//! Groups by name.

use std::collections::HashMap;

/// The names of groups, in the order in which a file mentions them.
#[derive(Debug, Default)]
pub(super) struct Names {
    names: Vec<String>,
    index: HashMap<String, u32>,
}

impl Names {
    /// Returns the index of a name, which is added if it is new.
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
