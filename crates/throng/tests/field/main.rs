//! Fields: velocities at places and times.

mod anchors;
mod critical;
mod sampled;
