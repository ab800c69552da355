//! Paints pictures of moments.

use crate::exposure::Exposure;
use crate::flow::Sheets;
use crate::insect::{self, Crowd};
use crate::legend::{Layout, Scale};
use crate::look::Look;
use crate::primitive::Primitive;
use crate::projector::Projector;
use crate::shape::Strides;
use crate::space::{Birds, People, SpaceScene};
use crate::text::Type;
use crate::trail::{AgentTrail, Brush, Trail, Trails};
use crate::vehicle::Vehicles;
use crate::{AgentShape, Annotation, Camera, Color, Error, Image, Projection, Style, annotate, place, raster};
use glam::{DVec2, DVec3, Vec2};
use std::collections::BTreeSet;
use throng::Obstacle;
use throng_record::{Body, Frame, Setting};

/// The distance between points of a trail, pixels.
const TRAIL_SPACING: f32 = 4.5;
/// The length of the trails of annotated agents, seconds.
const WAYS: f64 = 10.0;

/// The view of the world.
#[derive(Debug)]
enum Perspective {
    /// Plan view.
    Plan(Camera),
    /// In perspective.
    Space(Box<SpaceScene>),
}

/// Paints the moments of one recording in order.
///
/// It keeps everything constant as a finished picture, and keeps the positions of agents for their trails: call
/// [`paint`](Self::paint) or [`follow`](Self::follow) for every frame in order.
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
    view: Perspective,
    pub(crate) layout: Layout,
    pub(crate) look: Look,
    typeface: Type,
    pub(crate) trails: Trails,
    /// The positions of insects while the shutter was open.
    blur: Trails,
    /// The walked distances of agents with shapes.
    pub(crate) strides: Strides,
    /// Agents that are people, in perspective.
    pub(crate) people: People,
    /// Agents that are birds, in perspective.
    pub(crate) birds: Birds,
    /// Agents on wheels.
    pub(crate) vehicles: Vehicles,
    /// The trails of annotated agents.
    pub(crate) ways: Trails,
    /// The annotations that have been visible so far.
    seen: BTreeSet<Annotation>,
    /// The origin of the positions in traces.
    pub(crate) origin: DVec2,
    /// The constant parts below the agents: the ground; obstacles and goals.
    pub(crate) floor: Vec<Primitive>,
    pub(crate) place: Vec<Primitive>,
    /// The fields, between these two parts.
    pub(crate) flows: Option<Sheets>,
    /// The constant part of the legend, above the agents.
    legend: Vec<Primitive>,
    background: Image,
    image: Image,
    exposure: Exposure,
    /// The place and the first moment, both with the present obstacles.
    stage: (Setting, Frame),
    /// The obstacles at the start, once they have changed.
    start: Option<Vec<Obstacle>>,
}

impl Painter {
    /// Creates a painter for a recording that begins with `first`. If the style has no view, the view is fitted to that
    /// moment.
    ///
    /// # Errors
    /// [`Error::Size`] if the style's width or height is outside its limits.
    pub fn new(setting: &Setting, style: &Style, first: &Frame) -> Result<Self, Error> {
        let (width, height) = (style.width, style.height);
        Error::check_size(width, height)?;
        let layout = Layout::new(style);
        let (low, high) = layout.room(style.legend);
        let view = style.ground(setting, first);
        let look = Look::new(setting, style, first);
        let mut typeface = Type::of(&style.typeface);
        let base = if setting.walkable.is_empty() { style.theme.ground } else { style.theme.outside };
        let mut flows = None;
        let (view, floor, place, scale) = match style.projection(setting) {
            Projection::Plan => {
                let camera = Camera::fit(view, low, high);
                let floor = place::floor(setting, &style.theme, &camera, layout.unit);
                let place = place::marks(setting, style, &camera, layout.unit, first);
                let mut below = Image::new(width, height, base);
                raster::draw(&mut below, &mut typeface, &floor);
                flows = Sheets::new(setting, style, camera, &layout, &look, Some(below));
                (Perspective::Plan(camera), floor, place, Scale::Bar(camera.scale))
            }
            Projection::Perspective => {
                let stage = SpaceScene::new(setting, style, layout.unit, view, first, (low, high));
                let scale = stage.cell().map_or(Scale::None, Scale::Grid);
                (Perspective::Space(Box::new(stage)), Vec::new(), Vec::new(), scale)
            }
        };
        let legend = if style.legend { layout.fixed(setting, style, &look, scale, &typeface) } else { Vec::new() };
        let mut background = Image::new(width, height, base);
        raster::draw(&mut background, &mut typeface, &floor);
        raster::draw(&mut background, &mut typeface, &place);
        Ok(Self {
            style: style.clone(),
            base,
            view,
            layout,
            look,
            typeface,
            trails: Trails::default(),
            blur: Trails::default(),
            strides: Strides::default(),
            people: People::new(setting, style, first),
            birds: Birds::default(),
            vehicles: Vehicles::default(),
            ways: Trails::default(),
            seen: BTreeSet::new(),
            origin: setting.origin,
            floor,
            place,
            flows,
            legend,
            image: background.clone(),
            exposure: Exposure::default(),
            background,
            stage: (setting.clone(), first.clone()),
            start: None,
        })
    }

