//! Damaged trajectories: clear errors, or people that stand.

use crate::paths::driven;
use glam::DVec2;
use proptest::prelude::*;
use throng_figure::{Error, JOINTS, Live, Person, Pose, Sample, Skeleton, Walk};

fn sample(time: f64, x: f64) -> Sample {
    Sample { time, position: DVec2::new(x, 0.0), heading: 0.0 }
}

fn is_sane(person: &Person, pose: &Pose) -> bool {
    let joints = Skeleton::new(person).world(pose);
    joints.len() == JOINTS
        && joints.iter().all(|joint| joint.position.is_finite() && (joint.rotation.length() - 1.0).abs() < 1e-6)
        && joints.iter().all(|joint| joint.position.z > -0.02 && joint.position.z < 1.1 * person.height)
}

#[test]
fn errors_name_the_sample() {
    let person = Person::new(1, 1);
    let error = |samples: &[Sample]| Walk::recorded(&person, samples).unwrap_err();
    assert_eq!(error(&[]), Error::Empty);
    assert_eq!(error(&[sample(0.0, 0.0), sample(f64::NAN, 1.0)]), Error::NotFinite { index: 1 });
    assert_eq!(error(&[sample(0.0, f64::INFINITY)]), Error::NotFinite { index: 0 });
    assert_eq!(error(&[sample(0.0, 0.0), sample(1.0, 0.0), sample(1.0, 0.0)]), Error::Time { index: 2, time: 1.0 });
    assert_eq!(error(&[sample(0.0, 0.0), sample(1e6, 0.0)]), Error::TooLong { duration: 1e6 });
    assert!(error(&[sample(2.0, 0.0), sample(1.0, 0.0)]).to_string().contains("sort the samples"));
    let mut live = Live::new(person, sample(0.0, 0.0)).unwrap();
    let pose = live.pose();
    assert_eq!(live.step(sample(0.0, 0.0)), Err(Error::Time { index: 1, time: 0.0 }));
    assert_eq!(live.step(sample(1.0, f64::NAN)), Err(Error::NotFinite { index: 1 }));
    assert_eq!(live.pose(), pose);
}

#[test]
fn one_sample_is_a_standing_person() {
    let person = Person::new(1, 1);
    let walk = Walk::recorded(&person, &[sample(5.0, 2.0)]).unwrap();
    for time in [f64::NAN, f64::NEG_INFINITY, 0.0, 5.0, 1e12] {
        let pose = walk.pose(time);
        assert!(is_sane(&person, &pose));
        assert!(pose.hips.truncate().distance(DVec2::new(2.0, 0.0)) < 0.04);
    }
}

#[test]
fn people_that_jump_are_elsewhere_at_once() {
    let person = Person::new(1, 1);
    let mut samples = driven(25.0, 8.0, |_| (1.2, 0.0, 0.0));
    for sample in samples.iter_mut().skip(100) {
        sample.position.y += 10.0;
    }
    let walk = Walk::recorded(&person, &samples).unwrap();
    let mut live = Live::new(person, samples[0]).unwrap();
    for (index, sample) in samples.iter().enumerate().skip(1) {
        for pose in [walk.pose(sample.time), live.step(*sample).unwrap()] {
            assert!(is_sane(&person, &pose), "sample {index}");
            assert!(pose.hips.truncate().distance(sample.position) < 0.25, "sample {index}");
        }
    }
}

#[test]
fn extreme_people_have_poses() {
    let samples = driven(5.0, 4.0, |_| (1.0, 0.0, 0.5));
    for height in [f64::NAN, -1.0, 0.0, 0.7, 2.4, 1e9] {
        let person = Person::new(1, 1).with_height(height);
        let walk = Walk::recorded(&person, &samples).unwrap();
        assert!((0..40).all(|moment| is_sane(&person, &walk.pose(f64::from(moment) / 10.0))), "height {height}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::default())]

    #[test]
    fn any_numbers_have_sane_poses(
        steps in prop::collection::vec((0.001..3.0f64, -8.0..8.0f64, -8.0..8.0f64, -10.0..10.0f64), 1..30),
        times in prop::collection::vec(-5.0..60.0f64, 10),
    ) {
        let person = Person::new(1, 1);
        let mut time = 0.0;
        let samples: Vec<Sample> = steps
            .iter()
            .map(|&(step, x, y, heading)| {
                time += step;
                Sample { time, position: DVec2::new(x, y), heading }
            })
            .collect();
        let walk = Walk::recorded(&person, &samples).unwrap();
        for time in times {
            prop_assert!(is_sane(&person, &walk.pose(time)));
        }
        let mut live = Live::new(person, samples[0]).unwrap();
        for sample in &samples[1..] {
            let pose = live.step(*sample).unwrap();
            prop_assert!(pose.hips.is_finite() && pose.rotations.iter().all(|rotation| rotation.is_normalized()));
        }
    }
}
