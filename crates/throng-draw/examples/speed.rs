//! Measures painting and encoding: `cargo run --release --example speed -- [AGENTS]`.

#[path = "shared/clock.rs"]
mod clock;

use clock::{now, report};
use glam::{DVec2, Vec2};
use throng::Status;
use throng_draw::{AgentShape, Painter, Projection, Style, sink::sink};
use throng_record::{Body, Frame, Setting};

fn moment(agents: u32, k: u32) -> Frame {
    let time = f64::from(k) * 0.04;
    let side = (f64::from(agents) * 2.0).sqrt();
    let bodies = (0..agents)
        .map(|n| {
            // A disc of people that walk in circles at 1.3 m/s.
            let distance = side * 0.5 * (f64::from(n + 1) / f64::from(agents)).sqrt();
            let angle = f64::from(n) * 2.399963 + 1.3 / distance * time;
            Body {
                number: n,
                group: n % 4,
                goal: None,
                position: DVec2::new(angle.cos(), angle.sin()) * distance,
                velocity: Vec2::ONE,
                altitude: 0.0,
                vertical_velocity: 0.0,
                heading: angle as f32 + 1.57,
                basis: None,
                radius: 0.25,
                core: Vec2::ZERO,
                preferred_speed: 1.3,
                status: Status::Walking,
            }
        })
        .collect();
    Frame { time, bodies, total: agents as usize, ..Frame::default() }
}

/// Returns the same bodies as flying insects.
fn swarm(setting: &Setting, frames: &[Frame]) -> (Setting, Vec<Frame>) {
    let mut frames = frames.to_vec();
    for body in frames.iter_mut().flat_map(|frame| &mut frame.bodies) {
        body.altitude = 1.0 + (body.number % 97) as f32 * 0.1;
        body.radius = 0.02;
        body.velocity = Vec2::from_angle(body.heading) * 1.3;
    }
    (Setting { in_space: true, ..setting.clone() }, frames)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let agents = std::env::args().nth(1).map_or(Ok(100), |a| a.parse())?;
    let setting = Setting { title: "Speed".into(), ..Setting::default() };
    let frames: Vec<_> = (0..200).map(|k| moment(agents, k)).collect();
    let folder = tempfile::tempdir()?;
    for trails in [0.0, 1.5] {
        let mut painter = Painter::new(&setting, &Style { trails, ..Style::default() }, &frames[0])?;
        let start = now();
        for frame in &frames {
            painter.paint(frame);
        }
        report(&format!("paint {agents} agents, trails of {trails} s"), frames.len(), start);
    }
    for projection in [Projection::Plan, Projection::Perspective] {
        let (setting, frames) = swarm(&setting, &frames);
        let (forms, projection) = (vec![AgentShape::Insect; 4], Some(projection));
        let style = Style { width: 1280, height: 720, forms, projection, ..Style::default() };
        let mut painter = Painter::new(&setting, &style, &frames[0])?;
        let start = now();
        for frame in &frames {
            painter.paint(frame);
        }
        report(&format!("paint {agents} insects, {projection:?}, 1280 x 720"), frames.len(), start);
    }
    let mut painter = Painter::new(&setting, &Style::default(), &frames[0])?;
    let images: Vec<_> = frames.iter().map(|frame| painter.paint(frame).clone()).collect();
    for name in ["film.mp4", "film.gif", "film/"] {
        let path = folder.path().join(name);
        let start = now();
        let mut sink = sink(&path, 25.0)?;
        for image in &images {
            sink.push(image)?;
        }
        sink.finish()?;
        let size = std::fs::metadata(&path)?.len();
        report(&format!("write {name}, {size} bytes"), images.len(), start);
    }
    let start = now();
    let mut film = throng_draw::Film::create(folder.path().join("whole.mp4"), &setting, &Style::default(), 25.0)?;
    for frame in &frames {
        film.push(frame)?;
    }
    film.finish()?;
    report("film.mp4, painted and written", frames.len(), start);
    Ok(())
}
