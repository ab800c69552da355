//! Standing places in a goal area: a hexagonal lattice of places, each with its depth.
//!
//! The depth of a place is its distance, along paths inside the area, from the part of the border through which the
//! area can be entered. If agents fill an area from its greatest depth, they never block its entrance. The lattice has
//! two levels. A third of its places is comfortable: a body's width is free between two bodies. All places together
//! leave 15 % of a body's width between two bodies.

use super::meshes::nearest_on_ring;
use crate::space::is_inside;
use glam::DVec2;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Distance of neighbouring places, in radii: the distance of a hole of a triangular lattice of spacing 4 from its
/// points.
pub(crate) const SPACING: f64 = 2.309_401_076_758_503;
/// Distance of places from the border of the area, in radii, so that a small push does not move an agent out.
const INSET: f64 = 0.5;
/// Distance of the points of the border that are tested for being open, in radii.
const BORDER_STEP: f64 = 0.25;
/// Maximum number of points of the border that are tested.
const MOST_BORDER: f64 = 4096.0;
/// Number of offsets of the lattice across the rows that are tried: the offset with most places is used.
const PHASES: u32 = 4;
/// Maximum number of points of the finer grid that is searched when the lattice is full.
const MOST_CRANNIES: usize = 4096;

const STEPS: [(i32, i32); 6] = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)];

/// A place to stand at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StandingPlace {
    /// World coordinates.
    pub at: DVec2,
    /// Metres from the open part of the border, along paths inside the area.
    pub depth: f64,
    /// Whether the place belongs to the comfortable third.
    pub comfortable: bool,
}

/// The standing places in a goal area, for bodies of one radius.
#[derive(Clone, Debug)]
pub(crate) struct StandingPlaces {
    places: Vec<StandingPlace>,
    /// A finer grid of points, searched when the lattice is full.
    crannies: Vec<DVec2>,
    comfortable: usize,
}

/// A coordinate frame along the longest edge of the area.
struct Frame {
    origin: DVec2,
    along: DVec2,
    across: DVec2,
    low: DVec2,
    high: DVec2,
}

impl Frame {
    fn of(corners: &[DVec2]) -> Self {
        let edges = corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&a, &b)| b - a);
        let longest = edges.fold(
            DVec2::ZERO,
            |long, edge| {
                if edge.length_squared() > long.length_squared() { edge } else { long }
            },
        );
        let along = longest.normalize_or(DVec2::X);
        let (origin, across) = (corners[0], along.perp());
        let own = |p: DVec2| DVec2::new((p - origin).dot(along), (p - origin).dot(across));
        let (low, high) = corners
            .iter()
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), &p| (low.min(own(p)), high.max(own(p))));
        Self { origin, along, across, low, high }
    }

    fn world(&self, p: DVec2) -> DVec2 {
        self.origin + self.along * p.x + self.across * p.y
    }

    fn size(&self) -> DVec2 {
        self.high - self.low
    }
}

impl StandingPlaces {
    /// Creates the places in the polygon `corners` for bodies of a radius. `has_room` returns whether a body can stand
    /// at a point. The spacing is widened so that there are at most about `most` places.
    pub fn new(corners: &[DVec2], radius: f64, most: usize, has_room: impl Fn(DVec2) -> bool) -> Self {
        let frame = Frame::of(corners);
        let widest = frame.size().x * frame.size().y;
        let spacing = (SPACING * radius).max((widest / (0.866 * most as f64)).sqrt());
        let inset = |p: DVec2, least: f64| is_inside(corners, p) && nearest_on_ring(corners, p).distance(p) >= least;
        let lattice = |least: f64| {
            let phases = (0..PHASES).map(|phase| {
                let shift = f64::from(phase) / f64::from(PHASES);
                HexLattice::new(&frame, spacing, shift, |p| inset(p, least) && has_room(p))
            });
            phases.reduce(|best, next| if next.count > best.count { next } else { best })
        };
        let lattice = lattice(INSET * radius).filter(|lattice| lattice.count > 0).or_else(|| lattice(0.0));
        let Some(lattice) = lattice else { return Self { places: vec![], crannies: vec![], comfortable: 0 } };
        let border = |p: DVec2| nearest_on_ring(corners, p).distance(p);
        let places = lattice.places(&openings(corners, radius, &has_room), border, &has_room);
        let step = 0.5 * radius;
        let counts = (frame.size() / step).floor() + 1.0;
        let crannies = if counts.x * counts.y <= MOST_CRANNIES as f64 && !places.is_empty() {
            let points = (0..(counts.x * counts.y) as usize).map(|k| {
                let (column, row) = (k % counts.x as usize, k / counts.x as usize);
                frame.world(frame.low + DVec2::new(column as f64, row as f64) * step)
            });
            points.filter(|&p| inset(p, INSET * radius) && has_room(p)).collect()
        } else {
            vec![]
        };
        let comfortable = places.iter().filter(|place| place.comfortable).count();
        Self { places, crannies, comfortable }
    }

