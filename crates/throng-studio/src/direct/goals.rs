//! Editing of goals and exits.

use super::obstacles::sides;
use super::parts::{OutlineKind, Parts, Removal, point};
use super::shapes::{Owner, region, spot};
use crate::document::Edit;
use glam::DVec2;
use throng_scene::{AreaGoal, ExitGoal, Goal, Opposite, PointGoal, PointsGoal, Scene};
use toml_edit::{InlineTable, Value};

/// The radius of an exit that is placed with a click, metres.
const EXIT: f64 = 1.0;

/// Adds the handles of the goals of the groups.
pub fn parts(scene: &Scene, parts: &mut Parts) {
    for (g, group) in scene.groups.iter().enumerate() {
        let path = format!("group.{g}.goal");
        let owner = Owner { kind: OutlineKind::Goal, removal: Some(Removal::Path(path.clone())) };
        if let Some(goal) = &group.goal {
            goal_parts(scene, parts, &path, goal, &owner);
        }
    }
}

fn goal_parts(scene: &Scene, parts: &mut Parts, path: &str, goal: &Goal, owner: &Owner) {
    if let Some(there) = goal.read::<PointGoal>() {
        spot(parts, &format!("{path}.point"), there.at, owner);
    } else if let Some(there) = goal.read::<PointsGoal>() {
        for (k, &at) in there.at.iter().enumerate() {
            spot(parts, &format!("{path}.points.at.{k}"), at, &Owner { kind: owner.kind, removal: None });
        }
    } else if let Some(Opposite { center: Some(center), .. }) = goal.read() {
        spot(parts, &format!("{path}.opposite.center"), center, owner);
    } else if let Some(AreaGoal(there)) = goal.read() {
        region(parts, &format!("{path}.area"), &there, owner);
    } else if let Some(ExitGoal(there)) = goal.read() {
        region(parts, &format!("{path}.exit"), &there, owner);
    }
    for (below, part) in scene.plugins.goals.parts(goal) {
        // a goal is removed with its entry of the list: `journey.0` of `journey.0.goal`
        let entry = below.strip_suffix(".goal").unwrap_or(&below);
        let owner = Owner { kind: owner.kind, removal: Some(Removal::Path(format!("{path}.{entry}"))) };
        goal_parts(scene, parts, &format!("{path}.{below}"), &part, &owner);
    }
}

/// Sets the goal of a group: a point, or, after a drag, the rectangle between the two corners.
///
/// # Errors
/// The text has no place for the goal.
pub fn goal(edit: &mut Edit, g: usize, corners: Option<(DVec2, DVec2)>, at: DVec2) -> Result<(), String> {
    match corners {
        Some((from, to)) => place(edit, g, "area.rectangle", sides(from, to)),
        None => place(edit, g, "point", point(at)),
    }
}

/// Sets the exit of a group: a disc, or, after a drag, the rectangle between the two corners.
///
/// # Errors
/// The text has no place for the exit.
pub fn exit(edit: &mut Edit, g: usize, corners: Option<(DVec2, DVec2)>, at: DVec2) -> Result<(), String> {
    match corners {
        Some((from, to)) => place(edit, g, "exit.rectangle", sides(from, to)),
        None => {
            let disc = InlineTable::from_iter([("center", point(at)), ("radius", EXIT.into())]);
            place(edit, g, "exit.disc", disc.into())
        }
    }
}

fn place(edit: &mut Edit, g: usize, kind: &str, value: Value) -> Result<(), String> {
    if !edit.has(&format!("group.{g}")) {
        return Err("there is no group for this goal".into());
    }
    edit.remove(&format!("group.{g}.goal"))?;
    edit.set(&format!("group.{g}.goal.{kind}"), value)
}
