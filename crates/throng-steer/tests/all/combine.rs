//! Combinations of behaviours: the forces that they grant, and the parts that they run.

use crate::harness::{Actor, RADIUS, RATES, Stage, angle, ask, on_ground, told, vector};
use glam::{DVec3, Quat, Vec3};
use proptest::prelude::*;
use std::f32::consts::TAU;
use throng::motion::{Motion, Steering, Vehicle};
use throng::parameters::Angle;
use throng::space::surface::{Cylinder, SeenFrom, Surface};
use throng::steer::{
    Barriers, Behaviour, BoxedBehaviour, GroupFilter, Rng, SteeringInput, SteeringNeighbour, SteeringReason, Target,
    TraceRecorder,
};
use throng_steer::{
    Allocation, Amortised, Condition, ContextSteering, Dithering, Face, Flee, Hold, Irregular, Limited, Neighbourhood,
    Noise, Priority, RunningSum, Seek, State, StopAndWait, Switch, Wander, WeightedSum,
};

/// Returns a constant steering.
#[derive(Clone, Copy, Debug)]
pub struct Says(pub Option<Vec3>);

impl Behaviour for Says {
    fn steer(&self, _: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        self.0.map(Steering::from)
    }
}

/// Returns the time as a force, until a time.
#[derive(Clone, Copy, Debug)]
pub struct Clock(pub f64);

impl Behaviour for Clock {
    /// Number of calls.
    fn memory(&self) -> usize {
        1
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        memory[0] += 1.0;
        (view.time < self.0).then(|| (Vec3::X * (1.0 + view.time as f32)).into())
    }
}

fn force(behaviour: &dyn Behaviour) -> Option<Vec3> {
    ask(behaviour, &SteeringInput::default()).map(|said| said.force)
}

fn says() -> impl Strategy<Value = Vec<Option<Vec3>>> {
    prop::collection::vec(prop::option::of(vector(4.0)), 0..6)
}

fn branches(says: &[Option<Vec3>]) -> Vec<BoxedBehaviour> {
    says.iter().map(|&one| Says(one).into()).collect()
}

fn weighted(says: &[Option<Vec3>], weight: f32) -> Vec<(f32, BoxedBehaviour)> {
    branches(says).into_iter().map(|branch| (weight, branch)).collect()
}

