//! Fields: velocities at places and times.

mod anchors;
mod brush;
mod combine;
mod critical;
mod sampled;
mod space;
