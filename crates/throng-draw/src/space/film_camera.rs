//! The camera of films in perspective, for other renderers.

use super::Sight;
use super::extent::Extent;
use super::rig::Rig;
use crate::{Projection, Style, WorldBox};
use glam::{DVec2, Vec2};
use throng_record::{Frame, Setting};

/// The margin of the picture, pixels.
const MARGIN: f32 = 28.0;

/// The camera of a film in perspective, with its motion.
///
/// ```
/// use throng_draw::{FilmCamera, Motion, Projection, Style, Viewpoint};
/// use throng_record::{Frame, Setting};
/// let viewpoint = Viewpoint { motion: Motion::Orbit(90.0), ..Viewpoint::default() };
/// let style = Style { projection: Some(Projection::Perspective), viewpoint, ..Style::default() };
/// let mut camera = FilmCamera::new(&Setting::default(), &style, &Frame::default()).unwrap();
/// let [first, later] = [0.0, 2.0].map(|time| camera.turn(&Frame { time, ..Frame::default() }).0.eye);
/// assert!((first.x + later.x).abs() < 1e-9, "on the other side after two seconds");
/// ```
#[derive(Clone, Debug)]
pub struct FilmCamera {
    rig: Rig,
}

impl FilmCamera {
    /// Returns the camera of a film in this style that begins with `first`; `None` if the film is in plan view.
    pub fn new(setting: &Setting, style: &Style, first: &Frame) -> Option<Self> {
        if style.projection(setting) == Projection::Plan {
            return None;
        }
        let view = style.ground(setting, first);
        let extent = Extent::of(view, style.view.is_some(), setting, first);
        let size = Vec2::new(style.width as f32, style.height as f32);
        let margin = Vec2::splat(MARGIN).min(size * 0.1);
        Some(Self { rig: Rig::new(&style.viewpoint, &extent, style.height, (margin, size - margin)) })
    }

    /// Whether the camera stays where it is.
    pub fn is_still(&self) -> bool {
        self.rig.is_still()
    }

    /// Moves the camera to its place at the time of a frame. Returns it with the vertical field of view, degrees.
    pub fn turn(&mut self, frame: &Frame) -> (Sight, f64) {
        self.rig.sight(frame)
    }
}

impl Style {
    /// Returns the projection of pictures of a place: perspective if agents fly, unless the style says otherwise.
    pub fn projection(&self, setting: &Setting) -> Projection {
        let usual = if setting.in_space { Projection::Perspective } else { Projection::Plan };
        self.projection.unwrap_or(usual)
    }

    /// Returns the part of the ground that pictures show.
    pub(crate) fn ground(&self, setting: &Setting, first: &Frame) -> WorldBox {
        let everything = WorldBox { min: DVec2::splat(-5.0), max: DVec2::splat(5.0) };
        // A single agent is not enlarged to fill the picture.
        self.view.unwrap_or_else(|| WorldBox::of(setting, first).unwrap_or(everything).at_least(4.0))
    }
}
