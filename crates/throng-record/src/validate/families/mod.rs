//! Random families of scenes: variants of scenes in which requirements were once violated, and the requirements on all
//! of them.
//!
//! A [`Trial`] is a variant. It is determined by a seed and its index, so that a failure can be reproduced. Width,
//! number, density, rotation, shift and the seed of the scene are random. [`Trial::check`] runs it and returns the
//! violated requirements ([`TrialFlaw`]):
//!
//! - every agent arrives before the scene ends, at several times the time that pedestrians need; goals have room for
//!   all of their agents;
//! - no agent walks for 30 s without progress;
//! - agents that have arrived in an area are inside it;
//! - no two bodies overlap, and no body overlaps a wall.
//!
//! ```
//! use throng_record::validate::families::{FAMILIES, Trial};
//! let trial = Trial::new(1, 3);
//! assert_eq!((trial.family, FAMILIES[3].name), (3, "plug"));
//! let scene: throng_scene::Scene = trial.text.parse()?;
//! assert_eq!(scene.plan()?.groups.is_empty(), false);
//! # Ok::<(), throng_scene::Error>(())
//! ```

mod check;
mod pose;
mod scenes;

pub use check::TrialFlaw;

use pose::Pose;
use throng_scene::{Purpose, Random};

/// A family of variants of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Name.
    pub name: &'static str,
    /// Description of its scenes, in a sentence.
    pub about: &'static str,
    draw: fn(&mut Random, &Pose) -> String,
}

/// All families; consecutive trials cycle through them.
pub const FAMILIES: &[Family] = &[
    Family { name: "loop", about: "a ring, all agents the same way round", draw: scenes::circulation },
    Family { name: "compact-loop", about: "agents that walk round a pillar", draw: scenes::compact_loop },
    Family { name: "bend", about: "a corridor with a bend of 90 degrees", draw: scenes::bend },
    Family { name: "plug", about: "an area at the end of a corridor that all agents go to", draw: scenes::plug },
    Family { name: "bus", about: "agents get off and on through one door", draw: scenes::bus },
    Family {
        name: "counterflow",
        about: "two crowds that walk through each other in a corridor",
        draw: scenes::counterflow,
    },
    Family { name: "gate", about: "a crowd before a gate in a wall", draw: scenes::gate },
    Family { name: "planks", about: "long bodies that change places", draw: scenes::planks },
];

/// A variant of a family.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Index into [`FAMILIES`].
    pub family: usize,
    /// Index; with the seed, it determines the trial.
    pub index: u64,
    /// The scene file.
    pub text: String,
}

impl Trial {
    /// Returns the trial with an index.
    pub fn new(seed: u64, index: u64) -> Self {
        let family = (index % FAMILIES.len() as u64) as usize;
        let mut random = Random::new(seed, family as u64, index, Purpose::Choice);
        let pose = Pose::draw(&mut random);
        let scene_seed = random.bits() >> 32;
        let body = (FAMILIES[family].draw)(&mut random, &pose);
        let text = format!("title = \"{} {index}\"\nseed = {scene_seed}\n{body}", FAMILIES[family].name);
        Self { family, index, text }
    }

    /// Returns its name: the family and the index.
    pub fn name(&self) -> String {
        format!("{}-{}", FAMILIES[self.family].name, self.index)
    }
}
