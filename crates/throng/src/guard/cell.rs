//! Buffered Voronoi cells: regions in which an agent is safe whatever its neighbours do within their own cells (Zhou,
//! Wang, Bandyopadhyay, Schwager, RA-L 2017). The paper uses the cells as a controller. Here they are the last resort
//! of the [guard](super).

use super::BodyPose;
use super::certify::CertifyScratch;
use super::solid::GuardedObjects;
use crate::avoid::{HalfPlane, HalfSpace, closest_velocity, closest_velocity_in_space};
use crate::motion::wrap;
use glam::{DVec2, DVec3};

/// Fraction of the radius that a cell keeps in reserve. Without it rounding would make bodies in contact stick
/// together.
const RESERVE: f64 = 1e-4;
/// Fractions of the turn that are tried, in this order.
const TURNS: [f32; 3] = [1.0, 0.5, 0.0];

/// One side of a cell. No point of the body moves along `normal` farther than `gap` beyond the body's present extent.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellSide {
    normal: DVec3,
    gap: f64,
}

impl CellSide {
    /// Returns the intersection of the ground with the plane `room` metres away, as a half-plane. Returns `None` if the
    /// plane is level.
    fn line(&self, room: f64) -> Option<HalfPlane> {
        let part = (1.0 - self.normal.z * self.normal.z).sqrt();
        let normal = (self.normal.truncate() / part).as_vec2();
        let point = normal * (room / part) as f32;
        (part > 1e-3).then(|| HalfPlane { point, direction: normal.perp() })
    }

    fn plane(&self, room: f64) -> HalfSpace {
        let normal = self.normal.as_vec3();
        HalfSpace { point: normal * room as f32, normal: -normal }
    }
}

/// Returns all sides of the cell of `row`.
fn sides<'a>(row: usize, solid: GuardedObjects<'a>) -> impl Iterator<Item = CellSide> + 'a {
    let bodies = solid.bodies;
    let place = bodies.place(row).as_dvec3();
    let from = place.truncate();
    let radius = f64::from(bodies.radii[row]);
    let side = |normal: DVec3, distance: f64, clearance: f64, share: f64| CellSide {
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
    let ground = CellSide { normal: DVec3::NEG_Z, gap: place.z };
    others.chain(edges).chain(discs).chain(standing).chain([ground])
}

/// Returns the pose nearest to `target` that lies in the cell of `row`. The turn, or a fraction of it, is kept if the
/// cell has room for it.
pub(super) fn clamp(row: usize, solid: GuardedObjects<'_>, target: BodyPose, scratch: &mut CertifyScratch) -> BodyPose {
    let bodies = solid.bodies;
    let (from, heading) = (bodies.place(row), bodies.headings[row]);
    let stand = BodyPose { heading, ..target }.with_place(from);
    let motion = target.place() - from;
    let is_grounded = solid.is_grounded(row, target);
    let reserve = RESERVE * f64::from(bodies.radii[row]);
    let CertifyScratch { lines, planes, sides: all, .. } = scratch;
    all.clear();
    all.extend(sides(row, solid));
    let sweep = solid.sweep(row, target);
    for part in TURNS {
        let heading = if part == 1.0 { target.heading } else { wrap(heading + sweep.turn as f32 * part) };
        let stand = BodyPose { heading, ..stand };
        let turned = solid.sweep(row, stand);
        let growth = |side: &CellSide| {
            let along = side.normal.truncate();
            // a turn about the vertical does not move the body down
            if turned.turn == 0.0 || along == DVec2::ZERO { 0.0 } else { turned.growth(along) }
        };
        if all.iter().any(|side| growth(side) > side.gap) {
            continue;
        }
        let room = |side: &CellSide| (side.gap - growth(side) - reserve).max(0.0);
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

#[cfg(test)]
mod tests {
    use super::super::cores::Cores;
    use super::super::{Contacts, GuardedBodies, Solids};
    use super::*;
    use crate::Obstacle;
    use crate::perceive::Grid;
    use crate::space::Walls;
    use glam::Vec2;
    use std::f32::consts::FRAC_PI_2;

    /// Returns the clamped pose of a body at (3, 1) that faces +x, next to a wall along the line y = `wall`.
    fn clamped(core: Vec2, target: BodyPose, wall: f64) -> BodyPose {
        let positions = [Vec2::new(3.0, 1.0)];
        let bodies = GuardedBodies {
            positions: &positions,
            altitudes: &[0.0].into_iter().collect(),
            headings: &[0.0],
            cores: &[core].into_iter().collect(),
            radii: &[0.2].into_iter().collect(),
            reach: &[2.0].into_iter().collect(),
            guarded: &[true].into_iter().collect(),
            solids: &Solids::default(),
            resting: &[],
        };
        let points = vec![DVec2::new(-20.0, wall), DVec2::new(20.0, wall)];
        let walls = Walls::new(&[], &[Obstacle::Wall { points }], DVec2::ZERO);
        let (mut grid, mut contacts, mut cores) = (Grid::default(), Contacts::default(), Cores::default());
        grid.rebuild(&positions, &[0], 1.0);
        contacts.collect(&bodies, &[0], &grid, &walls, |_, _| true, |_| None);
        cores.rebuild(&bodies);
        let solid = GuardedObjects { bodies: &bodies, contacts: &contacts, walls: &walls, cores: &cores };
        clamp(0, solid, target, &mut CertifyScratch::default())
    }

    /// A disc moves up to the wall, less a ten-thousandth of its radius.
    #[test]
    fn a_clamped_disc_moves_up_to_the_wall() {
        let target = BodyPose { position: Vec2::new(3.0, 2.5), altitude: 0.0, heading: 0.0 };
        let at = clamped(Vec2::ZERO, target, 1.9);
        let room = 1.9 - 1.0 - 0.2;
        assert!((room * 0.9999 - 2e-5..=room).contains(&f64::from(at.position.y - 1.0)), "{at:?}");
        assert!((at.position.x - 3.0).abs() < 1e-6, "{at:?}");
    }

    /// The end of a bar moves sideways with the sine of the turn. The wall leaves room for half of a quarter turn.
    #[test]
    fn a_bar_without_room_for_its_turn_turns_by_half() {
        let target = BodyPose { position: Vec2::new(3.0, 1.0), altitude: 0.0, heading: FRAC_PI_2 };
        let bar = Vec2::new(1.0, 0.0);
        let turned = |room: f64| clamped(bar, target, 1.0 + 0.2 + room).heading;
        assert!((turned(1.8) - FRAC_PI_2).abs() < 1e-6);
        let half = turned(0.95);
        assert!((half - 0.5 * FRAC_PI_2).abs() < 1e-6, "{half}");
        assert_eq!(turned(0.1), 0.0);
    }
}
