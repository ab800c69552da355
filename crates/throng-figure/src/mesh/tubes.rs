//! Closed tubes of ellipses along the bones.

use super::{Level, Mesh, Region};
use crate::math::smooth;
use crate::person::{Build, Side};
use crate::pose::{Joint, Proportions, Skeleton};
use glam::DVec3;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// An ellipse of a tube. Lengths are in heights of the person.
pub(super) struct Ring {
    pub centre: DVec3,
    /// Half axes of the ellipse: the first to the left of the second, seen against the direction of the tube.
    pub axes: [DVec3; 2],
    pub region: Region,
    pub form: Form,
}

/// The form of a ring.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Form {
    Ellipse,
    /// An ellipse without most of its lower half.
    Sole,
    /// A rectangle with round corners.
    Box,
}

/// The levels at which a ring counts: all, all but blocks, the finest two, the finest.
pub(super) type Detail = u8;

/// Adds the body of a build.
pub(super) fn add_body(mesh: &mut Mesh, build: Build, level: Level) {
    let body = Body {
        proportions: Proportions::of(build),
        skeleton: Skeleton::scaled(build, 1.0).binds().map(|bind| bind.position),
        build,
        level,
    };
    body.trunk(mesh);
    body.head(mesh);
    for side in Side::BOTH {
        body.arm(mesh, side);
        body.leg(mesh, side);
        body.foot(mesh, side);
    }
    body.clothes(mesh);
}

pub(super) struct Body {
    pub proportions: Proportions,
    skeleton: [DVec3; crate::pose::JOINTS],
    pub build: Build,
    pub level: Level,
}

impl Body {
    pub fn joint(&self, joint: Joint) -> DVec3 {
        self.skeleton[joint.index()]
    }

    /// Whether a ring of this detail counts.
    pub fn has(&self, detail: Detail) -> bool {
        self.level as u8 + detail <= 3
    }

    pub fn sides(&self) -> usize {
        match self.level {
            Level::Fine => 12,
            Level::Medium => 8,
            Level::Coarse => 6,
            Level::Blocks => 4,
        }
    }

    /// Returns the rings of the trunk, from below, with the levels at which each counts.
    pub fn trunk_rings(&self) -> [(Ring, Detail); 15] {
        use Region::{Skin, Top, Trousers};
        // factors of the widths of hips, waist, chest and shoulders
        let [hips, waist, chest, shoulders] = match self.build {
            Build::Woman => [1.03, 0.88, 0.91, 0.90],
            Build::Man => [0.95, 1.0, 1.0, 1.0],
            Build::Child => [0.98, 1.12, 0.98, 0.96],
        };
        let bust = if self.build == Build::Woman { 1.1 } else { 1.0 };
        let base = self.joint(Joint::Hips).z;
        let neck = self.joint(Joint::Neck).z;
        // heights are shares of the way from the hips to the neck
        let table: [(f64, f64, f64, f64, Region, Detail); 15] = [
            (-0.13, 0.040, 0.040, 0.0, Trousers, 0),
            (-0.08, 0.078 * hips, 0.058, -0.004, Trousers, 2),
            (0.00, 0.096 * hips, 0.067, -0.006, Trousers, 1),
            (0.12, 0.093 * hips, 0.064, -0.004, Trousers, 2),
            (0.22, 0.084 * waist, 0.059, 0.0, Trousers, 3),
            (0.24, 0.087 * waist, 0.062, 0.0, Top, 0),
            (0.36, 0.080 * waist, 0.059, 0.0, Top, 2),
            (0.52, 0.088 * chest, 0.063, -0.003, Top, 1),
            (0.68, 0.098 * chest, 0.069 * bust, -0.004, Top, 2),
            (0.80, 0.105 * shoulders, 0.066, -0.008, Top, 0),
            (0.89, 0.106 * shoulders, 0.056, -0.011, Top, 2),
            (0.96, 0.084 * shoulders, 0.044, -0.012, Top, 1),
            (1.01, 0.042, 0.037, -0.011, Top, 0),
            (1.03, 0.031, 0.034, -0.008, Skin, 3),
            (1.20, 0.031, 0.034, 0.006, Skin, 0),
        ];
        table.map(|(share, width, depth, x, region, detail)| {
            let centre = DVec3::new(x, 0.0, base + share * (neck - base));
            (Ring { centre, axes: [DVec3::X * depth, DVec3::Y * width], region, form: Form::Ellipse }, detail)
        })
    }

