//! Obstacle avoidance on a map of cells: OpenSteer's "driving through map based obstacles".

use crate::Error;
use crate::motion::Steering;
use crate::space::Raster;
use crate::steer::{Behaviour, Branch, Reason, View, Why};
use glam::Vec3;
use std::f32::consts::PI;
use std::sync::Arc;

/// Does what a part would, and turns and brakes where its way is not free: for fast vehicles that turn in wide circles.
///
/// It scans the corridor that its body is about to sweep on the arc that it is on, wider the faster it is; and to each side of
/// it four rays that spread, its wings. A free side of the corridor is taken; else the side where there is more room; and
/// where both would do, that to which the part leads. It keeps to a side for a while. It goes no faster than it can stop
/// before what it sees.
///
/// ```
/// use glam::{Vec2, Vec3};
/// use std::sync::Arc;
/// use throng::motion::Motion;
/// use throng::space::Raster;
/// use throng::steer::{AvoidMap, Behaviour, Seek, Target, View, Why};
///
/// let rock = |at: Vec2| at.distance(Vec2::new(3.5, 0.5)) < 2.0;
/// let map = Raster::of(Vec2::splat(-30.0), Vec2::splat(30.0), 0.5, rock)?;
/// let drive = AvoidMap::new(Arc::new(map), Seek { target: Target::Point(Vec3::X * 20.0) });
/// let view = View { motion: Motion::moving(Vec3::ZERO, Vec3::X), ..View::default() };
/// let steering = drive.steer(&view, &mut [0.0; 2], &mut Why::default()).expect("a rock is in its way");
/// assert!(steering.force.y < 0.0, "there is more room on the right");
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct AvoidMap {
    /// What is solid, in the coordinates of the [`View`].
    pub map: Arc<Raster>,
    /// What it would do.
    pub of: Branch,
    /// How far ahead it looks at the top speed, seconds; little more than half of that when it is slow, but at least 3 m.
    /// Limit: > 0.
    pub seconds: f32,
    /// How much farther than its body the corridor reaches to either side at the top speed, metres; less than half of that
    /// when it is slow. Limit: >= 0.
    pub margin: f32,
    /// Whether it expects to go on along the arc that it is on; else straight ahead.
    pub curved: bool,
}

impl AvoidMap {
    /// With OpenSteer's numbers.
    pub fn new(map: Arc<Raster>, of: impl Into<Branch>) -> Self {
        Self { map, of: of.into(), seconds: 2.1, margin: 1.5, curved: true }
    }
}

/// How far it sees at least, metres.
const LEAST_REACH: f32 = 3.0;
/// Part of the seconds that it looks ahead when it is slow.
const SHORT: f32 = 4.0 / 7.0;
/// Part of the margin that is left when it is slow.
const NARROW: f32 = 0.4;
/// The most that an arc turns, radians.
const MOST_TURN: f32 = PI / 3.0;
/// How many rays a wing has.
const RAYS: u8 = 4;
/// By how much the rays of a wing spread: metres aside for every metre ahead, at rest and at the top speed.
const SPREAD: (f32, f32) = (0.3, 0.06);
/// Part of its brakes that it counts on: it may turn out that it needs more.
const RESERVE: f32 = 0.7;
/// Part of what it sees from which on there is time: it does what its part would, but no faster than it can stop.
const FAR: f32 = 0.85;
/// Part of the tightest turn that is one.
const TIGHT: f32 = 0.9;
/// How much farther one side is free than the other, cells, when they are not alike.
const ALIKE: f32 = 5.0;
/// How many rays more are free on one side when they are not alike.
const RAYS_ALIKE: f32 = 0.5;
/// How long it keeps to a side, seconds.
const KEEPS: f32 = 0.7;
/// Part of the top speed at which it feels its way on where nothing is free.
const SLOW: f32 = 0.12;
/// Parts of its force that it brakes by, and turns by: both together are all of it.
const BRAKES: f32 = 0.6;
const GRIP: f32 = 0.8;

/// What is in the way. Of the two sides the left is the first.
#[derive(Clone, Copy, Debug)]
struct Scan {
    /// How far it looked, metres.
    reach: f32,
    /// How far each side of the corridor is free; infinite if all of it is.
    free: [f32; 2],
    /// How many rays of each wing are free; parts of those that are not.
    room: [f32; 2],
}

