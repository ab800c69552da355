//! Fields that lead crowds, drawn below everything else: as a texture, as colour, as lines and arrows, with their
//! anchors and critical points.

mod anchors;
mod arrows;
mod blade;
mod critical;
mod grid;
mod key;
mod marks;
mod mask;
mod shares;
mod sheets;
mod speed;
mod streamlines;
mod texture;

pub use marks::FlowMarks;
pub(crate) use sheets::Sheets;

use crate::{Camera, Color, Theme};
use glam::{DVec2, Vec2};
use grid::Grid;
use mask::Mask;

/// A layer of fields, in drawing order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FlowLayer {
    /// The speed, as a tone that deepens with the speed.
    Speed,
    /// A texture of noise smeared along the field (line integral convolution: Cabral and Leedom, Imaging vector fields
    /// using line integral convolution, SIGGRAPH 1993).
    Lic,
    /// Evenly spaced streamlines (Jobard and Lefer, Creating evenly-spaced streamlines of arbitrary density, 1997).
    Streamlines,
    /// Arrows on a regular grid; their lengths grow with the speed.
    Arrows,
    /// The anchors of a sketched field: dots with their velocities.
    Anchors,
    /// Critical points, by their kind. Points that trap agents have a warning colour.
    Critical,
}

impl FlowLayer {
    /// All layers.
    pub const ALL: [Self; 6] = [Self::Speed, Self::Lic, Self::Streamlines, Self::Arrows, Self::Anchors, Self::Critical];

    /// Returns the name in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::Lic => "lic",
            Self::Streamlines => "streamlines",
            Self::Arrows => "arrows",
            Self::Anchors => "anchors",
            Self::Critical => "critical",
        }
    }
}

/// The style of fields ([`throng_record::Setting::flows`]), which are drawn in plan view. The default is a pale texture
/// with streamlines, anchors and critical points.
///
/// ```
/// use glam::Vec3;
/// use std::sync::Arc;
/// use throng_draw::{FlowLayer, FlowStyle, Painter, Style};
/// use throng_record::{Flow, Frame, Setting};
/// let whirl = |place: Vec3, _: f64| Vec3::Z.cross(place);
/// let setting = Setting { flows: vec![Flow { still: true, ..Flow::of(Arc::new(whirl)) }], ..Setting::default() };
/// let flow = FlowStyle { layers: vec![FlowLayer::Speed, FlowLayer::Arrows], ..FlowStyle::default() };
/// let style = Style { flow: Some(flow), ..Style::default() };
/// let frame = Frame::default();
/// let bare = Painter::new(&setting, &Style::default(), &frame)?.paint(&frame).clone();
/// assert_ne!(Painter::new(&setting, &style, &frame)?.paint(&frame), &bare);
/// # Ok::<(), throng_draw::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FlowStyle {
    /// The layers; their order does not matter.
    pub layers: Vec<FlowLayer>,
    /// The spacing of streamlines and arrows, relative to the default: 2 is twice as far. Clamped to 0.25 to 16.
    pub spacing: f32,
    /// The strength of texture and tones: 1 is the default, 0 makes them invisible. Clamped to 0 to 2.
    pub strength: f32,
    /// The speed at which tones are deepest and arrows longest, m/s. `None`, or a value not greater than 0, stands for
    /// the speed that the fields exceed in 2 % of the picture at the first moment with any flow.
    pub max_speed: Option<f32>,
}

impl Default for FlowStyle {
    fn default() -> Self {
        let layers = vec![FlowLayer::Lic, FlowLayer::Streamlines, FlowLayer::Anchors, FlowLayer::Critical];
        Self { layers, spacing: 1.0, strength: 1.0, max_speed: None }
    }
}

impl FlowStyle {
    /// Returns the default style with other layers.
    pub fn of(layers: impl Into<Vec<FlowLayer>>) -> Self {
        Self { layers: layers.into(), ..Self::default() }
    }

    /// Returns the tone of a speed relative to the fastest, 0 to 1.
    pub fn tone(part: f32, theme: &Theme) -> Color {
        speed::tone(part, theme)
    }

    fn draws(&self, layer: FlowLayer) -> bool {
        self.layers.contains(&layer)
    }

