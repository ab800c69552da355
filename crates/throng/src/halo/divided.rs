//! A world of a division.

use super::refuse::refuse;
use super::{Agreement, BROKEN, Cuts, Halo, Load, write};
use crate::agent::{Hindered, ObstacleId};
use crate::{Counts, Error, Obstacle, Position, Summary, World};
use glam::Vec2;
use std::collections::BTreeMap;

/// One of several worlds that step one crowd together, with the bits of one world.
///
/// Every world is built with the whole crowd, in the same way: [`new`](Self::new) keeps the agents on the ground that
/// the [`Halo`] gives to this world. Or each is built with a part of the crowd: [`from_part`](Self::from_part). Agents that walk to the ground of another world move there at the start of a step:
/// their numbers stay, their ids change. All worlds must call the methods that change them in the same order, each in its
/// own thread or process, because they wait for each other.
///
/// ```
/// use throng::halo::{Alone, DividedWorld};
/// use throng::{Agent, Settings, World};
/// let mut world = World::new(Settings::default())?;
/// for y in 0..5 {
///     world.add_agent(Agent::at([0.0, f64::from(y)]).goal([9.0, f64::from(y)]))?;
/// }
/// let mut part = DividedWorld::new(world.clone(), Alone)?;
/// while !part.finished() {
///     part.step();
///     world.step();
///     assert_eq!(part.world().state_hash(), world.state_hash());
/// }
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct DividedWorld<H> {
    world: World,
    halo: H,
}

impl<H: Halo> DividedWorld<H> {
    /// Returns the world of the agents on the ground that `halo` gives to it, from the world of all agents.
    ///
    /// # Errors
    /// [`Error::Undivided`] for a crowd that cannot be divided with the same bits, with the group and the reason, and for
    /// worlds that were not built in the same way.
    pub fn new(mut world: World, mut halo: H) -> Result<Self, Error> {
        refuse(&world.state)?;
        agree_on_worlds(&mut halo, world.built())?;
        world.keep_own(|place| halo.owner(place) == halo.index(), halo.index() == 0);
        Ok(Self { world, halo })
    }

