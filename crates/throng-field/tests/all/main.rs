//! Fields: velocities at places and times.

mod anchors;
mod brush;
mod combine;
mod critical;
#[path = "../../../throng/tests/shared/draw.rs"]
mod draw;
mod goal;
mod guide;
mod kept;
mod noise;
#[path = "../../../throng/tests/shared/oracle.rs"]
mod oracle;
#[path = "../../../throng/tests/shared/kept.rs"]
mod results;
mod sampled;
mod space;