    /// Returns the joints and weights of the trunk at a height.
    pub fn trunk_weights(&self, height: f64) -> ([u8; 4], [f32; 4]) {
        let bends = [
            (Joint::Spine, self.joint(Joint::Spine).z, 0.05),
            (Joint::Spine1, self.joint(Joint::Spine1).z, 0.05),
            (Joint::Neck, self.joint(Joint::Neck).z, 0.025),
            (Joint::Head, self.joint(Joint::Head).z, 0.02),
        ];
        weights(Joint::Hips, &bends, height)
    }

    fn trunk(&self, mesh: &mut Mesh) {
        let rings = self.trunk_rings().into_iter().filter(|(_, detail)| self.has(*detail)).map(|(ring, _)| ring);
        add_tube(mesh, self.sides(), rings.collect(), |_, centre| self.trunk_weights(centre.z));
    }

    /// Returns the height of the chin, and that of the head above it.
    pub fn face(&self) -> (f64, f64) {
        let height = self.proportions.head * 1.06;
        (1.0 - height, height)
    }

    fn head(&self, mesh: &mut Mesh) {
        let (chin, height) = self.face();
        let size = height / 0.138;
        // share of the height from the chin, half width, half depth, offset forward
        let table: [(f64, f64, f64, f64, Detail); 11] = [
            (0.00, 0.014, 0.016, 0.030, 0),
            (0.05, 0.024, 0.028, 0.024, 2),
            (0.16, 0.033, 0.041, 0.016, 1),
            (0.28, 0.039, 0.050, 0.009, 2),
            (0.40, 0.042, 0.055, 0.005, 0),
            (0.52, 0.044, 0.057, 0.003, 3),
            (0.64, 0.045, 0.058, 0.001, 1),
            (0.76, 0.044, 0.056, -0.001, 3),
            (0.87, 0.037, 0.047, -0.001, 0),
            (0.95, 0.025, 0.032, -0.001, 2),
            (0.99, 0.010, 0.014, -0.001, 1),
        ];
        let long = self.build == Build::Woman;
        let x = self.joint(Joint::Head).x;
        let rings: Vec<Ring> = table
            .iter()
            .filter(|row| self.has(row.4))
            .map(|&(share, width, depth, forward, _)| Ring {
                centre: DVec3::new(x + forward * size, 0.0, chin + share * height),
                axes: [DVec3::X * depth * size, DVec3::Y * width * size],
                region: Region::Skin,
                form: Form::Ellipse,
            })
            .collect();
        let first = mesh.positions.len();
        add_tube(mesh, self.sides(), rings, |_, _| weights(Joint::Head, &[], 0.0));
        // hair: above a line that falls from the forehead to the nape
        for vertex in first..mesh.positions.len() {
            let position = mesh.positions[vertex].as_dvec3();
            let behind = 1.0 - smooth((position.x - x + 0.035 * size) / (0.075 * size));
            let line = chin + height * (0.80 - if long { 0.86 } else { 0.58 } * behind);
            if position.z > line {
                let centre = DVec3::new(x, 0.0, chin + 0.55 * height);
                let scale = if long && position.z < chin + 0.4 * height { 1.22 } else { 1.05 };
                mesh.positions[vertex] = (centre + (position - centre) * DVec3::new(scale, scale, 1.02)).as_vec3();
                mesh.positions[vertex].z = mesh.positions[vertex].z.min(1.0);
                mesh.regions[vertex] = Region::Hair;
            } else if (position.z - chin - 0.4 * height).abs() < 0.02 && position.y.abs() < 0.004 && position.x > x {
                // the nose
                mesh.positions[vertex].x += 0.010;
            }
        }
    }

