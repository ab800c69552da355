//! People that follow agents live obey the same laws.

use crate::paths::all;
use glam::DVec2;
use throng_figure::measure::FeetMeasure;
use throng_figure::{Joint, Live, Person, Pose, Sample, Skeleton};

#[test]
fn feet_of_live_people_do_not_slide() {
    for (name, samples) in all() {
        // turns within a moment cannot be foreseen
        let sudden = ["right angles", "about face"].contains(&name);
        for number in 0..3 {
            let person = Person::new(3, number);
            let skeleton = Skeleton::new(&person);
            let mut live = Live::new(person, samples[0]).unwrap();
            let mut poses: Vec<Pose> = vec![live.pose()];
            poses.extend(samples[1..].iter().map(|sample| live.step(*sample).unwrap()));
            let mut measure = FeetMeasure::new(&person);
            for (moment, pair) in poses.windows(2).enumerate() {
                for quarter in 0..4 {
                    let share = f64::from(quarter) / 4.0;
                    measure.push((moment as f64 + share) / 25.0, &skeleton.world(&pair[0].towards(&pair[1], share)));
                }
            }
            let report = measure.report();
            let (mean, largest) = if sudden { (0.01, 0.05) } else { (0.006, 0.015) };
            assert!(report.mean_slide < mean && report.largest_slide < largest, "{name}: {report:?}");
            assert!(report.penetration < 0.012, "{name}: {report:?}");
        }
    }
}

#[test]
fn live_people_walk_at_the_cadence_of_recorded_people() {
    let (_, samples) = all().into_iter().find(|(name, _)| *name == "1.3 m/s").unwrap();
    let person = Person::new(3, 4);
    let walk = throng_figure::Walk::recorded(&person, &samples).unwrap();
    let recorded = walk.plants(throng_figure::Side::Left).count();
    let mut live = Live::new(person, samples[0]).unwrap();
    let skeleton = Skeleton::new(&person);
    let mut measure = FeetMeasure::new(&person);
    for sample in &samples[1..] {
        let pose = live.step(*sample).unwrap();
        measure.push(sample.time, &skeleton.world(&pose));
    }
    let steps = measure.report().steps;
    assert!(steps.abs_diff(2 * recorded) <= 4, "{steps} live, {recorded} pairs recorded");
}

#[test]
fn live_people_are_the_same_in_every_run() {
    for (_, samples) in all() {
        let run = || {
            let mut live = Live::new(Person::new(6, 1), samples[0]).unwrap();
            samples[1..].iter().map(|sample| live.step(*sample).unwrap()).collect::<Vec<_>>()
        };
        assert_eq!(run(), run());
    }
}

#[test]
fn live_people_move_smoothly() {
    let steady =
        ["stands", "0.05 m/s", "0.15 m/s", "0.5 m/s", "0.9 m/s", "1.3 m/s", "circle 0.5 m", "sideways 0.3", "wobble"];
    for (name, samples) in all().into_iter().filter(|(name, _)| steady.contains(name)) {
        let mut live = Live::new(Person::new(8, 2), samples[0]).unwrap();
        let mut last = live.pose();
        for sample in &samples[1..] {
            let pose = live.step(*sample).unwrap();
            // the agent begins to move at once; its person needs a step for that
            if sample.time > samples[0].time + 1.5 {
                for (joint, (a, b)) in last.rotations.iter().zip(&pose.rotations).enumerate() {
                    assert!(a.dot(*b) >= 0.0, "{name}: a quaternion changes its sign");
                    let speed = 2.0 * a.dot(*b).min(1.0).acos() * 25.0;
                    assert!(speed < 20.0, "{name}: joint {joint} turns at {speed} rad/s at {} s", sample.time);
                }
                let away = (pose.hips - last.hips).length() * 25.0;
                assert!(away < 3.0, "{name}: the hips move at {away} m/s");
            }
            last = pose;
        }
    }
}

/// Returns a sample of a straight motion.
fn straight(velocity: DVec2, time: f64) -> Sample {
    Sample { time, position: velocity * time, heading: velocity.to_angle() }
}

#[test]
fn a_person_in_the_middle_of_its_way_walks_at_once() {
    for speed in [0.1, 0.3, 0.7, 1.0, 1.3, 1.6, 1.9, 2.5, 3.5] {
        for number in 0..4 {
            let (person, velocity) = (Person::new(3, number), DVec2::from_angle(0.7 * speed) * speed);
            let mut live = Live::moving(person, straight(velocity, 50.0), velocity).unwrap();
            assert!((live.pose().hips.truncate() - velocity * 50.0).length() < 0.06, "{speed} m/s");
            let skeleton = Skeleton::new(&person);
            let mut measure = FeetMeasure::new(&person);
            let mut last = live.pose();
            measure.push(50.0, &skeleton.world(&last));
            for moment in 1..100 {
                let time = 50.0 + f64::from(moment) / 50.0;
                let pose = live.step(straight(velocity, time)).unwrap();
                measure.push(time, &skeleton.world(&pose));
                let away = (pose.hips - last.hips).length() * 50.0;
                assert!((away - speed).abs() < 0.6 + 0.3 * speed, "{speed} m/s: the hips move at {away} m/s");
                last = pose;
            }
            let report = measure.report();
            assert!(report.largest_slide < 0.012 && report.penetration < 0.012, "{speed} m/s: {report:?}");
            assert!(speed < 0.3 || report.steps >= 2, "{speed} m/s: {report:?}");
        }
    }
}

#[test]
fn legs_go_on_from_start_to_start() {
    for speed in [0.5, 1.0, 1.3, 1.6] {
        let (person, velocity) = (Person::new(4, 5), DVec2::new(speed, 0.0));
        let skeleton = Skeleton::new(&person);
        // a foot in the air is at most 1.9 times as fast as in the mean, which is v / (1 - duty)
        // the feet against the hips, moment by moment, each time begun anew
        let feet: Vec<[f64; 2]> = (0..250)
            .map(|moment| {
                let live = Live::moving(person, straight(velocity, 40.0 + f64::from(moment) / 25.0), velocity).unwrap();
                let joints = skeleton.world(&live.pose());
                [Joint::LeftFoot, Joint::RightFoot].map(|foot| joints[foot.index()].position.x - live.pose().hips.x)
            })
            .collect();
        let jumps = feet.windows(2).filter(|pair| {
            let [a, b] = [pair[0], pair[1]];
            (0..2).any(|foot| (a[foot] - b[foot]).abs() * 25.0 > 6.0 * speed)
        });
        // at most once in a cycle of 1.1 s
        assert!(jumps.count() <= 10, "{speed} m/s");
        let (most, least) =
            feet.iter().fold((f64::MIN, f64::MAX), |(most, least), [left, _]| (most.max(*left), least.min(*left)));
        assert!(most - least > 0.25, "{speed} m/s: the legs stand still");
    }
}

#[test]
fn a_start_with_bad_numbers_is_an_error() {
    let sample = straight(DVec2::X, 1.0);
    let person = Person::new(1, 1);
    assert!(Live::moving(person, sample, DVec2::NAN).is_err());
    assert!(Live::moving(person, Sample { heading: f64::INFINITY, ..sample }, DVec2::X).is_err());
    let stands = Live::new(person, sample).unwrap().pose();
    for speed in [0.0, 0.01, 20.0, 1e300] {
        assert_eq!(Live::moving(person, sample, DVec2::X * speed).unwrap().pose(), stands);
    }
}
