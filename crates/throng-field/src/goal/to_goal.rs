//! Flow to a goal: the route of least cost, from everywhere.

use super::super::cost;
use super::super::eikonal::{Front, backwards, march};
use super::destination::Destination;
use super::limits::WallSpeedLimits;
use super::terrain::{TOUCH, Terrain};
use glam::{DVec2, Vec2, Vec3};
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::parallel;
use throng::space::Wall;

/// Distance from a goal, in cells, within which the flow leads straight to it.
const STRAIGHT: f64 = 3.0;
/// Cosine of the angle between directions below which they belong to different routes: fronts meet between them.
const SAME_WAY: f32 = 0.5;
/// Sum of weights below which the interpolation is unreliable.
const LITTLE: f32 = 1e-3;

/// A flow to the nearest of some goals on a terrain: along the routes of least cost. Every cell stores its direction.
///
/// The directions are the slope of the solution of the eikonal equation (|grad T| = cost), computed by fast marching
/// (Sethian 1996). Treuille, Cooper, Popovic, *Continuum crowds*, 2006, lead crowds in this way. An agent that follows
/// the flow goes round walls, keeps the clearance that the terrain's costs give, and never comes nearer to a wall than
/// the terrain's radius. The velocity is zero where no route leads to a goal, beyond the terrain, and at the goal.
///
/// ```
/// use glam::{DVec2, Vec3};
/// use std::sync::Arc;
/// use throng::field::Field;
/// use throng_field::{Destination, Terrain, TerrainSettings, ToGoal};
/// use throng::space::Place;
/// use throng::Obstacle;
/// // a wall across the room, open at the top
/// let wall = Obstacle::Wall { points: vec![DVec2::new(5.0, -1.0), DVec2::new(5.0, 8.0)] };
/// let place = Place { areas: vec![], obstacles: vec![Some(wall)] };
/// let ground = Terrain::of_place(&place, DVec2::ZERO, TerrainSettings { high: DVec2::splat(10.0), ..TerrainSettings::default() })?;
/// let goal = Destination::Point { at: DVec2::new(8.0, 2.0), tolerance: 0.2 };
/// let flow = ToGoal::new(Arc::new(ground), vec![goal], 1.3)?;
/// let up = flow.velocity(Vec3::new(3.5, 2.0, 0.0), 0.0);
/// assert!(up.y > 1.1, "along the wall: {up}");
/// let seconds = flow.time_to_goal(DVec2::new(3.5, 2.0)).expect("there is a way");
/// assert!(seconds > 12.0 / 1.3);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone)]
pub struct ToGoal {
    terrain: Arc<Terrain>,
    goals: Arc<[Destination]>,
    /// Cells from which fronts start, with the nearest point of the goal that is visible from them.
    starts: Arc<[(u32, DVec2)]>,
    speed: f32,
    slowing: f32,
    /// The cost of a metre in each cell, metres, with the cost of crowds.
    cost: Vec<f32>,
    /// The cost of the route from each cell to the goal, metres; infinite where no route leads there.
    lengths: Vec<f32>,
    /// Unit vectors; zero where no route leads on.
    directions: Vec<Vec2>,
    front: Front,
}

impl ToGoal {
    /// Creates a flow with a speed, m/s, to the nearest of these goals. It slows down within a metre of a point.
    ///
    /// # Errors
    /// A speed that is not greater than 0 and finite; no goals; a goal with values out of their limits, beyond the
    /// terrain, inside an obstacle, or visible from no open cell.
    pub fn new(terrain: Arc<Terrain>, goals: Vec<Destination>, speed: f32) -> Result<Self, Error> {
        Error::unless_positive("speed of a flow to a goal", speed)?;
        let fail = |what: String, why: String| Err(Error::Shape { what, why });
        if goals.is_empty() {
            return fail("the goals of a flow".into(), "there are none".into());
        }
        let mut starts = Vec::new();
        for (index, goal) in goals.iter().enumerate() {
            goal.check()?;
            let before = starts.len();
            goal.starts(&terrain, &mut starts);
            if starts.len() == before {
                let at = goal.place();
                let why = match terrain.cell_at(at) {
                    None => "it is beyond the terrain".into(),
                    Some(cell) if terrain.is_solid(cell) => "it is inside an obstacle".into(),
                    Some(_) => {
                        let (radius, cell) = (terrain.radius, terrain.cell());
                        format!("no nearby cell of {cell} m visible from it has room for a body of radius {radius} m")
                    }
                };
                return fail(format!("goal {} at ({:.3}, {:.3})", index + 1, at.x, at.y), why);
            }
        }
        let count = terrain.cost().len();
        let mut flow = Self {
            terrain,
            goals: goals.into(),
            starts: starts.into(),
            speed,
            slowing: 1.0,
            cost: vec![0.0; count],
            lengths: vec![0.0; count],
            directions: vec![Vec2::ZERO; count],
            front: Front::default(),
        };
        flow.lead(|_| 1.0);
        Ok(flow)
    }

