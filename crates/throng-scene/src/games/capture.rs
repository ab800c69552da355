//! One agent runs for a base, four defend it (OpenSteer's "capture the flag").

use super::{on_ring, touch};
use crate::scene::SceneNames;
use glam::{DVec2, Vec2, Vec3};
use throng::motion::Steering;
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, Target, TraceRecorder};
use throng::{Agent, AgentRef, Error, Rules, World};
use throng_steer::{AvoidObstacles, Prediction, Pursue, SlipThrough};

/// The only agent of the group `seeker` runs for the base at the origin. A defender of the group `defenders` that
/// touches it has tagged it. Beyond the field the seeker is out. Some seconds after the end of a run all agents start
/// again on a ring around the base.
#[derive(Clone, Copy, Debug)]
pub struct CaptureTheFlag {
    /// Radius of the base, metres.
    pub base: f64,
    /// Inner and outer radius of the ring, metres.
    pub ring: (f64, f64),
    /// The start speed of all agents, m/s.
    pub start_speed: f32,
    /// Radius of the field, metres. Beyond it the seeker is out.
    pub field: f64,
    /// Distance from obstacles at the start, in radii.
    pub clearance: f32,
    /// Seconds from the end of a run to the start of the next.
    pub pause: f64,
}

impl Default for CaptureTheFlag {
    fn default() -> Self {
        Self { base: 1.5, ring: (30.0, 40.0), start_speed: 3.0, field: 60.0, clearance: 5.0, pause: 4.0 }
    }
}

/// The indices of the figures.
const STATE: usize = 0;
const ENDED: usize = 1;
const RUNS: usize = 2;
const TAGS: usize = 3;
const CAPTURES: usize = 4;
const OUTS: usize = 5;

/// The values of [`STATE`].
const RUNNING: f64 = 0.0;
const TAGGED: f64 = 1.0;
const AT_GOAL: f64 = 2.0;
const OUT: f64 = 3.0;

/// How near a defender must be to tag, beyond contact, as a part of the sum of the radii: the guard keeps bodies from
/// touching.
const REACH: f64 = 0.05;

impl Rules for CaptureTheFlag {
    fn figures(&self) -> Vec<String> {
        ["state", "ended", "runs", "tags", "captures", "outs"].map(String::from).into()
    }

    fn begin(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        self.start(world, figures)
    }

    fn act(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        if figures[STATE] != RUNNING {
            let over = world.time() - figures[ENDED] >= self.pause;
            return if over { self.start(world, figures) } else { Ok(()) };
        }
        let defenders = world.members(world.group_named("defenders")?);
        for seeker in world.members(world.group_named("seeker")?) {
            let Some(agent) = world.agent(seeker).map(AgentRef::to_agent) else { continue };
            let end = if defenders.iter().any(|&defender| touch(world, defender, seeker, REACH)) {
                (TAGGED, TAGS)
            } else if agent.position.length() <= self.base + f64::from(agent.radius) {
                (AT_GOAL, CAPTURES)
            } else if agent.position.length() > self.field {
                (OUT, OUTS)
            } else {
                continue;
            };
            (figures[STATE], figures[ENDED]) = (end.0, world.time());
            figures[end.1] += 1.0;
        }
        Ok(())
    }

    fn standing(&self, _: &World, figures: &[f64]) -> String {
        let state = match figures[STATE] {
            TAGGED => "tagged",
            AT_GOAL => "at the goal",
            OUT => "out of the field",
            _ => "running",
        };
        format!("{state} · {} captured, {} tagged", figures[CAPTURES], figures[TAGS])
    }
}

impl CaptureTheFlag {
    /// Starts a run: all agents on the ring, with random headings.
    fn start(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        (figures[STATE], figures[RUNS]) = (RUNNING, figures[RUNS] + 1.0);
        let seekers = world.members(world.group_named("seeker")?);
        let defenders = world.members(world.group_named("defenders")?);
        for (id, k) in seekers.into_iter().chain(defenders).zip(0..) {
            let Some(agent) = world.agent(id).map(AgentRef::to_agent) else { continue };
            let position = on_ring(world, 1000 * k, DVec2::ZERO, self.ring, agent.radius * self.clearance);
            let heading = world.draw(1000 * k + 999) * std::f32::consts::TAU;
            let (sin, cos) = libm::sincosf(heading);
            let velocity = Vec2::new(cos, sin) * self.start_speed;
            world.replace(id, Agent { position: position.extend(0.0), heading: Some(heading), velocity, ..agent })?;
        }
        Ok(())
    }
}

