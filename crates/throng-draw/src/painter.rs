//! Pictures of moments.

use crate::legend::Layout;
use crate::look::Look;
use crate::mark::Mark;
use crate::rounded::{NOTCH_LEAST_RADIUS, Rounded};
use crate::text::Type;
use crate::trail::{End, Track, TrailLayer, Trails, freshness};
use crate::{Camera, Color, Error, Image, Style, WorldBox, place, raster};
use glam::{DVec2, Vec2};
use throng_record::{Body, Frame, Setting};

/// Opacity of a trail where it leaves the agent.
const TRAIL_OPACITY: f32 = 0.5;
/// Half the width of a trail there, in radii of the body.
const TRAIL_HALF_WIDTH: f32 = 0.42;
/// Points of a trail are this far apart, pixels.
const TRAIL_SPACING: f32 = 4.5;
/// The least radius an agent is drawn with, pixels.
const LEAST_RADIUS: f32 = 1.5;
/// How far aside, along both axes, a shadow lies, in altitudes; and its opacity.
const SHADOW: f32 = 0.12;
const SHADOW_OPACITY: f32 = 0.13;

/// Paints the moments of one recording, one after the other.
///
/// It keeps what does not change as a finished picture, and remembers where agents have been, for their trails:
/// [`paint`](Self::paint) or [`follow`](Self::follow) every frame in order.
///
/// ```
/// use throng_draw::{Painter, Style};
/// use throng_record::{Frame, Setting};
/// let (setting, frame) = (Setting::default(), Frame::default());
/// let mut painter = Painter::new(&setting, &Style::default(), &frame)?;
/// let image = painter.paint(&frame);
/// assert_eq!((image.width(), image.height()), (640, 480));
/// # Ok::<(), throng_draw::Error>(())
/// ```
#[derive(Debug)]
pub struct Painter {
    pub(crate) style: Style,
    base: Color,
    pub(crate) camera: Camera,
    pub(crate) layout: Layout,
    pub(crate) look: Look,
    pub(crate) typeface: Type,
    pub(crate) trails: Trails,
    /// Ground, obstacles and goals, below the agents.
    pub(crate) place: Vec<Mark>,
    /// What the legend always says, above the agents.
    pub(crate) legend: Vec<Mark>,
    background: Image,
    layer: TrailLayer,
    image: Image,
}

impl Painter {
    /// A painter for a recording that begins with `first`, which the view is fitted to if the style names none.
    ///
    /// # Errors
    /// [`Error::Size`] if the style's width or height is out of its limits.
    pub fn new(setting: &Setting, style: &Style, first: &Frame) -> Result<Self, Error> {
        let (width, height) = (style.width, style.height);
        Error::check_size(width, height)?;
        let layout = Layout::new(style);
        let (low, high) = layout.room(style.legend);
        let everything = WorldBox { min: DVec2::splat(-5.0), max: DVec2::splat(5.0) };
        let view = style.view.or_else(|| WorldBox::of(setting, first)).unwrap_or(everything);
        // A single agent is not blown up to fill the picture.
        let view = if style.view.is_some() { view } else { view.at_least(4.0) };
        let camera = Camera::fit(view, low, high);
        let look = Look::new(setting, style, first);
        let mut typeface = Type::new();
        let place = place::marks(setting, style, &camera, layout.unit, first);
        let legend = if style.legend { layout.fixed(setting, style, &look, &camera, &typeface) } else { Vec::new() };
        let base = if setting.walkable.is_empty() { style.theme.ground } else { style.theme.outside };
        let mut background = Image::new(width, height, base);
        raster::draw(&mut background, &mut typeface, &place);
        Ok(Self {
            style: style.clone(),
            base,
            camera,
            layout,
            look,
            typeface,
            trails: Trails::default(),
            place,
            legend,
            image: background.clone(),
            background,
            layer: TrailLayer::new(width, height),
        })
    }

    /// From metres to pixels.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The colour under everything.
    pub(crate) fn base(&self) -> Color {
        self.base
    }

    /// Remembers where everybody is without painting, for trails in later pictures.
    pub fn follow(&mut self, frame: &Frame) {
        let spacing = f64::from(TRAIL_SPACING * self.layout.unit) / self.camera.scale;
        let look = &self.look;
        self.trails.follow(frame, f64::from(self.style.trails), spacing, |k| look.color(&frame.bodies[k]));
    }

