//! Figures of a swarm: distributions of speeds, accelerations and distances, the persistence of velocities, and the
//! size.
//!
//! The figures are those of Kelley and Ouellette, *Emergent dynamics of laboratory insect swarms*, Sci. Rep. 3:1073
//! (2013), and of Puckett, Kelley and Ouellette, *Searching for effective forces in laboratory insect swarms*, Sci.
//! Rep. 4:4766 (2014), computed from positions over time. `docs/swarms.md` lists their results.
//!
//! | figure | what | unit |
//! |---|---|---|
//! | velocity | of an agent present in three consecutive frames, at the middle frame: displacement from the first to the third over the time between them | m/s |
//! | acceleration | of the same agents: change from the velocity of the first interval to that of the second, over half the time | m/s² |
//! | nearest | distance to the centre of the nearest other agent, in space, of all agents in every frame | m |
//! | correlation | autocorrelation of velocities: [`Correlation`] | |
//! | size | root mean square distance from the centroid, along each axis and in all: the radius of gyration | m |
//! | polarisation | length of the mean direction of flight: 1 if all agents fly in one direction, about `1/sqrt(N)` for random directions | |

mod correlation;
mod distribution;

pub use correlation::Correlation;
pub use distribution::Distribution;

use crate::Frame;
use glam::{DVec3, Vec2};
use throng::perceive::{Grid, Near};

/// A swarm at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwarmMoment {
    /// Seconds.
    pub time: f64,
    /// Number of agents.
    pub count: usize,
    /// Mean position.
    pub centroid: DVec3,
    /// Root mean square distance from the centroid along each axis, metres.
    pub axes: DVec3,
    /// Length of the mean direction; NaN in the first and the last frame.
    pub polarisation: f64,
    /// Mean speed, m/s; NaN in the first and the last frame.
    pub speed: f64,
}

impl SwarmMoment {
    /// Returns the radius of gyration, metres.
    pub fn size(&self) -> f64 {
        self.axes.length()
    }
}

/// The figures of a swarm, computed incrementally. The [module](self) defines them.
///
/// ```
/// use glam::DVec3;
/// use throng_record::swarm::Swarm;
/// let mut swarm = Swarm::new(2.0);
/// for k in 0..100 {
///     let time = f64::from(k) * 0.1;
///     swarm.push(time, &[(0, DVec3::X * time), (1, DVec3::new(2.0 * time, 0.0, 3.0))]);
/// }
/// assert!((swarm.speed().mean() - 1.5).abs() < 1e-9 && swarm.acceleration()[0].rms() < 1e-9);
/// assert_eq!(swarm.nearest().least(), 3.0);
/// assert!((swarm.moments()[5].polarisation - 1.0).abs() < 1e-9);
/// ```
#[derive(Clone, Debug)]
pub struct Swarm {
    moments: Vec<SwarmMoment>,
    /// The last two frames, latest first: the time, and the positions by number.
    before: [(f64, Vec<(u32, DVec3)>); 2],
    velocities: Vec<(u32, DVec3)>,
    speed: Distribution,
    velocity: [Distribution; 3],
    acceleration: [Distribution; 3],
    nearest: Distribution,
    correlation: Correlation,
    search: SwarmSearch,
}

/// Memory of the nearest-neighbour search.
#[derive(Clone, Debug, Default)]
struct SwarmSearch {
    grid: Grid,
    points: Vec<Vec2>,
    numbers: Vec<u32>,
    found: Vec<Near>,
}

impl Swarm {
    /// Creates empty figures. `longest` is the longest lag of the velocity correlation, seconds.
    pub fn new(longest: f64) -> Self {
        Self {
            moments: Vec::new(),
            before: Default::default(),
            velocities: Vec::new(),
            speed: Distribution::default(),
            velocity: Default::default(),
            acceleration: Default::default(),
            nearest: Distribution::default(),
            correlation: Correlation::new(longest),
            search: SwarmSearch::default(),
        }
    }

    /// Adds the positions of a group in the next frame.
    pub fn push_frame(&mut self, frame: &Frame, group: u32) {
        let members = frame.bodies.iter().filter(|body| body.group == group);
        let places: Vec<(u32, DVec3)> = members.map(|body| (body.number, body.center())).collect();
        self.push(frame.time, &places);
    }

    /// Adds the next frame: seconds, and positions in metres by number, ascending. A frame that is not later than the
    /// last one, and positions that are not finite, are ignored.
    pub fn push(&mut self, time: f64, places: &[(u32, DVec3)]) {
        let is_later = self.moments.last().is_none_or(|last| time > last.time);
        if !is_later || !time.is_finite() {
            return;
        }
        let now: Vec<(u32, DVec3)> = places.iter().copied().filter(|(_, place)| place.is_finite()).collect();
        self.spread(time, &now);
        self.distances(&now);
        if self.moments.len() > 2 {
            self.differentiate(time, &now);
        }
        self.before.swap(0, 1);
        self.before[0] = (time, now);
    }