    /// Whether no body can stand in the area.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// Returns a place for an agent at `from`, deeper than `least`: the deepest free place among the `demand` places
    /// nearest to the agent, else the nearest free place. `None`: no place is free.
    pub fn choose(
        &self,
        from: DVec2,
        least: f64,
        demand: usize,
        is_free: impl Fn(DVec2) -> bool,
    ) -> Option<StandingPlace> {
        let roomy = demand <= self.comfortable;
        let found = roomy.then(|| self.choose_of(from, least, demand, true, &is_free)).flatten();
        let found = found.or_else(|| self.choose_of(from, least, demand, false, &is_free));
        found.or_else(|| {
            let free = self.crannies.iter().copied().filter(|&at| is_free(at));
            let near = |&at: &DVec2| (at.distance_squared(from).to_bits(), at.x.to_bits());
            free.map(|at| StandingPlace { at, depth: self.depth_near(at), comfortable: false })
                .filter(|place| place.depth > least)
                .min_by_key(|place| near(&place.at))
        })
    }

    fn choose_of(
        &self,
        from: DVec2,
        least: f64,
        demand: usize,
        comfortable: bool,
        is_free: &impl Fn(DVec2) -> bool,
    ) -> Option<StandingPlace> {
        let usable = self.places.iter().enumerate().filter(|(_, place)| place.comfortable || !comfortable);
        let mut near: Vec<(u64, usize)> =
            usable.map(|(index, place)| (place.at.distance_squared(from).to_bits(), index)).collect();
        near.sort_unstable();
        let fits = |&&(_, index): &&(u64, usize)| {
            let place = &self.places[index];
            place.depth > least && is_free(place.at)
        };
        let (region, beyond) = near.split_at(demand.min(near.len()));
        // sorted by distance: of places with the same depth the nearest comes last and is taken
        let deepest = region.iter().rev().filter(fits).max_by(|(_, a), (_, b)| {
            let depth = |&index: &usize| self.places[index].depth;
            depth(a).total_cmp(&depth(b))
        });
        deepest.or_else(|| beyond.iter().find(fits)).map(|&(_, index)| self.places[index])
    }

    /// Returns the depth of the place nearest to a point.
    pub fn depth_near(&self, at: DVec2) -> f64 {
        let nearest = self.places.iter().min_by(|a, b| a.at.distance_squared(at).total_cmp(&b.at.distance_squared(at)));
        nearest.map_or(0.0, |place| place.depth)
    }
}

/// Returns points of the border of an area at which a body can stand: there the area can be entered.
fn openings(corners: &[DVec2], radius: f64, has_room: &impl Fn(DVec2) -> bool) -> Vec<DVec2> {
    let edges = || corners.iter().zip(corners.iter().cycle().skip(1));
    let around: f64 = edges().map(|(a, b)| a.distance(*b)).sum();
    let step = (BORDER_STEP * radius).max(around / MOST_BORDER);
    let points = edges().flat_map(|(&a, &b)| {
        let count = (a.distance(b) / step).ceil().max(1.0);
        (0..count as u32).map(move |k| a.lerp(b, f64::from(k) / count))
    });
    points.filter(|&p| has_room(p)).collect()
}