proptest! {
    #[test]
    fn sums_are_sums(all in says(), weight in 0.0f32..2.0) {
        let expected = all.iter().flatten().fold(DVec3::ZERO, |sum, f| sum + f.as_dvec3() * f64::from(weight));
        let sum = force(&WeightedSum(weighted(&all, weight)));
        prop_assert_eq!(sum.is_some(), all.iter().any(Option::is_some));
        prop_assert!(sum.unwrap_or_default().as_dvec3().distance(expected) < 1e-4);
    }

    #[test]
    fn priority_is_the_first_that_says_something(all in says(), epsilon in 0.0f32..4.0) {
        let expected = all.iter().flatten().find(|f| f.length() > epsilon).copied();
        let priority = Priority { epsilon, parts: branches(&all) };
        prop_assert_eq!(force(&priority), expected);
        let (said, reasons) = told(&priority, &SteeringInput::default());
        let winner = reasons.iter().rev().find_map(|told| match told.reason {
            SteeringReason::Part { said, .. } => Some(said),
            _ => None,
        });
        prop_assert!(expected.is_none() || winner == Some(said));
    }

    /// Prioritised allocation as in Reynolds, Flocks, herds, and schools, 1987; the sum never exceeds the budget.
    #[test]
    fn allocation_never_exceeds_its_budget(all in says(), part in 0.1f32..1.0) {
        let (mut budget, mut sum) = (f64::from(part) * 5.0, DVec3::ZERO);
        for chosen in all.iter().flatten().map(|f| f.as_dvec3()) {
            let length = chosen.length();
            if length > budget {
                sum += chosen * (budget / length);
                break;
            }
            sum += chosen;
            budget -= length;
        }
        let granted = force(&Allocation { budget: part, parts: branches(&all) }).unwrap_or_default();
        prop_assert!(granted.as_dvec3().distance(sum) < 1e-4);
        prop_assert!(granted.length() <= part * 5.0001);
    }

    #[test]
    fn a_running_sum_never_exceeds_the_force(all in says(), weight in 0.0f32..3.0) {
        let mut sum = DVec3::ZERO;
        for chosen in all.iter().flatten().map(|f| f.as_dvec3() * f64::from(weight)) {
            sum += chosen.clamp_length_max((5.0 - sum.length()).max(0.0));
        }
        let granted = force(&RunningSum(weighted(&all, weight))).unwrap_or_default();
        prop_assert!(granted.as_dvec3().distance(sum) < 1e-3 && granted.length() < 5.001);
    }

    #[test]
    fn limits_of_its_own(chosen in vector(9.0), most in 0.1f32..9.0) {
        let limited = force(&Limited { max_speed: 1.0, max_force: most, of: Says(Some(chosen)).into() }).expect("a force");
        prop_assert!(limited.distance(chosen.clamp_length_max(most.min(5.0))) < 1e-5);
        let slow = Limited { max_speed: 0.5, max_force: 9.0, of: Seek { target: Target::Point(Vec3::X) }.into() };
        prop_assert!(SteeringInput::default().chosen(ask(&slow, &SteeringInput::default())).distance(Vec3::X * 0.5) < 1e-5);
    }

    /// The best of all directions by a search, with the danger by small steps of time.
    #[test]
    fn the_most_interesting_less_its_danger(
        chosen_velocities in prop::collection::vec((on_ground(1.2), 0.1f32..2.0), 1..4), others in prop::collection::vec((on_ground(3.0), on_ground(1.0)), 0..4),
        own in on_ground(1.0),
    ) {
        let all: Vec<SteeringNeighbour> = others.iter().enumerate().map(|(k, &(offset, velocity))| SteeringNeighbour {
            offset, velocity, forward: Vec3::X, radius: 0.2, number: k as u32 + 1, group: 0,
        }).collect();
        prop_assume!(own.length() > 0.01 && all.iter().all(|other| other.offset.length() > 0.41));
        let view = SteeringInput { neighbours: &all, motion: Motion::moving(Vec3::ZERO, own), ..SteeringInput::default() };
        let parts = chosen_velocities.iter().map(|&(chosen, weight)| (weight, Says(Some(view.reach(chosen).force)).into()));
        let parts: Vec<(f32, BoxedBehaviour)> = parts.collect();
        let said = view.chosen(ask(&ContextSteering::new(parts), &view));
        let speed = chosen_velocities.iter().map(|(chosen, _)| chosen.length()).fold(0.0, f32::max);
        let value = |direction: Vec3| {
            let interest = chosen_velocities.iter().map(|(chosen, weight)| weight * chosen.dot(direction)).fold(0.0, f32::max);
            let touches = |time: f32| all.iter().any(|o| (o.offset + (o.velocity - direction * speed) * time).length() < 0.4);
            let safe = (0..2000).map(|k| k as f32 * 1e-3).find(|&time| touches(time)).map_or(1.0, |time| time / 2.0);
            let keeps = 1.0 + 0.2 * angle(own, direction).cos().max(0.0);
            (interest * safe * keeps, direction * speed * safe)
        };
        let slots = (0..16).map(|k| Quat::from_rotation_z(k as f32 * TAU / 16.0) * own.normalize_or(Vec3::X));
        let directions = chosen_velocities.iter().filter_map(|(chosen, _)| chosen.try_normalize()).chain(slots);
        let best = directions.map(value).map(|best| best.0).fold(0.0, f32::max);
        let (found, velocity) = value(said.normalize_or(Vec3::X));
        prop_assert!(best < 5e-3 || found > best - 5e-3 && velocity.distance(said) < 5e-3, "{found} {best} {said}");
    }

}

/// Each part runs with its probability, independently of the rest.
#[test]
fn dithering_asks_with_probabilities() {
    let parts = [0.8, 0.5, 1.0].iter().zip([Vec3::X, Vec3::Y, Vec3::Z]);
    let parts = parts.map(|(&p, v)| (p, Says(Some(v)).into())).collect::<Vec<(f32, BoxedBehaviour)>>();
    let share = |every: f32, parts: &[(f32, BoxedBehaviour)]| {
        let dithering = Dithering { every, parts: parts.to_vec() };
        let sum: Vec3 = (0..4000)
            .map(|step| {
                let rng = Rng { step, ..Rng::default() };
                let view = SteeringInput { rng, time: step as f64 * 0.02, ..SteeringInput::default() };
                ask(&dithering, &view).expect("the last part always runs").force
            })
            .sum();
        sum / 4000.0
    };
    for (every, most) in [(0.0, 0.03), (0.1, 0.06)] {
        let shares = share(every, &parts);
        assert!(shares.distance(Vec3::new(0.8, 0.1, 0.1)) < most, "{shares}");
    }
}

/// Draws that hold for a while do not change within it.
#[test]
fn draws_hold_for_a_while() {
    let dithering = Dithering { every: 0.5, parts: vec![(0.5, Says(Some(Vec3::X)).into())] };
    let mut changes = 0;
    let mut before = None;
    for step in 0..1000 {
        let view =
            SteeringInput { rng: Rng { step, ..Rng::default() }, time: step as f64 * 0.01, ..SteeringInput::default() };
        let said = ask(&dithering, &view);
        changes += u32::from(step > 0 && said != before && step % 50 != 0);
        before = said;
    }
    assert_eq!(changes, 0);
}

