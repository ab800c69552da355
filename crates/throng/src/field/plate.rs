//! Scattered velocities interpolated by radial basis functions: the linear system behind [`Anchors`](super::Anchors).

use crate::Error;
use glam::{DMat2, DVec2, DVec3};
use nalgebra::{DMatrix, Dyn, LU};
use std::fmt::Debug;
use std::iter::Sum;
use std::ops::{Add, Mul, Sub};

/// How the influence of an anchor falls off with distance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Kernel {
    /// `r^2 log r` beside a linear field: of all fields that go through the anchors the one that bends least (thin plate). In space
    /// that is `r` (biharmonic).
    /// Every anchor matters everywhere; fields that are linear, a rotation too, come out as they are.
    #[default]
    ThinPlate,
    /// Wendland's `(1 - r)^4 (4 r + 1)`, `r` in parts of the reach: zero beyond it, so that an anchor matters near it only.
    Wendland {
        /// Metres, greater than 0.
        reach: f64,
    },
}

impl Kernel {
    fn at(self, distance_squared: f64, dimensions: usize) -> f64 {
        match self {
            Self::ThinPlate if dimensions == 3 => distance_squared.sqrt(),
            Self::ThinPlate if distance_squared > 0.0 => 0.5 * distance_squared * libm::log(distance_squared),
            Self::ThinPlate => 0.0,
            Self::Wendland { reach } => {
                let r = distance_squared.sqrt() / reach;
                let left = (1.0 - r).max(0.0);
                left.powi(4) * (4.0 * r + 1.0)
            }
        }
    }
}

/// A place, or a velocity: in the plane or in space.
pub(super) trait Vector:
    Copy + Debug + Default + PartialEq + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> + Sum
{
    /// A way to measure distances.
    type Metric: Copy + Debug;
    const DIMENSIONS: usize;

    fn of(component: impl Fn(usize) -> f64) -> Self;
    fn component(self, index: usize) -> f64;
    fn measured(self, metric: Self::Metric) -> Self;

    fn dot(self, other: Self) -> f64 {
        (0..Self::DIMENSIONS).map(|index| self.component(index) * other.component(index)).sum()
    }

    fn length(self) -> f64 {
        self.dot(self).sqrt()
    }
}

impl Vector for DVec2 {
    type Metric = DMat2;
    const DIMENSIONS: usize = 2;

    fn of(component: impl Fn(usize) -> f64) -> Self {
        Self::new(component(0), component(1))
    }

    fn component(self, index: usize) -> f64 {
        self[index]
    }

    fn measured(self, metric: DMat2) -> Self {
        metric * self
    }
}

impl Vector for DVec3 {
    type Metric = ();
    const DIMENSIONS: usize = 3;

    fn of(component: impl Fn(usize) -> f64) -> Self {
        Self::new(component(0), component(1), component(2))
    }

    fn component(self, index: usize) -> f64 {
        self[index]
    }

    fn measured(self, (): ()) -> Self {
        self
    }
}

/// A place with its own way to measure distances.
#[derive(Clone, Copy, Debug)]
pub(super) struct Center<V: Vector> {
    pub place: V,
    pub metric: V::Metric,
}

/// Centres, and the factors of their system: new velocities need no new factors.
#[derive(Clone, Debug)]
pub(super) struct Plate<V: Vector> {
    kernel: Kernel,
    centers: Vec<Center<V>>,
    /// Directions in which the linear part varies: as many as the centres span, none if there is no such part.
    axes: Vec<V>,
    has_polynomial: bool,
    factors: Option<LU<f64, Dyn, Dyn>>,
    /// What each centre adds, then the constant and what each axis adds.
    weights: Vec<V>,
    /// How many times as large all weights are together as the fastest velocity: how many digits are lost.
    gain: f64,
}

