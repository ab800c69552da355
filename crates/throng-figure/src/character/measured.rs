//! Measures of a body at rest: its directions, its height, the lengths of its legs and feet.

use super::{CharacterError, RestBody};
use crate::math::smooth;
use crate::person::Side;
use crate::pose::{JOINTS, Joint, Legs};
use glam::{DVec2, DVec3, Vec3};

/// The heights of bodies that walk, m.
pub(super) const LOWEST: f64 = 0.5;
pub(super) const HIGHEST: f64 = 2.5;
/// The largest difference of the lengths of two legs, as a share of their mean.
const UNEQUAL: f64 = 0.05;
/// The cosine of the largest angle of a leg at rest to the vertical.
const STEEPEST: f64 = 0.7;
/// The height below which vertices behind the ankle are the heel, in heights of the ankle.
const SOLE: f64 = 0.5;
/// The share of the way from below the ankle to the tip at which a foot without a joint of the toes bends.
const BALL: f64 = 0.6;

/// The joints of the legs of a side: hip, knee, ankle, toes.
pub(super) fn leg_of(side: Side) -> [Joint; 4] {
    match side {
        Side::Left => [Joint::LeftUpLeg, Joint::LeftLeg, Joint::LeftFoot, Joint::LeftToeBase],
        Side::Right => [Joint::RightUpLeg, Joint::RightLeg, Joint::RightFoot, Joint::RightToeBase],
    }
}

/// A body that faces along x, with its lowest vertex at z = 0 and the middle of its hip joints above the origin.
pub(super) struct Measured {
    pub height: f64,
    pub legs: Legs,
    /// The joints. Those that the body lacks are where they would be.
    pub joints: [DVec3; JOINTS],
    /// The directions of the feet, left first.
    pub feet: [DVec2; 2],
    pub positions: Vec<DVec3>,
    pub normals: Vec<Vec3>,
    pub numbers: Vec<[u8; 4]>,
    pub weights: Vec<[f32; 4]>,
}

/// Measures a body that was checked.
pub(super) fn measure(body: &RestBody) -> Result<Measured, CharacterError> {
    let known = |joint: Joint| body.joints[joint.index()].unwrap_or_default();
    let [left, right] = Side::BOTH.map(|side| known(leg_of(side)[0]));
    let across = (left - right).truncate();
    let lowest = body.positions.iter().map(|position| position.z).fold(f64::INFINITY, f64::min);
    let highest = body.positions.iter().map(|position| position.z).fold(f64::NEG_INFINITY, f64::max);
    let height = highest - lowest;
    if !(LOWEST..=HIGHEST).contains(&height) {
        return Err(CharacterError::Height { height });
    }
    if across.length() < 1e-3 * height {
        return Err(CharacterError::NoLength { from: Joint::LeftUpLeg, to: Joint::RightUpLeg });
    }
    // to the axes of the body: ahead, left, up
    let left_of_body = across.normalize();
    let ahead = DVec2::new(left_of_body.y, -left_of_body.x);
    let turned = |v: DVec3| DVec3::new(ahead.dot(v.truncate()), left_of_body.dot(v.truncate()), v.z);
    let middle = ((left + right) / 2.0).truncate().extend(lowest);
    let placed = |v: DVec3| turned(v - middle);
    let positions: Vec<DVec3> = body.positions.iter().map(|&position| placed(position)).collect();
    let normals = body.normals.iter().map(|normal| turned(normal.as_dvec3()).as_vec3().normalize_or(Vec3::Z)).collect();
    let mut measured = Measured {
        height,
        legs: Legs::MAN,
        joints: [DVec3::ZERO; JOINTS],
        feet: [DVec2::X; 2],
        positions,
        normals,
        numbers: body.numbers.clone(),
        weights: body.weights.iter().map(normalised).collect(),
    };
    let has = |joint: Joint| body.joints[joint.index()].is_some();
    for joint in Joint::ALL.into_iter().filter(|&joint| has(joint)) {
        measured.joints[joint.index()] = placed(known(joint));
    }
    measured.complete_trunk(has);
    measured.measure_legs(has)?;
    Ok(measured)
}

