//! Save, load, continue: the same run, whatever is in progress at that time.

use crate::world::common::{Draw, run_for, walker, world};
use crate::world::determinism::bits;
use crate::world::scenes::busy;
use glam::DVec2;
use throng::{Error, Obstacle, World};

#[test]
fn a_loaded_world_continues_with_the_same_bits() {
    let mut draw = Draw::new(99);
    let mut original = busy(0);
    for round in 0..4 {
        for _ in 0..10 + draw.index(60) {
            original.step();
        }
        let mut loaded = busy(7);
        loaded.load(&original.save()).unwrap();
        assert_eq!(loaded.save(), original.save(), "round {round}");
        for step in 0..60 {
            original.step();
            loaded.step();
            assert_eq!(loaded.state_hash(), original.state_hash(), "round {round}, {step} steps after loading");
            assert_eq!(bits(&loaded), bits(&original), "round {round}, {step} steps after loading");
        }
        assert_eq!(loaded.summary(), original.summary(), "round {round}");
    }
}

/// Data that are rebuilt after loading (walls, paths, meshes) must not depend on when they were first built.
#[test]
fn ways_round_walls_survive_loading() {
    let build = || {
        let mut world = world(0.05, DVec2::new(-900.0, 4000.0));
        let origin = world.settings().origin;
        let points = [(6.0, -4.0), (6.0, 4.0), (-2.0, 4.0)].map(|p| origin + DVec2::from(p));
        world.add_obstacle(Obstacle::Wall { points: points.to_vec() }).unwrap();
        for k in 0..6 {
            let from = origin + DVec2::new(-1.0, f64::from(k) - 3.0);
            let agent = walker(&mut world, from, origin + DVec2::new(11.0, 2.5 - f64::from(k)));
            world.add_agent(agent).unwrap();
        }
        world
    };
    let mut original = build();
    run_for(&mut original, 3.0, |_| {});
    let mut loaded = build();
    loaded.load(&original.save()).unwrap();
    for step in 0..600 {
        original.step();
        loaded.step();
        assert_eq!(bits(&loaded), bits(&original), "{step} steps after loading");
    }
    assert!(original.finished());
}

#[test]
fn saving_changes_nothing() {
    let (mut quiet, mut saved) = (busy(0), busy(0));
    for _ in 0..40 {
        quiet.step();
        saved.step();
        let _ = saved.save();
    }
    assert_eq!(quiet.state_hash(), saved.state_hash());
}

#[test]
fn ids_name_the_same_agents_after_loading() {
    let mut original = busy(0);
    for row in [3, 8, 40] {
        original.remove_agent(original.id(row));
    }
    let ids: Vec<_> = (0..original.relative_columns().len()).map(|row| original.id(row)).collect();
    let mut loaded = busy(0);
    loaded.load(&original.save()).unwrap();
    for id in ids {
        assert_eq!(loaded.position(id), original.position(id));
    }
}

#[test]
fn a_part_of_a_saved_state_is_refused_and_changes_nothing() {
    let mut world = small();
    let saved = world.save();
    world.step();
    let now = world.save();
    for length in 0..saved.len() {
        let refused = world.load(&saved[..length]);
        assert!(matches!(refused, Err(Error::Snapshot { .. })), "the first {length} bytes: {refused:?}");
    }
    assert_eq!(world.save(), now);
}

#[test]
fn a_damaged_state_is_refused_and_changes_nothing() {
    let mut world = small();
    let saved = world.save();
    world.step();
    let now = world.save();
    for place in 0..saved.len() {
        for flipped in [1, 0x80, 0xff] {
            let mut damaged = saved.clone();
            damaged[place] ^= flipped;
            let refused = world.load(&damaged);
            assert!(matches!(refused, Err(Error::Snapshot { .. })), "byte {place}: {refused:?}");
        }
    }
    let mut longer = saved.clone();
    longer.push(0);
    assert!(matches!(world.load(&longer), Err(Error::Snapshot { .. })));
    assert_eq!(world.save(), now);
    world.load(&saved).unwrap();
}

#[test]
fn other_groups_are_refused_by_name() {
    let mut plain = small();
    let error = plain.load(&busy(0).save()).unwrap_err().to_string();
    assert!(error.contains("far-sighted"), "{error}");
}

fn small() -> World {
    let mut world = world(0.05, DVec2::ZERO);
    for k in 0..3 {
        let at = DVec2::new(f64::from(k), 0.0);
        let agent = walker(&mut world, at, DVec2::new(5.0, -at.x));
        world.add_agent(agent).unwrap();
    }
    world.add_obstacle(Obstacle::Circle { center: DVec2::new(2.0, 2.0), radius: 0.5 }).unwrap();
    world.step();
    world
}
