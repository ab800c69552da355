//! Opening by name: scenes and trajectory files.

use super::Folder;
use crate::document::Document;
use crate::play::Film;
use std::path::Path;
use std::sync::Arc;
use throng_record::Trajectories;
use throng_scene::{Plugins, gallery};

/// The gallery, the scenes of the plug-ins, and the files of a [`Folder`]: the file system, or the files given to a
/// page.
#[derive(Default)]
pub struct Files {
    /// The source of files.
    pub folder: Folder,
}

impl Files {
    /// Opens a name of the gallery or of the plug-ins, a link, or a file as a document. For a trajectory file, the
    /// document is the scene of its surroundings if there is one.
    ///
    /// # Errors
    /// The name is none of them. The message says what to do.
    pub fn open(&self, scene: &str, plugins: &Arc<Plugins>) -> Result<Document, String> {
        if let Some(document) = crate::share::open(scene).or_else(|| Document::named(scene, plugins)) {
            return Ok(document);
        }
        if self.is_film(scene) {
            return Ok(self.place(Path::new(scene), plugins).unwrap_or_else(Document::empty));
        }
        if let Some(imported) = self.folder.import(Path::new(scene)) {
            return imported.map(|document| document.with(plugins));
        }
        match self.folder.text(Path::new(scene)) {
            Some(text) => Ok(self.folder.document(scene, text?)),
            None => Err(gallery::scene(scene).err().map_or_else(String::new, |error| error.to_string())),
        }
    }

    /// Whether the name is a trajectory file to replay.
    pub fn is_film(&self, scene: &str) -> bool {
        Trajectories::are_in(scene) && self.folder.holds(Path::new(scene))
    }

    /// Returns the trajectory file of this name with the surroundings of the document, or `None` if the name is no
    /// trajectory file.
    pub fn film(&self, scene: &str, place: &Document) -> Option<Film> {
        let place = place.scene().ok().map(|scene| (place.name.clone(), scene.clone()));
        self.is_film(scene).then(|| Film { path: scene.into(), bytes: self.folder.bytes(scene), place })
    }

    /// Returns the scene file or the scene of the gallery that has the name of a trajectory file. A number at the end
    /// of the name is ignored.
    fn place(&self, film: &Path, plugins: &Arc<Plugins>) -> Option<Document> {
        let beside = film.with_extension("toml");
        if let Some(Ok(text)) = self.folder.text(&beside) {
            return Some(self.folder.document(&beside.display().to_string(), text));
        }
        let name = film.file_stem()?.to_str()?;
        let first = name.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end_matches('-');
        Document::named(name, plugins).or_else(|| Document::named(first, plugins))
    }
}

/// Returns the file to open among files that arrive together: the first trajectory file, else the first file.
pub(super) fn chosen(names: &[String]) -> Option<String> {
    names.iter().find(|name| Trajectories::are_in(name)).or(names.first()).cloned()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn a_film_has_the_place_of_the_scene_that_is_called_as_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let (files, plugins) = (Files::default(), Arc::default());
        let file = |name: &str, text: &str| {
            std::fs::write(folder.path().join(name), text).unwrap();
            folder.path().join(name).display().to_string()
        };
        for (film, scene) in
            [("circle.csv", "circle"), ("circle-12.csv", "circle"), ("ring-1000.csv", "ring-1000"), ("x.csv", "new")]
        {
            let film = file(film, "");
            let document = files.open(&film, &plugins).unwrap();
            assert_eq!(&*document.name, scene, "{film}");
            let film = files.film(&film, &document).unwrap();
            assert_eq!(film.place.map(|(name, _)| name).as_deref(), Some(scene));
        }
        let own = file("circle.toml", "title = \"mine\"\n[[group]]\nplace.point = [1, 2]\n");
        let document = files.open(&folder.path().join("circle.csv").display().to_string(), &plugins).unwrap();
        assert_eq!((document.origin(), &*document.scene().unwrap().title), (own.clone(), "mine"));
        assert!(files.film(&own, &document).is_none() && files.film("circle", &document).is_none());
        assert!(files.open("no such scene", &plugins).unwrap_err().contains("no such scene"));
    }

    #[test]
    fn a_floor_plan_becomes_a_document() {
        let folder = tempfile::tempdir().unwrap();
        let (files, plugins) = (Files::default(), Arc::default());
        let path = folder.path().join("hall.geojson");
        let polygon = |layer: &str, x: f64| {
            format!(
                r#"{{"type":"Feature","properties":{{"layer":"{layer}"}},"geometry":{{"type":"Polygon","coordinates":
                [[[{x},0],[20,0],[20,9],[{x},9],[{x},0]]]}}}}"#
            )
        };
        let text = |exit: &str| {
            let features = [polygon("floor", 0.0), polygon(exit, 18.0), polygon("axes", 1.0)].join(",");
            format!(r#"{{"type":"FeatureCollection","features":[{features}]}}"#)
        };
        std::fs::write(&path, text("exit")).unwrap();
        let document = files.open(&path.display().to_string(), &plugins).unwrap();
        assert_eq!((&*document.name, &document.path), ("hall", &None));
        assert!(document.text().starts_with("# layer `axes`: a shape"), "{}", document.text());
        assert_eq!(document.scene().unwrap().groups.len(), 1);
        std::fs::write(&path, text("way out")).unwrap();
        assert!(files.open(&path.display().to_string(), &plugins).unwrap_err().contains("it has no exit"));
    }

    #[test]
    fn of_files_that_come_together_the_film_is_opened() {
        let names = |names: &[&str]| names.iter().map(|name| name.to_string()).collect::<Vec<_>>();
        assert_eq!(chosen(&names(&["a.toml", "b.csv"])).as_deref(), Some("b.csv"));
        assert_eq!(chosen(&names(&["a.toml", "b.toml"])).as_deref(), Some("a.toml"));
        assert_eq!(chosen(&[]), None);
    }
}
