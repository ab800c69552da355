//! Behaviours with respect to neighbours: compared with brute force in f64, and by the motion of crowds.

use crate::harness::{Actor, RADIUS, RATES, Stage, angle, ask, flier, on_ground, rate, vector};
use glam::{DVec3, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::motion::{Motion, Vehicle};
use throng::parameters::Angle;
use throng::steer::{Behaviour, BoxedBehaviour, GroupFilter, Rng, SteeringInput, SteeringNeighbour, Target};
use throng_steer::{
    Alignment, AvoidNeighbours, Boids, CloseAvoidance, Cohesion, Falloff, Flocking, FollowFlow, FollowLeader,
    KeepFormation, MatchVelocity, MoveForward, Neighbourhood, Pattern, Priority, Queue, Rule, Seek, Separation,
    TargetSpeed, Tether, UnalignedAvoidance, Wander, WeightedSum, assign,
};

/// Random neighbours, nearest first.
fn others() -> impl Strategy<Value = Vec<SteeringNeighbour>> {
    let other = (vector(6.0), vector(1.5), 0usize..3);
    prop::collection::vec(other, 0..12).prop_map(|all| {
        let seen = |(number, (offset, velocity, group)): (usize, (Vec3, Vec3, usize))| SteeringNeighbour {
            offset,
            velocity,
            forward: velocity.normalize_or(Vec3::X),
            radius: 0.2,
            number: number as u32 + 1,
            group,
        };
        let mut all: Vec<SteeringNeighbour> = all.into_iter().enumerate().map(seen).collect();
        all.sort_by(|a, b| a.offset.length().total_cmp(&b.offset.length()));
        all
    })
}

fn view<'a>(velocity: Vec3, neighbours: &'a [SteeringNeighbour]) -> SteeringInput<'a> {
    SteeringInput {
        motion: Motion::moving(Vec3::ONE, velocity),
        vehicle: flier(),
        neighbours,
        ..SteeringInput::default()
    }
}

fn double(v: Vec3) -> DVec3 {
    v.as_dvec3()
}

fn force(behaviour: &dyn Behaviour, view: &SteeringInput<'_>) -> DVec3 {
    ask(behaviour, view).map_or(DVec3::ZERO, |said| double(said.force))
}

/// Normalises a vector; zero stays zero.
fn unit(v: DVec3) -> DVec3 {
    v.normalize_or_zero()
}

/// The neighbours within a distance and an angle in degrees, or within three radii.
fn near(all: &[SteeringNeighbour], forward: Vec3, distance: f64, degrees: f64) -> Vec<SteeringNeighbour> {
    let belongs = |other: &&SteeringNeighbour| {
        let (offset, forward) = (double(other.offset), double(forward));
        let aside = offset.cross(forward).length().atan2(offset.dot(forward)).to_degrees();
        offset.length() < 0.6 || offset.length() < distance && aside < degrees
    };
    all.iter().filter(belongs).copied().collect()
}

fn mean(all: &[SteeringNeighbour], of: impl Fn(&SteeringNeighbour) -> Vec3) -> DVec3 {
    all.iter().map(|other| double(of(other))).sum::<DVec3>() / all.len() as f64
}

/// Whether a force of 5 N turns a velocity to a side by the angle that it gives in 0.02 s, at the same speed. Slower
/// than 0.1 m/s, which is the change of speed, the force must be sideways.
fn veers(velocity: Vec3, force: Vec3, side: Vec3) -> bool {
    let (speed, after) = (velocity.length(), velocity + force * 0.02);
    if speed < 0.1 {
        return force.distance(side * 5.0) < 1e-3;
    }
    let turned = angle(velocity, after);
    (turned - 0.1 / speed).abs() < 2e-3 && (after.length() - speed).abs() < 1e-4 && after.dot(side) > 0.0
}

