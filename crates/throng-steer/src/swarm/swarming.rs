//! The behaviour of the insects of a swarm.

use super::chosen::ChosenGuides;
use super::guide::{Guide, GuideOutput};
use glam::Vec3;
use std::sync::Arc;
use throng::Error;
use throng::agent::Group;
use throng::motion::{Locomotion, Steering, Vehicle};
use throng::parameters::{Value, parameters};
use throng::space::surface::SeenFrom;
use throng::steer::{
    Barriers, Behaviour, GroupFilter, MOST_IN_BATCH, SteeringBatch, SteeringInput, SteeringNeighbour, SteeringReason,
    TraceRecorder,
};
use throng_field::{CurlNoise, Noise, Octave, Potential};

/// Moves by noise and guides, as insects of a swarm do (Wang et al. 2014).
///
/// The chosen velocity is the sum of the guides' velocities, noise, separation from other
/// insects, and repulsion by obstacles.
///
/// The vehicle sets the [`response`](Vehicle::response) time and the limits of the speed.
#[parameters]
#[derive(Clone, Debug)]
pub struct Swarm {
    /// The guides, which add up.
    #[parameter(from = ChosenGuides)]
    pub guides: Vec<Arc<dyn Guide>>,
    /// The noise. Without it, 0.6 m/s in eddies of 0.4 m and 0.5 s.
    #[parameter(default = usual_noise(), from = SwarmNoise)]
    pub noise: Option<Arc<CurlNoise>>,
    /// Whether each agent has its own noise; else near agents fly alike.
    #[parameter(default = true)]
    pub own_noise: bool,
    /// Separation from other agents.
    pub apart: SwarmSpacing,
    /// Repulsion from surfaces. Without it, none.
    #[parameter(default = KeepOff::new(Barriers::default()), from = KeepOff)]
    pub keep_off: KeepOff,
}

/// Separation from other agents.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwarmSpacing {
    /// Distance between centres within which agents repel each other, metres; 0 disables the separation and its
    /// neighbour search.
    #[parameter(default = 0.06, unit = "m", least = 0)]
    pub distance: f32,
    /// Speed of the repulsion at distance 0, m/s. It decreases to 0 at the distance.
    #[parameter(default = 1.0, unit = "m/s", least = 0)]
    pub speed: f32,
}

/// Repulsion from surfaces.
#[parameters]
#[derive(Clone, Debug)]
pub struct KeepOff {
    /// Names of surfaces and obstacles, `"obstacles"`, or `"everything"`.
    #[parameter(name = "obstacles", required)]
    pub barriers: Barriers,
    /// Distance within which the surface repels, metres.
    #[parameter(default = 0.3, unit = "m", above = 0)]
    pub distance: f32,
    /// Speed of the repulsion at contact, m/s. It decreases to 0 at the distance.
    ///
    /// The component of the velocity towards the surface fades out there.
    #[parameter(default = 1.0, unit = "m/s", least = 0)]
    pub speed: f32,
}

/// The noise of a swarm as files write it.
#[parameters]
struct SwarmNoise(Noise);

impl TryFrom<SwarmNoise> for Option<Arc<CurlNoise>> {
    type Error = Error;

    fn try_from(SwarmNoise(noise): SwarmNoise) -> Result<Self, Error> {
        Ok(Some(Arc::new(noise.try_into()?)))
    }
}

/// Returns the default noise: 0.6 m/s in eddies of 0.4 m that last half a second, and in eddies of half their length.
fn usual_noise() -> Option<Arc<CurlNoise>> {
    let octaves = Octave::turbulence(0.4, 0.5, 0.6, 2).ok()?;
    CurlNoise::new(Potential::Space, &octaves, 0).ok().map(Arc::new)
}

/// Returns the motor of a midge or a fly: at most 2 m/s, with a response time of a tenth of a second. The radius, which
/// belongs to the agent, is some 5 mm.
pub fn midge() -> Vehicle {
    Vehicle { max_force: 40.0, max_speed: 2.0, response: 0.1, locomotion: Locomotion::Level, ..Vehicle::default() }
}

/// Returns the motor of a locust: 1 to 4 m/s. The radius, which belongs to the agent, is some 25 mm.
pub fn locust() -> Vehicle {
    Vehicle { max_speed: 4.0, min_speed: 1.0, response: 0.15, ..midge() }
}

impl Swarm {
    /// Returns the swarm with one more guide.
    pub fn with(mut self, guide: impl Guide + 'static) -> Self {
        self.guides.push(Arc::new(guide));
        self
    }

    /// Returns the swarm with this noise, individual for each insect or shared.
    pub fn with_noise(self, noise: CurlNoise, own_noise: bool) -> Self {
        Self { noise: Some(Arc::new(noise)), own_noise, ..self }
    }

