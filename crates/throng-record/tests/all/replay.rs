//! Tests of replays of recorded pedestrians against known results.

use super::shared::{STEP, replayed, stage};
use glam::DVec2;
use throng::{Agent, Goal, Journey, Obstacle, Settings, Stop, Walkable, World};
use throng_record::Frame;
use throng_record::pedestrian::replay::{Pace, PredictionSample, RecordedPeople, ReplayScene, from_entry, predict};
use throng_record::pedestrian::{People, Walk};

/// Returns a walk with positions by a formula.
fn walk(number: u32, times: impl Iterator<Item = f64>, place: impl Fn(f64) -> DVec2) -> Walk {
    let times: Vec<f64> = times.collect();
    Walk { number, radius: 0.2, places: times.iter().map(|&time| place(time)).collect(), times }
}

fn every(interval: f64, count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |k| f64::from(k) * interval)
}

/// Returns three pedestrians far apart, simulated by throng.
fn own_recording() -> People {
    let mut world = World::new(Settings { step: STEP, ..Settings::default() }).unwrap();
    let group = world.add_group(stage().group).unwrap();
    let mut walks = Vec::new();
    let mut ids = Vec::new();
    for (number, (speed, angle)) in (0u32..).zip([(1.3, 0.3), (0.9, 2.0), (1.6, -1.0)]) {
        let position = DVec2::new(0.0, 50.0 * f64::from(number));
        let way = DVec2::from_angle(angle);
        let goal = world.add_goal(Goal::Point { at: position + 12.0 * way, tolerance: 0.05 }).unwrap();
        let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false }).unwrap();
        let velocity = (f64::from(speed) * way).as_vec2();
        let agent = Agent {
            position: position.extend(0.0),
            velocity,
            group,
            journey,
            preferred_speed: speed,
            ..Agent::default()
        };
        ids.push(world.add_agent(agent).unwrap());
        walks.push(Walk { number, radius: 0.2, times: vec![0.0], places: vec![position] });
    }
    while !world.finished() {
        world.step();
        for (walk, &id) in walks.iter_mut().zip(&ids) {
            let row = world.row(id).unwrap();
            if world.relative_columns().status[row] == throng::Status::Walking {
                walk.times.push(world.time());
                walk.places.push(world.position(id).unwrap().truncate());
            }
        }
    }
    People::new(walks)
}

#[test]
fn lone_walkers_of_the_same_model_are_replayed_exactly() {
    let cast = RecordedPeople::new(&own_recording(), Pace::Quantile(0.5), 0.4);
    for (walker, speed) in cast.walkers.iter().zip([1.3, 0.9, 1.6]) {
        assert!((walker.speed - speed).abs() < 1e-3 && !walker.stays, "{walker:?}");
    }
    let stage = stage();
    let again = replayed(&stage, &cast);
    assert_eq!((again.entered, again.overlapping, again.moved, again.refused), (3, 0, 0, 0));
    for horizon in [1.0, 2.0, 4.0] {
        let samples = from_entry(&cast, &again, Some(horizon));
        assert_eq!(samples.len(), 3);
        let most = samples.iter().flat_map(|sample| sample.last).fold(0.0, f64::max);
        assert!(most < 2e-3, "{horizon} s: {most} m");
    }
    // near the goal, an agent slows down and leaves a little before it
    let end = from_entry(&cast, &again, None);
    assert!(end.iter().all(|sample| sample.last[0] < 0.15 && sample.average[0] < 0.02), "{end:?}");
    let ahead = predict(&stage, &cast, stage.world().unwrap(), 2.0, &[1.0, 4.0]).unwrap();
    assert_eq!((ahead[0].len(), ahead[1].len()), (3, 3));
    assert!(ahead.iter().flatten().all(|sample| sample.last[0] < 2e-3), "{ahead:?}");
}