impl<V: Vector> Plate<V> {
    /// The plate through centres that lie in places that differ, near the origin and not much more than 1 from it. With a
    /// smoothing of more than zero it goes past them instead of through them.
    pub fn new(kernel: Kernel, centers: Vec<Center<V>>, axes: Vec<V>, smoothing: f64) -> Result<Self, Error> {
        let has_polynomial = kernel == Kernel::ThinPlate;
        let axes = if has_polynomial { axes } else { Vec::new() };
        let mut plate = Self { kernel, centers, axes, has_polynomial, factors: None, weights: Vec::new(), gain: 0.0 };
        let (count, size) = (plate.centers.len(), plate.size());
        if count == 0 {
            return Ok(plate);
        }
        let entry = |row: usize, column: usize| match (row < count, column < count) {
            (true, true) => {
                let value = plate.influence(column, plate.centers[row].place);
                if row == column { value + smoothing } else { value }
            }
            (true, false) => plate.term(column - count, plate.centers[row].place),
            (false, true) => plate.term(row - count, plate.centers[column].place),
            (false, false) => 0.0,
        };
        // symmetric where nothing is stretched, but indefinite: so not by Cholesky. Plain loops, the same bits on every processor
        let factors = DMatrix::from_fn(size, size, entry).lu();
        if !factors.is_invertible() {
            return Err(Self::unsolvable());
        }
        plate.factors = Some(factors);
        Ok(plate)
    }

    fn size(&self) -> usize {
        self.centers.len() + if self.has_polynomial { 1 + self.axes.len() } else { 0 }
    }

    /// What a centre adds at a place, over its weight.
    fn influence(&self, center: usize, place: V) -> f64 {
        let Center { place: at, metric } = self.centers[center];
        let offset = (place - at).measured(metric);
        self.kernel.at(offset.dot(offset), V::DIMENSIONS)
    }

    /// A term of the linear part at a place.
    fn term(&self, index: usize, place: V) -> f64 {
        index.checked_sub(1).map_or(1.0, |axis| self.axes[axis].dot(place))
    }

    /// Goes through these velocities, one a centre, or past them if it is smoothed.
    pub fn go_through(&mut self, velocities: &[V]) {
        let Some(factors) = &self.factors else { return };
        let right = |row: usize, column: usize| velocities.get(row).map_or(0.0, |v| v.component(column));
        let solved =
            factors.solve(&DMatrix::from_fn(self.size(), V::DIMENSIONS, right)).expect("the system is invertible");
        self.weights.clear();
        self.weights.extend(solved.row_iter().map(|row| V::of(|index| row[index])));
        let length = |all: &[V]| all.iter().map(|v| v.length()).collect::<Vec<f64>>();
        let fastest = length(velocities).into_iter().fold(f64::MIN_POSITIVE, f64::max);
        self.gain = length(self.weights()).into_iter().sum::<f64>() / fastest;
    }

    /// How many times as large all weights are together as the fastest velocity: how many digits are lost.
    pub fn gain(&self) -> f64 {
        self.gain
    }

    /// Whether rounding left it on these velocities, which it goes through.
    pub fn check(&self, velocities: &[V]) -> Result<(), Error> {
        let largest = velocities.iter().map(|v| v.length()).fold(0.0, f64::max);
        let off = |(center, v): (&Center<V>, &V)| (self.velocity(center.place) - *v).length();
        let exact = self.centers.iter().zip(velocities).map(off).all(|off| off <= 1e-6 * largest);
        if exact { Ok(()) } else { Err(Self::unsolvable()) }
    }

    fn unsolvable() -> Error {
        let why = "no field goes through them all: set them farther apart, stretch them less, or smooth more";
        Error::Shape { what: "anchors of a field".into(), why: why.into() }
    }

    /// The velocity at a place.
    pub fn velocity(&self, place: V) -> V {
        let weights = (0..).zip(self.weights());
        weights.map(|(center, &weight)| weight * self.influence(center, place)).sum::<V>() + self.linear(place)
    }

    /// The linear part at a place.
    pub fn linear(&self, place: V) -> V {
        let terms = self.weights.get(self.centers.len()..).unwrap_or_default();
        (0..).zip(terms).map(|(term, &weight)| weight * self.term(term, place)).sum()
    }

    /// What each centre adds, over its influence.
    pub fn weights(&self) -> &[V] {
        self.weights.get(..self.centers.len()).unwrap_or_default()
    }

    pub fn centers(&self) -> &[Center<V>] {
        &self.centers
    }

    pub fn kernel(&self) -> Kernel {
        self.kernel
    }
}