impl Behaviour for AvoidMap {
    /// For how many seconds it keeps to a side, and to which; then those of the part.
    fn memory(&self) -> usize {
        2 + self.of.words()
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let (own, mut rest) = memory.split_at_mut_checked(2)?;
        let [left, kept] = own else { return None };
        *left = (*left - view.seconds).max(0.0);
        let wish = self.of.steer_as(0, view, &mut rest, why);
        let (side, forward) = (view.motion.basis.side, view.forward());
        let (hint, gain) = wish.map_or((0.0, 0.0), |wish| (wish.force.dot(side), wish.force.dot(forward)));
        let scan = self.scan(view, why);
        let nearest = scan.free[0].min(scan.free[1]);
        let speed = view.motion.speed();
        let brakes = RESERVE * BRAKES * view.vehicle.max_braking();
        let stops = (2.0 * brakes * (nearest - view.radius).max(0.0)).sqrt();
        // what it has just avoided it does not turn back to
        let back = if *left > 0.0 { (hint * *kept).min(0.0) * *kept } else { 0.0 };
        let wish = wish.map(|wish| Steering { force: wish.force - side * back, ..wish });
        if nearest.is_infinite() {
            // between two walls it does not race
            let narrow = scan.room[0].max(scan.room[1]) < 1.0 && speed > 0.5 * view.vehicle.max_speed;
            return if narrow { Some(self.at_speed(view, 0.0, 0.5 * view.vehicle.max_speed, 0.0)) } else { wish };
        }
        if nearest > FAR * scan.reach {
            let along = self.at_speed(view, 0.0, stops, 0.0).force.dot(forward);
            // what it cannot do anyway must not drown the brakes
            let force = wish.map_or(Vec3::ZERO, |wish| wish.force.clamp_length_max(view.vehicle.max_force));
            return Some((force + forward * (along - force.dot(forward)).min(0.0)).into());
        }
        if *left <= 0.0 {
            *kept = self.choose(&scan, hint, bend(view));
            *left = KEEPS;
        }
        // as much to the side as it is near
        let urgency = (1.5 * (1.0 - nearest / scan.reach)).clamp(0.3, 1.0);
        Some(self.at_speed(view, *kept * urgency, stops, gain))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("horizon", self.seconds)?;
        Error::unless(self.margin >= 0.0 && self.margin.is_finite(), "margin", self.margin, "0 or more and finite")?;
        self.of.check()
    }
}

impl AvoidMap {
    /// What is in the way on the arc that it is on.
    fn scan(&self, view: &View<'_>, why: &mut Why<'_>) -> Scan {
        let (motion, cell) = (&view.motion, self.map.cell());
        let part = (motion.speed() / view.vehicle.max_speed).min(1.0);
        let mix = |(rest, top): (f32, f32)| rest + (top - rest) * part;
        let curvature = if self.curved { motion.curvature.dot(motion.basis.side) } else { 0.0 };
        let reach = (motion.speed() * self.seconds * mix((SHORT, 1.0))).max(LEAST_REACH) + view.radius;
        let reach = reach.min(MOST_TURN / curvature.abs().max(f32::MIN_POSITIVE));
        let width = view.radius + self.margin * mix((NARROW, 1.0));
        let solid = |along: f32, beside: f32| self.map.is_solid(place(view, curvature, along, beside).truncate());
        let mut scan = Scan { reach, free: [f32::INFINITY; 2], room: [0.0; 2] };
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
                why.note(|| Reason::Feels(place(view, curvature, free, beside(free))));
                scan.room[index] += (free / reach).min(1.0);
            }
        }
        why.note(|| Reason::Expects(place(view, curvature, reach.min(scan.free[0]).min(scan.free[1]), 0.0)));
        scan
    }

    /// The side to turn to: 1 left, -1 right. `hint` is positive for who would go left anyway, `bend` is the part of its
    /// tightest turn that it is in.
    fn choose(&self, scan: &Scan, hint: f32, bend: f32) -> f32 {
        let Scan { free: [left, right], room, .. } = *scan;
        let hinted = (hint != 0.0).then_some(hint.signum());
        let better = |left: f32, right: f32| if left >= right { 1.0 } else { -1.0 };
        match hinted {
            // as tightly as it can, and what is in the way is on the inner side: out of the turn
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

    /// Turns by a part of its force, and goes no faster than a speed, to which it gains by no more than a force; nor stops. The
    /// force turns with it, as a rudder's does: one that stayed as it is for a long step would make it faster.
    fn at_speed(&self, view: &View<'_>, side: f32, most: f32, gain: f32) -> Steering {
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

/// Part of the tightest turn that it is in; to the left positive.
fn bend(view: &View<'_>) -> f32 {
    let speed = view.motion.speed();
    let across = view.motion.curvature.dot(view.motion.basis.side) * speed * speed;
    across * view.vehicle.mass / view.vehicle.max_force
}

/// A place on an arc, and so far to its left.
fn place(view: &View<'_>, curvature: f32, along: f32, beside: f32) -> Vec3 {
    let basis = &view.motion.basis;
    let angle = curvature * along;
    let (sin, cos) = libm::sincosf(angle);
    let straight = angle.abs() < 1e-4;
    let (ahead, aside) = if straight { (along, 0.0) } else { (sin / curvature, (1.0 - cos) / curvature) };
    view.position() + basis.forward * (ahead - beside * sin) + basis.side * (aside + beside * cos)
}
