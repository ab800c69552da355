//! Checks the steering of a group before it is built.

use super::super::limits::{Limit, check};
use crate::file::{Path, Problem};
use crate::scene::Group;
use toml::Value;

/// Checks the steering of a group: all numbers are finite.
pub fn check_steering(path: &Path, group: &Group) -> Result<(), Problem> {
    match group.steer.as_ref().map(Value::try_from) {
        Some(Ok(tree)) => check_finite(&path.key("steer"), &tree),
        _ => Ok(()),
    }
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
