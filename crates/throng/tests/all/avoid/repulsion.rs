//! Common properties of all models of repulsion: they do not depend on the axes, and symmetric situations do not stop
//! agents.

use crate::avoid::common::{choose, other, vector, view};
use glam::{DVec2, Vec2};
use proptest::prelude::*;
use std::sync::Arc;
use throng::avoid::{
    AnticipationVelocity, AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, Cause, CollisionFreeSpeed, LocalModel,
    Moussaid2009, NearEdge, PowerLaw, SocialForce, Workspace,
};
use throng::space::Walls;
use throng::{Agent, Error, Goal, Group, Journey, Obstacle, Settings, Stop, World};

/// All models of repulsion, without preference for a side.
pub fn models() -> [Arc<dyn LocalModel>; 5] {
    [
        Arc::new(CollisionFreeSpeed::default()),
        Arc::new(AnticipationVelocity::default()),
        Arc::new(SocialForce::default()),
        Arc::new(Moussaid2009 { side_preference: 0.0, ..Moussaid2009::default() }),
        Arc::new(PowerLaw::default()),
    ]
}

/// The edges of an obstacle, relative to a place.
pub fn edges_of(obstacle: &Obstacle, place: DVec2) -> Vec<NearEdge> {
    let seen = |p: DVec2| (p - place).as_vec2();
    let walls = Walls::new(&[], [obstacle], DVec2::ZERO);
    walls.edges().iter().map(|&edge| NearEdge { start: seen(edge.start), end: seen(edge.end), edge }).collect()
}

fn crowd() -> impl Strategy<Value = Vec<(Vec2, Vec2)>> {
    let one = (vector(3.0), vector(1.3)).prop_filter("bodies are apart", |(offset, _)| offset.length() > 0.6);
    prop::collection::vec(one, 1..5)
}

/// Neither exactly ahead nor at the limit of a model's view, where the last bit decides.
fn is_generic(all: &[(Vec2, Vec2)], velocity: Vec2, preferred: Vec2) -> bool {
    let (ahead, present) = (preferred.normalize(), velocity.normalize());
    velocity.length() > 0.2
        && preferred.length() > 0.5
        && ahead.dot(present).abs() > 0.05
        && all.iter().all(|(offset, theirs)| {
            let there = *offset + *theirs;
            ahead.perp_dot(*offset).abs() > 0.02
                && ahead.perp_dot(there).abs() > 0.02
                && (ahead.dot(*offset).abs() > 0.02 && present.dot(*offset).abs() > 0.02)
                && theirs.length() > 0.1
        })
}

fn seen(all: &[(Vec2, Vec2)], turn: impl Fn(Vec2) -> Vec2) -> Vec<AvoidanceNeighbour> {
    all.iter().map(|&(offset, theirs)| other(turn(offset), turn(theirs), 0.4, 0.5)).collect()
}

/// Checks that a rotated scene gives the rotated results.
fn assert_turns_along(
    all: &[(Vec2, Vec2)],
    velocity: Vec2,
    preferred: Vec2,
    turn: impl Fn(Vec2) -> Vec2,
) -> Result<(), TestCaseError> {
    for model in models() {
        let plain = choose(&*model, velocity, preferred, &seen(all, |v| v));
        let turned = choose(&*model, turn(velocity), turn(preferred), &seen(all, &turn));
        prop_assert!(turned.distance(turn(plain)) < 5e-3, "{:?}: {} and {}", model, turn(plain), turned);
    }
    Ok(())
}

proptest! {
    #[test]
    fn a_turned_scene_gives_a_turned_answer(
        all in crowd(), velocity in vector(1.0), preferred in vector(1.0), angle in 0.0f32..6.3,
    ) {
        prop_assume!(is_generic(&all, velocity, preferred));
        let turn = Vec2::from_angle(angle);
        assert_turns_along(&all, velocity, preferred, |v| turn.rotate(v))?;
    }

    #[test]
    fn a_mirrored_scene_gives_a_mirrored_answer(all in crowd(), velocity in vector(1.0), preferred in vector(1.0)) {
        prop_assume!(is_generic(&all, velocity, preferred));
        assert_turns_along(&all, velocity, preferred, |v| Vec2::new(v.x, -v.y))?;
    }

    /// For any distances and speeds the results are finite and within the top speed.
    #[test]
    fn answers_are_velocities(
        all in prop::collection::vec((vector(0.6), vector(3.0)), 0..8), velocity in vector(2.0), preferred in vector(1.0),
        step in prop_oneof![Just(0.001f32), 0.01f32..0.5],
    ) {
        let neighbours = seen(&all, |v| v);
        let view = AvoidanceInput { step, ..view(velocity, preferred, 1.5, &neighbours) };
        for model in models() {
            let chosen = model.velocity(&view, &mut Workspace::default());
            prop_assert!(chosen.is_finite() && chosen.length() <= 1.5 + 1e-5, "{:?}: {}", model, chosen);
        }
    }

    /// A neighbour far away has no effect.
    #[test]
    fn a_far_neighbour_does_not_count(offset in vector(1.0), theirs in vector(1.0), preferred in vector(1.0)) {
        prop_assume!(offset.length() > 0.1 && preferred.length() > 0.1);
        let far = [other(offset.normalize() * 60.0, theirs, 0.4, 0.5)];
        for model in models() {
            let (alone, together) = (choose(&*model, preferred, preferred, &[]), choose(&*model, preferred, preferred, &far));
            prop_assert!(alone.distance(preferred) < 1e-3, "{:?}: {}", model, alone);
            prop_assert!(alone.distance(together) < 1e-3, "{:?}: {} {}", model, alone, together);
        }
    }

    /// A convex obstacle repels once, from its nearest point, for any number of edges.
    #[test]
    fn an_obstacle_repels_from_its_nearest_point(place in vector(2.0), turn in 0.0f32..6.3, corners in 3usize..9) {
        let corner = |k: usize| Vec2::from_angle(turn + k as f32 * std::f32::consts::TAU / corners as f32);
        let ring: Vec<DVec2> = (0..corners).map(|k| corner(k).as_dvec2()).collect();
        let at = place.as_dvec2();
        let nearest = (0..corners).map(|k| throng::space::nearest_on_segment(ring[k], ring[(k + 1) % corners], at));
        let nearest = nearest.min_by(|a, b| a.distance(at).total_cmp(&b.distance(at))).unwrap();
        let inside = (0..corners).all(|k| (ring[(k + 1) % corners] - ring[k]).perp_dot(at - ring[k]) > -0.01);
        prop_assume!(!inside);
        let edges = edges_of(&Obstacle::Polygon { corners: ring }, at);
        let view = AvoidanceInput { edges: &edges, ..view(Vec2::ZERO, Vec2::X, 1.5, &[]) };
        let model = Moussaid2009 { range_obstacles: 1.0, ..Moussaid2009::default() };
        let pushes = model.explain(&view, &mut Workspace::default());
        prop_assert_eq!(pushes.len(), 1, "{:?}", pushes);
        let AvoidanceReason::Push(Cause::Edge(_), push) = pushes[0] else { panic!("{pushes:?}") };
        let off = at - nearest;
        let expected = off / off.length() * 3.0 * (-off.length()).exp();
        prop_assert!(push.as_dvec2().distance(expected) < 1e-3, "{push} instead of {expected}");
    }
}

