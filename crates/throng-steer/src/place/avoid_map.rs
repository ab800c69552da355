//! Obstacle avoidance on a map of cells: OpenSteer's "driving through map based obstacles".

use glam::{Vec2, Vec3};
use std::f32::consts::PI;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::parameters::{GroundPlace, Value, parameters};
use throng::space::Raster;
use throng::steer::{Barriers, Behaviour, BoxedBehaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Avoids obstacles by a map of them, as OpenSteer's cars do.
///
/// Turns and brakes the motion of a part where the way is not free: for fast vehicles that turn in wide circles. From
/// these parameters a [`DriveByMap`] is made, with a map of the obstacles.
///
/// ```
/// use glam::{Vec2, Vec3};
/// use throng::space::surface::{SeenFrom, Sphere};
/// use throng::steer::{Barriers, BoxedBehaviour};
/// use throng_steer::{AvoidMap, MoveForward};
///
/// let obstacles = Barriers::default().with(Sphere::new(Vec3::X * 9.0, 2.0)?, SeenFrom::Outside);
/// let of = MoveForward { part: 1.0 };
/// let drive = AvoidMap { obstacles, cell: 0.5, ..AvoidMap::new(Vec2::splat(-30.0), Vec2::splat(30.0), of) };
/// let drive: BoxedBehaviour = drive.try_into()?;
/// # Ok::<(), throng::Error>(())
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct AvoidMap {
    /// The obstacles.
    #[parameter(absent = "everything")]
    pub obstacles: Barriers,
    /// The corner of the map with the least coordinates; everything outside the map is solid.
    #[parameter(required, from = GroundPlace)]
    pub min: Vec2,
    /// The corner with the greatest coordinates.
    #[parameter(required, from = GroundPlace)]
    pub max: Vec2,
    /// Side of its square cells, metres; a cell is solid if an obstacle is nearer to its centre than half of that. There
    /// are at most 1,000,000 cells in all.
    #[parameter(default = 1.0, unit = "m", above = 0)]
    pub cell: f32,
    /// How far ahead it looks at top speed, seconds.
    #[parameter(default = HORIZON, unit = "s", above = 0)]
    pub horizon: f32,
    /// Extent of its corridor beyond its body, to either side at top speed, metres.
    #[parameter(default = MARGIN, unit = "m", least = 0)]
    pub margin: f32,
    /// Whether it predicts its motion along its present arc; else straight ahead.
    #[parameter(default = true)]
    pub curved: bool,
    /// The behaviour of the part.
    #[parameter(required)]
    pub of: BoxedBehaviour,
}

impl AvoidMap {
    /// Returns the map of the obstacles.
    fn map(&self) -> Result<Raster, Error> {
        let cells = ((self.max - self.min).as_dvec2() / f64::from(self.cell)).ceil();
        if !(cells.min_element() >= 1.0 && cells.element_product() <= MOST_CELLS) {
            let count = format!("{} by {} cells; there must be 1 to {MOST_CELLS} in all", cells.x, cells.y);
            let why = format!("{count}: set min and max, corners, or a greater cell");
            return Err(Error::Shape { what: "the map".into(), why });
        }
        let near = 0.5 * self.cell;
        let solid = |place: Vec2| self.obstacles.ahead(place.extend(0.0), Vec3::ZERO, near, 0.0).is_some();
        Raster::of(self.min, self.max, self.cell, solid)
    }
}

impl TryFrom<AvoidMap> for BoxedBehaviour {
    type Error = Error;

    fn try_from(said: AvoidMap) -> Result<Self, Error> {
        said.check_limits()?;
        let map = Arc::new(said.map()?);
        let AvoidMap { horizon, margin, curved, of, .. } = said;
        Ok(DriveByMap { map, of, horizon, margin, curved }.into())
    }
}

/// The most cells of a map.
const MOST_CELLS: f64 = 1e6;
/// OpenSteer's look-ahead at top speed, seconds.
const HORIZON: f32 = 2.1;
/// OpenSteer's extent of the corridor at top speed, metres.
const MARGIN: f32 = 1.5;

/// Follows the steering of a part, and turns and brakes where a map is solid: for fast vehicles that turn in wide
/// circles. [`AvoidMap`] makes the map from obstacles.
///
/// It scans the corridor that the body will sweep along its present arc; the corridor is wider at a higher speed. On
/// each side of the corridor it casts four diverging rays, the wings. It turns to a side of the corridor that is free;
/// if none is, to the side with more room; and if both sides do, to the side that the part steers to. It keeps to the
/// chosen side for a while. It never goes faster than it can stop before what it sees.
///
/// ```
/// use glam::{Vec2, Vec3};
/// use std::sync::Arc;
/// use throng::motion::Motion;
/// use throng::space::Raster;
/// use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};
/// use throng_steer::{DriveByMap, Seek};
///
/// let rock = |at: Vec2| at.distance(Vec2::new(3.5, 0.5)) < 2.0;
/// let map = Raster::of(Vec2::splat(-30.0), Vec2::splat(30.0), 0.5, rock)?;
/// let drive = DriveByMap::new(Arc::new(map), Seek { target: Target::Point(Vec3::X * 20.0) });
/// let view = SteeringInput { motion: Motion::moving(Vec3::ZERO, Vec3::X), ..SteeringInput::default() };
/// let steering = drive.steer(&view, &mut [0.0; 2], &mut TraceRecorder::default()).expect("a rock is in its way");
/// assert!(steering.force.y < 0.0, "there is more room on the right");
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct DriveByMap {
    /// The solid cells, in the coordinates of the [`SteeringInput`].
    pub map: Arc<Raster>,
    /// The part.
    pub of: BoxedBehaviour,
    /// How far ahead it scans at the top speed, seconds; little more than half of that at low speed, but at least 3 m.
    /// Limit: > 0.
    pub horizon: f32,
    /// How much farther than the body the corridor reaches to either side at the top speed, metres; less than half of
    /// that at low speed. Limit: >= 0.
    pub margin: f32,
    /// Whether the corridor follows the present arc; otherwise it leads straight ahead.
    pub curved: bool,
}

impl DriveByMap {
    /// Returns the behaviour with OpenSteer's numbers.
    pub fn new(map: Arc<Raster>, of: impl Into<BoxedBehaviour>) -> Self {
        Self { map, of: of.into(), horizon: HORIZON, margin: MARGIN, curved: true }
    }
}

/// Least reach of the scan, metres.
const LEAST_REACH: f32 = 3.0;
/// Part of the look-ahead time that is left at low speed.
const SHORT: f32 = 4.0 / 7.0;
/// Part of the margin that is left at low speed.
const NARROW: f32 = 0.4;
/// The greatest angle that an arc turns, radians.
const MOST_TURN: f32 = PI / 3.0;
/// Number of rays of a wing.
const RAYS: u8 = 4;
/// How much the rays of a wing diverge: metres aside for every metre ahead, at speed 0 and at the top speed.
const SPREAD: (f32, f32) = (0.3, 0.06);
/// Part of the braking force that the stopping distance counts on; the rest is in reserve.
const RESERVE: f32 = 0.7;
/// Part of the reach beyond which there is time: the vehicle follows its part, but goes no faster than it can stop.
const FAR: f32 = 0.85;
/// Part of the tightest turn above which a turn counts as tight.
const TIGHT: f32 = 0.9;
/// Difference of the free distances of the two sides from which on the sides differ, cells.
const ALIKE: f32 = 5.0;
/// Difference of the free rays of the two wings from which on the wings differ.
const RAYS_ALIKE: f32 = 0.5;
/// How long the vehicle keeps to a side, seconds.
const KEEPS: f32 = 0.7;
/// Part of the top speed at which the vehicle creeps on where nothing is free.
const SLOW: f32 = 0.12;
/// Parts of the force for braking and for turning: together they are the whole force.
const BRAKES: f32 = 0.6;
const GRIP: f32 = 0.8;

/// The result of a scan. The left side comes first.
#[derive(Clone, Copy, Debug)]
struct MapScan {
    /// Reach of the scan, metres.
    reach: f32,
    /// Free distance of each side of the corridor; infinite if all of the side is free.
    free: [f32; 2],
    /// Number of free rays of each wing; a ray that hits counts by the free part of its length.
    room: [f32; 2],
}

impl Behaviour for DriveByMap {
    /// How many seconds the vehicle still keeps to a side, and the side; then the words of the part.
    fn memory(&self) -> usize {
        2 + self.of.words()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let (own, mut rest) = memory.split_at_mut_checked(2)?;
        let [left, kept] = own else { return None };
        *left = (*left - view.seconds).max(0.0);
        let chosen = self.of.steer_as(0, view, &mut rest, why);
        let (side, forward) = (view.motion.basis.side, view.forward());
        let (hint, gain) = chosen.map_or((0.0, 0.0), |chosen| (chosen.force.dot(side), chosen.force.dot(forward)));
        let scan = self.scan(view, why);
        let nearest = scan.free[0].min(scan.free[1]);
        let speed = view.motion.speed();
        let brakes = RESERVE * BRAKES * view.vehicle.max_braking();
        let stops = (2.0 * brakes * (nearest - view.radius).max(0.0)).sqrt();
        // do not turn back to what was just avoided
        let back = if *left > 0.0 { (hint * *kept).min(0.0) * *kept } else { 0.0 };
        let chosen = chosen.map(|chosen| Steering { force: chosen.force - side * back, ..chosen });
        if nearest.is_infinite() {
            // between two walls the speed is limited to half the top speed
            let narrow = scan.room[0].max(scan.room[1]) < 1.0 && speed > 0.5 * view.vehicle.max_speed;
            return if narrow { Some(self.at_speed(view, 0.0, 0.5 * view.vehicle.max_speed, 0.0)) } else { chosen };
        }
        if nearest > FAR * scan.reach {
            let along = self.at_speed(view, 0.0, stops, 0.0).force.dot(forward);
            // a sideways force beyond the limit must not drown the braking force
            let force = chosen.map_or(Vec3::ZERO, |chosen| chosen.force.clamp_length_max(view.vehicle.max_force));
            return Some((force + forward * (along - force.dot(forward)).min(0.0)).into());
        }
        if *left <= 0.0 {
            *kept = self.choose(&scan, hint, bend(view));
            *left = KEEPS;
        }
        // turn more the nearer the obstacle is
        let urgency = (1.5 * (1.0 - nearest / scan.reach)).clamp(0.3, 1.0);
        Some(self.at_speed(view, *kept * urgency, stops, gain))
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.of.fields(see);
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("horizon", self.horizon)?;
        Error::unless(self.margin >= 0.0 && self.margin.is_finite(), "margin", self.margin, "0 or more and finite")?;
        self.of.check()
    }
}

impl DriveByMap {
    /// Scans the corridor and the wings along the present arc.
    fn scan(&self, view: &SteeringInput<'_>, why: &mut TraceRecorder<'_>) -> MapScan {
        let (motion, cell) = (&view.motion, self.map.cell());
        let part = (motion.speed() / view.vehicle.max_speed).min(1.0);
        let mix = |(rest, top): (f32, f32)| rest + (top - rest) * part;
        let curvature = if self.curved { motion.curvature.dot(motion.basis.side) } else { 0.0 };
        let reach = (motion.speed() * self.horizon * mix((SHORT, 1.0))).max(LEAST_REACH) + view.radius;
        let reach = reach.min(MOST_TURN / curvature.abs().max(f32::MIN_POSITIVE));
        let width = view.radius + self.margin * mix((NARROW, 1.0));
        let solid = |along: f32, beside: f32| self.map.is_solid(place(view, curvature, along, beside).truncate());
        let mut scan = MapScan { reach, free: [f32::INFINITY; 2], room: [0.0; 2] };
        let steps = (reach / cell).ceil() as u32;
        let across = (width / cell).ceil() as u32;
        for (index, sign) in [(0, 1.0), (1, -1.0)] {
            let blocked = |along: f32| (0..=across).any(|k| solid(along, sign * (k as f32 * cell).min(width)));
            let first = (1..=steps).map(|k| k as f32 * cell).find(|&along| blocked(along));
            scan.free[index] = first.unwrap_or(f32::INFINITY);
            for ray in 1..=RAYS {
                let beside = |along: f32| sign * (width + f32::from(ray) * mix(SPREAD) * along);
                let hit = (1..=steps).map(|k| k as f32 * cell).find(|&along| solid(along, beside(along)));
                let free = hit.unwrap_or(reach);
                why.note(|| SteeringReason::Feels(place(view, curvature, free, beside(free))));
                scan.room[index] += (free / reach).min(1.0);
            }
        }
        why.note(|| {
            let then = place(view, curvature, reach.min(scan.free[0]).min(scan.free[1]), 0.0);
            SteeringReason::Expects { now: view.position(), then }
        });
        scan
    }

    /// Returns the side to turn to: 1 left, -1 right. `hint` is positive if the part steers to the left. `bend` is the
    /// present turn as a part of the tightest turn.
    fn choose(&self, scan: &MapScan, hint: f32, bend: f32) -> f32 {
        let MapScan { free: [left, right], room, .. } = *scan;
        let hinted = (hint != 0.0).then_some(hint.signum());
        let better = |left: f32, right: f32| if left >= right { 1.0 } else { -1.0 };
        match hinted {
            // in a tight turn with an obstacle on the inner side: leave the turn
            _ if bend > TIGHT && left < right || bend < -TIGHT && right < left => -bend.signum(),
            _ if left.is_infinite() || right.is_infinite() => better(left, right),
            Some(hint) if room[0].min(room[1]) >= f32::from(RAYS) && (left - right).abs() < ALIKE * self.map.cell() => {
                hint
            }
            _ if room[0].min(room[1]) >= f32::from(RAYS) => better(left, right),
            Some(hint) if (room[0] - room[1]).abs() < RAYS_ALIKE => hint,
            _ => better(room[0], room[1]),
        }
    }

    /// Returns a steering that turns by a part of the force and goes no faster than `most`. The accelerating force is
    /// `gain` at most; the vehicle does not stop. The force turns with the vehicle as a rudder's does: a constant force
    /// would raise the speed over a long step.
    fn at_speed(&self, view: &SteeringInput<'_>, side: f32, most: f32, gain: f32) -> Steering {
        let (speed, forward, vehicle) = (view.motion.speed(), view.forward(), &view.vehicle);
        let least = SLOW * vehicle.max_speed;
        let brakes = BRAKES * vehicle.max_force;
        let gain = if speed < least { brakes } else { gain.clamp(0.0, brakes) };
        let along = view.reach(view.velocity() + forward * (most.max(least) - speed)).force.dot(forward);
        let per_newton = view.seconds / vehicle.mass;
        let (sin, cos) = libm::sincosf(side * GRIP * vehicle.max_force * per_newton / speed.max(least));
        let ahead = forward * cos + view.motion.basis.side * sin;
        let change = ahead * (speed + along.clamp(-brakes, gain) * per_newton) - view.velocity();
        (change / per_newton).into()
    }
}

/// Returns the present turn as a part of the tightest turn; positive to the left.
fn bend(view: &SteeringInput<'_>) -> f32 {
    let speed = view.motion.speed();
    let across = view.motion.curvature.dot(view.motion.basis.side) * speed * speed;
    across * view.vehicle.mass / view.vehicle.max_force
}

/// Returns the place at a distance along an arc and a distance to its left.
fn place(view: &SteeringInput<'_>, curvature: f32, along: f32, beside: f32) -> Vec3 {
    let basis = &view.motion.basis;
    let angle = curvature * along;
    let (sin, cos) = libm::sincosf(angle);
    let straight = angle.abs() < 1e-4;
    let (ahead, aside) = if straight { (along, 0.0) } else { (sin / curvature, (1.0 - cos) / curvature) };
    view.position() + basis.forward * (ahead - beside * sin) + basis.side * (aside + beside * cos)
}
