//! What fields of throng are made from, besides their parameters.

use super::{Flow, Names};
use crate::file::{Path, Problem};
use glam::DVec2;
use std::path;
use std::sync::Arc;
use throng::field::Field;
use throng::space::Place;
use throng_field::Anchor;

/// A scene, as its fields see it. `at` is the path to what the scene says.
pub(crate) trait FieldScene: Names {
    /// Returns the origin of the coordinates of the field, in world coordinates.
    fn origin(&self) -> DVec2;
    /// Returns the lower left and the upper right corner of the scene, in world coordinates.
    fn bounds(&self) -> [DVec2; 2];
    /// Returns the ground and the obstacles, in world coordinates; or the error for a field that moves with agents.
    fn ground(&self, at: &Path) -> Result<&Place, Problem>;
    /// Returns the folder to which names of files are relative.
    fn folder(&self) -> &path::Path;
    /// Returns a field of the scene by its name.
    fn known(&self, name: &str, at: &Path) -> Result<Arc<dyn Field>, Problem>;
    /// Adds the anchors of a sketch of which the field is made, metres from the origin.
    fn add_anchors(&self, anchors: &[Anchor]);
    /// Adds a note about the field.
    fn note(&self, what: &str);
}

/// A place in a scene at which it describes a field.
#[derive(Clone)]
pub(crate) struct FieldContext<'a> {
    pub scene: &'a dyn FieldScene,
    /// The path to the field in the scene.
    pub path: Path,
}

impl FieldContext<'_> {
    /// Returns the context of a key.
    pub fn key(&self, key: &str) -> Self {
        Self { path: self.path.key(key), ..*self }
    }

    /// Returns the context of an entry of a list.
    pub fn index(&self, index: usize) -> Self {
        Self { path: self.path.index(index), ..*self }
    }

    /// Returns the field that the scene chooses here.
    pub fn make(&self, flow: &Flow) -> Result<Arc<dyn Field>, Problem> {
        self.scene.field(flow, &self.path)
    }
}

/// A description from which a field is made.
pub(crate) trait BuildField {
    fn make(&self, at: &FieldContext) -> Result<Arc<dyn Field>, Problem>;

    /// Returns the fields of which it is made, each with its key.
    fn parts(&self) -> Vec<(&'static str, &Flow)> {
        vec![]
    }
}
