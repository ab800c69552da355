//! What only some looks wear or carry: skirts, coats, rucksacks, long hair and umbrellas, as closed tubes.

use super::tubes::{Body, Detail, Form, Ring, add_tube, weights};
use super::{Level, Mesh, Region};
use crate::math::smooth;
use crate::person::{Build, Side};
use crate::pose::Joint;
use glam::DVec3;

/// How far clothes and straps are outside the trunk, heights of the person.
const OVER: f64 = 0.004;
/// How much a skirt follows the leg on its side, 0 to 1; over which distances below the hips it begins to, and the distance
/// from the middle from which it does, heights of the person.
const FOLLOW: f64 = 0.85;
const BELOW: [f64; 2] = [-0.02, 0.06];
const BESIDE: f64 = 0.035;
/// Half the width of a strap, and half its thickness, heights of the person.
const STRAP: [f64; 2] = [0.014, 0.005];

/// A place on a strap: the share of the way from the hips to the neck, the share of the half width of the trunk, and
/// whether it is on the front.
type StrapPlace = (f64, f64, bool);

impl Body {
    /// Adds what the looks of the build may wear.
    pub fn clothes(&self, mesh: &mut Mesh) {
        // share of the thigh, half width, half depth
        let skirt = [(0.0, 0.112, 0.083, 1), (0.33, 0.117, 0.091, 2), (0.95, 0.127, 0.094, 0)];
        let coat = [(0.0, 0.110, 0.083, 1), (0.29, 0.115, 0.090, 2), (0.67, 0.121, 0.093, 0)];
        match self.build {
            Build::Man => self.skirt(mesh, Region::Coat, &coat),
            Build::Woman | Build::Child => {
                self.skirt(mesh, Region::Skirt, &skirt);
                self.long_hair(mesh);
            }
        }
        self.bag(mesh);
        if self.level <= Level::Medium {
            Side::BOTH.into_iter().for_each(|side| self.strap(mesh, side));
        }
        if self.level <= Level::Coarse {
            self.umbrella(mesh);
        }
    }

    /// Returns the height of a share of the way from the hips to the neck.
    fn height(&self, share: f64) -> f64 {
        let base = self.joint(Joint::Hips).z;
        base + share * (self.joint(Joint::Neck).z - base)
    }

    /// Returns the middle, the half width and the half depth of the trunk at a height.
    fn trunk_at(&self, height: f64) -> (f64, f64, f64) {
        let rings = self.trunk_rings().map(|(ring, _)| ring);
        let above = rings.iter().position(|ring| ring.centre.z >= height).unwrap_or(rings.len() - 1).max(1);
        let [low, high] = [&rings[above - 1], &rings[above]];
        let share = ((height - low.centre.z) / (high.centre.z - low.centre.z)).clamp(0.0, 1.0);
        let mix = |of: fn(&Ring) -> f64| of(low) + (of(high) - of(low)) * share;
        (mix(|ring| ring.centre.x), mix(|ring| ring.axes[1].y), mix(|ring| ring.axes[0].x))
    }

    /// Adds a tube around the legs from the waist to a hem. `below` are its rings along the thighs, from above.
    fn skirt(&self, mesh: &mut Mesh, region: Region, below: &[(f64, f64, f64, Detail)]) {
        let ring = |centre: DVec3, width: f64, depth: f64| Ring {
            centre,
            axes: [DVec3::X * depth, DVec3::Y * width],
            region,
            form: Form::Ellipse,
        };
        let (hips, thigh) = (self.joint(Joint::Hips), self.proportions.legs.thigh);
        let lower = below.iter().rev().filter(|row| self.has(row.3)).map(|&(share, width, depth, _)| {
            ring(DVec3::new(hips.x - 0.002, 0.0, hips.z - share * thigh), width, depth)
        });
        // share of the way from the hips to the neck, and how far it is outside the trunk at the side and at the front
        let upper = [(0.13, 1.5, 2.0, 2), (0.27, 1.0, 1.0, 0)];
        let upper = upper.into_iter().filter(|row| self.has(row.3)).map(|(share, side, front, _)| {
            let height = self.height(share);
            let (x, width, depth) = self.trunk_at(height);
            ring(DVec3::new(x, 0.0, height), width + side * OVER, depth + front * OVER)
        });
        let rings = lower.chain(upper).collect();
        add_tube(mesh, self.sides(), rings, |at, _| {
            let below = (hips.z - at.z - BELOW[0]) / (BELOW[1] - BELOW[0]);
            if below <= 0.0 {
                return self.trunk_weights(at.z);
            }
            let leg = if at.y > 0.0 { Joint::LeftUpLeg } else { Joint::RightUpLeg };
            let share = (FOLLOW * smooth(below) * (at.y.abs() / BESIDE).min(1.0)) as f32;
            ([Joint::Hips.index() as u8, leg.index() as u8, 0, 0], [1.0 - share, share, 0.0, 0.0])
        });
    }

