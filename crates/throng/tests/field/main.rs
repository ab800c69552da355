//! Fields: velocities at places and times.

mod anchors;
mod brush;
mod combine;
mod critical;
mod noise;
mod sampled;
mod space;
