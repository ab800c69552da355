//! Fields that lead crowds, under everything that stands or walks: as a texture, as colour, as lines and arrows, and where they
//! come from and what traps who follows them.

mod anchors;
mod arrows;
mod blade;
mod critical;
mod grid;
mod key;
mod marks;
mod mask;
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

/// One of the ways in which a field can be shown, in the order in which they lie over each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FlowLayer {
    /// How fast it is, as a tone that deepens with the speed.
    Speed,
    /// A texture as of sand that it has drawn out (line integral convolution: Cabral and Leedom, Imaging vector fields using line
    /// integral convolution, SIGGRAPH 1993).
    Lic,
    /// Lines that follow it, evenly far apart (Jobard and Lefer, Creating evenly-spaced streamlines of arbitrary density, 1997).
    Streamlines,
    /// Arrows on an even grid, the longer the faster it is.
    Arrows,
    /// What it was sketched by: dots, with the velocities wanted there.
    Anchors,
    /// Where it is zero though it flows round it, by what it does there; those that trap who follows it in a warning tone.
    Critical,
}

impl FlowLayer {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Speed, Self::Lic, Self::Streamlines, Self::Arrows, Self::Anchors, Self::Critical];

    /// What it is called in files and on the command line.
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

/// How fields ([`throng_record::Setting::flows`]) are drawn, from straight above. The default is a quiet texture with streamlines,
/// anchors and critical points.
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
    /// What is drawn; the order does not matter.
    pub layers: Vec<FlowLayer>,
    /// How far apart streamlines and arrows are: 1 as usual, 2 twice as far. What is out of 0.25 to 16 is taken for the nearer
    /// of the two.
    pub spacing: f32,
    /// How strong texture and tones are: 1 as usual, 0 not to be seen, at most 2.
    pub strength: f32,
    /// The speed at which tones are deepest and arrows longest, m/s; `None`, or not greater than 0: that which the fields exceed
    /// in a fiftieth of the picture, at the first moment at which they flow.
    pub max_speed: Option<f32>,
}

impl Default for FlowStyle {
    fn default() -> Self {
        let layers = vec![FlowLayer::Lic, FlowLayer::Streamlines, FlowLayer::Anchors, FlowLayer::Critical];
        Self { layers, spacing: 1.0, strength: 1.0, max_speed: None }
    }
}

impl FlowStyle {
    /// With other layers.
    pub fn of(layers: impl Into<Vec<FlowLayer>>) -> Self {
        Self { layers: layers.into(), ..Self::default() }
    }

    /// The tone of a speed over the fastest, 0 to 1.
    pub fn tone(part: f32, theme: &Theme) -> Color {
        speed::tone(part, theme)
    }

    fn draws(&self, layer: FlowLayer) -> bool {
        self.layers.contains(&layer)
    }

    /// How far apart things are, over the usual.
    fn spread(&self) -> f32 {
        // what is no number too is as usual
        if self.spacing.is_nan() { 1.0 } else { self.spacing.clamp(0.25, 16.0) }
    }

    fn strength(&self) -> f32 {
        if self.strength.is_nan() { 1.0 } else { self.strength.clamp(0.0, 2.0) }
    }
}

/// What the fields of a picture are drawn on.
#[derive(Clone, Debug)]
struct Canvas {
    camera: Camera,
    /// What places in fields are relative to.
    origin: DVec2,
    /// Width and height, pixels.
    size: Vec2,
    unit: f32,
    /// Where they are to be seen.
    free: Mask,
}

impl Canvas {
    /// The pixel of a place relative to the origin.
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
    /// Which of how many fields it is: they make room for each other.
    turn: (usize, usize),
}

impl Lay<'_> {
    /// What is slower than this part of the fastest is not drawn: fields that fade never end.
    const STILL: f32 = 0.02;

    /// The flow at a pixel, m/s along the rows and down the columns of the picture; zero where it is not drawn.
    fn flow(&self, pixel: Vec2) -> Vec2 {
        let flow = self.grid.at(pixel);
        let drawn = flow.length_squared() > (Self::STILL * self.fastest).powi(2) && self.canvas.free.at(pixel);
        if drawn { flow } else { Vec2::ZERO }
    }

    /// How fast a flow is, over the fastest: 0 to 1.
    fn part(&self, flow: Vec2) -> f32 {
        (flow.length() / self.fastest).min(1.0)
    }

    /// How much of a flow there is to be seen, 0 to 1: what is slow fades away.
    fn presence(&self, flow: Vec2) -> f32 {
        /// From here on all of it.
        const WHOLE: f32 = 0.22;
        let t = ((self.part(flow) - Self::STILL) / (WHOLE - Self::STILL)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }
}

/// A part of a turn, or any other number in [0, 1), that is as good as drawn by lot, for a cell (Wang and Jenkins' way: the
/// finaliser of MurmurHash3).
pub(crate) fn lot(column: u32, row: u32) -> f32 {
    let mut z = column.wrapping_mul(0x9e37_79b1) ^ row.wrapping_mul(0x85eb_ca77).rotate_left(15);
    z = (z ^ (z >> 16)).wrapping_mul(0x85eb_ca6b);
    z = (z ^ (z >> 13)).wrapping_mul(0xc2b2_ae35);
    ((z ^ (z >> 16)) >> 8) as f32 / 16_777_216.0
}