    /// Adds hair that falls from the crown to the shoulders.
    fn long_hair(&self, mesh: &mut Mesh) {
        let (chin, height) = self.face();
        let size = height / 0.138;
        // share of the height of the head from the chin, half width, half depth, offset back
        let table: [(f64, f64, f64, f64, Detail); 7] = [
            (-0.42, 0.026, 0.008, 0.044, 2),
            (-0.34, 0.046, 0.018, 0.042, 0),
            (-0.05, 0.054, 0.026, 0.038, 1),
            (0.25, 0.055, 0.034, 0.034, 0),
            (0.55, 0.053, 0.043, 0.026, 1),
            (0.82, 0.043, 0.046, 0.016, 0),
            (0.96, 0.022, 0.028, 0.012, 2),
        ];
        let x = self.joint(Joint::Head).x;
        let rings = table.iter().filter(|row| self.has(row.4)).map(|&(share, width, depth, back, _)| Ring {
            centre: DVec3::new(x - back * size, 0.0, chin + share * height),
            axes: [DVec3::X * depth * size, DVec3::Y * width * size],
            region: Region::LongHair,
            form: Form::Ellipse,
        });
        add_tube(mesh, self.sides(), rings.collect(), |_, _| weights(Joint::Head, &[], 0.0));
    }

    /// Adds a rucksack on the back.
    fn bag(&self, mesh: &mut Mesh) {
        // share of the way from the hips to the neck, half width, half depth, offset back from the back
        let table: [(f64, f64, f64, f64, Detail); 7] = [
            (0.24, 0.052, 0.018, 0.020, 1),
            (0.28, 0.072, 0.040, 0.034, 0),
            (0.50, 0.078, 0.046, 0.040, 3),
            (0.62, 0.078, 0.045, 0.039, 1),
            (0.86, 0.070, 0.036, 0.030, 0),
            (0.95, 0.060, 0.028, 0.022, 2),
            (0.99, 0.036, 0.012, 0.016, 1),
        ];
        // the back of the chest, on which the bag lies
        let (x, _, depth) = self.trunk_at(self.height(0.68));
        let rings = table.iter().filter(|row| self.has(row.4)).map(|&(share, width, depth_of_bag, back, _)| Ring {
            centre: DVec3::new(x - depth - back, 0.0, self.height(share)),
            axes: [DVec3::X * depth_of_bag, DVec3::Y * width],
            region: Region::Bag,
            form: Form::Box,
        });
        add_tube(mesh, self.sides(), rings.collect(), |_, _| weights(Joint::Spine1, &[], 0.0));
    }

    /// Adds a closed umbrella that goes on where the right arm ends.
    fn umbrella(&self, mesh: &mut Mesh) {
        // distance from the wrist, radius
        const TABLE: [(f64, f64, Detail); 7] = [
            (0.000, 0.006, 1),
            (0.012, 0.009, 2),
            (0.085, 0.009, 1),
            (0.095, 0.016, 2),
            (0.150, 0.021, 1),
            (0.330, 0.012, 1),
            (0.375, 0.003, 1),
        ];
        let [shoulder, wrist] = [Joint::RightArm, Joint::RightHand].map(|joint| self.joint(joint));
        let along = (wrist - shoulder).normalize();
        // the wrist is at the thumb: the fist holds the handle
        let grip = wrist + DVec3::X * 0.012;
        let rings = TABLE.iter().filter(|row| self.has(row.2)).map(|&(distance, radius, _)| Ring {
            centre: grip + along * distance,
            axes: [DVec3::X * radius, along.cross(DVec3::X) * radius],
            region: Region::Umbrella,
            form: Form::Ellipse,
        });
        add_tube(mesh, self.sides().min(6), rings.collect(), |_, _| weights(Joint::RightHand, &[], 0.0));
    }

    /// Adds a strap of the rucksack, from its top over the shoulder and under the arm to its bottom.
    fn strap(&self, mesh: &mut Mesh, side: Side) {
        const PLACES: [StrapPlace; 8] = [
            (0.86, 0.42, false),
            (0.96, 0.70, false),
            (0.995, 0.98, true),
            (0.94, 0.72, true),
            (0.80, 0.62, true),
            (0.62, 0.72, true),
            (0.46, 0.98, true),
            (0.34, 0.72, false),
        ];
        let place = |&(share, aside, front): &StrapPlace| {
            let height = self.height(share);
            let (x, width, depth) = self.trunk_at(height);
            let (ahead, left) = ((1.0 - aside * aside).sqrt() * if front { 1.0 } else { -1.0 }, aside * side.sign());
            let out = DVec3::new(ahead / depth, left / width, 0.0).normalize_or(DVec3::X);
            (DVec3::new(x + ahead * depth, left * width, height) + out * OVER, out)
        };
        let path: Vec<(DVec3, DVec3)> = PLACES.iter().map(place).collect();
        let rings = path.iter().enumerate().map(|(k, &(centre, out))| {
            let along = path[(k + 1).min(path.len() - 1)].0 - path[k.saturating_sub(1)].0;
            let across = out.cross(along).normalize_or(DVec3::Y);
            let out = along.cross(across).normalize_or(out);
            Ring { centre, axes: [out * STRAP[1], across * -STRAP[0]], region: Region::Bag, form: Form::Ellipse }
        });
        add_tube(mesh, 4, rings.collect(), |_, centre| self.trunk_weights(centre.z));
    }
}
