//! The agents: groups with profiles, states and places.

use super::super::notes::Notes;
use super::lattice;
use super::profile::Profile;
use super::xml::{Xml, children};
use crate::error::{Error, Kind};
use crate::geometry::DVec2;
use crate::import::short;
use crate::random::{Purpose, Random};
use roxmltree::Node;

/// The maximum number of agents of a group's generators.
const MOST: f64 = 1e6;

/// Agents of a group with the same profile.
#[derive(Debug)]
pub(super) struct Crowd {
    pub profile: Profile,
    /// The first state.
    pub state: String,
    pub at: Vec<DVec2>,
}

/// Reads all groups of a scene.
pub(super) fn all(xml: &Xml, profiles: &[Profile], notes: &mut Notes) -> Result<Vec<Crowd>, Error> {
    let mut crowds = vec![];
    for (i, node) in children(xml.document.root_element(), "AgentGroup").enumerate() {
        let mut at = vec![];
        for generator in children(node, "Generator") {
            generate(xml, generator, &mut at, notes)?;
        }
        let only = |name: &'static str| {
            children(node, name)
                .next()
                .ok_or_else(|| xml.wrong(node, Kind::MissingKey, format!("this group of agents has no <{name}>")))
        };
        let selector = only("StateSelector")?;
        let state = xml.text(selector, "name")?.to_owned();
        let chosen = choices(xml, only("ProfileSelector")?, profiles)?;
        let mut parts: Vec<Vec<DVec2>> = vec![vec![]; chosen.len()];
        let whole: f64 = chosen.iter().map(|(_, weight)| weight).sum();
        for (k, p) in at.into_iter().enumerate() {
            let mut drawn = Random::new(1, i as u64, k as u64, Purpose::Choice).unit() * whole;
            let part = chosen.iter().position(|(_, weight)| {
                drawn -= weight;
                drawn < 0.0
            });
            parts[part.unwrap_or(chosen.len() - 1)].push(p);
        }
        let crowd = |((profile, _), at): ((&Profile, f64), Vec<DVec2>)| Crowd {
            profile: profile.clone(),
            state: state.clone(),
            at,
        };
        crowds.extend(chosen.into_iter().zip(parts).map(crowd).filter(|crowd| !crowd.at.is_empty()));
    }
    Ok(crowds)
}

/// Returns the profiles that a selector chooses from, with their weights. The list is not empty.
fn choices<'p>(xml: &Xml, node: Node, profiles: &'p [Profile]) -> Result<Vec<(&'p Profile, f64)>, Error> {
    let find = |node: Node| -> Result<&'p Profile, Error> {
        let name = node.attribute("name").unwrap_or_default();
        let known = profiles.iter().find(|profile| profile.name == name);
        known.ok_or_else(|| xml.wrong(node, Kind::UnknownKey, format!("there is no profile `{name}`")))
    };
    let kind = node.attribute("type").unwrap_or("const");
    if !matches!(kind, "weighted" | "random") {
        return Ok(vec![(find(node)?, 1.0)]);
    }
    let mut out = vec![];
    for child in children(node, "Profile") {
        let weight = xml.number(child, "weight")?.filter(|_| kind == "weighted").unwrap_or(1.0);
        out.push((find(child)?, weight.max(0.0)));
    }
    if out.iter().all(|(_, weight)| *weight == 0.0) {
        return Err(xml.wrong(node, Kind::MissingKey, "this selector has no <Profile> to choose"));
    }
    Ok(out)
}

/// Adds the places of a generator.
fn generate(xml: &Xml, node: Node, out: &mut Vec<DVec2>, notes: &mut Notes) -> Result<(), Error> {
    if node.attribute("displace_dist").is_some() {
        notes.whole("displacements of generators by chance are left out: agents stand where the generator has them");
    }
    let point =
        |x: &str, y: &str| -> Result<DVec2, Error> { Ok(DVec2::new(xml.needed(node, x)?, xml.needed(node, y)?)) };
    match xml.text(node, "type")? {
        "explicit" | "nav_mesh_explicit" => {
            for agent in children(node, "Agent") {
                out.push(DVec2::new(xml.needed(agent, "p_x")?, xml.needed(agent, "p_y")?));
            }
        }
        "rect_grid" => {
            let (anchor, offset) = (point("anchor_x", "anchor_y")?, point("offset_x", "offset_y")?);
            let count = point("count_x", "count_y")?.max(DVec2::ZERO).floor();
            if out.len() as f64 + count.x * count.y > MOST {
                return Err(xml.wrong(
                    node,
                    Kind::Count,
                    format!("{} by {} agents make the group larger than {MOST}", count.x, count.y),
                ));
            }
            let (sin, cos) = libm::sincos(xml.number(node, "rotation")?.unwrap_or(0.0).to_radians());
            let turn = DVec2::new(cos, sin);
            let places = (0..count.y as u32)
                .flat_map(|v| (0..count.x as u32).map(move |u| DVec2::new(f64::from(u), f64::from(v))));
            out.extend(places.map(|place| anchor + turn.rotate(place * offset)));
        }
        "hex_lattice" => out.extend(lattice::places(xml, node, MOST - out.len() as f64)?),
        other => {
            let shown = short(other);
            let error = xml.wrong(node, Kind::UnknownKey, format!("generators of the kind `{shown}` are not read"));
            return Err(error.hint("write its agents as a generator `explicit`, or `rect_grid`"));
        }
    }
    Ok(())
}
