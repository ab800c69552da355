//! Cores of the bodies at the start of a step.

use super::GuardedBodies;
use crate::space::Core;
use glam::Vec2;

/// Cores of the bodies at the start of a step. Only cores of bodies that are not discs are stored.
#[derive(Clone, Debug, Default)]
pub(super) struct Cores {
    kept: Vec<Core>,
    /// Index of each row's core among the stored ones; empty if all bodies are discs.
    places: Vec<u32>,
}

impl Cores {
    pub fn rebuild(&mut self, bodies: &GuardedBodies<'_>) {
        self.kept.clear();
        self.places.clear();
        if bodies.cores.values().iter().all(|&core| core == Vec2::ZERO) {
            return;
        }
        for row in 0..bodies.positions.len() {
            self.places.push(self.kept.len() as u32);
            if !bodies.is_disc(row) {
                self.kept.push(Core::new(bodies.positions[row].as_dvec2(), bodies.headings[row], bodies.cores[row]));
            }
        }
    }

    pub fn of(&self, row: usize, bodies: &GuardedBodies<'_>) -> Core {
        if bodies.is_disc(row) {
            return Core::point(bodies.positions[row].as_dvec2());
        }
        self.kept[self.places[row] as usize]
    }
}
