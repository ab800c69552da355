//! The people of a run: they follow the agents step by step, so that views can draw walking bodies.

use super::figures::Figures;
use glam::{DVec2, Mat4};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use throng::parallel;
use throng_figure::{Character, JOINTS, Live, Person, Sample, Skeleton};
use throng_record::{Body, Frame, Setting};

/// The longest time between poses, seconds. Views interpolate between poses.
const LONGEST: f64 = 0.06;
/// The most poses between two states.
const MOST: f64 = 64.0;
/// The most agents of a run with people: poses of more take too long.
const MANY: usize = 10_000;
/// The largest bounding radius of a person, metres: longer bodies are doors, carts and vehicles.
const WIDEST: f32 = 0.5;
/// An agent that is faster than this has jumped, m/s.
const FASTEST: f64 = 15.0;

/// The number of rows of the matrix of a joint.
pub const ROWS: usize = 3;

/// The rows of the matrices of all joints of a person.
pub type Joints = [[f32; 4]; ROWS * JOINTS];

/// All people at one moment.
#[derive(Clone, Debug, Default)]
pub struct Poses {
    /// The numbers of the agents, in order, and their people.
    pub people: Vec<(u32, Person)>,
    /// For each person and each joint, the matrix from the body at rest (in heights of the person) to the world (in metres
    /// relative to its origin).
    pub joints: Vec<Joints>,
}

/// Poses from one state to the next, at equal intervals. Empty where no people are wanted.
pub type PosesBetween = Arc<[Arc<Poses>]>;

/// Returns the person of an agent that appears, `None` for an agent in the air or larger than a person.
pub fn person(body: &Body) -> Option<Person> {
    Person::of_agent(body.number, body.shape().clearance_radius()).filter(|_| stands(body))
}

/// Whether an agent is on the ground and no larger than a person.
fn stands(body: &Body) -> bool {
    body.altitude == 0.0 && body.basis.is_none() && body.shape().bounding_radius() <= WIDEST
}

/// The people of a run. Their poses are a function of the states since the last jump in time.
#[derive(Default)]
pub(super) struct People {
    figures: Arc<Figures>,
    followers: Vec<Follower>,
    time: f64,
    poses: PosesBetween,
}

impl People {
    /// Returns the people of a run with these bodies.
    pub fn new(figures: Arc<Figures>) -> Self {
        Self { figures, ..Self::default() }
    }

    /// Takes the state `period` seconds later, or a state after a jump in time.
    pub fn see(&mut self, frame: &Frame, setting: &Setting, period: f64) {
        let gap = frame.time - self.time;
        let last = self.poses.last().filter(|_| gap > 0.0 && gap < 1.5 * period).cloned();
        let Some(last) = last else {
            *self = Self::new(self.figures.clone());
            return;
        };
        self.enter(frame);
        let parts = (gap / LONGEST).ceil().clamp(1.0, MOST) as usize;
        let follow = |part: usize| {
            // as each part begins where the last one ended
            let share = 1.0 / (parts - part) as f64;
            self.pose(setting.origin, |follower| follower.follow(share))
        };
        self.poses = std::iter::once(last).chain((0..parts).map(follow)).collect();
    }

    /// Returns the poses from the last state to this one, which was taken last. People after a jump in time are in the
    /// middle of their way, or stand if there is no time for that.
    pub fn poses(&mut self, frame: &Frame, setting: &Setting, hurry: bool) -> PosesBetween {
        if !self.poses.is_empty() {
            return self.poses.clone();
        }
        self.enter(frame);
        let poses = self.pose(setting.origin, |follower| follower.begin(hurry));
        let poses: PosesBetween = [poses.clone(), poses].into();
        if hurry {
            self.followers.clear();
        } else {
            self.poses = poses.clone();
        }
        poses
    }

