//! What moves the agents of a group.

use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::{Group, Motor, Number, Speed};
use throng::motion;

/// Returns the vehicle of a group. The check of the group has refused what cannot be read.
pub(super) fn vehicle(group: &Group) -> motion::Vehicle {
    group.vehicle.as_ref().and_then(|given| given.read(&Path::default()).ok()).unwrap_or_default()
}

/// Returns the maximum speed of the slowest agent that a group may have, m/s.
pub(super) fn least_top_speed(group: &Group) -> f32 {
    match (group.moved_by(), &group.speed.max) {
        (Motor::Vehicle, _) => vehicle(group).max_speed,
        (_, Some(most)) => most.bounds()[0] as f32,
        (_, None) => (group.speed.preferred.bounds()[0] as f32).max(motion::Holonomic::default().max_speed),
    }
}

/// Checks that a group has no keys of another motor, and that those of its own are valid.
pub(super) fn check_motor(path: &Path, group: &Group) -> Result<(), Problem> {
    let motor = group.moved_by();
    let is_given = |key: &str| match key {
        "speed" => group.speed != Speed::default(),
        "acceleration" => group.acceleration.is_some(),
        "turn_rate" => group.turn_rate.is_some(),
        // no error is none
        "tracking_error" => !matches!(group.tracking_error, None | Some(Number::Constant(0.0))),
        _ => group.vehicle.is_some(),
    };
    if let Some(key) = motor.keys_of_others().find(|key| is_given(key)) {
        let name = match motor {
            Motor::Holonomic => "a holonomic motor",
            Motor::TwoWheels => "two wheels",
            Motor::Vehicle => "a vehicle",
        };
        let fix = match (motor, key) {
            (Motor::Vehicle, "speed") => "set vehicle.max_speed instead",
            (Motor::Vehicle, "acceleration") => "set vehicle.max_force and vehicle.mass instead",
            (Motor::Vehicle, "turn_rate") => "set vehicle.turn_rate instead",
            (_, "tracking_error") => "leave it out, or set motor = \"two_wheels\"",
            _ => "leave it out, or set motor = \"vehicle\"",
        };
        let message = format!("the agents have {name}, which has no `{key}`");
        return Err(Problem::new(&path.key(key), Kind::Conflict, message).hint(fix));
    }
    if motor == Motor::TwoWheels && group.turn_rate.is_none() {
        let message = "two wheels are for bodies that turn slowly, but there is no turn_rate";
        let key = if group.motor.is_some() { "motor" } else { "tracking_error" };
        return Err(Problem::new(&path.key(key), Kind::MissingKey, message)
            .hint(format!("add `turn_rate = 180`, degrees a second, or leave out `{key}`")));
    }
    if let Some(given) = &group.vehicle {
        given.read(&path.key("vehicle"))?;
    }
    Ok(())
}
