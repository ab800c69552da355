//! Converts a project to a scene.

use super::super::Imported;
use super::super::notes::Notes;
use super::files::Project;
use super::machine::Machine;
use super::profile::Profile;
use super::route::{MengeRoutes, follow};
use super::xml::{Xml, children};
use super::{people, profile, solids};
use crate::error::{Error, Kind};
use crate::geometry::DVec2;
use crate::scene::flow::{Governed, Named, Table};
use crate::scene::{Field, Group, PointsPlace, Scene, Time, Until, Walkable};
use std::path::Path;

pub(super) fn convert(project: &Project) -> Result<Imported, Error> {
    let mut notes = Notes::default();
    if let Some(model) = project.model.as_deref().filter(|model| *model != "orca") {
        notes.whole(format!("the model {model} and its parameters are left out: agents avoid each other by ORCA"));
    }
    let (path, text) = &project.behavior;
    let in_file = |path: &Path| {
        let name = path.display().to_string();
        move |mut error: Error| {
            error.file.get_or_insert_with(|| name.into());
            error
        }
    };
    let machine = Xml::parse(text).and_then(|xml| Machine::read(&xml, &mut notes)).map_err(in_file(path))?;
    let (scene, text) = &project.scene;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut scene =
        Xml::parse(text).and_then(|xml| read(&xml, scene, &machine, folder, &mut notes)).map_err(in_file(scene))?;
    scene.title = format!("{} (from Menge)", project.name);
    Ok(Imported { scene, notes: notes.lines() })
}

/// Reads the scene, with the goals of the machine. The files of the machine are in `folder`.
fn read(xml: &Xml, path: &Path, machine: &Machine, folder: &Path, notes: &mut Notes) -> Result<Scene, Error> {
    let root = xml.document.root_element();
    if root.tag_name().name() != "Experiment" {
        let message =
            format!("this is no scene of Menge's: its root is <{}>, not <Experiment>", root.tag_name().name());
        return Err(xml.wrong(root, Kind::NotAScene, message));
    }
    let profiles = profile::all(xml)?;
    let crowds = people::all(xml, &profiles, notes)?;
    if crowds.is_empty() {
        return Err(xml.wrong(root, Kind::Count, "this scene has no <AgentGroup> with agents"));
    }
    if let Some(crowd) = crowds.iter().find(|crowd| !machine.states.contains_key(&crowd.state)) {
        let message = format!("agents begin in the state `{}`, which the behaviour does not have", crowd.state);
        return Err(xml.wrong(root, Kind::UnknownKey, message));
    }
    let heeded = crowds.iter().fold(0, |bits, crowd| bits | crowd.profile.obstacles);
    let all: Vec<DVec2> = crowds.iter().flat_map(|crowd| crowd.at.iter().copied()).collect();
    let ground = solids::read(xml, path.parent().unwrap_or(Path::new("")), heeded, &all, notes)?;
    if crowds.iter().any(|crowd| crowd.profile.obstacles & heeded != heeded) {
        notes.whole("all agents avoid all obstacles, whatever obstacle set their profile has");
    }
    let (mut groups, mut fields): (Vec<Group>, Vec<Field>) = (vec![], vec![]);
    for (i, crowd) in crowds.into_iter().enumerate() {
        let MengeRoutes { goal, wait, field } = follow(machine, &crowd.state, &crowd.at, notes);
        let field = field.map(|file| {
            let file = absolute(&folder.join(file));
            let name = format!("field-{}", fields.len() + 1);
            fields.push(Field { name: name.clone(), flow: Table { file }.into() });
            Governed { of: Some(Named(name).into()), ratio: None, map: None, around: None }
        });
        groups.push(Group {
            name: name(&crowd.profile, i, &groups),
            place: PointsPlace(crowd.at.iter().map(DVec2::to_array).collect()).into(),
            goal,
            wait,
            field,
            ..crowd.profile.group()
        });
    }
    let step = children(root, "Common").find_map(|node| xml.number(node, "time_step").transpose()).transpose()?;
    let mut areas = ground.walkable;
    Ok(Scene {
        time: Time {
            step: step.filter(|step| *step > 0.0 && *step <= 10.0).unwrap_or(0.1),
            until: Until::Arrived,
            ..Time::default()
        },
        walkable: match areas.len() {
            0 => None,
            1 => areas.pop().map(Walkable::Polygon),
            _ => Some(Walkable::Polygons(areas)),
        },
        obstacles: ground.obstacles,
        fields,
        groups,
        ..Scene::default()
    })
}

/// Returns the name of the profile, with a number if a group has that name already.
fn name(profile: &Profile, i: usize, groups: &[Group]) -> String {
    let taken = groups.iter().any(|group| group.name == profile.name);
    if taken { format!("{}-{}", profile.name, i + 1) } else { profile.name.clone() }
}

/// Returns the absolute name of a file: an imported scene has no folder for relative names.
fn absolute(path: &Path) -> String {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned()).display().to_string()
}
