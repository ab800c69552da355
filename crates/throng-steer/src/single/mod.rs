//! Behaviours of a single agent, or of an agent with respect to a target.

mod arrive;
mod constant_force;
mod dock;
mod evade;
mod evade_all;
mod explore;
mod face;
mod fear;
mod flee;
mod flow;
mod forage;
mod forward;
mod fractal_wander;
mod head_for;
mod interpose;
mod offset_pursuit;
mod pursue;
mod seek;
mod shadow;
mod slip_through;
mod station;
mod takeoff;
mod target_speed;
mod tether;
mod wander;

pub use arrive::Arrive;
pub(crate) use arrive::SLOWING_DISTANCE;
pub(super) use arrive::{approach, settling_time};
pub use constant_force::ConstantForce;
pub use dock::{Dock, Docking};
pub use evade::Evade;
pub use evade_all::EvadeAll;
pub use explore::Explore;
pub use face::{Face, LookWhereYouGo, MatchOrientation};
pub use fear::Fear;
pub use flee::Flee;
pub use flow::FollowFlow;
pub use forage::Forage;
pub use forward::MoveForward;
pub use fractal_wander::FractalWander;
pub use head_for::HeadFor;
pub use interpose::Interpose;
pub use offset_pursuit::OffsetPursuit;
pub use pursue::Pursue;
pub use seek::Seek;
pub use shadow::Shadow;
pub use slip_through::SlipThrough;
pub use station::KeepStation;
pub(super) use station::keep;
pub use takeoff::{Takeoff, takeoff};
pub use target_speed::TargetSpeed;
pub use tether::Tether;
pub use wander::Wander;

use glam::Vec3;
use throng::parameters::Angle;

/// Returns the direction of a heading and a pitch.
fn direction(heading: Angle, pitch: Angle) -> Vec3 {
    let (sin, cos) = libm::sincosf(heading.radians());
    let (up, level) = libm::sincosf(pitch.radians());
    Vec3::new(cos * level, sin * level, up)
}