    /// Returns the pixel of a point of the world from the current viewpoint, counted from the upper left corner; `None`
    /// if the point is behind the viewpoint.
    pub fn pixel(&self, point: DVec3) -> Option<Vec2> {
        self.projector().pixel(point)
    }

    /// Returns the projection from the world to the picture.
    pub(crate) fn projector(&self) -> Projector {
        match &self.view {
            Perspective::Plan(camera) => Projector::Plan(*camera),
            Perspective::Space(stage) => Projector::Perspective(stage.lens),
        }
    }

    /// Returns the background colour.
    pub(crate) fn base(&self) -> Color {
        self.base
    }

    /// Takes the obstacles of a moment, if they are others than before.
    fn build(&mut self, frame: &Frame) {
        let (setting, first) = &mut self.stage;
        if first.obstacles == frame.obstacles {
            return;
        }
        let start = self.start.get_or_insert_with(|| setting.obstacles.clone());
        setting.obstacles = frame.obstacles.as_ref().map_or_else(|| start.clone(), |now| now.to_vec());
        first.obstacles.clone_from(&frame.obstacles);
        match &mut self.view {
            Perspective::Plan(camera) => {
                self.place = place::marks(setting, &self.style, camera, self.layout.unit, first);
                self.repaint();
            }
            Perspective::Space(stage) => stage.build(setting, &self.style),
        }
    }

    /// Adds the positions of a moment to the trails of later pictures, without painting.
    pub fn follow(&mut self, frame: &Frame) {
        let spacing = f64::from(TRAIL_SPACING * self.layout.unit);
        let spacing = match &mut self.view {
            Perspective::Plan(camera) => spacing / camera.scale,
            Perspective::Space(stage) => {
                stage.turn(frame);
                spacing / stage.scale()
            }
        };
        self.build(frame);
        self.look.see(frame);
        if let Some(flows) = &mut self.flows {
            flows.follow(frame);
        }
        let (look, wanted) = (&self.look, &self.style.annotations);
        let (color, ink) = (|body: &Body| look.color(body), |body: &Body| look.ink(body));
        let insect = |body: &Body| look.form(body) == AgentShape::Insect;
        self.trails.follow(frame, f64::from(self.style.trails), spacing, |body| (!insect(body)).then(|| ink(body)));
        if look.has(AgentShape::Insect) {
            self.blur
                .follow(frame, f64::from(self.style.shutter), 0.4 * spacing, |body| insect(body).then(|| color(body)));
        }
        if look.has_shapes() {
            self.strides.follow(frame);
            self.vehicles.follow(frame, look);
        }
        if matches!(self.view, Perspective::Space(_)) {
            self.people.follow(frame, look);
            self.birds.follow(frame, look);
        }
        if wanted.kinds.contains(&Annotation::Trails) {
            self.ways.follow(frame, WAYS, spacing, |body| wanted.concern(body).then(|| ink(body)));
        }
        self.seen.extend(wanted.in_frame(frame));
    }

    /// Updates the visible fields to a moment.
    pub(crate) fn settle(&mut self, frame: &Frame) {
        if self.flows.as_mut().is_some_and(|flows| flows.turn(frame)) {
            self.repaint();
        }
    }

