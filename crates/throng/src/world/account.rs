//! Why those who are asked go where they go, told in every step: as data that pictures can draw.

use super::World;
use crate::agent::Memory;
use crate::steer::{Reason, Told};
use glam::Vec3;
use std::f32::consts::PI;

/// Who tells why they go where they go.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Asked {
    /// Nobody: telling costs nothing.
    #[default]
    Nobody,
    /// Everybody.
    Everybody,
    /// Those with these numbers.
    Numbers(Vec<u32>),
}

impl Asked {
    /// Whether this one is asked.
    pub fn holds(&self, number: u32) -> bool {
        match self {
            Self::Nobody => false,
            Self::Everybody => true,
            Self::Numbers(numbers) => numbers.contains(&number),
        }
    }

    pub(super) fn anybody(&self) -> bool {
        *self != Self::Nobody
    }
}

/// What an agent would like, and why. Metres and seconds; places are relative to
/// [`Settings::origin`](crate::Settings::origin).
#[derive(Clone, Debug, PartialEq)]
pub struct Account {
    /// The agent's own number.
    pub number: u32,
    /// Its steering force over its mass, m/s²; zero of who does not steer.
    pub steering: Vec3,
    /// The velocity it would like, m/s.
    pub preferred: Vec3,
    /// What led to it: what its behaviour tells; of who does not steer, where its way leads and whom it sees.
    pub told: Vec<Told>,
}

impl World {
    /// Lets agents tell why they go where they go in every step from now on, beside what they do: nothing else changes.
    ///
    /// ```
    /// use glam::Vec3;
    /// use throng::steer::{Reason, Seek, Target};
    /// use throng::{Agent, Asked, Group, Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// let seek = Seek { target: Target::Point(Vec3::X * 9.0) };
    /// let group = world.add_group(Group { steering: Some(seek.into()), ..Group::default() })?;
    /// world.add_agent(Agent { group, number: Some(7), ..Agent::default() })?;
    /// world.ask(Asked::Everybody);
    /// world.step();
    /// let account = &world.accounts()[0];
    /// assert_eq!((account.number, account.told[0].reason), (7, Reason::Aim(Vec3::X * 9.0)));
    /// assert!(account.steering.x > 0.0 && account.preferred.x > 0.0);
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn ask(&mut self, whom: Asked) {
        self.asked = whom;
        self.step.accounts.clear();
    }

    /// What those who were [asked](Self::ask) told in the last sub-step, by number.
    pub fn accounts(&self) -> &[Account] {
        &self.step.accounts
    }

    /// Lets those who are asked tell of the sub-step that ends at `now`. `memory` is what behaviours remembered before it.
    pub(super) fn account(&mut self, memory: Option<Memory>, seconds: f32, now: f64) {
        let Some(memory) = memory else { return };
        let after = std::mem::replace(&mut self.agents.memory, memory);
        let asked = (0..self.agents.len()).filter(|&row| self.asked.holds(self.agents.number[row]));
        let mut accounts: Vec<Account> = asked.map(|row| self.account_of(row, seconds, now)).collect();
        accounts.sort_unstable_by_key(|account| account.number);
        (self.step.accounts, self.agents.memory) = (accounts, after);
    }

    fn account_of(&self, row: usize, seconds: f32, now: f64) -> Account {
        let (said, told) = self.steering_reasons(row, seconds, now);
        let mass = self.groups[self.agents.group[row].index()].vehicle.mass;
        Account {
            number: self.agents.number[row],
            steering: said.map_or(Vec3::ZERO, |steering| steering.force / mass),
            preferred: self.step.preferred.at(row),
            told: if self.steering(row).is_some() { told } else { self.way_told(row) },
        }
    }

    /// The way of an agent that follows its journey, and whom it sees.
    fn way_told(&self, row: usize) -> Vec<Told> {
        let agents = &self.agents;
        let altitude = agents.altitude[row];
        let local = |corner: glam::DVec2| (corner - self.settings.origin).as_vec2().extend(altitude);
        let corners = agents.travel[row].route().into_iter().flat_map(|route| route.corners());
        let via = corners.map(|corner| Reason::Via(local(corner)));
        let aim = self.steering_goal(row).map(Reason::Aim);
        let distance = self.groups[agents.group[row].index()].neighbour_distance;
        let looks = Reason::Looks { distance, angle: PI };
        let seen = self.neighbours(row).iter().map(|&other| Reason::Regards(agents.number[other as usize]));
        let reasons = via.chain(aim).chain([looks]).chain(seen);
        reasons.map(|reason| Told { depth: 0, reason }).collect()
    }
}
