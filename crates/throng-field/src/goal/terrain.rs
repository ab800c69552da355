//! The ground that routes to goals are searched on: which cells are walkable, how far the walls are, and what a metre
//! costs.

use super::super::cost;
use super::super::eikonal::{Links, NodeLattice};
use super::cover;
use glam::{DVec2, Vec2};
use std::fmt;
use throng::Error;
use throng::parallel;
use throng::space::{NearWalls, Obstacle, Place, Walls};

/// Maximum number of cells of a terrain.
const MOST: usize = 1 << 24;
/// Ways that come closer to a wall than this, metres, touch it.
pub(super) const TOUCH: f64 = 1e-6;
/// Factor of the cost where bodies would reach into walls, so that an agent there takes the shortest way out.
const MARGIN: f32 = 4.0;
/// The box, the cells and the bodies of a [`Terrain`]. Metres, from the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TerrainSettings {
    /// The corner with the least coordinates.
    pub low: DVec2,
    /// The corner with the greatest coordinates; the last cells may reach beyond it.
    pub high: DVec2,
    /// Width of a cell. Routes through gaps wider than two radii and 1.5 cells are always found; narrower gaps may be
    /// missed. Limit: > 0, at most 16 million cells.
    pub cell: f64,
    /// Radius of the bodies: their centres keep at least this distance from walls. Limit: >= 0.
    pub radius: f64,
    /// Extra cost close to walls, square metres: at a distance `d` from a wall a metre costs `clearance / (d -
    /// radius)^2` more. 0: shortest routes, along the walls. Limit: >= 0.
    pub clearance: f32,
    /// Maximum extra cost of a metre because of walls. Limit: >= 0.
    pub dearest: f32,
}

impl Default for TerrainSettings {
    fn default() -> Self {
        Self { low: DVec2::ZERO, high: DVec2::ZERO, cell: 0.25, radius: 0.25, clearance: 0.05, dearest: 10.0 }
    }
}

/// Ground in square cells, for [`ToGoal`](super::ToGoal): which cells are walkable, how far their centres are from the
/// walls, and what a metre costs there.
///
/// ```
/// use glam::DVec2;
/// use throng_field::{Terrain, TerrainSettings};
/// use throng::space::Place;
/// use throng::Obstacle;
/// let pillar = Obstacle::Circle { center: DVec2::splat(5.0), radius: 1.0 };
/// let place = Place { areas: vec![], obstacles: vec![Some(pillar)] };
/// let survey = TerrainSettings { high: DVec2::splat(10.0), cell: 0.5, radius: 0.3, ..TerrainSettings::default() };
/// let mut ground = Terrain::of_place(&place, DVec2::ZERO, survey)?;
/// let there = ground.cell_at(DVec2::new(5.25, 7.25)).expect("it is on the terrain");
/// assert!((ground.distances()[there] - 1.264).abs() < 1e-3 && ground.is_open(there));
/// assert!(!ground.is_open(ground.cell_at(DVec2::splat(5.2)).unwrap()), "inside the pillar");
/// // grass: a metre costs twice as much
/// ground.paint(|at| if at.x < 2.0 { 2.0 } else { 1.0 })?;
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone)]
pub struct Terrain {
    pub(super) lattice: NodeLattice<2>,
    pub(super) low: DVec2,
    pub(super) radius: f64,
    pub(super) walls: Walls,
    pub(super) solid: Vec<bool>,
    pub(super) distances: Vec<f32>,
    /// The cost of a metre, metres; infinite in solid cells.
    cost: Vec<f32>,
    /// Links between open cells.
    pub(super) links: Vec<Links>,
    /// Links to and between cells that are too close to walls, for agents that were pushed there.
    pub(super) margin: Vec<Links>,
    /// The cells that are too close to walls, farthest from walls first.
    pub(super) close: Vec<u32>,
}

impl Terrain {
    /// Creates the terrain of a place in world coordinates; the terrain is relative to the origin.
    ///
    /// # Errors
    /// Values out of their limits; a box without width or height; more than 16 million cells.
    pub fn of_place(place: &Place, origin: DVec2, survey: TerrainSettings) -> Result<Self, Error> {
        let lattice = survey.lattice()?;
        let walls = Walls::new(&place.areas, place.obstacles(), origin);
        let first = origin + survey.low + 0.5 * survey.cell;
        Ok(Self::surveyed(survey, lattice, walls, cover::solid(place, first, &lattice)))
    }

