//! A viewpoint that follows an agent.

use glam::{DVec3, Vec2};
use throng_record::Body;

/// The agent that a viewpoint follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Followed {
    /// The middle of the agent.
    pub center: DVec3,
    /// The direction in which the agent faces, of length 1.
    pub forward: DVec3,
    /// The radius, metres.
    pub radius: f64,
}

impl From<&Body> for Followed {
    fn from(body: &Body) -> Self {
        let level = || Vec2::from_angle(body.heading).extend(0.0);
        let forward = body.basis.map_or_else(level, |basis| basis.forward);
        Self { center: body.center(), forward: forward.as_dvec3(), radius: body.shape().bounding_radius().into() }
    }
}

/// A viewpoint and its target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// The viewpoint, metres.
    pub eye: DVec3,
    /// The point that it looks at, metres.
    pub target: DVec3,
}

impl Sight {
    /// Moves smoothly towards another viewpoint for `seconds`, at a rate of the exponential approach, 1/s.
    pub fn approach(&mut self, wanted: Self, seconds: f64, rate: f64) {
        let part = if rate.is_finite() { 1.0 - libm::exp(-rate * seconds.max(0.0)) } else { 1.0 };
        self.eye = self.eye.lerp(wanted.eye, part);
        self.target = self.target.lerp(wanted.target, part);
    }
}

/// The ways of following an agent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chase {
    /// At a fixed distance: the viewpoint keeps the side it is on.
    Distance,
    /// At a fixed position relative to the agent: the viewpoint turns with it.
    Offset,
    /// From the agent's point of view.
    PointOfView,
    /// From straight above.
    Down,
}

impl Chase {
    /// Returns the wanted viewpoint, `aside` radii away, for a current viewpoint at `from`.
    pub fn sight(self, followed: &Followed, aside: f64, from: DVec3) -> Sight {
        let Followed { center, forward, radius } = *followed;
        let away = aside * radius;
        let level = forward.with_z(0.0).normalize_or(DVec3::X);
        let left = DVec3::Z.cross(level);
        match self {
            Self::Distance => {
                let behind = (from - center).with_z(0.0).normalize_or(-level);
                Sight { eye: center + (behind * 0.85 + DVec3::Z * 0.5) * away, target: center }
            }
            Self::Offset => Sight { eye: center + (level * -0.6 + left * 0.6 + DVec3::Z * 0.5) * away, target: center },
            Self::PointOfView => {
                let eye = center + DVec3::Z * 4.0 * radius;
                Sight { eye, target: eye + forward * 20.0 * radius - DVec3::Z * 2.0 * radius }
            }
            Self::Down => Sight { eye: center + DVec3::Z * away * 1.5, target: center },
        }
    }
}

/// The agent that the viewpoint of a film follows, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Following {
    /// The number of the agent. The viewpoint does not move while the agent is absent.
    pub number: u32,
    /// The way of following.
    pub chase: Chase,
    /// The distance in radii of the agent, greater than 0.
    pub aside: f64,
}

/// The usual distance from an agent that is followed, radii.
const ASIDE: f64 = 28.0;

impl Following {
    /// Returns the usual way of following an agent: at a fixed distance that shows it and what is around it.
    pub fn usual(number: u32) -> Self {
        Self { number, chase: Chase::Distance, aside: ASIDE }
    }
}
