//! A world of a division.

use super::refuse::refuse;
use super::{Agreement, Halo};
use crate::agent::ObstacleId;
use crate::{Error, Obstacle, World};

/// One of several worlds that step one crowd together, with the bits of one world.
///
/// Every world is built in the same way: with the whole crowd for [`new`](Self::new), which keeps the agents on the
/// ground that the [`Halo`] gives to this world, or with a part of the crowd for [`of_part`](Self::of_part). Agents that walk to the ground of another world move there at the start of a step:
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
        if !agrees(&mut halo, world.built()) {
            return Err(Error::Undivided { what: "the worlds differ: build all of them in the same way".into() });
        }
        world.keep_own(|place| halo.owner(place) == halo.index(), halo.index() == 0);
        Ok(Self { world, halo })
    }

    /// Returns the world of a part of the crowd, from a world to which only this part has been added. Each agent of the
    /// crowd is in one of the worlds, with a [number](crate::Agent::number) that no other agent has, and a journey that
    /// all worlds have. All else that the worlds are built with is the same in all of them. Agents on the ground of other
    /// worlds move there at the start of the first step.
    ///
    /// # Errors
    /// Those of [`new`](Self::new), in all worlds if in any.
    pub fn of_part(mut world: World, mut halo: H) -> Result<Self, Error> {
        let refused = refuse(&world.state);
        let any = refused.is_err();
        if halo.agree(Agreement { any, ..Agreement::default() }).any {
            refused?;
            return Err(Error::Undivided { what: "another world has a crowd that cannot be divided".into() });
        }
        if !agrees(&mut halo, world.built_around_agents()) {
            return Err(Error::Undivided { what: "the worlds differ in more than their agents".into() });
        }
        let next = world.next_number();
        let all = halo.agree(Agreement { same: Some((next, next)), ..Agreement::default() });
        world.be_part(all.same.map_or(next, |(_, most)| most));
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
        let any = !self.world.finished();
        !self.halo.agree(Agreement { any, ..Agreement::default() }).any
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

/// Whether a value is the same in all worlds.
fn agrees(halo: &mut impl Halo, value: u64) -> bool {
    let all = halo.agree(Agreement { same: Some((value, value)), ..Agreement::default() });
    all.same.is_none_or(|(least, greatest)| least == greatest)
}
