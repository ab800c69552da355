//! Flying vehicles: small darts that show heading, climb and bank.

use super::Lens;
use crate::Color;
use crate::look::Coat;
use crate::primitive::{Primitive, Stroke};
use glam::{DVec3, Vec3};
use throng::motion::Basis;

/// The nose, the tips of the wings and the notch between them: forward, left and up, in radii of the body.
const NOSE: Vec3 = Vec3::new(1.9, 0.0, 0.0);
const TIP: Vec3 = Vec3::new(-1.3, 1.35, 0.35);
const TAIL: Vec3 = Vec3::new(-0.75, 0.0, -0.1);
/// The direction of the light.
const LIGHT: Vec3 = Vec3::new(-0.35, -0.35, 0.87);
/// The darkening of a wing at grazing light, and of one seen from below.
const SHADE: f32 = 0.55;
const BELOW: f32 = 0.28;

/// The dart of a body in space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dart {
    at: DVec3,
    basis: Basis,
    size: f32,
}

impl Dart {
    pub fn new(at: DVec3, basis: Basis, size: f32) -> Self {
        Self { at, basis, size }
    }

    /// Returns a point of the dart in the world.
    fn point(&self, local: Vec3) -> DVec3 {
        self.at + self.basis.to_world(local * self.size).as_dvec3()
    }

    /// Returns the outline.
    pub fn outline(&self) -> [DVec3; 4] {
        [NOSE, mirrored(TIP), TAIL, TIP].map(|local| self.point(local))
    }

    /// Adds the farther wing, then the nearer.
    pub fn marks(&self, coat: &Coat, lens: &Lens, unit: f32, marks: &mut Vec<Primitive>) {
        let sight = (lens.eye - self.at).as_vec3();
        let mut wings = [TIP, mirrored(TIP)];
        if sight.dot(self.basis.side) > 0.0 {
            wings.reverse();
        }
        for tip in wings {
            let normal = (tip - NOSE).cross(TAIL - NOSE).normalize() * tip.y.signum();
            let normal = self.basis.to_world(normal);
            let dark = SHADE * (1.0 - normal.dot(LIGHT).max(0.0)) + if normal.dot(sight) < 0.0 { BELOW } else { 0.0 };
            let fill = coat.fill.mix(coat.rim, dark);
            let ring = lens.area([NOSE, tip, TAIL].map(|local| self.point(local)));
            marks.push(Primitive::Line { points: ring.clone(), closed: true, stroke: Stroke::plain(0.5 * unit, fill) });
            marks.push(Primitive::Area { rings: vec![ring], fill });
        }
    }

    /// Returns the shadow straight below.
    pub fn shadow(&self, fill: Color, lens: &Lens) -> Primitive {
        Primitive::Area { rings: vec![lens.area(self.outline().map(|point| point.with_z(0.0)))], fill }
    }
}

/// Returns the mirror image of a point.
fn mirrored(local: Vec3) -> Vec3 {
    local.with_y(-local.y)
}
