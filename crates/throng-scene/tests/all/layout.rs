//! Start positions and goals of agents.

use glam::DVec3;
use throng::motion::Motor;
use throng_scene::{Scene, gallery};

fn plan(text: &str) -> throng_scene::Plan {
    text.parse::<Scene>().and_then(|scene| scene.plan()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn drawn_places_keep_clear_of_walls_and_of_each_other() {
    let plan = gallery::scene("office").unwrap().plan().unwrap();
    for (i, a) in plan.agents.iter().enumerate() {
        let p = a.agent.position;
        assert!(p.x.abs() <= 14.87 && p.y.abs() <= 6.87);
        for b in &plan.agents[..i] {
            assert!(p.distance(b.agent.position) >= 0.26 + 0.3 - 1e-6);
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_places_and_another_gives_others() {
    let places = |seed: u64| -> Vec<[u64; 3]> {
        let mut scene = gallery::scene("crossing").unwrap();
        scene.seed = seed;
        let plan = scene.plan().unwrap();
        plan.agents.iter().map(|a| a.agent.position.to_array().map(f64::to_bits)).collect()
    };
    assert_eq!(places(7), places(7));
    assert!(places(7) != places(8));
}

#[test]
fn a_ring_goes_to_the_opposite_side() {
    let plan = gallery::scene("circle").unwrap().plan().unwrap();
    for planned in &plan.agents {
        let (goal, wait) = plan.journeys[planned.journey.unwrap()].stops[0];
        let throng::Goal::Point { at, .. } = plan.goals[goal] else { panic!() };
        assert!((at + planned.agent.position.truncate()).length() < 1e-12 && wait == 0.0);
    }
}

#[test]
fn laps_run_round_the_ring_from_where_each_agent_starts() {
    let at = |angle: f64| 8.0 * glam::DVec2::from_angle(angle.to_radians());
    for (clockwise, turn) in [(false, 1.0), (true, -1.0)] {
        let plan = plan(&format!(
            "walkable.ring = {{ center = [3, 4], inner = 7, outer = 9 }}\n[[group]]\ncount = 16\n\
             place.ring = {{ center = [3, 4], radius = 8, start = 10 }}\ngoal.lap = {{ clockwise = {clockwise} }}"
        ));
        for (k, planned) in plan.agents.iter().enumerate() {
            let journey = &plan.journeys[planned.journey.unwrap()];
            assert!(journey.repeat && journey.stops.len() == 8);
            let start = planned.agent.position.truncate() - glam::DVec2::new(3.0, 4.0);
            assert!(start.distance(at(10.0 + 22.5 * k as f64)) < 1e-9);
            // successive sector centres are an eighth of a turn apart, the first within a quarter
            let mut last = start;
            for (stop, &(goal, _)) in journey.stops.iter().enumerate() {
                let middle = plan.goals[goal].middle() - glam::DVec2::new(3.0, 4.0);
                let way = turn * last.angle_to(middle).to_degrees();
                assert!(if stop == 0 { (22.0..68.0).contains(&way) } else { (way - 45.0).abs() < 1e-6 }, "{way}");
                last = middle;
            }
        }
    }
}

#[test]
fn ground_of_rectangles_is_where_any_of_them_is() {
    let plan = plan(
        "walkable.rectangles = [{ center = [0, 0], size = [4, 4] }, { center = [3, 0], size = [2.2, 1] }]\n\
         [[group]]\nplace.point = [0, 0]\ngoal.point = [3.5, 0]",
    );
    let on = |x: f64, y: f64| plan.walkable.iter().any(|area| area.contains(glam::DVec2::new(x, y)));
    assert!([on(0.0, 1.9), on(3.9, 0.4), on(3.9, 0.6), on(4.2, 0.0)] == [true, true, false, false]);
}

#[test]
fn mistakes_of_rings_and_laps_are_named() {
    let error_of = |text: &str| text.parse::<Scene>().and_then(|scene| scene.plan()).unwrap_err().to_string();
    let one = "\n[[group]]\nplace.point = [8, 0]\ngoal.lap = {}";
    assert!(error_of(one).contains("goal.lap has no ring"), "{}", error_of(one));
    let narrow = format!("walkable.ring = {{ inner = 9, outer = 7 }}{one}");
    assert!(error_of(&narrow).contains("is not more than the inner radius"), "{}", error_of(&narrow));
    let stop =
        "walkable.ring = { inner = 7, outer = 9 }\n[[group]]\nplace.point = [8, 0]\ngoal.journey = [{ goal.lap = {} }]";
    assert!(error_of(stop).contains("laps are without end"), "{}", error_of(stop));
}

#[test]
fn a_sphere_is_even_and_goes_to_its_antipodes() {
    let plan = gallery::scene("sphere").unwrap().plan().unwrap();
    let center = DVec3::new(0.0, 0.0, 10.0);
    let place = |agent: &throng::Agent| agent.position - center;
    let spots: Vec<DVec3> = plan.agents.iter().map(|planned| place(&planned.agent)).collect();
    for (planned, spot) in plan.agents.iter().zip(&spots) {
        let throng::Goal::Air { at, .. } = plan.goals[plan.journeys[planned.journey.unwrap()].stops[0].0] else {
            panic!()
        };
        assert!((at - center + *spot).length() < 1e-5 && (spot.length() - 8.0).abs() < 1e-5);
        let nearest =
            spots.iter().filter(|other| *other != spot).map(|other| other.distance(*spot)).fold(9.0, f64::min);
        // the distance in a hexagonal lattice of the same density
        let even = 8.0 * (8.0 * std::f64::consts::PI / (3.0_f64.sqrt() * spots.len() as f64)).sqrt();
        assert!(nearest > 0.75 * even, "{nearest} of {even}");
    }
    assert!(spots.iter().sum::<DVec3>().length() < 0.5 * spots.len() as f64 * 0.05, "no side has more");
}

#[test]
fn agents_that_start_in_the_air_have_their_own_goals_there() {
    let goals = |goal: &str| -> Vec<(throng::Goal, f32)> {
        let text = format!("[[group]]\nplace.points = [[0, 0], [4, 0]]\naltitude = {{ uniform = [2, 5] }}\n{goal}\n");
        let plan = plan(&text);
        let of = |planned: &throng_scene::PlannedAgent| plan.journeys[planned.journey.unwrap()].stops[0].0;
        plan.agents.iter().map(|planned| (plan.goals[of(planned)].clone(), planned.agent.position.z as f32)).collect()
    };
    for (text, rise, in_air) in [
        ("goal.opposite = {}", 0.0, true),
        ("goal.shift = { by = [0, 9], rise = 1.5 }", 1.5, true),
        ("goal.points.at = [[0, 9], [4, 9]]", 0.0, true),
        ("goal.point = [0, 9]", 0.0, false),
    ] {
        for (goal, altitude) in goals(text) {
            assert!((2.0..5.0).contains(&altitude));
            let want = in_air.then_some(f64::from(altitude) + rise);
            assert!(goal.altitude().zip(want).is_none_or(|(a, b)| (a - b).abs() < 1e-6), "{text}: {goal:?}");
            assert_eq!(goal.altitude().is_some(), in_air, "{text}");
        }
    }
    let shared = goals("goal.air = { at = [1, 2, 3] }");
    assert!(shared.iter().all(|(goal, _)| goal.altitude() == Some(3.0)));
}

/// Agents above each other do not overlap.
#[test]
fn spots_above_each_other_are_apart() {
    let layers = |altitude: f64| {
        let layer =
            |z: f64| format!("[[group]]\nplace.grid = {{ columns = 3, rows = 3, spacing = 0.5 }}\naltitude = {z}\n");
        (layer(1.0) + &layer(altitude)).parse::<Scene>().and_then(|scene| scene.plan()).is_ok()
    };
    assert!(layers(1.5) && !layers(1.2));
}

#[test]
fn sources_let_agents_enter_in_order() {
    let plan = plan(
        "[[group]]\nplace.point = [0, 0]\ngoal.point = [9, 0]\n\
         source = [{ rate = 2, end = 2 }, { start = 0.25, interval = 1, count = 2 }]\n",
    );
    let times: Vec<f64> = plan.agents.iter().map(|a| a.enters.unwrap()).collect();
    assert_eq!(times, [0.0, 0.25, 0.5, 1.0, 1.25, 1.5]);
    let numbers: Vec<Option<u32>> = plan.agents.iter().map(|a| a.agent.number).collect();
    assert_eq!(numbers, (0..6).map(Some).collect::<Vec<_>>());
}

#[test]
fn waits_choices_and_cycles_become_journeys() {
    let plan = plan(
        "[[group]]\ncount = 200\nplace.grid = { columns = 20, rows = 10, spacing = 1 }\nwait = 2\n\
         goal.choice = [\n\
           { weight = 3, goal.point = [50, 0] },\n\
           { weight = 1, goal.cycle = [{ goal.point = [0, 50], wait = 4 }, { goal.point = [0, 60] }] },\n\
         ]\n",
    );
    let journeys: Vec<_> = plan.agents.iter().map(|a| &plan.journeys[a.journey.unwrap()]).collect();
    assert!(journeys.iter().all(|journey| journey.stops[0].1 == 2.0));
    let cycling = journeys.iter().filter(|journey| journey.repeat).count();
    assert!((30..70).contains(&cycling), "{cycling}");
    let cycle = journeys.iter().find(|journey| journey.repeat).unwrap();
    assert_eq!(cycle.stops.iter().map(|stop| stop.1).collect::<Vec<_>>(), [2.0, 4.0, 0.0]);
}

#[test]
fn distributions_stay_in_their_bounds() {
    let plan = plan(
        "[[group]]\ncount = 100\nplace.disc = { radius = 20 }\nbody.radius = { uniform = [0.15, 0.25] }\n\
         speed = { preferred = { normal = { mean = 1.3, deviation = 0.3, min = 1.0 } }, max = 1.6 }\n\
         turn_rate = 180\nlayers = [0, 3]\navoids = [1]\n",
    );
    for planned in &plan.agents {
        let agent = &planned.agent;
        assert!((0.15..=0.25).contains(&agent.radius) && (1.0..=1.6).contains(&agent.preferred_speed));
        let Motor::Holonomic(motor) = agent.motor else { panic!("{:?}", agent.motor) };
        assert_eq!((agent.layers, agent.avoids, motor.max_turn_rate), (0b1001, 0b10, std::f32::consts::PI));
    }
    assert!(plan.agents.iter().any(|a| a.agent.radius != plan.agents[0].agent.radius));
}

#[test]
fn an_obstacle_can_be_the_circle_round_its_box() {
    let plan = plan(
        "[[group]]\nplace.point = [20, 0]\n[[obstacle]]\nas = \"circle\"\n\
         shape.rectangle = { center = [1, 2], size = [3, 4], rotation = 45 }\n",
    );
    let throng::Obstacle::Circle { center, radius } = plan.obstacles[0] else { panic!() };
    assert!((center.x - 1.0).abs() < 1e-12 && (radius - 2.5).abs() < 1e-12);
}

#[test]
fn the_origin_is_in_the_middle() {
    let plan = plan(
        "walkable.rectangle = { center = [-1800, 400], size = [20, 10] }\n[[group]]\nplace.point = [-1800, 400]\n",
    );
    assert_eq!(plan.settings.origin.to_array(), [-1800.0, 400.0]);
}

#[test]
fn agents_face_the_direction_of_their_path() {
    let heading = |text: &str| {
        let (world, _) = text.parse::<Scene>().unwrap().build().unwrap_or_else(|error| panic!("{error}"));
        world.relative_columns().heading[0].to_degrees()
    };
    let start = "[[group]]\nplace.point = [0, 0]\ngoal.point = [0, 5]\n";
    assert_eq!(heading(start), 90.0);
    // the first stop, at which they wait, is their start position
    assert_eq!(heading(&format!("{start}wait = 3\n")), 90.0);
    // a wall from the left that ends at (2, 2): the path leads around its end
    let wall = "[[obstacle]]\nshape.wall = [[-20, 2], [2, 2]]\n";
    for wait in ["", "wait = 3\n"] {
        let found = heading(&format!("{start}{wait}{wall}"));
        assert!((30.0..45.0).contains(&found), "{found}");
    }
    assert_eq!(heading(&format!("{start}heading = -10\n{wall}")), -10.0);
    assert_eq!(heading("[[group]]\nplace.point = [0, 0]\n"), 0.0);
}

#[test]
fn the_nearest_goal_is_the_nearest_on_foot() {
    let chosen = |walls: &str, first: &str| {
        let plan =
            plan(&format!("[[group]]\nplace.point = [0, 0]\ngoal.nearest = [{first}, {{ point = [0, -6] }}]\n{walls}"));
        plan.journeys[plan.agents[0].journey.unwrap()].stops[0].0
    };
    let wall = "[[obstacle]]\nshape.wall = [[-9, 2], [9, 2]]\n";
    let cell = "[[obstacle]]\nshape.wall = [[-1, 2], [1, 2], [1, 4], [-1, 4], [-1, 2]]\n";
    for first in ["{ point = [0, 3] }", "{ area.disc = { center = [0, 3], radius = 0.5 } }"] {
        assert_eq!(chosen("", first), 0, "in the open");
        assert_eq!(chosen(wall, first), 1, "round the wall it is farther");
        assert_eq!(chosen(cell, first), 1, "there is no way in");
    }
}

#[test]
fn groups_share_a_goal_they_both_name() {
    let one = |name: &str, x: f64| {
        format!(
            "[[group]]\nname = \"{name}\"\nplace.point = [{x}, 0]\n\
             goal.exit.rectangle = {{ center = [9, 0], size = [1, 1] }}\n"
        )
    };
    let plan = plan(&(one("a", 0.0) + &one("b", 2.0)));
    assert_eq!((plan.goals.len(), plan.journeys.len()), (1, 1));
}
