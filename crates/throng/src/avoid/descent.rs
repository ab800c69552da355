//! A local minimum of a differentiable function of a velocity: quasi-Newton steps (BFGS; Nocedal, Wright, Numerical
//! optimization, 2006, algorithm 6.1), shortened until the value falls enough (Armijo) and lengthened while the
//! function stays as steep (Wolfe).

use glam::{Mat2, Vec2};

/// Maximum number of quasi-Newton steps.
const STEPS: usize = 64;
/// Least step, m/s. The search ends where no step of this length leads down.
const EXACT: f32 = 1e-4;
/// Longest step, m/s. Beyond it the function may have other minima.
const LONGEST: f32 = 0.5;
/// Fraction of the decrease predicted by the slope that a step must achieve (Armijo).
const FALL: f32 = 1e-4;
/// Fraction of the slope that may be left after a step (Wolfe).
const FLATTER: f32 = 0.5;

/// A velocity, the value of the function there, and its gradient.
type DescentPoint = (Vec2, f32, Vec2);

/// Returns the local minimum of `function` (value and gradient) reached from `start`. `scale` is approximately the
/// inverse of the second derivative.
pub(super) fn least(start: Vec2, scale: f32, function: impl Fn(Vec2) -> (f32, Vec2)) -> Vec2 {
    let visit = |at: Vec2| {
        let (value, gradient) = function(at);
        (at, value, gradient)
    };
    let initial = Mat2::IDENTITY * scale;
    let (mut here, mut inverse) = (visit(start), initial);
    for _ in 0..STEPS {
        let (at, _, gradient) = here;
        let mut step = -(inverse * gradient);
        if step.dot(gradient) >= 0.0 {
            inverse = initial;
            step = -(inverse * gradient);
        }
        step = step.clamp_length_max(LONGEST);
        let Some(there) = along(here, step, visit) else {
            // the estimate of the curvature may be wrong, as beyond a barrier
            if inverse == initial {
                break;
            }
            inverse = initial;
            continue;
        };
        inverse = updated(inverse, there.0 - at, there.2 - gradient).unwrap_or(initial);
        here = there;
    }
    here.0
}

/// Returns a point along a step at which the function has fallen enough.
fn along(
    (at, value, gradient): DescentPoint,
    step: Vec2,
    visit: impl Fn(Vec2) -> DescentPoint,
) -> Option<DescentPoint> {
    let slope = step.dot(gradient);
    let mut part = 1.0;
    while step.length() * part > EXACT {
        let mut there = visit(at + step * part);
        if there.1 <= value + FALL * part * slope {
            while there.2.dot(step) < FLATTER * slope && step.length() * part * 2.0 <= LONGEST {
                let farther = visit(at + step * (part * 2.0));
                if farther.1 >= there.1 {
                    break;
                }
                (there, part) = (farther, part * 2.0);
            }
            return Some(there);
        }
        part *= 0.5;
    }
    None
}

/// Returns the updated inverse of the second derivative after a step and the change of the gradient in it; `None` if
/// the function is not convex there.
fn updated(inverse: Mat2, step: Vec2, change: Vec2) -> Option<Mat2> {
    let along = step.dot(change);
    if along <= 1e-6 * step.length() * change.length() || along.is_nan() {
        return None;
    }
    let outer = |a: Vec2, b: Vec2| Mat2::from_cols(a * b.x, a * b.y);
    let left = Mat2::IDENTITY - outer(step, change) * (1.0 / along);
    Some(left * inverse * left.transpose() + outer(step, step) * (1.0 / along))
}
