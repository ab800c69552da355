//! A body as a file has it.

use super::CharacterError;
use crate::pose::{JOINTS, Joint};
use glam::{DVec3, Vec3};

/// A body at rest, as it was modelled: it stands, with its arms in any direction. Lengths are metres, z is up. It may face in
/// any horizontal direction, and its ground is where its lowest vertex is.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RestBody {
    /// Where the joints are, in the order of [`Joint::ALL`]. `Spine`, `Neck`, the hands and the toes may be missing.
    pub joints: [Option<DVec3>; JOINTS],
    /// Positions of the vertices.
    pub positions: Vec<DVec3>,
    /// Unit normals; empty: they are computed from the triangles.
    pub normals: Vec<Vec3>,
    /// The joints that move each vertex, by their numbers in [`Joint::ALL`].
    pub numbers: Vec<[u8; 4]>,
    /// The weights of these joints. Their sum is greater than 0.
    pub weights: Vec<[f32; 4]>,
    /// Red, green, blue (sRGB) of each vertex.
    pub colours: Vec<[u8; 3]>,
    /// Triangles, counterclockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// The joints that a body may lack.
const OPTIONAL: [Joint; 6] =
    [Joint::Spine, Joint::Neck, Joint::LeftHand, Joint::RightHand, Joint::LeftToeBase, Joint::RightToeBase];

impl RestBody {
    /// Checks that the arrays fit together and that the numbers are finite.
    pub(super) fn check(&self) -> Result<(), CharacterError> {
        let (vertices, triangles) = (self.positions.len(), self.triangles.len());
        if vertices == 0 || triangles == 0 {
            return Err(CharacterError::Empty { vertices, triangles });
        }
        let missing = |joint: &Joint| self.joints[joint.index()].is_none() && !OPTIONAL.contains(joint);
        let joints: Vec<Joint> = Joint::ALL.into_iter().filter(missing).collect();
        if !joints.is_empty() {
            return Err(CharacterError::Missing { joints });
        }
        let mismatch = |what: String| Err(CharacterError::Mismatch { what });
        let counts = [
            ("normals", self.normals.len(), self.normals.is_empty()),
            ("numbers of joints", self.numbers.len(), false),
            ("weights", self.weights.len(), false),
            ("colours", self.colours.len(), false),
        ];
        if let Some((name, count, _)) = counts.iter().find(|(_, count, absent)| !absent && *count != vertices) {
            return mismatch(format!("the body has {vertices} vertices, but {count} {name}"));
        }
        let outside = |triangle: &[u32; 3]| triangle.iter().any(|&vertex| vertex as usize >= vertices);
        if let Some(at) = self.triangles.iter().position(outside) {
            return mismatch(format!("triangle {at} names a vertex that does not exist ({vertices} vertices)"));
        }
        if let Some(at) = self.numbers.iter().position(|all| all.iter().any(|&joint| usize::from(joint) >= JOINTS)) {
            return mismatch(format!("vertex {at} names a joint that does not exist"));
        }
        let not_finite = |what: String| Err(CharacterError::NotFinite { what });
        let lost = |joint: &Joint| self.joints[joint.index()].is_some_and(|position| !position.is_finite());
        if let Some(joint) = Joint::ALL.into_iter().find(lost) {
            return not_finite(format!("the position of joint {}", joint.name()));
        }
        if let Some(at) = self.positions.iter().position(|position| !position.is_finite()) {
            return not_finite(format!("the position of vertex {at}"));
        }
        if let Some(at) = self.normals.iter().position(|normal| !normal.is_finite()) {
            return not_finite(format!("the normal of vertex {at}"));
        }
        let light = |weights: &[f32; 4]| {
            let sum: f32 = weights.iter().sum();
            !(sum.is_finite() && sum > 0.0 && weights.iter().all(|&weight| weight >= 0.0))
        };
        match self.weights.iter().position(light) {
            Some(vertex) => Err(CharacterError::NoWeight { vertex }),
            None => Ok(()),
        }
    }
}
