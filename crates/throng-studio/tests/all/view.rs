//! The `[view]` of scenes: a scene looks the same in a film and in the studio.

use eframe::egui::{
    Context, Event, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, RawInput, Rect, TouchPhase, pos2,
    vec2,
};
use glam::{DVec2, DVec3, Vec2};
use std::sync::Arc;
use std::time::Duration;
use throng_draw::{Annotation, Projection, Projector, Style, WorldBox};
use throng_scene::Scene;
use throng_studio::play::{Command, Engine, RunMoment};
use throng_studio::settings::Settings;
use throng_studio::view::{Mode, ViewOptions};

const SIZE: Vec2 = Vec2::new(800.0, 600.0);

/// Returns a step of a scene of one agent that walks, with this view.
fn shown(view: &str, step: u64) -> Arc<RunMoment> {
    let text = format!("[[group]]\ncount = 1\nplace.point = [0, 0]\ngoal.point = [50, 0]\n[view]\n{view}\n");
    let mut engine = Engine::default();
    let scene = Arc::new(Scene::parse("scene.toml", text).unwrap());
    engine.command(Command::Load { name: "scene".into(), scene, run: false });
    engine.command(Command::Seek(step));
    while engine.idle().is_some() {
        engine.work(Duration::from_millis(20));
    }
    engine.shown().unwrap()
}

/// A window with the view.
#[derive(Default)]
struct Window {
    ctx: Context,
    view: ViewOptions,
    time: f64,
}

impl Window {
    fn frame(&mut self, shown: &RunMoment, events: Vec<Event>) {
        self.time += 0.02;
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), [SIZE.x, SIZE.y].into()));
        let input = RawInput { screen_rect, events, time: Some(self.time), ..RawInput::default() };
        let view = &mut self.view;
        self.ctx.run_ui(input, |ui| _ = view.ui(ui, shown, &Settings::default())).textures_delta.clear();
    }

    fn open(shown: &RunMoment) -> Self {
        let mut window = Self::default();
        (0..3).for_each(|_| window.frame(shown, Vec::new()));
        window
    }

    /// Drags by 50 points to the right.
    fn drag(&mut self, shown: &RunMoment) {
        let button = |pos: Pos2, pressed: bool| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        let (from, to) = (pos2(300.0, 200.0), pos2(350.0, 200.0));
        self.frame(shown, vec![Event::PointerMoved(from), button(from, true)]);
        self.frame(shown, vec![Event::PointerMoved(to)]);
        self.frame(shown, vec![button(to, false)]);
    }

    fn eye(&self) -> DVec3 {
        match self.view.eye.projector(SIZE) {
            Projector::Perspective(lens) => lens.eye,
            Projector::Plan(_) => panic!("a plan"),
        }
    }
}

#[test]
fn the_region_of_a_scene_is_in_view_until_the_user_moves_it() {
    let shown = shown("min = [10, -5]\nmax = [20, 5]", 0);
    let mut window = Window::open(&shown);
    let seen = window.view.eye.seen(SIZE);
    let region = WorldBox { min: DVec2::new(10.0, -5.0), max: DVec2::new(20.0, 5.0) };
    assert!(seen.min.cmple(region.min).all() && seen.max.cmpge(region.max).all(), "{seen:?}");
    assert!((seen.max - seen.min).y < 12.0 && ((seen.min + seen.max) * 0.5).distance(DVec2::new(15.0, 0.0)) < 1e-6);
    window.drag(&shown);
    let moved = window.view.eye.seen(SIZE);
    assert!(moved.min.x < seen.min.x - 0.5);
    window.frame(&shown, Vec::new());
    assert_eq!(window.view.eye.seen(SIZE), moved, "the user's change stays");
}

#[test]
fn the_camera_of_a_scene_is_that_of_its_films() {
    let view = "camera = { eye = [3, -20, 9], target = [3, 1, 2], field_of_view = 50 }";
    let shown = shown(view, 0);
    let window = Window::open(&shown);
    assert_eq!(window.view.eye.mode(), Mode::Orbit);
    assert!(window.eye().distance(DVec3::new(3.0, -20.0, 9.0)) < 1e-6, "{}", window.eye());
    let style = window.view.style(&shown, &Settings::default(), SIZE);
    let viewpoint = Style::said(&shown.scene).viewpoint;
    assert!(style.viewpoint.target.unwrap().distance(viewpoint.target.unwrap()) < 1e-6);
    assert!((style.viewpoint.field_of_view - 50.0).abs() < 1e-9);
    assert_eq!(style.projection, Some(Projection::Perspective));
}

