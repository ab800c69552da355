//! Critical points of a field: places where it is zero.

use super::Sampled;
use glam::{DMat2, DVec2};

/// Maximum ratio of divergence to curl at which a point is a centre, not a spiral.
const CENTER: f64 = 1e-3;

/// A place where a field is zero while it flows around the place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalPoint {
    /// Metres from the origin.
    pub place: DVec2,
    /// What the field does around the place.
    pub kind: Critical,
    /// Rotation of the field about the place, radians a second, counter-clockwise: half of its curl there.
    pub turn: f64,
}

/// What a field does around a place where it is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Critical {
    /// It leads there, straight or in a spiral: an agent that follows it does not get out.
    Sink,
    /// It leads away from there.
    Source,
    /// It leads there from two sides and away to two other sides.
    Saddle,
    /// It circles the place: an agent that follows it goes in circles.
    Center,
}

impl Critical {
    /// Whether an agent that follows the field stays near the place.
    pub fn traps(self) -> bool {
        matches!(self, Self::Sink | Self::Center)
    }
}

impl Sampled {
    /// Returns all places where the interpolated field is zero, cell by cell. Cells with a corner where the field is
    /// zero are left out: the field is undefined there.
    ///
    /// By the Poincaré-Hopf theorem, the number of the other points minus the number of saddles in a box is the number
    /// of full turns of the field along the box's rim.
    ///
    /// ```
    /// use glam::{DVec2, Vec3};
    /// use throng_field::{Critical, Sampled};
    /// let drain = |place: Vec3, _: f64| Vec3::Z.cross(place) - 0.2 * place;
    /// let field = Sampled::of(&drain, DVec2::splat(-3.1), DVec2::splat(4.0), 0.5, 0.0)?;
    /// let [sink] = field.critical_points()[..] else { panic!("there is exactly one critical point") };
    /// assert!(sink.kind == Critical::Sink && sink.place.length() < 1e-6 && (sink.turn - 1.0).abs() < 1e-6);
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn critical_points(&self) -> Vec<CriticalPoint> {
        let (columns, all) = (self.columns(), self.velocities());
        let mut found = Vec::new();
        for row in 0..self.rows() - 1 {
            for column in 0..columns - 1 {
                let first = row * columns + column;
                let corners = [first, first + 1, first + columns, first + columns + 1].map(|at| all[at].as_dvec2());
                let low = self.low() + DVec2::new(column as f64, row as f64) * self.cell();
                found.extend(zeros(corners).into_iter().flatten().map(|(at, slope)| CriticalPoint {
                    place: low + at * self.cell(),
                    kind: kind(slope),
                    turn: 0.5 * (slope.x_axis.y - slope.y_axis.x) / self.cell(),
                }));
            }
        }
        found
    }
}

/// Returns the zeros, in the unit square, of the bilinear interpolation of its corners (the origin, x, y, and both),
/// with the derivatives by x and y there.
fn zeros([a, b, c, d]: [DVec2; 4]) -> [Option<(DVec2, DMat2)>; 2] {
    // no sign change along an axis: by far the most cells
    let of_one_sign = |[a, b, c, d]: [f64; 4]| a * b > 0.0 && a * c > 0.0 && a * d > 0.0;
    let zero = [a, b, c, d].contains(&DVec2::ZERO);
    if zero || of_one_sign([a.x, b.x, c.x, d.x]) || of_one_sign([a.y, b.y, c.y, d.y]) {
        return [None; 2];
    }
    // the value at x on the lower side is a + along x; per y, up + both x is added
    let (along, up, both) = (b - a, c - a, a - b - c + d);
    // the zero is where both are parallel
    let [constant, linear, square] = [a.perp_dot(up), a.perp_dot(both) + along.perp_dot(up), along.perp_dot(both)];
    roots(constant, linear, square).map(|x| {
        let x = x.filter(|x| (0.0..1.0).contains(x))?;
        let (below, rise) = (a + along * x, up + both * x);
        let y = -below.dot(rise) / rise.length_squared();
        let slope = DMat2::from_cols(along + both * y, rise);
        (0.0..1.0).contains(&y).then_some((DVec2::new(x, y), slope))
    })
}

/// Returns the real roots of a quadratic without loss of digits by cancellation.
fn roots(constant: f64, linear: f64, square: f64) -> [Option<f64>; 2] {
    let discriminant = linear * linear - 4.0 * square * constant;
    if discriminant < 0.0 {
        return [None; 2];
    }
    let q = -0.5 * (linear + discriminant.sqrt().copysign(linear));
    let finite = |root: f64| Some(root).filter(|root| root.is_finite());
    [finite(q / square), finite(constant / q)]
}

fn kind(slope: DMat2) -> Critical {
    let divergence = slope.x_axis.x + slope.y_axis.y;
    let curl = slope.x_axis.y - slope.y_axis.x;
    if slope.determinant() < 0.0 {
        Critical::Saddle
    } else if divergence.abs() <= CENTER * curl.abs() {
        Critical::Center
    } else if divergence < 0.0 {
        Critical::Sink
    } else {
        Critical::Source
    }
}
