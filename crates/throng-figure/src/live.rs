//! A person that follows an agent while it moves.

use crate::error::Error;
use crate::gait::cycle_duration;
use crate::math::{direction, mix, smooth, wrapped};
use crate::path::{Ahead, Extrapolated, Sample, Tracker};
use crate::person::{Person, Side};
use crate::pose::{BodyState, Pose, hip_joints, idle_weight, pose};
use crate::steps::{FootPose, Planner, Plant, Swing, along, foot_at, stance};
use crate::walk::{FASTEST, check_sample, free_height, gaze_along, lift_of_foot, reachable_height, sway};
use glam::DVec2;

/// The longest step of the laws, s: longer steps are divided.
const LONGEST_STEP: f64 = 0.02;
/// After a gap of more than this, the person stands where the agent is, s.
const LONGEST_GAP: f64 = 2.0;
/// The largest angular speed of a foot on the ground, rad/s.
const FASTEST_ROLL: f64 = 14.0;

/// Below this speed a person stands at its first sample, m/s.
const STILL: f64 = 0.05;
/// How long a person walks at least before its first sample, if it moves there, s.
const RUN_UP: f64 = 1.4;
/// The speed of which the cycle divides time, m/s.
const COMFORTABLE: f64 = 1.3;

/// How fast a foot in the air follows its aim: the rest of the way is this power of the rest of the time.
const FOLLOWING: f64 = 2.5;

/// A person that follows an agent, without knowledge of its future.
///
/// The laws are those of [`Walk`](crate::Walk); the motion ahead is extrapolated, and a foot in the air still changes
/// its aim.
///
/// ```
/// use glam::DVec2;
/// use throng_figure::{Live, Person, Sample};
///
/// let at = |time: f64| Sample { time, position: DVec2::new(1.3 * time, 0.0), heading: 0.0 };
/// let mut live = Live::new(Person::new(1, 7), at(0.0))?;
/// let mut pose = live.pose();
/// for moment in 1..=250 {
///     pose = live.step(at(f64::from(moment) / 25.0))?;
/// }
/// assert!((pose.hips.x - 13.0).abs() < 0.1);
/// # Ok::<(), throng_figure::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Live {
    person: Person,
    last: Sample,
    samples: usize,
    tracker: Tracker,
    planner: Planner,
    feet: [Foot; 2],
    state: BodyState,
    velocity: DVec2,
    height_speed: f64,
    /// Times and phases of the last strike or lift, and of the next one.
    knots: [(f64, f64); 2],
    pose: Pose,
}

#[derive(Debug, Clone)]
struct Foot {
    plant: Plant,
    swing: Option<Swing>,
    /// How far the aim of the swing was moved since the step began, and how much of that the foot follows yet: m and
    /// rad.
    moved: (DVec2, f64),
    followed: (DVec2, f64),
    pose: FootPose,
    rate: FootPose,
}

impl Live {
    /// Returns a person that stands at a sample.
    ///
    /// # Errors
    /// A number of the sample is not finite.
    pub fn new(person: Person, sample: Sample) -> Result<Live, Error> {
        check_sample(&sample, 0)?;
        let tracker = Tracker::new(sample);
        let planner = Planner::new(person, tracker.motion, sample.time);
        let mut state = BodyState {
            time: sample.time,
            pelvis: sample.position.extend(0.0),
            heading: sample.heading,
            forward: 0.0,
            relative_speed: 0.0,
            acceleration: [0.0; 2],
            phase: 0.0,
            run: 0.0,
            still: 1.0,
            weight: idle_weight(&person, 1.0, sample.time),
            gaze: 0.0,
        };
        state.pelvis.z = free_height(&person, &state) - 0.01;
        let feet = planner.plants.map(|plant| {
            let pose = foot_at(&person, plant.ankle, plant.yaw, 0.0);
            Foot {
                plant,
                swing: None,
                moved: Default::default(),
                followed: Default::default(),
                pose,
                rate: FootPose::rate(&pose, &pose, 1.0),
            }
        });
        let pelvis = state.pelvis_rotation();
        let stands = pose(&person, &state, pelvis, &[feet[0].pose, feet[1].pose]);
        Ok(Live {
            person,
            last: sample,
            samples: 1,
            tracker,
            planner,
            feet,
            state,
            velocity: DVec2::ZERO,
            height_speed: 0.0,
            knots: [(sample.time, 0.0); 2],
            pose: stands,
        })
    }