#[test]
fn a_camera_that_moves_moves_the_view_until_the_user_does() {
    let view = "camera = { eye = [10, 0, 5], target = [0, 0, 0], orbit = 90 }";
    let (start, later) = (shown(view, 0), shown(view, 25));
    let mut window = Window::open(&start);
    assert!(window.eye().distance(DVec3::new(10.0, 0.0, 5.0)) < 1e-6);
    let turned = DVec2::from_angle((90.0 * later.time()).to_radians()) * 10.0;
    window.frame(&later, Vec::new());
    assert!(later.time() > 0.5 && window.eye().truncate().distance(turned) < 1e-6, "{}", window.eye());
    window.drag(&later);
    let own = window.eye();
    (0..3).for_each(|_| window.frame(&start, Vec::new()));
    assert!(own.truncate().distance(turned) > 0.1 && window.eye().distance(own) < 1e-6, "the user has moved it");
}

#[test]
fn new_keys_move_the_view_from_another_time_on() {
    let keys = |x: f64| {
        let key = |time: f64, x: f64| format!("{{ time = {time}, eye = [{x}, -9, 5], target = [0, 0, 0] }}");
        format!("camera = {{ keys = [{}, {}] }}", key(0.0, 0.0), key(1.0, x))
    };
    let mut window = Window::open(&shown(&keys(2.0), 0));
    let middle = shown(&keys(2.0), 25);
    window.frame(&middle, Vec::new());
    assert!((window.eye().x - 2.0).abs() < 1e-6, "the camera of the scene: {}", window.eye());
    let other = shown(&keys(4.0), 25);
    window.frame(&other, Vec::new());
    assert!((window.eye().x - 4.0).abs() < 1e-6, "changed keys: {}", window.eye());
    window.drag(&other);
    let own = window.eye();
    let changed = shown(&keys(8.0), 25);
    (0..3).for_each(|_| window.frame(&changed, Vec::new()));
    assert!(window.eye().distance(own) < 1e-6, "the user has moved it");
    window.frame(&shown(&keys(8.0), 50), Vec::new());
    assert!((window.eye().x - 8.0).abs() < 1e-6, "{}", window.eye());
    window.drag(&changed);
    window.frame(&shown(&keys(8.0), 0), Vec::new());
    assert!(window.eye().x != 0.0, "the user has moved it, and the keys are the same");
}

#[test]
fn annotations_colours_and_the_plan_of_a_scene_are_those_of_its_films() {
    let view = "projection = \"plan\"\nannotate = [\"velocity\", \"targets\"]\nground = \"#123456\"";
    let shown = shown(view, 3);
    assert_eq!(shown.frame.accounts.len(), 1, "the traces that annotations need are requested");
    let window = Window::open(&shown);
    assert_eq!(window.view.eye.mode(), Mode::Plan);
    let settings = Settings::default();
    let style = window.view.style(&shown, &settings, SIZE);
    assert_eq!(style.annotations.kinds, [Annotation::Velocity, Annotation::Targets]);
    assert_eq!(style.theme.ground.hex(), "#123456");
    let without = Settings { annotations: false, ..settings };
    assert!(window.view.style(&shown, &without, SIZE).annotations.kinds.is_empty(), "the user's change");
}

/// In a frame of another page, the wheel belongs to that page, except with Ctrl.
#[test]
fn an_embedded_view_zooms_with_ctrl_only() {
    let shown = shown("", 0);
    let zoomed = |scrolls: bool, modifiers: Modifiers| {
        let mut window = Window::open(&shown);
        window.view.scrolls = scrolls;
        let scale = |window: &Window| window.view.eye.projector(SIZE).scale(DVec3::ZERO);
        let before = scale(&window);
        let (unit, delta, phase) = (MouseWheelUnit::Point, vec2(0.0, 60.0), TouchPhase::Move);
        let source = MouseWheelSource::Wheel;
        window.frame(&shown, vec![Event::PointerMoved(pos2(300.0, 200.0))]);
        window.frame(&shown, vec![Event::MouseWheel { unit, delta, phase, modifiers, source }]);
        (0..20).for_each(|_| window.frame(&shown, Vec::new()));
        scale(&window) > 1.01 * before
    };
    assert!(zoomed(false, Modifiers::NONE));
    assert!(!zoomed(true, Modifiers::NONE));
    assert!(zoomed(true, Modifiers::COMMAND | Modifiers::CTRL));
}