    /// Creates a terrain from a function that returns whether a point is solid. A cell is solid if its centre is.
    ///
    /// # Errors
    /// As [`of_place`](Self::of_place).
    pub fn of(is_solid: impl Fn(DVec2) -> bool, survey: TerrainSettings) -> Result<Self, Error> {
        let lattice = survey.lattice()?;
        let middle = |node: usize| middle(survey.low, &lattice, node);
        let solid: Vec<bool> = (0..lattice.len()).map(|node| is_solid(middle(node))).collect();
        let walls: Vec<Obstacle> = cover::outlines(survey.low, &lattice, &solid);
        Ok(Self::surveyed(survey, lattice, Walls::new(&[], &walls, DVec2::ZERO), solid))
    }

    fn surveyed(survey: TerrainSettings, lattice: NodeLattice<2>, walls: Walls, solid: Vec<bool>) -> Self {
        let TerrainSettings { low, cell, radius, clearance, dearest, .. } = survey;
        let mut ground = Self {
            lattice,
            low,
            radius,
            walls,
            distances: vec![f32::INFINITY; lattice.len()],
            cost: vec![f32::INFINITY; lattice.len()],
            links: vec![0; lattice.len()],
            margin: vec![0; lattice.len()],
            close: Vec::new(),
            solid,
        };
        // how far links and directions consider walls, and how far walls add cost
        let reach = radius + (2.0 * cell).max(f64::from(cost::reach(clearance)));
        ground.measure(reach);
        ground.link();
        for (node, cost) in ground.cost.iter_mut().enumerate().filter(|&(node, _)| !ground.solid[node]) {
            let gap = ground.distances[node] - radius as f32;
            let dear = 1.0 + cost::close(gap, (clearance, dearest));
            *cost = if gap > 0.0 { dear } else { MARGIN * dear };
        }
        ground
    }

    /// Measures the distances of the cells' centres from walls, up to `reach`.
    fn measure(&mut self, reach: f64) {
        let Self { lattice, low, walls, solid, distances, .. } = self;
        let (cell, solid) = (lattice.cell, &solid[..]);
        parallel::ranges_with(&mut distances[..], &mut Vec::new(), |near: &mut NearWalls, nodes, out| {
            let mut before = f64::INFINITY;
            for (node, out) in nodes.zip(out) {
                if node.is_multiple_of(lattice.counts[0]) {
                    before = f64::INFINITY;
                }
                // the distance cannot exceed that of the previous cell in the row by more than the distance between the
                // two
                let range = (before + 1.001 * cell).min(reach);
                let distance = walls.distance(middle(*low, lattice, node), range, near);
                before = distance.max(0.0);
                *out = if solid[node] { -distance.abs() } else { distance } as f32;
            }
        });
    }

    /// Multiplies the costs: values below 1 for preferred routes, above 1 for ground that agents avoid. `cost` gets the
    /// centre of each cell.
    ///
    /// # Errors
    /// [`Error::Shape`] with the place of a cost that is not greater than 0 and finite. The costs are unchanged then.
    pub fn paint(&mut self, cost: impl Fn(DVec2) -> f32) -> Result<(), Error> {
        let painted: Vec<f32> = (0..self.cost.len()).map(|node| cost(self.middle(node))).collect();
        self.paint_cells(&painted)
    }

    /// As [`paint`](Self::paint), with one factor for each cell, row by row.
    ///
    /// # Errors
    /// As [`paint`](Self::paint); a number of factors that is not the number of cells.
    pub fn paint_cells(&mut self, cost: &[f32]) -> Result<(), Error> {
        let fail = |why: String| Err(Error::Shape { what: "the costs painted on the terrain".into(), why });
        if cost.len() != self.cost.len() {
            return fail(format!("{} costs are given for {} cells", cost.len(), self.cost.len()));
        }
        if let Some(node) = cost.iter().position(|&cost| !(cost > 0.0 && cost.is_finite())) {
            let (at, cost) = (self.middle(node), cost[node]);
            return fail(format!(
                "the cost at ({:.3}, {:.3}) is {cost}, but must be greater than 0 and finite",
                at.x, at.y
            ));
        }
        self.cost.iter_mut().zip(cost).for_each(|(all, cost)| *all *= cost);
        Ok(())
    }

    /// Returns the width of a cell, metres.
    pub fn cell(&self) -> f64 {
        self.lattice.cell
    }

    /// Returns the corner with the least coordinates.
    pub fn low(&self) -> DVec2 {
        self.low
    }

    /// Returns the corner with the greatest coordinates.
    pub fn high(&self) -> DVec2 {
        let [columns, rows] = self.lattice.counts.map(|count| count as f64);
        self.low + DVec2::new(columns, rows) * self.lattice.cell
    }

    /// Returns the number of cells in a row.
    pub fn columns(&self) -> usize {
        self.lattice.counts[0]
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.lattice.counts[1]
    }

