//! What a picture shows.

use crate::mesh::divided;
use crate::{Light, Material, Mesh};
use glam::{DVec2, DVec3, Mat3, Vec2, Vec3};

/// A scene. The axis z is up; lengths are metres; colours are linear light, 0 to 1.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Scene<'a> {
    /// The ground: a horizontal plane without end at z = 0; `None` for none.
    pub ground: Option<Material>,
    /// The areas on the ground, from the lowest to the highest.
    pub areas: Vec<Area>,
    /// The bodies.
    pub bodies: Vec<Body<'a>>,
    /// The lines, from the lowest to the highest.
    pub lines: Vec<Line>,
    /// The light.
    pub light: Light,
}

/// A body at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Body<'a> {
    /// The mesh.
    pub mesh: &'a Mesh<'a>,
    /// The place of the origin of the mesh, metres.
    pub place: DVec3,
    /// How the mesh is turned and scaled.
    pub turn: Mat3,
    /// The material; its colour is multiplied with the colours of the mesh.
    pub material: Material,
    /// Whether the triangles are seen from both sides, as wings; otherwise the mesh is closed.
    pub thin: bool,
}

impl<'a> Body<'a> {
    /// Returns a closed body with the axis x of its mesh turned to `heading`, radians.
    pub fn standing(mesh: &'a Mesh<'a>, place: DVec3, heading: f32, material: Material) -> Self {
        let (sine, cosine) = libm::sincosf(heading);
        let turn = Mat3::from_cols(Vec3::new(cosine, sine, 0.0), Vec3::new(-sine, cosine, 0.0), Vec3::Z);
        Self { mesh, place, turn, material, thin: false }
    }
}

/// An area on the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// The corners, metres.
    pub(crate) corners: Vec<DVec2>,
    /// The triangles, anticlockwise.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The material.
    pub(crate) material: Material,
}

impl Area {
    /// Creates an area of a polygon without crossing edges: the first ring is the outline, the others are holes; metres.
    /// Corners that are not finite are left out.
    pub fn new(rings: &[Vec<DVec2>], material: Material) -> Self {
        let origin = rings.iter().flatten().copied().find(|corner| corner.is_finite()).unwrap_or_default();
        let near: Vec<Vec<Vec2>> =
            rings.iter().map(|ring| ring.iter().map(|corner| (*corner - origin).as_vec2()).collect()).collect();
        let (corners, triangles) = divided(&near);
        Self { corners: corners.into_iter().map(|corner| corner.as_dvec2() + origin).collect(), triangles, material }
    }
}

/// A line that has a width in the picture. It is not lit and casts no shadow; bodies hide it.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The ends of its parts.
    pub ends: Vec<LineEnd>,
    /// The colour.
    pub color: Vec3,
    /// Whether it lies on the ground, whatever the heights of its ends are.
    pub flat: bool,
}

/// An end of a part of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineEnd {
    /// The position, metres.
    pub at: DVec3,
    /// The width, pixels, up to 4096.
    pub width: f32,
    /// The opacity, 0 to 1.
    pub opacity: f32,
}
