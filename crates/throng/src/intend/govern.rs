//! Fields: the velocities that they prescribe.

use crate::agent::Columns;
use crate::field::{Governed, Source, blend};
use crate::navigate::Surroundings;
use crate::parallel;
use crate::world::State;
use glam::{Vec2, Vec3};

/// Source agents, around which fields are defined, in their state in this sub-step; and the directions in which these
/// fields make other agents face.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sources {
    /// Rows and sources by group, in the order of the agents' numbers.
    all: Vec<Vec<(usize, Source)>>,
    /// Whether a field is defined around the agents of a group.
    wanted: Vec<bool>,
    /// Directions to face, by row; zero for none.
    pub looks: Vec<Vec2>,
}

impl Sources {
    /// Gathers the source agents of fields.
    pub fn find(&mut self, state: &State) {
        let Self { all, wanted, .. } = self;
        wanted.clear();
        wanted.resize(state.local_groups.len(), false);
        let governed = state.groups_in_use().filter_map(|group| group.guidance.field.as_ref());
        for around in governed.flat_map(|field| &field.around) {
            wanted.get_mut(around.source).into_iter().for_each(|wanted| *wanted = true);
        }
        all.iter_mut().for_each(Vec::clear);
        all.resize(state.local_groups.len(), Vec::new());
        if wanted.contains(&true) {
            let agents = &state.agents;
            for row in (0..agents.len()).filter(|&row| wanted[agents.group[row].index()]) {
                let (sin, cos) = libm::sincosf(agents.heading[row]);
                let (place, velocity) = (agents.position[row], agents.velocity[row]);
                all[agents.group[row].index()].push((row, Source { place, ahead: Vec2::new(cos, sin), velocity }));
            }
            all.iter_mut().for_each(|rows| rows.sort_unstable_by_key(|&(row, _)| agents.number[row]));
        }
    }

    /// Returns the preferred velocity of an agent blended with the field of its group.
    pub fn governed(&self, around: Surroundings<'_>, row: usize, own: Vec3, now: f64) -> Vec3 {
        let Some(governed) = around.state.field(row) else { return own };
        if !around.way(row).walks() {
            return own;
        }
        let place = around.state.place_in_space(row);
        let ratio = governed.ratio_at(place, around.state.agents.governed[row]);
        if ratio == 0.0 {
            return own;
        }
        let flow = self.flow(around.state, governed, row, place, now);
        let blended = blend(own.truncate(), flow, ratio, around.state.agents.velocity[row]);
        blended.clamp_length_max(around.state.agents.max_speed[row]).extend(own.z)
    }

    /// Returns the weighted mean of the velocities of a field and of the fields around source agents, along the ground.
    fn flow(&self, state: &State, governed: &Governed, row: usize, place: Vec3, now: f64) -> Vec2 {
        let adapted = state.adapted.get(state.agents.group[row].index()).and_then(Option::as_ref);
        let field = adapted.map_or(&governed.field, |adapted| &adapted.field);
        let field = field.velocity(place, now).truncate();
        if governed.around.is_empty() {
            return field;
        }
        let (mut sum, mut weights) = if field == Vec2::ZERO { (field, 0.0) } else { (field, 1.0) };
        for around in &governed.around {
            self.each(&state.agents, row, around.source, around.reach, |source| {
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
    pub fn find_looks(&mut self, state: &State, now: f64) {
        let mut looks = std::mem::take(&mut self.looks);
        looks.clear();
        if state.any_looks_about() {
            looks.resize(state.agents.len(), Vec2::ZERO);
            let sources = &*self;
            parallel::ranges(&mut looks[..], |rows, looks| {
                rows.zip(looks).for_each(|(row, looks)| *looks = sources.looks_about(state, row, now));
            });
        }
        self.looks = looks;
    }

    fn looks_about(&self, state: &State, row: usize, now: f64) -> Vec2 {
        let Some(governed) = state.field(row) else { return Vec2::ZERO };
        let place = state.agents.position[row];
        let mut sum = Vec2::ZERO;
        for around in governed.around.iter().filter(|around| around.looks.is_some()) {
            self.each(&state.agents, row, around.source, around.reach, |source| {
                sum += around.looks(&source, place, now) * around.weight;
            });
        }
        sum.normalize_or_zero()
    }

    /// Calls `found` for the source agents of a group within a distance of an agent.
    fn each(&self, agents: &Columns, row: usize, group: usize, reach: f32, mut found: impl FnMut(Source)) {
        let place = agents.position[row];
        for &(other, source) in self.all.get(group).into_iter().flatten() {
            if other != row && source.place.distance_squared(place) <= reach * reach {
                found(source);
            }
        }
    }
}

impl State {
    /// Returns the field that governs an agent.
    pub(crate) fn field(&self, row: usize) -> Option<&Governed> {
        self.local_groups[self.agents.group[row].index()].guidance.field.as_ref()
    }

    /// Whether a field of any group in use makes agents face a direction.
    pub(crate) fn any_looks_about(&self) -> bool {
        let fields = self.groups_in_use().filter_map(|group| group.guidance.field.as_ref());
        fields.flat_map(|field| &field.around).any(|around| around.looks.is_some())
    }
}
