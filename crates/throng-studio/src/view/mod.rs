//! The view: the world as it is now, through an eye that people move.

mod colors;
mod crowd;
mod eye;
mod geometry;
mod gl;
mod mode;
mod scenery;
mod shape;
mod thoughts;

pub use colors::Coloring;
pub use eye::{Eye, ground};
pub use mode::Mode;
pub use shape::{Marks, Shape};

use crate::play::Shown;
use crate::settings::Settings;
use crowd::Crowd;
use eframe::egui::{self, PointerButton, Rect, Response, Sense, Ui};
use eframe::{egui_glow, glow};
use geometry::{Disc, Geometry};
use gl::{Canvas, Lighting};
use glam::{DVec3, Vec2};
use std::sync::{Arc, Mutex, PoisonError};
use throng_draw::{Annotation, Annotations, Color, Followed, Form, Projection, Projector, Style, Theme};
use throng_record::{Body, Frame};

/// How near to an agent one must point, points of the screen beyond its edge.
const REACH: f32 = 12.0;
/// How high the air is that flocks are seen in, at least, metres.
const HEADROOM: f64 = 1.8;

/// What can be seen, and how.
#[derive(Default)]
pub struct View {
    /// Where one looks from.
    pub eye: Eye,
    /// Whether the first button of the mouse does something else than to move the eye and to select.
    pub lent: bool,
    /// The agent that is selected, by number.
    pub selected: Option<u32>,
    hovered: Option<u32>,
    /// The scene that the eye was fitted to.
    fitted: Option<Arc<str>>,
    scenery: Option<Scenery>,
    crowd: Crowd,
    canvas: Shared,
}

/// Canvas, or why there is none: made where OpenGL is at hand.
type Shared = Arc<Mutex<Option<Result<Canvas, String>>>>;

/// What does not change in a run.
struct Scenery {
    run: u64,
    dark: bool,
    floor: Arc<Geometry>,
    place: Arc<Geometry>,
    solids: Arc<Geometry>,
}

impl View {
    /// Shows a moment in all of the room there is, and lets people move the eye and select an agent.
    pub fn ui(&mut self, ui: &mut Ui, shown: &Shown, settings: &Settings) -> Response {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        let size = Vec2::new(rect.width(), rect.height()).max(Vec2::ONE);
        if self.fitted.as_ref() != Some(&shown.name) {
            self.open(shown, size);
        }
        let share = shown.share();
        self.handle(ui, &response, rect, size);
        let body = self.selected.and_then(|number| between(shown, number, share));
        self.eye.settle(body.as_ref().map(Followed::from), f64::from(ui.input(|input| input.stable_dt.min(0.1))));
        let projector = self.eye.projector(size);
        let pointer = response.hover_pos().map(|at| Vec2::new(at.x - rect.min.x, at.y - rect.min.y));
        self.hovered = pointer.and_then(|at| nearest(shown, &projector, at, share));
        if response.clicked() && !self.lent {
            self.selected = self.hovered;
        }
        if response.double_clicked() && !self.lent && self.hovered.is_none() {
            self.fit(shown, size);
        }
        self.paint(ui, rect, shown, settings, &projector, share);
        if shown.playing || self.eye.moves() {
            ui.ctx().request_repaint();
        }
        response
    }

    /// Sees everything again.
    pub fn fit(&mut self, shown: &Shown, size: Vec2) {
        let tops = shown.first.bodies.iter().map(|body| f64::from(body.altitude + body.radius));
        let height = tops.fold(HEADROOM, f64::max);
        self.eye.fit(shown.bounds, if shown.setting.in_space { height } else { 0.0 }, size);
    }

    /// What a film looks like that shows what this view shows, where it is so many points of the screen large.
    pub fn style(&self, shown: &Shown, settings: &Settings, size: Vec2) -> Style {
        let (plan, selected) = (self.eye.mode() == Mode::Plan, self.selected);
        let coloring = settings.coloring.style(shown, &settings.theme());
        let form = match settings.marks {
            Marks::Fitting => None,
            Marks::All(Shape::Insect) => Some(Form::Insect),
            Marks::Discs | Marks::All(_) => Some(Form::Body),
        };
        Style {
            view: plan.then(|| self.eye.seen(size)),
            projection: Some(if plan { Projection::Plan } else { Projection::Perspective }),
            viewpoint: self.eye.viewpoint(selected),
            trails: settings.trails,
            forms: form.map_or(coloring.forms, |form| vec![form; shown.setting.groups.len()]),
            annotations: match selected.filter(|_| settings.annotations) {
                Some(number) => Annotations { kinds: Annotation::ALL.to_vec(), agents: Some(vec![number]) },
                None => Annotations::default(),
            },
            ..coloring
        }
    }

    /// Sees everything again, at the next moment.
    pub fn refit(&mut self) {
        self.fitted = None;
    }

