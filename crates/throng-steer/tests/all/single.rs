//! Behaviours of one or two agents, compared with their definitions and by the resulting motion.

use crate::harness::{Actor, Stage, angle, ask, flier, on_ground, rate, vector};
use glam::Vec3;
use proptest::prelude::*;
use std::sync::Arc;
use throng::motion::{Motion, Vehicle};
use throng::steer::{BoxedBehaviour, GroupFilter, SteeringInput, SteeringNeighbour, Stimulus, Target};
use throng_steer::{
    Arrive, Docking, Evade, Face, Fear, Flee, FollowFlow, Interpose, KeepStation, LookWhereYouGo, MatchOrientation,
    MoveForward, OffsetPursuit, Prediction, Pursue, Seek, Shadow, TargetSpeed, Tether, takeoff,
};

/// A behaviour without force.
fn still() -> BoxedBehaviour {
    MoveForward { part: 0.0 }.into()
}

pub fn view(velocity: Vec3) -> SteeringInput<'static> {
    SteeringInput { motion: Motion::moving(Vec3::ONE, velocity), vehicle: flier(), ..SteeringInput::default() }
}

fn at(place: Vec3) -> Target {
    Target::Point(place)
}

proptest! {
    /// "desired velocity - velocity", with the desired velocity at the top speed.
    #[test]
    fn seek_and_flee_are_the_papers(velocity in vector(1.0), place in vector(5.0)) {
        prop_assume!(place.distance(Vec3::ONE) > 0.01);
        let view = view(velocity);
        let seek = view.chosen(ask(&Seek { target: at(place) }, &view));
        let flee = view.chosen(ask(&Flee::new(at(place)), &view));
        let expected = (place - Vec3::ONE).normalize() * 1.8;
        prop_assert!(seek.distance(expected) < 1e-4 && flee.distance(-expected) < 1e-4);
        let panics = Flee { panic_distance: 3.0, ..Flee::new(at(place)) };
        prop_assert_eq!(ask(&panics, &view).is_some(), place.distance(Vec3::ONE) <= 3.0);
    }

    /// The agent never passes the target and stops there, at any time step and with any response of the vehicle.
    #[test]
    fn arrival_does_not_overshoot(
        place in on_ground(8.0), seconds in 0.005f32..0.5, response in 0.0f32..1.0, slowing in 0.0f32..3.0, force in 1.0f32..9.0,
        smoothing in 0.0f32..0.3,
    ) {
        prop_assume!(place.length() > 0.5);
        let vehicle = Vehicle { response, smoothing, max_force: force, ..Vehicle::default() };
        let arrive = Arrive { slowing_distance: slowing, ..Arrive::new(at(place)) };
        let mut stage = Stage::new(seconds, vec![Actor::new(Motion::default(), vehicle, arrive)]);
        let mut past = f32::NEG_INFINITY;
        stage.run(90.0, |stage| past = past.max((stage.actors[0].motion.position - place).dot(place.normalize())));
        let Actor { motion, said, .. } = &stage.actors[0];
        prop_assert!(past <= 1e-4, "{past} too far");
        prop_assert!(motion.position.distance(place) <= 0.0101 && motion.speed() <= 0.0018, "{motion:?}");
        prop_assert!(said.is_none(), "still corrects at the target");
    }

    /// Any slower quarry, on any winding course.
    #[test]
    fn pursuit_catches_a_slower_quarry(
        start in on_ground(8.0), turning in -1.0f32..1.0, speed in 0.2f32..1.2, kind in 0usize..3, seconds in rate(),
    ) {
        let prediction =
            [Prediction::Constant(0.3), Prediction::Distance { per_metre: 0.3, most: 3.0 }, Prediction::default()][kind];
        let winding = FollowFlow {
            flow: Arc::new(move |_: Vec3, time: f64| Vec3::new((turning * time as f32).cos(), (turning * time as f32).sin(), 0.0) * speed),
            prediction: 0.0,
        };
        let quarry = Actor::new(Motion::at_rest(start, Vec3::X), Vehicle::default(), winding);
        let hunter = Actor::new(Motion::default(), Vehicle::default(), Pursue { prediction, ..Pursue::new(Target::Agent(0)) });
        let mut stage = Stage::new(seconds, vec![quarry, hunter]);
        let mut nearest = f32::INFINITY;
        stage.run(60.0, |stage| {
            nearest = nearest.min(stage.actors[0].motion.position.distance(stage.actors[1].motion.position));
        });
        prop_assert!(nearest < 0.4, "{nearest}");
    }

    /// A prey that is faster than its pursuer is never caught.
    #[test]
    fn evasion_keeps_away(start in on_ground(6.0), slower in 0.3f32..0.95, seconds in rate()) {
        prop_assume!(start.length() > 2.0);
        let slow = Vehicle { max_speed: 1.8 * slower, ..Vehicle::default() };
        let hunter = Actor::new(Motion::default(), slow, Pursue::new(Target::Agent(1)));
        let prey = Actor::new(Motion::at_rest(start, -start), Vehicle::default(), Evade::new(Target::Agent(0)));
        let mut stage = Stage::new(seconds, vec![hunter, prey]);
        let mut nearest = f32::INFINITY;
        let apart = |stage: &Stage| stage.actors[0].motion.position.distance(stage.actors[1].motion.position);
        stage.run(30.0, |stage| nearest = nearest.min(apart(stage)));
        prop_assert!(nearest > 0.5 * start.length() && apart(&stage) > start.length(), "{nearest}");
    }

    /// OpenSteer's table, by angles.
    #[test]
    fn nine_cases_of_prediction(velocity in vector(1.5), offset in vector(6.0), theirs in vector(1.0)) {
        let degrees = [(angle(velocity, offset), "offset"), (angle(velocity, theirs), "theirs")].map(|(a, _)| a.to_degrees());
        prop_assume!(degrees.iter().all(|a| (a - 45.0).abs() > 0.1 && (a - 135.0).abs() > 0.1));
        prop_assume!(velocity.length() > 0.01 && theirs.length() > 0.01);
        let times = match degrees.map(|a| if a < 45.0 { 'a' } else if a > 135.0 { 'c' } else { 'b' }) {
            ['a', 'a'] => 4.0, ['a', 'b'] => 1.8, ['a', 'c'] => 0.85,
            ['b', 'a'] => 1.0, ['b', 'b'] => 0.8, ['b', 'c'] => 4.0,
            ['c', 'a'] => 0.5, _ => 2.0,
        };
        let time = (times * offset.length() / velocity.length()).min(10.0);
        let seen = SteeringNeighbour {
            offset, velocity: theirs, forward: theirs.normalize(), radius: 0.2, number: 1, group: 0,
        };
        let view = SteeringInput { neighbours: &[seen], ..view(velocity) };
        let chosen = view.chosen(ask(&Pursue::new(Target::Nearest(GroupFilter::All)), &view));
        prop_assert!(chosen.distance((offset + theirs * time).normalize() * 1.8) < 2e-3);
    }

    /// Away from the predicted position of the menace at its time of arrival, but at most half of the time until the
    /// closest approach.
    #[test]
    fn evasion_looks_ahead(velocity in vector(1.5), offset in vector(6.0)) {
        prop_assume!(velocity.length() > 0.1 && offset.length() > 0.5);
        let seen = SteeringNeighbour { offset, velocity, forward: velocity.normalize(), radius: 0.2, number: 1, group: 0 };
        let view = SteeringInput { neighbours: &[seen], ..view(Vec3::ZERO) };
        let chosen = view.chosen(ask(&Evade::new(Target::Nearest(GroupFilter::All)), &view));
        let covers = (offset.length() / velocity.length()).min(10.0);
        let passes = (0..4000).map(|i| i as f32 * 0.01).min_by(|a, b| {
            (offset + velocity * *a).length().total_cmp(&(offset + velocity * *b).length())
        });
        let time = covers.min(0.5 * passes.expect("some time is the best"));
        prop_assert!(angle(chosen, -(offset + velocity * time)) < 0.05, "{chosen}");
    }

    /// A standing quarry is passed at the distance.
    #[test]
    fn offset_pursuit_passes_at_the_distance(start in vector(1.0), distance in 0.5f32..2.0, seconds in rate()) {
        let start = start + Vec3::X * -12.0;
        let pass = OffsetPursuit { quarry: at(Vec3::ZERO), prediction: Prediction::Constant(0.0), distance };
        let mut stage = Stage::new(seconds, vec![Actor::new(Motion::moving(start, Vec3::X), flier(), pass)]);
        let mut nearest = f32::INFINITY;
        stage.run(9.0, |stage| nearest = nearest.min(stage.actors[0].motion.position.length()));
        prop_assert!((nearest / distance - 1.0).abs() < 0.15, "{nearest} instead of {distance}");
    }

    /// The agent ends on the line between both targets, at the ratio, while both move on.
    #[test]
    fn interpose_ends_between(
        places in prop::array::uniform2(on_ground(5.0)), velocity in on_ground(0.7), ratio in 0.0f32..1.0,
        seconds in rate(),
    ) {
        let walk = |place| Actor::new(Motion::moving(place, velocity), Vehicle::default(), still());
        let between = Interpose { ratio, ..Interpose::new(Target::Agent(0), Target::Agent(1)) };
        let guard = Actor::new(Motion::at_rest(Vec3::new(3.0, 9.0, 0.0), Vec3::X), Vehicle::default(), between);
        let mut stage = Stage::new(seconds, vec![walk(places[0]), walk(places[1]), guard]);
        stage.run(40.0, |_| ());
        let [a, b, own] = [0, 1, 2].map(|row| stage.actors[row].motion.position);
        prop_assert!(own.distance(a + (b - a) * ratio) < 0.02, "{own} {a} {b}");
    }

    /// The shadow ends up near its quarry with the same velocity and facing, the wingman at its station.
    #[test]
    fn shadows_and_wingmen_move_as_their_leaders_do(
        start in on_ground(8.0), velocity in on_ground(0.9), offset in vector(3.0), seconds in rate(),
    ) {
        prop_assume!(velocity.length() > 0.2 && start.length() > 2.0);
        let leader = Actor::new(Motion::moving(Vec3::ZERO, velocity), Vehicle::default(), still());
        let shadow = Shadow { quarry: Target::Agent(0), distance: 1.0, slowing_distance: 1.0 };
        let wing = KeepStation { leader: Target::Agent(0), offset: offset.with_z(0.0), slowing_distance: 1.0 };
        let from = Motion::at_rest(start, -start);
        let mut stage = Stage::new(seconds, vec![
            leader, Actor::new(from, Vehicle::default(), shadow), Actor::new(from, Vehicle::default(), wing),
        ]);
        stage.run(60.0, |_| ());
        let [leader, shadow, wing] = [0, 1, 2].map(|row| stage.actors[row].motion);
        prop_assert!((shadow.position.distance(leader.position) - 1.0).abs() < 0.1);
        prop_assert!(shadow.velocity.distance(velocity) < 0.02 && angle(shadow.basis.forward, velocity) < 0.1);
        let place = leader.position + leader.basis.to_world(offset.with_z(0.0));
        prop_assert!(wing.position.distance(place) < 0.02 && wing.velocity.distance(velocity) < 0.02);
    }

    /// Arrives at the place, in the direction, at the speed, and at the time if one is set.
    #[test]
    fn docking_arrives_at_the_pose(
        place in on_ground(8.0), direction in on_ground(1.0), through in 0.3f32..1.0, rests: bool, timed: bool,
        velocity in on_ground(1.0), seconds in rate(),
    ) {
        prop_assume!(direction.length() > 0.1 && place.length() > 3.0);
        let speed = if rests { 0.0 } else { through };
        let dock = Docking { place, direction, speed, time: timed.then_some(25.0) };
        let mut stage = Stage::new(seconds, vec![Actor::new(Motion::moving(Vec3::ZERO, velocity), Vehicle::default(), dock)]);
        let (mut before, mut there) = (Motion::default(), None);
        stage.run(60.0, |stage| {
            let Actor { motion, memory, .. } = &stage.actors[0];
            if memory[0] < -0.5 * seconds && there.is_none() {
                there = Some((stage.time() - f64::from(seconds), before));
            }
            before = *motion;
        });
        let (time, motion) = there.expect("it got there");
        prop_assert!(motion.position.distance(place) < 0.05, "{} away", motion.position.distance(place));
        prop_assert!(motion.velocity.distance(direction.normalize() * speed) < 0.1, "{}", motion.velocity);
        prop_assert!(angle(motion.basis.forward, direction) < 0.2, "{}", angle(motion.basis.forward, direction));
        prop_assert!(!timed || (time - 25.0).abs() < 0.05, "{time}");
        // In the worst case the vehicle starts and ends away from the place, at v: the cubic's speed is then up to 1.5
        // d / t + v / 2, so it needs t = 3 d / v. Plans use 0.8 of the top speed, 1 m/s, and durations grow by
        // twentieths.
        prop_assert!(timed || time < f64::from(1.05 * 3.0 / 0.8 * place.length()), "{time} for {}", place.length());
    }

    /// The velocity of the field at the predicted position, limited by the top speed.
    #[test]
    fn a_flow_is_taken_on_where_it_will_be(velocity in vector(1.5), field in vector(1.0), prediction in 0.0f32..2.0) {
        let flow = FollowFlow { flow: Arc::new(move |place: Vec3, time: f64| field * place.x + Vec3::Y * time as f32), prediction };
        let view = SteeringInput { time: 0.5, ..view(velocity) };
        let expected = field * (1.0 + velocity.x * prediction) + Vec3::Y * 0.5;
        prop_assert!(view.chosen(ask(&flow, &view)).distance(expected.clamp_length_max(1.8)) < 1e-4);
    }

    /// In a circular flow, at its speed.
    #[test]
    fn flows_are_followed(start in on_ground(3.0), seconds in rate()) {
        prop_assume!(start.length() > 2.0);
        let whirl = FollowFlow { flow: Arc::new(|place: Vec3, _: f64| Vec3::Z.cross(place).normalize_or_zero()), prediction: 0.25 };
        let mut stage = Stage::new(seconds, vec![Actor::new(Motion::at_rest(start, start), Vehicle::default(), whirl)]);
        stage.run(10.0, |_| ());
        let Motion { position, velocity, .. } = stage.actors[0].motion;
        prop_assert!(angle(velocity, Vec3::Z.cross(position)) < 0.2 && (velocity.length() - 1.0).abs() < 0.1);
        prop_assert!((position.length() / start.length() - 1.0).abs() < 0.35, "{position} {start}");
    }

    #[test]
    fn small_behaviours_are_what_they_say(velocity in vector(1.0), place in vector(5.0), speed in 0.0f32..1.5) {
        let view = view(velocity);
        prop_assume!(velocity.length() > 0.01 && place.distance(Vec3::ONE) > 0.1);
        let face = ask(&Face { target: at(place) }, &view).and_then(|said| said.facing).expect("a facing");
        prop_assert!(angle(face, place - Vec3::ONE) < 1e-3);
        let look = ask(&LookWhereYouGo, &view).and_then(|said| said.facing).expect("a facing");
        prop_assert!(angle(look, velocity) < 1e-3);
        let as_other = SteeringNeighbour { offset: Vec3::Y, velocity: Vec3::ZERO, forward: velocity.normalize(), radius: 0.2, number: 1, group: 0 };
        let seen = SteeringInput { neighbours: &[as_other], ..view };
        let matched = ask(&MatchOrientation { with: Target::Nearest(GroupFilter::All) }, &seen).and_then(|said| said.facing);
        prop_assert!(angle(matched.expect("a facing"), velocity) < 1e-3);
        let tether = ask(&Tether { to: at(place), length: 3.0 }, &view);
        prop_assert_eq!(tether, (place.distance(Vec3::ONE) > 3.0).then(|| ask(&Seek { target: at(place) }, &view)).flatten());
        let chosen = view.chosen(ask(&TargetSpeed { speed }, &view));
        prop_assert!(chosen.distance(velocity.normalize() * speed) < 3e-3);
    }

    /// A jump integrated in small steps lands at its target from above; an impossible jump returns `None`.
    #[test]
    fn jumps_land(leap in vector(4.0), rise in 0.5f32..8.0) {
        let highest = rise * rise / 20.0;
        prop_assume!((leap.z - highest).abs() > 0.01);
        let velocity = takeoff(leap, rise, 10.0, 1e3);
        prop_assert_eq!(velocity.is_some(), leap.z < highest);
        if let Some(start) = velocity {
            let (mut place, mut velocity, step) = (Vec3::ZERO, start, 1e-4);
            while velocity.z > 0.0 || place.z > leap.z {
                velocity.z -= 0.5 * step * 10.0;
                place += velocity * step;
                velocity.z -= 0.5 * step * 10.0;
            }
            prop_assert!(place.distance(leap) < 0.05, "{place} {leap}");
            let level = start.truncate().length();
            prop_assert!(takeoff(leap, rise, 10.0, level * 1.01 + 1e-6).is_some());
            prop_assert!(level < 0.01 || takeoff(leap, rise, 10.0, level * 0.99).is_none());
        }
    }

    /// By angles and distances in f64.
    #[test]
    fn fear_fades_with_time_and_distance(events in prop::collection::vec((vector(6.0), -3.0f64..6.0), 1..4)) {
        let list: Vec<Stimulus> = events.iter().map(|&(position, time)| Stimulus { position, time }).collect();
        let view = SteeringInput { stimuli: &list, time: 5.0, ..view(Vec3::ZERO) };
        let mut sum = glam::DVec3::ZERO;
        for (place, time) in events {
            let (away, age) = ((Vec3::ONE - place).as_dvec3(), 5.0 - time);
            if (0.0..4.0).contains(&age) && away.length() < 5.0 {
                sum += away.normalize() * (1.0 - age / 4.0) * (1.0 - away.length() / 5.0);
            }
        }
        let said = ask(&Fear { range: 5.0, fades: 4.0 }, &view).map_or(Vec3::ZERO, |said| said.force);
        prop_assert!(said.as_dvec3().distance(sum.clamp_length_max(1.0) * 5.0) < 1e-4);
    }
}

/// Nothing moves, or all is at one place: no direction arises from zero vectors.
#[test]
fn nothing_comes_of_nothing() {
    let view = SteeringInput { motion: Motion::default(), ..SteeringInput::default() };
    let here = at(Vec3::ZERO);
    assert_eq!(ask(&Seek { target: here }, &view), None);
    assert_eq!(ask(&Pursue::new(here), &view), None);
    assert!(ask(&Evade::new(here), &view).is_some_and(|said| said.force.is_finite()));
    assert_eq!(ask(&Seek { target: Target::Agent(1) }, &view), None);
    assert_eq!(ask(&LookWhereYouGo, &view), None);
}
