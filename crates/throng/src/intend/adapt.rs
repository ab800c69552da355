//! Fields that adapt to the positions of the agents.

use crate::field::{Adaptive, Field};
use crate::halo::{Halo, read, write};
use crate::world::State;
use glam::Vec2;
use std::fmt;
use std::sync::Arc;

/// The adaptive field of a group, in its present state.
#[derive(Clone)]
pub(crate) struct Adapted {
    /// The field that it adapts.
    of: Arc<dyn Field>,
    pub memory: Vec<f32>,
    pub field: Arc<dyn Field>,
}

impl fmt::Debug for Adapted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Adapted").field("memory", &self.memory.len()).finish_non_exhaustive()
    }
}

impl State {
    /// Updates adaptive fields with the positions of the agents, when their interval has passed.
    pub(crate) fn adapt(&mut self, halo: &mut dyn Halo) {
        self.adapted.resize(self.local_groups.len(), None);
        let mut positions = Vec::new();
        for index in 0..self.local_groups.len() {
            let Some(governed) = &self.local_groups[index].guidance.field else {
                self.adapted[index] = None;
                continue;
            };
            let field = governed.field.clone();
            let Some(adaptive) = field.adaptive() else {
                self.adapted[index] = None;
                continue;
            };
            let same = |adapted: &&Adapted| Arc::ptr_eq(&adapted.of, &field);
            let known = self.adapted[index].take().filter(|adapted| same(&adapted));
            self.adapted[index] = Some(match known {
                Some(known) if !self.is_time_for(adaptive) => known,
                // groups that share a field share its adapted state
                known => match self.adapted[..index].iter().flatten().find(same) {
                    Some(other) => other.clone(),
                    None => {
                        let mut memory = known.map_or_else(|| adaptive.memory(), |known| known.memory);
                        if positions.is_empty() {
                            positions = self.positions_by_number(halo);
                        }
                        adaptive.notice(&mut memory, &positions);
                        Adapted { field: adaptive.adapted(&memory), memory, of: field.clone() }
                    }
                },
            });
        }
    }

    /// Whether the step that begins is the first step or the first after a multiple of the interval.
    fn is_time_for(&self, adaptive: &dyn Adaptive) -> bool {
        let count = |steps: u64| self.ticks(steps, adaptive.interval());
        self.steps == 0 || count(self.steps) != count(self.steps - 1)
    }

    /// Returns the positions of the agents of all worlds.
    fn positions_by_number(&self, halo: &mut dyn Halo) -> Vec<Vec2> {
        let own = self.agents.number.iter().copied().zip(self.agents.position.iter().copied());
        let mut all: Vec<(u32, Vec2)> = own.collect();
        let mut packets = vec![Vec::new(); halo.worlds()];
        for (_, packet) in packets.iter_mut().enumerate().filter(|&(world, _)| world != halo.index()) {
            all.iter().for_each(|agent| write(packet, agent));
        }
        all.extend(halo.exchange(packets).iter().flat_map(|packet| read::<(u32, Vec2)>(packet)));
        all.sort_unstable_by_key(|&(number, _)| number);
        all.into_iter().map(|(_, position)| position).collect()
    }

    /// Returns the memories of adaptive fields, by group.
    pub(crate) fn field_memories(&self) -> Vec<Vec<f32>> {
        let memory =
            |adapted: &Option<Adapted>| adapted.as_ref().map_or_else(Vec::new, |adapted| adapted.memory.clone());
        self.adapted.iter().map(memory).collect()
    }

    /// Returns the adaptive fields with these memories, by group; `None` if the memories belong to other fields.
    pub(crate) fn fields_that_remember(&self, memories: Vec<Vec<f32>>) -> Option<Vec<Option<Adapted>>> {
        let adapted = |(index, memory): (usize, Vec<f32>)| -> Option<Option<Adapted>> {
            if memory.is_empty() {
                return Some(None);
            }
            let field = self.local_groups.get(index)?.guidance.field.as_ref()?.field.clone();
            let adaptive = field.adaptive().filter(|adaptive| adaptive.memory().len() == memory.len())?;
            Some(Some(Adapted { field: adaptive.adapted(&memory), memory, of: field.clone() }))
        };
        memories.into_iter().enumerate().map(adapted).collect()
    }
}
