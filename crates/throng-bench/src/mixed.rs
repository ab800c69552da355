//! Crowds and flocks with a few agents of other kinds: vehicles and doors, pedestrians below birds.

use crate::{Crowd, Flock};
use throng::motion::{Holonomic, Motor};
use throng::{Agent, AgentRef, Body, Error, Group, Keyframe, Script, World};

/// One of this many agents is a vehicle.
const VEHICLE: usize = 500;
/// One of this many agents is a door.
const DOOR: usize = 2000;

/// Turns a few agents into vehicles, 4.2 by 1.8 m, that turn slowly, and into doors that swing.
///
/// # Errors
/// Those of [`World::replace`].
pub fn mix(world: &mut World) -> Result<(), Error> {
    let all = world.agent_ids();
    for &id in all.iter().skip(VEHICLE / 2).step_by(VEHICLE) {
        let Some(agent) = world.agent(id).map(AgentRef::to_agent) else { continue };
        let car = Agent { motor: turning(&agent, 0.5), ..agent };
        world.replace(id, car.with_body(Body::rectangle(4.2, 1.8)))?;
    }
    for &id in all.iter().skip(DOOR / 4).step_by(DOOR) {
        let Some(agent) = world.agent(id).map(AgentRef::to_agent) else { continue };
        let at = agent.position.truncate();
        let keyframes = [0.0, std::f64::consts::FRAC_PI_2, 0.0].into_iter().zip([0.0, 2.0, 4.0]);
        let keyframes = keyframes.map(|(heading, time)| Keyframe { time, at, heading }).collect();
        let script = Some(world.add_script(Script { keyframes, repeat: true })?);
        let door = Agent { script, avoids: 0, motor: turning(&agent, 3.0), ..agent };
        world.replace(id, door.with_body(Body::rectangle(2.0, 0.3)))?;
    }
    Ok(())
}

/// Returns the motor of an agent with this maximum turn rate, radians a second.
fn turning(agent: &Agent, max_turn_rate: f32) -> Motor {
    let max_speed = agent.motor.max_speed();
    Holonomic { max_speed, max_turn_rate, ..Holonomic::default() }.into()
}

/// One of this many agents in the scene of a flock is a pedestrian.
pub const PEDESTRIAN: usize = 10;

/// Returns the world of a flock with pedestrians on the ground below it, in a group of their own, with or without the
/// guard.
///
/// # Errors
/// Those of [`Flock::world`] and [`Crowd::world`].
pub fn flock_in_scene(flock: &Flock, pedestrians: &Crowd, guard: bool) -> Result<World, Error> {
    let mut world = flock.world(guard)?;
    let group = Group { guard, ..Crowd::interaction() };
    pedestrians.add_to(&mut world, group, Holonomic::default().max_acceleration)?;
    Ok(world)
}
