//! Choice among goals: agents choose the goal that they reach soonest.

use crate::world::common::{Draw, journey_into, rectangle, run, with_settings};
use glam::DVec2;
use throng::{Agent, AgentId, Goal, Group, SubSteps, Walkable, World};

const MIDDLE: DVec2 = DVec2::new(-310.0, 94.0);
const ANGLE: f64 = 0.4;

/// Converts from the room's frame to the world's.
fn at(x: f64, y: f64) -> DVec2 {
    MIDDLE + DVec2::from_angle(ANGLE).rotate(DVec2::new(x, y))
}

/// A room of 20 m by 10 m with exits of two widths in the middles of its short sides, and agents anywhere in it, each
/// on its way to the nearer exit.
fn room(widths: [f64; 2], count: usize, look_ahead: bool) -> (World, Vec<AgentId>) {
    room_at_speed(widths, count, look_ahead, Agent::default().preferred_speed)
}

fn room_at_speed(widths: [f64; 2], count: usize, look_ahead: bool, preferred_speed: f32) -> (World, Vec<AgentId>) {
    let mut world = with_settings(0.05, SubSteps::Auto, MIDDLE);
    let [west, east] = widths.map(|width| width / 2.0);
    let outer = [
        [-10.0, -5.0],
        [10.0, -5.0],
        [10.0, -east],
        [12.0, -east],
        [12.0, east],
        [10.0, east],
        [10.0, 5.0],
        [-10.0, 5.0],
        [-10.0, west],
        [-12.0, west],
        [-12.0, -west],
        [-10.0, -west],
    ];
    let outer = outer.map(|[x, y]| at(x, y)).to_vec();
    world.set_walkable(vec![Walkable { outer, holes: vec![] }]).unwrap();
    let exit = |x: f64, width: f64| Goal::Exit { corners: rectangle(at(x, 0.0), DVec2::new(0.5, width), ANGLE) };
    let journeys = [(-11.75, widths[0]), (11.75, widths[1])].map(|(x, width)| journey_into(&mut world, exit(x, width)));
    world.add_choice(&journeys).unwrap();
    let group = world.add_group(Group { look_ahead, ..Group::default() }).unwrap();
    let mut draw = Draw::new(5);
    // places on a grid, two per metre, so that no two agents overlap
    let mut places: Vec<[f64; 2]> =
        (-18..=18).flat_map(|x| (-9..=9).map(move |y| [f64::from(x) / 2.0, f64::from(y) / 2.0])).collect();
    draw.shuffle(&mut places);
    let agents = places.into_iter().take(count).map(|[x, y]| {
        let journey = journeys[usize::from(x > 0.0)];
        world
            .add_agent(Agent { position: at(x, y).extend(0.0), group, journey, preferred_speed, ..Agent::default() })
            .unwrap()
    });
    let agents = agents.collect();
    (world, agents)
}

/// Runs until the room is empty. Returns the numbers of agents that left in the west and in the east, and the time of
/// the last agent of each.
fn leave(mut world: World, agents: &[AgentId]) -> ([usize; 2], [f64; 2]) {
    let (mut counts, mut last) = ([0; 2], [0.0; 2]);
    let mut sides = vec![0.0; agents.len()];
    run(&mut world, 300.0, |world| {
        for (side, &id) in sides.iter_mut().zip(agents) {
            match world.position(id) {
                Some(place) => *side = (place.truncate() - MIDDLE).dot(DVec2::from_angle(ANGLE)),
                None if *side != 0.0 => {
                    let exit = usize::from(*side > 0.0);
                    counts[exit] += 1;
                    last[exit] = world.time();
                    *side = 0.0;
                }
                None => {}
            }
        }
    });
    assert!(world.finished(), "all leave");
    (counts, last)
}

#[test]
fn exits_are_used_by_their_widths() {
    let (world, agents) = room([0.9, 1.8], 240, true);
    let (counts, last) = leave(world, &agents);
    let share = counts[0] as f64 / 240.0;
    assert!((0.27..0.40).contains(&share), "a third by the narrow exit, of 0.9 m beside 1.8 m: {counts:?}");
    let (longer, shorter) = (last[0].max(last[1]), last[0].min(last[1]));
    assert!(longer < 1.25 * shorter, "both are used to the end: {last:?}");
}

/// The way to the other exit is longer than what was left to the first, and takes more than 30 s.
#[test]
fn agents_that_change_to_the_far_exit_get_on() {
    let (mut world, agents) = room_at_speed([0.5, 2.0], 240, true, 0.3);
    run(&mut world, 900.0, |_| {});
    assert!(world.finished(), "all of {} leave", agents.len());
    assert_eq!(world.summary().without_progress_30s, 0);
}

#[test]
fn without_a_queue_the_nearest_exit_is_taken() {
    let (world, agents) = room([0.9, 1.8], 6, true);
    let nearest: Vec<bool> = agents
        .iter()
        .map(|&id| (world.position(id).unwrap().truncate() - MIDDLE).dot(DVec2::from_angle(ANGLE)) > 0.0)
        .collect();
    let east = nearest.iter().filter(|&&east| east).count();
    assert_eq!(leave(world, &agents).0, [6 - east, east]);
}

#[test]
fn agents_that_do_not_look_ahead_keep_to_their_goals() {
    let (world, agents) = room([0.9, 1.8], 60, false);
    let east = agents
        .iter()
        .filter(|&&id| (world.position(id).unwrap().truncate() - MIDDLE).dot(DVec2::from_angle(ANGLE)) > 0.0);
    let east = east.count();
    assert_eq!(leave(world, &agents).0, [60 - east, east]);
}

#[test]
fn a_saved_world_chooses_alike() {
    let (mut world, _) = room([0.9, 1.8], 240, true);
    (0..83).for_each(|_| world.step());
    let (mut other, _) = room([0.9, 1.8], 240, true);
    other.load(&world.save()).unwrap();
    for _ in 0..200 {
        world.step();
        other.step();
        assert_eq!(world.state_hash(), other.state_hash(), "at {} s", world.time());
    }
}

#[test]
fn journeys_that_do_not_match_are_no_choice() {
    let mut world = with_settings(0.05, SubSteps::Auto, MIDDLE);
    let point = |x: f64| Goal::Point { at: at(x, 0.0), tolerance: 0.1 };
    let [a, b, c] = [1.0, 2.0, 3.0].map(|x| journey_into(&mut world, point(x)));
    let wrong = world.add_choice(&[a, throng::JourneyId::STAY]).unwrap_err().to_string();
    assert!(wrong.contains("number of their stops"), "{wrong}");
    world.add_choice(&[a, b]).unwrap();
    let wrong = world.add_choice(&[c, b]).unwrap_err().to_string();
    assert!(wrong.contains("alternatives already"), "{wrong}");
}
