//! Vehicles.

use super::{angle, or};
use crate::geometry::DVec2;
use crate::scene::{self, Group, VehicleKind};
use throng::motion::{Forces, Integrator, Locomotion, Vehicle, WrapAround};

/// Returns the vehicle of a group that steers.
pub fn vehicle(group: &Group) -> Vehicle {
    let standard = Vehicle::default();
    let Some(said) = &group.vehicle else { return standard };
    Vehicle {
        mass: or(said.mass, standard.mass),
        max_force: or(said.max_force, standard.max_force),
        forces: said.forces.as_ref().map_or(standard.forces, forces),
        max_speed: or(said.max_speed, standard.max_speed),
        min_speed: or(said.min_speed, standard.min_speed),
        max_turn_rate: angle(said.turn_rate, standard.max_turn_rate),
        low_speed: or(said.low_speed, standard.low_speed),
        response: or(said.response, standard.response),
        smoothing: or(said.smoothing, standard.smoothing),
        locomotion: said.kind.map_or(standard.locomotion, |kind| match kind {
            VehicleKind::Ground => Locomotion::Ground,
            VehicleKind::Level => Locomotion::Level,
            VehicleKind::Banking => Locomotion::Banking,
        }),
        integrator: said.integrator.map_or(standard.integrator, |integrator| match integrator {
            scene::Integrator::SemiImplicit => Integrator::SemiImplicit,
            scene::Integrator::Euler => Integrator::Euler,
        }),
    }
}

fn forces(said: &scene::Forces) -> Forces {
    let standard = Forces::default();
    Forces {
        thrust: or(said.thrust, standard.thrust),
        brake: or(said.brake, standard.brake),
        side: or(said.side, standard.side),
        up: or(said.up, standard.up),
    }
}

/// Returns the sphere that agents that steer leave on one side and enter on the other.
pub fn wrap_around(said: scene::WrapAround, origin: DVec2) -> WrapAround {
    let [x, y, z] = said.center.0;
    WrapAround { center: (DVec2::new(x, y) - origin).as_vec2().extend(z as f32), radius: said.radius as f32 }
}