    /// Takes the next state of each agent. Agents without a person get one, and people without an agent leave.
    fn enter(&mut self, frame: &Frame) {
        self.time = frame.time;
        let bodies = if frame.bodies.len() > MANY { &[] } else { frame.bodies.as_slice() };
        let mut known = std::mem::take(&mut self.followers).into_iter().peekable();
        let figures = &self.figures;
        let follower = |body: &Body| {
            // both lists are sorted by number
            while known.next_if(|follower| follower.number < body.number).is_some() {}
            let position = body.position;
            let sample = Sample { time: frame.time, position, heading: body.heading.into() };
            let next = (sample, body.velocity.as_dvec2());
            match known.next_if(|follower| follower.number == body.number) {
                Some(mut follower) => {
                    follower.next = next;
                    Some(follower)
                }
                None => Follower::new(
                    body.number,
                    Character::dressed(figures.character(body.group).map(Arc::as_ref), person(body)?),
                    next,
                ),
            }
        };
        self.followers = bodies.iter().filter(|body| stands(body)).filter_map(follower).collect();
    }

    /// Moves all people and returns their poses.
    fn pose(&mut self, origin: DVec2, go: impl Fn(&mut Follower) + Sync) -> Arc<Poses> {
        let mut joints = vec![[[0.0; 4]; ROWS * JOINTS]; self.followers.len()];
        parallel::ranges((&mut *self.followers, &mut *joints), |_, (followers, joints)| {
            for (follower, joints) in followers.iter_mut().zip(joints) {
                go(follower);
                *joints = follower.joints(origin);
            }
        });
        let people = self.followers.iter().map(|follower| (follower.number, *follower.live.person())).collect();
        Arc::new(Poses { people, joints })
    }
}

/// A person that follows an agent.
struct Follower {
    number: u32,
    // in boxes, as followers move when others enter and leave
    skeleton: Box<Skeleton>,
    live: Box<Live>,
    /// The last sample, and the next one with the velocity there.
    last: Sample,
    next: (Sample, DVec2),
    /// Whether the person has not begun to follow the agent yet.
    new: bool,
}

impl Follower {
    /// Returns a person that stands where the agent is, `None` if that is no place.
    fn new(number: u32, (person, skeleton): (Person, Skeleton), next: (Sample, DVec2)) -> Option<Self> {
        let live = Box::new(Live::new(person, next.0).ok()?);
        Some(Self { number, skeleton: Box::new(skeleton), live, last: next.0, next, new: true })
    }

    /// Puts the person where the agent is: on its way, or standing.
    fn begin(&mut self, stands: bool) {
        let (sample, velocity) = self.next;
        let velocity = if stands { DVec2::ZERO } else { velocity };
        // numbers that are not finite leave the person where it is
        if let Ok(live) = Live::moving(*self.live.person(), sample, velocity) {
            (*self.live, self.last) = (live, sample);
        }
        self.new = false;
    }

    /// Goes a share of the way to the next sample.
    fn follow(&mut self, share: f64) {
        let (next, last) = (self.next.0, self.last);
        let gap = next.time - last.time;
        if self.new || next.position.distance(last.position) > FASTEST * gap {
            // an agent that has just come, or jumped, is there in the whole step
            return self.begin(false);
        }
        let turn = (next.heading - last.heading + PI).rem_euclid(TAU) - PI;
        let sample = Sample {
            time: last.time + gap * share,
            position: last.position.lerp(next.position, share),
            heading: last.heading + turn * share,
        };
        if self.live.step(sample).is_ok() {
            self.last = sample;
        }
    }

    /// Returns the matrices of the joints.
    fn joints(&self, origin: DVec2) -> Joints {
        let height = self.live.person().height as f32;
        let placed = self.skeleton.world(&self.live.pose());
        let matrices = self.skeleton.skin_matrices(&placed, origin.extend(0.0));
        let mut rows = [[0.0; 4]; ROWS * JOINTS];
        for (rows, matrix) in rows.chunks_mut(ROWS).zip(matrices) {
            let matrix = (matrix * Mat4::from_scale(glam::Vec3::splat(height))).transpose();
            rows.copy_from_slice(&[matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|row| row.to_array()));
        }
        rows
    }
}
