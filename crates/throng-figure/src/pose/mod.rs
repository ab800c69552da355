//! Poses of a skeleton.

mod body;
mod idle;
mod leg;
mod proportions;
mod skeleton;

pub(crate) use body::{BodyState, pose};
pub(crate) use leg::hip_joints;
pub use proportions::Legs;
pub(crate) use proportions::{ARM_AT_REST, Proportions};
pub(crate) use skeleton::Bind;
pub use skeleton::{JOINTS, Joint, Placed, Skeleton};

use glam::{DQuat, DVec3};

/// A pose: where the hips are, and how each joint is turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Position of the hips in the world, m, z up.
    pub hips: DVec3,
    /// Rotation of each joint against its parent, in the order of [`Joint::ALL`]. That of the hips is in the world.
    pub rotations: [DQuat; JOINTS],
}

impl Pose {
    /// Returns the pose with the signs of quaternions with which none is farther than needed from that of `before`: q
    /// and -q are the same rotation.
    pub fn near(mut self, before: &Pose) -> Pose {
        for (own, before) in self.rotations.iter_mut().zip(&before.rotations) {
            if own.dot(*before) < 0.0 {
                *own = -*own;
            }
        }
        self
    }

    /// Returns the pose a share of the way to `next`, as readers of files compute it: the position on a line, the
    /// rotations along the shorter arc.
    pub fn towards(&self, next: &Pose, share: f64) -> Pose {
        Pose {
            hips: self.hips + (next.hips - self.hips) * share,
            rotations: std::array::from_fn(|i| crate::math::slerp(self.rotations[i], next.rotations[i], share)),
        }
    }
}

/// Returns to which side a person that stands to the degree `still` shifts its weight: -1 (right) to 1 (left).
pub(crate) fn idle_weight(person: &crate::Person, still: f64, time: f64) -> f64 {
    if still > 0.0 { still * idle::weight(person.seed, time) } else { 0.0 }
}
