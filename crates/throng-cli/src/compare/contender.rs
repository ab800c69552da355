//! The models that are compared.

use super::worker::{Script, WorkerModel};
use crate::failure::Failure;
use crate::models::model;
use crate::source::Loaded;
use std::fmt;
use std::sync::Arc;
use throng::World;
use throng_scene::{Built, Model};

/// A local model of the engine, or one in Python.
pub enum Contender {
    /// A model of the engine.
    Engine(Model),
    /// A model in a file of Python.
    Python(Script),
}

impl Contender {
    /// Returns the model that a part of `--models` names.
    ///
    /// # Errors
    /// The model does not exist, or has no such key.
    pub fn named(text: &str) -> Result<Self, Failure> {
        match Script::named(text) {
            Some(script) => Ok(Self::Python(script)),
            None => Ok(Self::Engine(model("--models", text)?)),
        }
    }

    /// Returns the text that names the model in tables.
    pub fn label(&self) -> &str {
        match self {
            Self::Engine(model) => model.label(),
            Self::Python(script) => script.label(),
        }
    }

    /// Builds a scene with this model in all groups. Returns the model also by itself, if it is in Python.
    ///
    /// # Errors
    /// The scene cannot be built, or the model cannot be started.
    pub fn build(&self, mut loaded: Loaded) -> Result<(World, Built, Option<Arc<WorkerModel>>), Failure> {
        match self {
            Self::Engine(model) => {
                loaded.scene = loaded.scene.with_model(model).map_err(|mut error| {
                    error.file = Some(format!("--models {model}").into());
                    error
                })?;
                let (world, built) = loaded.build(true)?;
                Ok((world, built, None))
            }
            Self::Python(script) => {
                let (mut world, built) = loaded.build(true)?;
                let model = Arc::new(script.start()?);
                for group in &built.groups {
                    let changed = model.lead(world.group(group.id).clone());
                    world.set_group(group.id, changed).map_err(|error| Failure::Error(error.to_string()))?;
                }
                Ok((world, built, Some(model)))
            }
        }
    }
}

impl fmt::Display for Contender {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.label())
    }
}
