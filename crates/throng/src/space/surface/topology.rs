//! Topology of a mesh: shared corners and edges, connected parts, and orientation.

use super::Bounds;
use glam::{DVec3, Vec3};
use std::f64::consts::TAU;

/// Merges equal points and removes triangles with two equal corners.
pub(super) fn weld(points: &[Vec3], triangles: &[[u32; 3]]) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    // negative zero is the same place as zero
    let key = |i: u32| (points[i as usize] + 0.0).to_array();
    let compare = |a: u32, b: u32| key(a).iter().zip(key(b)).map(|(a, b)| a.total_cmp(&b)).find(|o| o.is_ne());
    order.sort_by(|&a, &b| compare(a, b).unwrap_or(a.cmp(&b)));
    let mut merged = vec![0; points.len()];
    let mut kept: Vec<Vec3> = Vec::new();
    for &i in &order {
        let point = Vec3::from_array(key(i));
        if kept.last() != Some(&point) {
            kept.push(point);
        }
        merged[i as usize] = kept.len() as u32 - 1;
    }
    let triangles = triangles.iter().map(|triangle| triangle.map(|i| merged[i as usize]));
    (kept, triangles.filter(|[a, b, c]| a != b && b != c && c != a).collect())
}

/// Returns the triangle on the other side of each edge, if every edge has two triangles. Edge k of a triangle goes from
/// its corner k to the next.
pub(super) fn neighbours(triangles: &[[u32; 3]]) -> Option<Vec<[u32; 3]>> {
    let sides = (0..triangles.len()).flat_map(|t| (0..3).map(move |k| (t, k)));
    let mut sides: Vec<_> = sides
        .map(|(t, k)| {
            let (a, b) = (triangles[t][k], triangles[t][(k + 1) % 3]);
            (a.min(b), a.max(b), t as u32, k)
        })
        .collect();
    sides.sort_unstable();
    let mut across = vec![[0; 3]; triangles.len()];
    for edge in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let &[(.., t, k), (.., u, l)] = edge else { return None };
        across[t as usize][k] = u;
        across[u as usize][l] = t;
    }
    Some(across)
}

/// Orients the triangles of closed meshes to be counter-clockwise seen from outside. A part within another part is a
/// hollow of it, a part within that is solid again. Returns false if there is no inside: a one-sided surface, or one
/// without volume.
pub(super) fn turn_out(points: &[Vec3], triangles: &mut [[u32; 3]], across: &mut [[u32; 3]]) -> bool {
    let Some(part_of) = agree(triangles, across) else { return false };
    let parts = part_of.iter().max().map_or(0, |&last| last as usize + 1);
    let mut members = vec![Vec::new(); parts];
    for (t, &part) in part_of.iter().enumerate() {
        members[part as usize].push(t);
    }
    let corners = |t: usize| triangles[t].map(|i| points[i as usize].as_dvec3());
    let around =
        |part: &Vec<usize>| Bounds::around(part.iter().flat_map(|&t| triangles[t].map(|i| points[i as usize])));
    let bounds: Vec<Bounds> = members.iter().map(around).collect();
    let mut wrong: Vec<usize> = Vec::new();
    for (part, own) in members.iter().enumerate() {
        let base = corners(own[0])[0];
        let volume: f64 = own.iter().map(|&t| corners(t).map(|p| p - base)).map(|[a, b, c]| a.dot(b.cross(c))).sum();
        let size = (bounds[part].high - bounds[part].low).as_dvec3();
        if volume.abs() <= 1e-9 * size.length().powi(3) {
            return false;
        }
        let holds = |outer: Bounds| outer.contains(bounds[part].low) && outer.contains(bounds[part].high);
        let seen = |other: usize| members[other].iter().map(|&t| solid_angle(base, corners(t))).sum::<f64>();
        // the solid angle of a closed mesh seen from inside is 4 pi
        let within = |&other: &usize| other != part && holds(bounds[other]) && seen(other).abs() > TAU;
        let hollow = (0..parts).filter(within).count() % 2 == 1;
        if (volume < 0.0) != hollow {
            wrong.extend(own);
        }
    }
    for t in wrong {
        turn_over(&mut triangles[t], &mut across[t]);
    }
    true
}

/// Orients neighbouring triangles consistently. Returns the number of the connected part of each triangle, or `None`
/// for a one-sided surface.
fn agree(triangles: &mut [[u32; 3]], across: &mut [[u32; 3]]) -> Option<Vec<u32>> {
    let mut part_of = vec![u32::MAX; triangles.len()];
    let mut parts = 0;
    for seed in 0..triangles.len() {
        if part_of[seed] != u32::MAX {
            continue;
        }
        part_of[seed] = parts;
        let mut open = vec![seed];
        while let Some(t) = open.pop() {
            for k in 0..3 {
                let (start, end) = (triangles[t][k], triangles[t][(k + 1) % 3]);
                let next = across[t][k] as usize;
                // consistent neighbours traverse their edge in opposite directions
                let same_way = (0..3).any(|l| (triangles[next][l], triangles[next][(l + 1) % 3]) == (start, end));
                if part_of[next] == u32::MAX {
                    part_of[next] = parts;
                    open.push(next);
                    if same_way {
                        turn_over(&mut triangles[next], &mut across[next]);
                    }
                } else if same_way {
                    return None;
                }
            }
        }
        parts += 1;
    }
    Some(part_of)
}

/// Reverses a triangle and its list of neighbours.
fn turn_over(triangle: &mut [u32; 3], across: &mut [u32; 3]) {
    triangle.swap(1, 2);
    across.swap(0, 2);
}

/// Returns the solid angle of a triangle as seen from `eye`, negative from behind (Van Oosterom and Strackee, IEEE
/// Transactions on Biomedical Engineering 30(2), 1983).
fn solid_angle(eye: DVec3, corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| corner - eye);
    let [x, y, z] = [a, b, c].map(DVec3::length);
    2.0 * libm::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y)
}
