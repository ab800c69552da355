//! The scene's text: the one document. Whatever edits a scene edits this text, so that nothing a person has written is lost.

mod edit;
mod history;
mod layout;
#[cfg(not(target_arch = "wasm32"))]
mod watched;

pub use edit::Edit;
pub use history::History;
pub use layout::number;
#[cfg(not(target_arch = "wasm32"))]
pub use watched::Watched;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use throng_scene::{Error, Plugins, Scene};

/// A scene's text, where it is from, and what it says.
#[derive(Clone, Debug)]
pub struct Document {
    /// What it is called: a name of the gallery, or the stem of a file's name.
    pub name: Arc<str>,
    /// The file it is saved in, if it has one.
    pub path: Option<PathBuf>,
    /// What the scene can name.
    plugins: Arc<Plugins>,
    text: String,
    /// The text as it was opened or saved.
    saved: String,
    history: History,
    scene: Result<Arc<Scene>, Box<Error>>,
}

impl Document {
    /// A text that is not in a file.
    pub fn new(name: &str, text: impl Into<String>) -> Self {
        let text = text.into();
        let mut document = Self {
            name: name.into(),
            path: None,
            plugins: Arc::default(),
            saved: text.clone(),
            text,
            history: History::default(),
            scene: Ok(Arc::default()),
        };
        document.parse();
        document
    }

    /// A new scene: a square that can be walked on, and a group.
    pub fn empty() -> Self {
        Self::new("new", include_str!("new.toml"))
    }

    /// A scene of the gallery.
    pub fn gallery(name: &str) -> Option<Self> {
        Self::named(name, &Arc::default())
    }

    /// A scene of the plug-ins or of the gallery.
    pub fn named(name: &str, plugins: &Arc<Plugins>) -> Option<Self> {
        Some(Self::new(name, plugins.text(name)?).with(plugins))
    }

    /// The same text, which can name the behaviours and rules of these plug-ins.
    pub fn with(mut self, plugins: &Arc<Plugins>) -> Self {
        if !Arc::ptr_eq(&self.plugins, plugins) {
            self.plugins = plugins.clone();
            self.parse();
        }
        self
    }

    /// What the scene can name.
    pub fn plugins(&self) -> &Arc<Plugins> {
        &self.plugins
    }

    /// The text of a scene file.
    pub fn of_file(path: &Path, text: impl Into<String>) -> Self {
        let name = path.file_stem().map_or_else(|| "scene".into(), |stem| stem.to_string_lossy().into_owned());
        let mut document = Self { path: Some(path.to_owned()), ..Self::new(&name, text) };
        document.parse();
        document
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// What it says; or what is wrong with it, and where.
    pub fn scene(&self) -> Result<&Arc<Scene>, &Error> {
        self.scene.as_ref().map_err(Box::as_ref)
    }

    /// What it said when it was opened or saved; `None` if that was no scene.
    pub fn saved_scene(&self) -> Option<Arc<Scene>> {
        self.read(&self.saved).ok()
    }

    /// Whether there is something that is not saved.
    pub fn changed(&self) -> bool {
        self.text != self.saved
    }

    /// Makes it say something else, which can be undone.
    pub fn edit(&mut self, text: String) {
        if text != self.text {
            self.history.push(std::mem::replace(&mut self.text, text));
            self.parse();
        }
    }

    /// Takes back the last edit; whether there was one.
    pub fn undo(&mut self) -> bool {
        let text = self.history.undo(&self.text);
        self.replaced(text)
    }

    /// Takes back the last undo; whether there was one.
    pub fn redo(&mut self) -> bool {
        let text = self.history.redo(&self.text);
        self.replaced(text)
    }

    fn replaced(&mut self, text: Option<String>) -> bool {
        let found = text.is_some();
        if let Some(text) = text {
            self.text = text;
            self.parse();
        }
        found
    }

    /// It is in a file of this name from now on.
    pub fn saved_in(&mut self, path: &Path) {
        let named = Self::of_file(path, String::new());
        (self.name, self.path) = (named.name, named.path);
        self.mark_saved();
        self.parse();
    }

    /// Takes back all that is not saved, which can be undone.
    pub fn revert(&mut self) {
        self.edit(self.saved.clone());
    }

    /// What opens it again: its file, or its name.
    pub fn origin(&self) -> String {
        self.path.as_ref().map_or_else(|| self.name.to_string(), |path| path.display().to_string())
    }

    /// The text is now what its file holds.
    pub fn mark_saved(&mut self) {
        self.saved.clone_from(&self.text);
    }

    fn parse(&mut self) {
        self.scene = self.read(&self.text);
    }

    /// The scene that a text of this document says.
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
