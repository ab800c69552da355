//! Areas are filled from the back and hold the agents that have arrived: in random corridors and rooms, at random
//! angles.

use crate::world::common::{Draw, journey_into, run, run_for, with_settings};
use crate::world::oracle::assert_free;
use glam::DVec2;
use throng::{Agent, Goal, Hindrance, JourneyId, Status, SubSteps, Walkable, World};

/// Rotates and moves the plans of scenes.
#[derive(Clone, Copy)]
struct Pose {
    angle: f64,
    shift: DVec2,
}

impl Pose {
    fn drawn(draw: &mut Draw) -> Self {
        let low = DVec2::splat(-50.0);
        Self { angle: draw.between(0.0, std::f64::consts::TAU), shift: draw.point(low, -low) }
    }

    fn point(self, p: DVec2) -> DVec2 {
        DVec2::from_angle(self.angle).rotate(p) + self.shift
    }

    fn all(self, corners: &[(f64, f64)]) -> Vec<DVec2> {
        corners.iter().map(|&p| self.point(p.into())).collect()
    }
}

fn rectangle(low: (f64, f64), high: (f64, f64)) -> [(f64, f64); 4] {
    [low, (high.0, low.1), high, (low.0, high.1)]
}

/// Whether a point is inside a convex polygon, counter-clockwise.
fn is_in(corners: &[DVec2], p: DVec2) -> bool {
    corners.iter().zip(corners.iter().cycle().skip(1)).all(|(&a, &b)| (b - a).perp_dot(p - a) >= 0.0)
}

/// Number of agents of a journey inside a polygon.
fn inside(world: &World, journey: JourneyId, area: &[DVec2]) -> usize {
    let agents = world.relative_columns();
    let mine = (0..agents.len()).filter(|&row| agents.journey[row] == journey);
    mine.filter(|&row| is_in(area, world.position(world.id(row)).unwrap().truncate())).count()
}

/// Puts this number of agents at random in a rectangle of the plan.
fn fill(world: &mut World, pose: Pose, draw: &mut Draw, (low, high): (DVec2, DVec2), count: usize, agent: &Agent) {
    let mut placed = 0;
    for _ in 0..200_000 {
        if placed == count {
            break;
        }
        let position = pose.point(draw.point(low, high));
        if world.is_free(position.extend(0.0), agent.radius * 1.02) {
            world.add_agent(Agent { position: position.extend(0.0), ..agent.clone() }).unwrap();
            placed += 1;
        }
    }
    assert_eq!(placed, count, "the test has room for them");
}

/// Upper bound of the number of discs with centres in a rectangle that do not overlap (Groemer's inequality, 1960).
fn most_discs(size: DVec2, radius: f64) -> f64 {
    let apart = 2.0 * radius;
    2.0 / 3f64.sqrt() * size.x * size.y / (apart * apart) + (size.x + size.y) / apart + 1.0
}

struct Corridor {
    world: World,
    area: Vec<DVec2>,
    journey: JourneyId,
    count: usize,
    label: String,
}

/// A corridor with a goal area at its end, and agents for a part of what the densest packing has room for.
fn corridor(seed: u64, part: (f64, f64)) -> Corridor {
    let mut draw = Draw::new(seed);
    let pose = Pose::drawn(&mut draw);
    let part = draw.between(part.0, part.1);
    let (width, depth) = (draw.between(1.2, 4.0), draw.between(3.0, 9.0));
    let radius = draw.between(0.15, 0.25);
    let densest = most_discs(DVec2::new(width - 2.0 * radius, depth - radius), radius);
    let count = (part * densest).max(2.0) as usize;
    let room = 16.0 * count as f64 * radius * radius / (width - 2.0 * radius) + 2.0;
    let (low, high) = (room + 3.0, room + 3.0 + depth);
    let mut world = with_settings(0.05, SubSteps::Auto, pose.shift);
    let outer = pose.all(&rectangle((-1.0, -0.5 * width), (high, 0.5 * width)));
    world.set_walkable(vec![Walkable { outer, holes: vec![] }]).unwrap();
    let area = pose.all(&rectangle((low, -0.5 * width), (high, 0.5 * width)));
    let journey = journey_into(&mut world, Goal::Area { corners: area.clone() });
    let preferred_speed = draw.between(1.1, 1.5) as f32;
    let agent = Agent { radius: radius as f32, journey, preferred_speed, ..Agent::default() };
    let side = 0.5 * width - 1.05 * radius;
    fill(&mut world, pose, &mut draw, (DVec2::new(-0.7, -side), DVec2::new(room, side)), count, &agent);
    let label = format!("seed {seed}: {count} agents of radius {radius:.3} in {width:.2} m x {depth:.2} m");
    Corridor { world, area, journey, count, label }
}

