//! What moves the agents of a scene: any motor with any guidance.

use throng::motion::{Holonomic, Motor, TwoWheels, Vehicle};
use throng::parameters::Angle;
use throng_scene::Scene;

fn scene(keys: &str) -> Scene {
    let text = format!(
        "time = {{ step = 0.05, until = \"limit\", limit = 40 }}\n\
         [[group]]\nname = \"a\"\nplace.point = [0, 0]\ngoal.point = [12, 0]\nheading = 90\n{keys}\n"
    );
    text.parse().unwrap_or_else(|error| panic!("{error}"))
}

fn motor(keys: &str) -> Motor {
    scene(keys).plan().unwrap_or_else(|error| panic!("{keys}: {error}")).agents[0].agent.motor
}

#[test]
fn motors_follow_from_the_keys_or_are_given() {
    let vehicle = Vehicle { max_speed: 3.0, ..Vehicle::default() };
    let robot = TwoWheels { max_turn_rate: Angle::degrees(90.0).radians(), ..TwoWheels::default() };
    let cases: [(&str, Motor); 9] = [
        ("", Holonomic::default().into()),
        ("acceleration = 2", Holonomic { max_acceleration: 2.0, ..Holonomic::default() }.into()),
        ("tracking_error = 0", Holonomic::default().into()),
        ("turn_rate = 90\ntracking_error = 0.2", TwoWheels { tracking_error: 0.2, ..robot }.into()),
        ("motor = \"two_wheels\"\nturn_rate = 90", robot.into()),
        ("vehicle.max_speed = 3", vehicle.into()),
        ("steer.wander = {}", Vehicle::default().into()),
        ("steer.wander = {}\nvehicle.max_speed = 3", vehicle.into()),
        (
            "steer.wander = {}\nmotor = \"holonomic\"\nspeed.max = 2",
            Holonomic { max_speed: 2.0, ..Holonomic::default() }.into(),
        ),
    ];
    for (keys, expected) in cases {
        assert_eq!(motor(keys), expected, "{keys}");
        let written = scene(keys).to_toml().unwrap();
        assert_eq!(written.parse::<Scene>().unwrap(), scene(keys), "{written}");
    }
}

#[test]
fn keys_of_another_motor_are_refused_with_their_place() {
    for (keys, message, hint) in [
        ("vehicle.mass = 2\nspeed.max = 2", "the agents have a vehicle, which has no `speed`", "vehicle.max_speed"),
        (
            "steer.wander = {}\nturn_rate = 9",
            "the agents have a vehicle, which has no `turn_rate`",
            "vehicle.turn_rate",
        ),
        (
            "motor = \"holonomic\"\ntracking_error = 0.1",
            "a holonomic motor, which has no `tracking_error`",
            "two_wheels",
        ),
        ("motor = \"two_wheels\"\nvehicle.mass = 2", "two wheels, which has no `vehicle`", "leave it out"),
        ("motor = \"two_wheels\"", "there is no turn_rate", "turn_rate = 180"),
        ("tracking_error = 0.1", "there is no turn_rate", "turn_rate = 180"),
    ] {
        let error = scene(keys).plan().expect_err(keys);
        assert!(error.to_string().contains(message) && error.line.is_some(), "{keys}: {error}");
        assert!(error.hint.as_deref().unwrap_or_default().contains(hint), "{keys}: {error}");
    }
    let error = "[[group]]\nplace.point = [0, 0]\nmotor = \"wings\"".parse::<Scene>().unwrap_err();
    assert!(error.to_string().contains("wings") && error.line.is_some(), "{error}");
}

/// A route, a behaviour, a field and a field over a behaviour lead each motor to the goal.
#[test]
fn any_guidance_leads_any_motor() {
    let motors = ["", "turn_rate = 120\ntracking_error = 0.1", "vehicle = { max_speed = 1.5, turn_rate = 120 }"];
    let guidance = [
        "",
        "steer.arrive = { target = \"goal\" }",
        "field = { of.towards = { at = [12, 0], speed = 1 } }",
        "steer.arrive = { target = \"goal\" }\nfield = { of.uniform = [1, 0], ratio = 0.3 }",
    ];
    for motor in motors {
        for guidance in guidance {
            let kind = match (motor.is_empty(), motor.contains("tracking")) {
                (true, _) => "motor = \"holonomic\"",
                (_, true) => "motor = \"two_wheels\"",
                _ => "motor = \"vehicle\"",
            };
            let keys = format!("{kind}\n{motor}\n{guidance}");
            let (mut world, _) = scene(&keys).build().unwrap_or_else(|error| panic!("{keys}: {error}"));
            let mut nearest = f64::INFINITY;
            while world.time() < 40.0 {
                world.step();
                let at = world.agents().next().unwrap().position();
                nearest = nearest.min(at.truncate().distance(glam::DVec2::new(12.0, 0.0)));
            }
            assert!(nearest < 0.6, "{keys}: {nearest} m from the goal");
        }
    }
}

#[test]
fn agents_on_routes_may_start_at_a_speed() {
    let plan = scene("start_speed = 1.2").plan().unwrap();
    assert!((plan.agents[0].agent.velocity - glam::Vec2::new(0.0, 1.2)).length() < 1e-6);
}
