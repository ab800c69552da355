//! Vehicles.

use crate::file::Path;
use crate::geometry::DVec2;
use crate::scene::{self, Group};
use throng::motion::{Vehicle, WrapAround};

/// Returns the vehicle of a group that steers. The check of the group has refused what cannot be read.
pub fn vehicle(group: &Group) -> Vehicle {
    group.vehicle.as_ref().and_then(|given| given.read(&Path::default()).ok()).unwrap_or_default()
}

/// Returns the sphere that agents that steer leave on one side and enter on the other.
pub fn wrap_around(said: scene::WrapAround, origin: DVec2) -> WrapAround {
    let [x, y, z] = said.center.0;
    WrapAround { center: (DVec2::new(x, y) - origin).as_vec2().extend(z as f32), radius: said.radius as f32 }
}
