//! Checks the steering of a group before it is built.

use super::super::limits::{HIGHEST, Limit, check, check_point};
use super::super::motor::vehicle;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::steer::Position;
use crate::scene::{Group, Motor, WrapAround};
use toml::Value;

/// Checks the steering of a group: all numbers are finite.
pub fn check_steering(path: &Path, group: &Group) -> Result<(), Problem> {
    let Some(steer) = &group.steer else {
        let says = [("wrap_around", group.wrap_around.is_some(), "only agents that steer wrap around")];
        return match says.into_iter().find(|(_, said, _)| *said) {
            None => Ok(()),
            Some((key, _, message)) => {
                Err(Problem::new(&path.key(key), Kind::Conflict, message).hint("add a behaviour: steer.wander = {}"))
            }
        };
    };
    check_wrap_around(&path.key("wrap_around"), group)?;
    if let Ok(tree) = Value::try_from(steer) {
        check_finite(&path.key("steer"), &tree)?;
    }
    Ok(())
}

/// Checks that agents that wrap around reach neither the ground nor another agent on the other side.
fn check_wrap_around(path: &Path, group: &Group) -> Result<(), Problem> {
    let Some(WrapAround { center: Position([x, y, z]), radius }) = group.wrap_around else { return Ok(()) };
    check_point(&path.key("center"), &[x, y])?;
    check(&path.key("radius"), radius, Limit::UpTo(HIGHEST))?;
    let flies = group.moved_by() == Motor::Vehicle && vehicle(group).flies();
    check(&path.key("center").index(2), z, Limit::Between(if flies { radius } else { 0.0 }, HIGHEST))?;
    if group.guard == Some(true) {
        let message = "agents that wrap around cannot be guarded: the guard does not see the other side";
        return Err(Problem::new(path, Kind::Conflict, message).hint("leave out `guard`"));
    }
    if group.solid.is_some() {
        let message = "agents that wrap around have no `solid`: a solid may be in the way on the other side";
        return Err(Problem::new(path, Kind::Conflict, message).hint("leave out `solid` or `wrap_around`"));
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
