//! The place of a replay, and the model of its agents.

use glam::DVec2;
use throng::space::crossing;
use throng::{Agent, Error, Group, Obstacle, Settings, Walkable, World};

/// Spacing and greatest distance of the positions that are tried for an agent without room, metres.
const FINE: f64 = 0.05;
const FARTHEST: f64 = 2.0;

/// The place of a replay, and the model of its agents.
#[derive(Clone, Debug)]
pub struct ReplayScene {
    /// The settings of the world. Its clock starts with the replay.
    pub settings: Settings,
    /// The common group of all agents: local model and interaction rules.
    pub group: Group,
    /// Common properties of all agents: limits of speed, acceleration and turning.
    pub agent: Agent,
    /// Walkable areas; empty: everywhere outside obstacles.
    pub walkable: Vec<Walkable>,
    /// The obstacles.
    pub obstacles: Vec<Obstacle>,
    /// Distance from the goal at which an agent has arrived, metres.
    pub near: f64,
    /// Whether all agents that arrive stay until their recordings end.
    pub stay: bool,
}

impl ReplayScene {
    /// Returns the world without agents.
    ///
    /// # Errors
    /// The world rejects the settings, the walkable areas or the obstacles.
    pub fn world(&self) -> Result<World, Error> {
        let mut world = World::new(self.settings)?;
        world.set_walkable(self.walkable.clone())?;
        world.add_obstacles(self.obstacles.iter().cloned()).map_err(|(_, error)| error)?;
        Ok(world)
    }

    /// Whether the segment between two points passes through an obstacle or leaves the walkable area.
    pub fn blocks(&self, from: DVec2, to: DVec2) -> bool {
        let obstacles = self.obstacles.iter().any(|obstacle| match obstacle {
            Obstacle::Circle { center, radius } => {
                let way = to - from;
                let share = ((center - from).dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
                (from + share * way).distance(*center) < *radius
            }
            Obstacle::Polygon { corners } => obstacle.covers(from) || obstacle.covers(to) || closed(corners, from, to),
            Obstacle::Wall { points } => points.windows(2).any(|edge| crossing(edge[0], edge[1], from, to).is_some()),
        });
        let on_ground = |at: DVec2| self.walkable.is_empty() || self.walkable.iter().any(|area| area.contains(at));
        obstacles || !on_ground(from) || !on_ground(to)
    }
}

/// Whether a segment crosses the boundary of a polygon.
fn closed(corners: &[DVec2], from: DVec2, to: DVec2) -> bool {
    (0..corners.len()).any(|k| crossing(corners[k], corners[(k + 1) % corners.len()], from, to).is_some())
}

/// Returns the nearest point (to 5 cm) at which a disc has room on the ground, within 2 m. Agents do not count.
pub(super) fn room(world: &World, at: DVec2, radius: f64) -> Option<DVec2> {
    let free = |place: &DVec2| world.no_room(*place, radius as f32).is_none();
    let ring = |k: u32| {
        let distance = f64::from(k) * FINE;
        // spacing along a ring equals that of the rings
        let count = (std::f64::consts::TAU * f64::from(k)).ceil().max(1.0);
        let turn = std::f64::consts::TAU / count;
        (0..count as u32).map(move |j| at + distance * DVec2::from_angle(f64::from(j) * turn))
    };
    (0..=(FARTHEST / FINE) as u32).flat_map(ring).find(free)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stage() -> ReplayScene {
        let square = |from: f64, to: f64| [(from, from), (to, from), (to, to), (from, to)].map(DVec2::from).to_vec();
        ReplayScene {
            settings: Settings::default(),
            group: Group::default(),
            agent: Agent::default(),
            walkable: vec![Walkable { outer: square(-10.0, 10.0), holes: vec![] }],
            obstacles: vec![
                Obstacle::Polygon { corners: square(0.0, 1.0) },
                Obstacle::Circle { center: DVec2::new(-5.0, 0.0), radius: 1.0 },
                Obstacle::Wall { points: vec![DVec2::new(5.0, -1.0), DVec2::new(5.0, 1.0)] },
            ],
            near: 0.3,
            stay: false,
        }
    }

    #[test]
    fn segments_through_obstacles_are_found() {
        let blocks = |a: (f64, f64), b: (f64, f64)| stage().blocks(a.into(), b.into());
        assert!(blocks((-1.0, 0.5), (2.0, 0.5)) && blocks((0.4, 0.4), (0.6, 0.6)) && !blocks((-1.0, 2.0), (2.0, 2.0)));
        assert!(
            blocks((-5.0, -3.0), (-5.0, 3.0))
                && !blocks((-6.5, -3.0), (-6.5, 3.0))
                && !blocks((-3.0, 0.0), (-3.0, 0.0))
        );
        assert!(blocks((4.0, 0.0), (6.0, 0.0)) && !blocks((4.0, 2.0), (6.0, 2.0)));
        assert!(blocks((9.0, 9.0), (11.0, 9.0)));
    }

    #[test]
    fn an_agent_in_an_obstacle_is_moved_beside_it() {
        let world = stage().world().unwrap();
        let at = DVec2::new(0.9, 0.5);
        let beside = room(&world, at, 0.2).unwrap();
        assert!((beside.x - 1.2).abs() < 0.06 && (beside.y - 0.5).abs() < 0.1, "{beside}");
        assert_eq!(room(&world, DVec2::new(3.0, 3.0), 0.2), Some(DVec2::new(3.0, 3.0)));
        assert_eq!(room(&world, DVec2::new(30.0, 3.0), 0.2), None);
    }
}
