//! A generated recording: two streams cross a hall with pillars while a few people gather in a ring.

use glam::{DVec2, Vec2};
use throng::{Goal, Obstacle, Status, Walkable};
use throng_record::{Body, Frame, Setting};

/// Returns the hall.
pub fn crossing() -> Setting {
    let corners = |x0: f64, y0: f64, x1: f64, y1: f64| {
        vec![DVec2::new(x0, y0), DVec2::new(x1, y0), DVec2::new(x1, y1), DVec2::new(x0, y1)]
    };
    let pillar = |x: f64, y: f64| Obstacle::Circle { center: DVec2::new(x, y), radius: 0.45 };
    Setting {
        title: "Two streams crossing".into(),
        walkable: vec![Walkable { outer: corners(0.0, 0.4, 24.0, 15.0), holes: vec![corners(9.0, 12.0, 12.5, 13.6)] }],
        obstacles: vec![
            pillar(7.0, 2.6),
            pillar(12.0, 2.0),
            pillar(17.0, 2.6),
            Obstacle::rectangle(DVec2::new(3.4, 12.9), DVec2::new(2.6, 1.2), 0.35),
            Obstacle::Wall { points: vec![DVec2::new(20.6, 15.0), DVec2::new(20.6, 12.4), DVec2::new(22.4, 12.4)] },
        ],
        groups: vec!["east".into(), "west".into(), "meeting".into()],
        goals: vec![
            Goal::Exit { corners: corners(22.6, 5.6, 24.0, 9.2) },
            Goal::Area { corners: corners(0.0, 5.6, 1.4, 9.2) },
            Goal::Point { at: DVec2::new(17.0, 12.8), tolerance: 0.4 },
        ],
        ..Setting::default()
    }
}

/// Returns the hall at step `k`, with 25 steps per second.
pub fn moment(k: usize) -> Frame {
    let time = k as f64 * 0.04;
    let mut bodies = Vec::new();
    for n in 0..54u32 {
        let east = n % 2 == 0;
        let lane = f64::from(n / 2 % 9) - 4.0;
        let phase = f64::from(n * 37 % 54) / 54.0 * 22.0;
        let speed = 1.1 + 0.4 * f64::from(n * 13 % 7) / 7.0;
        let along = (phase + speed * time).rem_euclid(22.0) + 1.0;
        let sway =
            |s: f64| 7.4 + lane * 0.78 + 0.25 * (s * 0.45 + f64::from(n)).sin() + if east { -0.19 } else { 0.19 };
        let (x, slope) = if east { (along, 1.0) } else { (24.0 - along, -1.0) };
        let velocity = Vec2::new((speed * slope) as f32, (0.112 * (along * 0.45 + f64::from(n)).cos() * speed) as f32);
        bodies.push(Body {
            number: n,
            group: u32::from(!east),
            goal: Some(u32::from(!east)),
            position: DVec2::new(x, sway(along)),
            velocity,
            altitude: 0.0,
            vertical_velocity: 0.0,
            heading: velocity.y.atan2(velocity.x),
            basis: None,
            radius: 0.24,
            core: Vec2::ZERO,
            preferred_speed: 1.5,
            status: Status::Walking,
        });
    }
    for n in 0..9u32 {
        let angle = f64::from(n) / 9.0 * std::f64::consts::TAU;
        let outward = DVec2::new(angle.cos(), angle.sin());
        let there = n % 3 != 0;
        let distance = if there { 1.1 } else { (4.5 - 0.35 * time).max(1.1) };
        bodies.push(Body {
            number: 100 + n,
            group: 2,
            goal: Some(2),
            position: DVec2::new(17.0, 12.8) + outward * DVec2::new(distance, distance.min(2.0)),
            velocity: if there { Vec2::ZERO } else { outward.as_vec2() * -0.35 },
            altitude: 0.0,
            vertical_velocity: 0.0,
            heading: (angle + std::f64::consts::PI) as f32,
            basis: None,
            radius: 0.24,
            core: Vec2::ZERO,
            preferred_speed: 1.3,
            status: if there { Status::Arrived } else { Status::Walking },
        });
    }
    Frame { time, bodies, arrived: 6, total: 63, ..Frame::default() }
}