/// Whether the run is in progress, as players see it.
fn runs(view: &SteeringInput<'_>) -> bool {
    view.figures.get(STATE).is_none_or(|&state| state == RUNNING)
}

/// Returns the steering that brakes at `rate` per second.
fn brake(view: &SteeringInput<'_>, rate: f32) -> Option<Steering> {
    Some(view.vehicle.brake(&view.motion, rate, view.seconds).into())
}

/// Runs for the base, around obstacles and past defenders. While the corridor is clear and the base is straight ahead,
/// it looks farther ahead.
#[derive(Clone, Debug)]
struct Seeker {
    slip: SlipThrough,
    near: AvoidObstacles,
    far: AvoidObstacles,
}

/// Cosine of the angle within which a direction counts as straight ahead.
const STRAIGHT: f32 = 0.98;

/// Makes the seeker for a scene with defenders.
pub fn seeker(cast: &SceneNames<'_>) -> Result<BoxedBehaviour, Error> {
    let base = Target::Point(cast.place(0.0, 0.0));
    let slip = SlipThrough::new(base).past(cast.group("defenders")?);
    let near = avoidance(cast, base, 0.9)?;
    let far = AvoidObstacles { horizon: 2.0, ..near.clone() };
    Ok(Seeker { slip, near, far }.into())
}

impl Behaviour for Seeker {
    fn memory(&self) -> usize {
        self.near.memory()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        if !runs(view) {
            return brake(view, 0.75);
        }
        let way = self.slip.target.find(view).map_or(Vec3::ZERO, |mark| view.to(mark.position));
        let straight = way.normalize_or_zero().dot(view.forward()) > STRAIGHT;
        let farther = straight && way.length() > self.far.horizon * view.motion.speed() && self.slip.is_clear(view);
        let avoid = if farther { &self.far } else { &self.near };
        avoid.steer(view, memory, why).or_else(|| self.slip.steer(view, &mut [], why))
    }

    fn check(&self) -> Result<(), Error> {
        self.slip.check().and(self.far.check())
    }
}

/// Pursues the seeker, around obstacles, to where it will be before it reaches the base.
#[derive(Clone, Debug)]
struct Defender {
    seeker: Target,
    base: Vec3,
    avoid: AvoidObstacles,
}

/// The maximum prediction time of a defender, as a part of the seeker's time to the base.
const AHEAD: f32 = 0.9;

/// Makes a defender for a scene with a seeker.
pub fn defender(cast: &SceneNames<'_>) -> Result<BoxedBehaviour, Error> {
    let seeker = cast.agent("seeker", 0)?;
    Ok(Defender { seeker, base: cast.place(0.0, 0.0), avoid: avoidance(cast, seeker, 0.9)? }.into())
}

impl Behaviour for Defender {
    fn memory(&self) -> usize {
        self.avoid.memory()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        if !runs(view) {
            return brake(view, 0.75);
        }
        let seeker = self.seeker.find(view)?;
        let speed = seeker.velocity.length().max(f32::MIN_POSITIVE);
        let most = (AHEAD * seeker.position.distance(self.base) / speed).min(60.0);
        let pursue = Pursue { quarry: self.seeker, prediction: Prediction::Cases { most } };
        self.avoid.steer(view, memory, why).or_else(|| pursue.steer(view, &mut [], why))
    }

    fn check(&self) -> Result<(), Error> {
        self.avoid.check()
    }
}

/// Returns the avoidance of the solid surfaces of a scene.
fn avoidance(cast: &SceneNames<'_>, towards: Target, horizon: f32) -> Result<AvoidObstacles, Error> {
    Ok(AvoidObstacles { towards, horizon, ..AvoidObstacles::from(cast.barriers()?) })
}
