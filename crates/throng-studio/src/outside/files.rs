//! Opening by name: scenes and trajectory files.

use super::Folder;
use crate::document::Document;
use crate::play::Film;
use std::path::Path;
use std::sync::Arc;
use throng_record::Trajectories;
#[cfg(any(target_arch = "wasm32", test))]
use throng_record::formats::FORMATS;
use throng_scene::Plugins;

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
            None => Err(missing(scene, plugins)),
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

/// Returns the message for a name that is neither a scene nor a file, with similar names of scenes.
fn missing(name: &str, plugins: &Plugins) -> String {
    let path = Path::new(name);
    if path.extension().is_some() || path.components().count() > 1 {
        let folder = std::path::absolute(path).ok().and_then(|path| Some(path.parent()?.display().to_string()));
        return format!("there is no file {name}{}", folder.map_or_else(String::new, |folder| format!(" in {folder}")));
    }
    let near = near(name, plugins.names());
    let near = match near.is_empty() {
        true => String::new(),
        false => format!("did you mean {}? ", near.join(", ")),
    };
    format!("there is no scene and no file `{name}`: {near}`throng list` lists all scenes, other scenes are files")
}

/// Returns at most three names that resemble a name, the nearest first: by the share of their pairs of letters that both
/// have.
fn near<'a>(name: &str, known: Vec<&'a str>) -> Vec<&'a str> {
    let pairs = |word: &str| -> Vec<[char; 2]> {
        let letters: Vec<char> = format!(" {} ", word.to_lowercase()).chars().collect();
        letters.windows(2).map(|two| [two[0], two[1]]).collect()
    };
    let own = pairs(name);
    let likeness = |word: &str| {
        let mut other = pairs(word);
        let all = own.len() + other.len();
        let both =
            own.iter().filter(|pair| other.iter().position(|at| at == *pair).map(|at| other.remove(at)).is_some());
        2.0 * both.count() as f64 / all as f64
    };
    let mut near: Vec<(f64, &str)> = known.into_iter().map(|word| (likeness(word), word)).collect();
    near.retain(|(likeness, _)| *likeness > 0.4);
    near.sort_by(|a, b| b.0.total_cmp(&a.0));
    near.into_iter().take(3).map(|(_, word)| word).collect()
}

/// Returns the message for a file that a page cannot open.
#[cfg(any(target_arch = "wasm32", test))]
pub(super) fn not_in_page(file: &Path) -> String {
    let mut endings: Vec<String> = Vec::new();
    for format in FORMATS.iter().filter(|format| format.is_read()) {
        let ending = format!(".{}", format.ending);
        if !endings.contains(&ending) {
            endings.push(ending);
        }
    }
    let csv = file.with_extension("csv");
    format!(
        "{}: a page opens scenes (.toml) and trajectories ({}). The program converts other trajectories: throng convert {} -o {}",
        file.display(),
        endings.join(", "),
        file.display(),
        csv.display()
    )
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
    fn a_name_that_is_missing_has_near_names() {
        let open = |name: &str| Files::default().open(name, &Arc::default()).unwrap_err();
        let says = open("circel");
        assert!(says.contains("`circel`") && says.contains("did you mean circle"), "{says}");
        assert!(open("boid").contains("boids") && !open("xyz").contains("did you mean"));
        let says = open("plans/mine.toml");
        assert!(says.starts_with("there is no file plans/mine.toml in /") && says.ends_with("plans"), "{says}");
    }

    #[test]
    fn a_page_says_how_to_convert_what_it_does_not_open() {
        let says = not_in_page(Path::new("people.parquet"));
        assert!(says.contains(".csv") && says.ends_with("throng convert people.parquet -o people.csv"), "{says}");
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
