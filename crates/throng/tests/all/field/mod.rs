//! Fields: velocities at places and times.

mod anchors;
mod brush;
mod combine;
mod critical;
mod goal;
mod guide;
mod kept;
mod noise;
mod sampled;
mod space;
