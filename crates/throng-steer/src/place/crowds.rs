//! Crowds on a path and at a door: combined behaviours, as in the demos of Reynolds, Steering behaviors for autonomous
//! characters, GDC 1999.

use super::{AvoidObstacles, FollowPath};
use crate::{
    Arrive, CloseAvoidance, Condition, MoveForward, Neighbourhood, Priority, Queue, Separation, State, Switch,
    UnalignedAvoidance, WeightedSum,
};
use throng::steer::Barriers;
use throng::steer::{BoxedBehaviour, GroupFilter, Target};

/// Range of the separation in a crowd, metres.
const SPACING: f32 = 1.0;

/// Returns a behaviour that walks along a path in a crowd: the agent stays on the path, keeps its distance from
/// neighbours, and pushes no other agent.
///
/// ```
/// use glam::Vec3;
/// use throng::space::Pathway;
/// use throng_steer::{crowd_path, FollowPath};
/// let path = Pathway::new(&[Vec3::ZERO, Vec3::X * 20.0, Vec3::Y * 20.0], 1.5, true)?;
/// let crowd = crowd_path(FollowPath::from(path));
/// # Ok::<(), throng::Error>(())
/// ```
pub fn crowd_path(follow: FollowPath) -> BoxedBehaviour {
    let onward = Priority { epsilon: 0.0, parts: vec![follow.into(), MoveForward { part: 0.3 }.into()] };
    among_others(onward)
}

/// Returns a behaviour that goes to a goal through a door in walls, in a queue: the agent keeps its distance from
/// neighbours and walls, and pushes no other agent.
///
/// ```
/// use glam::Vec3;
/// use throng::space::surface::{Cuboid, Moved, Pose, SeenFrom};
/// use throng::steer::{Barriers, Target};
/// use throng_steer::queue_at_door;
/// let wall = |y| Pose::at(Vec3::Y * y).map(|pose| Moved::new(Cuboid::new(Vec3::new(0.2, 9.0, 3.0)).expect("extents"), pose));
/// let walls = Barriers::default().with(wall(5.0)?, SeenFrom::Outside).with(wall(-5.0)?, SeenFrom::Outside);
/// let leave = queue_at_door(Target::Goal, Target::Point(Vec3::ZERO), walls);
/// # Ok::<(), throng::Error>(())
/// ```
pub fn queue_at_door(goal: Target, door: Target, walls: Barriers) -> BoxedBehaviour {
    let go = |to: Target| -> BoxedBehaviour {
        let avoid = AvoidObstacles { towards: to, gap: 0.05, seconds: 1.0, ..AvoidObstacles::from(walls.clone()) };
        Priority { epsilon: 0.0, parts: vec![avoid.into(), Arrive { slowing_distance: 0.0, ..Arrive::new(to) }.into()] }
            .into()
    };
    let through = Condition::Nearer(door, 0.5);
    let states =
        vec![State { behaviour: go(door), exits: vec![(through, 1)] }, State { behaviour: go(goal), exits: vec![] }];
    // agents that walk along the wall meet other agents head-on
    let apart = UnalignedAvoidance { horizon: 1.0, ..UnalignedAvoidance::default() };
    among_others(WeightedSum(vec![(1.0, Switch(states).into()), (1.0, apart.into())]))
}

/// Returns the behaviour with separation from neighbours, no faster than the agent right ahead.
fn among_others(of: impl Into<BoxedBehaviour>) -> BoxedBehaviour {
    let near = Neighbourhood { distance: SPACING, ..Neighbourhood::default() };
    let apart = Separation { near, full: 6.0 / SPACING, ..Separation::default() };
    let close = CloseAvoidance { groups: GroupFilter::All, gap: 0.0 };
    Queue::new(WeightedSum(vec![(1.0, of.into()), (1.0, apart.into()), (1.0, close.into())])).into()
}
