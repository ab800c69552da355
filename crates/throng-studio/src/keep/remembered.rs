//! Persistent values, stored as JSON in the storage of the window or the browser.

use eframe::Storage;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Returns the value stored under a key, `None` if it is missing or has another type.
pub fn remembered<T: DeserializeOwned>(storage: &dyn Storage, key: &str) -> Option<T> {
    serde_json::from_str(&storage.get_string(key)?).ok()
}

/// Stores a value under a key.
pub fn remember<T: Serialize>(storage: &mut dyn Storage, key: &str, what: &T) {
    // settings and drafts always serialise; a value that does not is not stored
    if let Ok(said) = serde_json::to_string(what) {
        storage.set_string(key, said);
    }
}
