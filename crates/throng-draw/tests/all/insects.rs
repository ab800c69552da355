//! Swarms of insects.

use super::common::{elements, moment, setting, style};
use glam::{DVec2, Vec2};
use throng_draw::{AgentShape, Color, Image, Painter, Projection, Style};
use throng_record::{Frame, Setting};

fn swarming() -> Style {
    Style { forms: vec![AgentShape::Insect; 2], ..style() }
}

fn place() -> Setting {
    Setting { obstacles: Vec::new(), goals: Vec::new(), ..setting() }
}

/// Returns a frame with one agent that moves along +x through the middle of the picture.
fn alone(time: f64, radius: f32) -> Frame {
    let mut frame = moment(0);
    frame.bodies.truncate(1);
    frame.bodies[0].position = DVec2::new(2.0 * time, 0.0);
    frame.bodies[0].velocity = Vec2::X * 2.0;
    frame.bodies[0].radius = radius;
    Frame { time, ..frame }
}

fn picture(style: &Style, frames: &[Frame]) -> Image {
    let mut painter = Painter::new(&place(), style, &frames[0]).unwrap();
    frames.iter().map(|frame| painter.paint(frame).clone()).last().unwrap()
}

/// Returns the difference of each pixel from the ground.
fn ink(image: &Image) -> Vec<(Vec2, f32)> {
    let paper = image.pixel(0, 0);
    let all = (0..image.height()).flat_map(|y| (0..image.width()).map(move |x| (x, y)));
    let off = |a: u8, b: u8| (f32::from(a) - f32::from(b)).abs();
    let dark = |(x, y)| {
        let Color { r, g, b, .. } = image.pixel(x, y);
        (Vec2::new(x as f32, y as f32) + 0.5, off(r, paper.r) + off(g, paper.g) + off(b, paper.b))
    };
    all.map(dark).filter(|(_, ink)| *ink > 0.0).collect()
}

fn middle(ink: &[(Vec2, f32)]) -> Vec2 {
    ink.iter().map(|(at, ink)| *at * *ink).sum::<Vec2>() / ink.iter().map(|(_, ink)| ink).sum::<f32>()
}

#[test]
fn even_the_smallest_insect_is_visible_at_its_position() {
    for projection in [Projection::Plan, Projection::Perspective] {
        let style = Style { shutter: 0.0, projection: Some(projection), ..swarming() };
        for radius in [1e-6, 0.01, 0.4] {
            let frame = alone(0.0, radius);
            let mut painter = Painter::new(&Setting { in_space: false, ..place() }, &style, &frame).unwrap();
            let want = painter.pixel(frame.bodies[0].center()).unwrap();
            let with = painter.paint(&frame).clone();
            let bare = painter.paint(&Frame { bodies: Vec::new(), ..frame.clone() }).clone();
            let all = (0..with.height()).flat_map(|y| (0..with.width()).map(move |x| (x, y)));
            let changed: Vec<Vec2> = all
                .filter(|&(x, y)| with.pixel(x, y) != bare.pixel(x, y))
                .map(|(x, y)| Vec2::new(x as f32, y as f32) + 0.5)
                .collect();
            let middle = changed.iter().sum::<Vec2>() / changed.len() as f32;
            assert!(changed.len() >= 6 && middle.distance(want) < 3.0, "{projection:?} {radius}: {middle}, not {want}");
        }
    }
}

#[test]
fn wings_are_on_both_sides_and_beat_with_time() {
    let style = Style { shutter: 0.0, ..swarming() };
    let spans: Vec<f32> = (0..20)
        .map(|k| {
            let ink = ink(&picture(&style, &[Frame { time: f64::from(k) * 0.013, ..alone(0.0, 1.0) }]));
            assert!((middle(&ink).y - 60.0).abs() < 0.5, "both sides alike");
            ink.iter().map(|(at, _)| (at.y - 60.0).abs()).fold(0.0, f32::max)
        })
        .collect();
    let (low, high) = spans.iter().fold((f32::INFINITY, 0f32), |(low, high), &span| (low.min(span), high.max(span)));
    assert!(high > 13.0 && low < 0.75 * high, "{spans:?}");
    let frame = [alone(0.0, 1.0)];
    assert_eq!(picture(&style, &frame), picture(&style, &frame));
}

