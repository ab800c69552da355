//! What is solid to whom in a step.

use super::sweep::Sweep;
use super::{Bodies, Contacts, Pose};
use crate::space::{Core, Disc, Edge, Walls};
use glam::Vec2;

/// Everything that the guard holds apart.
#[derive(Clone, Copy)]
pub(super) struct Solid<'a> {
    pub bodies: &'a Bodies<'a>,
    pub contacts: &'a Contacts,
    pub walls: &'a Walls,
    /// Cores at the start of the step; of discs, any.
    pub cores: &'a [Core],
}

impl<'a> Solid<'a> {
    /// Those whom `row` could touch and is held apart from: of two, one at least must be guarded.
    pub fn others(self, row: usize) -> impl Iterator<Item = usize> + 'a {
        let guarded = self.bodies.guarded;
        let others = self.contacts.of(row).iter().map(|&other| other as usize);
        others.filter(move |&other| guarded[row] || guarded[other])
    }

    /// Wall edges that `row` could touch and is held off.
    pub fn edges(self, row: usize) -> impl Iterator<Item = &'a Edge> {
        let found: &[u32] = if self.bodies.guarded[row] { self.contacts.edges_of(row) } else { &[] };
        found.iter().map(move |&index| &self.walls.edges()[index as usize])
    }

    /// Solid discs that `row` could touch and is held off.
    pub fn discs(self, row: usize) -> impl Iterator<Item = &'a Disc> {
        let found: &[u32] = if self.bodies.guarded[row] { self.contacts.discs_of(row) } else { &[] };
        found.iter().map(move |&index| &self.walls.discs()[index as usize])
    }

    /// Edges and solid discs as cores that stand, with their radii.
    pub fn standing(self, row: usize) -> impl Iterator<Item = (Core, f64)> + 'a {
        let edges = self.edges(row).map(|edge| (Core::segment(edge.start, edge.end), 0.0));
        edges.chain(self.discs(row).map(|disc| (Core::point(disc.center), disc.radius)))
    }

    /// Whether a body is a disc: centres and radii say everything about it.
    pub fn is_disc(self, row: usize) -> bool {
        self.bodies.cores[row] == Vec2::ZERO
    }

    /// The core of a body at the start of the step.
    pub fn core(self, row: usize) -> Core {
        self.cores[row]
    }

    /// The motion of a body to `target`: the shorter way round.
    pub fn sweep(self, row: usize, target: Pose) -> Sweep {
        let start = self.core(row);
        let turn = f64::from(target.heading) - f64::from(self.bodies.headings[row]);
        let turn = turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
        Sweep { start, motion: target.position.as_dvec2() - start.center, turn }
    }
}
