//! B-splines, rational or not, approximated by lines.

use super::super::curve::cubic;
use super::pairs::Entity;
use crate::error::{Error, Kind};
use crate::geometry::{DVec2, DVec3, distance_to_segment};

/// The greatest degree.
const STEEPEST: f64 = 25.0;
/// Maximum number of lines of a spline with few spans. With more spans, each piece has at most 2^[`LEAST`] lines.
const MOST: usize = 1024;
/// The number of times that a piece can always be halved.
const LEAST: u32 = 4;

/// A B-spline.
struct Spline {
    degree: usize,
    /// Not decreasing. Their number is that of the points, plus the degree, plus one.
    knots: Vec<f64>,
    /// Control points times their weights, and the weights.
    points: Vec<DVec3>,
}

/// Returns the lines of a spline. `degree` and `weights` are the codes of its degree and its weights. A spline without
/// control points passes through its fit points.
///
/// # Errors
/// It has too few points, or knots or weights that do not match them. The error has the line.
pub(super) fn lines(entity: &Entity, degree: i32, weights: i32, tolerance: f64) -> Result<Vec<DVec2>, Error> {
    let (points, fit) = (entity.points(10)?, entity.points(11)?);
    if points.is_empty() && fit.len() > 1 {
        return Ok(through(&fit, tolerance));
    }
    let (knots, weights) = (entity.numbers(40)?, entity.numbers(weights)?);
    let degree = entity.number(degree, 3.0)?;
    let wrong = |message: String| {
        let mut error = Error::new(Kind::Geometry, message).hint("convert splines to polylines before the export");
        error.at = Some((entity.line, 1));
        error
    };
    if !(1.0..=STEEPEST).contains(&degree) {
        return Err(wrong(format!("this spline has the degree {degree}, which should be 1 to {STEEPEST}")));
    }
    let degree = degree as usize;
    let needs = points.len() + degree + 1;
    if points.len() <= degree || knots.len() != needs {
        let (points, knots) = (points.len(), knots.len());
        return Err(wrong(format!(
            "this spline of degree {degree} has {points} control points and {knots} knots: it needs {} points or more, and {needs} knots",
            degree + 1
        )));
    }
    if knots.windows(2).any(|ends| ends[0] > ends[1]) {
        return Err(wrong("the knots of this spline go back".into()));
    }
    if !weights.is_empty() && (weights.len() != points.len() || weights.iter().any(|weight| *weight <= 0.0)) {
        return Err(wrong("this spline needs a weight of more than 0 for every control point, or none".into()));
    }
    let weights = weights.into_iter().chain(std::iter::repeat(1.0));
    let points = points.into_iter().zip(weights).map(|(p, weight)| (p * weight).extend(weight)).collect();
    Ok(Spline { degree, knots, points }.lines(tolerance))
}

impl Spline {
    /// Returns the lines from end to end.
    fn lines(&self, tolerance: f64) -> Vec<DVec2> {
        let spans = (self.degree..self.points.len()).filter(|k| self.knots[*k] < self.knots[k + 1]);
        let spans: Vec<usize> = spans.collect();
        let pieces = self.degree + 1;
        let halvings = (MOST / (spans.len() * pieces).max(1)).checked_ilog2().unwrap_or_default().max(LEAST);
        let mut out = vec![];
        for span in spans {
            let (from, to) = (self.knots[span], self.knots[span + 1]);
            let at = |part: f64| self.at(span, from + (to - from) * part);
            if out.is_empty() {
                out.push(at(0.0));
            }
            for k in 0..pieces {
                let ends = [k, k + 1].map(|k| k as f64 / pieces as f64);
                halved(&at, ends, tolerance, halvings, &mut out);
            }
        }
        out
    }

    /// Returns the point at a parameter within a span of knots: de Boor's algorithm.
    fn at(&self, span: usize, t: f64) -> DVec2 {
        let degree = self.degree;
        let mut d: Vec<DVec3> = self.points[span - degree..=span].to_vec();
        for round in 1..=degree {
            for j in (round..=degree).rev() {
                let (from, to) = (self.knots[span + j - degree], self.knots[span + j + 1 - round]);
                let part = if to > from { (t - from) / (to - from) } else { 0.0 };
                d[j] = d[j - 1].lerp(d[j], part);
            }
        }
        d[degree].truncate() / d[degree].z
    }
}

/// Adds a piece of a curve as lines, without its first point: halves it until the lines are within the tolerance.
fn halved(at: &impl Fn(f64) -> DVec2, ends: [f64; 2], tolerance: f64, halvings: u32, out: &mut Vec<DVec2>) {
    let [from, to] = ends;
    let (start, end) = (at(from), at(to));
    let off = |part: f64| distance_to_segment(at(from + (to - from) * part), start, end);
    if halvings == 0 || [0.25, 0.5, 0.75].into_iter().all(|part| off(part) <= tolerance) {
        out.push(end);
        return;
    }
    let middle = 0.5 * (from + to);
    halved(at, [from, middle], tolerance, halvings - 1, out);
    halved(at, [middle, to], tolerance, halvings - 1, out);
}