#[test]
fn near_wings_are_blurred_fans_that_appear_gradually() {
    let style = Style { shutter: 0.0, projection: Some(Projection::Perspective), legend: false, ..swarming() };
    let bare = Frame { bodies: Vec::new(), ..alone(0.0, 0.1) };
    // the share of the ink that differs between moments of a beat
    let flutter = |radius: f32| {
        let first = alone(0.0, radius);
        let mut painter = Painter::new(&place(), &style, &first).unwrap();
        let paper = painter.paint(&bare).clone();
        let ink = |a: &Image, b: &Image| -> f32 {
            a.data().iter().zip(b.data()).map(|(a, b)| f32::from(a.abs_diff(*b))).sum()
        };
        let pictures: Vec<Image> =
            (0..8).map(|k| painter.paint(&Frame { time: f64::from(k) * 0.016, ..first.clone() }).clone()).collect();
        let changes: f32 = pictures.windows(2).map(|pair| ink(&pair[0], &pair[1])).sum();
        let whole: f32 = pictures.iter().map(|picture| ink(picture, &paper)).sum();
        changes / whole
    };
    let [far, near] = [0.3, 2.0].map(flutter);
    assert!(near < 0.5 * far && near > 0.0, "{near} near, {far} far");
    let steps: Vec<f32> = (0..24).map(|k| flutter(0.6 + 0.05 * k as f32)).collect();
    assert!(steps.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 0.35 * far), "{steps:?} of {far}");
}

#[test]
fn the_length_of_a_streak_is_the_way_during_the_exposure() {
    let frames: Vec<Frame> = (0..20).map(|k| alone(f64::from(k) * 0.04, 0.05)).collect();
    for shutter in [0.2f32, 0.5] {
        let ink = ink(&picture(&Style { shutter, ..swarming() }, &frames));
        let tail = ink.iter().map(|(at, _)| at.x).fold(f32::INFINITY, f32::min);
        // 2 m/s at 10 pixels per metre; the very end has faded.
        let want = 80.0 + 10.0 * 2.0 * (0.76 - shutter);
        assert!((tail - want).abs() < 2.6, "{tail}, not {want}");
    }
    // With an exposure shorter than the time to move its own length, an insect leaves no visible streak.
    let [long, short, none] =
        [0.5, 0.05, 0.0].map(|shutter| ink(&picture(&Style { shutter, ..swarming() }, &frames)).len());
    assert!(long > short && short == none, "{long}, {short}, {none}");
    // At the first moment the streak follows from the velocity.
    let first = ink(&picture(&Style { shutter: 0.5, ..swarming() }, &frames[..1]));
    assert!(first.iter().any(|(at, _)| at.x < 75.0));
}

#[test]
fn invalid_bodies_do_not_panic() {
    for (position, radius, velocity) in [
        (DVec2::NAN, 0.1, Vec2::X),
        (DVec2::splat(1e300), 0.1, Vec2::X),
        (DVec2::ZERO, f32::NAN, Vec2::X),
        (DVec2::ZERO, f32::INFINITY, Vec2::X),
        (DVec2::ZERO, 0.0, Vec2::NAN),
        (DVec2::ZERO, 1e9, Vec2::splat(1e30)),
    ] {
        let mut frame = moment(0);
        frame.bodies[0].position = position;
        frame.bodies[0].radius = radius;
        frame.bodies[0].velocity = velocity;
        for projection in [Projection::Plan, Projection::Perspective] {
            for shutter in [0.2, f32::NAN, -1.0] {
                let style = Style { projection: Some(projection), shutter, ..swarming() };
                let mut painter = Painter::new(&place(), &style, &moment(0)).unwrap();
                painter.paint(&frame);
                elements(&painter.svg(&frame));
            }
        }
    }
}
