//! Crowds on a path and at a door: combined behaviours, as in the demos of Reynolds, Steering behaviors for autonomous
//! characters, GDC 1999.

use super::{AvoidObstacles, FollowPath};
use crate::{
    Arrive, CloseAvoidance, Condition, MoveForward, Neighbourhood, Priority, Queue, Separation, State, Switch,
    UnalignedAvoidance, WeightedSum,
};
use std::sync::Arc;
use throng::parameters::parameters;
use throng::space::{PathDirection, Pathway};
use throng::steer::{Barriers, BoxedBehaviour, GroupFilter, Target};

/// Range of the separation in a crowd, metres.
const SPACING: f32 = 1.0;

/// Moves along a path among other agents (Reynolds 1999, "crowd path following").
///
/// The agent stays on the path, keeps its distance from neighbours, and pushes no other agent.
///
/// ```
/// use glam::Vec3;
/// use throng::space::Pathway;
/// use throng::steer::BoxedBehaviour;
/// use throng_steer::CrowdPath;
/// let path = Pathway::new(&[Vec3::ZERO, Vec3::X * 20.0, Vec3::Y * 20.0], 1.5, true)?;
/// let crowd = BoxedBehaviour::from(CrowdPath::new(path));
/// # Ok::<(), throng::Error>(())
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct CrowdPath {
    /// The name of the path.
    ///
    /// In code, the path: metres in the coordinates of the [`SteeringInput`](throng::steer::SteeringInput).
    #[parameter(required)]
    pub path: Arc<Pathway>,
    /// Whether it moves in the order of the path's points or against it.
    pub direction: PathDirection,
    /// How far ahead it looks, seconds.
    #[parameter(default = 0.5, unit = "s", above = 0)]
    pub horizon: f32,
}

impl From<CrowdPath> for BoxedBehaviour {
    fn from(CrowdPath { path, direction, horizon }: CrowdPath) -> Self {
        let follow = FollowPath { direction, horizon, ..FollowPath::new(path) };
        among_others(Priority { epsilon: 0.0, parts: vec![follow.into(), MoveForward { part: 0.3 }.into()] })
    }
}

/// Moves through a door among other agents (Reynolds 1999, "queuing").
///
/// The agent goes to a goal through a door in walls, in a queue: it keeps its distance from neighbours and walls, and
/// pushes no other agent.
///
/// ```
/// use glam::Vec3;
/// use throng::space::surface::{Cuboid, Moved, Pose, SeenFrom};
/// use throng::steer::{Barriers, BoxedBehaviour, Target};
/// use throng_steer::QueueAtDoor;
/// let wall = |y| Pose::at(Vec3::Y * y).map(|pose| Moved::new(Cuboid::new(Vec3::new(0.2, 9.0, 3.0)).expect("extents"), pose));
/// let obstacles = Barriers::default().with(wall(5.0)?, SeenFrom::Outside).with(wall(-5.0)?, SeenFrom::Outside);
/// let leave = QueueAtDoor { obstacles, ..QueueAtDoor::new(Target::Point(Vec3::ZERO)) };
/// let leave = BoxedBehaviour::from(leave);
/// # Ok::<(), throng::Error>(())
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct QueueAtDoor {
    /// The target behind the door.
    #[parameter(default = Target::Goal)]
    pub goal: Target,
    /// The position of the door.
    #[parameter(required)]
    pub door: Target,
    /// The walls.
    #[parameter(absent = "everything")]
    pub obstacles: Barriers,
}

impl From<QueueAtDoor> for BoxedBehaviour {
    fn from(QueueAtDoor { goal, door, obstacles }: QueueAtDoor) -> Self {
        let go = |to: Target| -> Self {
            let avoid = AvoidObstacles { towards: to, gap: 0.05, horizon: 1.0, ..obstacles.clone().into() };
            let arrive = Arrive { slowing_distance: 0.0, ..Arrive::new(to) };
            Priority { epsilon: 0.0, parts: vec![avoid.into(), arrive.into()] }.into()
        };
        let through = Condition::Nearer { target: door, than: 0.5 };
        let enter = State { behaviour: go(door), exits: vec![(through, 1)] };
        let states = vec![enter, State { behaviour: go(goal), exits: vec![] }];
        // agents that walk along the wall meet other agents head-on
        let apart = UnalignedAvoidance { horizon: 1.0, ..UnalignedAvoidance::default() };
        among_others(WeightedSum(vec![(1.0, Switch(states).into()), (1.0, apart.into())]))
    }
}

/// Returns the behaviour with separation from neighbours, no faster than the agent right ahead.
fn among_others(of: impl Into<BoxedBehaviour>) -> BoxedBehaviour {
    let near = Neighbourhood { distance: SPACING, ..Neighbourhood::default() };
    let apart = Separation { near, full: 6.0 / SPACING, ..Separation::default() };
    let close = CloseAvoidance { groups: GroupFilter::All, gap: 0.0 };
    Queue::new(WeightedSum(vec![(1.0, of.into()), (1.0, apart.into()), (1.0, close.into())])).into()
}
