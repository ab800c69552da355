//! Fields: velocities at places and times.

mod anchors;
mod brush;
mod combine;
mod critical;
mod goal;
mod guide;
mod noise;
#[expect(dead_code, reason = "what navigation alone asks")]
#[path = "../navigation/oracle.rs"]
mod oracle;
mod sampled;
mod space;
