//! The slope of arrival times.

use super::eikonal::{Links, NodeLattice, beside, bit};

/// Concave bend of the times over three nodes, in metres of front for the width of a cell at the cost there, above
/// which fronts meet between the nodes: the slope is one-sided there.
const KINK: f32 = 0.05;
/// The same for a convex bend, as around a point: above this it is too sharp for the second order.
const ROUND: f32 = 0.4;

/// Returns the slope of the times at a node along each axis, in metres of front a metre, and whether it is known along
/// all axes. It is unknown, and zero, along an axis on which only neighbours that the front reaches later are linked.
///
/// Where fronts meet there is a ridge: the slope is that of the side from which the front came first. Elsewhere the
/// slope is that of both sides, if the bend is small.
pub(super) fn slope<const D: usize>(
    lattice: &NodeLattice<D>,
    (links, cost): (&[Links], &[f32]),
    times: &[f32],
    node: usize,
) -> ([f32; D], bool) {
    let strides = lattice.strides();
    let width = lattice.cell as f32;
    let (mut slope, mut whole) = ([0.0; D], true);
    for axis in 0..D {
        let beside = |node: usize, after: usize| beside(node, strides[axis], after);
        let rise_from = |node: usize, after: usize| {
            let linked = links[node] & bit(axis, after) != 0;
            let rise = if linked { times[node] - times[beside(node, after)] } else { f32::NEG_INFINITY };
            (rise > f32::NEG_INFINITY).then_some(rise)
        };
        let (before, after) = (rise_from(node, 0), rise_from(node, 1));
        let unit = width * cost[node];
        if let (Some(before), Some(after)) = (before, after) {
            if (-ROUND * unit..=KINK * unit).contains(&(before + after)) {
                slope[axis] = 0.5 * (before - after) / width;
                continue;
            }
            // the bottom of a narrow valley
            if before.max(after) <= 0.0 {
                continue;
            }
        }
        let (rise, side) = match (before, after) {
            (Some(before), Some(after)) if after > before => (after, 1),
            (Some(before), _) => (before, 0),
            (None, Some(after)) => (after, 1),
            (None, None) => (f32::NEG_INFINITY, 0),
        };
        if rise < 0.0 {
            whole = false;
            continue;
        }
        // of second order where the bend is small, as around a point, and no fronts meet
        let rise = match rise_from(beside(node, side), side) {
            Some(next) if (-KINK * unit..=ROUND * unit).contains(&(rise - next)) => 1.5 * rise - 0.5 * next,
            _ => rise,
        };
        slope[axis] = if side == 1 { -rise / width } else { rise / width };
    }
    (slope, whole)
}
