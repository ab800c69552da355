//! Worlds that are built in parts, worlds that go on from saved states, and worlds with equal loads.

use crate::crowds::kind;
use crate::threads::{self, Threads};
use crate::{Part, compare_with};
use glam::{DVec2, Vec2, Vec3};
use proptest::prelude::*;
use std::thread;
use throng::halo::{Cuts, DividedWorld};
use throng::motion::WrapAround;
use throng::{Agent, AgentId, Error, Group, Obstacle, Settings, World};

/// Makes steps in all worlds of a division, then returns their states.
fn saved(world: &World, cuts: &Cuts, steps: u64) -> Vec<Vec<u8>> {
    let run = |halo: Threads| {
        let mut part = DividedWorld::new(world.clone(), halo).unwrap();
        (0..steps).for_each(|_| part.step());
        part.world().save()
    };
    thread::scope(|scope| {
        let handles: Vec<_> =
            threads::halos(cuts.clone()).into_iter().map(|halo| scope.spawn(move || run(halo))).collect();
        handles.into_iter().map(|handle| handle.join().unwrap()).collect()
    })
}

/// Goes on from saved states in worlds with these cuts.
fn resumed(
    world: &World,
    states: &[Vec<u8>],
    index: usize,
    halo: Threads,
    worlds: usize,
) -> Result<DividedWorld<Threads>, Error> {
    DividedWorld::resume(world.clone(), &states[0], states.iter().skip(index).step_by(worlds), halo)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    #[test]
    fn a_run_goes_on_in_another_number_of_worlds(
        kind in kind(), before in 1usize..7, after in 1usize..7, seed: u64, steps in 0u64..15,
    ) {
        let world = kind.crowd();
        let states = saved(&world, &kind.cuts(seed, before), steps);
        let mut whole = world.clone();
        (0..steps).for_each(|_| whole.step());
        let cuts = |_| kind.cuts(seed ^ 1, after);
        let work = compare_with(whole, cuts, 20, |_, _| (), |index, halo| resumed(&world, &states, index, halo, after));
        prop_assert!(work.is_ok(), "{:?}, {:?}", work, kind);
    }

    #[test]
    fn worlds_may_be_built_with_any_part_of_the_agents(kind in kind(), worlds in 1usize..7, seed: u64) {
        let world = kind.crowd();
        let part = |index: usize, halo: Threads| {
            let mut part = world.clone();
            let others = |id: &AgentId| part.agent(*id).is_none_or(|agent| agent.number() as usize % worlds != index);
            let others: Vec<AgentId> = part.agent_ids().into_iter().filter(others).collect();
            others.into_iter().for_each(|id| assert!(part.remove_agent(id)));
            DividedWorld::from_part(part, halo)
        };
        let work = compare_with(world.clone(), |_| kind.cuts(seed, worlds), 20, |_, _| (), part);
        prop_assert!(work.is_ok(), "{:?}, {:?}", work, kind);
    }
}

#[test]
fn a_state_of_another_step_is_refused() {
    let mut world = World::new(Settings::default()).unwrap();
    world.add_agent(Agent::at([0.0, 0.0]).goal([9.0, 0.0])).unwrap();
    let early = saved(&world, &Cuts::default(), 1);
    let late = saved(&world, &Cuts::default(), 2);
    let halo = || threads::halos(Cuts::default()).remove(0);
    let error = DividedWorld::resume(world.clone(), &early[0], &late, halo()).err().unwrap();
    assert!(error.to_string().contains("after 2 steps, the other parts after 1"), "{error}");
    let error = DividedWorld::resume(world, &early[0], [[7u8]], halo()).err().unwrap();
    assert!(matches!(error, Error::Snapshot { .. }), "{error}");
}

/// Cuts by measured cost give a slow world fewer agents, and the bits stay the same.
#[test]
fn cuts_follow_the_cost() {
    let mut world = World::new(Settings::default()).unwrap();
    for k in 0..400 {
        let place = [f64::from(k % 20), f64::from(k / 20)];
        world.add_agent(Agent::at(place).goal([place[0] + 9.0, place[1]])).unwrap();
    }
    let first = Cuts::cut(0, 2.5, Cuts::default(), Cuts::default());
    let balance = |step: u64, part: Part<'_>| {
        if let Part::Divided(part) = part
            && step == 3
        {
            // agents of the first world cost as much as three of the other
            let agents = part.world().relative_columns().number.len() as f64;
            let cost = if part.world().relative_columns().position[0].x < 2.5 { 3e-3 } else { 1e-3 };
            let cuts = part.balanced(cost * agents);
            let below =
                part.world().relative_columns().position.iter().filter(|place| cuts.owner(**place) == 0).count();
            let sums = part.balanced(0.0);
            assert_eq!((cuts.worlds(), sums.worlds()), (2, 2));
            // 60 agents cost 180, the other 340 as much as they are: half of 520 is 180 and 80
            let half = cuts.owner(Vec2::new(5.0, 5.0)) == 0 && cuts.owner(Vec2::new(8.0, 5.0)) == 1;
            assert!(half && below > 0, "{cuts:?}");
            let even = sums.owner(Vec2::new(8.5, 5.0)) == 0 && sums.owner(Vec2::new(10.5, 5.0)) == 1;
            assert!(even, "{sums:?}");
        }
    };
    let begin = |_, halo| DividedWorld::new(world.clone(), halo);
    compare_with(world.clone(), |_| first.clone(), 6, balance, begin).unwrap();
}

/// Builds three worlds in parts; `change` changes one before the worlds join. Returns why they are refused.
fn refusals(change: impl Fn(usize, &mut World) + Sync) -> Vec<String> {
    let cuts = Cuts::cut(0, 0.0, Cuts::default(), Cuts::cut(1, 0.0, Cuts::default(), Cuts::default()));
    let join = |index: usize, halo: Threads| {
        let mut world = World::new(Settings::default()).unwrap();
        let wrap_around = Some(WrapAround { center: Vec3::ZERO, radius: 90.0 });
        world.add_group(Group { wrap_around, name: "odd".into(), ..Group::default() }).unwrap();
        change(index, &mut world);
        DividedWorld::from_part(world, halo).err().map(|error| error.to_string())
    };
    thread::scope(|scope| {
        let spawn = |(index, halo)| {
            let join = &join;
            scope.spawn(move || join(index, halo))
        };
        let handles: Vec<_> = threads::halos(cuts).into_iter().enumerate().map(spawn).collect();
        handles.into_iter().filter_map(|handle| handle.join().unwrap()).collect()
    })
}

#[test]
fn parts_that_differ_in_their_places_are_refused() {
    let circle = |index, world: &mut World| {
        if index != 1 {
            world.add_obstacle(Obstacle::Circle { center: DVec2::ONE, radius: 1.0 }).unwrap();
        }
    };
    let why = refusals(circle);
    assert!(why.len() == 3 && why.iter().all(|why| why.contains("build all of them in the same way")), "{why:?}");
}

#[test]
fn a_part_that_cannot_be_divided_is_refused_by_all_worlds() {
    let odd = |index, world: &mut World| {
        if index == 2 {
            let group = world.group_named("odd").unwrap();
            world.add_agent(Agent { number: Some(7), group, ..Agent::at([45.0, 9.0]) }).unwrap();
        }
    };
    let why = refusals(odd);
    assert!(why.len() == 3 && why[2].contains("group `odd`") && why[0].contains("another world"), "{why:?}");
}
