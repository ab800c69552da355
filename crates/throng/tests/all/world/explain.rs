//! An explanation describes the next sub-step, and changes nothing.

use crate::world::common::{Draw, with_settings};
use crate::world::scenes::{Kind, clutter, packed, populate};
use glam::{DVec2, Vec2};
use std::sync::Arc;
use throng::avoid::{
    AnticipationVelocity, Avo, AvoidanceReason, Cause, ClearPath, CollisionFreeSpeed, Hrvo, LocalModel, Moussaid2009,
    NoAvoidance, Orca, PowerLaw, Rvo, RvoLab, SocialForce, Vo,
};
use throng::{Agent, AgentId, Group, Settings, SubSteps, World};

fn agent_ids(world: &World) -> Vec<AgentId> {
    (0..world.relative_columns().len()).map(|row| world.id(row)).collect()
}

fn models() -> [Arc<dyn LocalModel>; 13] {
    [
        Arc::new(Orca::default()),
        Arc::new(Avo::default()),
        Arc::new(ClearPath::default()),
        Arc::new(RvoLab),
        Arc::new(CollisionFreeSpeed::default()),
        Arc::new(AnticipationVelocity::default()),
        Arc::new(SocialForce::default()),
        Arc::new(Moussaid2009::default()),
        Arc::new(PowerLaw::default()),
        Arc::new(Hrvo::default()),
        Arc::new(Rvo::default()),
        Arc::new(Vo::default()),
        Arc::new(NoAvoidance),
    ]
}

/// A room of walls and a crowd of all sizes, with this model.
fn room(seed: u64, model: Arc<dyn LocalModel>) -> World {
    let origin = DVec2::new(-1800.25, 950.5);
    let mut draw = Draw::new(seed);
    let mut world = with_settings(0.05, SubSteps::Fixed(1), origin);
    let group = world.add_group(Group { model, ..Group::default() }).unwrap();
    for obstacle in clutter(&mut draw, origin, 5.0, 3) {
        world.add_obstacle(obstacle).unwrap();
    }
    let area = (origin - DVec2::splat(3.5), origin + DVec2::splat(3.5));
    populate(&mut world, &mut draw, area, 30, &Kind { group, ..Kind::default() });
    world
}

/// Explains all agents every few steps, and checks that the next step gives the explained velocity.
fn comes_true(mut world: World, steps: u32) {
    for step in 0..steps {
        if step % 7 == 0 {
            let before = world.save();
            let ids = agent_ids(&world);
            let explained: Vec<_> = ids.iter().map(|&id| world.explain(id).unwrap()).collect();
            assert_eq!(world.save(), before, "nothing changes");
            world.step();
            for (id, why) in ids.into_iter().zip(explained) {
                // an agent that leaves by an exit has no velocity any more
                let Some(row) = world.row(id) else { continue };
                assert_eq!(why.number, world.relative_columns().number[row]);
                assert_eq!(why.guarded, world.relative_columns().velocity[row], "agent {} at {}", why.number, why.time);
            }
        } else {
            world.step();
        }
    }
}

#[test]
fn what_is_explained_comes_true() {
    for (seed, model) in (1..).zip(models()) {
        comes_true(room(seed, model), 60);
    }
    // the guard has work
    comes_true(packed(0), 8);
}

#[test]
fn a_world_that_was_asked_goes_on_with_the_same_bits() {
    let [mut asked, mut left_alone] = [0, 1].map(|_| room(9, Arc::new(Orca::default())));
    for _ in 0..40 {
        for id in agent_ids(&asked).into_iter().take(3) {
            asked.explain(id).unwrap();
        }
        asked.step();
        left_alone.step();
        assert_eq!(asked.state_hash(), left_alone.state_hash());
    }
}

#[test]
fn the_chosen_velocity_keeps_what_the_reasons_ask_where_it_can_be_kept() {
    let mut world = room(4, Arc::new(Orca::default()));
    let (mut held, mut kept) = (0, 0);
    for _ in 0..40 {
        world.step();
        for why in agent_ids(&world).into_iter().map(|id| world.explain(id).unwrap()) {
            assert_eq!(why.reasons.iter().filter(|r| of_neighbour(r)).count(), why.neighbours.len());
            if why.held_by(why.chosen).iter().all(|(_, depth)| *depth == 0.0) {
                kept += 1;
                held += usize::from(why.chosen.distance(why.relaxed) > 0.01);
                let touched = !why.held_by(why.chosen).is_empty();
                assert!(touched || why.chosen.distance(why.relaxed.clamp_length_max(why.max_speed)) < 1e-4);
            }
        }
    }
    assert!(kept > 500 && held > 50, "{kept} kept, {held} held");
}

fn of_neighbour(reason: &AvoidanceReason) -> bool {
    matches!(
        reason,
        AvoidanceReason::Permits(Cause::Neighbour(_), _) | AvoidanceReason::Forbids(Cause::Neighbour(_), _)
    )
}

#[test]
fn removed_agents_are_not_explained() {
    let mut world = World::new(Settings::default()).unwrap();
    let id = world.add_agent(Agent { velocity: Vec2::X, ..Agent::default() }).unwrap();
    let why = world.explain(id).unwrap();
    assert_eq!((why.velocity, why.preferred, why.chosen), (Vec2::X, Vec2::ZERO, Vec2::ZERO));
    assert!(why.limited.x > 0.0 && why.limited.x < 1.0, "braking takes time");
    assert_eq!((why.collision(Vec2::X), why.held_by(Vec2::X)), (None, vec![]));
    world.remove_agent(id);
    assert_eq!(world.explain(id), None);
}
