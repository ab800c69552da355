//! SIMD and scalar paths, with four, eight or sixteen lanes, on any number of threads: the same bits.

use crate::irregular::irregular;
use crate::world::common::{Draw, journey_to, with_settings};
use crate::world::determinism::{bits, with_threads};
use glam::DVec2;
use proptest::prelude::*;
use std::sync::Arc;
use throng::avoid::{Orca, Vo};
use throng::motion::Holonomic;
use throng::perceive::SimdLevel;
use throng::{Agent, Group, Obstacle, SubSteps, World};

/// The settings of a crowd.
#[derive(Clone, Debug)]
struct Kind {
    seed: u64,
    count: usize,
    /// Agents per square metre.
    density: f64,
    goals: usize,
    /// Whether agents have several sizes, speeds, priorities, accelerations and reaches.
    mixed: bool,
    /// Whether some agents do not move at all, and one group has another model.
    odd: bool,
    /// Whether some agents are long, turn slowly, follow a script or ignore some layers.
    irregular: bool,
    walls: bool,
    guard: bool,
    step: f64,
}

fn kind() -> impl Strategy<Value = Kind> {
    let density = prop_oneof![0.05f64..1.0, 1.0f64..5.0];
    let step = prop_oneof![Just(0.1), Just(0.25), 0.01f64..0.2];
    (
        (any::<u64>(), 1usize..300, density, 1usize..20, step),
        (any::<bool>(), prop::bool::weighted(0.3), any::<bool>(), prop::bool::weighted(0.3), any::<bool>()),
    )
        .prop_map(|((seed, count, density, goals, step), (mixed, odd, irregular, walls, guard))| Kind {
            seed,
            count,
            density,
            goals,
            mixed,
            odd,
            irregular,
            walls,
            guard,
            step,
        })
}

fn crowd(kind: &Kind) -> World {
    let mut draw = Draw::new(kind.seed);
    let mut world = with_settings(kind.step, SubSteps::Fixed(1), DVec2::ZERO);
    let half = DVec2::splat(0.5 * (kind.count as f64 / kind.density).sqrt());
    let journeys: Vec<_> =
        (0..kind.goals).map(|_| journey_to(&mut world, draw.point(-half * 2.0, half * 2.0))).collect();
    let orca = || Group { guard: kind.guard, model: Arc::new(Orca::default()), ..Group::default() };
    let mut groups = vec![world.add_group(orca()).unwrap()];
    if kind.mixed {
        groups.push(world.add_group(Group { neighbours: 5, neighbour_distance: 3.0, ..orca() }).unwrap());
    }
    if kind.odd {
        let vo = Group { model: Arc::new(Vo::default()), ..orca() };
        groups.push(world.add_group(vo).unwrap());
    }
    if kind.irregular {
        groups.push(world.add_group(Group { neighbours: 25, ..orca() }).unwrap());
    }
    if kind.walls {
        for _ in 0..3 {
            let at = draw.point(-half, half);
            world.add_obstacle(Obstacle::Circle { center: at, radius: 0.6 }).unwrap();
            let points = vec![at + DVec2::X, at + DVec2::new(2.0, 3.0)];
            world.add_obstacle(Obstacle::Wall { points }).unwrap();
        }
    }
    for _ in 0..kind.count {
        let mut agent = Agent {
            position: draw.point(-half, half).extend(0.0),
            journey: draw.one_of(&journeys),
            group: draw.one_of(&groups),
            radius: 0.15,
            preferred_speed: draw.between(1.0, 1.6) as f32,
            ..Agent::default()
        };
        if kind.mixed {
            agent.radius = draw.one_of(&[0.1, 0.2]);
            agent.priority = draw.one_of(&[0.0, 0.0, 0.5]);
            let max_acceleration = draw.one_of(&[f32::INFINITY, 2.0]);
            agent.motor = Holonomic { max_acceleration, ..Holonomic::default() }.into();
        }
        if kind.odd && draw.index(4) == 0 {
            (agent.preferred_speed, agent.journey) = (0.0, throng::JourneyId::STAY);
        }
        if kind.irregular {
            agent = irregular(&mut world, agent, &mut draw, 40);
        }
        // places in walls are refused: those agents are left out
        let _ = world.add_agent(agent);
    }
    world
}

fn after(kind: &Kind, instructions: SimdLevel) -> Vec<[u32; 6]> {
    let mut world = crowd(kind);
    world.set_simd_level(instructions);
    for _ in 0..25 {
        world.step();
    }
    bits(&world)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    #[test]
    fn all_instructions_give_the_same_bits(kind in kind()) {
        let plain = after(&kind, SimdLevel::Plain);
        for instructions in SimdLevel::ALL {
            prop_assert_eq!(&after(&kind, instructions), &plain, "{:?}", instructions);
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_bits_of_the_scalar_path() {
    for (seed, density, guard) in [(1, 0.25, false), (2, 1.0, true), (3, 4.0, true)] {
        let (mixed, step) = (seed == 2, 0.1);
        let kind = Kind {
            seed,
            count: 1500,
            density,
            goals: 12,
            mixed,
            odd: false,
            irregular: seed == 3,
            walls: false,
            guard,
            step,
        };
        let plain = with_threads(1, || after(&kind, SimdLevel::Plain));
        for threads in [1, 2, 3, 7] {
            let many = with_threads(threads, || after(&kind, SimdLevel::Best));
            assert!(many == plain, "{threads} threads, {kind:?}");
        }
    }
}

/// While a few agents agree on a right of way, the rest of the crowd uses SIMD.
#[test]
fn standoffs_give_the_same_bits_too() {
    let run = |instructions: SimdLevel| {
        let mut world = with_settings(0.1, SubSteps::Fixed(2), DVec2::ZERO);
        world.set_simd_level(instructions);
        for side in [-1.0, 1.0] {
            let points = [(-2.0, 12.0), (-2.0, 0.2), (2.0, 0.2), (2.0, 12.0)].map(|(x, y)| DVec2::new(x, y * side));
            world.add_obstacle(Obstacle::Wall { points: points.to_vec() }).unwrap();
        }
        let mut draw = Draw::new(5);
        for k in 0..60 {
            let side = if k % 2 == 0 { 1.0 } else { -1.0 };
            let at = DVec2::new(side * draw.between(2.5, 9.0), draw.between(-5.0, 5.0));
            let _ = world.add_agent(Agent::at(at).goal(DVec2::new(-side * 8.0, draw.between(-4.0, 4.0))).radius(0.14));
        }
        for _ in 0..400 {
            world.step();
        }
        (bits(&world), world.summary().standoffs)
    };
    let plain = run(SimdLevel::Plain);
    assert!(plain.1 > 3, "{} standoffs", plain.1);
    for instructions in SimdLevel::ALL {
        assert!(run(instructions) == plain, "{instructions:?}");
    }
}
