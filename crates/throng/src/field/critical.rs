//! Where a field comes to a standstill: its critical points.

use super::Sampled;
use glam::{DMat2, DVec2};

/// How much of the turning of a field round a point may be flow towards or away from it, that it is no spiral but a centre.
const CENTER: f64 = 1e-3;

/// A place where a field is zero though it flows round it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalPoint {
    /// Metres from the world's origin.
    pub place: DVec2,
    /// What the field does about it.
    pub kind: Critical,
    /// How the field turns about it, radians a second, counter-clockwise: half of its curl there.
    pub turn: f64,
}

/// What a field does about a place where it is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Critical {
    /// It leads there, straight or in a spiral: who follows it does not get out.
    Sink,
    /// It leads away from there.
    Source,
    /// It leads there from two sides, and away to two others.
    Saddle,
    /// It leads round and round: who follows it goes in circles.
    Center,
}

impl Critical {
    /// Whether who follows the field stays there.
    pub fn traps(self) -> bool {
        matches!(self, Self::Sink | Self::Center)
    }
}

impl Sampled {
    /// All places where the field, interpolated as it is, is zero, cell by cell; but not where it is zero at a corner of the cell:
    /// there it says nothing.
    ///
    /// By the theorem of Poincaré and Hopf the saddles among them, taken from the others, are as many as the times that the field
    /// turns once round along the rim of any box.
    ///
    /// ```
    /// use glam::{DVec2, Vec3};
    /// use throng::field::{Critical, Sampled};
    /// let drain = |place: Vec3, _: f64| Vec3::Z.cross(place) - 0.2 * place;
    /// let field = Sampled::of(&drain, DVec2::splat(-3.1), DVec2::splat(4.0), 0.5, 0.0)?;
    /// let [sink] = field.critical_points()[..] else { panic!("one and no more") };
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

/// Where in the unit square what is interpolated from its corners - at the origin, x, y, and both - is zero, and how it changes
/// there with x and with y.
fn zeros([a, b, c, d]: [DVec2; 4]) -> [Option<(DVec2, DMat2)>; 2] {
    // all on one side of an axis: the most cells by far
    let of_one_sign = |[a, b, c, d]: [f64; 4]| a * b > 0.0 && a * c > 0.0 && a * d > 0.0;
    let zero = [a, b, c, d].contains(&DVec2::ZERO);
    if zero || of_one_sign([a.x, b.x, c.x, d.x]) || of_one_sign([a.y, b.y, c.y, d.y]) {
        return [None; 2];
    }
    // a + x (b - a) along the lower side, and what is added per y
    let (along, up, both) = (b - a, c - a, a - b - c + d);
    // zero where both have the same direction
    let [constant, linear, square] = [a.perp_dot(up), a.perp_dot(both) + along.perp_dot(up), along.perp_dot(both)];
    roots(constant, linear, square).map(|x| {
        let x = x.filter(|x| (0.0..1.0).contains(x))?;
        let (below, rise) = (a + along * x, up + both * x);
        let y = -below.dot(rise) / rise.length_squared();
        let slope = DMat2::from_cols(along + both * y, rise);
        (0.0..1.0).contains(&y).then_some((DVec2::new(x, y), slope))
    })
}

/// The real roots of a quadratic, without loss of digits.
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
