//! Draws a generated swarm around a lamp at moments one second apart: `cargo run --release --example insects -- [FOLDER
//! [WIDTHxHEIGHT]]`.

use glam::{DVec2, DVec3, Vec2};
use std::path::PathBuf;
use throng::motion::Basis;
use throng::{Obstacle, Status};
use throng_draw::{AgentShape, Painter, Projection, Style, Theme, sink::write_png};
use throng_record::{Body, Frame, Setting};

/// Pictures per second.
const RATE: u32 = 25;

/// Returns the position of an insect; each has its own orbit around the lamp.
fn place(number: u32, time: f64) -> DVec3 {
    let part = |k: f64| (f64::from(number) * k).fract();
    let (out, turn) = (0.5 + 2.6 * part(0.618_034).powf(0.7), std::f64::consts::TAU * part(0.754_878));
    let rate = if number.is_multiple_of(2) { 1.3 } else { -1.1 } * (1.0 + part(0.569_84)) / out.sqrt();
    let angle = turn + rate * time;
    let wobble =
        DVec3::new((3.1 * time + turn).sin(), (2.7 * time + 2.0 * turn).cos(), (3.7 * time + 3.0 * turn).sin());
    DVec2::from_angle(angle).extend(0.0) * out
        + DVec3::Z * (2.2 + 1.2 * (turn * 7.0 + 0.8 * time).sin())
        + wobble * 0.22
}

fn moment(count: u32, time: f64) -> Frame {
    let body = |number: u32| {
        let (here, next) = (place(number, time), place(number, time + 1e-3));
        let velocity = ((next - here) / 1e-3).as_vec3();
        Body {
            number,
            group: u32::from(number.is_multiple_of(5)),
            goal: None,
            position: here.truncate(),
            velocity: velocity.truncate(),
            altitude: here.z as f32,
            vertical_velocity: velocity.z,
            heading: velocity.truncate().to_angle(),
            basis: Some(Basis::facing(velocity)),
            radius: 0.02,
            core: Vec2::ZERO,
            preferred_speed: 1.0,
            status: Status::Walking,
        }
    };
    Frame { time, bodies: (0..count).map(body).collect(), total: count as usize, ..Frame::default() }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".into()));
    let size = std::env::args().nth(2).unwrap_or_else(|| "1280x720".into());
    let (width, height) = size.split_once('x').ok_or("write WIDTHxHEIGHT")?;
    std::fs::create_dir_all(&folder)?;
    let column = |x: f64, y: f64| Obstacle::Circle { center: DVec2::new(x, y), radius: 0.25 };
    let setting = Setting {
        title: "Round a lamp".into(),
        groups: vec!["males".into(), "females".into()],
        obstacles: vec![column(0.0, 0.0), column(2.4, 1.6)],
        in_space: true,
        ..Setting::default()
    };
    for (name, projection, theme, count) in [
        ("plan", Projection::Plan, Theme::light(), 300),
        ("plan-many", Projection::Plan, Theme::light(), 10_000),
        ("space", Projection::Perspective, Theme::light(), 300),
        ("space-many", Projection::Perspective, Theme::light(), 10_000),
        ("space-dark", Projection::Perspective, Theme::dark(), 3000),
    ] {
        let style = Style {
            width: width.parse()?,
            height: height.parse()?,
            projection: Some(projection),
            forms: vec![AgentShape::Insect; 2],
            theme,
            ..Style::default()
        };
        let mut painter = Painter::new(&setting, &style, &moment(count, 0.0))?;
        for k in 0..=2 * RATE {
            let frame = moment(count, f64::from(k) / f64::from(RATE));
            painter.follow(&frame);
            if k % RATE == 0 {
                write_png(folder.join(format!("insects-{name}-{}.png", k / RATE)), painter.paint(&frame))?;
            }
        }
    }
    Ok(())
}
