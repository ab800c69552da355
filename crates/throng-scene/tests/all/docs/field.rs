//! The field of docs/fields.md: it leads agents, and the page shows it.

use glam::{Vec2, Vec3};
use throng::field::Field;
use throng::parameters::{Angle, parameters};
use throng_scene::{Plugins, Scene};

/// A spiral around the place (0, 0).
#[parameters]
#[derive(Debug)]
struct Spiral {
    /// Speed, m/s.
    #[parameter(default = 1.0, unit = "m/s", least = 0, most = 100)]
    speed: f32,
    /// Angle from the direction inwards to the velocity, counter-clockwise.
    #[parameter(default = Angle::degrees(70.0), unit = "°", least = -180, most = 180)]
    angle: Angle,
}

impl Field for Spiral {
    fn velocity(&self, place: Vec3, _: f64) -> Vec3 {
        let (sin, cos) = libm::sincosf(self.angle.radians());
        let inwards = -place.truncate().normalize_or_zero();
        (Vec2::new(cos, sin).rotate(inwards) * self.speed).extend(0.0)
    }
}

#[test]
fn the_scene_of_the_page_runs() -> Result<(), throng_scene::Error> {
    let mut scene: Scene = r#"
        [[group]]
        place.point = [9, 0]
        field.of.spiral = { angle = 60 }
    "#
    .parse()?;
    Plugins::new().field::<Spiral>().equip(&mut scene);
    let (mut world, _) = scene.build()?;
    (0..200).for_each(|_| world.step());
    let place = world.agents().next().expect("the agent is present").position();
    assert!(place.length() < 7.0 && place.y < -1.0, "{place}");
    Ok(())
}

#[test]
fn the_page_shows_this_field() {
    let page = include_str!("../../../../../docs/fields.md");
    super::assert_shown(page, "```rust,ignore\n", 1, include_str!("field.rs"));
}
