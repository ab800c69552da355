//! The bodies that people of files wear.

use std::borrow::Cow;
use throng_figure::{Build, Character, Level, Look, Mesh, Region, Skeleton};

/// The body of a person: throng's of a build with a look, or that of a file, with its number.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PersonBody<'a> {
    /// Throng's body.
    Build(Build, u8),
    /// The body of a file.
    Character(usize, &'a Character),
}

impl<'a> PersonBody<'a> {
    /// Returns the number of the body, and of its look.
    #[cfg(feature = "glb")]
    pub(crate) fn key(self) -> (usize, u8) {
        match self {
            Self::Build(build, look) => (build as usize, look),
            Self::Character(number, _) => (Build::ALL.len() + number, 0),
        }
    }

    /// Returns the name of the body, without its look.
    #[cfg(any(feature = "glb", feature = "usda"))]
    pub(crate) fn name(self) -> Cow<'static, str> {
        match self {
            Self::Build(build, _) => build.name().into(),
            Self::Character(number, _) => format!("figure {}", number + 1).into(),
        }
    }

    /// Returns the look; 0 for a body of a file.
    #[cfg(feature = "usda")]
    pub(crate) fn look(self) -> u8 {
        match self {
            Self::Build(_, look) => look,
            Self::Character(..) => 0,
        }
    }

    /// Returns the body with a look. That of a file has only one.
    #[cfg(feature = "usda")]
    pub(crate) fn with_look(self, look: u8) -> Self {
        match self {
            Self::Build(build, _) => Self::Build(build, look),
            Self::Character(..) => self,
        }
    }

    /// Returns the skeleton for this height, m.
    #[cfg(any(feature = "bvh", feature = "glb", feature = "usda"))]
    pub(crate) fn skeleton(self, height: f64) -> Skeleton {
        match self {
            Self::Build(build, _) => Skeleton::scaled(build, height),
            Self::Character(_, character) => character.skeleton(height),
        }
    }

    /// Returns the mesh for a height of 1 m.
    #[cfg(any(feature = "glb", feature = "usda"))]
    pub(crate) fn mesh(self) -> Cow<'a, Mesh> {
        match self {
            Self::Build(build, _) => Cow::Owned(Mesh::new(build, Level::Fine)),
            Self::Character(_, character) => Cow::Borrowed(character.mesh()),
        }
    }

    /// Returns the regions of a mesh of this body that are worn.
    #[cfg(any(feature = "glb", feature = "usda"))]
    pub(crate) fn worn(self, mesh: &Mesh) -> Vec<Region> {
        match self {
            Self::Build(_, look) => mesh.worn(&Look::new(look)),
            Self::Character(..) => Vec::new(),
        }
    }

    /// Returns the triangles of what is worn of a mesh of this body.
    #[cfg(any(feature = "glb", feature = "usda"))]
    pub(crate) fn triangles(self, mesh: &Mesh) -> Cow<'_, [[u32; 3]]> {
        match self {
            Self::Build(_, look) => mesh.triangles_of(&Look::new(look)).into(),
            Self::Character(..) => (&mesh.triangles[..]).into(),
        }
    }

    /// Returns the colours of the vertices of a mesh of this body.
    #[cfg(any(feature = "glb", feature = "usda"))]
    pub(crate) fn colours(self, mesh: &Mesh) -> Cow<'a, [[u8; 3]]> {
        match self {
            Self::Build(_, look) => mesh.colours(&Look::new(look)).into(),
            Self::Character(_, character) => character.colours().into(),
        }
    }
}
