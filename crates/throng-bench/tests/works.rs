//! Tests that the works match their descriptions.

use glam::DVec2;
use throng::World;
use throng_bench::{WORKS, Work, lap, median, work};

fn places(work: &Work, count: usize) -> Vec<DVec2> {
    work.crowd(count).unwrap().people.iter().map(|person| person.position).collect()
}

/// Returns the least distance of two points, over all pairs.
fn least_distance(places: &[DVec2]) -> f64 {
    let from = |k: usize| places[..k].iter().map(move |p| p.distance(places[k]));
    (0..places.len()).flat_map(from).fold(f64::INFINITY, f64::min)
}

#[test]
fn no_two_agents_overlap_at_the_start_except_in_one_spot() {
    for work in WORKS {
        for count in [1, 2, 700] {
            let Some(crowd) = work.crowd(count) else { continue };
            assert_eq!(crowd.people.len(), count, "{}", work.name);
            let least = least_distance(&places(work, count));
            let apart = least >= 2.0 * crowd.radius * 0.999;
            assert_eq!(apart, work.name != "one-spot" || count == 1, "{}: {least}", work.name);
        }
    }
}

#[test]
fn crowds_have_the_density_of_their_name() {
    for work in WORKS {
        let Some(density) = work.name.strip_prefix("density-") else { continue };
        let density: f64 = density.parse().unwrap();
        let all = places(work, 10_000);
        // in a square in the middle, with a quarter of the area
        let half = 0.25 * (10_000.0 / density).sqrt();
        let inside = all.iter().filter(|p| p.abs().max_element() < half).count() as f64;
        let found = inside / (4.0 * half * half);
        assert!((found / density - 1.0).abs() < 0.06, "{}: {found}", work.name);
    }
    // uniformly random: the counts in squares of 10 m vary like a Poisson distribution, a little less since bodies do
    // not overlap
    let all = places(work("crossing").unwrap(), 10_000);
    let mut counts = vec![0.0_f64; 400];
    for p in &all {
        let square = ((*p + 100.0) / 10.0).floor().clamp(DVec2::ZERO, DVec2::splat(19.0));
        counts[(square.y * 20.0 + square.x) as usize] += 1.0;
    }
    let variance = counts.iter().map(|n| (n - 25.0) * (n - 25.0)).sum::<f64>() / 400.0;
    assert!((8.0..25.0).contains(&variance), "{variance}");
}

#[test]
fn shuffled_are_the_same_places_in_another_order() {
    let key = |p: &DVec2| (p.x.to_bits(), p.y.to_bits());
    let [mut sorted, mut shuffled] = ["crossing", "crossing-shuffled"].map(|name| places(work(name).unwrap(), 5_000));
    let walk = |places: &[DVec2]| places.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>() / 4999.0;
    assert!(walk(&sorted) < 8.0 && walk(&shuffled) > 60.0);
    sorted.sort_by_key(key);
    shuffled.sort_by_key(key);
    assert_eq!(sorted, shuffled);
}

#[test]
fn agents_walk_or_stand_as_described() {
    for work in WORKS {
        for guard in [false, true] {
            let mut world = work.world(200, guard).unwrap();
            let lap = lap(&mut world, 30, || true);
            assert_eq!((lap.steps, lap.agent_steps), (30, 6_000));
            assert!(world.stranded().is_empty(), "{}: {:?}", work.name, world.stranded());
            let walked = (0..200).map(|row| world.relative_columns().trip(row).walked).sum::<f64>() / 200.0;
            match work.name {
                "at-rest" => assert!(walked < 0.01, "{walked}"),
                // in a crush, agents hardly move
                "one-spot" | "density-4" | "density-6" => assert!(walked > 0.0, "{}: {walked}", work.name),
                // half a second of noise of 0.6 m/s, starting at rest
                "swarm" | "swarm-alone" => assert!((0.1..0.4).contains(&walked), "{}: {walked}", work.name),
                _ => assert!(walked > 1.0, "{}: {walked}", work.name),
            }
        }
    }
}

#[test]
fn all_people_leave_the_building_through_doors() {
    let crowd = work("evacuation").unwrap().crowd(300).unwrap();
    let mut world = work("evacuation").unwrap().world(300, true).unwrap();
    let inside = |count: usize, seconds: f64, world: &World| {
        assert_eq!(world.counts().present, count, "after {seconds} s");
        assert!(world.stranded().is_empty(), "after {seconds} s");
    };
    // the first to leave walk from the door of the room beside an exit
    lap(&mut world, 30, || true);
    inside(300, 1.5, &world);
    lap(&mut world, 1_800 - 30, || true);
    inside(0, 90.0, &world);
    // every exit is used
    let mut exits: Vec<_> = crowd.people.iter().filter_map(|person| person.way).collect();
    exits.sort_unstable();
    exits.dedup();
    assert_eq!(exits.len(), crowd.goals.len());
}

#[test]
fn people_of_the_city_walk_in_the_streets_to_goals_two_blocks_away() {
    let crowd = work("city").unwrap().crowd(10_000).unwrap();
    let mut ways: Vec<_> = crowd.people.iter().filter_map(|person| person.way).collect();
    ways.dedup();
    assert_eq!((ways.len(), crowd.goals.len()), (10_000, 10_000));
    for person in &crowd.people {
        let goal = crowd.goals[crowd.ways[person.way.unwrap()][0]];
        for p in [person.position, goal] {
            assert!(crowd.walkable[0].contains(p) && !crowd.obstacles.iter().any(|block| block.covers(p)), "{p}");
        }
        let off = (goal - person.position).abs();
        assert!((144.0..=288.0).contains(&off.max_element()), "{off}");
    }
    let side = crowd.walkable[0].outer.iter().map(|corner| corner.x).fold(0.0, f64::max);
    let density = 10_000.0 / (side * side - 3_600.0 * crowd.obstacles.len() as f64);
    assert!((0.2..=0.25).contains(&density), "{density}");
}

#[test]
fn one_agent_in_ten_of_the_scene_of_a_flock_walks() {
    let world = work("flock-in-scene").unwrap().world(1_000, true).unwrap();
    let (walkers, birds): (Vec<_>, Vec<_>) = world.agents().partition(|agent| agent.position().z == 0.0);
    assert_eq!((walkers.len(), birds.len()), (100, 900));
    let group = walkers[0].group();
    assert!(walkers.iter().all(|agent| agent.group() == group) && birds.iter().all(|agent| agent.group() != group));
}

#[test]
fn a_lap_adds_up() {
    let mut world = work("crossing").unwrap().world(500, true).unwrap();
    let mut left = 7;
    let lap = lap(&mut world, 10, || {
        left -= 1;
        left > 0
    });
    assert_eq!((lap.steps, world.steps()), (6, 6));
    let stages = lap.stages.iter().sum::<std::time::Duration>();
    assert!(stages <= lap.wall && stages * 2 > lap.wall, "{lap:?}");
    assert!(lap.ns(lap.wall) > 0.0);
}

#[test]
fn medians() {
    assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
    assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
    assert!(median(vec![]).is_nan());
}
