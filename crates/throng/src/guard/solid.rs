//! The bodies, walls and discs that the guard keeps apart in a step.

use super::cores::Cores;
use super::sweep::CoreSweep;
use super::{BodyPose, Contacts, GuardedBodies};
use crate::space::{Core, Disc, Edge, Walls};
use glam::DVec3;

/// The bodies, walls and discs that the guard keeps apart.
#[derive(Clone, Copy)]
pub(super) struct GuardedObjects<'a> {
    pub bodies: &'a GuardedBodies<'a>,
    pub contacts: &'a Contacts,
    pub walls: &'a Walls,
    pub cores: &'a Cores,
}

impl<'a> GuardedObjects<'a> {
    /// Returns the bodies that `row` could touch and is kept apart from: at least one of the two is guarded.
    #[inline]
    pub fn others(self, row: usize) -> impl Iterator<Item = usize> + 'a {
        let others = self.contacts.of(row).iter().map(|&other| other as usize);
        let guarded = self.bodies.guarded[row];
        others.filter(move |&other| guarded || self.bodies.guarded[other])
    }

    /// Returns the wall edges that `row` could touch and is kept off.
    pub fn edges(self, row: usize) -> impl Iterator<Item = &'a Edge> {
        let found: &[u32] = if self.bodies.guarded[row] { self.contacts.edges_of(row) } else { &[] };
        found.iter().map(move |&index| &self.walls.edges()[index as usize])
    }

    /// Returns the solid discs that `row` could touch and is kept off.
    pub fn discs(self, row: usize) -> impl Iterator<Item = &'a Disc> {
        let found: &[u32] = if self.bodies.guarded[row] { self.contacts.discs_of(row) } else { &[] };
        found.iter().map(move |&index| &self.walls.discs()[index as usize])
    }

    /// Returns the edges and solid discs as static cores with their radii.
    pub fn standing(self, row: usize) -> impl Iterator<Item = (Core, f64)> + 'a {
        let edges = self.edges(row).map(|edge| (Core::segment(edge.start, edge.end), 0.0));
        edges.chain(self.discs(row).map(|disc| (Core::point(disc.center), disc.radius)))
    }

    /// Whether a body is a disc: its centre and radius describe it completely.
    #[inline]
    pub fn is_disc(self, row: usize) -> bool {
        self.bodies.is_disc(row)
    }

    /// Returns the core of a body at the start of the step.
    pub fn core(self, row: usize) -> Core {
        self.cores.of(row, self.bodies)
    }

    /// Returns the displacement of the centre of a body that moves to `target`.
    #[inline(always)]
    pub fn motion(self, row: usize, target: BodyPose) -> DVec3 {
        target.place().as_dvec3() - self.bodies.place(row).as_dvec3()
    }

    /// Returns the offset from the centre of `other` to the centre of `row`, and its change over the step; `motion` is
    /// the displacement of `row`.
    #[inline(always)]
    pub fn relative(self, row: usize, motion: DVec3, other: usize, targets: &[BodyPose]) -> (DVec3, DVec3) {
        let offset = self.bodies.place(row).as_dvec3() - self.bodies.place(other).as_dvec3();
        (offset, motion - self.motion(other, targets[other]))
    }

    /// Whether a body is on the ground and its target is on the ground too.
    pub fn is_grounded(self, row: usize, target: BodyPose) -> bool {
        self.bodies.altitudes[row] == 0.0 && target.altitude == 0.0
    }

    /// Returns the motion of a body to `target` in the plane. It turns by the smaller angle.
    pub fn sweep(self, row: usize, target: BodyPose) -> CoreSweep {
        let start = self.core(row);
        let turn = f64::from(target.heading) - f64::from(self.bodies.headings[row]);
        let turn = turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
        CoreSweep { start, motion: target.position.as_dvec2() - start.center, turn }
    }
}
