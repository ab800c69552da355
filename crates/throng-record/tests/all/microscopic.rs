//! Tests of the microscopic figures against closed forms and chance.

use glam::DVec2;
use throng_record::pedestrian::{Microscopic, People, Walk};

/// Returns a pedestrian with positions by a formula, a row every 0.1 s.
fn walk(number: u32, from: f64, seconds: f64, place: impl Fn(f64) -> DVec2) -> Walk {
    let times: Vec<f64> = (0..=(10.0 * seconds).round() as u32).map(|k| from + 0.1 * f64::from(k)).collect();
    Walk { number, radius: 0.2, places: times.iter().map(|&time| place(time)).collect(), times }
}

fn of(walks: Vec<Walk>) -> Microscopic {
    Microscopic::of(&People::new(walks), 0.0)
}

#[test]
fn turning_and_acceleration_on_a_circle_are_those_of_chords() {
    let (radius, rate) = (3.0, 0.4_f64);
    let found = of(vec![walk(1, 0.0, 20.0, |time| radius * DVec2::from_angle(rate * time))]);
    let speed = 2.0 * radius * (0.2 * rate).sin() / 0.4;
    let acceleration = speed * 2.0 * (0.2 * rate).sin() / 0.4;
    assert!((found.turning - rate.to_degrees()).abs() < 1e-6 && found.speed_deviation < 1e-9, "{found:?}");
    assert!(found.acceleration.iter().all(|own| (own - acceleration).abs() < 1e-6), "{found:?}");
    assert_eq!((found.standing, found.head_on), (0.0, 0));
    assert!(found.passing[0].is_nan() && found.interaction_off(&found).is_nan());
}

#[test]
fn standing_is_a_share_of_the_time_and_no_walking() {
    // 8 s at 1 m/s, 12 s of standing, 20 s that alternate between 1 and 2 m/s every 0.4 s
    let speed = |time: f64| match time {
        time if time < 8.0 => 1.0,
        time if time < 20.0 => 0.0,
        time => 1.0 + f64::from((((time - 20.0) / 0.4) as u32 % 2) as u8),
    };
    let gone =
        |time: f64| (0..(10.0 * time).round() as u32).map(|k| 0.1 * speed(0.1 * f64::from(k) + 0.05)).sum::<f64>();
    let found = of(vec![walk(1, 0.0, 40.0, |time| DVec2::X * gone(time))]);
    assert!((found.standing - 0.3).abs() < 1e-9, "{}", found.standing);
    // of 70 walking samples, 45 are at 1 m/s, 25 at 2 m/s
    let mean = (45.0 + 50.0) / 70.0;
    let square = (45.0 * (1.0_f64 - mean).powi(2) + 25.0 * (2.0_f64 - mean).powi(2)) / 70.0;
    assert!((found.speed_deviation - square.sqrt()).abs() < 1e-6, "{}", found.speed_deviation);
    assert!(found.turning < 1e-6 && (found.acceleration[1] - 2.5).abs() < 1e-6, "{found:?}");
}

#[test]
fn head_on_pairs_are_those_that_would_nearly_meet() {
    let pair = |aside: f64, way: f64| {
        let first = walk(1, 0.0, 12.0, |time| DVec2::X * 1.1 * time);
        let second = walk(2, 1.0, 12.0, move |time| DVec2::new(14.0, aside) + way * DVec2::X * time);
        of(vec![first, second])
    };
    let found = pair(0.5, -1.3);
    assert_eq!(found.head_on, 1);
    // the least distance may lie between two samples
    assert!((found.passing[0] - 0.5).abs() < 1e-9 && (found.passing[1] - 0.5).abs() < 1e-9, "{found:?}");
    assert_eq!([pair(0.7, -1.3), pair(0.5, 0.9), pair(0.5, -0.4)].map(|found| found.head_on), [0; 3]);
    // pedestrians that avoid each other are classified by the distance at constant velocities
    let bow = |sign: f64, from: f64| {
        move |time: f64| {
            let x = sign * (1.25 * time - 10.0);
            DVec2::new(x, from + sign * -0.4 * (-(x * x) / 2.0).exp())
        }
    };
    let found = of(vec![walk(1, 0.0, 16.0, bow(1.0, 0.0)), walk(2, 0.0, 16.0, bow(-1.0, 0.0))]);
    assert_eq!(found.head_on, 1);
    assert!((found.passing[0] - 0.8).abs() < 0.01, "{found:?}");
}

/// Returns a generator of numbers from 0 to 1.
fn draws(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Pedestrians that ignore each other have a g of 1; without pairs that come close, g is less at short times.
#[test]
fn g_is_one_without_interaction() {
    let mut draw = draws(9);
    let mut walks = Vec::new();
    for number in 0..1500 {
        let (from, at) = (60.0 * draw(), DVec2::new(24.0 * draw(), 24.0 * draw()));
        let velocity = DVec2::from_angle(std::f64::consts::TAU * draw()) * (0.8 + draw());
        walks.push(walk(number, (from * 2.5).floor() / 2.5, 4.0, move |time| at + velocity * (time - from)));
    }
    let found = of(walks.clone());
    assert!(found.interaction.iter().all(|g| (g - 1.0).abs() < 0.2), "{:?}", found.interaction);
    assert_eq!(found.interaction_off(&found), 0.0);
    // without pedestrians that come within 0.6 m of another
    let lonely = |walk: &Walk| {
        let near = |other: &Walk| {
            let both = walk.times.iter().filter_map(|&time| Some(walk.at(time)?.distance(other.at(time)?)));
            other.number != walk.number && both.fold(f64::INFINITY, f64::min) < 0.6
        };
        !walks.iter().any(near)
    };
    let kept: Vec<Walk> = walks.iter().filter(|walk| lonely(walk)).cloned().collect();
    let other = of(kept);
    // except for the ends of walks
    assert!(other.interaction[0] < 0.5 && other.interaction_off(&found) > 0.2, "{:?}", other.interaction);
}
