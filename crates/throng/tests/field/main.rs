//! Fields: velocities at places and times.

mod anchors;
mod brush;
mod critical;
mod noise;
mod sampled;