/// The result of a meeting of two agents.
struct Meeting {
    /// Whether both agents arrived within a minute.
    passed: bool,
    /// Position of the first agent at each full second.
    path: Vec<DVec2>,
    /// Least distance of the centres, metres.
    least: f64,
}

/// Two agents that meet head-on, each `aside` metres to the right of the line between them, with their models only.
fn meeting(model: Arc<dyn LocalModel>, step: f64, aside: f64) -> Result<Meeting, Error> {
    let mut world = World::new(Settings { step, ..Settings::default() })?;
    let plain = Group { look_ahead: false, keep_right: 0.0, resolve: false, ..Group::default() };
    let group = world.add_group(Group { model, neighbour_distance: 10.0, ..plain })?;
    for side in [-1.0, 1.0] {
        let goal = world.add_goal(Goal::Point { at: DVec2::new(9.0 * side, aside * side), tolerance: 0.2 })?;
        let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false })?;
        let position = DVec2::new(-9.0 * side, aside * side);
        world.add_agent(Agent {
            position: position.extend(0.0),
            group,
            journey,
            preferred_speed: 1.3,
            radius: 0.17,
            ..Agent::default()
        })?;
    }
    let (mut path, mut next, mut least) = (Vec::new(), 1.0, f64::INFINITY);
    while !world.finished() && world.time() < 60.0 {
        world.step();
        let [a, b] = [0, 1].map(|row| world.relative_columns().position[row].as_dvec2());
        least = least.min(a.distance(b));
        if world.time() + 1e-6 >= next {
            path.push(a);
            next += 1.0;
        }
    }
    Ok(Meeting { passed: world.finished(), path, least })
}

#[test]
fn two_exactly_head_on_pass() -> Result<(), Error> {
    for model in models() {
        for step in [0.02, 0.05, 0.1] {
            let Meeting { passed, path, .. } = meeting(model.clone(), step, 0.0)?;
            assert!(passed, "{model:?} with {step} s: {:?}", path.last());
        }
    }
    Ok(())
}

#[test]
fn the_step_shows_little() -> Result<(), Error> {
    for model in models() {
        let [coarse, fine] = [0.05, 0.025].map(|step| meeting(model.clone(), step, 0.1));
        let (coarse, fine) = (coarse?.path, fine?.path);
        let apart = coarse.iter().zip(&fine).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(coarse.len() >= 6 && apart < 0.25, "{model:?}: {apart} m apart, {coarse:?} {fine:?}");
    }
    Ok(())
}

/// The distance at which two agents pass after meeting exactly head-on, compared with other programs: JuPedSim 1.4.2
/// has 0.60 m with its collision-free speed model and 1.45 m with its anticipation velocity model.
#[test]
fn agents_pass_as_far_apart_as_in_jupedsim() -> Result<(), Error> {
    let [free_speed, anticipation, ..] = models();
    for (model, expected) in [(free_speed, 0.60), (anticipation, 1.45)] {
        let least = meeting(model.clone(), 0.04, 0.0)?.least;
        assert!((least - expected).abs() < 0.1, "{model:?}: {least} m instead of {expected}");
    }
    Ok(())
}

/// A share of one half gives the papers' models; with other shares one agent avoids more and the other less.
#[test]
fn the_share_of_the_avoiding_counts() {
    for model in models() {
        let aside = |share: f32| {
            let near = [other(Vec2::new(1.0, 0.2), Vec2::new(-0.5, 0.0), 0.4, share)];
            choose(&*model, Vec2::X * 0.8, Vec2::X, &near).distance(choose(&*model, Vec2::X * 0.8, Vec2::X, &[]))
        };
        assert!(aside(0.9) > aside(0.5) && aside(0.5) > aside(0.1), "{model:?}");
    }
}
