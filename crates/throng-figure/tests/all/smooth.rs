//! Motion has no jumps, and is the same in any order of calls.

use crate::paths::all;
use throng_figure::{Joint, Person, Walk};

/// Bounds of the angular speed of joints, rad/s, and of the acceleration of the hips, m/s².
fn bounds(name: &str) -> (f64, f64) {
    match name {
        "2.1 m/s" | "2.6 m/s" | "3.5 m/s" | "start, run, stop" | "1.8 m/s" => (28.0, 16.0),
        _ => (17.0, 16.0),
    }
}

#[test]
fn joints_and_hips_move_smoothly() {
    for (name, samples) in all() {
        for number in 0..4 {
            let walk = Walk::recorded(&Person::new(8, number), &samples).unwrap();
            let (start, end) = walk.span();
            let step = 0.01;
            let (fastest, hardest) = bounds(name);
            let poses: Vec<_> =
                (0..((end - start) / step) as i32).map(|moment| walk.pose(start + f64::from(moment) * step)).collect();
            for (moment, three) in poses.windows(3).enumerate() {
                let time = moment as f64 * step;
                for joint in Joint::ALL {
                    let [a, b] = [&three[0], &three[1]].map(|pose| pose.rotations[joint.index()]);
                    let speed = 2.0 * a.dot(b).abs().min(1.0).acos() / step;
                    assert!(speed < fastest, "{name}: {} turns at {speed} rad/s at {time} s", joint.name());
                }
                let pull = (three[2].hips - 2.0 * three[1].hips + three[0].hips).length() / (step * step);
                assert!(pull < hardest, "{name}: the hips accelerate by {pull} m/s² at {time} s");
            }
        }
    }
}

#[test]
fn poses_do_not_depend_on_the_order_of_calls() {
    for (name, samples) in all() {
        let person = Person::new(8, 2);
        let [walk, again] = [(); 2].map(|()| Walk::recorded(&person, &samples).unwrap());
        let times: Vec<f64> = (0..100).map(|moment| f64::from(moment) * 0.117).collect();
        let forward: Vec<_> = times.iter().map(|&time| walk.pose(time)).collect();
        let backward: Vec<_> = times.iter().rev().map(|&time| again.pose(time)).collect();
        assert!(forward.iter().eq(backward.iter().rev()), "{name}");
    }
}

#[test]
fn the_body_stays_over_its_path() {
    for (name, samples) in all() {
        if name == "right angles" || name == "stop, go" || name == "queue" || name == "start, stop" {
            continue; // smoothing cuts corners
        }
        let walk = Walk::recorded(&Person::new(8, 2), &samples).unwrap();
        for sample in &samples {
            let away = walk.pose(sample.time).hips.truncate().distance(sample.position);
            assert!(away < 0.075, "{name}: {away} m from the agent at {} s", sample.time);
        }
    }
}