    /// Returns the distance up to which an insect needs neighbours, metres; 0 if it needs none.
    pub fn reach(&self) -> f32 {
        self.guides.iter().map(|guide| guide.reach()).fold(self.apart.distance, f32::max)
    }

    /// Returns a group of such insects; the neighbour search covers the needed distance, and there is none if the swarm
    /// needs no neighbours.
    pub fn group(self) -> Group {
        let reach = self.reach();
        let (neighbours, neighbour_distance) = if reach > 0.0 { (Group::ALL_NEIGHBOURS, reach) } else { (0, 1.0) };
        Group { neighbours, neighbour_distance, ..Group::steered(self) }
    }

    /// Computes the noise of the insects with these numbers.
    fn noise_at(&self, places: &[Vec3], numbers: &[u32], time: f64, noise: &mut [Vec3]) {
        match &self.noise {
            Some(field) if self.own_noise => field.velocities_of_individuals(places, numbers, time, noise),
            Some(field) => field.velocities(places, time, noise),
            None => {}
        }
    }

    /// Returns the chosen velocity of an insect, m/s, with this noise.
    fn velocity(&self, view: &SteeringInput<'_>, noise: Vec3, mut memory: &mut [f32]) -> Vec3 {
        let mut chosen = GuideOutput::default();
        for guide in &self.guides {
            let (own, rest) = memory.split_at_mut(guide.memory());
            guide.guide(view, own, &mut chosen);
            memory = rest;
        }
        if chosen.rests {
            return Vec3::ZERO;
        }
        let own = chosen.velocity + noise * chosen.noise + self.apart.velocity(view);
        let most = view.vehicle.max_speed * chosen.vigour;
        let all = view.passable(self.keep_off.velocity(view, own.clamp_length_max(most) + chosen.drift));
        if all.is_finite() { all } else { view.velocity() }
    }
}

impl Behaviour for Swarm {
    fn memory(&self) -> usize {
        self.guides.iter().map(|guide| guide.memory()).sum()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let mut noise = [Vec3::ZERO];
        self.noise_at(&[view.position()], &[view.rng.number], view.time, &mut noise);
        let velocity = self.velocity(view, noise[0], memory);
        if why.is_requested() {
            self.guides.iter().for_each(|guide| guide.tell(view, why));
        }
        why.note(|| SteeringReason::Wishes(velocity));
        Some(view.reach(velocity))
    }

    /// The noise is computed for all insects of the batch at once.
    fn steer_many(&self, batch: &mut SteeringBatch<'_>) {
        let count = batch.count();
        let (mut places, mut numbers, mut noise) =
            ([Vec3::ZERO; MOST_IN_BATCH], [0; MOST_IN_BATCH], [Vec3::ZERO; MOST_IN_BATCH]);
        for index in 0..count {
            (places[index], numbers[index]) = (batch.position(index), batch.number(index));
        }
        self.noise_at(&places[..count], &numbers[..count], batch.time(), &mut noise[..count]);
        for (index, noise) in (0..count).zip(noise) {
            batch.steer(index, |view, memory| Some(view.reach(self.velocity(view, noise, memory))));
        }
    }

    fn perception_range(&self) -> Option<f32> {
        Some(self.reach())
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        self.keep_off.check_limits()?;
        self.guides.iter().try_for_each(|guide| guide.check())
    }
}

impl SwarmSpacing {
    /// Returns the velocity away from all insects that are too near.
    fn velocity(&self, view: &SteeringInput<'_>) -> Vec3 {
        let push = |other: &SteeringNeighbour| {
            let distance = other.offset.length();
            if distance >= self.distance || !GroupFilter::OwnGroup.counts(view, other) {
                return Vec3::ZERO;
            }
            // two insects at the same position separate to opposite sides
            let side = view.motion.basis.side * if view.rng.number < other.number { 1.0 } else { -1.0 };
            other.offset.try_normalize().map_or(side, |to| -to) * (self.speed * (1.0 - distance / self.distance))
        };
        if self.distance > 0.0 { view.neighbours.iter().map(push).sum() } else { Vec3::ZERO }
    }
}

impl KeepOff {
    /// Returns the velocity corrected near obstacles.
    fn velocity(&self, view: &SteeringInput<'_>, mut velocity: Vec3) -> Vec3 {
        for barrier in &self.barriers.0 {
            let near = barrier.surface.query(view.position());
            let outside = match barrier.seen_from {
                SeenFrom::Outside => true,
                SeenFrom::Inside => false,
                SeenFrom::Both => !near.is_inside(),
            };
            let (away, room) = if outside { (near.normal, near.distance) } else { (-near.normal, -near.distance) };
            let part = (room - view.radius) / self.distance;
            if part < 1.0 {
                let towards = velocity.dot(away).min(0.0);
                velocity -= away * (towards * (1.0 - part.max(0.0)));
                velocity += away * (self.speed * (1.0 - part));
            }
        }
        velocity
    }
}
