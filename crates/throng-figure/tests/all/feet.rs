//! Feet: they do not slide, sink or cross.

use crate::forward::{filed, matrices, point, read};
use crate::paths::{all, driven};
use glam::DVec3;
use proptest::prelude::*;
use throng_figure::measure::{FeetMeasure, FeetReport};
use throng_figure::{Joint, Person, Sample, Side, Skeleton, Walk};

/// The rate of files, and that at which they are read back, 1/s.
const RATE: f64 = 25.0;
const FINE: f64 = 100.0;

fn joints(side: Side) -> [Joint; 2] {
    match side {
        Side::Left => [Joint::LeftFoot, Joint::LeftToeBase],
        Side::Right => [Joint::RightFoot, Joint::RightToeBase],
    }
}

/// Returns the measures of a walk that was written to a file and read back.
fn report(person: &Person, samples: &[Sample]) -> FeetReport {
    let walk = Walk::recorded(person, samples).unwrap();
    let skeleton = Skeleton::new(person);
    let poses = filed(|time| walk.pose(time), walk.span(), RATE);
    let mut measure = FeetMeasure::new(person);
    for moment in 0..((poses.len() - 1) as f64 / RATE * FINE) as i32 {
        let time = f64::from(moment) / FINE;
        measure.push(time, &skeleton.world(&read(&poses, RATE, time)));
    }
    measure.report()
}

fn check(name: &str, report: &FeetReport) -> Result<(), TestCaseError> {
    // a foot of a fast runner lands between two moments of the file
    let fast = ["3.5 m/s", "start, run, stop"].contains(&name);
    let deepest = if fast { 0.011 } else { 0.005 };
    prop_assert!(report.mean_slide < 0.0031, "{name}: {report:?}");
    prop_assert!(report.largest_slide < 0.01, "{name}: {report:?}");
    prop_assert!(report.penetration < deepest, "{name}: {report:?}");
    Ok(())
}

#[test]
fn feet_read_back_from_a_file_do_not_slide_or_sink() {
    for (name, samples) in all() {
        for number in 0..4 {
            let report = report(&Person::new(3, number), &samples);
            check(name, &report).unwrap();
            assert!(report.skating_ratio < 0.15, "{name}: {report:?}");
            if !["2.1 m/s", "2.6 m/s", "3.5 m/s", "start, run, stop"].contains(&name) {
                assert_eq!(report.airborne, 0.0, "{name}: a foot is on the ground in walking");
            }
        }
    }
}

#[test]
fn computed_feet_slide_less_than_a_millimetre() {
    let (_, samples) = all().into_iter().find(|(name, _)| *name == "1.3 m/s").unwrap();
    for number in 0..4 {
        let person = Person::new(3, number);
        let (walk, skeleton) = (Walk::recorded(&person, &samples).unwrap(), Skeleton::new(&person));
        let mut measure = FeetMeasure::new(&person);
        for moment in 0..1200 {
            let time = f64::from(moment) / 100.0;
            measure.push(time, &skeleton.world(&walk.pose(time)));
        }
        let report = measure.report();
        assert!(report.mean_slide < 0.001 && report.penetration < 1e-4, "{report:?}");
    }
}

#[test]
fn feet_do_not_cross() {
    for (name, samples) in all() {
        // within an about-face a foot steps behind the other
        if name == "about face" {
            continue;
        }
        for number in 0..4 {
            let report = report(&Person::new(4, number), &samples);
            assert!(report.least_gap > 0.02, "{name}: {report:?}");
            assert!(report.least_distance > 0.01, "{name}: {report:?}");
        }
    }
}

