//! 2c. Where does the crowd flow: what fields have to say.

use super::World;
use crate::field::{Governed, Source, blend};
use crate::parallel;
use glam::{Vec2, Vec3};

/// Rows of the agents that fields go with, by group, in the order of their numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct Sources {
    rows: Vec<Vec<u32>>,
}

impl World {
    /// Whether anybody looks where a field says.
    pub(super) fn anybody_looks_about(&self) -> bool {
        let fields = self.groups_in_use().filter_map(|group| group.field.as_ref());
        fields.flat_map(|field| &field.around).any(|around| around.looks.is_some())
    }

    /// Notes whom fields go with.
    pub(super) fn note_sources(&mut self) {
        let mut sources = std::mem::take(&mut self.step.sources);
        sources.rows.iter_mut().for_each(Vec::clear);
        sources.rows.resize(self.groups.len(), Vec::new());
        let governed = self.groups_in_use().filter_map(|group| group.field.as_ref());
        let mut wanted = Vec::new();
        for source in governed.flat_map(|field| &field.around).map(|around| around.source) {
            wanted.resize(self.groups.len(), false);
            wanted.get_mut(source).into_iter().for_each(|wanted| *wanted = true);
        }
        if !wanted.is_empty() {
            for row in 0..self.agents.len() {
                let group = self.agents.group[row].index();
                if wanted[group] {
                    sources.rows[group].push(row as u32);
                }
            }
            let number = |&row: &u32| self.agents.number[row as usize];
            sources.rows.iter_mut().for_each(|rows| rows.sort_unstable_by_key(number));
        }
        self.step.sources = sources;
    }

    /// What of a preferred velocity is left where a field governs too.
    pub(super) fn governed(&self, row: usize, own: Vec3, now: f64) -> Vec3 {
        let Some(governed) = &self.groups[self.agents.group[row].index()].field else { return own };
        if !self.step.shown[row].way.walks() {
            return own;
        }
        let place = self.place_in_space(row);
        let ratio = governed.ratio_at(place, self.agents.governed[row]);
        if ratio == 0.0 {
            return own;
        }
        let flow = self.flow(governed, row, place, now);
        let blended = blend(own.truncate(), flow, ratio, self.agents.velocity[row]);
        blended.clamp_length_max(self.agents.max_speed[row]).extend(own.z)
    }

    /// The mean of what a field and those that go with others say, along the ground.
    fn flow(&self, governed: &Governed, row: usize, place: Vec3, now: f64) -> Vec2 {
        let adapted = self.adapted.get(self.agents.group[row].index()).and_then(Option::as_ref);
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

    /// Where everybody looks because fields say so, by row; zero: nowhere. Empty where no field says so.
    pub(super) fn looks(&self, now: f64) -> Vec<Vec2> {
        if !self.anybody_looks_about() {
            return Vec::new();
        }
        let mut looks = vec![Vec2::ZERO; self.agents.len()];
        parallel::ranges(&mut looks[..], |rows, looks| {
            rows.zip(looks).for_each(|(row, looks)| *looks = self.looks_about(row, now));
        });
        looks
    }

    fn looks_about(&self, row: usize, now: f64) -> Vec2 {
        let Some(governed) = &self.groups[self.agents.group[row].index()].field else { return Vec2::ZERO };
        let place = self.agents.position[row];
        let mut sum = Vec2::ZERO;
        for around in governed.around.iter().filter(|around| around.looks.is_some()) {
            self.each_source(row, around.source, around.reach, |source| {
                sum += around.looks(&source, place, now) * around.weight;
            });
        }
        sum.normalize_or_zero()
    }

    /// All agents of a group within a distance of another.
    fn each_source(&self, row: usize, group: usize, reach: f32, mut found: impl FnMut(Source)) {
        let agents = &self.agents;
        let place = agents.position[row];
        let rows = self.step.sources.rows.get(group).map_or(&[][..], Vec::as_slice);
        for source in rows.iter().map(|&source| source as usize) {
            if source != row && agents.position[source].distance_squared(place) <= reach * reach {
                let (sin, cos) = libm::sincosf(agents.heading[source]);
                found(Source {
                    place: agents.position[source],
                    ahead: Vec2::new(cos, sin),
                    velocity: agents.velocity[source],
                });
            }
        }
    }
}
