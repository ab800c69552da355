//! Makes a film of half a minute of four scenes of the gallery: a circle of people, a street with two streams, a flock,
//! and a swarm: `cargo run --release -p throng-draw --example reel -- reel.mp4`. A second argument is the size, such as
//! 1920x1080; a third one the seconds of each part.

use glam::DVec3;
use throng_draw::{CameraKey, Motion, Painter, Projection, Style, sink};
use throng_record::{Frame, moment};
use throng_scene::{Camera, gallery};

/// Pictures per second.
const RATE: f64 = 25.0;

/// A part of the film.
struct Part {
    scene: &'static str,
    /// The time in the scene at which the part begins, seconds.
    from: f64,
    /// The camera at the times of the part.
    keys: Vec<CameraKey>,
    trails: f32,
}

fn key(time: f64, eye: [f64; 3], target: [f64; 3]) -> CameraKey {
    CameraKey { time, eye: eye.into(), target: DVec3::from(target), field_of_view: None, cut: false }
}

fn parts(seconds: f64) -> Vec<Part> {
    let s = seconds;
    let part = |scene, from, trails, keys: &[CameraKey]| {
        let keys = keys.iter().map(|key| CameraKey { time: from + key.time, ..*key }).collect();
        Part { scene, from, keys, trails }
    };
    vec![
        part(
            "circle",
            0.5,
            0.8,
            &[key(0.0, [-8.0, -12.0, 5.5], [0.0, 0.0, 0.6]), key(s, [1.5, -9.5, 2.6], [0.0, 0.0, 0.8])],
        ),
        part(
            "corridor",
            12.0,
            0.0,
            &[key(0.0, [-13.0, -8.5, 4.6], [-2.0, 0.0, 0.8]), key(s, [-5.0, -7.5, 2.4], [2.0, 0.0, 0.9])],
        ),
        part(
            "boids",
            4.0,
            1.2,
            &[key(0.0, [-70.0, -50.0, 26.0], [-20.0, 0.0, 20.0]), key(s, [-10.0, -52.0, 12.0], [8.0, 0.0, 21.0])],
        ),
        part(
            "swarm-aggregation",
            6.0,
            0.0,
            &[key(0.0, [-2.2, -2.9, 2.5], [0.0, 0.0, 1.95]), key(s, [1.8, -2.8, 1.6], [0.0, 0.0, 1.95])],
        ),
    ]
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let path = words.next().unwrap_or_else(|| "reel.mp4".into());
    let size = words.next().unwrap_or_else(|| "1280x720".into());
    let seconds: f64 = words.next().map_or(Ok(7.5), |text| text.parse())?;
    let (width, height) = size.split_once('x').ok_or("the size is width x height, such as 1280x720")?;
    let mut film = sink::sink(&path, RATE)?;
    for part in parts(seconds) {
        let mut scene = gallery::scene(part.scene)?;
        scene.view.camera = Some(Camera::default());
        let style = Style::said(&scene);
        let viewpoint = throng_draw::Viewpoint { motion: Motion::Keys(part.keys), ..style.viewpoint };
        let style = Style {
            width: width.parse()?,
            height: height.parse()?,
            projection: Some(Projection::Perspective),
            viewpoint,
            trails: part.trails,
            goals: false,
            legend: false,
            ..style
        };
        let (mut world, built) = scene.build()?;
        let mut frame = Frame::default();
        moment::capture(&world, &mut frame);
        let mut painter = Painter::new(&moment::setting(&world, &built, &scene.title), &style, &frame)?;
        let mut shown = 0;
        while f64::from(shown) < seconds * RATE {
            world.step();
            moment::capture(&world, &mut frame);
            if frame.time < part.from + f64::from(shown) / RATE {
                painter.follow(&frame);
            } else {
                film.push(painter.paint(&frame))?;
                shown += 1;
            }
        }
    }
    film.finish()?;
    Ok(())
}
