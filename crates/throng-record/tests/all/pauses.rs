//! Tests of the pauses of recorded pedestrians, and of their replay.

use glam::DVec2;
use throng::{Agent, Group, Settings};
use throng_record::pedestrian::replay::{
    Pace, Pause, RecordedPeople, Replay, ReplayScene, Replayed, from_entry, predict,
};
use throng_record::pedestrian::{People, Walk};

/// Returns a walk along y in stretches of seconds at speeds (m/s), from a place, four rows per second.
fn walk(number: u32, from: DVec2, stretches: &[(u32, f64)]) -> Walk {
    let (mut times, mut places) = (vec![0.0], vec![from]);
    for &(seconds, speed) in stretches {
        for _ in 0..4 * seconds {
            times.push(times[times.len() - 1] + 0.25);
            places.push(places[places.len() - 1] + 0.25 * speed * DVec2::Y);
        }
    }
    Walk { number, radius: 0.2, times, places }
}

fn found(walks: Vec<Walk>) -> Vec<Vec<Pause>> {
    let cast = RecordedPeople::new(&People::new(walks), Pace::Quantile(0.5), 0.5);
    cast.walkers.into_iter().map(|walker| walker.pauses).collect()
}

#[test]
fn a_pause_is_where_and_while_a_pedestrian_stands() {
    let pauses = &found(vec![walk(1, DVec2::ZERO, &[(2, 1.0), (5, 0.0), (3, 1.0), (1, 0.0), (2, 1.0), (4, 0.0)])])[0];
    // standing for 1 s is walking at its first and last row; standing at the end is the goal
    assert_eq!(pauses[..], [Pause { place: DVec2::Y * 2.0, from: 2.25, until: 6.75 }]);
}

#[test]
fn a_slow_drift_is_a_chain_of_pauses() {
    let pauses = &found(vec![walk(1, DVec2::ZERO, &[(10, 0.15), (2, 1.0)])])[0];
    assert_eq!(pauses.len(), 3);
    // the first pause ends after 0.5 m: rows of 3.75 cm, from 0 on
    let last = (0.5_f64 / 0.0375).floor();
    assert!((pauses[0].until - 0.25 * last).abs() < 1e-9 && (pauses[0].place.y - 0.01875 * last).abs() < 1e-9);
    assert!(pauses.windows(2).all(|pair| pair[1].place.y > pair[0].place.y + 0.3), "{pauses:?}");
}

#[test]
fn standing_in_a_jam_is_no_pause() {
    let stretches = [(5, 0.0), (2, 1.0)];
    let lattice = |k: u32| DVec2::new(f64::from(k % 3), f64::from(k / 3));
    let crowd = |spacing: f64| (0..9).map(|k| walk(k, spacing * lattice(k), &stretches)).collect();
    // at 0.6 m spacing, four to eight others are within 1 m of all but the corner positions
    assert_eq!(found(crowd(0.6)).iter().map(Vec::len).collect::<Vec<_>>(), [1, 0, 1, 0, 0, 0, 1, 0, 1]);
    assert!(found(crowd(1.01)).iter().all(|pauses| pauses.len() == 1));
    // a row of three
    assert!(found(crowd(0.6)[..3].to_vec()).iter().all(|pauses| pauses.len() == 1));
}

/// Returns a replay on unbounded ground.
fn replayed(cast: &RecordedPeople) -> (ReplayScene, Replayed) {
    let stage = ReplayScene {
        settings: Settings { step: 0.05, ..Settings::default() },
        group: Group { look_ahead: false, keep_right: 0.0, ..Group::default() },
        agent: Agent::default(),
        walkable: Vec::new(),
        obstacles: Vec::new(),
        near: 0.1,
        stay: false,
    };
    let times = cast.times();
    let end = times[times.len() - 1];
    let mut replay = Replay::new(&stage, cast, times[0], times).unwrap();
    while replay.time() < end - 1e-9 {
        replay.step().unwrap();
    }
    let out = replay.finish();
    (stage, out)
}

/// Returns the fraction of time in which walks are slower than 0.2 m/s.
fn standing(walks: &[Walk]) -> f64 {
    let slow = |walk: &Walk| {
        let steps = walk.places.windows(2).zip(walk.times.windows(2));
        steps.filter(|(places, times)| places[0].distance(places[1]) < 0.2 * (times[1] - times[0])).count()
    };
    let all: usize = walks.iter().map(|walk| walk.times.len().saturating_sub(1)).sum();
    walks.iter().map(slow).sum::<usize>() as f64 / all as f64
}

/// Returns two pedestrians far apart, each with a pause between two stretches; one of them deviates from its straight
/// line.
fn stroll() -> People {
    let mut bent = walk(2, DVec2::X * 50.0, &[(5, 1.2), (8, 0.0), (5, 1.2)]);
    for place in &mut bent.places {
        place.x += 0.8 * (place.y * std::f64::consts::PI / 12.0).sin();
    }
    People::new(vec![walk(1, DVec2::ZERO, &[(4, 1.0), (10, 0.0), (6, 1.0)]), bent])
}

#[test]
fn replayed_pedestrians_pause_as_recorded() {
    let people = stroll();
    let cast = RecordedPeople::new(&people, Pace::Quantile(0.5), 0.5);
    let (stage, again) = replayed(&cast);
    let recorded = standing(&people.walks);
    assert!(recorded > 0.45 && (standing(&again.walks) - recorded).abs() < 0.05, "{}", standing(&again.walks));
    // the first is replayed as recorded, and both arrive
    assert!(from_entry(&cast, &again, Some(12.0)).iter().all(|sample| sample.last[0] < 0.2));
    assert!(again.arrived.iter().all(Option::is_some), "{:?}", again.arrived);
    // a prediction from the middle of the pause on is as good as the straight one
    let ahead = predict(&stage, &cast, stage.world().unwrap(), 8.0, &[2.0, 8.0]).unwrap();
    assert!(ahead.iter().all(|samples| samples.len() == 2));
    assert!(ahead.iter().flatten().all(|sample| sample.last[0] < 0.5 && sample.last[2] < 0.5), "{ahead:?}");
    // with goals and speeds alone, they start at once
    let cast = cast.without_pauses();
    let (stage, again) = replayed(&cast);
    assert!(standing(&again.walks) < 0.05);
    let ahead = predict(&stage, &cast, stage.world().unwrap(), 8.0, &[2.0]).unwrap();
    assert!(ahead[0].iter().all(|sample| sample.last[0] > 1.5 && sample.last[2] > 1.5), "{ahead:?}");
}

#[test]
fn a_late_agent_skips_its_pause() {
    // 20 m in 10 s, then a pause of 5 s; the agent has half the speed
    let people = People::new(vec![walk(1, DVec2::ZERO, &[(10, 2.0), (5, 0.0), (20, 1.0)])]);
    let cast = RecordedPeople::new(&people, Pace::Constant(1.0), 0.5);
    let (_, again) = replayed(&cast);
    let at = |time: f64| again.walks[0].at(time).unwrap().y;
    // 15 m at the end of the pause, and no stop after that
    assert!((at(15.0) - 15.0).abs() < 1.2 && (at(25.0) - at(15.0) - 10.0).abs() < 0.3, "{} {}", at(15.0), at(25.0));
    let walker = &cast.walkers[0];
    assert!(walker.straight(DVec2::ZERO, 0.0, 25.0).distance(DVec2::Y * 25.0) < 1e-9);
    assert!(walker.straight(DVec2::Y * 19.0, 9.0, 14.0).distance(walker.pauses[0].place) < 1e-9);
}
