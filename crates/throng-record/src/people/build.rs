//! The builds of people in files.

use glam::DVec3;
use throng_figure::{Build, JOINTS, Joint, Legs, Skeleton};

/// The error, relative to all bones, up to which bones are those of a build.
const ALIKE: f64 = 1e-3;

/// Returns the build and the height (m) of the skeleton with the bones closest to these offsets (m, in the axes of the
/// scene): the least sum of squares; and whether it has these bones. The offset of the hips does not count.
pub(crate) fn fitted(offsets: &[DVec3; JOINTS]) -> (Build, f64, bool) {
    let fit = |build: Build| {
        let unit = Skeleton::scaled(build, 1.0);
        let pairs = || Joint::ALL[1..].iter().map(|&joint| (unit.offset(joint), offsets[joint.index()]));
        let square: f64 = pairs().map(|(unit, _)| unit.length_squared()).sum();
        let height = pairs().map(|(unit, found)| unit.dot(found)).sum::<f64>() / square;
        let error: f64 = pairs().map(|(unit, found)| (found - unit * height).length_squared()).sum();
        (build, height, error / (square * height * height))
    };
    let all = Build::ALL.map(fit);
    let (build, height, error) = all.into_iter().min_by(|a, b| a.2.total_cmp(&b.2)).unwrap_or(all[0]);
    (build, height, error < ALIKE * ALIKE)
}

/// Returns the legs of a skeleton with these offsets, for a person of this height (m) with ankles that are not lower than
/// `ankle` (m). Feet are as long as their insteps are.
pub(crate) fn legs_of(offsets: &[DVec3; JOINTS], height: f64, ankle: f64) -> Legs {
    let of = |joint: Joint| offsets[joint.index()] / height;
    let (known, toes) = (Legs::of(Build::Man), of(Joint::LeftToeBase));
    let longer = toes.x / known.ball;
    Legs {
        thigh: of(Joint::LeftLeg).length(),
        shank: of(Joint::LeftFoot).length(),
        ankle: ankle / height,
        foot: known.foot * longer,
        heel: known.heel * longer,
        ball: toes.x,
        toe_height: (ankle / height + toes.z).max(0.0),
        hip: of(Joint::LeftUpLeg).y.abs(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bones_tell_build_and_height() {
        for build in Build::ALL {
            for height in [0.9, 1.64, 2.1] {
                let skeleton = Skeleton::scaled(build, height);
                // as a file of centimetres with four decimals has them
                let round = |value: f64| (value * 1e6).round() / 1e6;
                let offsets = Joint::ALL.map(|joint| skeleton.offset(joint).to_array().map(round).into());
                let (found, tall, alike) = fitted(&offsets);
                assert!(found == build && alike);
                assert!((tall - height).abs() < 1e-5, "{build:?}: {tall}");
                let (legs, known) = (legs_of(&offsets, tall, height * 0.04), Legs::of(build));
                assert!((legs.leg() - known.leg()).abs() < 1e-4 && (legs.hip - known.hip).abs() < 1e-4, "{legs:?}");
                assert!((legs.foot - known.foot).abs() < 1e-4, "{legs:?}");
                let mut longer = offsets;
                longer[Joint::LeftLeg.index()] *= 1.05;
                assert!(!fitted(&longer).2);
            }
        }
    }
}
