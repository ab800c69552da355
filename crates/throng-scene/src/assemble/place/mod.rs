//! The start positions of agents.

mod drawn;
mod fixed;

use super::ground::{obstacle_name, short, show};
use super::movers::size;
use super::size::Size;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::{DVec2, DVec3, Solid, Spacing, Touch};
use crate::random::{Purpose, Random};
use crate::registry::ChosenPlacement;
use crate::scene::{Group, Scene};

/// Draws before an agent counts as not fitting: finds the last percent of free ground with near certainty.
const TRIES: usize = 4000;

/// The input of the placement.
pub(super) struct PlacementGround<'a> {
    pub scene: &'a Scene,
    pub solid: &'a Solid,
    /// For every group, its placement.
    pub places: &'a [ChosenPlacement],
    /// For every group, the size of every agent.
    pub sizes: &'a [Vec<Size>],
    /// For every group, the start height of every agent above its place.
    pub altitudes: &'a [Vec<f64>],
    /// For every group, whether it enters through sources.
    pub enters: &'a [bool],
}

impl PlacementGround<'_> {
    /// Returns the start positions of all agents, by group. Fixed positions are taken first, drawn ones fill what is
    /// left.
    pub fn place(&self) -> Result<Vec<Vec<DVec3>>, Problem> {
        let groups = &self.scene.groups;
        let sizes = self.sizes.iter().flatten().copied().chain(self.scene.movers.iter().map(size));
        let largest = sizes.fold(0.0_f64, |most, size| most.max(size.bound));
        let gap = self.places.iter().fold(0.0_f64, |most, place| most.max(place.gap));
        // fixed positions need room for the clearance radius only, drawn ones for the bounding radius: the body may
        // turn there
        let mut fixed_spots = Spacing::new(2.0 * largest);
        let mut spacing = Spacing::new(2.0 * largest + gap);
        let mut starts = vec![vec![]; groups.len()];
        let (drawn, fixed): (Vec<_>, Vec<_>) = (0..groups.len()).partition(|i| self.places[*i].is_drawn);
        for i in fixed {
            starts[i] = self.fixed(i, &mut fixed_spots)?;
            for (k, (spot, size)) in starts[i].iter().zip(&self.sizes[i]).enumerate().filter(|_| !self.enters[i]) {
                spacing.add(*spot, size.bound, self.number(i, k) as u32);
            }
        }
        for mover in &self.scene.movers {
            let at = mover.script.first().map_or(DVec2::ZERO, |first| DVec2::from_array(first.at));
            spacing.add(at.extend(0.0), size(mover).bound, u32::MAX);
        }
        for i in drawn {
            starts[i] = self.drawn(i, &mut spacing)?;
        }
        Ok(starts)
    }

    /// Returns fixed positions.
    fn fixed(&self, i: usize, spacing: &mut Spacing) -> Result<Vec<DVec3>, Problem> {
        let path = Path::of("group").index(i).key("place");
        let n = self.sizes[i].len();
        let mut spots = Vec::with_capacity(n);
        for k in 0..n {
            let Some(spot) = self.places[i].position(k, n, &mut self.random(i, k))? else {
                return Err(self.no_room(&path, i, k).hint("use fewer agents, or a place with more positions"));
            };
            spots.push(spot + DVec3::Z * self.altitudes[i][k]);
        }
        for (k, (spot, size)) in spots.iter().zip(&self.sizes[i]).enumerate() {
            let radius = size.clearance_radius;
            if let Some(touch) = self.solid.touch(spot.truncate(), radius * (1.0 - 1e-6)) {
                return Err(self.in_wall(&path, i, k, spot.truncate(), radius, touch));
            }
            if self.enters[i] {
                continue;
            }
            if let Some((other, distance)) = spacing.too_near(*spot, radius, 0.0) {
                let (a, b) = (self.agent_name(other as usize), self.agent_name(self.number(i, k)));
                let needed = radius + self.radius_of(other as usize);
                let message = if distance == 0.0 {
                    format!("{a} and {b} start at one place, {}", show(spot.truncate()))
                } else {
                    format!(
                        "{a} and {b} overlap: their centres are {} m apart, their bodies need {} m",
                        short(distance),
                        short(needed)
                    )
                };
                return Err(Problem::new(&path, Kind::Overlap, message)
                    .hint("move them apart, make the place larger, or use a smaller body.radius"));
            }
            spacing.add(*spot, radius, self.number(i, k) as u32);
        }
        Ok(spots)
    }

    /// Returns positions that are drawn.
    fn drawn(&self, i: usize, spacing: &mut Spacing) -> Result<Vec<DVec3>, Problem> {
        let path = Path::of("group").index(i).key("place");
        let n = self.sizes[i].len();
        let mut spots = Vec::with_capacity(n);
        for (k, size) in self.sizes[i].iter().enumerate() {
            let Some(spot) = self.draw(i, k, size.bound, spacing)? else {
                return Err(self
                    .no_room(&path, i, k)
                    .hint("make the place larger, or use fewer agents, a smaller body.radius or a smaller gap"));
            };
            if !self.enters[i] {
                spacing.add(spot, size.bound, self.number(i, k) as u32);
            }
            spots.push(spot);
        }
        Ok(spots)
    }

    /// Draws a position that is clear of walls and of the agents before it; `None` if none is found.
    fn draw(&self, i: usize, k: usize, radius: f64, spacing: &Spacing) -> Result<Option<DVec3>, Problem> {
        let place = &self.places[i];
        let mut random = self.random(i, k);
        for _ in 0..TRIES {
            let Some(spot) = place.position(k, self.sizes[i].len(), &mut random)? else { continue };
            let spot = spot + DVec3::Z * self.altitudes[i][k];
            if (self.enters[i] || spacing.too_near(spot, radius, place.gap).is_none())
                && self.solid.fits(spot.truncate(), radius)
            {
                return Ok(Some(spot));
            }
        }
        Ok(None)
    }

    /// Returns the random numbers of the place of an agent.
    fn random(&self, i: usize, k: usize) -> Random {
        Random::new(self.scene.seed, i as u64, k as u64, Purpose::Place)
    }

    fn no_room(&self, path: &Path, i: usize, k: usize) -> Problem {
        let (named, n) = (Group::name_at(&self.scene.groups[i].name, i), self.sizes[i].len());
        let message = format!("group `{named}`: only {k} of {n} agents fit into its place");
        Problem::new(path, Kind::NoRoom, message)
    }

    fn in_wall(&self, path: &Path, i: usize, k: usize, p: DVec2, radius: f64, touch: Touch) -> Problem {
        let agent = self.agent_name(self.number(i, k));
        let obstacle = |o: usize| obstacle_name(&self.scene.obstacles[o].name, o);
        let at = show(p);
        let (message, hint) = match touch {
            Touch::OffGround => {
                (format!("{agent} starts off the walkable ground, at {at}"), "move it onto the ground".to_owned())
            }
            Touch::Inside(o) => {
                (format!("{agent} starts inside {}, at {at}", obstacle(o)), "move it, or the obstacle".to_owned())
            }
            Touch::Edge(distance) => (
                format!(
                    "{agent} starts in a wall: {at} is {} m from it, the body's radius is {}",
                    short(distance),
                    short(radius)
                ),
                format!("move it {} m away from the wall", short(radius - distance + 5e-4)),
            ),
            Touch::Obstacle(o, distance) => (
                format!(
                    "{agent} starts in {}: {at} is {} m from it, the body's radius is {}",
                    obstacle(o),
                    short(distance),
                    short(radius)
                ),
                format!("move it {} m away from the obstacle", short(radius - distance + 5e-4)),
            ),
        };
        Problem::new(path, Kind::InWall, message).hint(hint)
    }

    /// Returns the number of an agent in the whole scene.
    fn number(&self, group: usize, k: usize) -> usize {
        self.sizes[..group].iter().map(Vec::len).sum::<usize>() + k
    }

    /// Returns the group of an agent's number, and the position of the agent in it.
    fn owner(&self, number: usize) -> (usize, usize) {
        let mut rest = number;
        for (i, sizes) in self.sizes.iter().enumerate() {
            if rest < sizes.len() {
                return (i, rest);
            }
            rest -= sizes.len();
        }
        (0, rest)
    }

    fn radius_of(&self, number: usize) -> f64 {
        let (i, k) = self.owner(number);
        self.sizes[i][k].clearance_radius
    }

    fn agent_name(&self, number: usize) -> String {
        let (i, k) = self.owner(number);
        format!("agent {k} of group `{}`", Group::name_at(&self.scene.groups[i].name, i))
    }
}

/// The centre of a place, and its altitude; `None`: each agent's own altitude.
#[derive(Clone, Copy, Debug)]
pub(super) struct Middle {
    pub at: DVec2,
    pub altitude: Option<f64>,
}

impl Middle {
    /// Returns the centre of a place at which agents start.
    pub fn of(place: &ChosenPlacement, starts: &[DVec3]) -> Self {
        let at = place.center.unwrap_or_else(|| {
            let low = starts.iter().copied().reduce(DVec3::min).unwrap_or_default();
            let high = starts.iter().copied().reduce(DVec3::max).unwrap_or_default();
            (low + high) * 0.5
        });
        Self { at: at.truncate(), altitude: place.sets_altitude.then_some(at.z) }
    }
}
