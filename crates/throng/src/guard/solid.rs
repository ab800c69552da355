//! What is solid to whom in a step.

use super::cores::Cores;
use super::sweep::Sweep;
use super::{Bodies, Contacts, Pose};
use crate::space::{Core, Disc, Edge, Walls};
use glam::DVec3;

/// Everything that the guard holds apart.
#[derive(Clone, Copy)]
pub(super) struct Solid<'a> {
    pub bodies: &'a Bodies<'a>,
    pub contacts: &'a Contacts,
    pub walls: &'a Walls,
    pub cores: &'a Cores,
}

impl<'a> Solid<'a> {
    /// Those whom `row` could touch and is held apart from: of two, one at least must be guarded.
    #[inline]
    pub fn others(self, row: usize) -> impl Iterator<Item = usize> + 'a {
        let others = self.contacts.of(row).iter().map(|&other| other as usize);
        let guarded = self.bodies.guarded[row];
        others.filter(move |&other| guarded || self.bodies.guarded[other])
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
    #[inline]
    pub fn is_disc(self, row: usize) -> bool {
        self.bodies.is_disc(row)
    }

    /// The core of a body at the start of the step.
    pub fn core(self, row: usize) -> Core {
        self.cores.of(row, self.bodies)
    }

    /// How the centre of a body moves to `target`.
    #[inline(always)]
    pub fn motion(self, row: usize, target: Pose) -> DVec3 {
        target.place().as_dvec3() - self.bodies.place(row).as_dvec3()
    }

    /// From another to `row`, which moves by `motion`: the offset of their centres, and its change.
    #[inline(always)]
    pub fn relative(self, row: usize, motion: DVec3, other: usize, targets: &[Pose]) -> (DVec3, DVec3) {
        let offset = self.bodies.place(row).as_dvec3() - self.bodies.place(other).as_dvec3();
        (offset, motion - self.motion(other, targets[other]))
    }

    /// Whether a body is on the ground and does not want to leave it.
    pub fn is_grounded(self, row: usize, target: Pose) -> bool {
        self.bodies.altitudes[row] == 0.0 && target.altitude == 0.0
    }

    /// The motion of a body to `target` along the ground: the shorter way round.
    pub fn sweep(self, row: usize, target: Pose) -> Sweep {
        let start = self.core(row);
        let turn = f64::from(target.heading) - f64::from(self.bodies.headings[row]);
        let turn = turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
        Sweep { start, motion: target.position.as_dvec2() - start.center, turn }
    }
}
