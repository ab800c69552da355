//! Buffered Voronoi cells: where an agent can go whatever its neighbours do within theirs (Zhou, Wang, Bandyopadhyay,
//! Schwager, RA-L 2017, who use them as a controller; here they are the last resort of the [guard](super)).

use super::Pose;
use super::certify::Scratch;
use super::solid::Solid;
use crate::avoid::{Line, Plane, closest_velocity, closest_velocity_in_space};
use crate::motion::wrap;
use glam::{DVec2, DVec3};

/// Part of the sum of radii that cells keep in reserve, so that rounding does not turn contacts to glue.
const RESERVE: f64 = 1e-4;
/// Parts of the turn that are tried.
const TURNS: [f32; 3] = [1.0, 0.5, 0.0];

/// One side of a cell: no point of the body moves farther along `normal` than `gap` beyond where the body reached.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    normal: DVec3,
    gap: f64,
}

impl Side {
    /// The line in which the plane `room` away cuts the ground, the permitted side on its left; none for one that is
    /// level.
    fn line(&self, room: f64) -> Option<Line> {
        let part = (1.0 - self.normal.z * self.normal.z).sqrt();
        let normal = (self.normal.truncate() / part).as_vec2();
        let point = normal * (room / part) as f32;
        (part > 1e-3).then(|| Line { point, direction: normal.perp() })
    }

    fn plane(&self, room: f64) -> Plane {
        let normal = self.normal.as_vec3();
        Plane { point: normal * room as f32, normal: -normal }
    }
}

/// Everything that bounds the cell of `row`.
fn sides<'a>(row: usize, solid: Solid<'a>) -> impl Iterator<Item = Side> + 'a {
    let bodies = solid.bodies;
    let place = bodies.place(row).as_dvec3();
    let from = place.truncate();
    let radius = f64::from(bodies.radii[row]);
    let side = |normal: DVec3, distance: f64, clearance: f64, share: f64| Side {
        normal,
        gap: ((distance - clearance) * share).max(0.0),
    };
    let between_discs = move |offset: DVec3, clearance: f64, share: f64| {
        side(offset.normalize_or_zero(), offset.length(), clearance, share)
    };
    let level = move |offset: DVec2| offset.extend(0.0);
    let others = solid.others(row).map(move |other| {
        let radii = radius + f64::from(bodies.radii[other]);
        if solid.is_disc(row) && solid.is_disc(other) {
            return between_discs(bodies.place(other).as_dvec3() - place, radii, 0.5);
        }
        let apart = solid.core(row).separation(&solid.core(other));
        side(level(apart.normal), apart.distance, radii, 0.5)
    });
    let is_disc = solid.is_disc(row);
    let edges = solid.edges(row).filter(move |_| is_disc);
    let edges = edges.map(move |edge| between_discs(level(edge.nearest(from) - from), radius, 1.0));
    let discs = solid.discs(row).filter(move |_| is_disc);
    let discs = discs.map(move |disc| between_discs(level(disc.center - from), radius + disc.radius, 1.0));
    let standing = solid.standing(row).filter(move |_| !is_disc).map(move |(core, size)| {
        let apart = solid.core(row).separation(&core);
        side(level(apart.normal), apart.distance, radius + size, 1.0)
    });
    let ground = Side { normal: DVec3::NEG_Z, gap: place.z };
    others.chain(edges).chain(discs).chain(standing).chain([ground])
}

/// The target nearest to `target` that lies in the cell of `row`, its turn or a part of it kept if there is room.
pub(super) fn clamp(row: usize, solid: Solid<'_>, target: Pose, scratch: &mut Scratch) -> Pose {
    let bodies = solid.bodies;
    let (from, heading) = (bodies.place(row), bodies.headings[row]);
    let stand = Pose { heading, ..target }.with_place(from);
    let motion = target.place() - from;
    let is_grounded = solid.is_grounded(row, target);
    let reserve = RESERVE * f64::from(bodies.radii[row]);
    let Scratch { lines, planes, sides: all, .. } = scratch;
    all.clear();
    all.extend(sides(row, solid));
    let sweep = solid.sweep(row, target);
    for part in TURNS {
        let heading = if part == 1.0 { target.heading } else { wrap(heading + sweep.turn as f32 * part) };
        let stand = Pose { heading, ..stand };
        let turned = solid.sweep(row, stand);
        let growth = |side: &Side| if turned.turn == 0.0 { 0.0 } else { turned.growth(side.normal.truncate()) };
        if all.iter().any(|side| growth(side) > side.gap) {
            continue;
        }
        let room = |side: &Side| (side.gap - growth(side) - reserve).max(0.0);
        let planned = if is_grounded {
            lines.clear();
            lines.extend(all.iter().filter_map(|side| side.line(room(side))));
            closest_velocity(lines, motion.length(), motion.truncate()).unwrap_or_default().extend(0.0)
        } else {
            planes.clear();
            planes.extend(all.iter().map(|side| side.plane(room(side))));
            closest_velocity_in_space(planes, motion.length(), motion).unwrap_or_default()
        };
        for part in [1.0, 0.99, 0.9, 0.5] {
            let moved = bodies.solids.lead(row, bodies, stand.with_place(from + planned * part));
            let rounded = solid.motion(row, moved);
            if all.iter().all(|side| growth(side) + side.normal.dot(rounded).max(0.0) <= side.gap) {
                return moved;
            }
        }
        return stand;
    }
    stand
}
