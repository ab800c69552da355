//! A figure of blocks as glTF, as programs of animators write it: each has its own names, axes, units and pose.

// each test uses a part of it
#![allow(dead_code)]

pub mod file;
mod names;

pub use names::Names;

use glam::{DQuat, DVec3};

/// A figure of blocks. Lengths are metres.
#[derive(Clone, Debug)]
pub struct Blocks {
    pub thigh: f64,
    pub shank: f64,
    pub ankle: f64,
    pub heel: f64,
    pub ball: f64,
    pub foot: f64,
    pub toe_height: f64,
    /// Half the distance of the hip joints.
    pub hip: f64,
    pub torso: f64,
    pub head: f64,
    pub arm: f64,
    pub forearm: f64,
    /// Half the distance of the shoulder joints.
    pub shoulder: f64,
    /// The angle of the arms below the horizontal, rad: 0 is a T pose.
    pub drop: f64,
    /// The direction that the figure faces, rad from +z of the file towards +x.
    pub yaw: f64,
    pub names: Names,
    /// Lengths of nodes are centimetres, under a root with the scale 0.01 that also turns z up to y up.
    pub centimetres: bool,
    /// The axes of bones are turned.
    pub turned: bool,
    /// Two joints of fingers on each hand move the hand too, and a joint of a twist each thigh.
    pub extra: bool,
    /// Whether there are joints of the toes.
    pub toes: bool,
}

impl Default for Blocks {
    fn default() -> Self {
        Self {
            thigh: 0.43,
            shank: 0.42,
            ankle: 0.08,
            heel: 0.06,
            ball: 0.13,
            foot: 0.27,
            toe_height: 0.025,
            hip: 0.1,
            torso: 0.5,
            head: 0.26,
            arm: 0.29,
            forearm: 0.26,
            shoulder: 0.19,
            drop: 0.0,
            yaw: 0.0,
            names: Names::Mixamo,
            centimetres: false,
            turned: false,
            extra: false,
            toes: true,
        }
    }
}

/// A block: its joint, its corners in the axes of the body (ahead, left, up), its colour (linear).
struct Block {
    joint: usize,
    low: DVec3,
    high: DVec3,
    colour: [f64; 3],
}

/// A vertex of the figure at rest, in the axes of the body (ahead, left, up), from the ground below the hips, and its
/// joint.
pub type Corner = (DVec3, usize);

impl Blocks {
    /// Returns the height of the highest vertex.
    pub fn height(&self) -> f64 {
        self.hips() + self.torso + self.head
    }

    fn hips(&self) -> f64 {
        self.ankle + self.shank + self.thigh
    }

    /// Returns where the joints are: ahead, left, up.
    pub fn joints(&self) -> [DVec3; 19] {
        let mut at = [DVec3::ZERO; 19];
        at[0] = DVec3::new(0.01, 0.0, self.hips() + 0.05);
        at[1] = DVec3::new(0.0, 0.0, self.hips() + 0.12);
        at[2] = DVec3::new(-0.01, 0.0, self.hips() + 0.6 * self.torso);
        at[3] = DVec3::new(-0.01, 0.0, self.hips() + self.torso);
        at[4] = DVec3::new(0.01, 0.0, self.hips() + self.torso + 0.05);
        for (sign, arm, leg) in [(1.0, 5, 11), (-1.0, 8, 15)] {
            let along = DVec3::new(0.0, sign * self.drop.cos(), -self.drop.sin());
            at[arm] = DVec3::new(0.0, sign * self.shoulder, self.hips() + self.torso - 0.06);
            at[arm + 1] = at[arm] + along * self.arm;
            at[arm + 2] = at[arm + 1] + along * self.forearm;
            at[leg] = DVec3::new(0.0, sign * self.hip, self.hips());
            at[leg + 1] = at[leg] - DVec3::Z * self.thigh;
            at[leg + 2] = at[leg + 1] - DVec3::Z * self.shank;
            at[leg + 3] = DVec3::new(self.ball, sign * self.hip, self.toe_height);
        }
        at
    }

