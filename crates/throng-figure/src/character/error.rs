//! Errors of bodies of files.

use super::measured::{HIGHEST, LOWEST};
use crate::pose::Joint;

/// The reason for which a body cannot walk.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CharacterError {
    /// There are no vertices, or no triangles.
    #[error("the body has {vertices} vertices and {triangles} triangles; it needs a mesh that its joints move")]
    Empty {
        /// Number of vertices.
        vertices: usize,
        /// Number of triangles.
        triangles: usize,
    },
    /// Joints are missing that walking needs.
    #[error("missing joints: {}", names(joints))]
    Missing {
        /// The missing joints.
        joints: Vec<Joint>,
    },
    /// The arrays of the body do not fit together.
    #[error("{what}")]
    Mismatch {
        /// What does not fit.
        what: String,
    },
    /// A number is not finite.
    #[error("{what} is not finite; export the body again")]
    NotFinite {
        /// The number.
        what: String,
    },
    /// No joint moves a vertex.
    #[error(
        "vertex {vertex} has no weight for any joint; give each vertex of the mesh a joint (normalise all weights)"
    )]
    NoWeight {
        /// Number of the vertex, from 0.
        vertex: usize,
    },
    /// The body is no size of a person.
    #[error(
        "the body is {height:.4} m tall, and not {LOWEST} to {HIGHEST} m; scale it before export (lengths of glTF are metres)"
    )]
    Height {
        /// Height, m.
        height: f64,
    },
    /// Two joints are at the same place.
    #[error("the joints {} and {} are at the same place; a bone needs a length", from.name(), to.name())]
    NoLength {
        /// One joint.
        from: Joint,
        /// The other joint.
        to: Joint,
    },
    /// A leg does not point down.
    #[error("{} does not point down at rest; export the body in the pose in which it was modelled (T or A pose), without animation", joint.name())]
    NotStanding {
        /// The joint of the thigh or of the shank.
        joint: Joint,
    },
    /// The legs are not of one length.
    #[error(
        "the left leg is {left:.3} m long, the right leg {right:.3} m; legs of a body that walks differ by at most 5 %"
    )]
    Unequal {
        /// Length of the left leg from hip to ankle, m.
        left: f64,
        /// Length of the right leg, m.
        right: f64,
    },
    /// The feet point backwards.
    #[error("the feet point backwards; the names of left and right joints are swapped, or the body is mirrored")]
    Backwards,
}

fn names(joints: &[Joint]) -> String {
    joints.iter().map(|joint| joint.name()).collect::<Vec<_>>().join(", ")
}
