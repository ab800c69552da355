//! The builds of people in files.

use throng_figure::Build;
#[cfg(feature = "bvh")]
use {
    glam::DVec3,
    throng_figure::{JOINTS, Joint, Skeleton},
};

/// The builds, and their names in files.
const BUILDS: [(Build, &str); 3] = [(Build::Woman, "woman"), (Build::Man, "man"), (Build::Child, "child")];

/// Returns the name of a build in files.
pub(crate) fn name(build: Build) -> &'static str {
    BUILDS.into_iter().find(|(known, _)| *known == build).map_or("man", |(_, name)| name)
}

/// Returns the build of a name in files.
pub(crate) fn build_named(name: &str) -> Option<Build> {
    BUILDS.into_iter().find(|(_, known)| *known == name).map(|(build, _)| build)
}

/// Returns the build and the height (m) of the skeleton that has the bones closest to these offsets (m, in the axes of
/// the scene): the least sum of squares. The offset of the hips does not count.
#[cfg(feature = "bvh")]
pub(crate) fn fitted(offsets: &[DVec3; JOINTS]) -> (Build, f64) {
    let fit = |build: Build| {
        let unit = Skeleton::scaled(build, 1.0);
        let pairs = || Joint::ALL[1..].iter().map(|&joint| (unit.offset(joint), offsets[joint.index()]));
        let square: f64 = pairs().map(|(unit, _)| unit.length_squared()).sum();
        let height = pairs().map(|(unit, found)| unit.dot(found)).sum::<f64>() / square;
        let error: f64 = pairs().map(|(unit, found)| (found - unit * height).length_squared()).sum();
        (build, height, error)
    };
    let all = BUILDS.map(|(build, _)| fit(build));
    let (build, height, _) = all.into_iter().min_by(|a, b| a.2.total_cmp(&b.2)).unwrap_or(all[0]);
    (build, height)
}

#[cfg(all(test, feature = "bvh"))]
mod tests {
    use super::*;

    #[test]
    fn bones_tell_build_and_height() {
        for (build, name) in BUILDS {
            for height in [0.9, 1.64, 2.1] {
                let skeleton = Skeleton::scaled(build, height);
                // as a file of centimetres with four decimals has them
                let round = |value: f64| (value * 1e6).round() / 1e6;
                let offsets = Joint::ALL.map(|joint| skeleton.offset(joint).to_array().map(round).into());
                let (found, tall) = fitted(&offsets);
                assert_eq!(found, build);
                assert!((tall - height).abs() < 1e-5, "{name}: {tall}");
            }
            assert_eq!(build_named(self::name(build)), Some(build));
        }
    }
}