    /// Returns a person in the middle of its way: it has walked or run at this velocity (m/s), facing as it does at the
    /// sample, for 1.4 to 3 seconds. Below 0.05 m/s and above 15 m/s it stands.
    ///
    /// It began at one of the times of a fixed cycle. So the legs go on at the samples of one motion, in either direction of
    /// time.
    ///
    /// # Errors
    /// A number of the sample or of the velocity is not finite.
    pub fn moving(person: Person, sample: Sample, velocity: DVec2) -> Result<Live, Error> {
        check_sample(&sample, 0)?;
        if !velocity.is_finite() {
            return Err(Error::NotFinite { index: 0 });
        }
        if !(STILL..=FASTEST).contains(&velocity.length()) {
            return Live::new(person, sample);
        }
        let cycle = cycle_duration(COMFORTABLE, person.leg()) * person.stride;
        let run_up = RUN_UP + (sample.time - RUN_UP - person.phase * cycle).rem_euclid(cycle);
        let (time, position) = (sample.time - run_up, sample.position - velocity * run_up);
        let mut live = Live::new(person, Sample { time, position, ..sample })?;
        live.tracker.motion.velocity = velocity;
        live.go(sample);
        Ok(live)
    }

    /// Returns the person.
    pub fn person(&self) -> &Person {
        &self.person
    }

    /// Returns the last sample.
    pub fn sample(&self) -> Sample {
        self.last
    }

    /// Returns the pose at the last sample.
    pub fn pose(&self) -> Pose {
        self.pose
    }

    /// Takes the next sample of the agent and returns the pose at it. If the agent jumped, the person stands where it
    /// is.
    ///
    /// # Errors
    /// A number of the sample is not finite, or it is not after the last sample; the person is then unchanged.
    pub fn step(&mut self, sample: Sample) -> Result<Pose, Error> {
        check_sample(&sample, self.samples)?;
        let gap = sample.time - self.last.time;
        if gap <= 0.0 {
            return Err(Error::Time { index: self.samples, time: sample.time });
        }
        let samples = self.samples + 1;
        if gap > LONGEST_GAP || self.last.position.distance(sample.position) > FASTEST * gap {
            *self = Live::new(self.person, sample)?;
        } else {
            self.go(sample);
        }
        self.samples = samples;
        Ok(self.pose)
    }

    /// Goes on a straight line to a later sample.
    fn go(&mut self, sample: Sample) {
        let from = self.last;
        let gap = sample.time - from.time;
        let parts = libm::ceil(gap / LONGEST_STEP).max(1.0);
        let turn = wrapped(sample.heading - from.heading);
        for part in 1..=parts as usize {
            let share = part as f64 / parts;
            self.advance(Sample {
                time: from.time + gap * share,
                position: from.position + (sample.position - from.position) * share,
                heading: from.heading + turn * share,
            });
        }
        self.last = sample;
        let pelvis = self.state.pelvis_rotation();
        self.pose = pose(&self.person, &self.state, pelvis, &[self.feet[0].pose, self.feet[1].pose]).near(&self.pose);
    }

    fn advance(&mut self, sample: Sample) {
        let step = sample.time - self.tracker.time;
        if step <= 0.0 {
            return;
        }
        self.tracker.push(sample);
        let ahead = Extrapolated { time: sample.time, motion: self.tracker.motion };
        self.land_and_lift(&ahead, sample.time);
        self.follow(&ahead, sample.time, step);
        self.move_feet(&ahead, sample.time, step);
    }

    /// Begins and ends steps.
    fn land_and_lift(&mut self, ahead: &Extrapolated, time: f64) {
        for foot in &mut self.feet {
            if foot.swing.is_some() && time >= foot.plant.strike {
                foot.swing = None;
            }
        }
        let flies = self.feet.iter().any(|foot| foot.swing.is_some());
        if flies && !self.planner.runs() {
            self.expect_lift(ahead);
        }
        if time < self.planner.ready || flies && !self.planner.runs() {
            return;
        }
        let Some(next) = self.planner.decide(ahead, time) else {
            // the step that was expected does not come
            for foot in &mut self.feet {
                foot.plant.lift = f64::INFINITY;
            }
            return;
        };
        let other = self.feet[next.side.other().index()].plant.ankle;
        let foot = &mut self.feet[next.side.index()];
        let raise = lift_of_foot(&self.person, self.state.relative_speed);
        foot.swing = Some(Swing::new(&self.person, next.side, (foot.pose, foot.rate), time, &next.plant, other, raise));
        foot.plant = next.plant;
        (foot.moved, foot.followed) = Default::default();
        self.knots = [(time, next.phases[0]), (next.plant.strike, next.phases[1])];
        let stays = &mut self.feet[next.side.other().index()].plant;
        (stays.roll, stays.rolling) = (next.roll, next.rolling);
        self.expect_lift(ahead);
    }