/// Returns a curve through points: centripetal Catmull-Rom (C. Yuksel, S. Schaefer, J. Keyser, *Parameterization and
/// applications of Catmull-Rom curves*, Computer-Aided Design 43, 2011), which has no cusps or loops between two
/// points. It is closed if it ends where it begins.
fn through(fit: &[DVec2], tolerance: f64) -> Vec<DVec2> {
    let mut fit = fit.to_vec();
    fit.dedup();
    let n = fit.len();
    if n < 3 {
        return fit;
    }
    let closed = fit[0] == fit[n - 1];
    let before = if closed { fit[n - 2] } else { 2.0 * fit[0] - fit[1] };
    let after = if closed { fit[1] } else { 2.0 * fit[n - 1] - fit[n - 2] };
    let all: Vec<DVec2> = std::iter::once(before).chain(fit.iter().copied()).chain([after]).collect();
    let mut out = vec![fit[0]];
    for four in all.windows(4) {
        let [a, b, c, d] = [four[0], four[1], four[2], four[3]];
        // square roots of the distances
        let [s, t, u] = [a.distance(b), b.distance(c), c.distance(d)].map(f64::sqrt);
        let leaving = (b - a) / s - (c - a) / (s + t) + (c - b) / t;
        let coming = (c - b) / t - (d - b) / (t + u) + (d - c) / u;
        out.extend(cubic([b, b + leaving * (t / 3.0), c - coming * (t / 3.0), c], tolerance));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spline(degree: usize, knots: &[f64], points: &[[f64; 3]]) -> Spline {
        let points = points.iter().map(|[x, y, w]| DVec3::new(x * w, y * w, *w)).collect();
        Spline { degree, knots: knots.to_vec(), points }
    }

    /// Returns a circle of radius 5 as nine points of degree 2: exact.
    fn circle() -> Spline {
        let root = std::f64::consts::FRAC_1_SQRT_2;
        let rim = [(5, 0), (5, 5), (0, 5), (-5, 5), (-5, 0), (-5, -5), (0, -5), (5, -5), (5, 0)];
        let points: Vec<[f64; 3]> = rim
            .iter()
            .enumerate()
            .map(|(i, (x, y))| [f64::from(*x), f64::from(*y), if i % 2 == 1 { root } else { 1.0 }])
            .collect();
        spline(2, &[0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.], &points)
    }

    #[test]
    fn a_rational_circle_is_round() {
        for tolerance in [0.1, 0.01, 1e-4] {
            let lines = circle().lines(tolerance);
            assert!(lines.iter().all(|p| (p.length() - 5.0).abs() < 1e-12));
            let off = lines.windows(2).map(|ends| 5.0 - ends[0].midpoint(ends[1]).length()).fold(0.0, f64::max);
            assert!(off <= tolerance && lines.len() < 1030, "{tolerance}: {off}, {} lines", lines.len());
            assert!(lines[0].distance(lines[lines.len() - 1]) < 1e-12);
        }
    }

    #[test]
    fn points_are_those_of_the_basis_functions() {
        // the recursion of Cox and de Boor, written out
        fn basis(i: usize, p: usize, t: f64, knots: &[f64]) -> f64 {
            if p == 0 {
                return f64::from(u8::from(knots[i] <= t && t < knots[i + 1]));
            }
            let part = |a: f64, b: f64| if b == 0.0 { 0.0 } else { a / b };
            part(t - knots[i], knots[i + p] - knots[i]) * basis(i, p - 1, t, knots)
                + part(knots[i + p + 1] - t, knots[i + p + 1] - knots[i + 1]) * basis(i + 1, p - 1, t, knots)
        }
        let knots = [0.0, 0.0, 0.0, 0.0, 0.3, 0.7, 0.7, 1.5, 2.0, 2.0, 2.0, 2.0];
        let points = [
            [0., 0., 1.],
            [1., 2., 2.],
            [3., 1., 0.5],
            [4., 4., 1.],
            [6., 0., 3.],
            [7., 1., 1.],
            [8., 8., 0.7],
            [9., 2., 1.],
        ];
        let curve = spline(3, &knots, &points);
        for k in 0..200 {
            let t = f64::from(k) * 0.01;
            let span = (3..8).find(|i| knots[*i] <= t && t < knots[i + 1]).unwrap();
            let sum = (0..8).map(|i| curve.points[i] * basis(i, 3, t, &knots)).sum::<DVec3>();
            assert!(curve.at(span, t).distance(sum.truncate() / sum.z) < 1e-12, "{t}");
        }
    }

    #[test]
    fn a_curve_goes_through_its_fit_points() {
        let turn = |k: u32| DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 12.0) * 5.0;
        let mut fit: Vec<DVec2> = (0..12).map(turn).collect();
        fit.push(fit[0]);
        let lines = through(&fit, 1e-3);
        assert!(fit.iter().all(|p| lines.contains(p)));
        // twelve points on a circle: the curve is nearly a circle
        assert!(lines.iter().all(|p| (p.length() - 5.0).abs() < 0.02), "{lines:?}");
        assert_eq!(through(&[DVec2::ZERO, DVec2::X], 0.1), [DVec2::ZERO, DVec2::X]);
    }
}
