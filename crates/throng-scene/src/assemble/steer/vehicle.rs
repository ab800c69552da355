//! Vehicles.

use crate::file::Path;
use crate::scene::Group;
use throng::motion::Vehicle;

/// Returns the vehicle of a group that steers. The check of the group has refused what cannot be read.
pub fn vehicle(group: &Group) -> Vehicle {
    group.vehicle.as_ref().and_then(|given| given.read(&Path::default()).ok()).unwrap_or_default()
}
