//! The costs of routes.

/// The part of the radius that links between cells keep from walls: a straight link round the corner of a wall dips
/// below the radius. With cells as wide as the radius it dips to this part: half of the square root of 3.
pub(super) const KEPT: f64 = 0.866;
/// The cost of clearance below which it is neglected.
const LITTLE: f32 = 0.01;

/// Returns the distance, metres, beyond the contact with a wall up to which clearance costs something.
pub(super) fn reach(clearance: f32) -> f32 {
    (clearance / LITTLE).sqrt()
}

/// Returns the extra cost of a metre at a gap (metres) between a body and a wall: `clearance / gap^2`, at most
/// `dearest`.
pub(super) fn close(gap: f32, (clearance, dearest): (f32, f32)) -> f32 {
    if gap <= 0.0 {
        dearest
    } else if gap < reach(clearance) {
        (clearance / (gap * gap)).min(dearest)
    } else {
        0.0
    }
}

/// Returns the cost of a straight way of this length, summed over pieces of half a cell. `cost` returns the cost of a
/// metre at a part (0 to 1) of the way; where it returns none, the cost at the start counts.
pub(super) fn straight(length: f64, cell: f64, cost: impl Fn(f64) -> Option<f32>) -> f64 {
    let pieces = (2.0 * length / cell).ceil().max(1.0);
    let first = cost(0.0).unwrap_or(1.0);
    let piece = |index: usize| f64::from(cost((index as f64 + 0.5) / pieces).unwrap_or(first));
    (0..pieces as usize).map(piece).sum::<f64>() / pieces * length
}