#[test]
fn a_machine_goes_from_state_to_state() {
    let (a, b) = (Target::Point(Vec3::X * 3.0), Target::Point(Vec3::Y * 3.0));
    let state = |target, next| State {
        behaviour: Seek { target }.into(),
        exits: vec![(Condition::Nearer { target, than: 0.3 }, next), (Condition::After(60.0), 2)],
    };
    let patrol = Switch(vec![state(a, 1), state(b, 0), State { behaviour: Says(None).into(), exits: vec![] }]);
    assert!(patrol.check().is_ok());
    let mut stage = Stage::new(0.05, vec![Actor::new(Motion::default(), Vehicle::default(), patrol)]);
    let mut states = Vec::new();
    stage.run(30.0, |stage| {
        let state = stage.actors[0].memory[0] as usize;
        if states.last() != Some(&state) {
            states.push(state);
        }
    });
    assert!(states.len() > 5 && states.windows(2).all(|pair| pair[0] + pair[1] == 1), "{states:?}");
}

/// A state that is entered again begins with empty memory.
#[test]
fn states_begin_anew() {
    let state = |next| State { behaviour: Clock(9.0).into(), exits: vec![(Condition::After(0.25), next)] };
    let machine = Switch(vec![state(1), state(0)]);
    let mut memory = vec![0.0; machine.memory()];
    for _ in 0..200 {
        machine.steer(
            &SteeringInput { seconds: 0.1, ..SteeringInput::default() },
            &mut memory,
            &mut TraceRecorder::default(),
        );
        assert!(memory[3] <= 4.0 && memory[4] <= 4.0, "{memory:?}");
    }
}

#[test]
fn conditions_hold_when_they_should() {
    let other = SteeringNeighbour {
        offset: Vec3::X * 2.0,
        velocity: Vec3::ZERO,
        forward: Vec3::X,
        radius: 0.2,
        number: 1,
        group: 0,
    };
    let holds = |condition: Condition, steps: u64| {
        let says = |one: Vec3| Says(Some(one)).into();
        let machine = Switch(vec![
            State { behaviour: says(Vec3::X), exits: vec![(condition, 1)] },
            State { behaviour: says(Vec3::Y), exits: vec![] },
        ]);
        let mut memory = vec![0.0; machine.memory()];
        let neighbours = [other];
        let mut last = None;
        for step in 0..steps {
            let rng = Rng { step, ..Rng::default() };
            let view = SteeringInput {
                neighbours: &neighbours,
                figures: &[0.0, 3.0],
                rng,
                seconds: 0.1,
                ..SteeringInput::default()
            };
            last = machine.steer(&view, &mut memory, &mut TraceRecorder::default());
        }
        last.expect("it always says something").force == Vec3::Y
    };
    let (near, here) = (Target::Nearest(GroupFilter::All), Neighbourhood::default());
    assert!(
        holds(Condition::Nearer { target: near, than: 2.1 }, 1)
            && !holds(Condition::Nearer { target: near, than: 1.9 }, 1)
    );
    assert!(
        holds(Condition::Farther { target: near, than: 1.9 }, 1)
            && holds(Condition::Farther { target: Target::Agent(3), than: 9.0 }, 1)
    );
    assert!(!holds(Condition::After(0.95), 10) && holds(Condition::After(0.95), 12));
    assert!(
        holds(Condition::Crowded { near: here, least: 1 }, 1) && !holds(Condition::Crowded { near: here, least: 2 }, 1)
    );
    assert!(!holds(Condition::Done, 3) && holds(Condition::Not(Box::new(Condition::Done)), 1));
    assert!(!holds(Condition::Chance(0.0), 50) && holds(Condition::Chance(2.0), 50));
    assert!(
        holds(Condition::Figure { of: 1, at_least: 3.0, at_most: f64::INFINITY }, 1)
            && holds(Condition::Figure { of: 1, at_least: 2.0, at_most: 3.0 }, 1)
    );
    assert!(
        !holds(Condition::Figure { of: 0, at_least: 1.0, at_most: 9.0 }, 1)
            && !holds(Condition::Figure { of: 2, at_least: 0.0, at_most: 9.0 }, 1)
    );
    assert!(Condition::Figure { of: 0, at_least: 2.0, at_most: 1.0 }.check().is_err());
    let both = vec![Condition::Crowded { near: here, least: 1 }, Condition::Done];
    assert!(holds(Condition::Any(both.clone()), 1) && !holds(Condition::All(both), 1));
}

