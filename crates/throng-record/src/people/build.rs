//! The builds of people in files.

use glam::DVec3;
use throng_figure::{Build, JOINTS, Joint, Skeleton};

/// Returns the build and the height (m) of the skeleton with the bones closest to these offsets (m, in the axes of the
/// scene): the least sum of squares. The offset of the hips does not count.
pub(crate) fn fitted(offsets: &[DVec3; JOINTS]) -> (Build, f64) {
    let fit = |build: Build| {
        let unit = Skeleton::scaled(build, 1.0);
        let pairs = || Joint::ALL[1..].iter().map(|&joint| (unit.offset(joint), offsets[joint.index()]));
        let square: f64 = pairs().map(|(unit, _)| unit.length_squared()).sum();
        let height = pairs().map(|(unit, found)| unit.dot(found)).sum::<f64>() / square;
        let error: f64 = pairs().map(|(unit, found)| (found - unit * height).length_squared()).sum();
        (build, height, error)
    };
    let all = Build::ALL.map(fit);
    let (build, height, _) = all.into_iter().min_by(|a, b| a.2.total_cmp(&b.2)).unwrap_or(all[0]);
    (build, height)
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
                let (found, tall) = fitted(&offsets);
                assert_eq!(found, build);
                assert!((tall - height).abs() < 1e-5, "{build:?}: {tall}");
            }
        }
    }
}
