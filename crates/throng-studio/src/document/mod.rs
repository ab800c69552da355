//! The text of the scene. It is the only editable representation: every edit of the scene changes this text, so
//! comments and layout survive.

mod camera;
mod edit;
mod history;
mod layout;
mod tokens;
#[cfg(not(target_arch = "wasm32"))]
mod watched;

pub use camera::CameraEdit;
pub use edit::Edit;
pub use history::{EditHistory, PastEdit};
pub use layout::number;
pub use tokens::{Token, tokens};
#[cfg(not(target_arch = "wasm32"))]
pub use watched::Watched;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use throng_scene::{Error, Plugins, Scene};

/// The text of a scene, its origin, and the parsed scene.
#[derive(Clone, Debug)]
pub struct Document {
    /// The name: a name of the gallery, or the stem of the file name.
    pub name: Arc<str>,
    /// The file, if there is one.
    pub path: Option<PathBuf>,
    /// The plug-ins that the scene can refer to.
    plugins: Arc<Plugins>,
    text: String,
    /// The text as opened or last saved.
    saved: String,
    history: EditHistory,
    scene: Result<Arc<Scene>, Box<Error>>,
}

impl Document {
    /// Creates a document without a file.
    pub fn new(name: &str, text: impl Into<String>) -> Self {
        let text = text.into();
        let mut document = Self {
            name: name.into(),
            path: None,
            plugins: Arc::default(),
            saved: text.clone(),
            text,
            history: EditHistory::default(),
            scene: Ok(Arc::default()),
        };
        document.parse();
        document
    }

    /// Creates a new scene: a walkable rectangle and one group.
    pub fn empty() -> Self {
        Self::new("new", include_str!("new.toml"))
    }

    /// Opens a scene of the gallery.
    pub fn gallery(name: &str) -> Option<Self> {
        Self::named(name, &Arc::default())
    }

    /// Opens a scene of the plug-ins or of the gallery.
    pub fn named(name: &str, plugins: &Arc<Plugins>) -> Option<Self> {
        Some(Self::new(name, plugins.text(name)?).with(plugins))
    }

    /// Returns the document with these plug-ins. The scene can refer to their behaviours and rules.
    pub fn with(mut self, plugins: &Arc<Plugins>) -> Self {
        if !Arc::ptr_eq(&self.plugins, plugins) {
            self.plugins = plugins.clone();
            self.parse();
        }
        self
    }

    /// Returns the plug-ins that the scene can refer to.
    pub fn plugins(&self) -> &Arc<Plugins> {
        &self.plugins
    }

    /// Creates the document of a scene file.
    pub fn of_file(path: &Path, text: impl Into<String>) -> Self {
        let name = path.file_stem().map_or_else(|| "scene".into(), |stem| stem.to_string_lossy().into_owned());
        let mut document = Self { path: Some(path.to_owned()), ..Self::new(&name, text) };
        document.parse();
        document
    }

    /// Returns the text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the scene of the text, or the error and its position.
    pub fn scene(&self) -> Result<&Arc<Scene>, &Error> {
        self.scene.as_ref().map_err(Box::as_ref)
    }

    /// Returns the scene as opened or last saved, `None` if that text is invalid.
    pub fn saved_scene(&self) -> Option<Arc<Scene>> {
        self.read(&self.saved).ok()
    }

    /// Whether there are unsaved changes.
    pub fn changed(&self) -> bool {
        self.text != self.saved
    }

    /// Replaces the text, which can be undone.
    pub fn edit(&mut self, text: String) {
        if text != self.text {
            self.history.push(std::mem::replace(&mut self.text, text));
            self.parse();
        }
    }

    /// Undoes the last edit. Returns whether there was one.
    pub fn undo(&mut self) -> bool {
        let text = self.history.undo(&self.text);
        self.replaced(text)
    }

    /// Redoes the last undone edit. Returns whether there was one.
    pub fn redo(&mut self) -> bool {
        let text = self.history.redo(&self.text);
        self.replaced(text)
    }

    /// Whether there is an edit to undo.
    pub fn is_edited(&self) -> bool {
        !self.history.is_empty()
    }

    /// Returns the last edits, the last first.
    pub fn edits(&self) -> Vec<PastEdit> {
        self.history.edits(&self.text)
    }

    fn replaced(&mut self, text: Option<String>) -> bool {
        let found = text.is_some();
        if let Some(text) = text {
            self.text = text;
            self.parse();
        }
        found
    }

    /// Sets the file of the document and marks the text as saved.
    pub fn saved_in(&mut self, path: &Path) {
        let named = Self::of_file(path, String::new());
        (self.name, self.path) = (named.name, named.path);
        self.mark_saved();
        self.parse();
    }

    /// Discards the unsaved changes, which can be undone.
    pub fn revert(&mut self) {
        self.edit(self.saved.clone());
    }

    /// Returns the file, or else the name: what opens the document again.
    pub fn origin(&self) -> String {
        self.path.as_ref().map_or_else(|| self.name.to_string(), |path| path.display().to_string())
    }

    /// Marks the text as saved.
    pub fn mark_saved(&mut self) {
        self.saved.clone_from(&self.text);
    }

    fn parse(&mut self) {
        self.scene = self.read(&self.text);
    }

    /// Parses a text as the scene of this document.
    fn read(&self, text: &str) -> Result<Arc<Scene>, Box<Error>> {
        let file = match &self.path {
            Some(path) => path.display().to_string(),
            None => format!("{}.toml", self.name),
        };
        let folder = self.path.as_deref().and_then(Path::parent).map(Path::to_owned).unwrap_or_default();
        let mut scene = Scene::parse(&file, text)?;
        scene.origin.folder = folder;
        self.plugins.equip(&mut scene);
        Ok(Arc::new(scene))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RING: &str = "[[group]]\nname = \"a\"\ncount = 6\nplace.ring = { radius = 4.0 }\n";

    #[test]
    fn edits_are_undone_and_done_again() {
        let mut document = Document::new("ring", RING);
        assert!(!document.changed() && !document.undo() && !document.redo());
        document.edit(RING.replace('6', "9"));
        assert_eq!(document.scene().unwrap().groups[0].count, Some(9));
        assert!(document.changed() && document.undo() && !document.changed());
        assert_eq!(document.scene().unwrap().groups[0].count, Some(6));
        assert!(document.redo() && !document.redo());
        assert_eq!(document.scene().unwrap().groups[0].count, Some(9));
        document.mark_saved();
        assert!(!document.changed());
    }

    #[test]
    fn what_is_wrong_has_its_line() {
        let mut document = Document::new("ring", RING);
        document.edit(RING.replace("count", "cuont"));
        let error = document.scene().unwrap_err();
        assert_eq!(error.at.map(|(line, _)| line), Some(3), "{error}");
        assert_eq!(document.saved_scene().unwrap().groups[0].count, Some(6));
        assert!(document.undo() && document.scene().is_ok());
    }

    #[test]
    fn every_scene_of_the_gallery_opens() {
        for name in throng_scene::gallery::names() {
            assert!(Document::gallery(name).unwrap().scene().is_ok(), "{name}");
        }
        assert!(Document::gallery("no such scene").is_none());
    }
}