    /// Returns the centre of a cell. Cells are counted row by row from the low corner, towards +x, then +y.
    pub fn middle(&self, cell: usize) -> DVec2 {
        middle(self.low, &self.lattice, cell)
    }

    /// Returns the cell that contains a place; none beyond the rim.
    pub fn cell_at(&self, place: DVec2) -> Option<usize> {
        let at = (place - self.low) / self.lattice.cell;
        let counts = DVec2::new(self.columns() as f64, self.rows() as f64);
        let inside = at.cmpge(DVec2::ZERO).all() && at.cmple(counts).all();
        let [column, row] = at.floor().min(counts - 1.0).to_array().map(|at| at as usize);
        inside.then(|| row * self.columns() + column)
    }

    /// Whether a body's centre can be at the centre of a cell.
    pub fn is_open(&self, cell: usize) -> bool {
        !self.solid[cell] && f64::from(self.distances[cell]) >= self.radius * (1.0 - 1e-6)
    }

    /// Whether the centre of a cell is inside an obstacle or off the walkable areas.
    pub fn is_solid(&self, cell: usize) -> bool {
        self.solid[cell]
    }

    /// Returns the distances of the cells' centres from the nearest walls, metres: negative in solid cells, infinite
    /// where walls are too far to matter.
    pub fn distances(&self) -> &[f32] {
        &self.distances
    }

    /// Returns the cost of a metre in each cell, metres; infinite in solid cells.
    pub fn cost(&self) -> &[f32] {
        &self.cost
    }

    /// Returns the four cells with the centres nearest to a place, row by row, and their bilinear weights; on the rim,
    /// beyond the centres, weights are below 0.
    pub(super) fn around(&self, place: DVec2) -> [(usize, f32); 4] {
        let last = DVec2::new((self.columns() - 1) as f64, (self.rows() - 1) as f64);
        let at = (place - self.low) / self.lattice.cell - 0.5;
        let corner = at.floor().clamp(DVec2::ZERO, (last - 1.0).max(DVec2::ZERO));
        let Vec2 { x, y } = (at - corner).as_vec2();
        let first = corner.y as usize * self.columns() + corner.x as usize;
        // with one row or column only, the next is the same
        let right = usize::from(self.columns() > 1);
        let up = if self.rows() > 1 { self.columns() } else { 0 };
        let (left_part, low_part) = (1.0 - x, 1.0 - y);
        [
            (first, left_part * low_part),
            (first + right, x * low_part),
            (first + up, left_part * y),
            (first + up + right, x * y),
        ]
    }
}

impl fmt::Debug for Terrain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { lattice, low, radius, .. } = self;
        f.debug_struct("Terrain")
            .field("low", low)
            .field("lattice", lattice)
            .field("radius", radius)
            .finish_non_exhaustive()
    }
}

/// Returns the centre of a node's cell.
fn middle(low: DVec2, lattice: &NodeLattice<2>, node: usize) -> DVec2 {
    let [column, row] = lattice.coordinates(node).map(|at| at as f64 + 0.5);
    low + DVec2::new(column, row) * lattice.cell
}

impl TerrainSettings {
    /// Checks the settings and returns the lattice of the cells' centres.
    fn lattice(&self) -> Result<NodeLattice<2>, Error> {
        let Self { low, high, cell, radius, clearance, dearest } = *self;
        Error::unless_finite("corner of a terrain", (low + high).element_sum())?;
        Error::unless(cell > 0.0 && cell.is_finite(), "width of a terrain's cell", cell, "greater than 0 and finite")?;
        let limit = "at least 0 and finite";
        Error::unless(radius >= 0.0 && radius.is_finite(), "radius of bodies on a terrain", radius, limit)?;
        Error::unless(clearance >= 0.0 && clearance.is_finite(), "clearance of a terrain", clearance, limit)?;
        Error::unless(dearest >= 0.0 && dearest.is_finite(), "greatest cost close to walls", dearest, limit)?;
        let fail = |why: String| Err(Error::Shape { what: "the terrain".into(), why });
        let size = high - low;
        if size.min_element() <= 0.0 {
            return fail(format!("the box from ({}, {}) to ({}, {}) is empty", low.x, low.y, high.x, high.y));
        }
        // a rim that exceeds the last cell by rounding only needs no other cell; `as` saturates
        let counts = size.to_array().map(|length| (length / cell - 1e-9).ceil().max(1.0) as usize);
        if counts[0].saturating_mul(counts[1]) > MOST {
            return fail(format!("{} by {} cells are more than {MOST}: make them wider", counts[0], counts[1]));
        }
        Ok(NodeLattice { counts, cell })
    }
}
