//! Lengths of bodies.

use super::JOINTS;
use super::skeleton::Joint::{
    self, Hips, LeftFoot, LeftLeg, LeftToeBase, LeftUpLeg, RightFoot, RightLeg, RightToeBase, RightUpLeg,
};
use crate::person::Build;
use glam::DVec3;

/// Lengths of legs and feet as fractions of the height of the person: what walking depends on.
///
/// Source of those of a [`Build`]: Boulic 1990; ankles: Winter, "Biomechanics and Motor Control of Human Movement".
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Legs {
    /// From the joint of the hip to that of the knee.
    pub thigh: f64,
    /// From the joint of the knee to that of the ankle.
    pub shank: f64,
    /// Height of the joint of the ankle above the ground.
    pub ankle: f64,
    /// Length of the foot from the heel to the tip of the toes.
    pub foot: f64,
    /// From the heel to below the ankle.
    pub heel: f64,
    /// From below the ankle to the joint of the toes.
    pub ball: f64,
    /// Height of the joint of the toes above the ground.
    pub toe_height: f64,
    /// Half the distance of the joints of the hips.
    pub hip: f64,
}

impl Legs {
    pub(crate) const MAN: Legs = Legs {
        thigh: 0.245,
        shank: 0.246,
        ankle: 0.039,
        foot: 0.150,
        heel: 0.030,
        ball: 0.072,
        toe_height: 0.012,
        hip: 0.0535,
    };

    /// Returns the legs of a build.
    pub fn of(build: Build) -> Legs {
        Proportions::of(build).legs
    }

    /// Returns the lengths in the order of the fields, for files.
    pub fn lengths(&self) -> [f64; 8] {
        let Legs { thigh, shank, ankle, foot, heel, ball, toe_height, hip } = *self;
        [thigh, shank, ankle, foot, heel, ball, toe_height, hip]
    }

    /// Returns the legs with these [lengths](Self::lengths).
    pub fn of_lengths([thigh, shank, ankle, foot, heel, ball, toe_height, hip]: [f64; 8]) -> Legs {
        Legs { thigh, shank, ankle, foot, heel, ball, toe_height, hip }
    }

    /// Returns the length of the leg from the hip joint to the ankle.
    pub fn leg(&self) -> f64 {
        self.thigh + self.shank
    }

    /// Puts the offsets of hips, legs and feet, in heights: the legs are straight down, the feet straight ahead.
    pub(crate) fn put(&self, offsets: &mut [DVec3; JOINTS]) {
        let mut put = |joint: Joint, x: f64, y: f64, z: f64| offsets[joint.index()] = DVec3::new(x, y, z);
        put(Hips, 0.0, 0.0, self.thigh + self.shank + self.ankle);
        for (sign, [up_leg, leg, foot, toes]) in [
            (1.0, [LeftUpLeg, LeftLeg, LeftFoot, LeftToeBase]),
            (-1.0, [RightUpLeg, RightLeg, RightFoot, RightToeBase]),
        ] {
            put(up_leg, 0.0, sign * self.hip, 0.0);
            put(leg, 0.0, 0.0, -self.thigh);
            put(foot, 0.0, 0.0, -self.shank);
            put(toes, self.ball, 0.0, self.toe_height - self.ankle);
        }
    }
}

/// Lengths of a body as fractions of its height.
///
/// Source: Boulic 1990; ankles and hands: Winter, "Biomechanics and Motor Control of Human Movement"; children of about
/// six years: own estimate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Proportions {
    pub head: f64,
    pub neck: f64,
    pub torso: f64,
    pub legs: Legs,
    /// Half the distance of the shoulder joints.
    pub shoulder: f64,
    pub upper_arm: f64,
    pub forearm: f64,
}

/// The angle of the arms to the vertical at rest is 45°: its sine and cosine.
pub(crate) const ARM_AT_REST: f64 = std::f64::consts::FRAC_1_SQRT_2;

impl Proportions {
    pub const fn of(build: Build) -> Proportions {
        const MAN: Proportions = Proportions {
            head: 0.130,
            neck: 0.052,
            torso: 0.288,
            legs: Legs::MAN,
            shoulder: 0.108,
            upper_arm: 0.176,
            forearm: 0.148,
        };
        match build {
            Build::Man => MAN,
            Build::Woman => Proportions { legs: Legs { hip: 0.0545, ..Legs::MAN }, shoulder: 0.098, ..MAN },
            Build::Child => Proportions {
                head: 0.170,
                neck: 0.045,
                torso: 0.300,
                legs: Legs { thigh: 0.220, shank: 0.222, ankle: 0.043, ..Legs::MAN },
                shoulder: 0.105,
                upper_arm: 0.165,
                forearm: 0.138,
            },
        }
    }
}