    /// Sets the distance, metres, from a point within which the flow slows down. 0: full speed until it is reached.
    ///
    /// # Errors
    /// A distance that is not at least 0 and finite.
    pub fn slowing(self, slowing: f32) -> Result<Self, Error> {
        let holds = slowing >= 0.0 && slowing.is_finite();
        Error::unless(holds, "slowing distance of a flow to a goal", slowing, "at least 0 and finite")?;
        Ok(Self { slowing, ..self })
    }

    /// Makes the flow lead round crowds: a metre costs `1 + density / weary` times as much, with the density of each
    /// cell in agents a square metre ([`Density`](super::Density)), and `weary` the density at which a metre costs
    /// twice as much. Treuille, Cooper, Popovic 2006 have a similar term, discomfort.
    ///
    /// To keep the flow without crowds, clone it first; the clone shares the terrain and the goals.
    ///
    /// # Errors
    /// A number of densities that is not the number of cells; a density that is not at least 0 and finite; `weary` not
    /// greater than 0 and finite. The flow is unchanged then.
    pub fn avoid_crowds(&mut self, density: &[f32], weary: f32) -> Result<(), Error> {
        Error::unless_positive("density at which ground costs twice as much", weary)?;
        let fail = |why: String| Err(Error::Shape { what: "the density on the terrain".into(), why });
        if density.len() != self.cost.len() {
            return fail(format!("{} densities are given for {} cells", density.len(), self.cost.len()));
        }
        if let Some(cell) = density.iter().position(|&density| !(density >= 0.0 && density.is_finite())) {
            let (at, density) = (self.terrain.middle(cell), density[cell]);
            return fail(format!(
                "the density at ({:.3}, {:.3}) is {density}, but must be at least 0 and finite",
                at.x, at.y
            ));
        }
        self.lead(|cell| 1.0 + density[cell] / weary);
        Ok(())
    }

    /// Returns the same flow led round crowds: see [`avoid_crowds`](Self::avoid_crowds).
    ///
    /// # Errors
    /// As [`avoid_crowds`](Self::avoid_crowds).
    pub fn with_density(&self, density: &[f32], weary: f32) -> Result<Self, Error> {
        let mut flow = self.clone();
        flow.avoid_crowds(density, weary)?;
        Ok(flow)
    }

    /// Computes lengths and directions with the costs of the cells multiplied by a factor.
    fn lead(&mut self, dearer: impl Fn(usize) -> f32) {
        let Self { terrain, starts, cost, lengths, directions, front, .. } = self;
        for (cell, cost) in cost.iter_mut().enumerate() {
            *cost = terrain.cost()[cell] * dearer(cell);
        }
        lengths.fill(f32::INFINITY);
        for &(cell, nearest) in starts.iter() {
            let straight = terrain.straight(terrain.middle(cell as usize), nearest, cost) as f32;
            let length = &mut lengths[cell as usize];
            *length = length.min(straight);
        }
        let first = starts.iter().map(|start| start.0);
        march(&terrain.lattice, (&terrain.links, cost), first, lengths, front);
        parallel::ranges(&mut directions[..], |cells, directions| {
            for (cell, direction) in cells.zip(directions) {
                let way = backwards(&terrain.lattice, (&terrain.links, cost), lengths, cell);
                *direction = Vec2::from(way).normalize_or_zero();
            }
        });
        terrain.lead_out(cost, lengths, directions);
        // close to goals the curvature of the front is too high for differences
        for &(cell, nearest) in starts.iter() {
            let place = terrain.middle(cell as usize);
            if lengths[cell as usize] == terrain.straight(place, nearest, cost) as f32 {
                directions[cell as usize] = (nearest - place).as_vec2().normalize_or_zero();
            }
        }
    }

