//! Radial basis function interpolation of scattered velocities: the linear system behind [`Anchors`](super::Anchors).

use glam::{DMat2, DVec2, DVec3};
use nalgebra::{DMatrix, Dyn, LU};
use std::fmt::Debug;
use std::iter::Sum;
use std::ops::{Add, Mul, Sub};
use throng::Error;

/// How the influence of an anchor falls off with distance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Kernel {
    /// `r^2 log r` plus a linear field: the interpolation with the least bending energy (thin plate). In space the
    /// kernel is `r` (biharmonic). Every anchor has influence everywhere. Linear fields, including rotations, are
    /// reproduced exactly.
    #[default]
    ThinPlate,
    /// Wendland's `(1 - r)^4 (4 r + 1)`, with `r` in parts of the reach: zero beyond the reach, so an anchor has local
    /// influence only.
    Wendland {
        /// Radius of influence, metres, greater than 0.
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

/// A place or a velocity, in the plane or in space.
pub(super) trait Vector:
    Copy + Debug + Default + PartialEq + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> + Sum
{
    /// A metric of distances.
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

/// A place with its metric of distances.
#[derive(Clone, Copy, Debug)]
pub(super) struct Center<V: Vector> {
    pub place: V,
    pub metric: V::Metric,
}

/// Centres and the factors of their linear system: new velocities need no new factorisation.
#[derive(Clone, Debug)]
pub(super) struct Plate<V: Vector> {
    kernel: Kernel,
    centers: Vec<Center<V>>,
    /// Directions in which the linear part varies: as many as the centres span, none without a linear part.
    axes: Vec<V>,
    has_polynomial: bool,
    factors: Option<LU<f64, Dyn, Dyn>>,
    /// The weights of the centres, then the constant, then the weights of the axes.
    weights: Vec<V>,
    /// The sum of the weights' lengths, in parts of the fastest velocity: a measure of the loss of digits.
    gain: f64,
}

impl<V: Vector> Plate<V> {
    /// Factors the system of some centres. The centres must be distinct and lie at most about 1 from the origin. With
    /// `smoothing` above zero the plate approximates the velocities instead of interpolating them.
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
        // Cholesky's method does not apply: the matrix is indefinite, and symmetric only without stretching. Plain
        // loops give the same bits on every processor.
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

    /// Returns the contribution of a centre at a place, for a weight of 1.
    fn influence(&self, center: usize, place: V) -> f64 {
        let Center { place: at, metric } = self.centers[center];
        let offset = (place - at).measured(metric);
        self.kernel.at(offset.dot(offset), V::DIMENSIONS)
    }

    /// Returns a term of the linear part at a place.
    fn term(&self, index: usize, place: V) -> f64 {
        index.checked_sub(1).map_or(1.0, |axis| self.axes[axis].dot(place))
    }

    /// Computes the weights from the velocities of the centres.
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

    /// Returns the sum of the weights' lengths, in parts of the fastest velocity: a measure of the loss of digits.
    pub fn gain(&self) -> f64 {
        self.gain
    }

    /// Checks that the plate interpolates these velocities in spite of rounding.
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

    /// Returns the velocity at a place.
    pub fn velocity(&self, place: V) -> V {
        let weights = (0..).zip(self.weights());
        weights.map(|(center, &weight)| weight * self.influence(center, place)).sum::<V>() + self.linear(place)
    }

    /// Returns the linear part at a place.
    pub fn linear(&self, place: V) -> V {
        let terms = self.weights.get(self.centers.len()..).unwrap_or_default();
        (0..).zip(terms).map(|(term, &weight)| weight * self.term(term, place)).sum()
    }

    /// Returns the weights of the centres.
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
