//! Slipping past several agents, to a heading: compared with the definitions in f64, and by the resulting motion.

use crate::harness::{Actor, RADIUS, Stage, angle, ask, on_ground};
use glam::{DVec3, Vec3};
use proptest::prelude::*;
use throng::motion::{Motion, Vehicle};
use throng::parameters::Angle;
use throng::steer::{GroupFilter, SteeringInput, SteeringNeighbour, Target};
use throng_steer::{ConstantForce, EvadeAll, HeadFor, MoveForward, SlipThrough, WeightedSum};

fn others() -> impl Strategy<Value = Vec<SteeringNeighbour>> {
    let other = (on_ground(12.0), on_ground(1.5), 0usize..3);
    prop::collection::vec(other, 0..6).prop_map(|all| {
        let seen = |(number, (offset, velocity, group)): (usize, (Vec3, Vec3, usize))| {
            let forward = velocity.normalize_or(Vec3::X);
            SteeringNeighbour { offset, velocity, forward, radius: 0.2, number: number as u32 + 1, group }
        };
        all.into_iter().enumerate().map(seen).collect()
    })
}

fn view(velocity: Vec3, neighbours: &[SteeringNeighbour]) -> SteeringInput<'_> {
    SteeringInput {
        motion: Motion::moving(Vec3::new(2.0, -1.0, 0.0), velocity),
        neighbours,
        ..SteeringInput::default()
    }
}

/// Predicted position of a neighbour, relative to the agent, after a part of the time in which the agent would reach
/// its present position.
fn expected(other: &SteeringNeighbour, speed: f64, part: f64) -> DVec3 {
    let (offset, velocity) = (other.offset.as_dvec3(), other.velocity.as_dvec3());
    offset + velocity * (part * offset.length() / speed.max(0.2 * 1.8))
}

proptest! {
    #[test]
    fn it_flees_all_as_the_table_says(velocity in on_ground(1.2), neighbours in others()) {
        prop_assume!(velocity.length() > 0.1 && neighbours.iter().all(|other| other.offset.length() > 0.3));
        let said = ask(&EvadeAll { groups: GroupFilter::Group(1), ..EvadeAll::default() }, &view(velocity, &neighbours));
        let (speed, forward) = (velocity.as_dvec3().length(), velocity.as_dvec3().normalize());
        let mut sum = DVec3::ZERO;
        for other in neighbours.iter().filter(|other| other.group == 1) {
            let behind = forward.dot(other.offset.as_dvec3()) < -2.0 * 0.2;
            let weight = 4.0 / other.offset.as_dvec3().length() * if behind { 0.5 } else { 1.0 };
            sum -= expected(other, speed, 0.5).normalize_or_zero() * weight;
        }
        let force = said.map_or(DVec3::ZERO, |said| said.force.as_dvec3());
        let wanted = sum * (5.0 / sum.length().max(1.0));
        prop_assert!(force.distance(wanted) < 1e-3 * (1.0 + wanted.length()), "{force} {wanted}");
    }

    #[test]
    fn a_corridor_is_clear_when_no_agent_is_in_it(velocity in on_ground(1.2), place in on_ground(15.0), neighbours in others()) {
        let view = view(velocity, &neighbours);
        let way = (place - view.position()).as_dvec3();
        prop_assume!(velocity.length() > 0.1 && way.length() > 0.5);
        let (along, forward) = (way.normalize(), velocity.as_dvec3().normalize());
        let aside = forward.dot(along).abs() < std::f64::consts::FRAC_1_SQRT_2;
        let mut near_a_rule = false;
        let closed = neighbours.iter().filter(|other| other.group != 0).any(|other| {
            let then = expected(other, velocity.as_dvec3().length(), 0.3);
            let (ahead, front) = (then.dot(along), then.dot(forward));
            let across = (then - along * ahead).length();
            near_a_rule |= [ahead + 0.4, ahead - way.length(), across - 1.6, front + 0.8, front + 0.4].iter().any(|gap| gap.abs() < 1e-3);
            let behind = front < -0.8 || aside && front < -0.4;
            !behind && across < 1.6 && ahead >= -0.4 && ahead <= way.length()
        });
        prop_assume!(!near_a_rule);
        let slip = SlipThrough::new(Target::Point(place));
        prop_assert_eq!(slip.is_clear(&view), !closed);
        // the agent never brakes or turns back
        let chosen = view.chosen(ask(&slip, &view));
        prop_assert!(angle(chosen, velocity) <= slip.turn.radians() + 1e-3, "{} rad aside", angle(chosen, velocity));
        prop_assert!((chosen.length() - 1.8).abs() < 1e-3);
        if !closed && angle(place - view.position(), velocity) < slip.turn.radians() {
            prop_assert!(angle(chosen, place - view.position()) < 1e-3);
        }
    }

    #[test]
    fn it_turns_to_its_heading_and_goes_where_it_is_pressed(direction in on_ground(1.0), velocity in on_ground(1.5), seconds in 0.01f32..0.1) {
        prop_assume!(direction.length() > 0.1 && velocity.length() > 0.2);
        // opposite to a heading there is no side to turn to
        prop_assume!(angle(direction, velocity) < 3.0);
        let head = HeadFor::new(Angle::from_radians(libm::atan2f(direction.y, direction.x)));
        let go = WeightedSum(vec![(1.0, head.into()), (1.0, MoveForward { part: 0.2 }.into())]);
        let press = ConstantForce(direction * 9.0);
        for behaviour in [throng::steer::BoxedBehaviour::from(go), press.into()] {
            let actor = Actor::new(Motion::moving(Vec3::ZERO, velocity), Vehicle::default(), behaviour);
            let mut stage = Stage::new(seconds, vec![actor]);
            stage.run(30.0, |_| ());
            let motion = &stage.actors[0].motion;
            prop_assert!(angle(motion.velocity, direction) < 0.02 && motion.speed() > 1.79, "{motion:?}");
        }
    }
}

/// Three agents stand in the way, with gaps: the agent comes through without contact, at every time step.
#[test]
fn it_slips_between_defenders() {
    for seconds in [0.02, 0.04, 0.1] {
        let goal = Vec3::X * 30.0;
        let slip = SlipThrough::new(Target::Point(goal));
        let runner = Actor::new(Motion::moving(Vec3::ZERO, Vec3::X), Vehicle::default(), slip);
        let stands = |x: f32, y: f32| {
            let place = Vec3::new(x, y, 0.0);
            Actor {
                group: 1,
                ..Actor::new(Motion::at_rest(place, -Vec3::X), Vehicle::default(), MoveForward { part: 0.0 })
            }
        };
        let mut stage = Stage::new(seconds, vec![runner, stands(10.0, 0.1), stands(16.0, -2.5), stands(21.0, 1.5)]);
        let (mut near, mut home) = (f32::INFINITY, f32::INFINITY);
        stage.run(30.0, |stage| {
            let at = stage.actors[0].motion.position;
            near = stage.actors[1..].iter().map(|other| other.motion.position.distance(at)).fold(near, f32::min);
            home = home.min(at.distance(goal));
        });
        assert!(near > 2.0 * RADIUS && home < 0.3, "step {seconds}: {near} m off them, {home} m off its goal");
    }
}
