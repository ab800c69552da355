//! Behaviours that query the world's geometry: obstacles, containers, walls, paths.

mod avoid_map;
mod avoid_obstacles;
mod contain;
mod course;
mod crowds;
mod follow_path;
mod follow_wall;
mod hide;
mod stay_on_path;
mod whiskers;

pub use avoid_map::{AvoidMap, DriveByMap};
pub use avoid_obstacles::AvoidObstacles;
pub use contain::Contain;
pub use crowds::{CrowdPath, QueueAtDoor};
pub use follow_path::FollowPath;
pub use follow_wall::FollowWall;
pub use hide::Hide;
pub use stay_on_path::StayOnPath;
pub use whiskers::{Whisker, Whiskers};
