//! Wrapping around.

use crate::geometry::DVec2;
use crate::scene;
use throng::motion::WrapAround;

/// Returns the sphere that agents that steer leave on one side and enter on the other.
pub fn wrap_around(said: scene::WrapAround, origin: DVec2) -> WrapAround {
    let [x, y, z] = said.center.0;
    WrapAround { center: (DVec2::new(x, y) - origin).as_vec2().extend(z as f32), radius: said.radius as f32 }
}