    fn arm(&self, mesh: &mut Mesh, side: Side) {
        use Region::{Skin, Sleeves, Top};
        let sign = side.sign();
        let [arm, forearm, hand] = match side {
            Side::Left => [Joint::LeftArm, Joint::LeftForeArm, Joint::LeftHand],
            Side::Right => [Joint::RightArm, Joint::RightForeArm, Joint::RightHand],
        };
        let start = self.joint(arm);
        let along = DVec3::new(0.0, sign * FRAC_1_SQRT_2, -FRAC_1_SQRT_2);
        let (upper, lower) = (self.proportions.upper_arm, self.proportions.forearm);
        let thick = if self.build == Build::Woman { 0.88 } else { 1.0 };
        // distance from the shoulder, half width (across), half depth
        let table: [(f64, f64, f64, Region, Detail); 16] = [
            (-0.022, 0.018, 0.024, Top, 1),
            (0.000, 0.026, 0.031, Top, 0),
            (0.030, 0.029, 0.032, Top, 2),
            (0.090, 0.028, 0.030, Top, 1),
            (upper - 0.030, 0.025, 0.025, Top, 3),
            (upper - 0.010, 0.024, 0.024, Top, 0),
            (upper + 0.010, 0.023, 0.023, Sleeves, 2),
            (upper + 0.045, 0.0235, 0.024, Sleeves, 1),
            (upper + 0.095, 0.0195, 0.021, Sleeves, 3),
            (upper + lower - 0.016, 0.0165, 0.019, Sleeves, 0),
            (upper + lower - 0.010, 0.0135, 0.017, Skin, 2),
            (upper + lower + 0.014, 0.0125, 0.022, Skin, 1),
            (upper + lower + 0.045, 0.0115, 0.024, Skin, 0),
            (upper + lower + 0.070, 0.0095, 0.021, Skin, 2),
            (upper + lower + 0.090, 0.0075, 0.014, Skin, 1),
            (upper + lower + 0.098, 0.004, 0.007, Skin, 3),
        ];
        let rings = table
            .iter()
            .filter(|row| self.has(row.4))
            .map(|&(distance, width, depth, region, _)| Ring {
                centre: start + along * distance,
                // the direction of the tube is `along`: the axes are ordered so that faces look outward
                axes: [DVec3::X * (depth * thick), along.cross(DVec3::X) * (width * thick)],
                region,
                form: Form::Ellipse,
            })
            .collect();
        let bends = [(arm, 0.0, 0.045), (forearm, upper, 0.035), (hand, upper + lower, 0.02)];
        add_tube(mesh, self.sides().min(10), rings, |_, at| weights(Joint::Spine1, &bends, (at - start).dot(along)));
    }

    fn leg(&self, mesh: &mut Mesh, side: Side) {
        let [up_leg, leg, foot] = match side {
            Side::Left => [Joint::LeftUpLeg, Joint::LeftLeg, Joint::LeftFoot],
            Side::Right => [Joint::RightUpLeg, Joint::RightLeg, Joint::RightFoot],
        };
        let start = self.joint(up_leg);
        let (thigh, shank) = (self.proportions.legs.thigh, self.proportions.legs.shank);
        // distance below the hip, half width, half depth, offset forward, outward
        let table: [(f64, f64, f64, f64, f64, Detail); 13] = [
            (-0.035, 0.032, 0.046, -0.004, 0.000, 2),
            (0.000, 0.046, 0.060, -0.005, 0.000, 0),
            (0.045, 0.047, 0.060, -0.004, 0.000, 2),
            (0.100, 0.045, 0.054, 0.000, 0.000, 1),
            (0.170, 0.040, 0.046, 0.001, 0.000, 3),
            (thigh - 0.022, 0.033, 0.038, 0.002, 0.000, 1),
            (thigh, 0.032, 0.036, 0.002, 0.000, 0),
            (thigh + 0.022, 0.031, 0.035, 0.000, 0.000, 2),
            (thigh + 0.070, 0.032, 0.037, -0.006, 0.000, 1),
            (thigh + 0.130, 0.028, 0.032, -0.005, 0.000, 3),
            (thigh + 0.190, 0.025, 0.029, -0.001, 0.000, 2),
            (thigh + shank - 0.008, 0.025, 0.030, 0.002, 0.000, 0),
            (thigh + shank - 0.004, 0.017, 0.020, 0.000, 0.000, 3),
        ];
        let wide = if self.build == Build::Woman { 1.04 } else { 1.0 };
        let skirts = self.build != Build::Man;
        let rings = table
            .iter()
            .filter(|row| self.has(row.5))
            .map(|&(distance, width, depth, forward, outward, _)| Ring {
                centre: start + DVec3::new(forward, side.sign() * outward, -distance),
                axes: [DVec3::X * depth, DVec3::Y * (-width * if distance < thigh { wide } else { 1.0 })],
                region: if skirts && distance > thigh - 0.03 { Region::Shins } else { Region::Trousers },
                form: Form::Ellipse,
            })
            .collect();
        let bends = [(up_leg, 0.012, 0.045), (leg, thigh, 0.04), (foot, thigh + shank, 0.015)];
        add_tube(mesh, self.sides(), rings, |_, at| weights(Joint::Hips, &bends, start.z - at.z));
    }

