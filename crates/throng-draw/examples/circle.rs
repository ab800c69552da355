//! Paints a generated ring of agents that walk to the opposite side: `cargo run --example circle -- 36 circle.png`.

use glam::DVec2;
use std::f64::consts::{PI, TAU};
use throng::{Goal, Status};
use throng_draw::{ColorBy, Film, Style};
use throng_record::{Body, Frame, Setting};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count: u32 = std::env::args().nth(1).map_or(Ok(36), |n| n.parse())?;
    let path = std::env::args().nth(2).unwrap_or_else(|| "circle.png".into());
    let ring = (f64::from(count) * 0.9 / TAU).max(3.0);
    let place = |n: u32| DVec2::from_angle(f64::from(n) / f64::from(count) * TAU);
    let setting = Setting {
        title: format!("Ring of {count}"),
        goals: (0..count).map(|n| Goal::Point { at: -place(n) * ring, tolerance: 0.2 }).collect(),
        groups: vec!["walkers".into()],
        ..Setting::default()
    };
    let style = Style { color_by: ColorBy::Goal, ..Style::default() };
    let mut film = Film::create(path, &setting, &style, 25.0)?;
    for k in 0..=60 {
        let time = f64::from(k) * 0.04;
        let bodies = (0..count).map(|n| {
            // Agents walk inwards and turn aside as the ring gets narrow.
            let inward = -place(n);
            let turn = 0.9 * (1.3 * time / ring).min(1.0);
            let direction = DVec2::from_angle(turn).rotate(inward);
            Body {
                number: n,
                group: 0,
                goal: Some(n),
                position: -inward * ring + direction * 1.3 * time,
                velocity: (direction * 1.3).as_vec2(),
                altitude: 0.0,
                vertical_velocity: 0.0,
                heading: (f64::from(n) / f64::from(count) * TAU + PI + turn) as f32,
                basis: None,
                radius: 0.2,
                core: glam::Vec2::ZERO,
                preferred_speed: 1.3,
                status: Status::Walking,
            }
        });
        film.push(&Frame { time, bodies: bodies.collect(), total: count as usize, ..Frame::default() })?;
    }
    film.finish()?;
    Ok(())
}
