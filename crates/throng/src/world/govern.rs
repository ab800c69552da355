//! 2c. Fields: the velocities that they prescribe.

use super::{State, World};
use crate::field::{Governed, Source, blend};
use crate::parallel;
use glam::{Vec2, Vec3};

/// Source agents, around which fields are defined, in their state in this sub-step; and the directions in which these
/// fields make other agents face.
#[derive(Clone, Debug, Default)]
pub(super) struct Sources {
    /// Rows and sources by group, in the order of the agents' numbers.
    all: Vec<Vec<(usize, Source)>>,
    /// Whether a field is defined around the agents of a group.
    wanted: Vec<bool>,
    /// Directions to face, by row; zero for none.
    pub looks: Vec<Vec2>,
}

impl World {
    /// Gathers the source agents of fields.
    pub(super) fn note_sources(&mut self) {
        let mut sources = std::mem::take(&mut self.step.sources);
        let Sources { all, wanted, .. } = &mut sources;
        wanted.clear();
        wanted.resize(self.state.local_groups.len(), false);
        let governed = self.state.groups_in_use().filter_map(|group| group.field.as_ref());
        for around in governed.flat_map(|field| &field.around) {
            wanted.get_mut(around.source).into_iter().for_each(|wanted| *wanted = true);
        }
        all.iter_mut().for_each(Vec::clear);
        all.resize(self.state.local_groups.len(), Vec::new());
        if wanted.contains(&true) {
            let agents = &self.state.agents;
            for row in (0..agents.len()).filter(|&row| wanted[agents.group[row].index()]) {
                let (sin, cos) = libm::sincosf(agents.heading[row]);
                let (place, velocity) = (agents.position[row], agents.velocity[row]);
                all[agents.group[row].index()].push((row, Source { place, ahead: Vec2::new(cos, sin), velocity }));
            }
            all.iter_mut().for_each(|rows| rows.sort_unstable_by_key(|&(row, _)| agents.number[row]));
        }
        self.step.sources = sources;
    }

    /// Returns the preferred velocity of an agent blended with the field of its group.
    pub(super) fn governed(&self, row: usize, own: Vec3, now: f64) -> Vec3 {
        let Some(governed) = &self.state.local_groups[self.state.agents.group[row].index()].field else { return own };
        if !self.step.shown[row].way.walks() {
            return own;
        }
        let place = self.state.place_in_space(row);
        let ratio = governed.ratio_at(place, self.state.agents.governed[row]);
        if ratio == 0.0 {
            return own;
        }
        let flow = self.flow(governed, row, place, now);
        let blended = blend(own.truncate(), flow, ratio, self.state.agents.velocity[row]);
        blended.clamp_length_max(self.state.agents.max_speed[row]).extend(own.z)
    }

    /// Returns the weighted mean of the velocities of a field and of the fields around source agents, along the ground.
    fn flow(&self, governed: &Governed, row: usize, place: Vec3, now: f64) -> Vec2 {
        let adapted = self.state.adapted.get(self.state.agents.group[row].index()).and_then(Option::as_ref);
        let field = adapted.map_or(&governed.field, |adapted| &adapted.field);
        let field = field.velocity(place, now).truncate();
        if governed.around.is_empty() {
            return field;
        }
        let (mut sum, mut weights) = if field == Vec2::ZERO { (field, 0.0) } else { (field, 1.0) };
        for around in &governed.around {
            self.each_source(row, around.source, around.reach, |source| {
                let said = around.velocity(&source, place.truncate(), now);
                if said != Vec2::ZERO {
                    sum += said * around.weight;
                    weights += around.weight;
                }
            });
        }
        if weights > 0.0 { sum / weights } else { sum }
    }

    /// Computes the directions in which fields make agents face; empty if no field does.
    pub(super) fn note_looks(&mut self, now: f64) {
        let mut looks = std::mem::take(&mut self.step.sources.looks);
        looks.clear();
        if self.state.any_looks_about() {
            looks.resize(self.state.agents.len(), Vec2::ZERO);
            let world = &*self;
            parallel::ranges(&mut looks[..], |rows, looks| {
                rows.zip(looks).for_each(|(row, looks)| *looks = world.looks_about(row, now));
            });
        }
        self.step.sources.looks = looks;
    }

    fn looks_about(&self, row: usize, now: f64) -> Vec2 {
        let Some(governed) = &self.state.local_groups[self.state.agents.group[row].index()].field else { return Vec2::ZERO };
        let place = self.state.agents.position[row];
        let mut sum = Vec2::ZERO;
        for around in governed.around.iter().filter(|around| around.looks.is_some()) {
            self.each_source(row, around.source, around.reach, |source| {
                sum += around.looks(&source, place, now) * around.weight;
            });
        }
        sum.normalize_or_zero()
    }

    /// Calls `found` for the source agents of a group within a distance of an agent.
    fn each_source(&self, row: usize, group: usize, reach: f32, mut found: impl FnMut(Source)) {
        let place = self.state.agents.position[row];
        for &(other, source) in self.step.sources.all.get(group).into_iter().flatten() {
            if other != row && source.place.distance_squared(place) <= reach * reach {
                found(source);
            }
        }
    }
}

impl State {
    /// Whether a field of any group in use makes agents face a direction.
    pub(crate) fn any_looks_about(&self) -> bool {
        let fields = self.groups_in_use().filter_map(|group| group.field.as_ref());
        fields.flat_map(|field| &field.around).any(|around| around.looks.is_some())
    }
}