    /// Paints a moment.
    pub fn paint(&mut self, frame: &Frame) -> &Image {
        self.follow(frame);
        self.image.copy_from(&self.background);
        let brush = self.brush();
        for track in self.trails.tracks.values() {
            let color = track.color.unwrap_or(self.style.theme.goal);
            let mut pieces = brush.pieces(track, frame.time);
            if let Some(mut from) = pieces.next() {
                for to in pieces {
                    self.layer.piece(from, to, color);
                    from = to;
                }
            }
        }
        self.layer.lay(&mut self.image);
        let bodies = stacked(frame);
        let shadows: Vec<Mark> = bodies.iter().filter_map(|body| self.shadow(body)).collect();
        raster::draw(&mut self.image, &mut self.typeface, &shadows);
        for body in bodies {
            self.rounded(body).draw(&mut self.image);
        }
        raster::draw(&mut self.image, &mut self.typeface, &self.legend);
        if self.style.legend {
            let moment = self.layout.moment(frame, &self.style, &self.typeface);
            raster::draw(&mut self.image, &mut self.typeface, &moment);
        }
        &self.image
    }

    /// What was painted last.
    pub(crate) fn image(&self) -> &Image {
        &self.image
    }

    /// How trails are drawn.
    pub(crate) fn brush(&self) -> Brush {
        Brush { camera: self.camera, seconds: f64::from(self.style.trails) }
    }

    /// The shadow of who is in the air, on the ground: the farther off, the higher.
    pub(crate) fn shadow(&self, body: &Body) -> Option<Mark> {
        let off = SHADOW * body.altitude * self.camera.scale as f32;
        let radius = self.camera.length(f64::from(body.radius)).max(LEAST_RADIUS);
        let center = self.camera.pixel(body.position) + Vec2::new(off, off);
        let fill = Color::rgb(0).alpha(SHADOW_OPACITY);
        (body.altitude > 0.0 && center.is_finite()).then_some(Mark::Disc { center, radius, fill })
    }

    /// How an agent is drawn.
    pub(crate) fn rounded(&self, body: &Body) -> Rounded {
        let coat = self.look.coat(body);
        let radius = self.camera.length(f64::from(body.radius)).max(LEAST_RADIUS);
        let core = body.core.as_dvec2() * self.camera.scale;
        let girth = radius + core.min_element() as f32;
        let notch = self.style.headings && girth >= NOTCH_LEAST_RADIUS;
        let notch = notch.then(|| self.style.theme.notch.alpha(0.92));
        let (sin, cos) = body.heading.sin_cos();
        let rim_width = if body.status == throng::Status::Stranded { 0.34 * girth } else { 0.13 * girth };
        Rounded {
            center: self.camera.pixel(body.position),
            core: core.as_vec2(),
            // Up in the world is down in the rows of a picture.
            along: Vec2::new(cos, -sin),
            radius,
            fill: coat.fill,
            // The edge of a small disc would take its colour away.
            rim: coat.fill.mix(coat.rim, (0.4 * (girth - 1.2)).clamp(0.0, 1.0)),
            rim_width: rim_width.clamp(0.6, 3.0 * self.layout.unit),
            notch,
        }
    }
}

/// Everybody, the lower first, of those at one altitude by number.
pub(crate) fn stacked(frame: &Frame) -> Vec<&Body> {
    let mut bodies: Vec<&Body> = frame.bodies.iter().collect();
    bodies.sort_by(|a, b| a.altitude.total_cmp(&b.altitude));
    bodies
}

/// What it takes to draw a trail.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Brush {
    camera: Camera,
    seconds: f64,
}

impl Brush {
    /// The points of a trail, oldest first.
    pub(crate) fn pieces(self, track: &Track, now: f64) -> impl Iterator<Item = End> {
        let half = (self.camera.length(f64::from(track.radius)) * TRAIL_HALF_WIDTH).max(0.6);
        track.points.iter().map(move |&(time, point)| {
            let fresh = freshness(now - time, self.seconds);
            End { at: self.camera.pixel(point), half: half * (0.35 + 0.65 * fresh), opacity: TRAIL_OPACITY * fresh }
        })
    }
}