    /// Returns the spacing relative to the default.
    fn spread(&self) -> f32 {
        // NaN stands for the default.
        if self.spacing.is_nan() { 1.0 } else { self.spacing.clamp(0.25, 16.0) }
    }

    fn strength(&self) -> f32 {
        if self.strength.is_nan() { 1.0 } else { self.strength.clamp(0.0, 2.0) }
    }
}

/// The canvas of fields: camera, size and mask.
#[derive(Clone, Debug)]
struct Canvas {
    camera: Camera,
    /// The origin of positions in fields.
    origin: DVec2,
    /// Width and height, pixels.
    size: Vec2,
    unit: f32,
    /// The pixels where fields are visible.
    free: Mask,
}

impl Canvas {
    /// Returns the pixel of a position relative to the origin.
    fn pixel(&self, place: DVec2) -> Vec2 {
        self.camera.pixel(self.origin + place)
    }

    fn shows(&self, pixel: Vec2) -> bool {
        pixel.cmpge(Vec2::ZERO).all() && pixel.cmple(self.size).all()
    }
}

/// One field at one moment, ready to be drawn.
#[derive(Clone, Copy, Debug)]
struct Lay<'a> {
    grid: &'a Grid,
    canvas: &'a Canvas,
    style: &'a FlowStyle,
    theme: &'a Theme,
    /// The colour of its lines.
    ink: Color,
    /// The speed that is drawn as the fastest, m/s.
    fastest: f32,
    /// The index of this field and the number of fields, which share the space.
    turn: (usize, usize),
    /// The length of the pieces into which streamlines are cut, pixels; `None` for whole lines.
    cut: Option<f32>,
}

impl Lay<'_> {
    /// The share of the fastest speed below which a field is not drawn: fields that fade out have no end.
    const STILL: f32 = 0.02;

    /// Returns the flow at a pixel, m/s along the rows and down the columns of the picture; zero where it is not drawn.
    fn flow(&self, pixel: Vec2) -> Vec2 {
        let flow = self.grid.at(pixel);
        let drawn = flow.length_squared() > (Self::STILL * self.fastest).powi(2) && self.canvas.free.at(pixel);
        if drawn { flow } else { Vec2::ZERO }
    }

    /// Returns the speed of a flow relative to the fastest, 0 to 1.
    fn part(&self, flow: Vec2) -> f32 {
        (flow.length() / self.fastest).min(1.0)
    }

    /// Returns the opacity of a flow, 0 to 1: slow flow fades out.
    fn presence(&self, flow: Vec2) -> f32 {
        /// The relative speed from which on the flow is opaque.
        const WHOLE: f32 = 0.22;
        let t = ((self.part(flow) - Self::STILL) / (WHOLE - Self::STILL)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }
}

/// Returns the colour of a single field, which is neutral.
pub(crate) fn alone(theme: &Theme) -> Color {
    theme.goal.mix(theme.text, 0.45)
}

/// Returns the colour of streamlines of a field in a colour: translucent where that is clear of the ground; colours near
/// that of the ground are nearly opaque, and darker on light ground as little as they need, so that they keep their hue.
pub(crate) fn line(ink: Color, theme: &Theme) -> Color {
    /// The opacity of such colours.
    const DENSE: f32 = 0.92;
    let grounds = [theme.ground, theme.outside];
    let legible = |opacity: f32| ink.alpha(opacity).legible(&grounds, theme.text.alpha(opacity), Theme::MARKS);
    let thin = ink.alpha(streamlines::OPACITY);
    if legible(streamlines::OPACITY) == thin { thin } else { legible(DENSE) }
}

/// Returns the colour of points that trap agents.
#[cfg(test)]
pub(crate) fn warning(theme: &Theme) -> Color {
    critical::WARNING[usize::from(theme.is_dark())]
}

/// Returns a pseudorandom number in [0, 1) for a cell, by the finaliser of MurmurHash3.
pub(crate) fn lot(column: u32, row: u32) -> f32 {
    let mut z = column.wrapping_mul(0x9e37_79b1) ^ row.wrapping_mul(0x85eb_ca77).rotate_left(15);
    z = (z ^ (z >> 16)).wrapping_mul(0x85eb_ca6b);
    z = (z ^ (z >> 13)).wrapping_mul(0xc2b2_ae35);
    ((z ^ (z >> 16)) >> 8) as f32 / 16_777_216.0
}
