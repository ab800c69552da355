//! Buffered Voronoi cells: where an agent can go whatever its neighbours do within theirs (Zhou, Wang, Bandyopadhyay,
//! Schwager, RA-L 2017, who use them as a controller; here they are the last resort of the [guard](super)).

use super::solid::Solid;
use super::{Pose, Scratch};
use crate::avoid::{Line, closest_velocity};
use crate::motion::wrap;
use glam::DVec2;

/// Part of the sum of radii that cells keep in reserve, so that rounding does not turn contacts to glue.
const RESERVE: f64 = 1e-4;
/// Parts of the turn that are tried.
const TURNS: [f32; 3] = [1.0, 0.5, 0.0];

/// One side of a cell: no point of the body moves farther along `normal` than `gap` beyond where the body reached.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    normal: DVec2,
    gap: f64,
}

/// Everything that bounds the cell of `row`.
fn sides<'a>(row: usize, solid: Solid<'a>) -> impl Iterator<Item = Side> + 'a {
    let bodies = solid.bodies;
    let from = bodies.positions[row].as_dvec2();
    let radius = f64::from(bodies.radii[row]);
    let side = |normal: DVec2, distance: f64, clearance: f64, share: f64| Side {
        normal,
        gap: ((distance - clearance) * share).max(0.0),
    };
    let between_discs = move |offset: DVec2, clearance: f64, share: f64| {
        side(offset.normalize_or_zero(), offset.length(), clearance, share)
    };
    let others = solid.others(row).map(move |other| {
        let radii = radius + f64::from(bodies.radii[other]);
        if solid.is_disc(row) && solid.is_disc(other) {
            return between_discs(bodies.positions[other].as_dvec2() - from, radii, 0.5);
        }
        let apart = solid.core(row).separation(&solid.core(other));
        side(apart.normal, apart.distance, radii, 0.5)
    });
    let is_disc = solid.is_disc(row);
    let edges = solid.edges(row).filter(move |_| is_disc);
    let edges = edges.map(move |edge| between_discs(edge.nearest(from) - from, radius, 1.0));
    let discs = solid.discs(row).filter(move |_| is_disc);
    let discs = discs.map(move |disc| between_discs(disc.center - from, radius + disc.radius, 1.0));
    let standing = solid.standing(row).filter(move |_| !is_disc).map(move |(core, size)| {
        let apart = solid.core(row).separation(&core);
        side(apart.normal, apart.distance, radius + size, 1.0)
    });
    others.chain(edges).chain(discs).chain(standing)
}

/// The target nearest to `target` that lies in the cell of `row`, its turn or a part of it kept if there is room.
pub(super) fn clamp(row: usize, solid: Solid<'_>, target: Pose, scratch: &mut Scratch) -> Pose {
    let bodies = solid.bodies;
    let (from, heading) = (bodies.positions[row], bodies.headings[row]);
    let motion = target.position - from;
    let reserve = RESERVE * f64::from(bodies.radii[row]);
    let Scratch { lines, sides: all } = scratch;
    all.clear();
    all.extend(sides(row, solid));
    let sweep = solid.sweep(row, target);
    for part in TURNS {
        let heading = if part == 1.0 { target.heading } else { wrap(heading + sweep.turn as f32 * part) };
        let turned = solid.sweep(row, Pose { position: from, heading });
        let growth = |side: &Side| if turned.turn == 0.0 { 0.0 } else { turned.growth(side.normal) };
        if all.iter().any(|side| growth(side) > side.gap) {
            continue;
        }
        lines.clear();
        lines.extend(all.iter().map(|side| {
            let normal = side.normal.as_vec2();
            // the permitted side is on the left of the line
            let point = normal * (side.gap - growth(side) - reserve).max(0.0) as f32;
            Line { point, direction: normal.perp() }
        }));
        let planned = closest_velocity(lines, motion.length(), motion).unwrap_or_default();
        for part in [1.0, 0.99, 0.9, 0.5] {
            let position = from + planned * part;
            let rounded = position.as_dvec2() - from.as_dvec2();
            if all.iter().all(|side| growth(side) + side.normal.dot(rounded).max(0.0) <= side.gap) {
                return Pose { position, heading };
            }
        }
        return Pose { position: from, heading };
    }
    Pose { position: from, heading }
}
