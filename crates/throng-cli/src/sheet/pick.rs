//! Picks the scenes of a sheet.

use crate::failure::Failure;
use crate::source::{Changes, Loaded};
use std::path::{Path, PathBuf};
use throng_draw::Section;
use throng_scene::gallery;

/// Returns the scenes that `names` stand for, and their sections. A group of the gallery has its own section, also the
/// group of the papers, which names the citations; scenes named individually share a section without a heading. Without
/// names, returns the whole gallery.
///
/// # Errors
/// A name is neither a group nor a scene, or a file is not a scene.
pub fn pick(names: &[PathBuf]) -> Result<(Vec<Section>, Vec<Loaded>), Failure> {
    let all: Vec<PathBuf> = gallery::groups().map(|(group, _)| group.into()).collect();
    let (mut sections, mut scenes): (Vec<Section>, Vec<Loaded>) = (Vec::new(), Vec::new());
    for name in if names.is_empty() { &all } else { names } {
        let group = gallery::groups().find(|(group, _)| name.as_path() == Path::new(group));
        let cites = name.as_path() == Path::new(gallery::PAPERS);
        let (heading, members) = match group {
            _ if cites => (gallery::PAPERS, gallery::papers().iter().map(|(name, _)| name.into()).collect()),
            Some((group, members)) => (group, members.map(PathBuf::from).collect()),
            None => ("", vec![name.clone()]),
        };
        let loaded = members.iter().map(|member: &PathBuf| load(member)).collect::<Result<Vec<Loaded>, Failure>>()?;
        let names = loaded.iter().map(|loaded| match &loaded.scene.about.shows {
            Some(citation) if cites => citation.clone(),
            _ => loaded.name.clone(),
        });
        match sections.last_mut() {
            Some(last) if last.heading.is_empty() && heading.is_empty() => last.names.extend(names),
            _ => sections.push(Section { heading: heading.into(), names: names.collect() }),
        }
        scenes.extend(loaded);
    }
    Ok((sections, scenes))
}

/// Reads a scene. The error for an unknown name lists the groups too.
fn load(path: &Path) -> Result<Loaded, Failure> {
    Changes::default().load(path).map_err(|failure| match failure {
        Failure::Error(text) if !path.exists() && path.extension().is_none() => {
            let groups: Vec<&str> = gallery::groups().map(|(group, _)| group).chain([gallery::PAPERS]).collect();
            Failure::Error(format!("{text}; groups: {}", groups.join(", ")))
        }
        other => other,
    })
}
