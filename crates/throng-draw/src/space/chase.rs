//! An eye that goes with somebody.

use glam::{DVec3, Vec2};
use throng_record::Body;

/// How fast an eye gets where it wants to be, a second.
const HASTE: f64 = 7.0;

/// Whom an eye goes with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Followed {
    /// Its middle.
    pub center: DVec3,
    /// Where it faces, of length 1.
    pub forward: DVec3,
    /// Its radius, metres.
    pub radius: f64,
}

impl From<&Body> for Followed {
    fn from(body: &Body) -> Self {
        let level = || Vec2::from_angle(body.heading).extend(0.0);
        let forward = body.basis.map_or_else(level, |basis| basis.forward);
        Self { center: body.center(), forward: forward.as_dvec3(), radius: body.shape().bound().into() }
    }
}

/// From where one looks, and to where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// Where the eye is, metres.
    pub eye: DVec3,
    /// What it looks at.
    pub target: DVec3,
}

impl Sight {
    /// Lets `seconds` pass on the way to another sight: smoothly, most of it in the first half second.
    pub fn approach(&mut self, wanted: Self, seconds: f64) {
        let part = 1.0 - (-HASTE * seconds).exp();
        self.eye = self.eye.lerp(wanted.eye, part);
        self.target = self.target.lerp(wanted.target, part);
    }
}

/// How an eye goes with somebody.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Chase {
    /// Drawn along at a fixed distance: it keeps the side it is on.
    Distance,
    /// At a fixed place beside it: it turns with it.
    Offset,
    /// With its own eyes.
    PointOfView,
    /// From straight above.
    Down,
}

impl Chase {
    /// Where the eye wants to be, `aside` radii away, if it is at `from` now.
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

/// Whom the eye of a film goes with, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Following {
    /// The agent's number. While it is not there, the eye stays where it is.
    pub number: u32,
    /// How.
    pub chase: Chase,
    /// How far away, in radii of the agent, greater than 0.
    pub aside: f64,
}
