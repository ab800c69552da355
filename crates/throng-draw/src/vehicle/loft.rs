//! Smooth surfaces through rings of corners.

use glam::{Mat3, Vec2, Vec3};
use std::f32::consts::{FRAC_PI_2, PI, TAU};
use throng_render::Mesh;

/// How far the faces of a wheel are from its middle, in half its width.
pub(super) const HUB: f32 = 1.03;

/// Vertices with normals and colours under construction.
#[derive(Clone, Debug, Default)]
pub(super) struct Loft {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    colors: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Loft {
    /// Adds a closed surface through rings with the same number of corners, anticlockwise seen from the last ring. `color` returns the colour of a face by the ring below it and its middle.
    pub fn add(&mut self, rings: &[Vec<Vec3>], color: impl Fn(usize, Vec3) -> Vec3) {
        let around = rings.first().map_or(0, Vec::len);
        let levels = rings.len();
        if around < 3 || levels < 2 || rings.iter().any(|ring| ring.len() != around) {
            return;
        }
        let at = |level: usize, k: usize| rings[level][k % around];
        let normal = |level: usize, k: usize| {
            let along = at(level, k + 1) - at(level, k + around - 1);
            let up = at((level + 1).min(levels - 1), k) - at(level.saturating_sub(1), k);
            along.cross(up).normalize_or(Vec3::Z)
        };
        for level in 0..levels - 1 {
            for k in 0..around {
                let corners = [(level, k), (level, k + 1), (level + 1, k + 1), (level + 1, k)];
                let places = corners.map(|(level, k)| at(level, k));
                self.face(&places, &corners.map(|(level, k)| normal(level, k)), |middle| color(level, middle));
            }
        }
        let bottom: Vec<Vec3> = rings[0].iter().rev().copied().collect();
        for (level, cap) in [(levels - 1, &rings[levels - 1]), (0, &bottom)] {
            let middle = cap.iter().sum::<Vec3>() / around as f32;
            self.flat(cap, color(level, middle));
        }
    }

    /// Adds a convex face with the normals of its corners.
    fn face(&mut self, corners: &[Vec3], normals: &[Vec3], color: impl Fn(Vec3) -> Vec3) {
        let first = self.positions.len() as u32;
        let middle = corners.iter().sum::<Vec3>() / corners.len() as f32;
        self.positions.extend(corners);
        self.normals.extend(normals);
        self.colors.extend(corners.iter().map(|_| color(middle)));
        self.triangles.extend((1..corners.len() as u32 - 1).map(|k| [first, first + k, first + k + 1]));
    }

    /// Adds a flat convex face of one colour.
    pub fn flat(&mut self, corners: &[Vec3], color: Vec3) {
        let sides = corners.iter().zip(corners.iter().cycle().skip(1));
        let normal = sides.map(|(a, b)| a.cross(*b)).sum::<Vec3>().normalize_or(Vec3::Z);
        self.face(corners, &vec![normal; corners.len()], |_| color);
    }

    /// Adds a wheel about an axis across: its centre, its radius and half its width; rolled forward and steered to the left,
    /// radians; the colours of tyre and rim.
    pub fn wheel(
        &mut self,
        (centre, size): (Vec3, Vec2),
        (rolled, steered): (f32, f32),
        around: usize,
        [tyre, rim, gap]: [Vec3; 3],
    ) {
        let (radius, half) = (size.x, size.y);
        let (steer_sin, steer_cos) = libm::sincosf(steered);
        let place = |out: f32, angle: f32, across: f32| {
            // seen from the left a wheel that rolls forward turns anticlockwise; x is ahead and y to the left
            let (sin, cos) = libm::sincosf(rolled + angle);
            let flat = Vec3::new(cos * out, across, -sin * out);
            centre + Vec3::new(flat.x * steer_cos - flat.y * steer_sin, flat.x * steer_sin + flat.y * steer_cos, flat.z)
        };
        let ring = |out: f32, across: f32| -> Vec<Vec3> {
            (0..around).map(|k| place(out, TAU * k as f32 / around as f32, across)).collect()
        };
        // the axis of the rings is across: from the right to the left
        let profile = [(0.86, -1.0), (1.0, -0.7), (1.0, 0.7), (0.86, 1.0)];
        let rings: Vec<Vec<Vec3>> = profile.iter().map(|&(out, across)| ring(out * radius, across * half)).collect();
        self.add(&rings, |_, _| tyre);
        // spokes on both faces: five pairs of a bright and a dark part
        const SPOKES: usize = 5;
        for side in [1.0, -1.0] {
            for part in 0..2 * SPOKES {
                let width = PI / SPOKES as f32;
                let [from, to] = [part, part + 1].map(|k| k as f32 * width + if k % 2 == 0 { 0.12 } else { -0.12 });
                let across = side * half * HUB;
                let ends =
                    [place(0.0, 0.0, across), place(0.7 * radius, from, across), place(0.7 * radius, to, across)];
                let ends = if side < 0.0 { [ends[0], ends[2], ends[1]] } else { ends };
                self.flat(&ends, if part % 2 == 0 { rim } else { gap });
            }
        }
    }

    /// Returns the mesh, turned and scaled. Scales are uniform.
    pub fn mesh(self, turn: Mat3) -> Mesh<'static> {
        let positions: Vec<Vec3> = self.positions.into_iter().map(|place| turn * place).collect();
        let normals: Vec<Vec3> = self.normals.into_iter().map(|normal| (turn * normal).normalize_or(Vec3::Z)).collect();
        Mesh::new(positions, normals, self.colors, self.triangles).unwrap_or_default()
    }

    /// Returns the triangles, corner by corner.
    #[cfg(test)]
    pub fn corners(&self) -> impl Iterator<Item = [Vec3; 3]> + '_ {
        self.triangles.iter().map(|triangle| triangle.map(|corner| self.positions[corner as usize]))
    }
}

/// Returns a ring of a rectangle with round corners at a height, anticlockwise from above: from `back` to `front`, and
/// `half` to both sides. `round` is the share of the half width that corners take. A corner has `corners` parts, and a side
/// along x has `along` parts.
pub(super) fn rounded(
    [back, front]: [f32; 2],
    half: f32,
    height: f32,
    round: f32,
    [corners, along]: [usize; 2],
) -> Vec<Vec3> {
    let radius = (round * half).min(0.5 * (front - back));
    let centres = [(front - radius, half - radius), (back + radius, half - radius)];
    let centres = [centres[0], centres[1], (centres[1].0, -centres[1].1), (centres[0].0, -centres[0].1)];
    let on = |k: usize, part: usize| {
        let (x, y) = centres[k % 4];
        let (sin, cos) = libm::sincosf(FRAC_PI_2 * (k as f32 + part as f32 / corners as f32));
        Vec3::new(x + radius * cos, y + radius * sin, height)
    };
    let corner = |k: usize| {
        // the first and the third corner are followed by a side along x
        let inner = if k.is_multiple_of(2) { along } else { 1 };
        let (end, next) = (on(k, corners), on(k + 1, 0));
        let side = (1..inner).map(move |part| end.lerp(next, part as f32 / inner as f32));
        (0..=corners).map(move |part| on(k, part)).chain(side)
    };
    (0..4).flat_map(corner).collect()
}
