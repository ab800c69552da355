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
    let (speed, error) = (group.speed != Speed::default(), group.tracking_error.is_some());
    let of_walkers = [
        ("speed", speed, "set vehicle.max_speed instead"),
        ("acceleration", group.acceleration.is_some(), "set vehicle.max_force and vehicle.mass instead"),
        ("turn_rate", group.turn_rate.is_some(), "set vehicle.turn_rate instead"),
        ("tracking_error", error, "leave it out"),
    ];
    let of_vehicles = ("vehicle", group.vehicle.is_some(), "leave it out, or set motor = \"vehicle\"");
    let of_wheels = ("tracking_error", error, "leave it out, or set motor = \"two_wheels\"");
    let (name, foreign) = match motor {
        Motor::Vehicle => ("a vehicle", &of_walkers[..]),
        Motor::TwoWheels => ("two wheels", &[of_vehicles][..]),
        Motor::Holonomic => ("a holonomic motor", &[of_vehicles, of_wheels][..]),
    };
    // a distribution or a constant of 0 is no error
    let is_nothing = |key: &str| key == "tracking_error" && group.tracking_error == Some(Number::Constant(0.0));
    if let Some((key, _, fix)) = foreign.iter().find(|(key, given, _)| *given && !is_nothing(key)) {
        let message = format!("the agents have {name}, which has no `{key}`");
        return Err(Problem::new(&path.key(key), Kind::Conflict, message).hint(*fix));
    }
    if motor == Motor::TwoWheels && group.turn_rate.is_none() {
        let message = "two wheels are for bodies that turn slowly, but there is no turn_rate";
        let key = if error { "tracking_error" } else { "motor" };
        return Err(Problem::new(&path.key(key), Kind::MissingKey, message)
            .hint(format!("add `turn_rate = 180`, degrees a second, or leave out `{key}`")));
    }
    if let Some(given) = &group.vehicle {
        given.read(&path.key("vehicle"))?;
    }
    Ok(())
}
