//! Behaviours with respect to other agents: flocks, queues, followers, formations.

mod alignment;
mod assignment;
mod avoid_neighbours;
mod boids;
mod close_avoidance;
mod cohesion;
mod flocking;
mod flocking_simd;
mod follow_leader;
mod formation;
mod match_velocity;
mod neighbourhood;
mod queue;
mod separation;
mod unaligned_avoidance;

pub use alignment::Alignment;
pub use assignment::assign;
pub use avoid_neighbours::AvoidNeighbours;
pub use boids::{Boids, Strengths};
pub use close_avoidance::CloseAvoidance;
pub use cohesion::Cohesion;
pub use flocking::{Flocking, Rule};
pub use follow_leader::FollowLeader;
pub use formation::{KeepFormation, Pattern};
pub use match_velocity::MatchVelocity;
pub use neighbourhood::Neighbourhood;
pub use queue::Queue;
pub use separation::{Falloff, Separation};
pub use unaligned_avoidance::UnalignedAvoidance;
