//! What is wrong with what a group says of steering, before anything is made of it.

use super::super::limits::{Limit, check, check_number};
use super::{refused, vehicle};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::{Group, Speed};
use toml::Value;

/// Checks what a group says of steering: that vehicles are those of who steers, that nothing else says what they do, that
/// they can be, and that numbers are finite.
pub fn check_steering(path: &Path, group: &Group) -> Result<(), Problem> {
    let Some(steer) = &group.steer else {
        return match (&group.vehicle, &group.start_speed) {
            (None, None) => Ok(()),
            (None, Some(_)) => {
                Err(Problem::new(&path.key("start_speed"), Kind::Conflict, "only those who steer have a start_speed")
                    .hint("say what they steer by: steer.wander = {}"))
            }
            (Some(_), _) => {
                Err(Problem::new(&path.key("vehicle"), Kind::Conflict, "only those who steer have a vehicle")
                    .hint("say what they steer by: steer.wander = {}"))
            }
        };
    };
    let mends = [
        ("speed", group.speed != Speed::default(), "set vehicle.max_speed instead"),
        ("acceleration", group.acceleration.is_some(), "set vehicle.max_force and vehicle.mass instead"),
        ("turn_rate", group.turn_rate.is_some(), "set vehicle.turn_rate instead"),
        ("tracking_error", group.tracking_error.is_some(), "leave it away"),
    ];
    for (key, said, mend) in mends {
        if said {
            let message = format!("{key} is for those who walk; those who steer move as their vehicles can");
            return Err(Problem::new(&path.key(key), Kind::Conflict, message).hint(mend));
        }
    }
    if let Some(speed) = &group.start_speed {
        let path = path.key("start_speed");
        check_number(&path, speed, Limit::Between(0.0, 1000.0))?;
        if group.heading.is_none() {
            let message = "start_speed without a heading";
            return Err(Problem::new(&path, Kind::Conflict, message).hint("say where they face: heading = 90"));
        }
    }
    if let Ok(tree) = Value::try_from(steer) {
        check_finite(&path.key("steer"), &tree)?;
    }
    let path = path.key("vehicle");
    if let Some(said) = &group.vehicle {
        if let Ok(tree) = Value::try_from(said) {
            check_finite(&path, &tree)?;
        }
        let made = vehicle(group);
        made.check().map_err(|error| refused(&path, &error))?;
        check(&path.key("max_speed"), f64::from(made.max_speed), Limit::UpTo(1000.0))?;
    }
    Ok(())
}

/// All numbers are finite, and none is larger than coordinates are.
fn check_finite(path: &Path, tree: &Value) -> Result<(), Problem> {
    match tree {
        Value::Float(x) => check(path, *x, Limit::Finite),
        Value::Array(items) => items.iter().enumerate().try_for_each(|(i, item)| check_finite(&path.index(i), item)),
        Value::Table(items) => items.iter().try_for_each(|(key, item)| check_finite(&path.key(key), item)),
        _ => Ok(()),
    }
}
