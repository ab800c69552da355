//! Triangle meshes.

use glam::{Vec2, Vec3};
use std::borrow::Cow;

/// A triangle mesh. Its triangles are anticlockwise seen from outside.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Mesh<'a> {
    positions: Cow<'a, [Vec3]>,
    normals: Cow<'a, [Vec3]>,
    colors: Cow<'a, [Vec3]>,
    triangles: Cow<'a, [[u32; 3]]>,
}

/// Why arrays are no mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// The arrays of vertices have different lengths.
    #[error("a mesh of {positions} positions has {other} {name}: give one for each position")]
    Lengths {
        /// The number of positions.
        positions: usize,
        /// The number of the other values.
        other: usize,
        /// What the other values are.
        name: &'static str,
    },
    /// A triangle has a vertex that does not exist.
    #[error(
        "triangle {triangle} has the vertex {vertex}, and the mesh has {positions} vertices: give indices below that"
    )]
    Vertex {
        /// The index of the triangle.
        triangle: usize,
        /// The index of the vertex.
        vertex: u32,
        /// The number of vertices.
        positions: usize,
    },
}

impl<'a> Mesh<'a> {
    /// Creates a mesh of vertices and triangles of vertex indices, anticlockwise seen from outside.
    ///
    /// `normals` point outwards and have length 1. `colors` are linear light, multiplied with the colour of the
    /// instance; an empty list stands for white.
    ///
    /// # Errors
    /// The lists of vertices have different lengths, or a triangle has a vertex that does not exist.
    ///
    /// ```
    /// use glam::Vec3;
    /// use throng_render::Mesh;
    /// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    /// assert!(Mesh::new(corners.clone(), vec![Vec3::Z; 3], vec![], vec![[0, 1, 2]]).is_ok());
    /// assert!(Mesh::new(corners, vec![Vec3::Z; 3], vec![], vec![[0, 1, 3]]).is_err());
    /// ```
    pub fn new(
        positions: impl Into<Cow<'a, [Vec3]>>,
        normals: impl Into<Cow<'a, [Vec3]>>,
        colors: impl Into<Cow<'a, [Vec3]>>,
        triangles: impl Into<Cow<'a, [[u32; 3]]>>,
    ) -> Result<Self, MeshError> {
        let (positions, normals, colors, triangles) =
            (positions.into(), normals.into(), colors.into(), triangles.into());
        let count = positions.len();
        let lengths = |other: usize, name| Err(MeshError::Lengths { positions: count, other, name });
        if normals.len() != count {
            return lengths(normals.len(), "normals");
        }
        if !colors.is_empty() && colors.len() != count {
            return lengths(colors.len(), "colours");
        }
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&vertex| vertex as usize >= count) {
                return Err(MeshError::Vertex { triangle, vertex, positions: count });
            }
        }
        Ok(Self { positions, normals, colors, triangles })
    }

    /// Returns the positions of the vertices, metres.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Returns the normals of the vertices.
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Returns the colours of the vertices, linear light; empty if all are white.
    pub fn colors(&self) -> &[Vec3] {
        &self.colors
    }

    /// Returns the triangles, as indices of vertices.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Appends a flat polygon without crossing edges and without dents, anticlockwise seen from its front. Fewer than
    /// three corners, and polygons without area, add nothing.
    ///
    /// ```
    /// use glam::Vec3;
    /// let mut mesh = throng_render::Mesh::default();
    /// mesh.face(&[Vec3::ZERO, Vec3::X, Vec3::Y]);
    /// assert_eq!(mesh.normals(), [Vec3::Z; 3]);
    /// ```
    pub fn face(&mut self, corners: &[Vec3]) {
        let edges = corners.iter().zip(corners.iter().cycle().skip(1));
        let Some(normal) = edges.map(|(a, b)| a.cross(*b)).sum::<Vec3>().try_normalize() else { return };
        let first = self.positions.len() as u32;
        self.positions.to_mut().extend(corners);
        self.normals.to_mut().extend(corners.iter().map(|_| normal));
        let fan = 1..(corners.len() as u32).saturating_sub(1);
        self.triangles.to_mut().extend(fan.map(|k| [first, first + k, first + k + 1]));
    }

    /// Returns a prism: polygons without crossing edges, extruded from the height `bottom` to the height `top`, metres.
    /// The first ring is the outline, the others are holes; their directions do not matter. Corners that are not finite
    /// are left out.
    ///
    /// ```
    /// use glam::Vec2;
    /// let square = vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    /// assert_eq!(throng_render::Mesh::prism(&[square], 0.0, 3.0).triangles().len(), 12);
    /// ```
    pub fn prism(rings: &[Vec<Vec2>], bottom: f32, top: f32) -> Mesh<'static> {
        let mut mesh = Mesh::default();
        for (k, ring) in rings.iter().enumerate() {
            let mut ring: Vec<Vec2> = ring.iter().copied().filter(|corner| corner.is_finite()).collect();
            let area: f32 = edges(&ring).map(|[a, b]| a.perp_dot(b)).sum();
            if (area < 0.0) == (k == 0) {
                ring.reverse();
            }
            for [a, b] in edges(&ring) {
                mesh.face(&[a.extend(bottom), b.extend(bottom), b.extend(top), a.extend(top)]);
            }
        }
        let (corners, triangles) = divided(rings);
        for (height, normal) in [(top, Vec3::Z), (bottom, Vec3::NEG_Z)] {
            let first = mesh.positions.len() as u32;
            mesh.positions.to_mut().extend(corners.iter().map(|corner| corner.extend(height)));
            mesh.normals.to_mut().extend(corners.iter().map(|_| normal));
            let turned = triangles.iter().map(|&[a, b, c]| if normal.z > 0.0 { [a, b, c] } else { [a, c, b] });
            mesh.triangles.to_mut().extend(turned.map(|face| face.map(|corner| corner + first)));
        }
        mesh
    }

    /// Returns a body of circles about the line from `from` to `to`, of the radii `start` and `end`, with round ends;
    /// metres. It has `around` corners in a circle, 3 to 1024, and half as many rings. A ball is a body from a point to
    /// the same point.
    pub fn capsule(from: Vec3, to: Vec3, [start, end]: [f32; 2], around: u32) -> Mesh<'static> {
        let around = around.clamp(3, 1024);
        let axis = (to - from).normalize_or(Vec3::Z);
        let (side, other) = axis.any_orthonormal_pair();
        let half = (around / 4).max(1);
        let (mut positions, mut normals, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        let rings = (0..=half).map(|ring| (from, start, ring as f32 - half as f32));
        for (centre, radius, ring) in rings.chain((0..=half).map(|ring| (to, end, ring as f32))) {
            let (up, out) = libm::sincosf(ring / half as f32 * std::f32::consts::FRAC_PI_2);
            for corner in 0..around {
                let (sine, cosine) = libm::sincosf(corner as f32 / around as f32 * std::f32::consts::TAU);
                let normal = axis * up + (side * cosine + other * sine) * out;
                positions.push(centre + normal * radius);
                normals.push(normal);
            }
        }
        for ring in 0..2 * half + 1 {
            for corner in 0..around {
                let next = (corner + 1) % around;
                let [a, b] = [ring * around + corner, ring * around + next];
                let [c, d] = [a + around, b + around];
                triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
        Mesh {
            positions: positions.into(),
            normals: normals.into(),
            colors: Cow::default(),
            triangles: triangles.into(),
        }
    }
}

/// Divides a polygon with holes into triangles, anticlockwise; returns its finite corners too.
pub(crate) fn divided(rings: &[Vec<Vec2>]) -> (Vec<Vec2>, Vec<[u32; 3]>) {
    let mut corners: Vec<Vec2> = Vec::new();
    let mut holes: Vec<u32> = Vec::new();
    for (k, ring) in rings.iter().enumerate() {
        if k > 0 {
            holes.push(corners.len() as u32);
        }
        corners.extend(ring.iter().filter(|corner| corner.is_finite()));
    }
    let mut indices: Vec<u32> = Vec::new();
    earcut::Earcut::new().earcut(corners.iter().map(|corner| corner.to_array()), &holes, &mut indices);
    let upwards = |&[a, b, c]: &[u32; 3]| {
        let [a, b, c] = [a, b, c].map(|corner| corners[corner as usize]);
        (b - a).perp_dot(c - a) > 0.0
    };
    let faces = indices.as_chunks::<3>().0.iter();
    let triangles = faces.map(|face| if upwards(face) { *face } else { [face[0], face[2], face[1]] }).collect();
    (corners, triangles)
}

fn edges(polygon: &[Vec2]) -> impl Iterator<Item = [Vec2; 2]> {
    (0..polygon.len()).map(move |corner| [polygon[corner], polygon[(corner + 1) % polygon.len()]])
}
