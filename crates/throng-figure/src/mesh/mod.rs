//! The body: a mesh with weights for the joints of a skeleton.

mod clothes;
mod looks;
mod tubes;

pub use looks::{LOOKS, Look, Region};

use crate::person::Build;
use crate::pose::{JOINTS, Placed, Skeleton};
use glam::{DVec3, Mat4, Vec3};

/// How finely a body is modelled. Vertices are those of the body, and of what only some looks wear or carry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Level {
    /// 1104 + 346 vertices: files, and pictures closer than 8 m.
    Fine,
    /// 704 + 262 vertices: hundreds of people.
    Medium,
    /// 352 + 116 vertices: thousands of people.
    Coarse,
    /// 128 + 34 vertices: people in the distance.
    Blocks,
}

impl Level {
    /// All levels, the finest first.
    pub const ALL: [Level; 4] = [Level::Fine, Level::Medium, Level::Coarse, Level::Blocks];

    /// Returns the level for a height in a picture, pixels.
    ///
    /// ```
    /// use throng_figure::Level;
    ///
    /// let levels = [140.0, 139.0, 60.0, 59.0, 22.0, 21.0].map(Level::for_height);
    /// use Level::{Blocks, Coarse, Fine, Medium};
    /// assert_eq!(levels, [Fine, Medium, Medium, Coarse, Coarse, Blocks]);
    /// ```
    pub fn for_height(pixels: f64) -> Level {
        match pixels {
            140.0.. => Level::Fine,
            60.0.. => Level::Medium,
            22.0.. => Level::Coarse,
            _ => Level::Blocks,
        }
    }
}

/// A body of height 1 m in the pose of the skeleton at rest: scale it by the height of the person.
///
/// All looks share the mesh. They differ in the colours of its regions, and in which of the regions of clothes they wear:
/// [`triangles_of`](Self::triangles_of) are the triangles of a look.
///
/// ```
/// use throng_figure::{Build, Level, Look, Mesh};
///
/// let mesh = Mesh::new(Build::Man, Level::Medium);
/// assert!(mesh.triangles.iter().flatten().all(|&vertex| (vertex as usize) < mesh.positions.len()));
/// let colours = mesh.colours(&Look::new(3));
/// assert_eq!(colours.len(), mesh.positions.len());
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Positions of the vertices, in heights of the person.
    pub positions: Vec<Vec3>,
    /// Unit normals, outward.
    pub normals: Vec<Vec3>,
    /// The joints that move each vertex, by their numbers in [`Joint::ALL`](crate::Joint::ALL).
    pub joints: Vec<[u8; 4]>,
    /// The weights of these joints. Their sum is 1.
    pub weights: Vec<[f32; 4]>,
    /// The region of each vertex; empty for the mesh of a [`Character`](crate::Character), which has colours of its own.
    pub regions: Vec<Region>,
    /// Triangles, counterclockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Returns the body of a build at a level.
    pub fn new(build: Build, level: Level) -> Mesh {
        let mut mesh = Mesh::default();
        tubes::add_body(&mut mesh, build, level);
        mesh.find_normals();
        mesh
    }

    /// Returns the colour of each vertex with a look: red, green, blue (sRGB). What the look does not wear is black.
    pub fn colours(&self, look: &Look) -> Vec<[u8; 3]> {
        self.regions.iter().map(|&region| look.colour(region).unwrap_or_default()).collect()
    }

    /// Returns the regions of the mesh that a look wears: looks that wear the same have the same triangles.
    pub fn worn(&self, look: &Look) -> Vec<Region> {
        let worn = |region: &Region| look.wears(*region) && self.regions.contains(region);
        Region::ALL.into_iter().filter(worn).collect()
    }

    /// Returns the triangles of what a look wears, which are closed surfaces.
    pub fn triangles_of(&self, look: &Look) -> Vec<[u32; 3]> {
        let worn = |triangle: &&[u32; 3]| triangle.iter().all(|&vertex| look.wears(self.regions[vertex as usize]));
        self.triangles.iter().filter(worn).copied().collect()
    }

    /// Returns the positions of the vertices in the world, m, by linear blend skinning.
    ///
    /// `skeleton` and `joints` are those of a person of `height` (m).
    pub fn posed(&self, skeleton: &Skeleton, height: f64, joints: &[Placed; JOINTS]) -> Vec<DVec3> {
        let binds = skeleton.binds();
        let vertices = self.positions.iter().zip(self.joints.iter().zip(&self.weights));
        vertices
            .map(|(position, (numbers, weights))| {
                let position = position.as_dvec3() * height;
                let moved = numbers.iter().zip(weights).map(|(&number, &weight)| {
                    let (joint, bind) = (&joints[usize::from(number)], &binds[usize::from(number)]);
                    let own = bind.turn * (position - bind.position);
                    (joint.position + joint.rotation * own) * f64::from(weight)
                });
                moved.sum()
            })
            .collect()
    }

    /// Returns positions (m) and unit normals of the vertices relative to `origin`, for pictures.
    ///
    /// `skeleton` and `joints` are those of a person of `height` (m). [`posed`](Self::posed) is the exact form.
    pub fn skinned(
        &self,
        skeleton: &Skeleton,
        height: f64,
        joints: &[Placed; JOINTS],
        origin: DVec3,
    ) -> (Vec<Vec3>, Vec<Vec3>) {
        let moved = skeleton.skin_matrices(joints, origin);
        let vertices = self.positions.iter().zip(&self.normals).zip(self.joints.iter().zip(&self.weights));
        vertices
            .map(|((position, normal), (numbers, weights))| {
                let parts = numbers.iter().zip(weights).filter(|(_, weight)| **weight > 0.0);
                let matrix =
                    parts.fold(Mat4::ZERO, |sum, (&number, &weight)| sum + moved[usize::from(number)] * weight);
                let normal = matrix.transform_vector3(*normal).normalize_or(Vec3::Z);
                (matrix.transform_point3(*position * height as f32), normal)
            })
            .unzip()
    }

    pub(crate) fn find_normals(&mut self) {
        let mut normals = vec![Vec3::ZERO; self.positions.len()];
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|vertex| self.positions[vertex as usize]);
            let normal = (b - a).cross(c - a);
            for &vertex in triangle {
                normals[vertex as usize] += normal;
            }
        }
        self.normals = normals.into_iter().map(|normal| normal.normalize_or(Vec3::Z)).collect();
    }
}
