//! The experiments with pedestrians that models are validated by: their scenes, measures and results.
//!
//! An [`Experiment`] is a list of [`Case`]s. A case is a scene, as the text of a scene file, and the [`Figure`]s
//! measured on a [`Run`] of it. Each figure holds the result of pedestrians, the results of other simulators in the
//! same geometry, and the tolerance for a model of pedestrians. [`families`] draws random variants of scenes and checks
//! requirements that hold in all of them. `docs/validation.md` describes all of it.
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
pub(crate) use run::AgentPaths;
pub use run::Run;

/// All experiments, in the order of tables.
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
