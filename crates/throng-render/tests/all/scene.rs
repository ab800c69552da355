//! Scenes of tests, and a ray caster as their oracle.

use glam::{DVec3, Mat3, Quat, Vec2, Vec3};
use throng_render::{Body, Material, Mesh, View};

/// A generator of numbers (SplitMix64).
pub struct Numbers(pub u64);

impl Numbers {
    /// Returns a number from 0 to 1.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a number between two.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// Returns a point of a box.
    pub fn point(&mut self, low: DVec3, high: DVec3) -> DVec3 {
        DVec3::new(self.between(low.x, high.x), self.between(low.y, high.y), self.between(low.z, high.z))
    }

    /// Returns a rotation.
    pub fn turn(&mut self) -> Mat3 {
        let axis = self.point(DVec3::NEG_ONE, DVec3::ONE).normalize_or(DVec3::Z);
        Mat3::from_quat(Quat::from_axis_angle(axis.as_vec3(), self.between(0.0, std::f64::consts::TAU) as f32))
    }
}

/// Returns a box with edges of 1 m about its middle.
pub fn cube() -> Mesh<'static> {
    let corner = |x: f32, y: f32| Vec2::new(x, y);
    Mesh::prism(&[vec![corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)]], -0.5, 0.5)
}

/// Returns bodies of the meshes at random places before a viewpoint at the origin that looks along y.
pub fn bodies<'a>(meshes: &[&'a Mesh<'a>], count: usize, numbers: &mut Numbers) -> Vec<Body<'a>> {
    let body = |k: usize| Body {
        mesh: meshes[k % meshes.len()],
        place: numbers.point(DVec3::new(-6.0, 4.0, -4.0), DVec3::new(6.0, 14.0, 4.0)),
        turn: numbers.turn() * numbers.between(1.0, 2.0) as f32,
        material: Material::plain(Vec3::splat(0.5)),
        thin: false,
    };
    (0..count).map(body).collect()
}

/// Returns the distance along `direction` from `eye` to the nearest front of a triangle (Moller, Trumbore, 1997).
pub fn cast(bodies: &[Body<'_>], eye: DVec3, direction: DVec3) -> Option<f64> {
    let mut nearest = None;
    for body in bodies {
        let places: Vec<DVec3> =
            body.mesh.positions().iter().map(|&place| body.place + (body.turn * place).as_dvec3()).collect();
        for corners in body.mesh.triangles() {
            let [a, b, c] = corners.map(|corner| places[corner as usize]);
            let (u, v) = (b - a, c - a);
            let normal = u.cross(v);
            let facing = -direction.dot(normal);
            if facing <= 0.0 && !body.thin {
                continue;
            }
            let from = eye - a;
            let part = |share: f64| share / facing;
            let cross = from.cross(direction);
            let (s, t, way) = (part(v.dot(cross)), part(-u.dot(cross)), part(from.dot(normal)));
            if s >= 0.0 && t >= 0.0 && s + t <= 1.0 && way > 0.0 && nearest.is_none_or(|nearest| way < nearest) {
                nearest = Some(way);
            }
        }
    }
    nearest
}

/// Returns the direction of the middle of a pixel.
pub fn ray(view: &View, column: u32, row: u32) -> DVec3 {
    let at = (Vec2::new(column as f32 + 0.5, row as f32 + 0.5) - view.centre).as_dvec2() / f64::from(view.focal);
    let [right, up, forward] = [view.right, view.up, view.forward].map(Vec3::as_dvec3);
    forward + right * at.x - up * at.y
}
