//! Space in cubes: how far obstacles are from each cube, and what a metre costs there.

use super::super::cost::{self, KEPT};
use super::super::eikonal::{Links, NodeLattice, bit};
use glam::Vec3;
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::parallel;
use throng::space::surface::{Surface, SurfacePoint, Sweep, Union};

/// Maximum number of cubes.
const MOST: usize = 1 << 24;

/// The box, the cubes and the bodies of [`Voxels`]. Metres, from the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoxelSettings {
    /// The corner with the least coordinates.
    pub low: Vec3,
    /// The corner with the greatest coordinates; the last cubes may reach beyond it.
    pub high: Vec3,
    /// Width of a cube. Routes through gaps wider than two radii and two cubes are always found; narrower gaps may be
    /// missed. Limit: > 0, at most 16 million cubes.
    pub cell: f32,
    /// Radius of the bodies: their centres keep at least this distance from obstacles. Limit: >= 0.
    pub radius: f32,
    /// Extra cost close to obstacles, square metres: at a distance `d` a metre costs `clearance / (d - radius)^2` more.
    /// Limit: >= 0.
    pub clearance: f32,
    /// Maximum extra cost of a metre. Limit: >= 0.
    pub dearest: f32,
}

impl Default for VoxelSettings {
    fn default() -> Self {
        Self { low: Vec3::ZERO, high: Vec3::ZERO, cell: 0.25, radius: 0.05, clearance: 0.05, dearest: 10.0 }
    }
}

/// A box of space in cubes, with the distance of obstacles from the centre of each, for the routes of swarms: the first
/// step of the preprocessing of Wang, Jin, Deng, Zhou 2014.
///
/// ```
/// use glam::Vec3;
/// use std::sync::Arc;
/// use throng_field::{VoxelSettings, Voxels};
/// use throng::space::surface::{Sphere, Surface};
/// let ball: Arc<dyn Surface> = Arc::new(Sphere::new(Vec3::splat(2.0), 1.0)?);
/// let space = Voxels::of(&[ball], VoxelSettings { high: Vec3::splat(4.0), ..VoxelSettings::default() })?;
/// let middle = space.cell_at(Vec3::new(2.0, 2.0, 3.5)).expect("it is in the box");
/// let (at, distance) = (space.middle(middle), space.distances()[middle]);
/// assert!((distance - (at.distance(Vec3::splat(2.0)) - 1.0)).abs() < 1e-5);
/// # Ok::<(), throng::Error>(())
/// ```
pub struct Voxels {
    pub(super) lattice: NodeLattice<3>,
    pub(super) low: Vec3,
    pub(super) radius: f32,
    scene: Option<Union>,
    distances: Vec<f32>,
    pub(super) cost: Vec<f32>,
    pub(super) links: Vec<Links>,
}

impl Voxels {
    /// Creates the voxels of space among some surfaces; without surfaces all of it is free. The inside of a solid is
    /// not free; a sheet separates its two sides.
    ///
    /// # Errors
    /// Values out of their limits; an empty box; more than 16 million cubes.
    pub fn of(scene: &[Arc<dyn Surface>], scan: VoxelSettings) -> Result<Self, Error> {
        let lattice = scan.lattice()?;
        let scene = if scene.is_empty() { None } else { Some(Union::new(scene.to_vec())?) };
        let count = lattice.len();
        let VoxelSettings { low, radius, clearance, dearest, .. } = scan;
        let mut space = Self {
            lattice,
            low,
            radius,
            scene,
            distances: vec![f32::INFINITY; count],
            cost: vec![f32::INFINITY; count],
            links: vec![0; count],
        };
        let mut distances = std::mem::take(&mut space.distances);
        parallel::rows(&mut distances[..], |(): &mut (), cell, out| *out = space.nearest(space.middle(cell)).distance);
        space.distances = distances;
        for (cost, distance) in space.cost.iter_mut().zip(&space.distances) {
            if *distance >= radius {
                *cost = 1.0 + cost::close(distance - radius, (clearance, dearest));
            }
        }
        space.link();
        Ok(space)
    }

    /// Finds the links between neighbouring cubes.
    fn link(&mut self) {
        let (strides, cell) = (self.lattice.strides(), self.lattice.cell as f32);
        let gap = KEPT as f32 * self.radius;
        let mut onwards: Vec<Links> = vec![0; self.lattice.len()];
        parallel::rows(&mut onwards[..], |(): &mut (), node, links| {
            let at = self.lattice.coordinates(node);
            for (axis, along) in Vec3::AXES.into_iter().enumerate() {
                let next = node + strides[axis];
                if at[axis] + 1 == self.lattice.counts[axis] || !self.is_open(node) || !self.is_open(next) {
                    continue;
                }
                // no point between the two cubes is farther from both than half of their distance
                let clear = self.distances[node] + self.distances[next] > 2.0 * gap + 1.001 * cell;
                let middle = self.middle(node);
                if clear || self.is_clear(middle, middle + along * cell, gap) {
                    *links |= bit(axis, 1);
                }
            }
        });
        for (node, links) in onwards.into_iter().enumerate() {
            self.links[node] |= links;
            for (axis, stride) in strides.into_iter().enumerate() {
                if links & bit(axis, 1) != 0 {
                    self.links[node + stride] |= bit(axis, 0);
                }
            }
        }
    }