    fn open(&mut self, shown: &Shown, size: Vec2) {
        self.fitted = Some(shown.name.clone());
        self.selected = None;
        let usual = if shown.setting.in_space { Projection::Perspective } else { Projection::Plan };
        self.eye.set_mode(match Style::said(&shown.scene).projection.unwrap_or(usual) {
            Projection::Plan => Mode::Plan,
            Projection::Perspective => Mode::Orbit,
        });
        self.fit(shown, size);
    }

    /// Changes as another view has: its eye, and who is selected in it. Who is followed goes another way in each.
    pub fn goes_with(&mut self, before: (Eye, Option<u32>), now: (Eye, Option<u32>)) {
        if before.1 != now.1 {
            self.selected = now.1;
        }
        let alone = now.0.mode().follows() && now.0.mode() == self.eye.mode();
        if before.0 != now.0 && !alone {
            self.eye = now.0;
        }
    }

    /// Selects the agent after the selected one.
    pub fn select_next(&mut self, shown: &Shown) {
        let bodies = &shown.frame.bodies;
        let after = self.selected.map_or(0, |number| bodies.partition_point(|body| body.number <= number));
        self.selected = bodies.get(after).or(bodies.first()).map(|body| body.number);
    }

    fn handle(&mut self, ui: &Ui, response: &Response, rect: Rect, size: Vec2) {
        if response.dragged() && !(self.lent && response.dragged_by(PointerButton::Primary)) {
            let by = response.drag_delta();
            let shift = ui.input(|input| input.modifiers.shift);
            let turning = response.dragged_by(PointerButton::Primary) && !shift;
            self.eye.drag(Vec2::new(by.x, by.y), turning, size);
        }
        if let Some(at) = response.hover_pos() {
            let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
            let factor = f64::from(pinch) * f64::from(scroll * 0.004).exp();
            if factor != 1.0 {
                self.eye.zoom(Vec2::new(at.x - rect.min.x, at.y - rect.min.y), factor, size);
            }
        }
    }

    fn paint(&mut self, ui: &Ui, rect: Rect, shown: &Shown, settings: &Settings, projector: &Projector, share: f32) {
        let theme = settings.theme();
        let base = if shown.setting.walkable.is_empty() { theme.ground } else { theme.outside };
        let painter = ui.painter_at(rect);
        painter.rect_filled(rect, 0.0, crate::style::color(base));
        let scenery = self.scenery(shown, settings, &theme);
        let (floor, place, solids) = (scenery.floor.clone(), scenery.place.clone(), scenery.solids.clone());
        let solids = if matches!(projector, Projector::Plan(_)) { Arc::default() } else { solids };
        let size = Vec2::new(rect.width(), rect.height());
        let grid = if settings.grid { grid(projector, size, shown, &theme) } else { Geometry::default() };
        let plan = matches!(projector, Projector::Plan(_));
        let look = || settings.coloring.look(shown, &theme);
        let [trails, agents] = self.crowd.layers(shown, settings, plan, &look);
        let layers = vec![floor, Arc::new(grid), place, solids, trails, agents, Arc::new(self.marked(shown, &theme))];
        let unit = ui.ctx().pixels_per_point();
        let lighting = Lighting { share, notch: theme.notch.alpha(0.92), ..lighting(projector, size, unit, shown) };
        let canvas = self.canvas.clone();
        let draw = move |_: egui::PaintCallbackInfo, painter: &egui_glow::Painter| {
            draw(&canvas, painter.gl(), &layers, &lighting);
        };
        painter.add(egui::PaintCallback { rect, callback: Arc::new(egui_glow::CallbackFn::new(draw)) });
        if let Some(number) = self.selected.filter(|_| settings.annotations) {
            let look = Coloring::Group.look(shown, &theme);
            let (origin, projector, look, theme) = (shown.setting.origin, *projector, &look, &theme);
            let thinker = thoughts::Thinker { number, origin, projector, look, theme };
            thoughts::draw(&painter, rect, &interpolated(shown, share), thinker);
        }
        if let Some(Err(says)) = self.canvas.lock().unwrap_or_else(PoisonError::into_inner).as_ref() {
            painter.text(rect.center(), egui::Align2::CENTER_CENTER, says, egui::FontId::default(), egui::Color32::RED);
        }
    }

    fn scenery(&mut self, shown: &Shown, settings: &Settings, theme: &Theme) -> &Scenery {
        let (run, dark) = (shown.run, settings.dark);
        if self.scenery.as_ref().is_some_and(|scenery| (scenery.run, scenery.dark) != (run, dark)) {
            self.scenery = None;
        }
        self.scenery.get_or_insert_with(|| Scenery {
            run,
            dark,
            floor: Arc::new(scenery::floor(&shown.setting, theme)),
            solids: Arc::new(scenery::solids(&shown.setting, theme)),
            place: Arc::new(scenery::place(&shown.setting, &shown.scene, theme, &shown.first)),
        })
    }

