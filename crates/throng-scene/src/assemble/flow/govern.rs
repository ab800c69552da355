//! The fields that guide groups.

use super::{FieldSite, Flows};
use crate::assemble::PlannedAgent;
use crate::assemble::limits::{Limit, check, check_some};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::DVec2;
use crate::registry::Names;
use crate::scene::{Group, flow};
use glam::Vec3;
use std::cell::RefCell;
use std::sync::Arc;
use throng::field::{Governed, Interaction};
use throng_field::Uniform;

impl Flows<'_> {
    /// Returns the fields that guide a group, by its position in the scene. `id` returns the position of a group in the
    /// world by its name.
    pub fn governed(&self, group: usize, id: impl Fn(&str) -> Option<usize>) -> Result<Option<Governed>, Problem> {
        let Some(said) = &self.scene.groups[group].field else { return Ok(None) };
        let path = Path::of("group").index(group).key("field");
        let made = self.of_group(group).governed(said, &path, id);
        made.map(Some).map_err(|problem| {
            let name = Group::name_at(&self.scene.groups[group].name, group);
            Problem { message: format!("group `{name}`: {}", problem.message), ..problem }
        })
    }
}

impl FieldSite<'_> {
    fn governed(
        &self,
        said: &flow::Governed,
        path: &Path,
        id: impl Fn(&str) -> Option<usize>,
    ) -> Result<Governed, Problem> {
        let field = match &said.of {
            Some(flow) => self.field(flow, &path.key("of"))?,
            None => Arc::new(Uniform(Vec3::ZERO)),
        };
        let map = said.map.as_ref().map(|map| self.map(map, &path.key("map"))).transpose()?.or_else(|| field.cover());
        let around = said.around.as_deref().unwrap_or_default();
        if said.of.is_none() && around.is_empty() {
            let problem = Problem::new(path, Kind::MissingKey, "it has neither `of` nor `around`");
            return Err(problem.hint("write `of.named = \"street\"`, a [[field]] of the scene"));
        }
        let one = |(i, around)| self.interaction(around, &path.key("around").index(i), &id);
        let around = around.iter().enumerate().map(one).collect::<Result<_, _>>()?;
        // each agent has its own ratio, which is drawn
        Ok(Governed { field, ratio: 1.0, map, around })
    }

    fn interaction(
        &self,
        said: &flow::Interaction,
        path: &Path,
        id: impl Fn(&str) -> Option<usize>,
    ) -> Result<Interaction, Problem> {
        let source = id(&said.source).ok_or_else(|| {
            let message = format!("there is no group or mover `{}`", said.source);
            Problem::new(&path.key("source"), Kind::UnknownKey, message)
                .hint("name one of the scene's [[group]]s or [[mover]]s")
        })?;
        check_some(&path.key("weight"), said.weight, Limit::Positive)?;
        check_some(&path.key("reach"), said.reach, Limit::Positive)?;
        check(&path.key("carried"), said.carried.unwrap_or(0.0), Limit::Finite)?;
        // in the frame of the agent that carries the field
        let frame = Self { moves: true, ..self.clone() };
        let looks = said.looks.as_ref().map(|looks| frame.field(looks, &path.key("looks"))).transpose()?;
        Ok(Interaction {
            source,
            field: frame.field(&said.of, &path.key("of"))?,
            looks,
            weight: said.weight.unwrap_or(1.0) as f32,
            carried: said.carried.unwrap_or(0.0) as f32,
            reach: said.reach.map_or(f32::INFINITY, |reach| reach as f32),
        })
    }
}

/// Adds notes about groups guided by a field alone that is zero at the start positions of some of their agents.
pub fn note_silence(groups: &[throng::Group], agents: &[PlannedAgent], origin: DVec2, notes: &RefCell<Vec<String>>) {
    for (i, group) in groups.iter().enumerate() {
        let Some(governed) = group.guidance.field.as_ref().filter(|governed| governed.around.is_empty()) else {
            continue;
        };
        let led = || agents.iter().filter(|planned| planned.group == i && planned.journey.is_none());
        let silent = led().filter(|planned| {
            let place = (planned.agent.position - origin.extend(0.0)).as_vec3();
            governed.field.velocity(place, 0.0) == Vec3::ZERO
        });
        let (silent, all) = (silent.count(), led().count());
        if silent > 0 {
            notes.borrow_mut().push(format!(
                "group `{}`: its field is zero where {silent} of its {all} agents start, and they have no goal",
                group.name
            ));
        }
    }
}
