//! The native part of the Python package `throng-sim`: scenes, worlds with their state as arrays, recordings.
//!
//! What people use is `python/throng_sim`, on top of this module.

mod arrow;
mod error;
mod figure;
mod inner;
mod live;
mod measure;
mod model;
mod neighbours;
mod place;
mod run;
mod scene;
mod stepper;
mod sweep;
mod threads;
mod track;
mod trajectories;
mod world;
mod writable;

/// Scenes, worlds and recordings.
#[pyo3::pymodule(gil_used = false)]
mod _throng {
    #[pymodule_export]
    use crate::error::{FileError, SceneError, WorldError};
    #[pymodule_export]
    use crate::figure::{builds, joints, look_colors, look_worn, mesh, regions, skeleton};
    #[pymodule_export]
    use crate::measure::figures;
    #[pymodule_export]
    use crate::model::View;
    #[pymodule_export]
    use crate::place::cut_ground;
    #[pymodule_export]
    use crate::run::{Recording, colors};
    #[pymodule_export]
    use crate::scene::{Scene, gallery, models, schema};
    #[pymodule_export]
    use crate::stepper::Stepper;
    #[pymodule_export]
    use crate::sweep::Plan;
    #[pymodule_export]
    use crate::trajectories::Trajectories;
    #[pymodule_export]
    use crate::world::World;
}
