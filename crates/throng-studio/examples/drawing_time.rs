//! Measures the processor time that drawing a crowd takes, without simulation and without the graphics processor. Every
//! frame draws a new state, which is the worst case. The poses of people are computed beside that, once per state: their
//! time is that of a step with people beyond that of a step without them. All is on one thread.
//!
//! usage: cargo run --release -p throng-studio --example drawing_time [AGENTS ...]
#![allow(clippy::print_stdout)]

use eframe::egui::{Context, Event, RawInput, Rect, pos2};
use std::sync::Arc;
use std::time::{Duration, Instant};
use throng_scene::Scene;
use throng_studio::play::{Command, Engine, RunMoment};
use throng_studio::settings::Settings;
use throng_studio::view::{Coloring, Mode, ViewOptions};

type Failure = Box<dyn std::error::Error>;

/// The number of states, one per frame. The first `WARM` states are not measured.
const STATES: usize = 60;
const WARM: usize = 20;
/// The size of the screen, in points.
const SIZE: [f32; 2] = [1280.0, 720.0];

fn main() -> Result<(), Failure> {
    let asked = std::env::args().skip(1).map(|count| count.parse()).collect::<Result<Vec<usize>, _>>()?;
    let counts = if asked.is_empty() { vec![1000, 10_000, 100_000] } else { asked };
    println!("{:>8}  {:<34} {:>8} {:>8} {:>10}", "agents", "drawn", "mean ms", "worst ms", "upload MB");
    let thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    thread.install(|| counts.into_iter().try_for_each(|count| measure(count).map_err(|error| error.to_string())))?;
    Ok(())
}

fn measure(count: usize) -> Result<(), Failure> {
    let (without, _) = states(count, false)?;
    let (with, states) = states(count, true)?;
    println!("{count:>8}  {:<34} {:>8.2}", "poses of people", (with - without) * 1e3);
    let plain = Settings { coloring: Coloring::Speed, trails: 0.0, ..Settings::default() };
    let mut walkers = plain.clone();
    walkers.layers.people = false;
    let trails = Settings { trails: 1.5, ..plain.clone() };
    for (says, settings, mode, selected) in [
        ("plan", &plain, Mode::Plan, None),
        ("plan, trails", &trails, Mode::Plan, None),
        ("plan, one selected", &plain, Mode::Plan, Some(count as u32 / 2)),
        ("walking figures", &walkers, Mode::Orbit, None),
        ("walking figures, trails", &Settings { trails: 1.5, ..walkers.clone() }, Mode::Orbit, None),
        ("people", &plain, Mode::Orbit, None),
        ("density", &Settings { coloring: Coloring::Density, ..plain.clone() }, Mode::Plan, None),
    ] {
        let (mean, worst, bytes) = draw(&states, settings, mode, selected);
        let [mean, worst] = [mean, worst].map(|time| time.as_secs_f64() * 1e3);
        println!("{count:>8}  {says:<34} {mean:>8.2} {worst:>8.2} {:>10.2}", bytes as f64 / 1e6);
    }
    Ok(())
}

/// Returns consecutive states of a walking crowd, with or without people, and the mean time of a step, seconds.
fn states(count: usize, people: bool) -> Result<(f64, Vec<Arc<RunMoment>>), Failure> {
    let side = (count as f64).sqrt().ceil() as usize;
    let text = format!(
        "title = \"Crowd\"\n[[group]]\nname = \"crowd\"\ncount = {count}\n\
         place.grid = {{ columns = {side}, rows = {side}, spacing = 1.0 }}\ngoal.shift = {{ by = [100.0, 0.0] }}\n"
    );
    let scene = Arc::new(Scene::parse("crowd.toml", text)?);
    let mut engine = Engine::default();
    engine.command(Command::Load { name: "crowd".into(), scene, run: false });
    engine.command(Command::People(people));
    engine.shown();
    let mut states = Vec::new();
    let mut begun = used();
    for state in 0..STATES {
        if state == WARM {
            begun = used();
        }
        engine.command(Command::Step);
        while engine.idle().is_some() {
            engine.work(Duration::from_secs(1));
        }
        states.push(engine.shown().ok_or("nothing is shown")?);
    }
    Ok(((used() - begun).as_secs_f64() / (STATES - WARM) as f64, states))
}

/// Draws all states, one per frame. Returns the mean time, the longest time, and the bytes uploaded in the last frame.
fn draw(
    states: &[Arc<RunMoment>],
    settings: &Settings,
    mode: Mode,
    selected: Option<u32>,
) -> (Duration, Duration, usize) {
    let (ctx, mut view) = (Context::default(), ViewOptions::default());
    let (mut begun, mut last, mut worst) = (used(), used(), Duration::ZERO);
    for (frame, shown) in states.iter().enumerate() {
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(pos2(0.0, 0.0), SIZE.into())),
            events: vec![Event::PointerMoved(pos2(640.0 + frame as f32, 360.0))],
            ..RawInput::default()
        };
        let mut output = ctx.run_ui(input, |ui| {
            view.ui(ui, shown, settings);
        });
        // no graphics processor consumes the textures
        output.textures_delta.clear();
        std::hint::black_box(ctx.tessellate(std::mem::take(&mut output.shapes), output.pixels_per_point));
        if frame == 0 {
            view.eye.set_mode(mode);
            view.selected = selected;
        }
        let now = used();
        if frame == WARM {
            begun = now;
        } else if frame > WARM {
            worst = worst.max(now - last);
        }
        last = now;
    }
    ((used() - begun) / (states.len() - 1 - WARM) as u32, worst, view.handed_over())
}

/// Returns the processor time of this thread, or the elapsed time where the system does not report it.
fn used() -> Duration {
    static BEGUN: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    let schedstat = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = schedstat.and_then(|text| text.split_whitespace().next()?.parse().ok());
    nanoseconds.map_or_else(|| BEGUN.get_or_init(Instant::now).elapsed(), Duration::from_nanos)
}