    /// Expects the foot on the ground to be lifted next, if the body goes on. It may have started or stopped since the
    /// other foot was lifted.
    fn expect_lift(&mut self, ahead: &Extrapolated) {
        let goes = ahead.at(self.planner.ready).velocity.length() > 0.15;
        let roll = self.planner.roll(&ahead.motion);
        for foot in self.feet.iter_mut().filter(|foot| foot.swing.is_none()) {
            foot.plant.lift = if goes { self.planner.ready } else { f64::INFINITY };
            foot.plant.roll = foot.plant.roll.max(roll);
        }
    }

    /// Lets the body follow the agent.
    fn follow(&mut self, ahead: &Extrapolated, time: f64, step: f64) {
        let person = &self.person;
        let motion = ahead.motion;
        let leg = person.leg();
        let near = |constant: f64| 1.0 - libm::exp(-step / constant);
        let (forward, _) = along(&motion);
        let change = (motion.velocity - self.velocity) / step;
        self.velocity = motion.velocity;
        let facing = direction(motion.heading);
        let state = &mut self.state;
        for (own, new) in state.acceleration.iter_mut().zip([facing.dot(change), facing.perp().dot(change)]) {
            *own = mix(*own, new, near(0.2));
        }
        let way = ahead.at(time + 0.8).position - motion.position;
        state.time = time;
        state.heading = motion.heading;
        state.forward = forward / leg;
        state.relative_speed = motion.velocity.length() / leg;
        state.gaze = mix(state.gaze, gaze_along(facing, way), near(0.25));
        state.run = mix(state.run, if self.planner.runs() { 1.0 } else { 0.0 }, near(0.15));
        state.still = mix(state.still, 1.0 - smooth(motion.velocity.length() / 0.2), near(0.3));
        state.weight = idle_weight(person, state.still, time);
        let [from, to] = self.knots;
        let share = if to.0 > from.0 { ((time - from.0) / (to.0 - from.0)).clamp(0.0, 1.3) } else { 0.0 };
        state.phase = mix(state.phase, mix(from.1, to.1, share), near(0.05));
        // the pelvis: as the gait has it, but in reach of the feet on the ground, now and shortly
        let height = state.pelvis.z;
        state.pelvis = motion.position.extend(height);
        state.pelvis += sway(person, state);
        let mut aim = free_height(person, state);
        for later in [0.0, 0.06] {
            let at = (state.pelvis.truncate() + motion.velocity * later).extend(height);
            let hips = hip_joints(person, at, state.pelvis_rotation());
            for (foot, hip) in self.feet.iter().zip(hips) {
                if foot.swing.is_none() || time + later >= foot.plant.strike {
                    aim = aim.min(reachable_height(person, &foot.plant, time + later, hip));
                }
            }
        }
        let rate = 1.0 / 0.045;
        let pull = rate * rate * (aim - height) - 2.0 * rate * self.height_speed;
        // implicit, so that it is stable for any step
        self.height_speed += step * pull / (1.0 + 2.0 * rate * step + rate * rate * step * step);
        state.pelvis.z = height + step * self.height_speed;
    }

    /// Moves the feet.
    fn move_feet(&mut self, ahead: &Extrapolated, time: f64, step: f64) {
        let person = self.person;
        let hips = hip_joints(&person, self.state.pelvis, self.state.pelvis_rotation());
        for side in Side::BOTH {
            let foot = &mut self.feet[side.index()];
            let before = foot.pose;
            foot.pose = if let Some(swing) = &foot.swing {
                // the aim changes with the motion until shortly before the strike
                let left = foot.plant.strike - time;
                if left > 0.1 {
                    let aim = self.planner.replan(ahead, side, foot.plant.strike);
                    foot.moved.0 += aim.ankle - foot.plant.ankle;
                    foot.moved.1 += wrapped(aim.yaw - foot.plant.yaw);
                    foot.plant = aim;
                }
                let share = (FOLLOWING * step / (left + step)).min(1.0);
                foot.followed.0 += (foot.moved.0 - foot.followed.0) * share;
                foot.followed.1 += (foot.moved.1 - foot.followed.1) * share;
                let mut pose = swing.at(time);
                pose.ankle += foot.followed.0.extend(0.0);
                pose.yaw += foot.followed.1;
                pose
            } else {
                let aim = stance(&person, &foot.plant, time, hips[side.index()]).pitch;
                let most = FASTEST_ROLL * step;
                let pitch = before.pitch + (aim - before.pitch).clamp(-most, most);
                foot_at(&person, foot.plant.ankle, foot.plant.yaw, pitch)
            };
            foot.rate = FootPose::rate(&before, &foot.pose, step);
        }
    }
}
