//! Shapes of agents in space: small bodies of flat faces, some with beating wings or walking legs. Lengths are in radii
//! of the agent's body; +x is forward, +y to the left, z up.

mod posed;

pub(crate) use posed::{Strides, marks, mesh};

use glam::{Vec2, Vec3};
use throng_record::Body;

/// A shape of agents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Shape {
    /// A flat arrow.
    Arrow,
    /// A dart.
    Vehicle,
    /// A bird with beating wings.
    Bird,
    /// An insect: a thin body with two fast-beating wings.
    Insect,
    /// A walking figure; its steps follow the walked distance.
    Walker,
    /// A car of the length of the body. In pictures its wheels roll and steer, and it is as wide as the body.
    Car,
    /// A robot on two wheels. In pictures its wheels roll.
    Robot,
}

/// Half the length of a car in a disc of radius 1: its corners are on the disc.
pub(crate) const CAR: f32 = 0.91;

/// A corner of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// The position in the rest pose.
    pub corner: Vec3,
    /// The normal of its face.
    pub normal: Vec3,
    /// The amplitudes of rotation around the body's length and around its side, radians; and the height of the joint.
    pub joint: Vec3,
}

impl Shape {
    /// All shapes.
    pub const ALL: [Self; 7] =
        [Self::Arrow, Self::Vehicle, Self::Bird, Self::Insect, Self::Walker, Self::Car, Self::Robot];

    /// Returns the plural name.
    pub fn label(self) -> &'static str {
        match self {
            Self::Arrow => "arrows",
            Self::Vehicle => "vehicles",
            Self::Bird => "birds",
            Self::Insect => "insects",
            Self::Walker => "figures",
            Self::Car => "cars",
            Self::Robot => "robots",
        }
    }

    /// Returns the length that the shape of an agent has as its unit, metres.
    pub fn unit(self, body: &Body) -> f32 {
        match self {
            Self::Car if body.core != Vec2::ZERO => (body.core.x + body.radius) / CAR,
            _ => body.radius,
        }
    }

    /// Returns the phase of the motion after `seconds` and `way` metres, radians.
    pub fn phase(self, seconds: f32, way: f32, radius: f32) -> f32 {
        match self {
            Self::Arrow | Self::Vehicle | Self::Car | Self::Robot => 0.0,
            Self::Bird => 16.0 * seconds,
            Self::Insect => 70.0 * seconds,
            // Two steps are one period.
            Self::Walker => std::f32::consts::TAU * way / (6.0 * radius),
        }
    }

    /// Whether all faces are visible only from outside: the shape consists of closed bodies without wings.
    pub(crate) fn is_closed(self) -> bool {
        matches!(self, Self::Walker | Self::Car | Self::Robot)
    }

    /// Returns the faces, three corners each.
    pub fn mesh(self) -> Vec<Vertex> {
        let mut mesh = Mesh::default();
        match self {
            Self::Arrow => {
                let (nose, tip, tail) =
                    (Vec3::new(1.3, 0.0, 0.05), Vec3::new(-1.0, 0.85, 0.05), Vec3::new(-0.5, 0.0, 0.05));
                mesh.mirrored([nose, tip, tail], Vec3::ZERO);
            }
            Self::Vehicle => {
                let (nose, tip, tail) =
                    (Vec3::new(1.9, 0.0, 0.0), Vec3::new(-1.3, 1.35, 0.35), Vec3::new(-0.75, 0.0, -0.1));
                mesh.mirrored([nose, tip, tail], Vec3::ZERO);
            }
            Self::Bird => {
                mesh.spindle(Vec3::new(1.6, 0.28, 0.24), -0.4);
                let wing = Vec3::X * 0.75;
                mesh.mirrored([Vec3::new(0.7, 0.15, 0.1), Vec3::new(-0.1, 2.4, 0.1), Vec3::new(-0.5, 0.15, 0.1)], wing);
                mesh.mirrored(
                    [Vec3::new(-1.3, 0.0, 0.0), Vec3::new(-2.2, 0.5, 0.05), Vec3::new(-2.0, 0.0, 0.0)],
                    Vec3::ZERO,
                );
            }
            Self::Insect => {
                mesh.spindle(Vec3::new(1.1, 0.22, 0.22), 0.0);
                let wing = Vec3::X * 0.9;
                mesh.mirrored([Vec3::new(0.5, 0.1, 0.2), Vec3::new(-0.2, 1.5, 0.3), Vec3::new(-0.9, 0.8, 0.2)], wing);
            }
            Self::Walker => {
                let leg = Vec3::new(0.0, 0.55, 3.2);
                let arm = Vec3::new(0.0, -0.45, 5.3);
                for side in [1.0, -1.0] {
                    let swing = |joint: Vec3| joint * Vec3::new(1.0, side, 1.0);
                    mesh.block(Vec3::new(0.0, 0.34 * side, 1.6), Vec3::new(0.27, 0.24, 1.6), swing(leg));
                    mesh.block(Vec3::new(0.0, 0.88 * side, 4.2), Vec3::new(0.18, 0.16, 1.15), swing(arm));
                }
                mesh.block(Vec3::new(0.0, 0.0, 4.3), Vec3::new(0.34, 0.66, 1.2), Vec3::ZERO);
                mesh.block(Vec3::new(0.05, 0.0, 6.1), Vec3::new(0.4, 0.36, 0.48), Vec3::ZERO);
            }
            Self::Car => {
                for (x, y) in [(0.56, 0.34), (0.56, -0.34), (-0.56, 0.34), (-0.56, -0.34)] {
                    mesh.block(Vec3::new(x, y, 0.13), Vec3::new(0.14, 0.06, 0.13), Vec3::ZERO);
                }
                mesh.block(Vec3::new(0.0, 0.0, 0.23), Vec3::new(CAR, 0.39, 0.14), Vec3::ZERO);
                mesh.block(Vec3::new(-0.18, 0.0, 0.49), Vec3::new(0.44, 0.31, 0.12), Vec3::ZERO);
            }
            Self::Robot => {
                for side in [1.0, -1.0] {
                    mesh.block(Vec3::new(0.0, 0.82 * side, 0.4), Vec3::new(0.4, 0.085, 0.4), Vec3::ZERO);
                }
                mesh.block(Vec3::new(0.0, 0.0, 0.75), Vec3::new(0.56, 0.62, 0.55), Vec3::ZERO);
                mesh.block(Vec3::new(0.6, 0.0, 1.0), Vec3::new(0.08, 0.42, 0.14), Vec3::ZERO);
            }
        }
        mesh.0
    }
}

