//! A small recording that the tests share: two groups walk past each other on open ground.

use glam::{DVec2, Vec2};
use std::path::Path;
use throng::{Goal, Obstacle, Status};
use throng_draw::{Style, WorldBox};
use throng_record::{Body, Frame, Setting};

pub fn setting() -> Setting {
    Setting {
        title: "Cats & <dogs>".into(),
        obstacles: vec![Obstacle::Circle { center: DVec2::new(0.0, 4.0), radius: 1.0 }],
        groups: vec!["cats".into(), "dogs".into()],
        goals: vec![Goal::Point { at: DVec2::new(4.0, -4.0), tolerance: 0.5 }],
        ..Setting::default()
    }
}

/// Returns a style with 160 by 120 pixels, 10 pixels per metre, and the origin in the middle.
pub fn style() -> Style {
    let half = DVec2::new(8.0, 6.0) - 1.05;
    let view = Some(WorldBox { min: -half, max: half });
    Style { width: 160, height: 120, view, trails: 0.0, legend: false, ..Style::default() }
}

pub fn moment(k: usize) -> Frame {
    let time = k as f64 * 0.04;
    let body = |number: u32, group: u32, position: DVec2, velocity: Vec2| Body {
        number,
        group,
        goal: Some(0),
        position,
        velocity,
        altitude: 0.0,
        vertical_velocity: 0.0,
        heading: velocity.y.atan2(velocity.x),
        basis: None,
        radius: 0.5,
        core: Vec2::ZERO,
        preferred_speed: 1.0,
        status: Status::Walking,
    };
    let bodies =
        vec![body(0, 0, DVec2::new(-5.0 + time, 1.0), Vec2::X), body(1, 1, DVec2::new(5.0 - time, -1.0), Vec2::NEG_X)];
    Frame { time, bodies, total: 2, ..Frame::default() }
}

/// Returns the bytes of a picture, three per pixel.
pub fn read_png(path: &Path) -> Vec<u8> {
    let mut reader =
        png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap())).read_info().unwrap();
    let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut rgb).unwrap();
    rgb
}

/// Checks that tags close in order and that attributes and text are clean; returns the number of elements.
pub fn elements(svg: &str) -> usize {
    let (mut open, mut count) = (Vec::new(), 0);
    for piece in svg.split('<').skip(1) {
        let (tag, text) = piece.split_once('>').expect("a tag ends");
        assert!(tag.matches('"').count() % 2 == 0, "quotes come in pairs: {tag}");
        for (at, _) in text.match_indices('&') {
            assert!(["&amp;", "&lt;", "&gt;"].iter().any(|e| text[at..].starts_with(e)), "{text}");
        }
        if tag.starts_with('?') || tag.ends_with('/') {
            count += 1;
        } else if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
        } else {
            open.push(tag.split_whitespace().next().unwrap());
            count += 1;
        }
    }
    assert!(open.is_empty(), "left open: {open:?}");
    count
}
