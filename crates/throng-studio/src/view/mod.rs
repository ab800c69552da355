//! The view: the world through a camera that the user controls.

mod colors;
mod crowd;
mod derived;
mod eye;
mod geometry;
mod gl;
mod guide;
mod heat;
mod kernel;
mod key;
mod layers;
mod marks;
mod mesh;
mod mode;
mod moment;
mod people;
mod scenery;
mod set;
mod streams;
mod thoughts;
mod trails;

pub use colors::Coloring;
pub use eye::{Eye, ground};
pub use heat::Heat;
pub use key::{Row, Sign};
pub use layers::{Ground, Layers};
pub use marks::Marks;
pub use mode::Mode;
pub use moment::between;
pub use streams::Streams;

use crate::play::RunMoment;
use crate::settings::Settings;
use crowd::Crowd;
use eframe::egui::{self, InputState, PointerButton, Rect, Response, Role, Sense, Ui, WidgetInfo};
use eframe::{egui_glow, glow};
use geometry::{Disc, Geometry};
use gl::{Canvas, Lighting};
use glam::{Vec2, Vec3};
use guide::Guide;
use moment::{interpolated, nearest, pair};
use people::DrawnPeople;
use set::Set;
use std::sync::{Arc, Mutex, PoisonError};
use throng_draw::{Annotation, Annotations, Color, Projection, Projector, Style, Theme, WorldBox};
use throng_record::{Frame, Setting};
use throng_scene::{CameraKey, Scene};
use trails::RunTrails;

/// The length of the trails of agents with annotations, seconds.
const WAYS: f64 = 10.0;

/// The direction to the sun of a scene that gives none, from +x, and its height above the horizon, radians.
const AZIMUTH: f32 = -2.2565;
const HEIGHT: f32 = 0.7777;

/// The least height of the box around flocks, metres.
const HEADROOM: f64 = 1.8;

/// What a view begins with, where it differs from the scene's own view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FirstView {
    /// The number of the selected agent.
    pub selected: Option<u32>,
    /// The camera.
    pub mode: Option<Mode>,
    /// The pose of the camera ([`Eye::pose`]).
    pub pose: Option<String>,
}

/// A view of the world.
#[derive(Default)]
pub struct ViewOptions {
    /// The camera.
    pub eye: Eye,
    /// Whether a tool uses the primary mouse button, instead of moving the camera and selecting.
    pub lent: bool,
    /// Whether the wheel zooms only with Ctrl, so that a page around the view can scroll.
    pub scrolls: bool,
    /// The number of the selected agent.
    pub selected: Option<u32>,
    /// What the view of the next scene begins with.
    pub at_first: FirstView,
    hovered: Option<u32>,
    /// The scene that the camera was fitted to.
    fitted: Option<Arc<str>>,
    guide: Guide,
    /// The trails of agents with annotations.
    ways: RunTrails,
    scenery: Option<Scenery>,
    ground: Ground,
    crowd: Crowd,
    set: Set,
    /// The layers drawn last.
    layers: Vec<Arc<Geometry>>,
    /// The bytes of the layers that changed in the last frame.
    handed_over: usize,
    canvas: Shared,
}

/// The canvas, or the error that prevented it. It is created when OpenGL is available.
type Shared = Arc<Mutex<Option<Result<Canvas, String>>>>;

/// The geometry that changes only with the setting, the scene and the theme.
struct Scenery {
    /// What it is made of.
    setting: Arc<Setting>,
    scene: Arc<Scene>,
    dark: bool,
    floor: Arc<Geometry>,
    place: Arc<Geometry>,
    /// Solid things in space, and their surfaces from above.
    solids: Arc<Geometry>,
    roofs: Arc<Geometry>,
}