/// Returns the failures in corridors with areas that have room for all agents.
fn failures(seeds: std::ops::Range<u64>) -> Vec<String> {
    let mut failed = Vec::new();
    for seed in seeds {
        let Corridor { mut world, area, journey, count, label } = corridor(seed, (0.1, 0.45));
        run(&mut world, 200.0, |_| {});
        let (first, time) = (world.summary(), world.time());
        run_for(&mut world, 30.0, |_| {});
        assert_free(&world);
        let (last, inside) = (world.summary(), inside(&world, journey, &area));
        if first.arrived < count || last.arrived < count || inside < count || last.resting < count {
            let counts = (first.arrived, last.arrived, inside, last.resting);
            failed.push(format!(
                "{label}: {counts:?} arrived, later, inside, at rest; {:?} at {time:.0} s",
                last.hindered
            ));
            let agents = world.relative_columns();
            for row in (0..count).filter(|&row| agents.speed(row) >= 0.05) {
                let standing = agents.travel[row].standing();
                let off = standing.map(|s| s.at.distance(world.position(world.id(row)).unwrap().truncate()));
                failed.push(format!(
                    "  {row}: {:?} at {:.2} m/s, {off:?} off {standing:?}",
                    agents.status[row],
                    agents.speed(row)
                ));
            }
        }
        if last.without_progress_30s > 0 {
            failed.push(format!("{label}: {} walked without getting on", last.without_progress_30s));
        }
    }
    failed
}

#[test]
fn an_area_at_the_end_of_a_corridor_is_filled() {
    let failed = failures(1..13);
    assert!(failed.is_empty(), "{} failures\n{}", failed.len(), failed.join("\n"));
}

#[test]
#[ignore = "takes minutes"]
fn areas_at_the_ends_of_many_corridors_are_filled() {
    let failed = failures(13..213);
    assert!(failed.is_empty(), "{} failures\n{}", failed.len(), failed.join("\n"));
}

#[test]
fn agents_that_do_not_fit_wait_outside_and_are_reported() {
    for seed in 500..506 {
        let Corridor { mut world, area, journey, count, label } = corridor(seed, (1.5, 1.5));
        if count > 150 {
            continue;
        }
        run(&mut world, 150.0, |_| {});
        let summary = world.summary();
        assert!(!world.finished(), "{label}: agents wait");
        assert_eq!(summary.arrived, inside(&world, journey, &area), "{label}");
        let share = 1.5 * summary.arrived as f64 / count as f64;
        assert!((0.5..=1.0).contains(&share), "{label}: {share} of the densest packing are in the area, {summary:?}");
        assert_eq!(summary.hindered.waiting_for_room, count - summary.arrived, "{label}: {summary:?}");
        assert_eq!((summary.stuck, summary.without_progress_30s), (0, 0), "{label}: {summary:?}");
        assert!(summary.resting as f64 > 0.95 * count as f64, "{label}: they wait calmly, {summary:?}");
        let agents = world.relative_columns();
        for row in (0..count).filter(|&row| agents.status[row] != Status::Arrived) {
            assert_eq!(world.hindrance(row), Hindrance::WaitingForRoom);
        }
    }
}

/// Agents leave a room by its only door while others enter: the entering agents stay in their area.
#[test]
fn agents_that_board_a_bus_stay_on_it() {
    let mut failed = Vec::new();
    for seed in 0..6 {
        let mut draw = Draw::new(77 + seed);
        let pose = Pose::drawn(&mut draw);
        let (length, door, count) = (draw.between(3.5, 6.0), draw.between(0.45, 0.8), 8 + draw.index(8));
        let mut world = with_settings(0.05, SubSteps::Auto, pose.shift);
        let outer = pose.all(&[
            (-6.0, -4.0),
            (6.0, -4.0),
            (6.0, -0.1),
            (door, -0.1),
            (door, 0.1),
            (length, 0.1),
            (length, 2.4),
            (-length, 2.4),
            (-length, 0.1),
            (-door, 0.1),
            (-door, -0.1),
            (-6.0, -0.1),
        ]);
        world.set_walkable(vec![Walkable { outer, holes: vec![] }]).unwrap();
        let area = pose.all(&rectangle((-length, 0.1), (length, 2.4)));
        let off = Goal::Exit { corners: pose.all(&rectangle((-6.0, -4.0), (6.0, -3.0))) };
        let off = journey_into(&mut world, off);
        let on = journey_into(&mut world, Goal::Area { corners: area.clone() });
        for (journey, low, high) in [
            (off, DVec2::new(-length + 0.3, 0.4), DVec2::new(length - 0.3, 2.1)),
            (on, DVec2::new(-3.0, -2.5), DVec2::new(3.0, -0.4)),
        ] {
            fill(&mut world, pose, &mut draw, (low, high), count, &Agent { journey, ..Agent::default() });
        }
        run(&mut world, 200.0, |_| {});
        run_for(&mut world, 10.0, |_| {});
        let (summary, inside) = (world.summary(), inside(&world, on, &area));
        if summary.arrived < 2 * count || inside < count {
            failed.push(format!("seed {seed}, door {door:.2}, {count} each way: {inside} inside, {summary:?}"));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