    /// Paints the constant place again.
    fn repaint(&mut self) {
        self.background.clear(self.base);
        let fields = self.flows.as_ref().map(|flows| &flows.marks);
        for marks in [Some(&self.floor), fields, Some(&self.place)].into_iter().flatten() {
            raster::draw(&mut self.background, &mut self.typeface, marks);
        }
    }

    /// Paints a moment.
    pub fn paint(&mut self, frame: &Frame) -> &Image {
        self.follow(frame);
        self.settle(frame);
        self.image.copy_from(&self.background);
        for (_, marks) in self.moment(frame) {
            raster::draw(&mut self.image, &mut self.typeface, &marks);
        }
        &self.image
    }

    /// Exposes the picture to a moment: adds it to the picture that [`develop`](Self::develop) returns.
    pub(crate) fn expose(&mut self, frame: &Frame) {
        self.follow(frame);
        self.settle(frame);
        self.image.copy_from(&self.background);
        for (_, marks) in self.world(frame) {
            raster::draw(&mut self.image, &mut self.typeface, &marks);
        }
        self.exposure.add(&self.image);
    }

    /// Paints the mean of the moments to which the picture has been exposed, with the legend of `frame`.
    pub(crate) fn develop(&mut self, frame: &Frame) -> &Image {
        self.exposure.develop(&mut self.image);
        let legend = self.legend(frame);
        raster::draw(&mut self.image, &mut self.typeface, &legend);
        &self.image
    }

    /// Returns the last painted picture.
    pub(crate) fn image(&self) -> &Image {
        &self.image
    }

    /// Returns everything above the constant place at a moment, in named parts.
    pub(crate) fn moment(&self, frame: &Frame) -> Vec<(&'static str, Vec<Primitive>)> {
        let mut parts = self.world(frame);
        parts.push(("legend", self.legend(frame)));
        parts
    }

    /// Returns everything above the constant place at a moment except the legend, in named parts.
    fn world(&self, frame: &Frame) -> Vec<(&'static str, Vec<Primitive>)> {
        let mut parts = match &self.view {
            Perspective::Plan(camera) => self.plan(camera, frame),
            Perspective::Space(stage) => self.scene(stage, frame),
        };
        parts.push(("annotations", self.annotations(frame)));
        parts
    }

    /// Returns the legend at a moment.
    fn legend(&self, frame: &Frame) -> Vec<Primitive> {
        let mut legend = self.legend.clone();
        if self.style.legend {
            let seen: Vec<Annotation> = self.seen.iter().copied().collect();
            let mut rows = annotate::rows(&seen, &self.style, self.layout.key_size());
            rows.extend(self.flows.iter().flat_map(|flows| flows.rows(self.layout.key_size())));
            legend.extend(self.layout.key(&rows, &self.style, &self.typeface));
            legend.extend(self.layout.moment(frame, &self.style, &self.typeface));
        }
        legend
    }

    /// Returns how a moment's insects are drawn.
    pub(crate) fn crowd(&self, frame: &Frame) -> Crowd {
        let insects = frame.bodies.iter().filter(|body| self.look.form(body) == AgentShape::Insect);
        Crowd::of(insects.count(), self.layout.unit)
    }

    /// Returns the streaks of insects at a time.
    pub(crate) fn streaks<'a>(&self, insects: impl Iterator<Item = &'a Body>, time: f64, crowd: Crowd) -> Vec<Trail> {
        let (projector, seconds) = (self.projector(), f64::from(self.style.shutter));
        // Without exposure time (0 or NaN) there are no streaks.
        if seconds.is_nan() || seconds <= 0.0 {
            return Vec::new();
        }
        let streak = |body: &Body| {
            let track = self.blur.tracks.get(&body.number)?;
            insect::streak(track, body, self.look.coat(body).fill, &projector, (time, seconds), crowd)
        };
        insects.filter_map(streak).collect()
    }

    /// Returns the trails at a time.
    pub(crate) fn trails(&self, now: f64) -> Vec<Trail> {
        let brush = Brush { projector: self.projector(), seconds: f64::from(self.style.trails) };
        let color = |track: &AgentTrail| track.color.unwrap_or(self.style.theme.goal);
        self.trails.tracks.values().flat_map(|track| brush.trails(track, color(track), now)).collect()
    }
}
