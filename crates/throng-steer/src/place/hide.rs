//! Hiding: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::avoid_obstacles::Passing;
use crate::Arrive;
use crate::single::SLOWING_DISTANCE;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Barriers, Behaviour, Kinematics, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Hides from another agent behind an obstacle (Reynolds 1999).
///
/// It hides from an agent or a place behind the nearest obstacle, and stays with that obstacle until another is nearer by
/// a fifth. Nothing to correct if the target does not exist, if there is nothing to hide behind, or once the agent is
/// hidden.
///
/// The agent steers round obstacles on its way. Surfaces without end, such as planes, hide no agent.
///
/// ```
/// use glam::Vec3;
/// use throng::space::surface::{SeenFrom, Sphere};
/// use throng::steer::{Barriers, Behaviour, SteeringInput, SteeringReason, Target, TraceEntry, TraceRecorder};
/// use throng_steer::Hide;
///
/// let tree = Sphere::new(Vec3::X * 3.0, 1.0)?;
/// let obstacles = Barriers::default().with(tree, SeenFrom::Outside);
/// let hide = Hide { obstacles, gap: 0.3, ..Hide::new(Target::Point(Vec3::X * 9.0)) };
/// let mut told = Vec::new();
/// hide.steer(&SteeringInput::default(), &mut [0.0; 5], &mut TraceRecorder::requested(&mut told)).expect("it is elsewhere");
/// let aims = |told: &TraceEntry| if let SteeringReason::Aim(place) = told.reason { Some(place) } else { None };
/// let place = told.iter().find_map(aims).expect("it says where");
/// assert!(place.distance(Vec3::X * 1.5) < 1e-4);
/// # Ok::<(), throng::Error>(())
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Hide {
    /// The target that it hides from.
    #[parameter(required)]
    pub from: Target,
    /// The obstacles.
    #[parameter(absent = "everything")]
    pub obstacles: Barriers,
    /// Gap between the obstacle and its body, metres.
    #[parameter(default = 0.2, unit = "m", least = 0)]
    pub gap: f32,
    /// Distance beyond which it does not hide, metres. Without it, it hides at any distance.
    #[parameter(default = f32::INFINITY, unit = "m", above = 0, infinite)]
    pub range: f32,
    /// Distance from its place at which it starts to slow down, metres.
    #[parameter(default = SLOWING_DISTANCE, unit = "m", least = 0)]
    pub slowing_distance: f32,
}

impl Hide {
    /// Returns the place behind an obstacle, on the line from the target through the obstacle's centre.
    fn behind(&self, index: usize, from: &Kinematics, view: &SteeringInput<'_>) -> Option<Vec3> {
        let surface = &self.obstacles.0[index].surface;
        let mut bounds = surface.bounds();
        if view.is_on_ground() {
            // an upright obstacle without end hides an agent on the ground
            (bounds.low.z, bounds.high.z) = (view.position().z, view.position().z);
        }
        if !bounds.is_finite() {
            return None;
        }
        let away = view.passable(bounds.center() - from.position).try_normalize()?;
        let middle = from.position + away * away.dot(bounds.center() - from.position);
        // cast a ray from beyond the obstacle back to its far side
        let beyond = bounds.low.distance(bounds.high);
        let hit = surface.ray(middle + away * beyond, -away, beyond)?;
        Some(hit.point + away * (view.radius + self.gap))
    }
}

/// Factor on the distance of the place where the agent already hides.
const KEPT: f32 = 0.8;
/// Gap to obstacles that the agent passes on its way, metres.
const PASSING: f32 = 0.1;

impl Behaviour for Hide {
    /// The obstacle that the agent hides behind, counted from 1, or 0 for none; then the memory of the avoidance.
    fn memory(&self) -> usize {
        1 + Passing::MEMORY
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let [which, memory @ ..] = memory else { return None };
        let from = self.from.find(view).filter(|from| view.to(from.position).length() <= self.range);
        let places = from.iter().flat_map(|from| {
            (0..self.obstacles.0.len()).filter_map(|index| Some((index, self.behind(index, from, view)?)))
        });
        let far = places.map(|(index, place)| {
            let part = if *which == (index + 1) as f32 { KEPT } else { 1.0 };
            (index, place, view.to(place).length() * part)
        });
        let Some((index, place, _)) = far.reduce(|a, b| if b.2 < a.2 { b } else { a }) else {
            *which = 0.0;
            return None;
        };
        *which = (index + 1) as f32;
        let arrive = Arrive { slowing_distance: self.slowing_distance, ..Arrive::new(Target::Point(place)) };
        let round = Passing::with_gap(&self.obstacles, PASSING).avoid(Some(view.to(place)), view, memory, why);
        let said = round.or_else(|| arrive.steer(view, &mut [], why));
        from.iter().for_each(|from| why.note(|| SteeringReason::Shuns(from.position)));
        said
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
