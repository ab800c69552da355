//! Tests of people on trajectories.

mod character;
mod damaged;
mod feet;
mod forward;
mod gait;
mod live;
mod mesh;
mod paths;
mod smooth;