proptest! {
    #[test]
    fn neighbourhoods_are_those_near_and_ahead(
        all in others(), velocity in vector(1.0), distance in 0.5f32..8.0, degrees in 5.0f32..180.0, most in 1usize..9,
    ) {
        prop_assume!(velocity.length() > 0.1);
        let hood = Neighbourhood {
            distance, angle: Angle::from_radians(degrees.to_radians()), always: 3.0, most, ..Neighbourhood::default()
        };
        let sharp = all.iter().all(|other| (angle(other.offset, velocity).to_degrees() - degrees).abs() > 0.01);
        prop_assume!(sharp);
        let mut expected = near(&all, velocity, distance.into(), degrees.into());
        expected.truncate(most);
        prop_assert_eq!(hood.of(&view(velocity, &all)).copied().collect::<Vec<_>>(), expected);
        for (groups, own) in [(GroupFilter::OwnGroup, true), (GroupFilter::OtherGroups, false)] {
            let hood = Neighbourhood { groups, ..Neighbourhood::default() };
            prop_assert!(hood.of(&view(velocity, &all)).all(|other| (other.group == 0) == own));
        }
    }

    /// The sums of the papers.
    #[test]
    fn flocks_follow_three_rules(all in others(), velocity in vector(1.0), full in 0.1f32..2.0) {
        prop_assume!(velocity.length() > 0.1);
        let (view, hood) = (view(velocity, &all), Neighbourhood::default());
        let soft = |sum: DVec3| sum * 5.0 / sum.length().max(f64::from(full));
        let close = |a: DVec3, b: DVec3| a.distance(b) < 2e-3;
        let push = |power: i32| -> DVec3 {
            all.iter().map(|other| {
                let away = -double(other.offset);
                away.normalize() / away.length().powi(power)
            }).sum()
        };
        for (falloff, power) in [(Falloff::Inverse, 1), (Falloff::InverseSquare, 2)] {
            let said = force(&Separation { near: hood, falloff, full }, &view);
            prop_assert!(close(said, soft(push(power))));
        }
        if !all.is_empty() {
            let forward = double(view.forward());
            let said = force(&Cohesion { near: hood, full }, &view);
            prop_assert!(close(said, soft(mean(&all, |other| other.offset))));
            let turn = mean(&all, |other| other.forward) - forward;
            let said = force(&Alignment { near: hood, full }, &view);
            prop_assert!(close(said, soft(turn)));
            let matched = double(view.chosen(ask(&MatchVelocity { near: hood }, &view)));
            prop_assert!(close(matched, mean(&all, |other| other.velocity)));
        }
    }

    /// OpenSteer's boids: each rule normalised, weighted, and added.
    #[test]
    fn flocking_is_nine_numbers(all in others(), velocity in vector(1.0)) {
        prop_assume!(velocity.length() > 0.1);
        let forward = view(velocity, &[]).forward();
        let degrees = |degrees: f32| Angle::from_radians(degrees.to_radians());
        let rule = |weight: f32, distance: f32, angle: f32| Rule { weight, distance, angle: degrees(angle) };
        let flocking = Flocking {
            separation: rule(0.4, 3.0, 135.0), alignment: rule(0.3, 4.0, 45.0), cohesion: rule(0.2, 5.0, 100.0),
            groups: GroupFilter::All, ..Flocking::default()
        };
        prop_assume!(all.iter().all(|other| [135.0, 45.0, 100.0].iter().all(|a| (angle(other.offset, forward).to_degrees() - a).abs() > 0.01)));
        let [apart, along, together] = [(3.0, 135.0), (4.0, 45.0), (5.0, 100.0)].map(|(d, a)| near(&all, forward, d, a));
        let mut expected = unit(apart.iter().map(|other| -double(other.offset) / double(other.offset).length_squared()).sum()) * 0.4;
        if !along.is_empty() {
            expected += unit(mean(&along, |other| other.forward) - double(forward)) * 0.3;
        }
        if !together.is_empty() {
            expected += unit(mean(&together, |other| other.offset)) * 0.2;
        }
        prop_assert!(force(&flocking, &view(velocity, &all)).distance(expected * 5.0) < 5e-3);
    }

    /// The urges of 1987 in f64: weights by the inverse square of the distance, more ahead; strict order.
    #[test]
    fn boids_are_those_of_1987(all in others(), velocity in vector(1.0)) {
        prop_assume!(velocity.length() > 0.1);
        let boids = Boids { near: Neighbourhood::default(), migration: Some(Target::Point(Vec3::X * 50.0)), ..Boids::default() };
        let view = view(velocity, &all);
        let (v, speed) = (double(velocity), f64::from(velocity.length()) / 1.8);
        let weigh = |other: &SteeringNeighbour| {
            let offset = double(other.offset);
            let ahead = offset.normalize().dot(v.normalize()).max(0.0) * speed;
            (1.5 / offset.length().max(0.2)).powi(2) * (1.0 + ahead)
        };
        let sum = |of: &dyn Fn(&SteeringNeighbour) -> DVec3| all.iter().map(|other| of(other) * weigh(other)).sum::<DVec3>();
        let weights = all.iter().map(weigh).sum::<f64>().max(1e-30);
        let mut left = 1.0;
        let mut expected = DVec3::ZERO;
        for urge in [
            -sum(&|other| double(other.offset).normalize()),
            sum(&|other| double(other.velocity) - v) / weights / 1.8 * 1.0,
            sum(&|other| double(other.offset)) / weights / 4.5,
            (DVec3::new(50.0, 0.0, 0.0) - DVec3::ONE).normalize(),
        ].iter().zip([1.0, 0.8, 0.5, 0.4]).map(|(urge, strength)| urge.clamp_length_max(1.0) * strength) {
            expected += urge.clamp_length_max(f64::max(left, 0.0));
            left -= urge.length();
        }
        prop_assert!(force(&boids, &view).distance(expected * 5.0) < 5e-3);
    }

    /// Two agents that meet at any angle and any time pass with the gap.
    #[test]
    fn changes_of_course_and_speed_lead_past(degrees in 5.0f32..180.0, late in -0.3f32..0.3, gap in 0.0f32..0.4, seconds in rate()) {
        let walk = |from: Vec3| {
            let avoid = UnalignedAvoidance { gap, horizon: 4.0, ..UnalignedAvoidance::default() };
            let goal = Seek { target: Target::Point(-from * 4.0) };
            let parts = vec![(3.0, avoid.into()), (0.5, goal.into())];
            Actor::new(Motion::moving(from, -from.normalize() * 1.4), Vehicle::default(), WeightedSum(parts))
        };
        let (a, b) = (Vec3::X * -7.0, -Vec3::new(degrees.to_radians().cos(), degrees.to_radians().sin(), 0.0) * (7.0 + late));
        prop_assume!(a.distance(b) > 1.0);
        let mut stage = Stage::new(seconds, vec![walk(a), walk(b)]);
        let mut nearest = f32::INFINITY;
        stage.run(15.0, |stage| {
            nearest = nearest.min(stage.actors[0].motion.position.distance(stage.actors[1].motion.position));
        });
        prop_assert!(nearest > 1.95 * RADIUS + 0.3 * gap, "{nearest}");
    }

    /// OpenSteer's rules, by angles.
    #[test]
    fn opensteer_turns_aside(all in others(), velocity in on_ground(1.5)) {
        prop_assume!(velocity.length() > 0.1);
        let all: Vec<SteeringNeighbour> = all.into_iter().filter(|other| other.offset.length() > 0.5).map(|other| SteeringNeighbour {
            offset: other.offset.with_z(0.0), velocity: other.velocity.with_z(0.0), forward: other.velocity.with_z(0.0).normalize_or(Vec3::X), ..other
        }).collect();
        prop_assume!(all.iter().all(|other| other.offset.length() > 0.41));
        let mut sharp = true;
        // by a search for the closest approach
        let threats = all.iter().filter_map(|other| {
            let relative = double(other.velocity - velocity);
            let time = -double(other.offset).dot(relative) / relative.length_squared();
            let miss = (double(other.offset) + relative * time).length();
            sharp &= (miss - 0.4).abs() > 1e-3 && (time - 3.0).abs() > 1e-3 && time.abs() > 1e-3;
            (time > 0.0 && time < 3.0 && miss < 0.4).then_some((time, other))
        }).min_by(|a, b| a.0.total_cmp(&b.0));
        let left = Vec3::Z.cross(velocity.normalize());
        let expected = threats.and_then(|(time, other)| {
            let between = angle(velocity, other.forward).to_degrees();
            let at = if between > 135.0 { other.offset + other.velocity * time as f32 } else if between < 45.0 { other.offset } else { other.velocity };
            sharp &= (between - 135.0).abs() > 0.1 && (between - 45.0).abs() > 0.1 && at.dot(left).abs() > 1e-3;
            let turns = !(45.0..135.0).contains(&between) || other.velocity.length() <= velocity.length();
            turns.then_some(if at.dot(left) > 0.0 { -left } else { left })
        });
        prop_assume!(sharp);
        let said = ask(&AvoidNeighbours::default(), &SteeringInput { vehicle: Vehicle::default(), ..view(velocity, &all) });
        prop_assert_eq!(said.is_some(), expected.is_some());
        if let (Some(said), Some(side)) = (said, expected) {
            prop_assert!(veers(velocity, said.force, side), "{} {side}", said.force);
        }
    }

    #[test]
    fn the_agent_turns_away_from_the_nearest_neighbour_that_is_too_close(all in others(), velocity in vector(1.0), gap in 0.0f32..3.0) {
        prop_assume!(velocity.length() > 0.1);
        let said = ask(&CloseAvoidance { groups: GroupFilter::All, gap }, &view(velocity, &all)).map(|said| said.force);
        let close = all.first().filter(|other| other.offset.length() < gap + 0.4);
        prop_assert_eq!(said.is_some(), close.is_some());
        if let (Some(said), Some(close)) = (said, close) {
            let side = angle(close.offset, velocity).sin() * close.offset.length();
            prop_assume!(side > 1e-2);
            let aside = close.offset - velocity * (close.offset.dot(velocity) / velocity.length_squared());
            prop_assert!(veers(velocity, said, -aside.normalize()), "{said}");
        }
    }

    /// No other assignment of the places is better.
    #[test]
    fn no_assignment_is_better(agents in prop::collection::vec(vector(5.0), 0..6), places in prop::collection::vec(vector(5.0), 6..7)) {
        fn best(agents: &[Vec3], places: &[Vec3], taken: u32) -> f64 {
            let Some((first, rest)) = agents.split_first() else { return 0.0 };
            (0..places.len())
                .filter(|place| taken & (1 << place) == 0)
                .map(|place| f64::from(first.distance_squared(places[place])) + best(rest, places, taken | 1 << place))
                .fold(f64::INFINITY, f64::min)
        }
        let assigned = assign(&agents, &places);
        let cost: f64 = agents.iter().zip(&assigned).map(|(agent, &place)| f64::from(agent.distance_squared(places[place]))).sum();
        let mut different = assigned.clone();
        different.sort_unstable();
        different.dedup();
        prop_assert_eq!(different.len(), agents.len());
        prop_assert!((cost - best(&agents, &places, 0)).abs() < 1e-3, "{cost}");
    }

    /// The head of the queue moves and stops at random: the agents behind it never come nearer than the gap, however
    /// slow their vehicles respond, and reach its speed in the end.
    #[test]
    fn a_queue_does_not_push(
        speeds in prop::collection::vec(0.0f32..1.8, 1..6), rooms in prop::collection::vec(0.0f32..1.5, 1..6),
        response in 0.0f32..0.6, headway in 0.1f32..3.0, gap in 0.0f32..0.5, seconds in rate(),
    ) {
        let last = speeds[speeds.len() - 1];
        let head = FollowFlow {
            flow: Arc::new(move |_: Vec3, time: f64| Vec3::X * speeds[(time as usize / 3).min(speeds.len() - 1)].max(1e-9)),
            prediction: 0.0,
        };
        let at_once = Vehicle { response: 0.0, max_force: 1e9, ..Vehicle::default() };
        let mut actors = vec![Actor::new(Motion::default(), at_once, head)];
        let vehicle = Vehicle { response, ..Vehicle::default() };
        let mut x = 0.0;
        for room in rooms {
            x -= 2.0 * RADIUS + gap + room;
            let queue = Queue { gap, headway, distance: 30.0, ..Queue::new(TargetSpeed { speed: 1.8 }) };
            actors.push(Actor::new(Motion::at_rest(Vec3::X * x, Vec3::X), vehicle, queue));
        }
        let mut stage = Stage::new(seconds, actors);
        let mut nearest = f32::INFINITY;
        stage.run(120.0, |stage| {
            for pair in stage.actors.windows(2) {
                nearest = nearest.min(pair[0].motion.position.x - pair[1].motion.position.x);
            }
        });
        prop_assert!(nearest > 2.0 * RADIUS + gap - 1e-3, "{nearest}");
        let rate = stage.actors.iter().map(|actor| (actor.motion.speed() - last).abs()).fold(0.0, f32::max);
        prop_assert!(rate < 0.05, "{rate}");
    }

    /// For every pattern each agent ends up in its place, and no two agents in one place.
    #[test]
    fn formations_form(starts in prop::collection::vec(on_ground(6.0), 1..8), kind in 0usize..5, velocity in on_ground(0.7), seconds in rate()) {
        prop_assume!(velocity.length() > 0.1);
        let pattern = [Pattern::Line, Pattern::Column, Pattern::Wedge, Pattern::Circle, Pattern::Grid][kind];
        let count = starts.len();
        let leader = Actor::new(Motion::moving(Vec3::ZERO, velocity), Vehicle::default(), MoveForward { part: 0.0 });
        let basis = leader.motion.basis;
        let places: Vec<Vec3> = (0..count).map(|i| basis.to_world(pattern.place(i, count, 1.5))).collect();
        let apart = places.iter().enumerate().flat_map(|(i, a)| places[..i].iter().map(move |b| a.distance(*b))).fold(f32::INFINITY, f32::min);
        prop_assert!(count < 2 || apart > 1.499, "{apart}");
        let keep = KeepFormation { leader: Target::Agent(0), pattern, count: Some(count), spacing: 1.5, slowing_distance: 1.0 };
        let slots = assign(&starts, &places);
        let member = |(start, slot): (&Vec3, usize)| Actor {
            slot, ..Actor::new(Motion::at_rest(*start, Vec3::X), Vehicle::default(), keep)
        };
        let members = starts.iter().zip(slots.iter().copied()).map(member);
        let mut stage = Stage::new(seconds, std::iter::once(leader).chain(members).collect());
        stage.run(40.0, |_| ());
        let lead = stage.actors[0].motion.position;
        for (actor, slot) in stage.actors[1..].iter().zip(slots) {
            prop_assert!(actor.motion.position.distance(lead + places[slot]) < 0.05);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Followers end up behind the leader, apart from each other, and out of its way when it turns back.
    #[test]
    fn followers_follow(off in prop::collection::vec(on_ground(0.5), 6), single_file: bool, seconds in rate()) {
        let follow = FollowLeader { single_file, ..FollowLeader::new(Target::Agent(0)) };
        let start =
            |i: usize| Motion::at_rest(Vec3::new((i % 3) as f32 - 2.0, (i / 3) as f32 - 1.0, 0.0) * 1.5 + off[i], Vec3::X);
        let slow = Vehicle { max_speed: 1.0, ..Vehicle::default() };
        let leader = Actor::new(Motion::default(), slow, Seek { target: Target::Point(Vec3::X * 1e3) });
        let followers = (0..6).map(|i| Actor { group: 1, ..Actor::new(start(i), Vehicle::default(), follow) });
        let mut stage = Stage::new(seconds, std::iter::once(leader).chain(followers).collect());
        let mut nearest = f32::INFINITY;
        stage.run(30.0, |stage| {
            if stage.time() > 15.0 {
                let apart = |row: usize| stage.neighbours(row)[0].offset.length();
                nearest = nearest.min((0..7).map(apart).fold(f32::INFINITY, f32::min));
            }
        });
        let places: Vec<Vec3> =
            stage.actors.iter().map(|actor| actor.motion.position - stage.actors[0].motion.position).collect();
        prop_assert!(places[1..].iter().all(|place| place.x < 0.0), "behind: {places:?}");
        prop_assert!(nearest > 0.35, "{nearest}");
        if single_file {
            prop_assert!(places[1..].windows(2).all(|pair| pair[1].x < pair[0].x - 0.4), "{places:?}");
            prop_assert!(places.iter().all(|place| place.y.abs() < 0.2), "{places:?}");
        }
        // the leader turns back through its followers
        stage.actors[0].behaviour = Seek { target: Target::Point(-Vec3::X * 1e3) }.into();
        nearest = f32::INFINITY;
        stage.run(15.0, |stage| nearest = nearest.min(stage.neighbours(0)[0].offset.length()));
        prop_assert!(nearest > 0.3, "{nearest}");
    }
}

/// Each flock forms: all birds fly in one direction, together, without contact.
#[test]
fn flocks_form() {
    let bird = Vehicle { max_speed: 9.0, max_force: 27.0, min_speed: 2.0, ..flier() };
    let soft = |distance: f32| Neighbourhood { distance, ..Neighbourhood::default() };
    let gentle = WeightedSum(vec![
        (0.6, Separation { near: soft(5.0), full: 1.0, ..Separation::default() }.into()),
        (0.5, MatchVelocity { near: Neighbourhood { most: 7, ..Neighbourhood::default() } }.into()),
        (0.3, Cohesion { near: Neighbourhood { most: 7, ..Neighbourhood::default() }, full: 5.0 }.into()),
    ]);
    let flocks: [(&str, BoxedBehaviour); 3] =
        [("flocking", Flocking::default().into()), ("boids", Boids::default().into()), ("topological", gentle.into())];
    for (name, behaviour) in flocks {
        let start = |i: usize| {
            let turn = i as f32 * 2.4;
            let place = Vec3::new(turn.cos(), turn.sin(), (i as f32 * 0.7).sin()) * (0.8 * (i as f32 + 1.0).sqrt());
            Motion::moving(place, Vec3::new((i as f32).cos(), (i as f32).sin(), 0.0) * 2.7)
        };
        let pushes = WeightedSum(vec![(1.0, behaviour), (0.1, MoveForward { part: 1.0 }.into())]);
        let pushes = BoxedBehaviour::from(pushes);
        for seconds in RATES {
            let mut stage = Stage::new(seconds, (0..24).map(|i| Actor::new(start(i), bird, pushes.clone())).collect());
            // the mean alignment of each bird with its nearest neighbour
            let order = |stage: &Stage| {
                let likeness =
                    |row: usize| stage.neighbours(row)[0].forward.dot(stage.actors[row].motion.basis.forward);
                (0..24).map(likeness).sum::<f32>() / 24.0
            };
            let before = order(&stage);
            stage.run(20.0, |_| ());
            assert!(before < 0.5 && order(&stage) > 0.9, "{name}: {before} {}", order(&stage));
            let nearest: Vec<f32> = (0..24).map(|row| stage.neighbours(row)[0].offset.length()).collect();
            assert!(nearest.iter().all(|&distance| distance > 0.3), "{name}: {nearest:?}");
            // a flock with a limited range loses some birds, a topological flock loses none
            assert!(name != "topological" || nearest.iter().all(|&distance| distance < 8.0), "{nearest:?}");
        }
    }
}

/// Reynolds' demo of 1999: thirty agents that wander in a square hardly touch.
#[test]
fn followers_of_a_bunch_have_places_of_their_own() {
    let follow = FollowLeader { gap: 2.0, spread: 1.5, ..FollowLeader::new(Target::Point(Vec3::ONE)) };
    let own = |number: u32, follow: &FollowLeader| {
        let rng = Rng { seed: 1, number, step: 7 };
        force(follow, &SteeringInput { rng, ..view(Vec3::ZERO, &[]) })
    };
    assert!(own(1, &follow).distance(own(2, &follow)) > 1e-3);
    for same in [FollowLeader { spread: 0.0, ..follow }, FollowLeader { single_file: true, ..follow }] {
        assert_eq!(own(1, &same), own(2, &same));
    }
}

#[test]
fn a_meeting_beyond_the_destination_is_none() {
    // they would touch in 2 s, 2 m ahead
    let offset = Vec3::new(4.0, 0.1, 0.0);
    let other = SteeringNeighbour { offset, velocity: -Vec3::X, forward: -Vec3::X, radius: 0.2, number: 1, group: 0 };
    let others = [other];
    let view = view(Vec3::X, &others);
    let avoids = |ahead: f32| {
        let destination = Some(Target::Point(Vec3::ONE + Vec3::X * ahead));
        ask(&UnalignedAvoidance { destination, ..UnalignedAvoidance::default() }, &view).is_some()
    };
    assert_eq!([avoids(1.0), avoids(3.0)], [false, true]);
}

#[test]
fn strollers_hardly_touch() {
    for seconds in RATES {
        let touches = |avoid: fn() -> BoxedBehaviour| {
            let walk = |i: usize| {
                let place = Vec3::new((i % 6) as f32 - 2.5, (i / 6) as f32 - 2.0, 0.0) * 2.0;
                let home = Tether { to: Target::Point(Vec3::ZERO), length: 6.0 };
                let parts = vec![avoid(), home.into(), Wander::default().into()];
                let slow = Vehicle { max_speed: 1.2, ..Vehicle::default() };
                Actor::new(Motion::moving(place, Vec3::X), slow, Priority { epsilon: 0.0, parts })
            };
            let mut stage = Stage::new(seconds, (0..30).map(walk).collect());
            let mut touching = 0;
            stage.run(40.0, |stage| {
                touching += (0..30).filter(|&row| stage.neighbours(row)[0].offset.length() < 2.0 * RADIUS).count();
            });
            touching
        };
        let never = || Tether { to: Target::Point(Vec3::ZERO), length: f32::INFINITY }.into();
        let (without, with) = (touches(never), touches(|| UnalignedAvoidance::default().into()));
        let turning = touches(|| AvoidNeighbours::default().into());
        assert!(with * 20 < without && turning * 2 < without, "{seconds}: {without}, {with}, {turning}");
    }
}
