//! The presets of a scene, and the numbers of its sliders.

use super::document::Document;
use super::set::Override;
use crate::error::{Error, Kind};
use crate::scene::{AboutPreset, Scene};

impl Scene {
    /// Returns the scene with the changes of one of its presets ([`About::presets`](crate::About::presets)).
    ///
    /// # Errors
    /// The scene has no preset of this name. The hint lists its presets.
    pub fn with_preset(&self, name: &str) -> Result<Self, Error> {
        let presets = &self.about.presets;
        let Some(preset) = presets.iter().find(|preset| preset.name == name) else {
            let error = Error::new(Kind::UnknownKey, format!("the scene has no preset `{name}`"));
            let names: Vec<&str> = presets.iter().map(|preset| preset.name.as_str()).collect();
            return Err(match names[..] {
                [] => error.hint("it has no presets: change values with --set"),
                _ => error.hint(format!("there is: {}", names.join(", "))),
            });
        };
        let mut scene = self.clone();
        preset.with.iter().try_for_each(|(path, value)| scene.set(path, &value.to_string()))?;
        Ok(scene)
    }

    /// Returns the number at a path, written as for [`Scene::set`]; `None` if the scene leaves it out. The path of a key of
    /// all groups needs a number in each group; the first counts.
    ///
    /// ```
    /// let scene = throng_scene::gallery::scene("circle")?;
    /// assert_eq!(scene.number("group.walkers.body.radius")?, Some(0.2));
    /// assert_eq!(scene.number("time_gap")?, None);
    /// assert!(scene.number("group.walkers.name").is_err());
    /// # Ok::<(), throng_scene::Error>(())
    /// ```
    ///
    /// # Errors
    /// The path does not exist, or the scene has a value there that is no number.
    pub fn number(&self, path: &str) -> Result<Option<f64>, Error> {
        self.document()?.number(path)
    }
}

/// Returns the document with a number of a slider changed.
pub(super) fn with_number(document: &Document, path: &str, number: f64) -> Document {
    document.with(Override::new(path, &number.to_string()))
}

/// Returns the documents with one more change of a preset each.
pub(super) fn with_changes<'a>(
    document: &Document,
    preset: &'a AboutPreset,
) -> impl Iterator<Item = (&'a str, Document)> {
    let changes = preset.with.iter();
    changes.scan(document.clone(), |document, (path, value)| {
        *document = document.with(Override::new(path, &value.to_string()));
        Some((path.as_str(), document.clone()))
    })
}