#[derive(Default)]
struct Mesh(Vec<Vertex>);

impl Mesh {
    fn face(&mut self, corners: [Vec3; 3], joint: Vec3) {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize_or(Vec3::Z);
        self.0.extend(corners.map(|corner| Vertex { corner, normal, joint }));
    }

    /// Adds a face and its mirror image, both facing up.
    fn mirrored(&mut self, [a, b, c]: [Vec3; 3], joint: Vec3) {
        let other = |p: Vec3| Vec3::new(p.x, -p.y, p.z);
        self.face([a, b, c], joint);
        self.face([other(a), other(c), other(b)], joint);
    }

    /// Adds a body that is pointed at the front and at the back: its half extents, and the position of its thickest
    /// part.
    fn spindle(&mut self, half: Vec3, thickest: f32) {
        let around = [Vec3::Y * half.y, Vec3::Z * half.z, Vec3::Y * -half.y, Vec3::Z * -half.z];
        for k in 0..4 {
            let middle = Vec3::X * thickest;
            let (a, b) = (around[k] + middle, around[(k + 1) % 4] + middle);
            self.face([Vec3::X * half.x, a, b], Vec3::ZERO);
            self.face([Vec3::X * -half.x, b, a], Vec3::ZERO);
        }
    }

    /// Adds a block: its centre and its half extents.
    fn block(&mut self, middle: Vec3, half: Vec3, joint: Vec3) {
        for (axis, u, v) in [(Vec3::X, Vec3::Y, Vec3::Z), (Vec3::Y, Vec3::Z, Vec3::X), (Vec3::Z, Vec3::X, Vec3::Y)] {
            for side in [1.0, -1.0] {
                let (out, u, v) = (axis * side * half, u * half, v * half * side);
                let [a, b, c, d] = [-u - v, u - v, u + v, v - u].map(|corner| middle + out + corner);
                self.face([a, b, c], joint);
                self.face([a, c, d], joint);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_of_a_block_look_outwards() {
        let mut mesh = Mesh::default();
        mesh.block(Vec3::ZERO, Vec3::ONE, Vec3::ZERO);
        assert_eq!(mesh.0.len(), 36);
        assert!(mesh.0.iter().all(|vertex| vertex.normal.dot(vertex.corner) > 0.5));
    }

    #[test]
    fn every_shape_has_whole_faces() {
        for shape in Shape::ALL {
            let mesh = shape.mesh();
            assert!(!mesh.is_empty() && mesh.len() % 3 == 0, "{shape:?}");
            assert!(mesh.iter().all(|vertex| (vertex.normal.length() - 1.0).abs() < 1e-5), "{shape:?}");
        }
    }

    #[test]
    fn the_phase_of_a_walker_follows_its_distance() {
        assert_eq!(Shape::Walker.phase(9.0, 1.2, 0.2), std::f32::consts::TAU);
        assert_eq!(Shape::Vehicle.phase(9.0, 1.2, 0.2), 0.0);
    }
}
