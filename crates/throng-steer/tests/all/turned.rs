//! No behaviour depends on the direction of the axes: rotated scenes give rotated forces.

use crate::harness::{Actor, Stage, flier, on_ground, rotation, vector};
use glam::{Quat, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::motion::{Motion, Vehicle};
use throng::parameters::Angle;
use throng::steer::{BoxedBehaviour, GroupFilter, Stimulus, Target, TraceRecorder};
use throng_steer::{
    Alignment, Allocation, Amortised, Arrive, AvoidNeighbours, Boids, CloseAvoidance, Cohesion, ContextSteering,
    Docking, Evade, Face, Fear, Flee, Flocking, FollowFlow, FollowLeader, Forage, FractalWander, Hold, Interpose,
    Irregular, KeepFormation, KeepStation, Limited, LookWhereYouGo, MatchOrientation, MatchVelocity, MoveForward,
    Noise, OffsetPursuit, Pattern, Prediction, Pursue, Queue, Seek, Separation, Shadow, StopAndWait, TargetSpeed,
    Tether, UnalignedAvoidance, Wander, WeightedSum,
};

/// All behaviours, in a scene with this rotation.
fn all(by: Quat) -> Vec<BoxedBehaviour> {
    let place = by * Vec3::new(2.0, -1.0, 0.5);
    let (point, other, near) = (Target::Point(place), Target::Agent(1), Target::Nearest(GroupFilter::All));
    let field = move |at: Vec3, time: f64| at * 0.1 + place * time.sin() as f32;
    vec![
        Seek { target: point }.into(),
        Flee::new(near).into(),
        Pursue::new(other).into(),
        Evade::new(other).into(),
        OffsetPursuit { quarry: other, prediction: Prediction::default(), distance: 2.0 }.into(),
        KeepStation { leader: other, offset: Vec3::new(-1.0, 2.0, 0.5), slowing_distance: 2.0 }.into(),
        Arrive::new(point).into(),
        Interpose { ratio: 0.3, ..Interpose::new(other, point) }.into(),
        Shadow { quarry: other, distance: 1.0, slowing_distance: 1.0 }.into(),
        Docking { place, direction: by * Vec3::Y, speed: 0.0, time: None }.into(),
        Wander::default().into(),
        FractalWander::default().into(),
        Forage { food: near, range: 2.0, of: Wander::default().into() }.into(),
        Tether { to: point, length: 1.0 }.into(),
        TargetSpeed { speed: 1.0 }.into(),
        MoveForward { part: 0.5 }.into(),
        Face { target: point }.into(),
        LookWhereYouGo.into(),
        MatchOrientation { with: other }.into(),
        FollowFlow { flow: Arc::new(field), prediction: 0.5 }.into(),
        Fear { range: 9.0, fades: 4.0 }.into(),
        Separation::default().into(),
        Cohesion::default().into(),
        Alignment::default().into(),
        MatchVelocity::default().into(),
        Flocking::default().into(),
        Boids { migration: Some(point), ..Boids::default() }.into(),
        UnalignedAvoidance::default().into(),
        AvoidNeighbours::default().into(),
        CloseAvoidance { groups: GroupFilter::All, gap: 2.0 }.into(),
        Queue { distance: 9.0, width: 5.0, ..Queue::new(Seek { target: point }) }.into(),
        FollowLeader::new(other).into(),
        FollowLeader { single_file: true, ..FollowLeader::new(other) }.into(),
        KeepFormation { leader: other, pattern: Pattern::Wedge, count: Some(3), spacing: 2.0, slowing_distance: 1.0 }
            .into(),
        Amortised { every: 0.1, of: Seek { target: point }.into() }.into(),
        Hold { seconds: 0.5, of: AvoidNeighbours::default().into() }.into(),
        Irregular {
            angle: Angle::from_radians(0.2),
            speed: 0.1,
            noise: Noise::default(),
            of: Seek { target: point }.into(),
        }
        .into(),
        StopAndWait::new(Seek { target: point }).into(),
        Limited { max_speed: 1.0, max_force: 2.0, of: Seek { target: point }.into() }.into(),
        ContextSteering::new(vec![(1.0, Seek { target: point }.into())]).into(),
        WeightedSum(vec![(1.0, Flocking::default().into()), (0.5, Wander::default().into())]).into(),
        Allocation { budget: 0.7, parts: vec![Separation::default().into(), Cohesion::default().into()] }.into(),
    ]
}

/// Returns two steerings of an agent in a row, the second with the memory of the first.
fn says(stage: &Stage, behaviour: &BoxedBehaviour) -> [Option<(Vec3, Option<Vec3>)>; 2] {
    let mut memory = vec![0.0; behaviour.words()];
    [0, 1].map(|step| {
        let stage = Stage { step, ..stage.clone() };
        let neighbours = stage.neighbours(0);
        let said = behaviour.steer(&stage.view(0, &neighbours), &mut memory, &mut TraceRecorder::default());
        said.map(|said| (said.force, said.facing))
    })
}

fn compare(moves: &[(Vec3, Vec3)], vehicle: Vehicle, by: Quat) -> Result<(), TestCaseError> {
    let idle = || BoxedBehaviour::from(MoveForward { part: 0.0 });
    let actors = moves.iter().map(|&(place, velocity)| Actor::new(Motion::moving(place, velocity), vehicle, idle()));
    let stage = Stage {
        stimuli: vec![Stimulus { position: Vec3::new(1.0, 2.0, 0.0), time: 0.0 }],
        ..Stage::new(0.02, actors.collect())
    };
    let turned = stage.turned(by);
    for (plain, other) in all(Quat::IDENTITY).iter().zip(all(by)) {
        for (plain_says, other_says) in says(&stage, plain).into_iter().zip(says(&turned, &other)) {
            prop_assert_eq!(plain_says.is_some(), other_says.is_some(), "{:?}", plain);
            let (Some((force, facing)), Some((other_force, other_facing))) = (plain_says, other_says) else { continue };
            let off = (by * force).distance(other_force);
            prop_assert!(off < 5e-3 * (1.0 + force.length()), "{plain:?}: {} {other_force}", by * force);
            let face = |facing: Option<Vec3>| facing.unwrap_or_default();
            prop_assert!((by * face(facing)).distance(face(other_facing)) < 1e-3);
        }
    }
    Ok(())
}

fn moves(space: bool) -> impl Strategy<Value = Vec<(Vec3, Vec3)>> {
    let flat = move |v: Vec3| if space { v } else { v.with_z(0.0) };
    let one = (vector(4.0), vector(1.5)).prop_filter_map("at rest", move |(place, velocity)| {
        (flat(velocity).length() > 0.1).then_some((flat(place), flat(velocity)))
    });
    prop::collection::vec(one, 2..7)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    #[test]
    fn in_space(moves in moves(true), by in rotation()) {
        compare(&moves, flier(), by)?;
    }

    #[test]
    fn on_the_ground(moves in moves(false), turn in 0.0f32..6.0) {
        compare(&moves, Vehicle::default(), Quat::from_rotation_z(turn))?;
    }

    /// On the ground no steering leads up.
    #[test]
    fn the_ground_is_flat(places in prop::collection::vec((vector(4.0), on_ground(1.5)), 2..7)) {
        let idle = || BoxedBehaviour::from(MoveForward { part: 0.0 });
        let actors = places.iter().map(|&(place, v)| Actor::new(Motion::moving(place, v), Vehicle::default(), idle()));
        let stage = Stage::new(0.02, actors.collect());
        for behaviour in all(Quat::IDENTITY) {
            for said in says(&stage, &behaviour).into_iter().flatten() {
                prop_assert!(said.0.z.abs() < 1e-4, "{behaviour:?}");
            }
        }
    }
}