    fn spread(&mut self, time: f64, now: &[(u32, DVec3)]) {
        let n = now.len() as f64;
        let centroid = now.iter().map(|&(_, place)| place).sum::<DVec3>() / n;
        let squares = now.iter().map(|&(_, place)| (place - centroid) * (place - centroid)).sum::<DVec3>() / n;
        let axes = DVec3::from_array(squares.to_array().map(f64::sqrt));
        let (polarisation, speed) = (f64::NAN, f64::NAN);
        self.moments.push(SwarmMoment { time, count: now.len(), centroid, axes, polarisation, speed });
    }

    fn distances(&mut self, now: &[(u32, DVec3)]) {
        let Some(middle) = self.moments.last().map(|moment| moment.centroid) else { return };
        let SwarmSearch { grid, points, numbers, found } = &mut self.search;
        points.clear();
        points.extend(now.iter().map(|&(_, place)| (place - middle).truncate().as_vec2()));
        numbers.clear();
        numbers.extend(0..now.len() as u32);
        grid.rebuild(points, numbers, f32::MAX);
        for (row, &(_, place)) in now.iter().enumerate() {
            let accept = |near: &mut Near| {
                let above = (now[near.row as usize].1.z - place.z) as f32;
                near.distance_squared += above * above;
                near.row as usize != row
            };
            grid.nearest(points[row], 1, f32::INFINITY, accept, found);
            found.iter().for_each(|near| self.nearest.add(now[near.row as usize].1.distance(place)));
        }
    }

    /// Computes velocities and accelerations of the frame before `now`.
    fn differentiate(&mut self, time: f64, now: &[(u32, DVec3)]) {
        let [(middle, then), (start, first)] = &self.before;
        let (early, late) = (middle - start, time - middle);
        let velocities = &mut self.velocities;
        velocities.clear();
        let (mut directions, mut speeds) = (DVec3::ZERO, 0.0);
        let mut started = first.iter().copied().peekable();
        for ((number, place), next) in numbered(then, now) {
            while started.next_if(|&(other, _)| other < number).is_some() {}
            let Some(&(other, last)) = started.peek() else { break };
            if other != number {
                continue;
            }
            let velocity = (next - last) / (early + late);
            let acceleration = ((next - place) / late - (place - last) / early) / (0.5 * (early + late));
            velocities.push((number, velocity));
            self.speed.add(velocity.length());
            for axis in 0..3 {
                self.velocity[axis].add(velocity[axis]);
                self.acceleration[axis].add(acceleration[axis]);
            }
            directions += velocity.normalize_or_zero();
            speeds += velocity.length();
        }
        let n = velocities.len() as f64;
        let at = self.moments.len() - 2;
        (self.moments[at].polarisation, self.moments[at].speed) = (directions.length() / n, speeds / n);
        self.correlation.push(early, velocities);
    }

    /// Returns the swarm in every frame.
    pub fn moments(&self) -> &[SwarmMoment] {
        &self.moments
    }

    /// Returns the distribution of speeds, m/s.
    pub fn speed(&self) -> &Distribution {
        &self.speed
    }

    /// Returns the distributions of velocities along x, y and z, m/s.
    pub fn velocity(&self) -> &[Distribution; 3] {
        &self.velocity
    }

    /// Returns the distributions of accelerations along x, y and z, m/s².
    pub fn acceleration(&self) -> &[Distribution; 3] {
        &self.acceleration
    }

    /// Returns the distribution of distances to the nearest other agent, metres.
    pub fn nearest(&self) -> &Distribution {
        &self.nearest
    }

    /// Returns the autocorrelation of velocities.
    pub fn correlation(&self) -> &Correlation {
        &self.correlation
    }
}

/// Returns the values of agents that are in both lists, which are sorted by number.
fn both<'a, T: Copy>(a: &'a [(u32, T)], b: &'a [(u32, T)]) -> impl Iterator<Item = (T, T)> + 'a {
    numbered(a, b).map(|((_, first), second)| (first, second))
}

/// Returns the values of agents that are in both lists, with their numbers.
fn numbered<'a, T: Copy>(a: &'a [(u32, T)], b: &'a [(u32, T)]) -> impl Iterator<Item = ((u32, T), T)> + 'a {
    let mut others = b.iter().copied().peekable();
    a.iter().filter_map(move |&(number, value)| {
        while others.next_if(|&(other, _)| other < number).is_some() {}
        others.peek().filter(|&&(other, _)| other == number).map(|&(_, other)| ((number, value), other))
    })
}

#[cfg(test)]
mod tests;
