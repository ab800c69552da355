//! The experiments with people that models of pedestrians are judged by: their scenes, how they are measured, and what people did.
//!
//! An [`Experiment`] is a list of [`Case`]s. A case is a scene, whose text is a scene file, and the [`Figure`]s measured on a [`Run`] of it. Each
//! figure holds what people did, what other simulators did in the same geometry, and the tolerance of a model that walks as people do.
//! [`families`] draws variants of scenes at random and checks what has to hold in all of them. `docs/validation.md` describes all of it.
//!
//! ```
//! use throng_record::validate::{EXPERIMENTS, Run};
//! let experiment = EXPERIMENTS.iter().find(|experiment| experiment.name == "lone-walker").unwrap();
//! let case = &experiment.cases()[0];
//! let run = Run::of(&case.scene(1)?, case.interval, |_| true)?.expect("it is not interrupted");
//! let values = case.measure(&run);
//! assert_eq!((values.len(), run.people.walks.len()), (case.figures.len(), 1));
//! # Ok::<(), throng_scene::Error>(())
//! ```

mod bidirectional;
mod circulation;
mod corner;
mod corridor;
mod crossing;
mod door;
mod experiment;
pub mod families;
mod gate;
mod head_on;
mod measure;
mod motion;
mod place;
pub mod points;
mod rimea;
mod run;
mod single_file;

pub use experiment::{Case, Experiment, Figure, Overall, Reference};
pub use run::Run;

/// All experiments, in the order in which they are listed.
pub const EXPERIMENTS: &[Experiment] = &[
    single_file::EXPERIMENT,
    corridor::EXPERIMENT,
    door::EXPERIMENT,
    bidirectional::EXPERIMENT,
    corner::EXPERIMENT,
    crossing::EXPERIMENT,
    circulation::EXPERIMENT,
    gate::EXPERIMENT,
    head_on::PAIR,
    head_on::LONE,
    rimea::EXPERIMENT,
];
