//! The start positions of agents.

use super::ground::{obstacle_name, short, show};
use super::movers::size;
use super::size::Size;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::{DVec2, DVec3, Solid, Spacing, Touch, bounds, contains, points, rectangle};
use crate::random::{Purpose, Random};
use crate::scene::{Grid, Group, Place, Rectangle, Scene, Sphere};

/// Draws before an agent counts as not fitting: finds the last percent of free ground with near certainty.
const TRIES: usize = 4000;

/// The input of the placement.
pub(super) struct PlacementGround<'a> {
    pub scene: &'a Scene,
    pub solid: &'a Solid,
    pub areas: &'a [throng::Walkable],
    /// For every group, the size of every agent.
    pub sizes: &'a [Vec<Size>],
    /// For every group, the start height of every agent above its place.
    pub altitudes: &'a [Vec<f64>],
    /// For every group, whether it enters through sources.
    pub enters: &'a [bool],
}

impl PlacementGround<'_> {
    /// Returns the start positions of all agents, by group. Given positions are taken first, drawn ones fill what is
    /// left.
    pub fn place(&self) -> Result<Vec<Vec<DVec3>>, Problem> {
        let groups = &self.scene.groups;
        let sizes = self.sizes.iter().flatten().copied().chain(self.scene.movers.iter().map(size));
        let largest = sizes.fold(0.0_f64, |most, size| most.max(size.bound));
        let gap = groups.iter().fold(0.0_f64, |most, group| most.max(gap(&group.place)));
        // given positions need room for the clearance radius only, drawn ones for the bounding radius: the body may
        // turn there
        let mut given_spots = Spacing::new(2.0 * largest);
        let mut spacing = Spacing::new(2.0 * largest + gap);
        let mut starts = vec![vec![]; groups.len()];
        let (given, drawn): (Vec<_>, Vec<_>) = (0..groups.len()).partition(|i| is_given(&groups[*i].place));
        for i in given {
            starts[i] = self.given(i, &mut given_spots)?;
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

    /// Returns positions that the scene gives.
    fn given(&self, i: usize, spacing: &mut Spacing) -> Result<Vec<DVec3>, Problem> {
        let group = &self.scene.groups[i];
        let path = Path::of("group").index(i).key("place");
        let n = self.sizes[i].len();
        let above = |k: usize| DVec3::Z * self.altitudes[i][k];
        let spots: Vec<DVec3> = (0..n).map(|k| spot(&group.place, k, n) + above(k)).collect();
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
        let group = &self.scene.groups[i];
        let path = Path::of("group").index(i).key("place");
        let shape = Drawn::new(&group.place, self.areas, &path)?;
        let gap = gap(&group.place);
        let mut spots = Vec::with_capacity(self.sizes[i].len());
        for (k, size) in self.sizes[i].iter().enumerate() {
            let (radius, altitude) = (size.bound, self.altitudes[i][k]);
            let mut random = Random::new(self.scene.seed, i as u64, k as u64, Purpose::Place);
            let found = (0..TRIES).map(|_| shape.draw(&mut random)).find(|p| {
                shape.contains(*p)
                    && (self.enters[i] || spacing.too_near(p.extend(altitude), radius, gap).is_none())
                    && self.solid.fits(*p, radius)
            });
            let Some(p) = found.map(|p| p.extend(altitude)) else {
                let named = Group::name_at(&group.name, i);
                let message = format!("group `{named}`: only {k} of {} agents fit into its place", self.sizes[i].len());
                return Err(Problem::new(&path, Kind::NoRoom, message)
                    .hint("make the place larger, or use fewer agents, a smaller body.radius or a smaller gap"));
            };
            if !self.enters[i] {
                spacing.add(p, radius, self.number(i, k) as u32);
            }
            spots.push(p);
        }
        Ok(spots)
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

fn is_given(place: &Place) -> bool {
    use Place::{Grid, Line, Point, Points, Ring, Sphere};
    matches!(place, Point(_) | Points(_) | Line(_) | Ring(_) | Sphere(_) | Grid(_))
}

fn gap(place: &Place) -> f64 {
    match place {
        Place::Disc(place) => place.gap,
        Place::Rectangle(place) => place.gap,
        Place::Polygon(place) => place.gap,
        Place::Walkable(place) => place.gap,
        _ => 0.0,
    }
}

/// The centre of a place, and its altitude; `None`: each agent's own altitude.
#[derive(Clone, Copy, Debug)]
pub(super) struct Middle {
    pub at: DVec2,
    pub altitude: Option<f64>,
}

/// Returns the centre of a place.
pub(super) fn middle(place: &Place, starts: &[DVec3]) -> Middle {
    let mut altitude = None;
    let at = match place {
        Place::Sphere(sphere) => {
            altitude = Some(sphere.center[2]);
            DVec3::from_array(sphere.center).truncate()
        }
        Place::Ring(ring) => DVec2::from_array(ring.center),
        Place::Grid(grid) => DVec2::from_array(grid.center),
        Place::Disc(disc) => DVec2::from_array(disc.center),
        Place::Rectangle(r) => DVec2::from_array(r.center),
        Place::Line(line) => DVec2::from_array(line.from).lerp(DVec2::from_array(line.to), 0.5),
        _ => bounds(starts.iter().map(|start| start.truncate())).map_or(DVec2::ZERO, |[low, high]| (low + high) * 0.5),
    };
    Middle { at, altitude }
}

/// Returns the k-th of n positions. If there are more agents than positions (with sources), they take them in turn.
fn spot(place: &Place, k: usize, n: usize) -> DVec3 {
    let level = match place {
        Place::Sphere(sphere) => return sphere_spot(sphere, k, n),
        Place::Point(point) => DVec2::from_array(*point),
        Place::Points(points) => points.get(k % points.len().max(1)).map_or(DVec2::ZERO, |p| DVec2::from_array(*p)),
        Place::Line(line) => {
            let t = if n > 1 { k as f64 / (n - 1) as f64 } else { 0.5 };
            DVec2::from_array(line.from).lerp(DVec2::from_array(line.to), t)
        }
        Place::Ring(ring) => {
            let angle = ring.start.to_radians() + std::f64::consts::TAU * k as f64 / n as f64;
            let (sin, cos) = libm::sincos(angle);
            DVec2::from_array(ring.center) + ring.radius * DVec2::new(cos, sin)
        }
        Place::Grid(grid) => grid_spot(grid, k as u64 % (grid.columns * grid.rows).max(1)),
        _ => DVec2::ZERO,
    };
    level.extend(0.0)
}

/// Returns positions at even heights, each a golden angle on from the one before.
fn sphere_spot(sphere: &Sphere, k: usize, n: usize) -> DVec3 {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let z = 1.0 - (2 * k + 1) as f64 / n as f64;
    let (sin, cos) = libm::sincos(golden * k as f64);
    let around = (DVec2::new(cos, sin) * (1.0 - z * z).sqrt()).extend(z);
    DVec3::from_array(sphere.center) + around * sphere.radius
}

fn grid_spot(grid: &Grid, k: u64) -> DVec2 {
    let along = |k: u64, n: u64| (k as f64 - (n - 1) as f64 * 0.5) * grid.spacing;
    let (x, y) = (along(k % grid.columns, grid.columns), along(k / grid.columns, grid.rows));
    let (sin, cos) = libm::sincos(grid.rotation.to_radians());
    DVec2::from_array(grid.center) + DVec2::new(cos * x - sin * y, sin * x + cos * y)
}

/// A shape in which positions are drawn.
enum Drawn {
    Disc(DVec2, f64),
    /// A corner and the two sides from it.
    Parallelogram(DVec2, DVec2, DVec2),
    Polygon(Vec<DVec2>, [DVec2; 2]),
    Box([DVec2; 2]),
}

impl Drawn {
    fn new(place: &Place, areas: &[throng::Walkable], path: &Path) -> Result<Self, Problem> {
        Ok(match place {
            Place::Disc(disc) => Self::Disc(DVec2::from_array(disc.center), disc.radius),
            Place::Rectangle(r) => {
                let c = rectangle(&Rectangle { center: r.center, size: r.size, rotation: r.rotation });
                Self::Parallelogram(c[0], c[1] - c[0], c[3] - c[0])
            }
            Place::Polygon(polygon) => {
                let corners = points(&polygon.corners);
                let box_ = bounds(corners.iter().copied()).unwrap_or_default();
                Self::Polygon(corners, box_)
            }
            _ => {
                let Some(box_) = bounds(areas.iter().flat_map(|area| area.outer.iter().copied())) else {
                    return Err(Problem::new(path, Kind::MissingKey, "place.walkable needs walkable ground")
                        .hint("add a `walkable` to the scene, or use place.rectangle"));
                };
                Self::Box(box_)
            }
        })
    }

    fn draw(&self, random: &mut Random) -> DVec2 {
        let (a, b) = (random.unit(), random.unit());
        match self {
            Self::Disc(center, radius) => {
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * a);
                *center + radius * libm::sqrt(b) * DVec2::new(cos, sin)
            }
            Self::Parallelogram(corner, u, v) => *corner + a * *u + b * *v,
            Self::Polygon(_, [low, high]) | Self::Box([low, high]) => *low + (*high - *low) * DVec2::new(a, b),
        }
    }

    fn contains(&self, p: DVec2) -> bool {
        match self {
            Self::Polygon(corners, _) => contains(corners, p),
            _ => true,
        }
    }
}
