//! Rows are sorted for faster memory access: only speed depends on it.

use crate::world::common::{Draw, journey_to};
use crate::world::determinism::{bits, history};
use crate::world::scenes::{busy, packed};
use glam::DVec2;
use throng::{Agent, AgentId, Settings, SubSteps, World};

/// The numbers in the order of rows.
fn numbers(world: &World) -> Vec<u32> {
    world.relative_columns().number.clone()
}

#[test]
fn rows_in_any_order_give_the_same_bits() {
    for build in [busy, packed] {
        let plain = history(build(0));
        let (mut world, mut moved) = (build(0), 0);
        for step in 1..=240 {
            let before = numbers(&world);
            world.sort_rows();
            moved += usize::from(numbers(&world) != before);
            world.step();
            if step % 10 == 0 {
                assert_eq!((world.state_hash(), bits(&world)), plain[step / 10 - 1], "after {step} steps");
            }
        }
        assert!(moved > 100, "rows moved in {moved} steps");
    }
}

/// Agents that cross a square in all directions, added in a shuffled order, with their numbers.
fn crossing(count: u32, order: u64) -> (World, Vec<(u32, AgentId)>) {
    let settings = Settings { step: 0.1, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
    let (mut world, mut draw) = (World::new(settings).unwrap(), Draw::new(5));
    let side = f64::from(count).sqrt().ceil();
    let mut agents: Vec<Agent> = (0..count)
        .map(|number| {
            let place = DVec2::new(f64::from(number) % side, (f64::from(number) / side).floor());
            let position = place * 2.0 + draw.point(DVec2::ZERO, DVec2::ONE);
            let journey = journey_to(&mut world, draw.point(DVec2::ZERO, DVec2::splat(2.0 * side)));
            Agent { position: position.extend(0.0), journey, number: Some(number), ..Agent::default() }
        })
        .collect();
    Draw::new(order).shuffle(&mut agents);
    let ids = agents.into_iter().map(|agent| (agent.number.unwrap(), world.add_agent(agent).unwrap())).collect();
    (world, ids)
}

/// Mean distance along the ground between rows that are eight apart.
fn apart(world: &World) -> f32 {
    let position = &world.relative_columns().position;
    let sum: f32 = position.iter().zip(&position[8..]).map(|(a, b)| a.distance(*b)).sum();
    sum / position.len() as f32
}

#[test]
fn a_large_crowd_comes_into_order_by_itself_and_ids_stay() {
    let ((mut one, ids), (mut two, _)) = (crossing(3000, 1), crossing(3000, 2));
    assert!(apart(&one) > 30.0 && apart(&two) > 30.0, "shuffled");
    for step in 0..50 {
        one.step();
        two.step();
        assert!(apart(&one) < 15.0 && apart(&two) < 15.0, "{} and {} m after {step} steps", apart(&one), apart(&two));
        assert_eq!(one.state_hash(), two.state_hash(), "after {step} steps");
    }
    assert_eq!(bits(&one), bits(&two));
    for (number, id) in ids {
        let row = one.row(id).expect("no agent was removed");
        assert_eq!((one.relative_columns().number[row], one.id(row)), (number, id));
    }
}

#[test]
fn a_world_saved_while_rows_move_goes_on_with_the_same_bits() {
    let (mut world, _) = crossing(3000, 1);
    (0..10).for_each(|_| world.step());
    let (mut loaded, _) = crossing(10, 1);
    loaded.load(&world.save()).unwrap();
    for _ in 0..30 {
        world.step();
        loaded.step();
    }
    assert_eq!((loaded.save(), loaded.state_hash()), (world.save(), world.state_hash()));
}
