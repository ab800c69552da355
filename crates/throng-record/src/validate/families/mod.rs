//! Random families of scenes: variants of scenes in which promises broke, and what has to hold in every one of them.
//!
//! A [`Trial`] is one variant. It follows from a seed and its index, so that a failure can be reproduced: width, number, density, rotation, shift and the
//! seed of the scene are drawn at random. [`Trial::check`] runs it and names what does not hold ([`Flaw`]):
//!
//! - every agent arrives before the scene ends, which leaves several times what people need; goals have room for all of their agents;
//! - no agent walks for 30 s without getting anywhere;
//! - agents that have arrived in an area are inside it;
//! - no two bodies overlap, and none overlaps a wall.
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

pub use check::Flaw;

use pose::Pose;
use throng_scene::{Purpose, Random};

/// Variants of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Its name.
    pub name: &'static str,
    /// What its scenes are, in a sentence.
    pub about: &'static str,
    draw: fn(&mut Random, &Pose) -> String,
}

/// All families; trials take them in turn.
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
    /// Which of [`FAMILIES`].
    pub family: usize,
    /// Its index; with the seed it says all of it.
    pub index: u64,
    /// The scene file.
    pub text: String,
}

impl Trial {
    /// The trial with an index.
    pub fn new(seed: u64, index: u64) -> Self {
        let family = (index % FAMILIES.len() as u64) as usize;
        let mut random = Random::new(seed, family as u64, index, Purpose::Choice);
        let pose = Pose::draw(&mut random);
        let scene_seed = random.bits() >> 32;
        let body = (FAMILIES[family].draw)(&mut random, &pose);
        let text = format!("title = \"{} {index}\"\nseed = {scene_seed}\n{body}", FAMILIES[family].name);
        Self { family, index, text }
    }

    /// Its name: the family and the index.
    pub fn name(&self) -> String {
        format!("{}-{}", FAMILIES[self.family].name, self.index)
    }
}
