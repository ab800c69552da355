//! The shape of an agent in a mesh: facing +x upright, standing on the ground or centred on its position.

use super::mesh::Mesh;
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

/// Corners of each level of a walking figure.
const SIDES: u32 = 10;
/// The levels of a walking figure, from the feet to the top of the head: radius relative to the agent's radius, and
/// height, metres.
const LEVELS: [(f32, f32); 7] =
    [(0.6, 0.0), (1.0, 1.15), (0.9, 1.35), (0.35, 1.43), (0.5, 1.55), (0.5, 1.66), (0.3, 1.75)];

/// Returns an agent of radius 1: a walking agent stands on the ground, 1.75 m high; a flying agent is a dart within a
/// sphere.
pub(super) fn mesh(flies: bool) -> Mesh {
    if flies { dart() } else { figure() }
}

/// Returns the scale of an agent of a radius: ahead, across and upwards.
pub(super) fn scale(radius: f32, flies: bool) -> Vec3 {
    if flies { Vec3::splat(radius) } else { Vec3::new(radius, radius, 1.0) }
}

/// Returns a round figure with a chest that points ahead.
fn figure() -> Mesh {
    let mut mesh = Mesh::default();
    for (radius, height) in LEVELS {
        let corner = |k: u32| (radius * Vec2::from_angle(TAU * k as f32 / SIDES as f32)).extend(height);
        mesh.points.extend((0..SIDES).map(corner));
    }
    for level in 1..LEVELS.len() as u32 {
        let at = |level: u32, k: u32| level * SIDES + k % SIDES;
        let [low, high] = [level - 1, level];
        for k in 0..SIDES {
            mesh.triangles.push([at(low, k), at(low, k + 1), at(high, k + 1)]);
            mesh.triangles.push([at(low, k), at(high, k + 1), at(high, k)]);
        }
    }
    let (bottom, top) = (mesh.points.len() as u32, LEVELS.len() as u32 * SIDES - SIDES);
    mesh.triangles.extend((1..SIDES - 1).flat_map(|k| [[0, k + 1, k], [top, top + k, top + k + 1]]));
    mesh.points
        .extend([(0.6, 0.5, 1.1), (0.6, 0.0, 1.3), (0.6, -0.5, 1.1), (0.6, 0.0, 0.9), (1.5, 0.0, 1.1)].map(Vec3::from));
    mesh.triangles.extend((0..4).map(|k| [bottom + k, bottom + (k + 1) % 4, bottom + 4]));
    mesh.triangles.extend([[0, 2, 1], [0, 3, 2]].map(|three| three.map(|at| bottom + at)));
    mesh
}

/// Returns a flat body with wings and a high back, which shows its bank angle.
fn dart() -> Mesh {
    let [nose, left, right, tail, back, belly] = [0, 1, 2, 3, 4, 5];
    let points =
        [(1.0, 0.0, 0.0), (-0.7, 0.7, 0.0), (-0.7, -0.7, 0.0), (-0.5, 0.0, 0.0), (-0.6, 0.0, 0.45), (-0.4, 0.0, -0.15)];
    let over = [[nose, left, back], [left, tail, back], [back, tail, right], [nose, back, right]];
    let under = [[nose, belly, left], [left, belly, tail], [belly, right, tail], [nose, right, belly]];
    Mesh { points: points.map(Vec3::from).to_vec(), triangles: [over, under].concat() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_are_closed_and_turned_outwards() {
        for flies in [false, true] {
            let mesh = mesh(flies);
            let corners = |&[a, b, c]: &[u32; 3]| [a, b, c].map(|at| mesh.points[at as usize]);
            let volume: f32 = mesh.triangles.iter().map(corners).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
            assert!(volume > 0.1, "flies {flies}: {volume}");
            for &[a, b, c] in &mesh.triangles {
                for (from, to) in [(a, b), (b, c), (c, a)] {
                    let back = mesh.triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
                    assert_eq!(back.filter(|&edge| edge == (to, from)).count(), 1, "flies {flies}: {from} to {to}");
                }
            }
            let ahead = mesh.points.iter().max_by(|a, b| a.x.total_cmp(&b.x)).unwrap();
            assert!(ahead.x >= 1.0 && ahead.y == 0.0);
        }
    }
}