    /// Returns the terrain of the flow.
    pub fn terrain(&self) -> &Arc<Terrain> {
        &self.terrain
    }

    /// Returns the goals of the flow.
    pub fn goals(&self) -> &[Destination] {
        &self.goals
    }

    /// Returns the speed, m/s.
    pub fn speed(&self) -> f32 {
        self.speed
    }

    /// Returns the cost of the route from the centre of each cell, metres; infinite where no route leads to a goal.
    pub fn lengths(&self) -> &[f32] {
        &self.lengths
    }

    /// Returns the open cells from which no route leads to a goal.
    pub fn unreachable(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.lengths.len()).filter(|&cell| self.terrain.is_open(cell) && self.lengths[cell].is_infinite())
    }

    /// Returns the cost of the route to the nearest goal divided by the speed, seconds; none where no route leads
    /// there.
    pub fn time_to_goal(&self, place: DVec2) -> Option<f32> {
        self.terrain.cell_at(place)?;
        if self.there(place) {
            return Some(0.0);
        }
        let length = match self.in_sight(place, STRAIGHT * self.terrain.cell()) {
            Some((way, _)) => self.terrain.straight(place, place + way, &self.cost) as f32,
            None => self.onwards(place)?.length,
        };
        Some(length / self.speed)
    }

    /// Whether a place counts as being at a goal.
    fn there(&self, place: DVec2) -> bool {
        self.goals.iter().any(|goal| match goal {
            Destination::Point { at, tolerance } => {
                at.distance_squared(place) <= tolerance * tolerance && self.terrain.walls.keep_off((place, *at), TOUCH)
            }
            area => area.nearest(place) == place,
        })
    }

    /// Returns the straight way to the nearest goal that is visible from a place and within `reach` metres, and whether
    /// the goal is a point.
    fn in_sight(&self, place: DVec2, reach: f64) -> Option<(DVec2, bool)> {
        let ways =
            self.goals.iter().map(|goal| (goal.nearest(place) - place, matches!(goal, Destination::Point { .. })));
        let seen = ways.filter(|(way, _)| {
            way.length_squared() < reach * reach && self.terrain.walls.keep_off((place, place + *way), TOUCH)
        });
        seen.min_by(|a, b| a.0.length_squared().total_cmp(&b.0.length_squared()))
    }

    /// Returns the direction and the length of the route at a place, interpolated bilinearly from the surrounding
    /// cells. Cells beyond a wall do not count, nor do cells of a different route.
    fn onwards(&self, place: DVec2) -> Option<Onwards> {
        let around = self.terrain.around(place);
        let middles = around.map(|(cell, _)| self.terrain.middle(cell));
        // no point between the centres is farther from all of them than half a diagonal
        let nearest = around.iter().map(|&(cell, _)| self.terrain.distances()[cell]).fold(f32::INFINITY, f32::min);
        let clear = f64::from(nearest) > 0.708 * self.terrain.cell();
        let sees = |index: usize| clear || self.terrain.walls.keep_off((place, middles[index]), TOUCH);
        let seen: [bool; 4] = std::array::from_fn(sees);
        // cells that are too close to walls count only where no open cell is visible
        let open = around.map(|(cell, _)| self.terrain.is_open(cell));
        let any_open = (0..4).any(|index| seen[index] && open[index]);
        let by: [f32; 4] = std::array::from_fn(|index| {
            let (cell, far) = (around[index].0, place.distance(middles[index]) as f32);
            let counts = seen[index] && (open[index] || !any_open) && self.lengths[cell].is_finite();
            if counts { self.lengths[cell] + self.cost[cell] * far } else { f32::INFINITY }
        });
        let best = (0..4).reduce(|best, index| if by[index] < by[best] { index } else { best })?;
        if by[best].is_infinite() {
            return None;
        }
        let own = self.directions[around[best].0];
        let same = |index: usize| by[index].is_finite() && self.directions[around[index].0].dot(own) >= SAME_WAY;
        let all = (0..4).all(same);
        let (mut direction, mut length, mut sum) = (Vec2::ZERO, 0.0, 0.0);
        for (index, &(cell, part)) in around.iter().enumerate().filter(|&(index, _)| same(index)) {
            // all four weights together also extrapolate on the rim; fewer do not
            let part = if all { part } else { part.max(0.0) };
            let (there, off) = (self.directions[cell], (place - middles[index]).as_vec2());
            direction += there * part;
            length += (self.lengths[cell] - self.cost[cell] * there.dot(off)) * part;
            sum += part;
        }
        if sum < LITTLE {
            (direction, length, sum) = (own, by[best], 1.0);
        }
        let by = (middles[best] - place).as_vec2();
        Some(Onwards { direction: direction.normalize_or_zero(), length: (length / sum).max(0.0), by })
    }

    /// Returns the velocity nearest to `velocity` that leads into no wall. The speed towards a wall closer than a
    /// cell's width is limited in proportion to the gap, to 0 where the body touches the wall.
    fn keep_off(&self, place: DVec2, velocity: DVec2) -> DVec2 {
        let (radius, cell) = (self.terrain.radius, self.terrain.cell());
        let mut limits = WallSpeedLimits::default();
        self.terrain.walls.visit(place, radius + cell, |wall: Wall<'_>| {
            if let (distance, Some(away)) = wall.off(place) {
                let part = ((distance - radius) / cell).clamp(0.0, 1.0);
                limits.add(away, f64::from(self.speed) * part);
            }
        });
        limits.nearest(velocity)
    }
}

