//! A car drives round a route among rocks and fences, by a map of them (OpenSteer's "driving through map based
//! obstacles").

use crate::scene::SceneNames;
use glam::{DVec2, Vec2, Vec3};
use std::sync::Arc;
use throng::motion::Steering;
use throng::space::{PathDirection, Pathway, Raster};
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, TraceRecorder};
use throng::{Agent, AgentRef, Error, Rules, World};
use throng_steer::{DriveByMap, FollowPath};

/// Counts the laps of the group `car` on the path `route`, and puts stuck cars back on it.
#[derive(Clone, Debug)]
pub struct MapDrive {
    route: Arc<Pathway>,
    origin: DVec2,
    /// A car that is below this speed, m/s, for this many seconds is stuck.
    still: (f32, f64),
}

/// Returns the route of a scene.
fn route(cast: &SceneNames<'_>) -> Result<Arc<Pathway>, Error> {
    let missing =
        || Error::Shape { what: "path `route`".into(), why: "there is none, and it is where the car drives".into() };
    cast.path("route").ok_or_else(missing)
}

/// Makes the rules for a scene with a route.
pub fn rules(cast: &SceneNames<'_>) -> Result<MapDrive, Error> {
    Ok(MapDrive { route: route(cast)?, origin: cast.origin, still: (0.5, 3.0) })
}

/// The indices of the figures.
const LAPS: usize = 0;
const METRES: usize = 1;
const BUMPS: usize = 2;
const STUCK: usize = 3;
const BUMPING: usize = 4;
const STILL: usize = 5;

/// How far along the route from its last place a car is searched for, metres: it cuts corners.
const REACH: f32 = 30.0;

impl Rules for MapDrive {
    fn figures(&self) -> Vec<String> {
        ["laps", "metres", "bumps", "stuck", "bumping", "still"].map(String::from).into()
    }

    fn begin(&self, world: &mut World, _: &mut [f64]) -> Result<(), Error> {
        world.group_named("car").map(drop)
    }

    fn act(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        let step = world.settings().step;
        for car in world.members(world.group_named("car")?) {
            let Some(agent) = world.agent(car).map(AgentRef::to_agent) else { continue };
            // the distance along the route: the car cannot be far from its last place
            let (length, along) = (f64::from(self.route.length()), figures[METRES]);
            let here = (agent.position.truncate() - self.origin).as_vec2().extend(0.0);
            let near = self.route.nearest_near(here, along.rem_euclid(length) as f32, REACH);
            let ahead = (f64::from(near.along) - along + 0.5 * length).rem_euclid(length) - 0.5 * length;
            figures[METRES] = along + ahead;
            figures[LAPS] = (figures[METRES] / length).floor().max(figures[LAPS]);

            let bumps = if world.no_room(agent.position.truncate(), agent.radius).is_some() { 1.0 } else { 0.0 };
            figures[BUMPS] += f64::from(bumps > figures[BUMPING]);
            figures[BUMPING] = bumps;

            let still = agent.velocity.length() < self.still.0;
            figures[STILL] = if still { figures[STILL] + step } else { 0.0 };
            if figures[STILL] >= self.still.1 {
                let position = self.route.at(near.along).truncate().as_dvec2() + self.origin;
                let tangent = self.route.tangent_at(near.along, PathDirection::Forward);
                let heading = Some(libm::atan2f(tangent.y, tangent.x));
                world.replace(
                    car,
                    Agent { position: position.extend(0.0), heading, velocity: Default::default(), ..agent },
                )?;
                (figures[STUCK], figures[STILL]) = (figures[STUCK] + 1.0, 0.0);
            }
        }
        Ok(())
    }

    fn standing(&self, _: &World, figures: &[f64]) -> String {
        let on_lap = (figures[METRES] / f64::from(self.route.length())).fract().max(0.0) * 100.0;
        format!("{} laps and {on_lap:.0} % · {} bumps", figures[LAPS], figures[BUMPS])
    }
}

/// Side of the cells of the map, metres.
const CELL: f32 = 1.0;
/// How far the map extends beyond the route, metres.
const RIM: f64 = 20.0;

