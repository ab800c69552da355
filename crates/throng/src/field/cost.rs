//! What ways cost.

/// The part of a body's radius that links between cells keep off walls: round the corner of a wall they dip below the radius. With
/// cells as wide as the radius that is by this part: a half of the square root of 3.
pub(super) const KEPT: f64 = 0.866;
/// What is left out of the cost of clearance.
const LITTLE: f32 = 0.01;

/// How far from where bodies touch walls they cost something, metres.
pub(super) fn reach(clearance: f32) -> f32 {
    (clearance / LITTLE).sqrt()
}

/// What a metre costs more at a gap between a body and a wall, metres: `clearance / gap^2`, at most `dearest`.
pub(super) fn close(gap: f32, (clearance, dearest): (f32, f32)) -> f32 {
    if gap <= 0.0 {
        dearest
    } else if gap < reach(clearance) {
        (clearance / (gap * gap)).min(dearest)
    } else {
        0.0
    }
}

/// What a straight way costs that is so long: pieces of half a cell, each as dear as what `cost` says about its middle, given as a part of
/// the way; where it says nothing, as at the start.
pub(super) fn straight(length: f64, cell: f64, cost: impl Fn(f64) -> Option<f32>) -> f64 {
    let pieces = (2.0 * length / cell).ceil().max(1.0);
    let first = cost(0.0).unwrap_or(1.0);
    let piece = |index: usize| f64::from(cost((index as f64 + 0.5) / pieces).unwrap_or(first));
    (0..pieces as usize).map(piece).sum::<f64>() / pieces * length
}
