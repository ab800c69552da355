//! The scenes of the gallery fill their pictures, and no agent leaves them.

use glam::Vec2;
use throng_draw::{Painter, Style};
use throng_record::{Frame, moment};
use throng_scene::gallery;

/// The least share of the width or the height of the picture that agents take up on average.
const LEAST: f32 = 0.4;
/// Where there are fewer agents, the picture shows their paths.
const FEW: usize = 6;
/// Seconds between moments that are looked at.
const PERIOD: f64 = 0.2;

/// A box of pixels.
#[derive(Clone, Copy)]
struct Pixels([Vec2; 2]);

impl Pixels {
    const NONE: Self = Self([Vec2::INFINITY, Vec2::NEG_INFINITY]);

    fn with(self, point: Vec2) -> Self {
        Self([self.0[0].min(point), self.0[1].max(point)])
    }

    /// Returns the greater one of the shares of the width and of the height.
    fn share(self, size: Vec2) -> f32 {
        ((self.0[1] - self.0[0]) / size).max_element().max(0.0)
    }
}

/// Returns the mean share of the picture that agents take up, and the share of the moments in which an agent is
/// outside of it.
fn framing(name: &str) -> (f32, f32) {
    let scene = gallery::scene(name).unwrap();
    let (mut world, built) = scene.build().unwrap();
    let [width, height] = scene.view.size.unwrap_or([960, 720]);
    let style = Style { width, height, ..Style::said(&scene) };
    let size = Vec2::new(width as f32, height as f32);
    let mut frame = Frame::default();
    moment::capture(&world, &mut frame);
    let mut painter = Painter::new(&moment::setting(&world, &built, name), &style, &frame).unwrap();
    let (mut shares, mut moments, mut outside, mut paths) = (0.0, 0.0, 0.0, Pixels::NONE);
    let mut most = 0;
    let mut next = 0.0;
    while !scene.time.over(&world) {
        if world.time() >= next - 1e-9 {
            next += PERIOD;
            moment::capture(&world, &mut frame);
            painter.follow(&frame);
            let pixels: Vec<Option<Vec2>> = frame.bodies.iter().map(|body| painter.pixel(body.center())).collect();
            let seen = |pixel: &Option<Vec2>| {
                pixel.is_some_and(|pixel| pixel.cmpge(Vec2::ZERO).all() && pixel.cmple(size).all())
            };
            if !pixels.is_empty() {
                moments += 1.0;
                outside += f32::from(u8::from(!pixels.iter().all(seen)));
                shares += pixels.iter().flatten().fold(Pixels::NONE, |all, &pixel| all.with(pixel)).share(size);
                paths = pixels.iter().flatten().fold(paths, |all, &pixel| all.with(pixel));
                most = most.max(pixels.len());
            }
        }
        world.step();
    }
    (if most < FEW { paths.share(size) } else { shares / moments }, outside / moments)
}

#[test]
#[ignore = "runs all scenes of the gallery"]
fn slow_agents_fill_the_pictures_of_the_gallery() {
    let mut wrong = Vec::new();
    for name in gallery::names() {
        let (share, outside) = framing(name);
        if share < LEAST || outside > 0.0 {
            wrong.push(format!(
                "{name}: agents take up {share:.2} of the picture, and leave it {outside:.2} of the time"
            ));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
