//! Space in cubes: how far what is solid is from each, and what a metre costs there.

use super::super::cost::{self, KEPT};
use super::super::eikonal::{Lattice, Links, bit};
use crate::Error;
use crate::parallel;
use crate::space::surface::{Surface, SurfacePoint, Sweep, Union};
use glam::Vec3;
use std::fmt;
use std::sync::Arc;

/// Cubes at most.
const MOST: usize = 1 << 24;

/// Over which box, in which cubes and for whom [`Voxels`] are made. Metres, from the world's origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scan {
    /// The corner with the least coordinates.
    pub low: Vec3,
    /// The corner with the greatest coordinates; the last cubes may reach beyond it.
    pub high: Vec3,
    /// Width of a cube. Ways through gaps that are wider than two radii and two cubes are found, narrower ones perhaps not. Limit: > 0, at
    /// most 16 million cubes.
    pub cell: f32,
    /// Radius of the bodies: no middle comes nearer to what is solid. Limit: >= 0.
    pub radius: f32,
    /// How dear it is to go close to what is solid, square metres: at a distance `d` a metre costs `clearance / (d - radius)^2` more.
    /// Limit: >= 0.
    pub clearance: f32,
    /// What a metre costs more at most. Limit: >= 0.
    pub dearest: f32,
}

impl Default for Scan {
    fn default() -> Self {
        Self { low: Vec3::ZERO, high: Vec3::ZERO, cell: 0.25, radius: 0.05, clearance: 0.05, dearest: 10.0 }
    }
}

/// A box of space in cubes, with the distance of what is solid from the middle of each, for ways of swarms: the first step of the
/// preprocessing of Wang, Jin, Deng, Zhou 2014.
///
/// ```
/// use glam::Vec3;
/// use std::sync::Arc;
/// use throng::field::{Scan, Voxels};
/// use throng::space::surface::{Sphere, Surface};
/// let ball: Arc<dyn Surface> = Arc::new(Sphere::new(Vec3::splat(2.0), 1.0)?);
/// let space = Voxels::of(&[ball], Scan { high: Vec3::splat(4.0), ..Scan::default() })?;
/// let middle = space.cell_at(Vec3::new(2.0, 2.0, 3.5)).expect("it is in the box");
/// let (at, distance) = (space.middle(middle), space.distances()[middle]);
/// assert!((distance - (at.distance(Vec3::splat(2.0)) - 1.0)).abs() < 1e-5);
/// # Ok::<(), throng::Error>(())
/// ```
pub struct Voxels {
    pub(super) lattice: Lattice<3>,
    pub(super) low: Vec3,
    pub(super) radius: f32,
    scene: Option<Union>,
    distances: Vec<f32>,
    pub(super) cost: Vec<f32>,
    pub(super) links: Vec<Links>,
}

impl Voxels {
    /// Space among some surfaces; none: nothing is in the way. What is inside a solid is not free; sheets part what is on both sides.
    ///
    /// # Errors
    /// Numbers out of their limits, a box that holds nothing, more than 16 million cubes.
    pub fn of(scene: &[Arc<dyn Surface>], scan: Scan) -> Result<Self, Error> {
        let lattice = scan.lattice()?;
        let scene = if scene.is_empty() { None } else { Some(Union::new(scene.to_vec())?) };
        let count = lattice.len();
        let Scan { low, radius, clearance, dearest, .. } = scan;
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

    /// Finds the ways between neighbouring cubes.
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
                // no point between them is farther from both than half the way
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

    /// What of the scene is nearest to a place; infinitely far if there is nothing.
    pub(super) fn nearest(&self, place: Vec3) -> SurfacePoint {
        let nothing = SurfacePoint { point: place, normal: Vec3::Z, distance: f32::INFINITY };
        self.scene.as_ref().map_or(nothing, |scene| scene.query(place))
    }

    /// Whether a ball gets straight from one place to another without touching anything.
    pub(super) fn is_clear(&self, from: Vec3, to: Vec3, radius: f32) -> bool {
        let Some(scene) = &self.scene else { return true };
        let (reach, direction) = ((to - from).length(), (to - from).normalize_or(Vec3::X));
        scene.sweep(&Sweep { origin: from, direction, radius, reach }).is_none()
    }

    /// The width of its cubes, metres.
    pub fn cell(&self) -> f32 {
        self.lattice.cell as f32
    }

    /// Its corner with the least coordinates.
    pub fn low(&self) -> Vec3 {
        self.low
    }

    /// Its corner with the greatest coordinates.
    pub fn high(&self) -> Vec3 {
        self.low + Vec3::from(self.lattice.counts.map(|count| count as f32)) * self.cell()
    }

    /// Cubes along x, y and z.
    pub fn counts(&self) -> [usize; 3] {
        self.lattice.counts
    }

    /// The middle of a cube; they are counted along x, then y, then z.
    pub fn middle(&self, cell: usize) -> Vec3 {
        let at = Vec3::from(self.lattice.coordinates(cell).map(|at| at as f32));
        self.low + (at + 0.5) * self.cell()
    }

    /// The cube that a place is in; none beyond the box.
    pub fn cell_at(&self, place: Vec3) -> Option<usize> {
        let at = (place - self.low) / self.cell();
        let counts = Vec3::from(self.lattice.counts.map(|count| count as f32));
        let inside = at.cmpge(Vec3::ZERO).all() && at.cmple(counts).all();
        let at = at.floor().min(counts - 1.0).to_array();
        let index = at.into_iter().zip(self.lattice.strides()).map(|(at, stride)| at as usize * stride);
        inside.then(|| index.sum())
    }

    /// Whether the middle of a body can be in that of a cube.
    pub fn is_open(&self, cell: usize) -> bool {
        self.distances[cell] >= self.radius
    }

    /// How far what is solid is from the middle of each cube, metres: negative inside, infinite if there is nothing.
    pub fn distances(&self) -> &[f32] {
        &self.distances
    }

    /// What a metre costs in each cube, in metres; infinite where no body can be.
    pub fn cost(&self) -> &[f32] {
        &self.cost
    }

    /// The eight cubes whose middles are nearest to a place in the box, and their trilinear weights.
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
                // of one layer only, the next is the same
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

impl Scan {
    /// The middles of its cubes.
    fn lattice(&self) -> Result<Lattice<3>, Error> {
        let Self { low, high, cell, radius, clearance, dearest } = *self;
        Error::unless_finite("corner of a box of space", f64::from((low + high).element_sum()))?;
        Error::unless_positive("width of a cube of space", cell)?;
        let limit = "at least 0 and finite";
        Error::unless(radius >= 0.0 && radius.is_finite(), "radius of bodies in space", radius, limit)?;
        Error::unless(clearance >= 0.0 && clearance.is_finite(), "clearance in space", clearance, limit)?;
        Error::unless(dearest >= 0.0 && dearest.is_finite(), "greatest cost close to what is solid", dearest, limit)?;
        let fail = |why: String| Err(Error::Shape { what: "the box of space".into(), why });
        let size = high - low;
        if size.min_element() <= 0.0 {
            return fail(format!("from {low} to {high} it holds nothing"));
        }
        // what lies on the rim by rounding needs no other cube; `as` saturates
        let counts = size.to_array().map(|length| (length / cell - 1e-4).ceil().max(1.0) as usize);
        let count = counts.into_iter().fold(1, usize::saturating_mul);
        if count > MOST {
            let [x, y, z] = counts;
            return fail(format!("{x} by {y} by {z} cubes are more than {MOST}: make them wider"));
        }
        Ok(Lattice { counts, cell: f64::from(cell) })
    }
}