/// Rows are far apart here: an agent that leaves between two rows stays where it left, whatever horizons are requested.
#[test]
fn agents_that_have_left_stay_where_they_left() {
    let one = |k: u32| walk(k, every(0.4, 25), move |time| DVec2::new(time, 100.0 * f64::from(k)));
    let cast = RecordedPeople::new(&People::new(vec![one(0), one(1)]), Pace::Constant(1.37), 0.4);
    let stage = stage();
    let again = replayed(&stage, &cast);
    for (sample, left) in from_entry(&cast, &again, None).iter().zip(&again.left) {
        let (time, place) = left.unwrap();
        assert!(time < 9.0 && (sample.last[0] - place.distance(cast.walkers[sample.walk].goal)).abs() < 1e-9);
        assert!(sample.last[0] < stage.near, "{sample:?}");
    }
    let ahead = |horizons: &[f64]| predict(&stage, &cast, stage.world().unwrap(), 2.0, horizons).unwrap();
    let many: Vec<f64> = (1..=64).map(|k| f64::from(k) * 0.125).collect();
    let all = ahead(&many);
    for (horizon, samples) in many.iter().zip(&all) {
        assert_eq!(&ahead(&[*horizon])[0], samples, "{horizon}");
    }
}

/// Returns two pedestrians with constant acceleration along lines far apart, a row every 0.1 s, for 10 s: 0.5 m/s at
/// first, 0.1 and 0.2 m/s².
fn speeding_up() -> (RecordedPeople, impl Fn(usize, f64) -> f64) {
    let gone = |walk: usize, time: f64| 0.5 * time + 0.05 * (walk + 1) as f64 * time * time;
    let one = |k: usize| walk(k as u32, every(0.1, 100), move |time| DVec2::new(gone(k, time), 100.0 * k as f64));
    (RecordedPeople::new(&People::new(vec![one(0), one(1)]), Pace::Constant(1.2), 0.4), gone)
}

#[test]
fn constant_velocity_has_the_error_of_its_closed_form() {
    let (cast, gone) = speeding_up();
    let stage = stage();
    let half = |walk: usize| 0.05 * (walk + 1) as f64;
    // the velocity so far is that of 0.2 s before, the velocity at the entry is that of 0.2 s after
    let since_start = |walk: usize, h: f64| half(walk) * (h * h - 0.4 * h).abs();
    let so_far = |walk: usize, h: f64| half(walk) * (h * h + 0.4 * h);
    let mean = |off: &dyn Fn(f64) -> f64, rows: u32| {
        (1..=rows).map(|k| off(f64::from(k) * 0.1)).sum::<f64>() / f64::from(rows)
    };
    let check = |sample: &PredictionSample, from: f64, h: f64, off: &dyn Fn(f64) -> f64| {
        let rows = (h * 10.0).round() as u32;
        let near = |found: f64, want: f64| assert!((found - want).abs() < 1e-9, "{found}, not {want}");
        near(sample.last[1], off(h));
        near(sample.average[1], mean(off, rows));
        // straight on at 1.2 m/s
        let straight = |h: f64| (1.2 * h - gone(sample.walk, from + h) + gone(sample.walk, from)).abs();
        near(sample.last[2], straight(h));
        near(sample.average[2], mean(&straight, rows));
    };
    let again = replayed(&stage, &cast);
    for h in [1.0, 2.0, 4.0] {
        for sample in from_entry(&cast, &again, Some(h)) {
            check(&sample, 0.0, h, &|h| since_start(sample.walk, h));
        }
        for start in [0.4, 3.0, 5.5] {
            let ahead = predict(&stage, &cast, stage.world().unwrap(), start, &[h]).unwrap().remove(0);
            assert_eq!(ahead.len(), 2, "{start} s");
            ahead.iter().for_each(|sample| check(sample, start, h, &|h| so_far(sample.walk, h)));
        }
    }
    let none = |start: f64, h: f64| predict(&stage, &cast, stage.world().unwrap(), start, &[h]).unwrap()[0].is_empty();
    assert!(none(0.3, 1.0), "velocities are not known yet");
    assert!(none(6.1, 4.0) && !none(6.0, 4.0), "the recording ends earlier");
}