    /// Rings round who is selected and who is pointed at.
    fn marked(&self, shown: &Shown, theme: &Theme) -> Geometry {
        let mut marks = Geometry::default();
        for (number, opacity) in [(self.hovered, 0.45), (self.selected, 0.95)] {
            let Some((before, now)) = number.and_then(|number| pair(shown, number)) else { continue };
            marks.discs.push(Disc::round_agent(before, now, theme.text.alpha(opacity), shown.setting.origin));
        }
        marks
    }

    /// Gives back what the graphics processor holds.
    pub fn destroy(&mut self, gl: &glow::Context) {
        if let Some(Ok(canvas)) = self.canvas.lock().unwrap_or_else(PoisonError::into_inner).take() {
            canvas.destroy(gl);
        }
    }
}

/// Draws layers with a canvas, which is made first where there is none.
fn draw(canvas: &Shared, gl: &glow::Context, layers: &[Arc<Geometry>], lighting: &Lighting) {
    let mut slot = canvas.lock().unwrap_or_else(PoisonError::into_inner);
    let result = match slot.get_or_insert_with(|| Canvas::new(gl)) {
        Ok(canvas) => canvas.paint(gl, layers, lighting),
        Err(_) => return,
    };
    if let Err(says) = result {
        *slot = Some(Err(says));
    }
}

/// From the world to clip coordinates, for the shaders.
fn lighting(projector: &Projector, size: Vec2, unit: f32, shown: &Shown) -> Lighting {
    let clip = projector.clip(shown.setting.origin.extend(0.0), size).as_mat4();
    let (focal, near) = match projector {
        Projector::Plan(camera) => (camera.scale, 0.0),
        Projector::Perspective(lens) => (lens.focal(), lens.near()),
    };
    let (focal, near) = (focal as f32, near as f32);
    Lighting { clip, size: size * unit, unit, focal: focal * unit, near, share: 1.0, notch: Color::rgb(0) }
}

/// The grid on the ground that is seen.
fn grid(projector: &Projector, size: Vec2, shown: &Shown, theme: &Theme) -> Geometry {
    let color = theme.edge.alpha(0.28);
    let origin = shown.setting.origin;
    match projector {
        Projector::Plan(camera) => {
            let corners = [camera.point(Vec2::new(0.0, size.y)), camera.point(Vec2::new(size.x, 0.0))];
            scenery::grid(corners, scenery::cell(camera.scale), origin, color)
        }
        Projector::Perspective(lens) => {
            let bounds = shown.bounds;
            let (middle, half) = ((bounds.min + bounds.max) * 0.5, (bounds.max - bounds.min).max_element().max(2.0));
            let cell = scenery::cell(lens.scale(middle.extend(0.0)));
            let corners = [middle - half, middle + half].map(|corner| (corner / cell).round() * cell);
            scenery::grid(corners, cell, origin, color)
        }
    }
}

/// An agent in the state before and in the state now; one who has just entered is where it is.
fn pair(shown: &Shown, number: u32) -> Option<(&Body, &Body)> {
    let find = |bodies: &[Body]| bodies.binary_search_by_key(&number, |body| body.number).ok();
    let now = &shown.frame.bodies[find(&shown.frame.bodies)?];
    Some((find(&shown.before.bodies).map_or(now, |k| &shown.before.bodies[k]), now))
}

/// Everybody where they are shown, and what they told in the state now.
fn interpolated(shown: &Shown, share: f32) -> Frame {
    let bodies = shown.frame.bodies.iter().filter_map(|body| between(shown, body.number, share));
    Frame { bodies: bodies.collect(), accounts: shown.frame.accounts.clone(), ..Frame::default() }
}

/// An agent where it is shown, a share of the way from the state before to the state now.
pub fn between(shown: &Shown, number: u32, share: f32) -> Option<Body> {
    let (before, now) = pair(shown, number)?;
    let turn =
        (now.heading - before.heading + std::f32::consts::PI).rem_euclid(std::f32::consts::TAU) - std::f32::consts::PI;
    Some(Body {
        position: before.position.lerp(now.position, share.into()),
        altitude: before.altitude + (now.altitude - before.altitude) * share,
        heading: before.heading + turn * share,
        ..*now
    })
}

/// The agent that is nearest to a pixel.
fn nearest(shown: &Shown, projector: &Projector, at: Vec2, share: f32) -> Option<u32> {
    let away = |body: &Body| {
        let center: DVec3 = body.center();
        let edge = projector.scale(center) as f32 * body.shape().bound();
        let beyond = projector.pixel(center)?.distance(at) - edge;
        (beyond <= REACH).then_some(beyond)
    };
    // who is far from the pointer now was far a step ago
    let near = shown.frame.bodies.iter().filter(|body| away(body).is_some());
    let found = near.filter_map(|body| Some((away(&between(shown, body.number, share)?)?, body.number)));
    found.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, number)| number)
}
