//! Fields as primitives, for other renderers.

use super::Sheets;
use crate::legend::Layout;
use crate::look::Look;
use crate::primitive::Primitive;
use crate::{Camera, Style, WorldBox};
use glam::Vec2;
use throng_record::{Frame, Setting};

/// The fields of a place at one moment, as primitives of a picture in plan view.
///
/// ```
/// use glam::{DVec2, Vec3};
/// use std::sync::Arc;
/// use throng_draw::{FlowLayer, FlowMarks, FlowStyle, Style, WorldBox};
/// use throng_record::{Flow, Frame, Setting};
/// let whirl = |place: Vec3, _: f64| Vec3::Z.cross(place);
/// let setting = Setting { flows: vec![Flow::of(Arc::new(whirl))], ..Setting::default() };
/// let view = Some(WorldBox { min: DVec2::splat(-5.0), max: DVec2::splat(5.0) });
/// let style = Style { flow: Some(FlowStyle::of([FlowLayer::Arrows])), view, ..Style::default() };
/// let drawn = FlowMarks::new(&setting, &style, &Frame::default(), &Frame::default()).unwrap();
/// assert!(drawn.marks.len() > 50 && drawn.fastest.unwrap() > 5.0);
/// ```
#[derive(Clone, Debug)]
pub struct FlowMarks {
    /// Primitives in pixels of a picture of the style's size.
    pub marks: Vec<Primitive>,
    /// The camera of that picture; the style's [`view`](Style::view) fills the picture.
    pub camera: Camera,
    /// The speed that is drawn as the fastest, m/s; `None` without any flow.
    pub fastest: Option<f32>,
}

impl FlowMarks {
    /// Returns the fields at the moment `now` as a picture in this style shows them, for a recording that begins with
    /// `first`. The opacity of primitives of several fields falls with the distance from the agents of their groups.
    /// Returns `None` if there are no fields or the style does not draw them.
    pub fn new(setting: &Setting, style: &Style, first: &Frame, now: &Frame) -> Option<Self> {
        let view = style.view.or_else(|| WorldBox::of(setting, first))?;
        let camera = Camera::fit(view, Vec2::ZERO, Vec2::new(style.width as f32, style.height as f32));
        let look = Look::new(setting, style, first);
        let mut sheets = Sheets::new(setting, style, camera, &Layout::new(style), &look, None)?;
        sheets.follow(now);
        sheets.turn(now);
        Some(Self { fastest: sheets.fastest(), marks: sheets.marks, camera })
    }
}
