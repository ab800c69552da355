//! The files of a project.

use super::xml::Xml;
use crate::error::{Error, Kind};
use crate::file::read_text;
use crate::import::short;
use std::path::{Path, PathBuf};

/// The texts of a project, and the names of their files.
pub(super) struct Project {
    pub name: String,
    pub scene: (PathBuf, String),
    pub behavior: (PathBuf, String),
    /// The local model that the project names.
    pub model: Option<String>,
}

/// Whether a folder holds the scene of a project.
pub(in super::super) fn is_project(folder: &Path) -> bool {
    !ending(folder, "S.xml").is_empty()
}

/// Finds the files of a project: those that belong to a file of it, or those in a folder.
pub(super) fn find(path: &Path) -> Result<Project, Error> {
    if path.is_dir() {
        let scenes = ending(path, "S.xml");
        let [scene] = scenes.as_slice() else { return Err(several(path, "scene", "S.xml", &scenes)) };
        return beside_scene(scene);
    }
    let text = read_text(path)?;
    let xml = Xml::parse(&text).map_err(|error| error.file(path.display().to_string()))?;
    let root = xml.document.root_element();
    let folder = path.parent().unwrap_or(Path::new(""));
    match root.tag_name().name() {
        "Project" => {
            let named = |name: &str| -> Result<PathBuf, Error> {
                let file = xml.text(root, name).map_err(|error| error.file(path.display().to_string()))?;
                Ok(folder.join(file.replace('\\', "/")))
            };
            let mut project = read(&named("scene")?, &named("behavior")?)?;
            project.name = stem(path);
            project.model = root.attribute("model").map(str::to_owned);
            Ok(project)
        }
        "Experiment" => beside_scene(path),
        "BFSM" => {
            let name = stem(path);
            let mut scenes = ending(folder, "S.xml");
            let before = |scene: &PathBuf| stem(scene).strip_suffix('S').is_some_and(|scene| name.starts_with(scene));
            if scenes.iter().any(before) {
                scenes.retain(before);
            }
            let [scene] = scenes.as_slice() else { return Err(several(folder, "scene", "S.xml", &scenes)) };
            read(scene, path)
        }
        other => {
            let shown = short(other);
            Err(Error::new(Kind::NotAScene, format!("this XML has the root <{shown}>: it is no project of Menge's"))
                .hint("a project is a <Project>, a scene (<Experiment>) or a behaviour (<BFSM>)")
                .file(path.display().to_string()))
        }
    }
}

/// Reads the project of a scene, with the behaviour beside it.
fn beside_scene(scene: &Path) -> Result<Project, Error> {
    let folder = scene.parent().unwrap_or(Path::new(""));
    let mut behaviors = ending(folder, "B.xml");
    let name = stem(scene);
    let same = |behavior: &PathBuf| stem(behavior).strip_suffix('B') == name.strip_suffix('S');
    if behaviors.iter().any(same) {
        behaviors.retain(same);
    }
    let [behavior] = behaviors.as_slice() else { return Err(several(folder, "behaviour", "B.xml", &behaviors)) };
    read(scene, behavior)
}

fn read(scene: &Path, behavior: &Path) -> Result<Project, Error> {
    let behavior_name = stem(behavior);
    Ok(Project {
        name: behavior_name.strip_suffix('B').unwrap_or(&behavior_name).to_owned(),
        scene: (scene.to_owned(), read_text(scene)?),
        behavior: (behavior.to_owned(), read_text(behavior)?),
        model: None,
    })
}

/// Returns the files of a folder with names that end in `end`, sorted.
fn ending(folder: &Path, end: &str) -> Vec<PathBuf> {
    let files = std::fs::read_dir(named(folder)).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut files: Vec<PathBuf> =
        files.filter(|path| path.file_name().is_some_and(|name| name.to_string_lossy().ends_with(end))).collect();
    files.sort();
    files
}

/// Returns a folder by a name that is not empty.
fn named(folder: &Path) -> &Path {
    if folder.as_os_str().is_empty() { Path::new(".") } else { folder }
}

fn several(folder: &Path, what: &str, end: &str, files: &[PathBuf]) -> Error {
    let names: Vec<String> = files.iter().take(6).map(|file| stem(file) + ".xml").collect();
    let shown = named(folder).display();
    let message = match names.as_slice() {
        [] => format!("{shown}: there is no {what} of Menge's, a file that ends in {end}"),
        names => format!("{shown} has more than one {what}: {}", names.join(", ")),
    };
    Error::new(Kind::NotAScene, message)
        .hint("open the <Project>, or the one behaviour that is meant: its scene is found beside it")
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
