//! One run of a plan.

use super::plan::{Plan, PlannedScene};
use super::row::Parameter;
use throng_scene::{Error, Scene};

/// One run of a plan: a scene, values of the parameters, and a seed.
#[derive(Clone, Debug)]
pub struct SweepRun<'p> {
    /// The plan.
    pub(super) plan: &'p Plan,
    /// The number of the run, from 0.
    pub index: usize,
    /// The scene, before parameters are set.
    pub scene: &'p PlannedScene,
    /// The value of each axis, by its position.
    pub(super) choice: Vec<usize>,
    /// The seed; `None` for the scene's own.
    pub(super) seed: Option<u64>,
}

impl SweepRun<'_> {
    /// Returns the seed.
    pub fn seed(&self) -> u64 {
        self.seed.unwrap_or(self.scene.scene.seed)
    }

    /// Returns the parameters that vary, with the values of this run.
    pub fn parameters(&self) -> Vec<Parameter> {
        let axes = self.plan.axes.iter().zip(&self.choice);
        let parameters = axes.flat_map(|(axis, &value)| {
            axis.parameters.iter().map(move |parameter| Parameter {
                column: parameter.column.clone(),
                cell: parameter.cells[value].clone(),
            })
        });
        parameters.collect()
    }

    /// Returns the scene with the parameters, the seed and the limit.
    ///
    /// # Errors
    /// The scene does not have a key, or a value has the wrong type.
    pub fn scene(&self) -> Result<Scene, Error> {
        let mut scene = self.scene.scene.clone();
        for (_, key, value) in self.plan.changes(&self.choice) {
            scene.set(key, &value.toml())?;
        }
        if let Some(limit) = self.plan.limit {
            scene.time.limit = limit;
        }
        scene.seed = self.seed();
        Ok(scene)
    }
}
