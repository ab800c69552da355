//! What the values of a parameter are, and how files write them.

use super::Parameter;
use std::borrow::Cow;

/// What the values of a parameter are. Schemas, sliders and reference pages are made from it.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A number.
    Number,
    /// A whole number, not negative.
    Whole,
    /// True or false.
    Flag,
    /// A text.
    Text,
    /// One of these names.
    Name(fn() -> Names),
    /// A table with one of these keys, which chooses what its value is.
    Choice(fn() -> Table),
    /// A table with parameters.
    Table(fn() -> Table),
    /// A list of values.
    List(&'static Kind),
    /// A list of this many values.
    Several(&'static Kind, usize),
    /// Values by name.
    Named(&'static Kind),
    /// A list of values, or a table in which that list is one of the parameters.
    ListOrTable(&'static Kind, fn() -> Table),
    /// Numbers along x and y, and along z, which may be left out.
    Vector,
    /// A place in space.
    SpacePlace,
    /// A place on the ground.
    GroundPlace,
    /// A target: a place, an agent.
    Target,
    /// The agents that count.
    Groups,
    /// Surfaces and obstacles.
    Obstacles,
    /// A surface.
    Surface,
    /// A path.
    Path,
    /// A vector field.
    Field,
    /// A factor at every place.
    Map,
    /// A behaviour.
    Behaviour,
    /// A figure of the rules.
    Figure,
}

/// A type of names.
#[derive(Clone, Copy, Debug)]
pub struct Names {
    /// The name of the type.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
    /// The names.
    pub names: &'static [Name],
}

/// A name that a parameter can have as its value.
#[derive(Clone, Copy, Debug)]
pub struct Name {
    /// The name.
    pub name: &'static str,
    /// What it means.
    pub about: &'static str,
}

/// A type with parameters, or with choices: the parameters of a [choice](Kind::Choice) are what can be chosen.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// The name of the type.
    pub name: &'static str,
    /// What it is.
    pub about: &'static str,
    /// The parameters.
    pub parameters: &'static [Parameter],
}

/// A value as files write it.
#[derive(Clone, Debug, PartialEq)]
pub enum Written {
    /// A number.
    Number(f64),
    /// A whole number.
    Whole(u64),
    /// True or false.
    Flag(bool),
    /// A text or a name.
    Text(Cow<'static, str>),
    /// A list.
    List(Vec<Self>),
    /// A table: keys and values.
    Table(Vec<(Cow<'static, str>, Self)>),
}
