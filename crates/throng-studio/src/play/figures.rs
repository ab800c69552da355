//! The bodies that people of a scene have from files.

use std::path::PathBuf;
use std::sync::Arc;
use throng_figure::Character;
#[cfg(not(target_arch = "wasm32"))]
use throng_record::moment;
use throng_scene::Scene;

/// The bodies of the groups of a scene, as they were read.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    /// The files that the groups name, and their folder.
    of: (Vec<Option<String>>, PathBuf),
    /// By group; `None` for throng's people.
    characters: Vec<Option<Arc<Character>>>,
    /// Why they were not read: all people are throng's.
    pub flaw: Option<String>,
}

impl Figures {
    /// Reads the bodies of a scene.
    pub fn read(scene: &Scene) -> Self {
        let names = scene.groups.iter().map(|group| group.figure.clone()).collect();
        let of: (Vec<_>, _) = (names, scene.origin.folder.clone());
        if of.0.iter().all(Option::is_none) {
            return Self { of, ..Self::default() };
        }
        #[cfg(not(target_arch = "wasm32"))]
        let read = moment::characters(scene).map_err(|error| error.to_string());
        #[cfg(target_arch = "wasm32")]
        let read = Err("a page does not read figures: open the scene in the program's window".to_owned());
        let (characters, flaw) = read.map_or_else(|flaw| (Vec::new(), Some(flaw)), |read| (read, None));
        Self { of, characters, flaw }
    }

    /// Whether the groups of a scene name the same files.
    pub fn fit(&self, scene: &Scene) -> bool {
        let (names, folder) = &self.of;
        *folder == scene.origin.folder && names.iter().eq(scene.groups.iter().map(|group| &group.figure))
    }

    /// Returns the body that people of a group have from a file.
    pub fn character(&self, group: u32) -> Option<&Arc<Character>> {
        self.characters.get(group as usize)?.as_ref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng_figure::Person;

    #[test]
    fn figures_that_cannot_be_read_leave_throngs_people() {
        let mut scene = throng_scene::gallery::scene("circle").unwrap();
        let plain = Figures::read(&scene);
        assert!(plain.flaw.is_none() && plain.fit(&scene) && plain.character(0).is_none());
        scene.groups[0].figure = Some("missing.glb".into());
        assert!(!plain.fit(&scene));
        let missing = Figures::read(&scene);
        assert!(missing.fit(&scene) && missing.flaw.as_ref().unwrap().contains("missing.glb"), "{missing:?}");
        let person = Person::new(0, 3);
        assert_eq!(Character::dressed(missing.character(0).map(Arc::as_ref), person).0, person);
    }
}