impl Field for ToGoal {
    fn velocity(&self, place: Vec3, _: f64) -> Vec3 {
        let place = place.truncate().as_dvec2();
        let Some(cell) = self.terrain.cell_at(place) else { return Vec3::ZERO };
        if self.there(place) {
            return Vec3::ZERO;
        }
        let straight = STRAIGHT * self.terrain.cell();
        let slowing = f64::from(self.slowing);
        let goal = self.in_sight(place, slowing.max(straight));
        let far = goal.map_or(f64::INFINITY, |(way, _)| way.length());
        let speed = match goal {
            Some((_, true)) if far < slowing => self.speed * (far / slowing) as f32,
            _ => self.speed,
        };
        let (direction, by) = match goal {
            Some((way, _)) if far < straight => ((way / far).as_vec2(), Vec2::ZERO),
            _ => match self.onwards(place) {
                Some(Onwards { direction, by, .. }) => (direction, by),
                None => return Vec3::ZERO,
            },
        };
        // walls are nearer to this place than to the cell's centre by less than half a diagonal
        if f64::from(self.terrain.distances()[cell]) > self.terrain.radius + 1.708 * self.terrain.cell() {
            return (direction * speed).extend(0.0);
        }
        let along = |direction: Vec2| self.keep_off(place, (direction * speed).as_dvec2()).as_vec2();
        let velocity = along(direction);
        if velocity.length() >= 0.5 * speed {
            return velocity.extend(0.0);
        }
        // round a corner the interpolated direction leads into the wall: go to the centre of the next cell first
        let other = along(by.normalize_or_zero());
        if other.length() > velocity.length() { other } else { velocity }.extend(0.0)
    }
}

/// How a route continues from a place.
struct Onwards {
    /// A unit vector.
    direction: Vec2,
    /// The cost of the route, metres.
    length: f32,
    /// The offset to the centre of the cell through which the route leads.
    by: Vec2,
}

impl fmt::Debug for ToGoal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ToGoal").field("goals", &self.goals).field("speed", &self.speed).finish_non_exhaustive()
    }
}

impl Terrain {
    /// Returns the cost of a straight way.
    fn straight(&self, from: DVec2, to: DVec2, cost: &[f32]) -> f64 {
        // a goal may be beyond the rim, or too close to a wall
        let there =
            |part: f64| self.cell_at(from.lerp(to, part)).map(|cell| cost[cell]).filter(|cost| cost.is_finite());
        cost::straight(from.distance(to), self.cell(), there)
    }
}
