//! Checks that the groups with expectations exist.

use super::limits::{Limit, check, check_some};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::{DistanceExpect, Group, GroupExpect, Mover, Scene, To};

/// Checks the expectations of groups: their names and bounds.
pub(super) fn check_groups(scene: &Scene) -> Result<(), Problem> {
    let groups = scene.groups.iter().enumerate().map(|(i, group)| Group::name_at(&group.name, i));
    let movers = scene.movers.iter().enumerate().map(|(i, mover)| Mover::name_at(&mover.name, i));
    let names: Vec<String> = groups.chain(movers).collect();
    let named = |path: &Path, name: Option<&String>| match name {
        Some(name) if !names.contains(name) => {
            let message = format!("there is no group `{name}`");
            Err(Problem::new(path, Kind::UnknownKey, message).hint(format!("there is: {}", names.join(", "))))
        }
        _ => Ok(()),
    };
    let surfaces = || scene.surfaces.iter().map(|surface| &surface.name);
    let known = |name: &String| surfaces().chain(scene.paths.iter().map(|path| &path.name)).any(|known| known == name);
    let bounds = |path: &Path, said: &GroupExpect| {
        named(&path.key("of"), said.of.as_ref())?;
        check_some(&path.key("at_least"), said.at_least, Limit::NotNegative)?;
        check_some(&path.key("at_most"), said.at_most, Limit::NotNegative)?;
        check(&path.key("after"), said.after, Limit::NotNegative)
    };
    let path = Path::of("expect");
    for (i, said @ DistanceExpect { to, .. }) in scene.expect.distance.iter().enumerate() {
        let path = path.key("distance").index(i);
        bounds(&path, &said.of_group())?;
        match to {
            To::Named(name) if !known(name) => named(&path.key("to"), Some(name))?,
            To::Named(_) => {}
            To::Place(place) => {
                place.0.iter().enumerate().try_for_each(|(i, x)| check(&path.key("to").index(i), *x, Limit::Finite))?
            }
        }
    }
    for (key, list) in [("speed", &scene.expect.speed), ("order", &scene.expect.order)] {
        list.iter().enumerate().try_for_each(|(i, said)| bounds(&path.key(key).index(i), said))?;
    }
    Ok(())
}
