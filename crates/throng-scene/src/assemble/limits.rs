//! Limits of numbers, and messages with the numbers' names.

use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::{Number, Point, SpacePoint};

/// Greatest coordinate of scenes and of trajectories, metres: 2.5 times the circumference of the Earth, and still exact
/// to 2e-8 m in f64.
pub const MAX_COORDINATE: f64 = 1e8;

/// Greatest altitude, metres: that of the world.
pub(super) const HIGHEST: f64 = 20_000.0;

/// The limit of a number.
#[derive(Clone, Copy, Debug)]
pub(super) enum Limit {
    Finite,
    Positive,
    NotNegative,
    /// From the first to the second, both included.
    Between(f64, f64),
    /// More than 0, and at most this.
    UpTo(f64),
}

impl Limit {
    fn holds(self, x: f64) -> bool {
        x.is_finite()
            && match self {
                Self::Finite => x.abs() <= MAX_COORDINATE,
                Self::Positive => x > 0.0,
                Self::NotNegative => x >= 0.0,
                Self::Between(low, high) => (low..=high).contains(&x),
                Self::UpTo(high) => x > 0.0 && x <= high,
            }
    }

    fn words(self) -> String {
        match self {
            Self::Finite => "a finite number of at most 100,000,000 in size".into(),
            Self::Positive => "more than 0".into(),
            Self::NotNegative => "0 or more".into(),
            Self::Between(low, high) => format!("from {low} to {high}"),
            Self::UpTo(high) => format!("more than 0 and at most {high}"),
        }
    }
}

/// Checks the number at `path`.
pub(super) fn check(path: &Path, x: f64, limit: Limit) -> Result<(), Problem> {
    if limit.holds(x) {
        return Ok(());
    }
    let message = format!("{} is {x}, but must be {}", path.below_list(), limit.words());
    Err(Problem::new(path, Kind::OutOfRange, message))
}

/// Checks an optional number.
pub(super) fn check_some(path: &Path, x: Option<f64>, limit: Limit) -> Result<(), Problem> {
    x.map_or(Ok(()), |x| check(path, x, limit))
}

/// Checks both coordinates of a point.
pub(super) fn check_point(path: &Path, point: &Point) -> Result<(), Problem> {
    point.iter().enumerate().try_for_each(|(i, x)| check(&path.index(i), *x, Limit::Finite))
}

/// Checks the coordinates of a point above the ground.
pub(super) fn check_spot(path: &Path, [x, y, z]: &SpacePoint) -> Result<(), Problem> {
    check_point(path, &[*x, *y])?;
    check(&path.index(2), *z, Limit::Between(0.0, HIGHEST))
}

/// Checks a number that may be a distribution: all its values must be within the limit.
pub(super) fn check_number(path: &Path, number: &Number, limit: Limit) -> Result<(), Problem> {
    match number {
        Number::Constant(x) => check(path, *x, limit),
        Number::Uniform([low, high]) => {
            let path = path.key("uniform");
            check(&path.index(0), *low, limit)?;
            check(&path.index(1), *high, limit)?;
            if low > high {
                let message = format!("{} goes from {low} down to {high}", path.below_list());
                return Err(Problem::new(&path, Kind::OutOfRange, message).hint("give the lower bound first"));
            }
            Ok(())
        }
        Number::Normal(normal) => {
            let path = path.key("normal");
            check(&path.key("mean"), normal.mean, Limit::Finite)?;
            check(&path.key("deviation"), normal.deviation, Limit::NotNegative)?;
            check_some(&path.key("min"), normal.min, limit)?;
            check_some(&path.key("max"), normal.max, limit)?;
            let [low, high] = normal.bounds();
            if low > high {
                let message = format!("{} has a least value of {low} above its greatest of {high}", path.below_list());
                return Err(Problem::new(&path, Kind::OutOfRange, message));
            }
            if limit.holds(low) && limit.holds(high) {
                return Ok(());
            }
            let message = format!("{} can give {low} to {high}, but must be {}", path.below_list(), limit.words());
            Err(Problem::new(&path, Kind::OutOfRange, message)
                .hint("without `min` and `max` it reaches three deviations to each side: set them"))
        }
    }
}