    fn foot(&self, mesh: &mut Mesh, side: Side) {
        let [foot, toes] = match side {
            Side::Left => [Joint::LeftFoot, Joint::LeftToeBase],
            Side::Right => [Joint::RightFoot, Joint::RightToeBase],
        };
        let ankle = self.joint(foot);
        let (heel, ball) = (self.proportions.legs.heel, self.proportions.legs.ball);
        let tip = self.proportions.legs.foot - heel;
        let high = self.proportions.legs.ankle / 0.039;
        // distance ahead of the ankle, half width, height of the instep
        let table: [(f64, f64, f64, Detail); 9] = [
            (-heel, 0.010, 0.026, 1),
            (-heel + 0.006, 0.018, 0.042, 0),
            (-0.006, 0.021, 0.055, 2),
            (0.020, 0.023, 0.054, 1),
            (0.048, 0.027, 0.037, 2),
            (ball, 0.029, 0.028, 0),
            (ball + 0.024, 0.027, 0.022, 2),
            (tip - 0.010, 0.020, 0.017, 1),
            (tip, 0.009, 0.010, 0),
        ];
        let rings = table
            .iter()
            .filter(|row| self.has(row.3))
            .map(|&(x, width, height, _)| Ring {
                centre: DVec3::new(ankle.x + x, ankle.y, height * high / 2.0),
                axes: [DVec3::Y * width, DVec3::Z * (height * high / 2.0)],
                region: Region::Shoes,
                form: Form::Sole,
            })
            .collect();
        let bends = [(toes, ball, 0.014)];
        add_tube(mesh, self.sides().min(8), rings, |_, at| weights(foot, &bends, at.x - ankle.x));
    }
}

/// Returns the weights at a distance along bones. `bends` holds the joints after `first`: where they are, and over
/// which distance to both sides the mesh bends.
pub(super) fn weights(first: Joint, bends: &[(Joint, f64, f64)], at: f64) -> ([u8; 4], [f32; 4]) {
    let (mut before, mut after, mut share) = (first, first, 0.0);
    for &(joint, place, reach) in bends {
        let own = smooth((at - place + reach) / (2.0 * reach));
        if own >= 1.0 {
            (before, after, share) = (joint, joint, 0.0);
        } else if own > 0.0 {
            (after, share) = (joint, own);
            break;
        } else {
            break;
        }
    }
    let share = share as f32;
    let numbers = [before.index() as u8, if share > 0.0 { after.index() as u8 } else { 0 }, 0, 0];
    (numbers, [1.0 - share, share, 0.0, 0.0])
}

/// Adds a tube through rings, closed at both ends. `weigh` returns the joints and weights of a vertex, by its position and
/// the centre of its ring.
pub(super) fn add_tube(
    mesh: &mut Mesh,
    sides: usize,
    rings: Vec<Ring>,
    weigh: impl Fn(DVec3, DVec3) -> ([u8; 4], [f32; 4]),
) {
    let mut add = |position: DVec3, region: Region, centre: DVec3| {
        let (joints, weights) = weigh(position, centre);
        mesh.positions.push(position.as_vec3());
        mesh.joints.push(joints);
        mesh.weights.push(weights);
        mesh.regions.push(region);
        mesh.positions.len() as u32 - 1
    };
    let mut starts = Vec::new();
    for ring in &rings {
        for side in 0..sides {
            let angle = TAU * (side as f64 + if sides == 4 { 0.5 } else { 0.0 }) / sides as f64;
            let (sin, cos) = libm::sincos(angle);
            // a square has the area of the ellipse
            let size = if sides == 4 { 1.25 } else { 1.0 };
            let squared = |part: f64| part.abs().sqrt().copysign(part);
            let (out, up) = match ring.form {
                Form::Ellipse => (cos * size, sin * size),
                Form::Sole => (cos * size, (sin * size * 1.6).clamp(-1.0, 1.0)),
                Form::Box => (squared(cos * size), squared(sin * size)),
            };
            let index = add(ring.centre + ring.axes[0] * out + ring.axes[1] * up, ring.region, ring.centre);
            if side == 0 {
                starts.push(index);
            }
        }
    }
    let poles = [rings.first(), rings.last()].map(|ring| ring.map(|ring| add(ring.centre, ring.region, ring.centre)));
    let ring_of = |start: u32, side: usize| start + (side % sides) as u32;
    for pair in starts.windows(2) {
        for side in 0..sides {
            let [a, b] = [ring_of(pair[0], side), ring_of(pair[0], side + 1)];
            let [c, d] = [ring_of(pair[1], side), ring_of(pair[1], side + 1)];
            mesh.triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    if let ([Some(first), Some(last)], [start, .., end]) = (poles, starts.as_slice()) {
        for side in 0..sides {
            mesh.triangles.push([first, ring_of(*start, side + 1), ring_of(*start, side)]);
            mesh.triangles.push([last, ring_of(*end, side), ring_of(*end, side + 1)]);
        }
    }
}