    /// Returns the blocks. Those of limbs are along x, and are turned to the bone later.
    fn blocks(&self) -> Vec<Block> {
        let at = self.joints();
        let (skin, cloth, shoe) = ([0.55, 0.3, 0.2], [0.05, 0.2, 0.5], [0.02, 0.02, 0.02]);
        let mut blocks = Vec::new();
        let mut add = |joint: usize, low: DVec3, high: DVec3, colour: [f64; 3]| {
            blocks.push(Block { joint, low, high, colour });
        };
        let wide = self.shoulder - 0.03;
        add(0, DVec3::new(-0.1, -wide, self.hips() - 0.04), DVec3::new(0.1, wide, at[1].z), [0.02, 0.05, 0.1]);
        add(1, DVec3::new(-0.09, -wide, at[1].z), DVec3::new(0.09, wide, at[2].z), cloth);
        add(2, DVec3::new(-0.1, -wide, at[2].z), DVec3::new(0.11, wide, at[3].z), cloth);
        add(3, DVec3::new(-0.04, -0.04, at[3].z), DVec3::new(0.04, 0.04, at[4].z), skin);
        add(4, DVec3::new(-0.09, -0.08, at[4].z), DVec3::new(0.1, 0.08, self.height()), skin);
        // the nose says where the figure looks
        add(4, DVec3::new(0.1, -0.015, at[4].z + 0.08), DVec3::new(0.13, 0.015, at[4].z + 0.11), [0.8, 0.1, 0.1]);
        for (leg, sign) in [(11, 1.0), (15, -1.0)] {
            let y = sign * self.hip;
            let box_of = |x: [f64; 2], half: f64, z: [f64; 2]| {
                (DVec3::new(x[0], y - half, z[0]), DVec3::new(x[1], y + half, z[1]))
            };
            let (low, high) = box_of([-0.07, 0.07], 0.07, [at[leg + 1].z, at[leg].z]);
            add(leg, low, high, [0.02, 0.05, 0.1]);
            let (low, high) = box_of([-0.055, 0.055], 0.055, [at[leg + 2].z, at[leg + 1].z]);
            add(leg + 1, low, high, [0.02, 0.05, 0.1]);
            let (low, high) = box_of([-self.heel, self.ball], 0.045, [0.0, self.ankle]);
            add(leg + 2, low, high, shoe);
            let (low, high) = box_of([self.ball, self.foot - self.heel], 0.045, [0.0, 2.0 * self.toe_height]);
            add(leg + 3, low, high, shoe);
        }
        for arm in [5, 8] {
            for (joint, to, thick, colour) in
                [(arm, arm + 1, 0.05, cloth), (arm + 1, arm + 2, 0.04, skin), (arm + 2, arm + 2, 0.035, skin)]
            {
                let length = if joint == to { 0.16 } else { at[joint].distance(at[to]) };
                let (low, high) = (DVec3::new(0.0, -thick, -thick), DVec3::new(length, thick, thick));
                add(joint, low, high, colour);
            }
        }
        blocks
    }

    /// Returns the corners of all blocks at rest, 24 a block, with their normals and colours.
    fn corners(&self) -> Vec<(DVec3, DVec3, usize, [f64; 3])> {
        let at = self.joints();
        let mut corners = Vec::new();
        for block in self.blocks() {
            let limb = (5..11).contains(&block.joint);
            let sign = if block.joint < 8 { 1.0 } else { -1.0 };
            let along = DQuat::from_rotation_arc(DVec3::X, DVec3::new(0.0, sign * self.drop.cos(), -self.drop.sin()));
            let placed = |own: DVec3| if limb { at[block.joint] + along * own } else { own };
            for axis in 0..3 {
                for side in [0.0, 1.0] {
                    let mut normal = DVec3::ZERO;
                    normal[axis] = 2.0 * side - 1.0;
                    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                    // counterclockwise from outside
                    let order =
                        if side > 0.5 { [[0, 0], [1, 0], [1, 1], [0, 1]] } else { [[0, 0], [0, 1], [1, 1], [1, 0]] };
                    for [a, b] in order {
                        let mut share = DVec3::ZERO;
                        (share[axis], share[u], share[v]) = (side, f64::from(a), f64::from(b));
                        let own = block.low + (block.high - block.low) * share;
                        let turned = if limb { along * normal } else { normal };
                        corners.push((placed(own), turned, block.joint, block.colour));
                    }
                }
            }
        }
        corners
    }

    /// Returns the vertices at rest and the joints that move them.
    pub fn vertices(&self) -> Vec<Corner> {
        self.corners().into_iter().map(|(place, _, joint, _)| (place, joint)).collect()
    }
}
