//! Sweeps: many runs of scenes with many values of their parameters and many seeds, and one table of the results.
//!
//! A [`Plan`] names scenes, parameters, seeds and what is recorded. Its runs are numbered from 0. [`run_one`] makes one
//! run on the calling thread and returns its [`Row`], so that any number of threads, processes or machines can share
//! the runs. [`RunFolder`] keeps the rows of finished runs, each under the [`Fingerprint`] of all that its result
//! depends on. [`collect`] makes the table of the rows. `docs/sweeps.md` describes plans and tables.
//!
//! ```
//! use throng_record::sweep::{Plan, collect, run_one};
//! use throng_scene::Plugins;
//!
//! let text = r#"
//!     scenes = "headon"
//!     seeds = "1..2"
//!     limit = 1
//!     [[vary]]
//!     avoid.orca.time_horizon = [1, 2, 4]
//! "#;
//! let plan = Plan::parse("plan.toml", text, "", &Plugins::new())?;
//! let rows = plan.runs().filter_map(|run| run_one(&run, || true));
//! let table = collect(&plan, rows);
//! assert_eq!((plan.len(), table.rows()), (6, 6));
//! # Ok::<(), throng_scene::Error>(())
//! ```

mod axis;
mod file;
mod fingerprint;
mod folder;
mod numbers;
mod one;
mod plan;
mod recorded;
mod row;
mod run;
mod table;
mod value;

pub use fingerprint::{FileFingerprints, Fingerprint};
pub use folder::RunFolder;
pub use numbers::whole_numbers;
pub use one::run_one;
pub use plan::{MOST_RUNS, Plan, PlannedScene};
pub use row::{Parameter, Row};
pub use run::SweepRun;
#[cfg(feature = "parquet")]
pub(crate) use table::ResultColumn;
pub use table::{ResultTable, collect};
