//! What a picture is to show.

use crate::WorldBox;
use glam::{DVec2, DVec3};
use throng::Obstacle;
use throng_record::{Frame, Setting};

/// The extra height of the view for agents that fly as vehicles, relative to their first height, because they roam.
const HEADROOM: f64 = 0.45;
/// The height of people, metres.
pub(super) const PERSON: f64 = 1.8;
/// The number of corners of the circle that encloses the scene while the viewpoint orbits.
const ROUND: usize = 16;

/// The extent of the scene: a box on the ground and its height.
#[derive(Clone, Debug)]
pub(crate) struct Extent {
    pub ground: WorldBox,
    pub height: f64,
    /// What is to be seen; empty for the corners of the box.
    points: Vec<DVec3>,
}

impl Extent {
    /// Returns the extent above `ground` of everything in the first frame and of the goals. In space without walkable
    /// ground, the box is at least as wide as it is high. `whole`: the picture is to show all of the box.
    pub(crate) fn of(ground: WorldBox, whole: bool, setting: &Setting, first: &Frame) -> Self {
        let bodies = first.bodies.iter().map(|body| f64::from(body.altitude + body.shape().bounding_radius()));
        let goals = setting.goals.iter().filter_map(|goal| goal.altitude());
        let shells = setting.shells.iter().flat_map(|shell| shell.facets.iter().flatten());
        let heights = shells.map(|corner| f64::from(corner.z));
        let height = bodies.chain(goals).chain(heights).filter(|z| z.is_finite()).fold(0.0, f64::max);
        if !setting.in_space {
            let points = if whole { Vec::new() } else { things(setting, first).collect() };
            return Self { ground, height: height.max(PERSON), points };
        }
        let points = Vec::new();
        if !setting.walkable.is_empty() {
            return Self { ground, height, points };
        }
        let roam = first.bodies.iter().any(|body| body.basis.is_some());
        // Surfaces define the height if there are any.
        let height = if roam && setting.shells.is_empty() { height * (1.0 + HEADROOM) } else { height };
        Self { ground: ground.at_least(height), height, points }
    }

    pub(crate) fn middle(&self) -> DVec3 {
        ((self.ground.min + self.ground.max) * 0.5).extend(0.5 * self.height)
    }

    /// Returns the distance of the farthest corner from the middle.
    pub(crate) fn reach(&self) -> f64 {
        0.5 * (self.ground.max - self.ground.min).extend(self.height).length()
    }

    /// Returns what is to be seen; if the view turns, corners of the circle that encloses the box.
    pub(super) fn points(&self, turns: bool) -> Vec<DVec3> {
        if !turns && !self.points.is_empty() {
            return self.points.clone();
        }
        let half = (self.ground.max - self.ground.min) * 0.5;
        let count = if turns { ROUND } else { 4 };
        let corner = |k: usize| match turns {
            true => DVec2::from_angle(k as f64 * std::f64::consts::TAU / ROUND as f64) * half.length(),
            false => half * DVec2::new([1.0, -1.0][k % 2], [1.0, -1.0][k / 2]),
        };
        let up = 0.5 * self.height;
        (0..count).flat_map(|k| [-up, up].map(|z| self.middle() + corner(k).extend(z))).collect()
    }
}

/// Returns the points of the people, the goals, the ground and the obstacles.
fn things<'a>(setting: &'a Setting, first: &'a Frame) -> impl Iterator<Item = DVec3> + 'a {
    let ground = setting.walkable.iter().flat_map(|area| area.outer.iter().copied());
    let obstacles = setting.obstacles.iter().flat_map(|obstacle| match obstacle {
        Obstacle::Circle { center, radius } => {
            [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y].map(|out| *center + out * *radius).to_vec()
        }
        Obstacle::Polygon { corners: points } | Obstacle::Wall { points } => points.clone(),
    });
    let goals = setting.goals.iter().flat_map(|goal| match goal.corners() {
        Some(corners) => corners.to_vec(),
        None => vec![goal.middle()],
    });
    let paths = setting.paths.iter().flat_map(|path| path.segments()).flat_map(|segment| [segment.start, segment.end]);
    let paths = paths.map(|end| end.truncate().as_dvec2() + setting.origin);
    let flat = ground.chain(obstacles).chain(goals).chain(paths).map(|point| point.extend(0.0));
    flat.chain(people(first, 0.0)).filter(|point| point.is_finite())
}

/// Returns the points of the agents of a moment, `ahead` seconds later if they move on: the feet and the heads of people,
/// the undersides and the backs of what flies.
pub(super) fn people(frame: &Frame, ahead: f64) -> impl Iterator<Item = DVec3> + '_ {
    let ends = frame.bodies.iter().flat_map(move |body| {
        let radius = f64::from(body.radius);
        let ends = if body.basis.is_some() { [-radius, radius] } else { [0.0, PERSON.max(2.0 * radius)] };
        let way = (body.velocity.as_dvec2() * ahead).extend(0.0);
        ends.map(|z| body.center() + way + DVec3::Z * z)
    });
    ends.filter(|point| point.is_finite())
}
