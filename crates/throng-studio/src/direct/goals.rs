//! Editing of goals and exits.

use super::obstacles::sides;
use super::parts::{OutlineKind, Parts, Removal, point};
use super::shapes::{Owner, region, spot};
use crate::document::Edit;
use glam::DVec2;
use throng_scene::{Goal, Scene};
use toml_edit::{InlineTable, Value};

/// The radius of an exit that is placed with a click, metres.
const EXIT: f64 = 1.0;

/// Adds the handles of the goals of the groups.
pub fn parts(scene: &Scene, parts: &mut Parts) {
    for (g, group) in scene.groups.iter().enumerate() {
        let path = format!("group.{g}.goal");
        let owner = Owner { kind: OutlineKind::Goal, removal: Some(Removal::Path(path.clone())) };
        if let Some(goal) = &group.goal {
            goal_parts(parts, &path, goal, &owner);
        }
    }
}

fn goal_parts(parts: &mut Parts, path: &str, goal: &Goal, owner: &Owner) {
    match goal {
        Goal::Point(there) => spot(parts, &format!("{path}.point"), there.at, owner),
        Goal::Points(there) => {
            for (k, &at) in there.at.iter().enumerate() {
                spot(parts, &format!("{path}.points.at.{k}"), at, &Owner { kind: owner.kind, removal: None });
            }
        }
        Goal::Opposite(opposite) => {
            if let Some(center) = opposite.center {
                spot(parts, &format!("{path}.opposite.center"), center, owner);
            }
        }
        Goal::Area(there) => region(parts, &format!("{path}.area"), there, owner),
        Goal::Exit(there) => region(parts, &format!("{path}.exit"), there, owner),
        Goal::Journey(stops) | Goal::Cycle(stops) => {
            let kind = if matches!(goal, Goal::Journey(_)) { "journey" } else { "cycle" };
            for (k, stop) in stops.iter().enumerate() {
                let itself = Removal::Path(format!("{path}.{kind}.{k}"));
                let owner = Owner { kind: owner.kind, removal: Some(itself) };
                goal_parts(parts, &format!("{path}.{kind}.{k}.goal"), &stop.goal, &owner);
            }
        }
        Goal::Nearest(goals) => {
            for (k, goal) in goals.iter().enumerate() {
                let path = format!("{path}.nearest.{k}");
                let owner = Owner { kind: owner.kind, removal: Some(Removal::Path(path.clone())) };
                goal_parts(parts, &path, goal, &owner);
            }
        }
        Goal::Choice(goals) => {
            for (k, weighted) in goals.iter().enumerate() {
                let path = format!("{path}.choice.{k}");
                let owner = Owner { kind: owner.kind, removal: Some(Removal::Path(path.clone())) };
                goal_parts(parts, &format!("{path}.goal"), &weighted.goal, &owner);
            }
        }
        Goal::Air(_) | Goal::Shift(_) | Goal::Lap(_) => {}
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