/// Returns a generator of pseudorandom numbers from 0 to 1.
fn draws(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Returns pedestrians that sway across each other's ways, with rows every 0.4 s, rotated, and shifted in space and
/// time.
fn crowd(turn: DVec2, by: DVec2, later: f64) -> People {
    let mut draw = draws(8);
    let one = |number: u32| {
        let start = DVec2::new(8.0 * draw() - 4.0, 8.0 * draw() - 4.0);
        let (angle, speed, phase) = (6.3 * draw(), 0.8 + 0.8 * draw(), 6.0 * draw());
        let way = DVec2::from_angle(angle);
        let first = (8.0 * draw()).floor() * 0.4;
        let place = |time: f64| {
            let at = start + way * speed * time + way.perp() * 0.2 * (time + phase).sin();
            turn.rotate(at) + by
        };
        let (times, places) = every(0.4, 25).map(|time| (first + time + later, place(time))).unzip();
        Walk { number, radius: 0.2, times, places }
    };
    People::new((0..14).map(one).collect())
}

#[test]
fn displacements_are_those_of_all_rows() {
    let cast = RecordedPeople::new(&crowd(DVec2::X, DVec2::ZERO, 0.0), Pace::Quantile(0.9), 0.4);
    let again = replayed(&stage(), &cast);
    assert!(again.entered == 14 && again.walks.iter().all(|walk| !walk.times.is_empty()));
    // positions by a separate look-up in all rows
    let at = |walk: &Walk, time: f64| {
        let pair = walk.times.windows(2).zip(walk.places.windows(2)).find(|(times, _)| times[1] >= time - 1e-9);
        pair.map_or(walk.places[walk.places.len() - 1], |(times, places)| {
            places[0] + (places[1] - places[0]) * ((time - times[0]) / (times[1] - times[0]))
        })
    };
    for horizon in [Some(1.0), Some(2.0), Some(3.3), None] {
        let samples = from_entry(&cast, &again, horizon);
        assert_eq!(samples.len(), 14);
        for sample in samples {
            let (real, mut ours) = (&cast.people.walks[sample.walk], again.walks[sample.walk].clone());
            if let Some((time, place)) =
                again.left[sample.walk].filter(|left| left.0 > ours.times[ours.times.len() - 1])
            {
                ours.times.push(time);
                ours.places.push(place);
            }
            let from = real.times[0];
            let end = horizon.map_or(real.times[real.times.len() - 1], |horizon| from + horizon);
            let off = |time: f64| at(real, time).distance(at(&ours, time));
            let rows: Vec<f64> =
                real.times.iter().copied().filter(|&time| time > from && time <= end + 1e-9).map(off).collect();
            let mean = rows.iter().sum::<f64>() / rows.len() as f64;
            assert!((sample.average[0] - mean).abs() < 1e-9 && (sample.last[0] - off(end)).abs() < 1e-9, "{sample:?}");
        }
    }
}

#[test]
fn place_time_and_rotation_make_no_difference() {
    let off = |turn: DVec2, by: DVec2, later: f64| {
        let cast = RecordedPeople::new(&crowd(turn, by, later), Pace::Mean, 0.4);
        let [low, high] = [by - 20.0, by + 20.0];
        let mut stage = stage();
        stage.settings.origin = ((low + high) * 0.5).round();
        let again = replayed(&stage, &cast);
        let ahead = predict(&stage, &cast, stage.world().unwrap(), 4.0 + later, &[2.0]).unwrap().remove(0);
        let both = from_entry(&cast, &again, Some(2.0)).into_iter().chain(ahead);
        both.map(|sample| (sample.walk, sample.average, sample.last)).collect::<Vec<_>>()
    };
    let here = off(DVec2::X, DVec2::ZERO, 0.0);
    assert!(here.len() > 20);
    for (turn, by, later) in [
        (DVec2::X, DVec2::new(3000.0, -2000.0), 0.0),
        (DVec2::X, DVec2::ZERO, 1234.5),
        (DVec2::Y, DVec2::ZERO, 0.0),
        (DVec2::from_angle(1.1), DVec2::new(-7.0, 12.0), 99.7),
    ] {
        let there = off(turn, by, later);
        assert_eq!(here.len(), there.len());
        for (a, b) in here.iter().zip(&there) {
            let most =
                a.1.iter().chain(&a.2).zip(b.1.iter().chain(&b.2)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(a.0 == b.0 && most < 5e-3, "{turn}, {by}, {later}: {a:?} and {b:?}");
        }
    }
}

#[test]
fn agents_without_room_at_the_start_are_counted_and_separated() {
    let straight = |number: u32, from: (f64, f64), to: (f64, f64)| {
        let (from, to) = (DVec2::from(from), DVec2::from(to));
        walk(number, every(0.4, 20), move |time| from.lerp(to, time / 8.0))
    };
    let walks = vec![
        straight(1, (0.0, 0.0), (8.0, 0.0)),
        straight(2, (0.0, 0.05), (8.0, 1.0)),
        straight(3, (-5.0, 5.0), (5.0, 5.0)),
        straight(4, (-3.0, -3.0), (-2.9, -3.0)),
        straight(5, (-30.0, -3.0), (-29.0, -3.0)),
    ];
    let cast = RecordedPeople::new(&People::new(walks), Pace::Quantile(0.5), 0.4);
    let corners = [(-5.5, 4.5), (-4.5, 4.5), (-4.5, 5.5), (-5.5, 5.5)].map(DVec2::from).to_vec();
    let outer = [(-12.0, -12.0), (12.0, -12.0), (12.0, 12.0), (-12.0, 12.0)].map(DVec2::from).to_vec();
    let stage = ReplayScene {
        obstacles: vec![Obstacle::Polygon { corners }],
        walkable: vec![Walkable { outer, holes: vec![] }],
        ..stage()
    };
    let again = replayed(&stage, &cast);
    assert_eq!((again.entered, again.overlapping, again.moved, again.refused), (4, 1, 1, 1));
    let (a, b) = (&again.walks[0], &again.walks[1]);
    let apart = a.places.iter().zip(&b.places).map(|(a, b)| a.distance(*b));
    assert!(apart.skip(5).take(5).all(|apart| apart > 0.399), "the guard separates them");
    assert!(
        cast.walkers[3].stays && again.walks[3].times.len() == 21,
        "a standing agent stays as long as its recording"
    );
    assert!(again.walks[4].times.is_empty() && from_entry(&cast, &again, None).len() == 4);
    assert!(again.walks[0].times.len() <= 21 && again.arrived[0].is_some());
}

#[test]
fn frames_between_rows_are_interpolated() {
    let cast = RecordedPeople::new(&crowd(DVec2::X, DVec2::ZERO, 0.0), Pace::Mean, 0.4);
    let seen = throng_record::pedestrian::replay::Seen::new(&cast);
    let mut frame = Frame::default();
    let here = |time: f64| cast.people.walks.iter().filter(move |walk| walk.at(time).is_some());
    for time in [0.0, 0.3, 5.0, 5.13, 12.8] {
        seen.capture(time, &mut frame);
        assert_eq!((frame.bodies.len(), frame.time, frame.total), (here(time).count(), time, 14));
        for (walk, body) in here(time).zip(&frame.bodies) {
            assert_eq!((walk.number, walk.at(time)), (body.number, Some(body.position)));
            assert!(
                body.velocity.length() > 0.5
                    && body.velocity.normalize().dot(glam::Vec2::from_angle(body.heading)) > 0.99
            );
        }
    }
    seen.capture(99.0, &mut frame);
    assert_eq!((frame.bodies.len(), frame.arrived), (0, 14));
}