/// Makes the driver for a scene with a route. Solid surfaces become its map.
pub fn driver(cast: &SceneNames<'_>) -> Result<BoxedBehaviour, Error> {
    let route = route(cast)?;
    let ends = route.segments().iter().map(|segment| segment.end.truncate().as_dvec2() + cast.origin);
    let ends: Vec<DVec2> = ends.collect();
    let low = ends.iter().copied().fold(DVec2::INFINITY, DVec2::min) - RIM;
    let high = ends.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max) + RIM;
    let (local, barriers) = (|at: DVec2| (at - cast.origin).as_vec2(), cast.barriers()?);
    // walls are thin: a cell is solid where one runs through it
    let solid = |at: Vec2| barriers.0.iter().any(|barrier| barrier.surface.query(at.extend(0.0)).distance < 0.5 * CELL);
    let map = Raster::of(local(low), local(high), CELL, solid)?;
    let follow = FollowPath { horizon: AHEAD, ..FollowPath::new(Pathway::clone(&route)) };
    Ok(DriveByMap::new(Arc::new(map), Drive { follow }).into())
}

/// How far ahead the driver looks along the route, seconds.
const AHEAD: f32 = 1.2;
/// The part of its force by which it turns and brakes at most.
const GRIP: f32 = 0.7;
/// The part of its force on which it counts in bends.
const CORNERS: f32 = 0.4;
/// Least distance along the route to the point where the car rejoins it, metres.
const NEAREST: f32 = 15.0;
/// Least speed on the way back to the route, m/s.
const SLOW: f32 = 3.0;
/// Distance along the route between the points it checks for bends, metres.
const EVERY: f32 = 4.0;

/// Follows a path, as fast as its bends let it.
#[derive(Clone, Debug)]
struct Drive {
    follow: FollowPath,
}

impl Behaviour for Drive {
    fn memory(&self) -> usize {
        self.follow.memory()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let (side, most) = (view.motion.basis.side, GRIP * view.vehicle.max_force);
        let turn = self.follow.steer(view, memory, why).map(|said| said.force.dot(side).clamp(-most, most));
        let along = memory.get(1).copied().unwrap_or(0.0);
        let back = if turn.is_some() { self.speed_back(along, view) } else { f32::INFINITY };
        let speed = self.speed_in_bends(along, view).min(back);
        let push = view.reach(view.velocity() + view.forward() * (speed - view.motion.speed())).force;
        // neither force may outweigh the other
        Some((push.clamp_length_max(most) + side * turn.unwrap_or(0.0)).into())
    }

    fn check(&self) -> Result<(), Error> {
        self.follow.check()
    }
}

/// Returns the sideways acceleration that the car counts on in bends, m/s².
fn grip(view: &SteeringInput<'_>) -> f32 {
    CORNERS * view.vehicle.max_force / view.vehicle.mass
}

impl Drive {
    /// Returns the speed from which the car can still brake for every bend ahead.
    fn speed_in_bends(&self, along: f32, view: &SteeringInput<'_>) -> f32 {
        let (path, grip) = (&self.follow.path, grip(view));
        let stopping = view.motion.speed() * view.motion.speed() / (2.0 * grip);
        let count = ((stopping + 4.0 * EVERY) / EVERY).ceil() as u32;
        let bend = |k: u32| {
            let at = k as f32 * EVERY;
            let direction = |ahead: f32| -> Vec3 { path.tangent_at(along + ahead, PathDirection::Forward) };
            let radius = path.radius_at(along + at, PathDirection::Forward).max(1.0);
            let cosine = direction(at).dot(direction(at + EVERY)).clamp(-1.0, 1.0);
            // the arc that begins and ends at a distance of the tube's radius from the corner
            let widest = radius / libm::tanf(0.5 * libm::acosf(cosine)).max(1e-3);
            (grip * widest + 2.0 * grip * at).sqrt()
        };
        (0..count).map(bend).fold(view.vehicle.max_speed, f32::min)
    }

    /// Returns the speed at which the car rejoins the route on one arc.
    fn speed_back(&self, along: f32, view: &SteeringInput<'_>) -> f32 {
        let offset = view.to(self.follow.path.at(along + (view.motion.speed() * AHEAD).max(NEAREST)));
        let aside = offset.reject_from_normalized(view.forward()).length();
        let behind = offset.dot(view.forward()) < 0.0;
        let radius = if behind { 0.5 * offset.length() } else { offset.length_squared() / (2.0 * aside).max(1e-3) };
        (grip(view) * radius).sqrt().max(SLOW)
    }
}
