//! Buffered Voronoi cells: where an agent can go whatever its neighbours do within theirs (Zhou, Wang, Bandyopadhyay,
//! Schwager, RA-L 2017, who use them as a controller; here they are the last resort of the [guard](super)).

use super::{Bodies, Contacts, Scratch};
use crate::avoid::{Line, closest_velocity};
use crate::space::Walls;
use glam::{DVec2, Vec2};

/// Part of the sum of radii that cells keep in reserve, so that rounding does not turn contacts to glue.
const RESERVE: f64 = 1e-4;

/// One side of a cell: displacement along `normal` is at most `gap`.
#[derive(Clone, Copy)]
struct Side {
    normal: DVec2,
    gap: f64,
}

/// Everything that bounds the cell of `row`.
fn sides<'a>(
    row: usize,
    bodies: &'a Bodies<'_>,
    contacts: &'a Contacts,
    walls: &'a Walls,
) -> impl Iterator<Item = Side> + 'a {
    let from = bodies.positions[row].as_dvec2();
    let radius = f64::from(bodies.radii[row]);
    let side = |offset: DVec2, clearance: f64, share: f64| Side {
        normal: offset.normalize_or_zero(),
        gap: ((offset.length() - clearance) * share).max(0.0),
    };
    let others = contacts.of(row).iter().map(move |&other| {
        let other = other as usize;
        let radii = radius + f64::from(bodies.radii[other]);
        side(bodies.positions[other].as_dvec2() - from, radii, 0.5)
    });
    let edges = contacts
        .edges_of(row)
        .iter()
        .map(move |&index| side(walls.edges()[index as usize].nearest(from) - from, radius, 1.0));
    let discs = contacts.discs_of(row).iter().map(move |&index| {
        let disc = &walls.discs()[index as usize];
        side(disc.center - from, radius + disc.radius, 1.0)
    });
    others.chain(edges).chain(discs)
}

/// The target nearest to `target` that lies in the cell of `row`.
pub(super) fn clamp(
    row: usize,
    bodies: &Bodies<'_>,
    contacts: &Contacts,
    walls: &Walls,
    target: Vec2,
    scratch: &mut Scratch,
) -> Vec2 {
    let from = bodies.positions[row];
    let motion = target - from;
    scratch.lines.clear();
    let reserve = RESERVE * f64::from(bodies.radii[row]);
    for Side { normal, gap } in sides(row, bodies, contacts, walls) {
        let normal = normal.as_vec2();
        // the permitted side is on the left of the line
        let point = normal * (gap - reserve).max(0.0) as f32;
        scratch.lines.push(Line { point, direction: normal.perp() });
    }
    let planned = closest_velocity(&scratch.lines, motion.length(), motion).unwrap_or(Vec2::ZERO);
    for part in [1.0, 0.99, 0.9, 0.5] {
        let target = from + planned * part;
        let rounded = target.as_dvec2() - from.as_dvec2();
        if sides(row, bodies, contacts, walls).all(|side| side.normal.dot(rounded) <= side.gap) {
            return target;
        }
    }
    from
}
