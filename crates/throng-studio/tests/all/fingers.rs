//! The view on a touch screen.

use eframe::egui::{
    Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, TouchDeviceId, TouchId, TouchPhase, pos2,
};
use glam::Vec2;
use std::sync::Arc;
use std::time::Duration;
use throng_scene::gallery;
use throng_studio::play::{Command, Engine, RunMoment};
use throng_studio::settings::Settings;
use throng_studio::view::{ViewOptions, ground};

const SIZE: Vec2 = Vec2::new(800.0, 600.0);

fn shown() -> Arc<RunMoment> {
    let mut engine = Engine::default();
    let scene = Arc::new(gallery::scene("circle").unwrap());
    engine.command(Command::Load { name: "circle".into(), scene, run: false });
    engine.work(Duration::from_millis(1));
    engine.shown().unwrap()
}

/// A touch screen.
struct Screen {
    ctx: Context,
    view: ViewOptions,
    shown: Arc<RunMoment>,
    time: f64,
}

impl Screen {
    fn new() -> Self {
        let mut screen = Self { ctx: Context::default(), view: ViewOptions::default(), shown: shown(), time: 0.0 };
        (0..3).for_each(|_| screen.frame(Vec::new()));
        screen
    }

    fn frame(&mut self, events: Vec<Event>) {
        self.time += 0.02;
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), [SIZE.x, SIZE.y].into()));
        let input = RawInput { screen_rect, events, time: Some(self.time), ..RawInput::default() };
        let (view, shown) = (&mut self.view, &self.shown);
        let mut output = self.ctx.run_ui(input, |ui| _ = view.ui(ui, shown, &Settings::default()));
        output.textures_delta.clear();
    }
}

fn touch(finger: u64, phase: TouchPhase, pos: Pos2) -> Event {
    Event::Touch { device_id: TouchDeviceId(0), id: TouchId(finger), phase, pos, force: None }
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
}

#[test]
fn two_fingers_hold_the_ground() {
    let mut screen = Screen::new();
    let places = |screen: &Screen, pixels: [Pos2; 2]| {
        let projector = screen.view.eye.projector(SIZE);
        pixels.map(|at| ground(&projector, Vec2::new(at.x, at.y)).unwrap())
    };
    let (begin, end) = ([pos2(350.0, 300.0), pos2(450.0, 300.0)], [pos2(310.0, 330.0), pos2(510.0, 330.0)]);
    // the first finger is reported as a mouse too
    screen.frame(vec![touch(1, TouchPhase::Start, begin[0]), Event::PointerMoved(begin[0]), button(begin[0], true)]);
    screen.frame(vec![touch(2, TouchPhase::Start, begin[1])]);
    screen.frame(Vec::new());
    let held = places(&screen, begin);
    for k in 1..=20 {
        let part = k as f32 / 20.0;
        let at = [0, 1].map(|finger| begin[finger].lerp(end[finger], part));
        screen.frame(vec![
            touch(1, TouchPhase::Move, at[0]),
            Event::PointerMoved(at[0]),
            touch(2, TouchPhase::Move, at[1]),
        ]);
    }
    let now = places(&screen, end);
    for finger in 0..2 {
        assert!(now[finger].distance(held[finger]) < 0.05, "{:?} {:?}", now[finger], held[finger]);
    }
}

#[test]
fn a_tap_selects() {
    let mut screen = Screen::new();
    let body = &screen.shown.frame.bodies[7];
    let at = screen.view.eye.projector(SIZE).pixel(body.center()).unwrap();
    let (number, at) = (body.number, pos2(at.x, at.y));
    screen.frame(vec![touch(1, TouchPhase::Start, at), Event::PointerMoved(at), button(at, true)]);
    // a lifted finger has no position
    screen.frame(vec![touch(1, TouchPhase::End, at), button(at, false), Event::PointerGone]);
    screen.frame(Vec::new());
    assert_eq!(screen.view.selected, Some(number));
}