/// Returns weights with the sum 1.
fn normalised(weights: &[f32; 4]) -> [f32; 4] {
    let sum: f32 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

impl Measured {
    /// Returns where a joint is.
    pub fn joint(&self, joint: Joint) -> DVec3 {
        self.joints[joint.index()]
    }

    /// Places the joints of trunk and arms that the body lacks.
    fn complete_trunk(&mut self, has: impl Fn(Joint) -> bool) {
        // hips turn about the middle of their joints
        let hips = (self.joint(Joint::LeftUpLeg) + self.joint(Joint::RightUpLeg)) / 2.0;
        self.joints[Joint::Hips.index()] = hips;
        if !has(Joint::Spine) {
            self.joints[Joint::Spine.index()] = (hips + self.joint(Joint::Spine1)) / 2.0;
        }
        if !has(Joint::Neck) {
            self.joints[Joint::Neck.index()] = self.joint(Joint::Head);
        }
        for [arm, forearm, hand] in [
            [Joint::LeftArm, Joint::LeftForeArm, Joint::LeftHand],
            [Joint::RightArm, Joint::RightForeArm, Joint::RightHand],
        ] {
            if !has(hand) {
                let (shoulder, elbow) = (self.joint(arm), self.joint(forearm));
                self.joints[hand.index()] = elbow + (elbow - shoulder) * 0.84;
            }
        }
    }

    /// Measures legs and feet.
    fn measure_legs(&mut self, has: impl Fn(Joint) -> bool) -> Result<(), CharacterError> {
        let sides = Side::BOTH.map(leg_of);
        let mut lengths = [[0.0; 2]; 2];
        for (lengths, [hip, knee, ankle, _]) in lengths.iter_mut().zip(sides) {
            for (length, [from, to]) in lengths.iter_mut().zip([[hip, knee], [knee, ankle]]) {
                let bone = self.joint(to) - self.joint(from);
                *length = bone.length();
                if *length < 1e-3 * self.height {
                    return Err(CharacterError::NoLength { from, to });
                }
                if -bone.z < STEEPEST * *length {
                    return Err(CharacterError::NotStanding { joint: from });
                }
            }
        }
        let [left, right] = lengths.map(|[thigh, shank]| thigh + shank);
        if (left - right).abs() > UNEQUAL * (left + right) / 2.0 {
            return Err(CharacterError::Unequal { left, right });
        }
        let mean = |of: &dyn Fn([Joint; 4]) -> f64| (of(sides[0]) + of(sides[1])) / (2.0 * self.height);
        let ankle = mean(&|leg| self.joint(leg[2]).z.max(0.0)).max(1e-3);
        let toed = sides.iter().all(|leg| has(leg[3]));
        if toed {
            for (foot, leg) in self.feet.iter_mut().zip(sides) {
                let way = (self.joints[leg[3].index()] - self.joints[leg[2].index()]).truncate();
                if way.length() < 1e-3 * self.height {
                    return Err(CharacterError::NoLength { from: leg[2], to: leg[3] });
                }
                *foot = way.normalize();
            }
        }
        if self.feet.iter().any(|foot| foot.x < 0.0) {
            return Err(CharacterError::Backwards);
        }
        let mut ends = [[0.0; 2]; 2];
        for (index, ends) in ends.iter_mut().enumerate() {
            *ends = self.foot_ends(sides[index], self.feet[index], ankle).unwrap_or([Legs::MAN.heel, 0.12]);
        }
        let [heel, tip] = [0, 1].map(|end| ((ends[0][end] + ends[1][end]) / 2.0).max(0.005));
        if !toed && heel > tip {
            return Err(CharacterError::Backwards);
        }
        let (ball, toe_height) = if toed {
            let along = |leg: [Joint; 4]| (self.joint(leg[3]) - self.joint(leg[2])).truncate().length();
            (mean(&along), mean(&|leg| self.joint(leg[3]).z.max(0.0)))
        } else {
            (BALL * tip, (0.3 * ankle).min(Legs::MAN.toe_height))
        };
        let part = |bone: usize| (lengths[0][bone] + lengths[1][bone]) / (2.0 * self.height);
        let hip = mean(&|leg| self.joint(leg[0]).y.abs());
        let foot = heel + tip.max(ball);
        let (thigh, shank) = (part(0), part(1));
        self.legs = Legs { thigh, shank, ankle, foot, heel, ball, toe_height: toe_height.min(ankle), hip };
        if !toed {
            self.add_toes();
        }
        Ok(())
    }

    /// Returns how far a foot extends behind and before its ankle, in heights; `None` without vertices of its sole.
    fn foot_ends(&self, [_, _, foot, toes]: [Joint; 4], ahead: DVec2, ankle: f64) -> Option<[f64; 2]> {
        let mut ends: Option<[f64; 2]> = None;
        let parts = [foot.index(), toes.index()];
        for (position, (numbers, weights)) in self.positions.iter().zip(self.numbers.iter().zip(&self.weights)) {
            let share: f32 =
                numbers.iter().zip(weights).filter(|(n, _)| parts.contains(&usize::from(**n))).map(|(_, w)| w).sum();
            if share >= 0.5 && position.z <= SOLE * ankle * self.height {
                let along = ahead.dot((*position - self.joint(foot)).truncate()) / self.height;
                let [heel, tip] = ends.unwrap_or([-along, along]);
                ends = Some([heel.max(-along), tip.max(along)]);
            }
        }
        ends
    }

    /// Divides feet without a joint of the toes.
    fn add_toes(&mut self) {
        for [_, _, foot, toes] in Side::BOTH.map(leg_of) {
            let (ankle, ball) = (self.joint(foot), self.legs.ball * self.height);
            self.joints[toes.index()] = DVec3::new(ankle.x + ball, ankle.y, self.legs.toe_height * self.height);
            for (position, (numbers, weights)) in
                self.positions.iter().zip(self.numbers.iter_mut().zip(&mut self.weights))
            {
                let Some(own) = (0..4).find(|&k| usize::from(numbers[k]) == foot.index() && weights[k] > 0.0) else {
                    continue;
                };
                let share = smooth((position.x - ankle.x - ball) / (0.3 * ball) + 0.5) as f32;
                let Some(free) = (0..4).find(|&k| weights[k] == 0.0) else { continue };
                numbers[free] = toes.index() as u8;
                weights[free] = weights[own] * share;
                weights[own] -= weights[free];
            }
        }
    }
}
