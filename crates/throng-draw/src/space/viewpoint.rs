//! The viewpoint of pictures in perspective, and how it moves.

use super::Following;
use glam::DVec3;

/// The viewpoint of a picture in perspective.
#[derive(Clone, Debug, PartialEq)]
pub struct Viewpoint {
    /// The position at the start, metres; `None` for a place slightly above all agents, from which they fill the
    /// picture.
    pub eye: Option<DVec3>,
    /// The point in the middle of the picture at the start; `None` for the middle of the scene.
    pub target: Option<DVec3>,
    /// The vertical field of view, degrees, greater than 0 and less than 180.
    pub field_of_view: f64,
    /// How it moves.
    pub motion: Motion,
}

impl Default for Viewpoint {
    fn default() -> Self {
        Self { eye: None, target: None, field_of_view: 35.0, motion: Motion::Still }
    }
}

/// How a viewpoint moves during a film.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Motion {
    /// It stays where it is.
    #[default]
    Still,
    /// It turns around its target, degrees per second, counter-clockwise from above.
    Orbit(f64),
    /// It follows an agent. The film begins at the position to which following leads from [`Viewpoint::eye`].
    Follow(Following),
    /// It moves with the agent of this number, and keeps its direction and its distance. It lags behind, so a fast agent is
    /// ahead in the picture.
    Beside(u32),
    /// It keeps its direction, and moves so that the agents on the ground fill the picture. When an agent is moved
    /// elsewhere, out of the picture, the film cuts to where all agents are.
    Crowd,
    /// It moves through keys, in the order of their times. Without keys it stays where it is.
    Keys(Vec<CameraKey>),
}

/// A viewpoint at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraKey {
    /// The time, seconds.
    pub time: f64,
    /// The position, metres.
    pub eye: DVec3,
    /// The point in the middle of the picture, metres.
    pub target: DVec3,
    /// The vertical field of view, degrees, greater than 0 and less than 180; `None` for that of the viewpoint.
    pub field_of_view: Option<f64>,
    /// Whether the film cuts to this key at its time; otherwise the viewpoint moves to it from the key before.
    pub cut: bool,
}
