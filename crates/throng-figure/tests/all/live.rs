//! People that follow agents live obey the same laws.

use crate::paths::all;
use throng_figure::measure::FeetMeasure;
use throng_figure::{Live, Person, Pose, Skeleton};

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
