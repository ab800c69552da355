//! Forward kinematics by matrices: the oracle of the tests. It knows the parents of joints and their offsets, and
//! nothing of how poses are made.

use glam::{DMat4, DVec3};
use throng_figure::{JOINTS, Joint, Pose, Skeleton};

/// Returns the matrix of each joint in the world.
pub fn matrices(skeleton: &Skeleton, pose: &Pose) -> [DMat4; JOINTS] {
    let mut matrices = [DMat4::IDENTITY; JOINTS];
    for (index, joint) in Joint::ALL.into_iter().enumerate() {
        let rotation = DMat4::from_quat(pose.rotations[index]);
        matrices[index] = match joint.parent() {
            None => DMat4::from_translation(pose.hips) * rotation,
            Some(parent) => {
                let at = Joint::ALL.iter().position(|&joint| joint == parent).unwrap();
                matrices[at] * DMat4::from_translation(skeleton.offset(joint)) * rotation
            }
        };
    }
    matrices
}

/// Returns the place of a point of a joint, given in its axes.
pub fn point(matrices: &[DMat4; JOINTS], joint: Joint, own: DVec3) -> DVec3 {
    matrices[joint.index()].transform_point3(own)
}

/// Returns poses at a rate (1/s), as a file holds them.
pub fn filed(pose: impl Fn(f64) -> Pose, (start, end): (f64, f64), rate: f64) -> Vec<Pose> {
    (0..=((end - start) * rate) as i32).map(|moment| pose(start + f64::from(moment) / rate)).collect()
}

/// Returns the pose between those of a file: the position on a line, the rotations by spherical interpolation of glam.
pub fn read(poses: &[Pose], rate: f64, time: f64) -> Pose {
    let place = (time * rate).clamp(0.0, (poses.len() - 1) as f64);
    let index = (place as usize).min(poses.len().saturating_sub(2));
    let (a, b) = (&poses[index], &poses[(index + 1).min(poses.len() - 1)]);
    let share = place - index as f64;
    Pose {
        hips: a.hips.lerp(b.hips, share),
        rotations: std::array::from_fn(|joint| a.rotations[joint].slerp(b.rotations[joint], share)),
    }
}