/// Between two opposite preferred velocities the agent chooses one, and passes an obstacle, at any time step; with a
/// sum it would stand still.
#[test]
fn context_steering_neither_hesitates_nor_touches() {
    let pillar = Cylinder::new(Vec3::new(3.0, 0.1, -1.0), Vec3::new(3.0, 0.1, 1.0), 0.8).unwrap();
    let seek = |x: f32| (1.0, BoxedBehaviour::from(Seek { target: Target::Point(Vec3::X * x) }));
    for seconds in RATES {
        let barriers = Barriers::default().with(pillar.clone(), SeenFrom::Outside);
        let weighs = ContextSteering { barriers, ..ContextSteering::new(vec![seek(8.0), seek(-8.0)]) };
        let mut stage = Stage::new(seconds, vec![Actor::new(Motion::default(), Vehicle::default(), weighs)]);
        let mut least = f32::INFINITY;
        let mut reached = false;
        stage.run(12.0, |stage| {
            let place = stage.actors[0].motion.position;
            least = least.min(pillar.query(place).distance);
            reached |= place.x.abs() > 7.5;
        });
        assert!(least > RADIUS && reached, "{seconds}: {least}, {}", stage.actors[0].motion.position);
    }
}

/// Every behaviour can be a part of any other, at any depth; each part has its own memory and random numbers.
#[test]
fn everything_nests() {
    let wander = || BoxedBehaviour::from(Wander::default());
    let wrap = |of: BoxedBehaviour, kind: usize| -> BoxedBehaviour {
        match kind {
            0 => WeightedSum(vec![(1.0, of), (0.5, wander())]).into(),
            1 => Priority { epsilon: 0.0, parts: vec![Says(None).into(), of, wander()] }.into(),
            2 => Dithering { every: 0.0, parts: vec![(0.5, wander()), (1.0, of)] }.into(),
            3 => Allocation { budget: 1.0, parts: vec![wander(), of] }.into(),
            4 => RunningSum(vec![(0.1, wander()), (1.0, of)]).into(),
            5 => Amortised { every: 0.05, of }.into(),
            6 => Hold { seconds: 0.3, of }.into(),
            7 => Irregular { angle: Angle::from_radians(0.2), speed: 0.1, noise: Noise::default(), of }.into(),
            8 => StopAndWait::new(of).into(),
            9 => ContextSteering::new(vec![(1.0, of), (0.5, wander())]).into(),
            10 => Limited { max_speed: 1.0, max_force: 2.0, of }.into(),
            _ => Switch(vec![
                State { behaviour: wander(), exits: vec![(Condition::After(0.1), 1)] },
                State { behaviour: of, exits: vec![(Condition::Chance(3.0), 0)] },
            ])
            .into(),
        }
    };
    for first in 0..12 {
        for second in 0..12 {
            let tree = wrap(wrap(wander(), first), second);
            assert!(tree.check().is_ok());
            let run = || {
                let mut stage = Stage::new(0.02, vec![Actor::new(Motion::default(), Vehicle::default(), tree.clone())]);
                stage.run(1.0, |_| ());
                stage.actors[0].motion
            };
            let motion = run();
            assert!(motion.position.is_finite() && motion.speed() > 0.01, "{first} {second}");
            assert_eq!(motion, run(), "the same bits");
            let (said, reasons) = told(&*tree, &SteeringInput::default());
            assert_eq!(said, ask(&*tree, &SteeringInput::default()), "a trace changes nothing");
            assert!(reasons.iter().any(|told| told.depth > 0), "{reasons:?}");
        }
    }
}

/// Two wandering parts in one tree differ; facings and forces come from different parts.
#[test]
fn parts_are_distinguished() {
    let sum = WeightedSum(vec![(1.0, Wander::default().into()), (1.0, Wander::default().into())]);
    let mut memory = vec![0.0; sum.memory()];
    sum.steer(&SteeringInput::default(), &mut memory, &mut TraceRecorder::default());
    assert_ne!(memory[..3], memory[3..]);
    let sidestep = WeightedSum(vec![
        (1.0, Flee::new(Target::Point(Vec3::Y)).into()),
        (1.0, Face { target: Target::Point(Vec3::Y) }.into()),
    ]);
    let said = ask(&sidestep, &SteeringInput::default()).expect("both");
    assert!(said.force.y < 0.0 && said.facing == Some(Vec3::Y));
}

#[test]
fn mistakes_in_parts_are_named() {
    let wrong = Wander { strength: 7.0, ..Wander::default() };
    let tree = Priority { epsilon: 0.0, parts: vec![Hold { seconds: 1.0, of: wrong.into() }.into()] };
    assert!(tree.check().expect_err("it is wrong").to_string().contains("strength is 7"));
    let lost = Switch(vec![State { behaviour: Says(None).into(), exits: vec![(Condition::Done, 1)] }]);
    assert!(lost.check().is_err() && Switch(vec![]).check().is_err());
}
