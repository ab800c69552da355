//! Far from the origin, where positions are coarse: agents keep their speed, the guard holds, and results have the same bits
//! as elsewhere in any way of computing them.

use crate::world::common::{Draw, run_for, walker, with_settings, world};
use crate::world::oracle::assert_free;
use glam::DVec2;
use throng::agent::Rounding;
use throng::perceive::SimdLevel;
use throng::{Agent, Group, SubSteps, World};

/// Steps of positions there: 2 mm.
const FAR: DVec2 = DVec2::new(17_321.5, -18_907.25);
/// The greatest error of a position that is rounded to steps of 2 mm along each axis.
const ROUNDED: f64 = 1e-3 * std::f64::consts::SQRT_2;

#[test]
fn agents_keep_their_speed() {
    for speed in [0.01, 0.05, 0.3, 1.31] {
        for direction in [0.0, 0.7, 2.1, 4.4] {
            let way = |from: DVec2| {
                let mut world = world(1.0 / 75.0, DVec2::ZERO);
                let to = from + DVec2::from_angle(direction) * 100.0;
                let agent = walker(&mut world, from, to).speed(speed);
                let agent = world.add_agent(agent).unwrap();
                run_for(&mut world, 20.0, |_| ());
                world.position(agent).unwrap().truncate() - from
            };
            let (near, far) = (way(DVec2::new(3.5, 1.25)), way(FAR));
            assert!(near.length() > 19.0 * f64::from(speed));
            assert!(near.distance(far) <= ROUNDED + 1e-4, "{speed} m/s: {near} near, {far} far");
        }
    }
}

/// A crowd that crosses about a place.
fn crossing(center: DVec2, seed: u64, guard: bool) -> World {
    let mut world = with_settings(0.1, SubSteps::Auto, DVec2::ZERO);
    let group = world.add_group(Group { guard, ..Group::default() }).unwrap();
    let mut draw = Draw::new(seed);
    for k in 0..64 {
        let near = draw.point(DVec2::splat(-0.35), DVec2::splat(0.35));
        let at = (DVec2::new(f64::from(k % 8), f64::from(k / 8)) - 3.5) * 1.2 + near;
        let speed = draw.between(0.05, 1.5) as f32;
        world.add_agent(Agent::at(center + at).goal(center - 2.0 * at).radius(0.2).speed(speed).group(group)).unwrap();
    }
    world
}

fn bits(world: &World) -> Vec<[u32; 6]> {
    let agents = world.relative_columns();
    let row = |row: usize| {
        let (at, velocity, rounding) = (agents.position[row], agents.velocity[row], agents.rounding[row].rest());
        [at.x, at.y, velocity.x, velocity.y, rounding.x, rounding.y].map(f32::to_bits)
    };
    (0..agents.len()).map(row).collect()
}

#[test]
fn crowds_do_not_overlap_and_have_the_same_bits() {
    for seed in 0..8 {
        // in some, agents cross the coordinate from which rounding counts
        let center = if seed % 2 == 0 { FAR } else { DVec2::new(-4096.0, 4090.0) };
        let guard = seed < 6;
        let after = |level: SimdLevel| {
            let mut world = crossing(center, seed, guard);
            world.set_simd_level(level);
            run_for(&mut world, 6.0, |world| {
                if guard {
                    assert_free(world)
                }
            });
            world
        };
        let mut plain = after(SimdLevel::Plain);
        let agents = plain.relative_columns();
        assert!((0..agents.len()).any(|row| agents.rounding[row] != Rounding::NONE));
        for level in SimdLevel::ALL {
            assert!(bits(&after(level)) == bits(&plain), "{level:?}, seed {seed}");
        }
        let mut loaded = crossing(center, seed, guard);
        loaded.load(&plain.save()).unwrap();
        for _ in 0..20 {
            plain.step();
            loaded.step();
        }
        assert!(bits(&loaded) == bits(&plain), "saved, seed {seed}");
    }
}

/// Near the origin there is no rounding, and no memory for it.
#[test]
fn positions_near_the_origin_are_not_rounded() {
    let mut world = crossing(DVec2::new(4000.0, -4000.0), 9, true);
    run_for(&mut world, 3.0, |_| ());
    assert_eq!(world.relative_columns().rounding.uniform(), Some(Rounding::NONE));
}