/// The oracle of the slide: the heel and the ball by matrices, between the planned strike and lift.
#[test]
fn planted_feet_stay_where_they_are() {
    for (name, samples) in all() {
        let person = Person::new(3, 1);
        let walk = Walk::recorded(&person, &samples).unwrap();
        let skeleton = Skeleton::new(&person);
        let (start, end) = walk.span();
        for side in Side::BOTH {
            let [foot, toes] = joints(side);
            for plant in walk.plants(side) {
                let (from, to) = (plant.strike.max(start), plant.lift.min(end));
                let flat = (plant.strike + plant.landing.min(0.3 * (plant.lift - plant.strike))).max(start);
                let mut first: Option<DVec3> = None;
                let mut time = flat;
                while time < to {
                    let placed = matrices(&skeleton, &walk.pose(time));
                    let ball = point(&placed, toes, DVec3::ZERO);
                    let first = *first.get_or_insert(ball);
                    assert!(
                        ball.distance(first) < 1e-3,
                        "{name}: the ball moves at {time} by {}",
                        ball.distance(first)
                    );
                    let ankle = point(&placed, foot, DVec3::ZERO);
                    assert!(ankle.z > 0.9 * -skeleton.offset(toes).z, "{name}");
                    time += 0.013;
                }
                assert!(from <= to, "{name}");
            }
        }
    }
}

#[test]
fn legs_keep_their_length_and_knees_do_not_bend_backwards() {
    for (name, samples) in all() {
        let person = Person::new(9, 5);
        let walk = Walk::recorded(&person, &samples).unwrap();
        let skeleton = Skeleton::new(&person);
        let (start, end) = walk.span();
        let mut time = start;
        while time < end {
            let placed = matrices(&skeleton, &walk.pose(time));
            for [hip, knee, ankle] in [
                [Joint::LeftUpLeg, Joint::LeftLeg, Joint::LeftFoot],
                [Joint::RightUpLeg, Joint::RightLeg, Joint::RightFoot],
            ] {
                let [hip, knee, ankle] = [hip, knee, ankle].map(|joint| point(&placed, joint, DVec3::ZERO));
                let thigh = skeleton.offset(Joint::LeftLeg).length();
                let shank = skeleton.offset(Joint::LeftFoot).length();
                assert!((hip.distance(knee) - thigh).abs() < 1e-9 && (knee.distance(ankle) - shank).abs() < 1e-9);
                // the knee is before the line from hip to ankle, as the pelvis sees it
                let line = (ankle - hip).normalize();
                let off = (knee - hip) - line * (knee - hip).dot(line);
                let facing = placed[Joint::Hips.index()].transform_vector3(DVec3::X);
                assert!(off.dot(facing) > -1e-6, "{name}: a knee bends backwards at {time}");
            }
            time += 0.021;
        }
    }
}

/// Walks with any mixture of speeds, turns, side steps and pauses, with the noise of recorded people.
fn walks() -> impl Strategy<Value = Vec<Sample>> {
    let wave = || (0.2..2.5f64, 0.0..6.3f64);
    (
        (0.05..2.0f64, 0.0..0.4f64, 0.0..0.25f64, 0.0..0.9f64),
        (wave(), wave(), wave()),
        (0.0..0.02f64, any::<u64>()),
        0.0..1.0f64,
    )
        .prop_map(|((speed, change, sideways, turning), (a, b, c), (noise, seed), pauses)| {
            let wave = |(rate, phase): (f64, f64), t: f64| (rate * t + phase).sin();
            let mut samples = driven(12.5, 10.0, |t| {
                let go = if pauses > 0.6 && wave((0.9, b.1), t) > 0.3 { 0.0 } else { 1.0 };
                let forward = speed * (1.0 + change * wave(a, t)) * go;
                (forward, sideways * wave(b, t) * go, turning * wave(c, t))
            });
            let mut state = seed | 1;
            for sample in &mut samples {
                for axis in 0..2 {
                    state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                    sample.position[axis] += noise * ((state >> 33) as f64 / f64::from(1 << 30) - 1.0);
                }
            }
            samples
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn feet_stand_on_any_walk(samples in walks(), number in any::<u64>()) {
        let report = report(&Person::new(1, number), &samples);
        prop_assert!(report.mean_slide < 0.003, "{report:?}");
        prop_assert!(report.largest_slide < 0.01, "{report:?}");
        // runners land between two moments of the file
        let deepest = if report.airborne > 0.0 { 0.011 } else { 0.005 };
        prop_assert!(report.penetration < deepest, "{report:?}");
        // a pelvis that turns over staggered feet sees them closer than they are
        prop_assert!(report.least_gap > -0.08, "{report:?}");
    }
}
