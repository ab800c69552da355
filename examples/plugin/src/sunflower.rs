//! The scene `sunflower`. Its obstacles are computed instead of listed in a file.

use throng::motion::Vehicle;
use throng_scene::{Circle, DiscPlace, GivenParameters, Group, Number, Obstacle, Scene, Shape, Steer, Time, Until};

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
    let parts = [
        Steer::named("avoid_obstacles"),
        Steer::named("tether").with("to", vec![0.0, 0.0]).with("length", 10.0),
        Steer::named("weave"),
    ];
    let people = Group {
        name: "people".into(),
        count: Some(12),
        place: DiscPlace { radius: 9.0, gap: 0.5, ..DiscPlace::default() }.into(),
        heading: Some(Number::Uniform([0.0, 360.0])),
        guard: Some(true),
        vehicle: Some(GivenParameters::of(&Vehicle { max_speed: 1.5, ..Vehicle::default() })),
        steer: Some(Steer::combining("priority", parts)),
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