    /// Returns a world of a division that was built in parts, so that no world holds all agents. `world` has a part of the
    /// agents, wherever they are: at the start of the first step they move to the worlds that own their places. Each agent
    /// is in one part, with a [number](crate::Agent::number) that no other agent has. All else must be the same in all
    /// worlds, scheduled agents included.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_part(world: World, halo: H) -> Result<Self, Error> {
        Self::join(world, halo, Ok(()))
    }

    /// Continues a run from the saved states of all worlds of a division, with the bits of the run that was saved; the
    /// number of worlds may be another one. `shared` is the state of any world of the division, the same one in all
    /// worlds. This world reads the agents of the states in `parts`: each state is read by one world.
    ///
    /// # Errors
    /// Those of [`World::load`], [`Error::Snapshot`] for states of other steps, and those of [`new`](Self::new).
    pub fn resume(
        mut world: World,
        shared: &[u8],
        parts: impl IntoIterator<Item: AsRef<[u8]>>,
        halo: H,
    ) -> Result<Self, Error> {
        let load = || {
            world.load(shared)?;
            world.keep_own(|_| false, false);
            parts.into_iter().try_for_each(|part| world.load_agents(part.as_ref()))
        };
        let loaded = load();
        Self::join(world, halo, loaded)
    }

    /// Returns a world of a division with a part of the agents, if all worlds are `ready`.
    fn join(mut world: World, mut halo: H, ready: Result<(), Error>) -> Result<Self, Error> {
        let ready = ready.and_then(|()| refuse(&world.state));
        let any = halo.agree(Agreement { any: ready.is_err(), ..Agreement::default() }).any;
        ready?;
        if any {
            return Err(Error::Undivided { what: "another world has refused its part".into() });
        }
        agree_on_worlds(&mut halo, world.built_for_agents())?;
        let next = world.state.slots.next_number.into();
        let all = halo.agree(Agreement { same: Some((next, next)), ..Agreement::default() });
        world.state.slots.next_number = all.same.map_or(next, |(_, most)| most) as u32;
        world.state.others.are_there = true;
        Ok(Self { world, halo })
    }

    /// Advances all agents of all worlds by one time step.
    pub fn step(&mut self) {
        self.world.step_beside(&mut self.halo, |_| ());
    }

    /// Returns the world with the agents of its ground. Counts and statistics are those of its agents; scheduled agents
    /// count in every world. A clone of it goes on without the other worlds, and [`World::explain`] does not see their
    /// agents.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Returns the halo.
    pub fn halo(&self) -> &H {
        &self.halo
    }

    /// Returns the halo, to change the division of the ground between two steps.
    pub fn halo_mut(&mut self) -> &mut H {
        &mut self.halo
    }

    /// Whether all worlds are [finished](World::finished).
    pub fn finished(&mut self) -> bool {
        let goes_on = !self.world.finished();
        !self.any(goes_on)
    }

    /// Whether a flag is set in any world.
    pub fn any(&mut self, flag: bool) -> bool {
        self.halo.agree(Agreement { any: flag, ..Agreement::default() }).any
    }

    /// Returns the [counts](World::counts) of all worlds.
    pub fn counts(&mut self) -> Counts {
        let own = self.world.counts();
        let Hindered { queueing, waiting_for_room, blocked, oscillating } = own.hindered;
        let scheduled = own.agents - own.present - own.removed;
        let numbers = [own.arrived, own.removed, own.present, queueing, waiting_for_room, blocked, oscillating];
        let all = self.sums((0..).zip(numbers.map(|number| number as i64)).collect());
        let [arrived, removed, present, queueing, waiting_for_room, blocked, oscillating] =
            std::array::from_fn(|index| all.get(&(index as u32)).map_or(0, |&sum| sum as usize));
        let hindered = Hindered { queueing, waiting_for_room, blocked, oscillating };
        Counts { agents: present + removed + scheduled, arrived, removed, present, hindered }
    }

    /// Returns the [summary](World::summary) of all worlds: that of the undivided world. But the least separation is known only
    /// of agents that could touch.
    pub fn summary(&mut self) -> Summary {
        let mut all = self.world.state.totals();
        let mut own = Vec::new();
        write(&mut own, &all);
        let index = self.halo.index();
        let packet = |world| if world == index { Vec::new() } else { own.clone() };
        let packets = (0..self.halo.worlds()).map(packet).collect();
        for packet in self.halo.exchange(packets).iter().filter(|packet| !packet.is_empty()) {
            all.merge(&postcard::from_bytes(packet).expect(BROKEN));
        }
        self.world.summary_of(&all)
    }

    /// Returns the [hash of the state](World::state_hash) of the undivided world.
    pub fn state_hash(&mut self) -> u64 {
        let own = self.world.state.hash_of_agents();
        // the halves, because sums of counts must not overflow
        let halves = [(0, (own & 0xffff_ffff) as i64), (1, (own >> 32) as i64)];
        let all = self.sums(halves.into());
        let half = |index| all.get(&index).map_or(0, |&sum| sum as u64);
        self.world.hash_with(half(0).wrapping_add(half(1) << 32))
    }

    /// Returns cuts that give all worlds the same cost. `seconds` is what steps since the last division have cost this world,
    /// without the time in which it waited for others. Agents of a world cost the same.
    pub fn balanced(&mut self, seconds: f64) -> Cuts {
        let places = &self.world.state.agents.position;
        let (low, high) = places
            .iter()
            .fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), &place| (low.min(place), high.max(place)));
        let ends = |corner: Vec2| corner.as_dvec2().to_array();
        let all = self.halo.agree(Agreement { low: ends(low), high: ends(high), ..Agreement::default() });
        let [low, high] = [all.low, all.high].map(|corner| Vec2::from_array(corner.map(|x| x as f32)));
        let mut load = Load::within(low, high);
        let cost = 1 + (seconds.max(0.0) * 1e9 / places.len().max(1) as f64) as u64;
        places.iter().for_each(|&place| load.add(place, cost));
        let own = load.clone().cells().into_iter().map(|(cell, load)| (cell, load as i64)).collect();
        let all = self.sums(own).into_iter().map(|(cell, load)| (cell, load as u64)).collect();
        Cuts::balanced(self.halo.worlds(), &load.with(all))
    }

    /// Returns sums over all worlds, by index.
    fn sums(&mut self, counts: BTreeMap<u32, i64>) -> BTreeMap<u32, i64> {
        self.halo.agree(Agreement { counts, ..Agreement::default() }).counts
    }

    /// Tells behaviours of something that happened, as [`World::notify`] does. All worlds call it.
    ///
    /// # Errors
    /// Those of [`World::notify`].
    pub fn notify(&mut self, place: impl Into<Position>, time: f64) -> Result<(), Error> {
        self.world.notify(place, time)
    }

    /// Adds an obstacle in all worlds, as [`World::add_obstacle`] does.
    ///
    /// # Errors
    /// Those of [`World::add_obstacle`]; [`Error::Undivided`] if another world refuses the obstacle. Then no world changes.
    pub fn add_obstacle(&mut self, obstacle: Obstacle) -> Result<ObstacleId, Error> {
        self.agree_on(&obstacle)?;
        self.world.add_obstacle(obstacle)
    }

    /// Gives an obstacle another shape or place in all worlds, as [`World::set_obstacle`] does.
    ///
    /// # Errors
    /// Those of [`add_obstacle`](Self::add_obstacle), and [`Error::Unknown`] for an obstacle that does not exist.
    pub fn set_obstacle(&mut self, id: ObstacleId, obstacle: Obstacle) -> Result<(), Error> {
        self.agree_on(&obstacle)?;
        self.world.set_obstacle(id, obstacle)
    }

    /// Removes an obstacle in all worlds. Returns false if it does not exist.
    pub fn remove_obstacle(&mut self, id: ObstacleId) -> bool {
        self.world.remove_obstacle(id)
    }

    /// Checks an obstacle in all worlds.
    fn agree_on(&mut self, obstacle: &Obstacle) -> Result<(), Error> {
        let own = self.world.check_shared_obstacle(obstacle);
        let any = own.is_err();
        if self.halo.agree(Agreement { any, ..Agreement::default() }).any {
            own?;
            return Err(Error::Undivided { what: "another world has refused the obstacle".into() });
        }
        Ok(())
    }
}

/// Returns an error unless all worlds were built in the same way, by a hash of what they were built with.
fn agree_on_worlds(halo: &mut impl Halo, built: u64) -> Result<(), Error> {
    let all = halo.agree(Agreement { same: Some((built, built)), ..Agreement::default() });
    let differ = || Error::Undivided { what: "the worlds differ: build all of them in the same way".into() };
    all.same.is_none_or(|(least, greatest)| least == greatest).then_some(()).ok_or_else(differ)
}