    /// Returns the nearest point of the scene to a place; infinitely far if the scene is empty.
    pub(super) fn nearest(&self, place: Vec3) -> SurfacePoint {
        let nothing = SurfacePoint { point: place, normal: Vec3::Z, distance: f32::INFINITY };
        self.scene.as_ref().map_or(nothing, |scene| scene.query(place))
    }

    /// Whether a ball moves straight from one place to another without contact.
    pub(super) fn is_clear(&self, from: Vec3, to: Vec3, radius: f32) -> bool {
        let Some(scene) = &self.scene else { return true };
        let (reach, direction) = ((to - from).length(), (to - from).normalize_or(Vec3::X));
        scene.sweep(&Sweep { origin: from, direction, radius, reach }).is_none()
    }

    /// Returns the width of a cube, metres.
    pub fn cell(&self) -> f32 {
        self.lattice.cell as f32
    }

    /// Returns the corner with the least coordinates.
    pub fn low(&self) -> Vec3 {
        self.low
    }

    /// Returns the corner with the greatest coordinates.
    pub fn high(&self) -> Vec3 {
        self.low + Vec3::from(self.lattice.counts.map(|count| count as f32)) * self.cell()
    }

    /// Returns the numbers of cubes along x, y and z.
    pub fn counts(&self) -> [usize; 3] {
        self.lattice.counts
    }

    /// Returns the centre of a cube. Cubes are counted along x, then y, then z.
    pub fn middle(&self, cell: usize) -> Vec3 {
        let at = Vec3::from(self.lattice.coordinates(cell).map(|at| at as f32));
        self.low + (at + 0.5) * self.cell()
    }

    /// Returns the cube that contains a place; none beyond the box.
    pub fn cell_at(&self, place: Vec3) -> Option<usize> {
        let at = (place - self.low) / self.cell();
        let counts = Vec3::from(self.lattice.counts.map(|count| count as f32));
        let inside = at.cmpge(Vec3::ZERO).all() && at.cmple(counts).all();
        let at = at.floor().min(counts - 1.0).to_array();
        let index = at.into_iter().zip(self.lattice.strides()).map(|(at, stride)| at as usize * stride);
        inside.then(|| index.sum())
    }

    /// Whether the centre of a body can be at the centre of a cube.
    pub fn is_open(&self, cell: usize) -> bool {
        self.distances[cell] >= self.radius
    }

    /// Returns the distance of obstacles from the centre of each cube, metres: negative inside an obstacle, infinite
    /// without obstacles.
    pub fn distances(&self) -> &[f32] {
        &self.distances
    }

    /// Returns the cost of a metre in each cube, metres; infinite where a body has no room.
    pub fn cost(&self) -> &[f32] {
        &self.cost
    }

    /// Returns the eight cubes with the centres nearest to a place in the box, and their trilinear weights.
    pub(super) fn around(&self, place: Vec3) -> [(usize, f32); 8] {
        let last = Vec3::from(self.lattice.counts.map(|count| (count - 1) as f32));
        let at = ((place - self.low) / self.cell() - 0.5).clamp(Vec3::ZERO, last);
        let corner = at.floor().min((last - 1.0).max(Vec3::ZERO));
        let part = at - corner;
        let strides = self.lattice.strides();
        let first: usize = corner.to_array().into_iter().zip(strides).map(|(at, stride)| at as usize * stride).sum();
        std::array::from_fn(|index| {
            let (mut cell, mut weight) = (first, 1.0);
            for axis in 0..3 {
                let after = index >> axis & 1;
                // with one layer only, the next is the same
                cell += if self.lattice.counts[axis] > 1 { after * strides[axis] } else { 0 };
                weight *= if after == 1 { part[axis] } else { 1.0 - part[axis] };
            }
            (cell, weight)
        })
    }
}

impl fmt::Debug for Voxels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { lattice, low, radius, .. } = self;
        f.debug_struct("Voxels")
            .field("low", low)
            .field("lattice", lattice)
            .field("radius", radius)
            .finish_non_exhaustive()
    }
}

impl VoxelSettings {
    /// Checks the settings and returns the lattice of the cubes' centres.
    fn lattice(&self) -> Result<NodeLattice<3>, Error> {
        let Self { low, high, cell, radius, clearance, dearest } = *self;
        Error::unless_finite("corner of a box of space", f64::from((low + high).element_sum()))?;
        Error::unless_positive("width of a cube of space", cell)?;
        let limit = "at least 0 and finite";
        Error::unless(radius >= 0.0 && radius.is_finite(), "radius of bodies in space", radius, limit)?;
        Error::unless(clearance >= 0.0 && clearance.is_finite(), "clearance in space", clearance, limit)?;
        Error::unless(dearest >= 0.0 && dearest.is_finite(), "greatest cost close to obstacles", dearest, limit)?;
        let fail = |why: String| Err(Error::Shape { what: "the box of space".into(), why });
        let size = high - low;
        if size.min_element() <= 0.0 {
            return fail(format!("from {low} to {high} it is empty"));
        }
        // a rim that exceeds the last cube by rounding only needs no other cube; `as` saturates
        let counts = size.to_array().map(|length| (length / cell - 1e-4).ceil().max(1.0) as usize);
        let count = counts.into_iter().fold(1, usize::saturating_mul);
        if count > MOST {
            let [x, y, z] = counts;
            return fail(format!("{x} by {y} by {z} cubes are more than {MOST}: make them wider"));
        }
        Ok(NodeLattice { counts, cell: f64::from(cell) })
    }
}
