//! Sets: meshes that are only looked at.

#[cfg(feature = "glb")]
use crate::formats::{FormatFlaw, glb};
use glam::{DMat3, DVec3, Vec3};

/// A set to look at: triangles with colours, seen from both sides. Metres, z up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SetMesh {
    /// The positions of the vertices.
    pub positions: Vec<Vec3>,
    /// The normal of each vertex, of length 1.
    pub normals: Vec<Vec3>,
    /// The colour of each vertex, sRGB.
    pub colors: Vec<[u8; 3]>,
    /// The vertices of the triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Whether it stands in place of the ground and the obstacles, which are not drawn then.
    pub replaces: bool,
}

impl SetMesh {
    /// Reads all meshes of a file in memory, at rest: binary glTF 2.0 (`.glb`), or glTF with everything embedded (`.gltf`).
    /// Its axis y points up. Colours are those of materials, of vertices, and of textures (PNG, JPEG, WebP) where a vertex is
    /// on them. Parts that one sees through (`BLEND` with an opacity below 0.5) are left out.
    ///
    /// ```
    /// let error = throng_record::SetMesh::read(b"no set").unwrap_err();
    /// assert_eq!(error.why, "the file does not begin like binary glTF");
    /// ```
    ///
    /// # Errors
    /// The file is no glTF, has no triangles, is compressed or damaged, or has more than 2,000,000 triangles or 4,000,000
    /// vertices.
    #[cfg(feature = "glb")]
    pub fn read(bytes: &[u8]) -> Result<Self, FormatFlaw> {
        glb::set::read(bytes)
    }

    /// Returns the set with its origin at a place, turned by an angle (radians, counter-clockwise from above), and with
    /// another length of its unit.
    #[must_use]
    pub fn placed(mut self, at: DVec3, turn: f64, scale: f64) -> Self {
        let turn = DMat3::from_rotation_z(turn);
        self.positions.iter_mut().for_each(|point| *point = (at + turn * point.as_dvec3() * scale).as_vec3());
        self.normals.iter_mut().for_each(|normal| *normal = (turn * normal.as_dvec3()).as_vec3());
        self
    }
}