/// A hexagonal lattice of points, by rows.
struct HexLattice {
    spacing: f64,
    columns: i32,
    /// `None`: no body can stand there.
    points: Vec<Option<DVec2>>,
    /// Column of the first point of row 0; each row is sheared by half a column.
    first: i32,
    count: usize,
}

impl HexLattice {
    fn new(frame: &Frame, spacing: f64, shift: f64, fits: impl Fn(DVec2) -> bool) -> Self {
        let height = spacing * 0.75f64.sqrt();
        let size = frame.size();
        let rows = (size.y / height).floor() as i32 + 2;
        // each row begins half a column farther than the row before
        let first = -(rows / 2 + 1);
        let columns = (size.x / spacing).floor() as i32 + 2 - first;
        let mut points = Vec::with_capacity((rows * columns).max(0) as usize);
        for row in 0..rows {
            for column in 0..columns {
                let x = (f64::from(column + first) + 0.5 * f64::from(row) + shift) * spacing;
                let y = (f64::from(row) + shift) * height;
                let p = frame.world(frame.low + DVec2::new(x, y));
                let in_box = x >= 0.0 && x <= size.x && y <= size.y;
                points.push((in_box && fits(p)).then_some(p));
            }
        }
        let count = points.iter().flatten().count();
        Self { spacing, columns, points, first, count }
    }

    fn neighbours(&self, at: usize) -> impl Iterator<Item = usize> + '_ {
        let (column, row) = (at as i32 % self.columns, at as i32 / self.columns);
        STEPS.iter().filter_map(move |&(x, y)| {
            let (column, row) = (column + x, row + y);
            let next = row * self.columns + column;
            ((0..self.columns).contains(&column) && row >= 0 && (next as usize) < self.points.len())
                .then_some(next as usize)
        })
    }

    /// Returns the places with their depths: shortest paths over the lattice from the openings (Dijkstra's algorithm).
    fn places(
        &self,
        openings: &[DVec2],
        border: impl Fn(DVec2) -> f64,
        has_room: &impl Fn(DVec2) -> bool,
    ) -> Vec<StandingPlace> {
        let mut depth = vec![f64::INFINITY; self.points.len()];
        let mut open = BinaryHeap::new();
        let reach = 1.5 * self.spacing;
        let points = self.points.iter().enumerate().filter_map(|(at, p)| Some((at, (*p)?)));
        for (at, p) in points.filter(|&(_, p)| border(p) <= reach) {
            let near = openings.iter().filter(|opening| opening.distance_squared(p) <= reach * reach);
            let near = near.filter(|opening| has_room(opening.midpoint(p))).map(|opening| opening.distance(p));
            depth[at] = near.fold(f64::INFINITY, f64::min);
            if depth[at].is_finite() {
                open.push(Reverse((depth[at].to_bits(), at)));
            }
        }
        let can_be_entered = !open.is_empty();
        while let Some(Reverse((bits, at))) = open.pop() {
            let (here, Some(p)) = (f64::from_bits(bits), self.points[at]) else { continue };
            if here > depth[at] {
                continue;
            }
            for next in self.neighbours(at) {
                let Some(to) = self.points[next] else { continue };
                let there = here + self.spacing;
                if there < depth[next] && has_room(p.midpoint(to)) {
                    depth[next] = there;
                    open.push(Reverse((there.to_bits(), next)));
                }
            }
        }
        let all = self.points.iter().enumerate().filter_map(|(at, p)| {
            let (column, row) = (at as i32 % self.columns + self.first, at as i32 / self.columns);
            let comfortable = (column - row).rem_euclid(3) == 0;
            // in an area that cannot be entered all places have the same depth
            let depth = if can_be_entered { depth[at] } else { 0.0 };
            Some(StandingPlace { at: (*p)?, depth, comfortable })
        });
        all.filter(|place| place.depth.is_finite()).collect()
    }
}
