//! What a file gives for a parameter.

use super::{Names, Parameter, Table, Value};
use crate::Error;
use crate::field::{FactorMap, Field};
use crate::space::Pathway;
use crate::space::surface::{Barrier, Surface};
use crate::steer::{Barriers, BoxedBehaviour, GroupFilter, Target};
use glam::{Vec2, Vec3};
use std::sync::Arc;

/// What a scene file gives for a parameter, with its place in the file. Names of agents, surfaces, paths and fields stand
/// for those of the scene. Readers of files implement it; types of values ([`Value`]) read it.
///
/// Each method reads one kind of value. Its error names the place in the file.
#[expect(clippy::missing_errors_doc, reason = "the paragraph above states them")]
pub trait Given: Sized {
    /// Why a value cannot be used, and its place in the file.
    type Error;

    /// Reads a number.
    fn number(&self) -> Result<f64, Self::Error>;
    /// Reads a whole number from 0 to `most`.
    fn whole(&self, most: u64) -> Result<u64, Self::Error>;
    /// Reads `true` or `false`.
    fn flag(&self) -> Result<bool, Self::Error>;
    /// Reads a text.
    fn text(&self) -> Result<String, Self::Error>;
    /// Reads one of several names, and returns its position.
    fn name(&self, names: &Names) -> Result<usize, Self::Error>;
    /// Reads the name of one of several things of a kind, and returns its position.
    fn one_of(&self, kind: &str, names: &[&str]) -> Result<usize, Self::Error>;
    /// Reads a list.
    fn list(&self) -> Result<Vec<Self>, Self::Error>;
    /// Whether it is a list.
    fn is_list(&self) -> bool;
    /// Checks that it is a table, and that its keys are names of parameters.
    fn table(&self, table: &Table) -> Result<(), Self::Error>;
    /// Reads a table with one key. Returns the position of the key among the parameters, and its value.
    fn choice(&self, table: &Table) -> Result<(usize, Self), Self::Error>;
    /// Reads values by name, in the order of the names.
    fn named(&self) -> Result<Vec<(String, Self)>, Self::Error>;
    /// Returns the value of a key of a table.
    fn get(&self, key: &str) -> Option<Self>;
    /// Returns this text as the value of a key that is not given.
    fn absent(&self, key: &str, text: &str) -> Self;

    /// Reads a vector.
    fn vector(&self) -> Result<Vec3, Self::Error>;
    /// Reads a place in space, and returns it in the coordinates of behaviours.
    fn space_place(&self) -> Result<Vec3, Self::Error>;
    /// Reads a place on the ground, and returns it in the coordinates of behaviours.
    fn ground_place(&self) -> Result<Vec2, Self::Error>;
    /// Reads a target.
    fn target(&self) -> Result<Target, Self::Error>;
    /// Reads the agents that count.
    fn groups(&self) -> Result<GroupFilter, Self::Error>;
    /// Reads the names of obstacles and surfaces.
    fn obstacles(&self) -> Result<Barriers, Self::Error>;
    /// Reads the name of a surface.
    fn surface(&self) -> Result<Barrier<Arc<dyn Surface>>, Self::Error>;
    /// Reads the name of a path.
    fn path(&self) -> Result<Arc<Pathway>, Self::Error>;
    /// Reads a vector field.
    fn field(&self) -> Result<Arc<dyn Field>, Self::Error>;
    /// Reads a factor at every place.
    fn map(&self) -> Result<Arc<dyn FactorMap>, Self::Error>;
    /// Reads a behaviour.
    fn behaviour(&self) -> Result<BoxedBehaviour, Self::Error>;
    /// Reads the name of a figure of the rules, and returns its position.
    fn figure(&self) -> Result<usize, Self::Error>;

    /// Checks the limit of a parameter that has been read.
    fn check<V: Value>(&self, parameter: &Parameter, value: &V) -> Result<(), Self::Error>;
    /// Returns the error for a table without the key `key`.
    fn missing(&self, key: &str) -> Self::Error;
    /// Returns the error for values that a type refuses.
    fn refused(&self, error: Error) -> Self::Error;

    /// Reads a parameter of a table, and checks its limit. `usual` is its value if the table does not give it; if that is
    /// `None`, the table must give it.
    fn parameter<V: Value>(&self, parameter: &Parameter, usual: Option<V>) -> Result<V, Self::Error> {
        match self.get(parameter.name) {
            Some(given) => {
                let value = V::read(&given, usual)?;
                given.check(parameter, &value)?;
                Ok(value)
            }
            None => usual.ok_or_else(|| self.missing(parameter.name)),
        }
    }

    /// Reads a parameter of a table as a value of type `From`, and makes a value of type `V` of it.
    fn made_from<From: Value, V: TryFrom<From, Error: Into<Error>>>(
        &self,
        parameter: &Parameter,
        usual: Option<V>,
    ) -> Result<V, Self::Error> {
        match self.get(parameter.name) {
            Some(given) => {
                let value = From::read(&given, None)?;
                given.check(parameter, &value)?;
                V::try_from(value).map_err(|error| given.refused(error.into()))
            }
            None => usual.ok_or_else(|| self.missing(parameter.name)),
        }
    }
}
