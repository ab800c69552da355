//! Checks the steering of a group before it is built.

use super::super::limits::{Limit, check, check_number};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::{Group, Speed};
use toml::Value;

/// Checks the steering of a group: only groups that steer have vehicles, no other key contradicts the vehicle, the
/// vehicle is valid, and all numbers are finite.
pub fn check_steering(path: &Path, group: &Group) -> Result<(), Problem> {
    let Some(steer) = &group.steer else {
        let says = [
            ("start_speed", group.start_speed.is_some(), "only agents that steer have a start_speed"),
            ("vehicle", group.vehicle.is_some(), "only agents that steer have a vehicle"),
        ];
        return match says.into_iter().find(|(_, said, _)| *said) {
            None => Ok(()),
            Some((key, _, message)) => {
                Err(Problem::new(&path.key(key), Kind::Conflict, message).hint("add a behaviour: steer.wander = {}"))
            }
        };
    };
    let fixes = [
        ("speed", group.speed != Speed::default(), "set vehicle.max_speed instead"),
        ("acceleration", group.acceleration.is_some(), "set vehicle.max_force and vehicle.mass instead"),
        ("turn_rate", group.turn_rate.is_some(), "set vehicle.turn_rate instead"),
        ("tracking_error", group.tracking_error.is_some(), "leave it out"),
    ];
    for (key, said, fix) in fixes {
        if said {
            let message = format!("{key} is for agents that walk; the vehicle defines the motion of agents that steer");
            return Err(Problem::new(&path.key(key), Kind::Conflict, message).hint(fix));
        }
    }
    if let Some(speed) = &group.start_speed {
        let path = path.key("start_speed");
        check_number(&path, speed, Limit::Between(0.0, 1000.0))?;
        if group.heading.is_none() {
            let message = "start_speed without a heading";
            return Err(Problem::new(&path, Kind::Conflict, message).hint("add their direction: heading = 90"));
        }
    }
    if let Ok(tree) = Value::try_from(steer) {
        check_finite(&path.key("steer"), &tree)?;
    }
    let path = path.key("vehicle");
    if let Some(given) = &group.vehicle {
        given.read(&path)?;
    }
    Ok(())
}

/// Checks that all numbers are finite and no larger than coordinates.
fn check_finite(path: &Path, tree: &Value) -> Result<(), Problem> {
    match tree {
        Value::Float(x) => check(path, *x, Limit::Finite),
        Value::Array(items) => items.iter().enumerate().try_for_each(|(i, item)| check_finite(&path.index(i), item)),
        Value::Table(items) => items.iter().try_for_each(|(key, item)| check_finite(&path.key(key), item)),
        _ => Ok(()),
    }
}
