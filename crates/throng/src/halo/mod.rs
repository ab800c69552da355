//! One crowd in several worlds, with the bits of one world.
//!
//! Each world owns the agents on a part of the ground: its own rows. In every sub-step it receives copies of the agents
//! near its part, its *ghosts*, as rows behind its own, so that the neighbours of an own row are those of the undivided
//! crowd. Ghosts have what other agents read, and the stages before the guard leave them out. At four points of a sub-step a
//! world receives for its ghosts what their owners have computed: the paths that neighbours know, the preferred velocities,
//! the chosen velocities and, while clamping spreads in the guard, the targets. After the motion it drops the ghosts.
//!
//! A [`Halo`] says which world owns which ground, for instance by [`Cuts`], and carries packets. It knows nothing of agents. [`DividedWorld`] joins
//! a world and its halo, and refuses what cannot be divided. `docs/divided.md` has the exchanges, and the depths that make
//! the bits equal.

mod agreement;
mod border;
mod cuts;
mod divided;
mod far;
mod packet;
mod refuse;

pub use agreement::Agreement;
pub(crate) use agreement::Told;
pub(crate) use border::{Border, Link, Others};
pub use cuts::{Cuts, Load};
pub use divided::DividedWorld;
pub(crate) use far::{FarQuestions, ask_far};
pub(crate) use packet::{BROKEN, read, write};

use glam::Vec2;

/// The division of the ground, and the connection to the other worlds. All worlds of a division call
/// [`agree`](Self::agree) and [`exchange`](Self::exchange) in the same order.
///
/// Places are metres from the [origin](crate::Settings::origin) of the world, as in
/// [`World::relative_columns`](crate::World::relative_columns).
pub trait Halo {
    /// Returns the number of worlds.
    fn worlds(&self) -> usize;

    /// Returns the index of this world.
    fn index(&self) -> usize;

    /// Returns the index of the world that owns the ground at a place. All worlds give the same answer. It may change
    /// between two steps: agents then move to their new worlds.
    fn owner(&self, place: Vec2) -> usize;

    /// Calls `found` once for each other world that owns ground within a distance of a place, metres. It may call it
    /// for further worlds.
    fn near(&self, place: Vec2, distance: f32, found: &mut dyn FnMut(usize));

    /// Returns the values of all worlds, [merged](Agreement::merge).
    fn agree(&mut self, own: Agreement) -> Agreement;

    /// Sends a packet to each world, by index, and returns the packet of each world to this one. The packet to this
    /// world is empty. Packets must arrive unchanged: a step cannot continue after a loss.
    fn exchange(&mut self, packets: Vec<Vec<u8>>) -> Vec<Vec<u8>>;
}

/// The halo of a world without others.
#[derive(Clone, Copy, Debug, Default)]
pub struct Alone;

impl Halo for Alone {
    fn worlds(&self) -> usize {
        1
    }

    fn index(&self) -> usize {
        0
    }

    fn owner(&self, _: Vec2) -> usize {
        0
    }

    fn near(&self, _: Vec2, _: f32, _: &mut dyn FnMut(usize)) {}

    fn agree(&mut self, own: Agreement) -> Agreement {
        own
    }

    fn exchange(&mut self, packets: Vec<Vec<u8>>) -> Vec<Vec<u8>> {
        packets
    }
}