impl ViewOptions {
    /// Shows a moment in the available space. Handles input that moves the camera or selects an agent.
    pub fn ui(&mut self, ui: &mut Ui, shown: &RunMoment, settings: &Settings) -> Response {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "view of the scene"));
        let size = Vec2::new(rect.width(), rect.height()).max(Vec2::ONE);
        if self.fitted.as_ref() != Some(&shown.name) {
            self.open(shown, size);
        } else if self.guide.is_outdated(shown) {
            self.guide.change(shown, size, self.eye);
        }
        let share = shown.share();
        self.handle(ui, &response, rect, size);
        self.guide.lead(&mut self.eye, shown, share);
        let people = people::drawn(shown, settings, self.eye.mode() == Mode::Plan);
        let body = self.selected.and_then(|number| between(shown, number, share));
        let followed = body.map(|body| people::followed(&body, people));
        self.eye.settle(followed, f64::from(ui.input(|input| input.stable_dt.min(0.1))));
        let projector = self.eye.projector(size);
        // a lifted finger has no hover position
        let pointer = response
            .hover_pos()
            .or(response.interact_pointer_pos())
            .map(|at| Vec2::new(at.x - rect.min.x, at.y - rect.min.y));
        self.hovered = pointer.and_then(|at| nearest(shown, &projector, at, share, people));
        if response.clicked() && !self.lent {
            self.selected = self.hovered;
        }
        if response.double_clicked() && !self.lent && self.hovered.is_none() {
            self.guide.end();
            self.fit(shown, size);
        }
        self.guide.follow(self.eye);
        self.paint(ui, rect, shown, settings, &projector, share);
        if shown.playing || self.eye.moves() {
            ui.ctx().request_repaint();
        }
        response
    }

    /// Fits the whole scene into the view.
    pub fn fit(&mut self, shown: &RunMoment, size: Vec2) {
        self.fit_to(shown.bounds, shown, size);
    }

    fn fit_to(&mut self, bounds: WorldBox, shown: &RunMoment, size: Vec2) {
        let tops = shown.first.bodies.iter().map(|body| f64::from(body.altitude + body.radius));
        let height = tops.fold(HEADROOM, f64::max);
        self.eye.fit(bounds, if shown.setting.in_space { height } else { 0.0 }, size);
    }

    /// Returns the agent under the pointer.
    pub fn hovered(&self) -> Option<u32> {
        self.hovered
    }

    /// Returns the layers on the ground, as drawn last.
    pub fn ground(&self) -> &Ground {
        &self.ground
    }

    /// Returns the bytes uploaded in the last frame: those of the layers that changed.
    pub fn handed_over(&self) -> usize {
        self.handed_over
    }

    /// Returns the style of a recording that looks like this view. `size` is the size of the view, points of the
    /// screen.
    pub fn style(&self, shown: &RunMoment, settings: &Settings, size: Vec2) -> Style {
        let (plan, selected) = (self.eye.mode() == Mode::Plan, self.selected);
        let coloring = settings.coloring.style(shown, &settings.theme());
        let form = |group: usize| {
            let own = coloring.forms.get(group).copied().unwrap_or_default();
            let mut all = shown.frame.bodies.iter().chain(&shown.first.bodies);
            let body = all.find(|body| body.group as usize == group);
            body.map_or(own, |body| settings.marks.form(body, own, plan))
        };
        let forms = (0..shown.setting.groups.len().max(1)).map(form).collect();
        Style {
            view: plan.then(|| self.eye.seen(size)),
            projection: Some(if plan { Projection::Plan } else { Projection::Perspective }),
            viewpoint: match self.guide.leads() {
                true => coloring.viewpoint.clone(),
                false => self.eye.viewpoint(selected),
            },
            flow: streams::flow(&settings.layers, coloring.flow.clone()),
            trails: settings.trails,
            forms,
            annotations: match selected.filter(|_| settings.annotations) {
                Some(number) => Annotations { kinds: settings.annotation_kinds(), agents: Some(vec![number]) },
                None if settings.annotations => Annotations::said(&shown.scene),
                None => Annotations::default(),
            },
            ..coloring
        }
    }

    /// Begins again in the next frame, as `first` says.
    pub fn begin(&mut self, first: FirstView) {
        self.at_first = first;
        self.refit();
    }

    /// Shows what the `[view]` of the scene shows, or the whole scene, in the next frame.
    pub fn refit(&mut self) {
        self.fitted = None;
    }

    fn open(&mut self, shown: &RunMoment, size: Vec2) {
        self.fitted = Some(shown.name.clone());
        let FirstView { selected, mode, pose } = std::mem::take(&mut self.at_first);
        self.selected = selected;
        let camera = self.guide.open(shown, size);
        let own = if camera.is_some() { Mode::Orbit } else { Mode::Plan };
        self.eye.set_mode(mode.unwrap_or(own));
        self.fit_to(Style::said(&shown.scene).view.unwrap_or(shown.bounds), shown, size);
        if let Some(mut camera) = camera.filter(|_| self.eye.mode() == Mode::Orbit) {
            let (sight, angle) = camera.turn(&shown.first);
            self.eye.look(sight, angle);
            self.guide.begin(self.eye);
        }
        if pose.is_some_and(|pose| self.eye.set_pose(&pose, size)) {
            self.guide.end();
        }
    }

    /// Lets the moving camera of the scene move the view.
    pub fn film(&mut self) {
        self.eye.stay();
        self.guide.begin(self.eye);
    }

    /// Returns the camera of the view as a key at a time, seconds; `None` in a plan.
    pub fn camera_key(&self, time: f64) -> Option<CameraKey> {
        let viewpoint = self.eye.viewpoint(None);
        let [eye, target] = [viewpoint.eye?, viewpoint.target?].map(|point| point.to_array());
        let key = CameraKey { time, eye, target, field_of_view: Some(viewpoint.field_of_view), cut: false };
        (self.eye.mode() != Mode::Plan).then_some(key)
    }

    /// Follows the changes of another view: its camera and its selection. A camera that follows an agent is not copied,
    /// because the agents of both runs move differently.
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
    pub fn select_next(&mut self, shown: &RunMoment) {
        let bodies = &shown.frame.bodies;
        let after = self.selected.map_or(0, |number| bodies.partition_point(|body| body.number <= number));
        self.selected = bodies.get(after).or(bodies.first()).map(|body| body.number);
    }

    fn handle(&mut self, ui: &Ui, response: &Response, rect: Rect, size: Vec2) {
        // two fingers always move the camera
        if let Some(touch) = ui.input(InputState::multi_touch).filter(|touch| rect.contains(touch.center_pos)) {
            let (by, at) = (touch.translation_delta, touch.center_pos - rect.min);
            self.eye.drag(Vec2::new(by.x, by.y), false, size);
            self.eye.turn(touch.rotation_delta.into());
            self.eye.zoom(Vec2::new(at.x, at.y), touch.zoom_delta.into(), size);
            return;
        }
        if response.dragged() && !(self.lent && response.dragged_by(PointerButton::Primary)) {
            let by = response.drag_delta();
            let shift = ui.input(|input| input.modifiers.shift);
            let turning = response.dragged_by(PointerButton::Primary) && !shift;
            self.eye.drag(Vec2::new(by.x, by.y), turning, size);
        }
        if let Some(at) = response.hover_pos() {
            let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
            let scroll = if self.scrolls { 0.0 } else { scroll };
            let factor = f64::from(pinch) * f64::from(scroll * 0.004).exp();
            if factor != 1.0 {
                self.eye.zoom(Vec2::new(at.x - rect.min.x, at.y - rect.min.y), factor, size);
            }
        }
    }

    fn paint(
        &mut self,
        ui: &Ui,
        rect: Rect,
        shown: &RunMoment,
        settings: &Settings,
        projector: &Projector,
        share: f32,
    ) {
        let theme = settings.theme_of(&shown.scene);
        let base = if shown.setting.walkable.is_empty() { theme.ground } else { theme.outside };
        let painter = ui.painter_at(rect);
        painter.rect_filled(rect, 0.0, crate::style::color(base));
        let scenery = self.scenery(shown, settings, &theme);
        let plan = matches!(projector, Projector::Plan(_));
        let (floor, place) = (scenery.floor.clone(), scenery.place.clone());
        let solids = if plan { scenery.roofs.clone() } else { scenery.solids.clone() };
        let size = Vec2::new(rect.width(), rect.height());
        let grid = if settings.grid { scenery::grid_seen(projector, size, shown, &theme) } else { Geometry::default() };
        let look = || settings.coloring.look(shown, &theme);
        let [trails, agents] = self.crowd.layers(shown, settings, plan, &look);
        let [heat, streams, mesh] = self.ground.layers(shown, settings, (projector, size), self.selected, ui.ctx());
        let marked = Arc::new(self.marked(shown, settings, plan, &theme));
        let unit = ui.ctx().pixels_per_point();
        let seen = DrawnPeople::seen(shown, self.crowd.looks(), share, (projector, size, unit));
        let people = seen.filter(|_| settings.draws_people(&shown.scene, plan));
        let people = Arc::new(Geometry { people, deep: true, ..Geometry::default() });
        let set = self.set.layer(shown, ui.ctx()).filter(|_| !plan);
        let replaced = shown.scene.view.set.as_ref().is_some_and(|set| set.replaces) && matches!(set, Some(Ok(_)));
        let [floor, grid, solids] =
            [floor, Arc::new(grid), solids].map(|layer| if replaced { Arc::default() } else { layer });
        let set_layer = set.as_ref().and_then(|set| set.as_ref().ok().cloned()).unwrap_or_default();
        let layers = vec![floor, heat, streams, grid, place, mesh, solids, set_layer, trails, agents, people, marked];
        let new =
            |(k, layer): &(usize, &Arc<Geometry>)| self.layers.get(*k).is_none_or(|before| !Arc::ptr_eq(before, layer));
        self.handed_over = layers.iter().enumerate().filter(new).map(|(_, layer)| layer.bytes()).sum();
        self.layers.clone_from(&layers);
        let shadows = settings.layers.shadows;
        let lighting =
            Lighting { share, shadows, notch: theme.notch.alpha(0.92), ..lighting(projector, size, unit, shown) };
        let canvas = self.canvas.clone();
        let draw = move |_: egui::PaintCallbackInfo, painter: &egui_glow::Painter| {
            draw(&canvas, painter.gl(), &layers, &lighting);
        };
        painter.add(egui::PaintCallback { rect, callback: Arc::new(egui_glow::CallbackFn::new(draw)) });
        let flaw = shown.figures.flaw.clone().filter(|_| settings.draws_people(&shown.scene, plan));
        if let Some(says) = set.and_then(Result::err).or(flaw) {
            let color = ui.visuals().error_fg_color;
            painter.text(rect.center_bottom(), egui::Align2::CENTER_BOTTOM, says, egui::FontId::default(), color);
        }
        if settings.annotations {
            self.annotate(&painter, rect, shown, settings, projector, share);
        }
        if let Some(Err(says)) = self.canvas.lock().unwrap_or_else(PoisonError::into_inner).as_ref() {
            painter.text(rect.center(), egui::Align2::CENTER_CENTER, says, egui::FontId::default(), egui::Color32::RED);
        }
    }

    /// Draws the annotations of the scene's `[view]`, and all of the selected agent.
    fn annotate(
        &mut self,
        painter: &egui::Painter,
        rect: Rect,
        shown: &RunMoment,
        settings: &Settings,
        projector: &Projector,
        share: f32,
    ) {
        let theme = &settings.theme_of(&shown.scene);
        let said = Annotations::said(&shown.scene);
        let chosen = self.selected.map(|number| Annotations {
            kinds: settings.annotation_kinds().into_iter().filter(|kind| *kind != Annotation::Trails).collect(),
            agents: Some(vec![number]),
        });
        if said.kinds.is_empty() && chosen.is_none() {
            return;
        }
        let look = Coloring::Group.look(shown, theme);
        if said.kinds.contains(&Annotation::Trails) {
            let spacing = shown.frame.bodies.first().map_or(0.2, |body| f64::from(body.radius));
            self.ways.follow(shown, WAYS, spacing, |body| Some(look.color(body)));
        }
        let frame = Frame { time: shown.time(), ..interpolated(shown, share) };
        for annotations in [(!said.kinds.is_empty()).then_some(said), chosen].into_iter().flatten() {
            let (origin, projector, ways) = (shown.setting.origin, *projector, &self.ways.trails);
            let thinker = thoughts::Thinker { annotations: &annotations, ways, origin, projector, look: &look, theme };
            thoughts::draw(painter, rect, &frame, thinker);
        }
    }

    fn scenery(&mut self, shown: &RunMoment, settings: &Settings, theme: &Theme) -> &Scenery {
        let is_same = |of: &Scenery| Arc::ptr_eq(&of.setting, &shown.setting) && Arc::ptr_eq(&of.scene, &shown.scene);
        let scenery = self.scenery.take().filter(|scenery| is_same(scenery) && scenery.dark == settings.dark);
        self.scenery.insert(scenery.unwrap_or_else(|| Scenery {
            setting: shown.setting.clone(),
            scene: shown.scene.clone(),
            dark: settings.dark,
            floor: Arc::new(scenery::floor(&shown.setting, theme)),
            solids: Arc::new(scenery::solids(&shown.setting, theme)),
            roofs: Arc::new(scenery::roofs(&shown.setting, theme)),
            place: Arc::new(scenery::place(&shown.setting, &shown.scene, theme, &shown.first)),
        }))
    }

    /// Returns rings around the selected and the hovered agent, and the path of the selected agent.
    fn marked(&self, shown: &RunMoment, settings: &Settings, plan: bool, theme: &Theme) -> Geometry {
        let way = self.selected.filter(|_| settings.layers.paths).map(|number| mesh::way(shown, number, theme));
        let mut marks = way.unwrap_or_default();
        let people = people::drawn(shown, settings, plan);
        for (number, opacity) in [(self.hovered, 0.45), (self.selected, 0.95)] {
            let Some((before, now)) = number.and_then(|number| pair(shown, number)) else { continue };
            let broad = people::person(people, now.number).map(|person| people::broad(now, person));
            let now = broad.as_ref().unwrap_or(now);
            marks.discs.push(Disc::round_agent(before, now, theme.text.alpha(opacity), shown.setting.origin));
        }
        marks
    }

    /// Frees the resources of the graphics processor.
    pub fn destroy(&mut self, gl: &glow::Context) {
        if let Some(Ok(canvas)) = self.canvas.lock().unwrap_or_else(PoisonError::into_inner).take() {
            canvas.destroy(gl);
        }
    }
}

/// Draws layers with a canvas. Creates the canvas first if there is none.
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

/// Returns the uniforms of the shaders for a projection.
fn lighting(projector: &Projector, size: Vec2, unit: f32, shown: &RunMoment) -> Lighting {
    let clip = projector.clip(shown.setting.origin.extend(0.0), size).as_mat4();
    let (focal, near) = match projector {
        Projector::Plan(camera) => (camera.scale, 0.0),
        Projector::Perspective(lens) => (lens.focal(), lens.near()),
    };
    let (focal, near) = (focal as f32, near as f32);
    Lighting {
        clip,
        size: size * unit,
        unit,
        focal: focal * unit,
        near,
        share: 1.0,
        sun: sun(&shown.scene),
        shadows: true,
        notch: Color::rgb(0),
    }
}

/// Returns the direction to the sun: where the scene says, else to the left and the front, and above.
fn sun(scene: &Scene) -> Vec3 {
    let sun = scene.view.sun;
    let azimuth = sun.azimuth.map_or(AZIMUTH, |degrees| degrees.to_radians() as f32);
    let height = sun.height.map_or(HEIGHT, |degrees| degrees.to_radians() as f32);
    (Vec2::from_angle(azimuth) * height.cos()).extend(height.sin())
}
