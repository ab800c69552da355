//! The scene `sunflower`. Its obstacles are computed instead of listed in a file.

use throng_scene::steer::{Priority, Target, Tether};
use throng_scene::{Circle, DiscPlace, Group, Number, Obstacle, Place, Scene, Shape, Steer, Time, Until, Vehicle};

/// The golden angle between consecutive seeds of a sunflower, radians.
const GOLDEN: f64 = 2.399_963;

/// Builds a scene in which agents weave among posts that are arranged like the seeds of a sunflower.
pub fn scene() -> Scene {
    let post = |k: u32| {
        let (sin, cos) = libm::sincos(f64::from(k) * GOLDEN);
        let far = 2.2 * libm::sqrt(f64::from(k));
        let center = [far * cos, far * sin].map(|x| libm::round(x * 1e3) / 1e3);
        Obstacle::from(Shape::Circle(Circle { center, radius: 0.3 }))
    };
    let parts = vec![
        Steer::named("avoid_obstacles"),
        Tether { to: Target::At([0.0, 0.0].into()), length: 10.0 }.into(),
        Steer::named("weave"),
    ];
    let people = Group {
        name: "people".into(),
        count: Some(12),
        place: Place::Disc(DiscPlace { radius: 9.0, gap: 0.5, ..DiscPlace::default() }),
        heading: Some(Number::Uniform([0.0, 360.0])),
        guard: Some(true),
        vehicle: Some(Vehicle { max_speed: Some(1.5), ..Vehicle::default() }),
        steer: Some(Priority::from(parts).into()),
        ..Group::default()
    };
    Scene {
        title: "Sunflower".into(),
        time: Time { until: Until::Limit, limit: 120.0, ..Time::default() },
        obstacles: (1..25).map(post).collect(),
        groups: vec![people],
        ..Scene::default()
    }
}
