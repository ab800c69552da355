//! Scenes.

use crate::error::scene_error;
use crate::world::World;
use pyo3::prelude::*;
use std::path::PathBuf;
use throng_scene::import::plan::{self, PlanOptions};
use throng_scene::{Model, Scene as Described};

/// A scene: a value. Changes return another scene.
#[pyclass(frozen, module = "throng_sim._throng")]
pub struct Scene {
    pub scene: Described,
}

#[pymethods]
impl Scene {
    /// Opens a scene of the gallery by its name, or a file that can be a scene. Returns it, and notes of the importer.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<(Self, Vec<String>)> {
        let opened = py.detach(|| throng_scene::open(&path)).map_err(|error| scene_error(py, &error))?;
        Ok((Self { scene: opened.scene }, opened.notes))
    }

    /// Reads the text of a scene file. Relative file names in it are relative to `folder`.
    #[staticmethod]
    fn parse(py: Python<'_>, text: String, name: &str, folder: PathBuf) -> PyResult<Self> {
        let mut scene = Described::parse(name, text).map_err(|error| scene_error(py, &error))?;
        scene.origin.folder = folder;
        Ok(Self { scene })
    }

    /// Opens a floor plan. `exit` is x and y of the lower left corner, width and height, metres.
    #[staticmethod]
    #[pyo3(signature = (path, exit=None, people=None, unit=None, level=None))]
    fn plan(
        py: Python<'_>,
        path: PathBuf,
        exit: Option<[f64; 4]>,
        people: Option<u64>,
        unit: Option<f64>,
        level: Option<u64>,
    ) -> PyResult<(Self, Vec<String>)> {
        let options = PlanOptions { exit, people, unit, level };
        let opened = py.detach(|| plan::load(&path, &options)).map_err(|error| scene_error(py, &error))?;
        Ok((Self { scene: opened.scene }, opened.notes))
    }

    /// Returns the scene with another value at a path. `value` is its TOML text.
    fn set(&self, py: Python<'_>, path: &str, value: &str) -> PyResult<Self> {
        let mut scene = self.scene.clone();
        scene.set(path, value).map_err(|error| scene_error(py, &error))?;
        Ok(Self { scene })
    }

    /// Returns the scene with another local model in all groups: `rvo`, `orca:time_horizon=4`.
    fn with_model(&self, py: Python<'_>, model: &str) -> PyResult<Self> {
        let parsed = Model::parse(model, &self.scene.plugins.models).and_then(|model| self.scene.with_model(&model));
        Ok(Self { scene: parsed.map_err(|error| scene_error(py, &error))? })
    }

    /// Returns the scene with another seed.
    fn with_seed(&self, seed: u64) -> Self {
        Self { scene: Described { seed, ..self.scene.clone() } }
    }

    /// Returns the text of the scene file.
    fn toml(&self, py: Python<'_>) -> PyResult<String> {
        self.scene.to_toml().map_err(|error| scene_error(py, &error))
    }

    /// The folder to which file names in the scene are relative.
    #[getter]
    fn folder(&self) -> PathBuf {
        self.scene.origin.folder.clone()
    }

    #[getter]
    fn title(&self) -> &str {
        &self.scene.title
    }

    #[getter]
    fn seed(&self) -> u64 {
        self.scene.seed
    }

    /// Seconds of a step.
    #[getter]
    fn dt(&self) -> f64 {
        self.scene.time.step
    }

    /// The latest end, seconds.
    #[getter]
    fn limit(&self) -> f64 {
        self.scene.time.limit
    }

    /// The names of the groups.
    #[getter]
    fn groups(&self) -> Vec<String> {
        let named = |(k, name): (usize, &String)| if name.is_empty() { k.to_string() } else { name.clone() };
        self.scene.groups.iter().map(|group| &group.name).enumerate().map(named).collect()
    }

    /// Builds the world.
    #[pyo3(signature = (threads=1))]
    fn build(&self, py: Python<'_>, threads: usize) -> PyResult<World> {
        World::of(py, &self.scene, threads)
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.scene == other.scene
    }
}

/// Returns the names of the gallery's scenes, by group.
#[pyfunction]
pub fn gallery() -> Vec<(&'static str, Vec<&'static str>)> {
    throng_scene::gallery::groups().map(|(group, names)| (group, names.collect())).collect()
}

/// Returns the JSON schema of scene files.
#[pyfunction]
pub fn schema() -> String {
    throng_scene::schema().to_string()
}

/// Returns the names of the local models.
#[pyfunction]
pub fn models() -> Vec<String> {
    throng_scene::Plugins::new().models.names().map(str::to_owned).collect()
}
