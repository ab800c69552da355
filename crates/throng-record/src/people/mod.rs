//! People on foot: which agents of a recording are people, their poses, and the people of files that are read back.
//!
//! All formats with figures take the people of a recording from here: the same agents are people in every format, with
//! the same poses. An agent is a person if it is on the ground and its radius is that of a person
//! ([`Person::of_agent`](throng_figure::Person::of_agent)). A person is a function of the agent's number and radius.

#[cfg(any(feature = "bvh", feature = "glb"))]
pub(crate) mod axes;
#[cfg(any(feature = "bvh", feature = "glb", feature = "usda"))]
mod body;
#[cfg(feature = "bvh")]
mod build;
#[cfg(feature = "glb")]
mod character;
#[cfg(any(feature = "bvh", feature = "glb", feature = "usda"))]
mod choose;
mod figure;
#[cfg(test)]
pub(crate) mod samples;
mod style;
mod walks;

#[cfg(any(feature = "glb", feature = "usda"))]
pub(crate) use body::PersonBody;
#[cfg(feature = "bvh")]
pub(crate) use build::{fitted, legs_of};
#[cfg(feature = "glb")]
pub use character::character;
#[cfg(any(feature = "bvh", feature = "glb", feature = "usda"))]
pub(crate) use choose::People;
pub use figure::{Figure, Figures};
pub use style::{FigureStyle, MOST_SKINS};
pub use walks::Walks;
