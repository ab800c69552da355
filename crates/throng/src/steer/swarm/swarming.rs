//! The behaviour of the insects of a swarm.

use super::guide::{Guide, Wish, check_amount};
use crate::Error;
use crate::agent::Group;
use crate::field::{CurlNoise, Octave, Potential};
use crate::motion::{Locomotion, Steering, Vehicle};
use crate::space::surface::SeenFrom;
use crate::steer::{Barriers, Behaviour, Neighbour, Reason, View, Who, Why};
use glam::Vec3;
use std::sync::Arc;

/// How an insect flies: the velocity that it takes on is the sum of what its guides ask for, noise, and what keeps it apart from others
/// and off obstacles.
///
/// The time in which it takes it on is the [`response`](Vehicle::response) of its vehicle, and the speeds it keeps between are its
/// vehicle's too. Those of a world where all are of one such swarm fly many at once.
#[derive(Clone, Debug)]
pub struct Swarm {
    /// What guides them, all together.
    pub guides: Vec<Arc<dyn Guide>>,
    /// The noise, if any.
    pub noise: Option<Arc<CurlNoise>>,
    /// Whether each has a noise of its own; else all have the same, and those who are near each other fly alike.
    pub own_noise: bool,
    /// How they keep apart.
    pub apart: Apart,
    /// How they keep off obstacles.
    pub keep_off: KeepOff,
}

/// How insects keep apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    /// From others of the swarm within this distance, metres; 0: they do not, and need not see each other. Limit: >= 0.
    pub distance: f32,
    /// How fast they go away from one that is where they are themselves, m/s; less and less to the distance. Limit: >= 0.
    pub speed: f32,
}

/// How insects keep off obstacles, and in containers.
#[derive(Clone, Debug, Default)]
pub struct KeepOff {
    /// The surfaces.
    pub barriers: Barriers,
    /// From within this distance, metres, of their bodies. Limit: > 0 if there are surfaces.
    pub distance: f32,
    /// How fast they go away where they touch, m/s; less and less to the distance. What leads at a surface fades out as they come near.
    /// Limit: >= 0.
    pub speed: f32,
}

/// The body of a midge or a fly: at most 2 m/s; what it wants, it takes on in a tenth of a second. Its radius, of the agent, is some 5 mm.
pub fn midge() -> Vehicle {
    Vehicle { max_force: 40.0, max_speed: 2.0, response: 0.1, locomotion: Locomotion::Level, ..Vehicle::default() }
}

/// The body of a locust: 1 to 4 m/s. Its radius, of the agent, is some 25 mm.
pub fn locust() -> Vehicle {
    Vehicle { max_speed: 4.0, min_speed: 1.0, response: 0.15, ..midge() }
}

impl Default for Swarm {
    /// Noise of 0.6 m/s, eddies of 0.4 m that last half a second and others of half their length, a noise for each; apart from others
    /// within 6 cm. Nothing guides them.
    fn default() -> Self {
        let noise = Octave::turbulence(0.4, 0.5, 0.6, 2).and_then(|all| CurlNoise::new(Potential::Space, &all, 0));
        Self {
            guides: Vec::new(),
            noise: noise.ok().map(Arc::new),
            own_noise: true,
            apart: Apart { distance: 0.06, speed: 1.0 },
            keep_off: KeepOff { barriers: Barriers::default(), distance: 0.3, speed: 1.0 },
        }
    }
}

impl Swarm {
    /// With one guide more.
    pub fn with(mut self, guide: impl Guide + 'static) -> Self {
        self.guides.push(Arc::new(guide));
        self
    }

    /// With this noise, one for each or the same for all.
    pub fn with_noise(self, noise: CurlNoise, own_noise: bool) -> Self {
        Self { noise: Some(Arc::new(noise)), own_noise, ..self }
    }

    /// How far an insect must see others, metres; 0 if it need not.
    pub fn reach(&self) -> f32 {
        self.guides.iter().map(|guide| guide.reach()).fold(self.apart.distance, f32::max)
    }

    /// A group of such insects, who see everybody as far as they must, or nobody.
    pub fn group(self, vehicle: Vehicle) -> Group {
        let reach = self.reach();
        let (neighbours, neighbour_distance) = if reach > 0.0 { (Group::EVERYBODY, reach) } else { (0, 1.0) };
        Group { neighbours, neighbour_distance, ..Group::vehicles(self, vehicle) }
    }

    /// The velocity that an insect wants, m/s, with this noise.
    pub(crate) fn velocity(&self, view: &View<'_>, noise: Vec3, mut memory: &mut [f32]) -> Vec3 {
        let mut wish = Wish::default();
        for guide in &self.guides {
            let (own, rest) = memory.split_at_mut(guide.memory());
            guide.guide(view, own, &mut wish);
            memory = rest;
        }
        if wish.rests {
            return Vec3::ZERO;
        }
        let own = wish.velocity + noise * wish.noise + self.apart.velocity(view);
        let most = view.vehicle.max_speed * wish.vigour;
        let all = view.passable(self.keep_off.velocity(view, own.clamp_length_max(most) + wish.drift));
        if all.is_finite() { all } else { view.velocity() }
    }
}

impl Behaviour for Swarm {
    fn memory(&self) -> usize {
        self.guides.iter().map(|guide| guide.memory()).sum()
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let mut noise = [Vec3::ZERO];
        if let Some(field) = &self.noise {
            let (place, number) = ([view.position()], [view.dice.number]);
            match self.own_noise {
                true => field.velocities_of_individuals(&place, &number, view.time, &mut noise),
                false => field.velocities(&place, view.time, &mut noise),
            }
        }
        let velocity = self.velocity(view, noise[0], memory);
        why.note(|| Reason::Wishes(velocity));
        Some(view.reach(velocity))
    }

    fn as_swarm(&self) -> Option<&Swarm> {
        Some(self)
    }

    fn check(&self) -> Result<(), Error> {
        check_amount("distance of separation", self.apart.distance)?;
        check_amount("speed of separation", self.apart.speed)?;
        if !self.keep_off.barriers.0.is_empty() {
            Error::unless_positive("distance of obstacles", self.keep_off.distance)?;
        }
        check_amount("speed off obstacles", self.keep_off.speed)?;
        self.guides.iter().try_for_each(|guide| guide.check())
    }
}

impl Apart {
    /// Away from all who are too near.
    fn velocity(&self, view: &View<'_>) -> Vec3 {
        let push = |other: &Neighbour| {
            let distance = other.offset.length();
            if distance >= self.distance || !Who::OwnGroup.counts(view, other) {
                return Vec3::ZERO;
            }
            // of two in one place, one goes left, the other right
            let side = view.motion.basis.side * if view.dice.number < other.number { 1.0 } else { -1.0 };
            other.offset.try_normalize().map_or(side, |to| -to) * (self.speed * (1.0 - distance / self.distance))
        };
        if self.distance > 0.0 { view.neighbours.iter().map(push).sum() } else { Vec3::ZERO }
    }
}

impl KeepOff {
    /// What becomes of a velocity near obstacles.
    fn velocity(&self, view: &View<'_>, mut velocity: Vec3) -> Vec3 {
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
