//! Fields that count only in part.

use glam::{DVec2, Vec2, Vec3};
use std::fmt;
use std::sync::Arc;
use throng::field::{Adaptive, FactorMap, Field, FieldSpine};

/// A field with another cover: the velocities of a field, and how much it counts at each place.
///
/// ```
/// use glam::{DVec2, Vec3};
/// use std::sync::Arc;
/// use throng::field::Field;
/// use throng_field::{Covered, Uniform};
/// let east = |place: DVec2| if place.x > 0.0 { 1.0 } else { 0.0 };
/// let field = Covered { field: Arc::new(Uniform(Vec3::Y)), cover: Arc::new(east) };
/// assert_eq!(field.velocity(Vec3::NEG_X, 0.0), Vec3::Y);
/// assert_eq!(field.cover().map(|cover| cover.at(DVec2::NEG_X)), Some(0.0));
/// ```
#[derive(Clone)]
pub struct Covered {
    /// The field.
    pub field: Arc<dyn Field>,
    /// How much it counts.
    pub cover: Arc<dyn FactorMap>,
}

impl Field for Covered {
    fn velocity(&self, place: Vec3, time: f64) -> Vec3 {
        self.field.velocity(place, time)
    }

    fn row(&self, row: (DVec2, f64), from: usize, time: f64, out: &mut [Vec2]) {
        self.field.row(row, from, time, out);
    }

    fn adaptive(&self) -> Option<&dyn Adaptive> {
        self.field.adaptive()
    }

    fn cover(&self) -> Option<Arc<dyn FactorMap>> {
        Some(self.cover.clone())
    }

    fn spine(&self) -> Option<FieldSpine> {
        self.field.spine()
    }
}

impl fmt::Debug for Covered {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Covered").finish_non_exhaustive()
    }
}
