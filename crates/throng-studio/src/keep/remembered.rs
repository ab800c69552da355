//! What is remembered from one time to the next, as JSON in the storage of the window or the browser.

use eframe::Storage;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// What was remembered under a key; `None` if there is nothing, or nothing of this kind.
pub fn remembered<T: DeserializeOwned>(storage: &dyn Storage, key: &str) -> Option<T> {
    serde_json::from_str(&storage.get_string(key)?).ok()
}

/// Remembers something under a key.
pub fn remember<T: Serialize>(storage: &mut dyn Storage, key: &str, what: &T) {
    // what cannot be said in JSON is not remembered: settings and drafts can
    if let Ok(said) = serde_json::to_string(what) {
        storage.set_string(key, said);
    }
}
