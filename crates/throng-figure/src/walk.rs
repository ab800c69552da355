//! A person on a recorded trajectory.

use crate::error::Error;
use crate::gait;
use crate::math::{direction, mix, smooth};
use crate::path::{CELL, Column, Recorded, Sample, gauss};
use crate::person::{Person, Side};
use crate::pose::{BodyState, Pose, hip_joints, idle_weight, pose};
use crate::steps::{FootPose, Planner, Plant, STRETCH, Step, Swing, allowed_roll, along, foot_at, stance};
use glam::{DVec2, DVec3};

/// A trajectory is cut where it is faster than this, m/s: the person is then elsewhere at once.
pub const FASTEST: f64 = 15.0;
/// The longest trajectory, s, and the largest number of a sample.
const LONGEST: f64 = 14_400.0;
const LARGEST: f64 = 1e9;
/// How long before its first sample and after its last sample a person walks, unseen, s.
const MARGIN: f64 = 3.0;

/// A person that walks a recorded trajectory.
///
/// The footfalls are planned once, with the future known: a foot is put where the body will be. [`Walk::pose`] then
/// returns the pose at any time, in any order of calls, with the same bits.
///
/// ```
/// use glam::DVec2;
/// use throng_figure::{Joint, Person, Sample, Skeleton, Walk};
///
/// // ten seconds straight ahead at 1.3 m/s
/// let samples: Vec<Sample> = (0..=100)
///     .map(|i| f64::from(i) / 10.0)
///     .map(|time| Sample { time, position: DVec2::new(1.3 * time, 0.0), heading: 0.0 })
///     .collect();
/// let person = Person::new(1, 7);
/// let walk = Walk::recorded(&person, &samples)?;
///
/// let joints = Skeleton::new(&person).world(&walk.pose(5.0));
/// let head = joints[Joint::Head.index()].position;
/// assert!((head.x - 6.5).abs() < 0.2 && head.z > 1.2);
/// # Ok::<(), throng_figure::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Walk {
    person: Person,
    /// The parts between jumps, at least one.
    parts: Vec<Part>,
}

/// A trajectory without jumps.
#[derive(Debug, Clone)]
struct Part {
    start: f64,
    end: f64,
    path: Recorded,
    columns: Columns,
    feet: [Foot; 2],
}

/// What changes smoothly, on the grid of the path.
#[derive(Debug, Clone, Default)]
struct Columns {
    phase: Column,
    /// Height of the pelvis above the ground, m.
    height: Column,
    run: Column,
    still: Column,
    gaze: Column,
    acceleration: [Column; 2],
}

/// The plants of a foot, in the order of time, and the swings between them.
#[derive(Debug, Clone, Default)]
struct Foot {
    plants: Vec<Plant>,
    swings: Vec<Swing>,
}

impl Foot {
    /// Returns the number of the plant on which the foot is at a time, or from which it comes.
    fn plant(&self, time: f64) -> usize {
        self.plants.partition_point(|plant| plant.strike <= time).max(1) - 1
    }
}

impl Walk {
    /// Returns the walk of a person along samples in the order of time.
    ///
    /// # Errors
    /// There is no sample, a number is not finite or larger than 1e9, a time is not after the one before, or the trajectory lasts more than four hours.
    pub fn recorded(person: &Person, samples: &[Sample]) -> Result<Walk, Error> {
        check(samples)?;
        let mut parts = Vec::new();
        let mut first = 0;
        for next in 1..=samples.len() {
            let jumps = next == samples.len() || {
                let (a, b) = (samples[next - 1], samples[next]);
                a.position.distance(b.position) > FASTEST * (b.time - a.time)
            };
            if jumps {
                parts.push(Part::new(person, &samples[first..next]));
                first = next;
            }
        }
        Ok(Walk { person: *person, parts })
    }

    /// Returns the person.
    pub fn person(&self) -> &Person {
        &self.person
    }

    /// Returns the times of the first and the last sample, s.
    pub fn span(&self) -> (f64, f64) {
        (self.parts[0].start, self.parts[self.parts.len() - 1].end)
    }

    /// Returns the pose at a time, s. Before the first sample and after the last sample it is the pose of that sample.
    pub fn pose(&self, time: f64) -> Pose {
        let (start, end) = self.span();
        // NaN is before everything
        let time = if time >= start { time.min(end) } else { start };
        let part = &self.parts[self.parts.partition_point(|part| part.start <= time).max(1) - 1];
        part.pose(&self.person, time)
    }

    /// Returns the footfalls of a side that lie between the first and the last sample, at least in part.
    pub fn plants(&self, side: Side) -> impl Iterator<Item = &Plant> {
        self.parts.iter().flat_map(move |part| {
            part.feet[side.index()].plants.iter().filter(|plant| plant.lift > part.start && plant.strike < part.end)
        })
    }
}

pub(crate) fn check_sample(sample: &Sample, index: usize) -> Result<(), Error> {
    let numbers = [sample.time, sample.position.x, sample.position.y, sample.heading];
    if numbers.iter().all(|number| number.abs() <= LARGEST) { Ok(()) } else { Err(Error::NotFinite { index }) }
}

fn check(samples: &[Sample]) -> Result<(), Error> {
    let (Some(first), Some(last)) = (samples.first(), samples.last()) else { return Err(Error::Empty) };
    for (index, sample) in samples.iter().enumerate() {
        check_sample(sample, index)?;
        if index > 0 && sample.time <= samples[index - 1].time {
            return Err(Error::Time { index, time: sample.time });
        }
    }
    let duration = last.time - first.time;
    if duration > LONGEST { Err(Error::TooLong { duration }) } else { Ok(()) }
}

impl Part {
    fn new(person: &Person, samples: &[Sample]) -> Part {
        let path = Recorded::new(samples, MARGIN);
        let (start, end) = (samples[0].time, samples[samples.len() - 1].time);
        let mut part = Part { start, end, path, columns: Columns::default(), feet: Default::default() };
        let (steps, runs) = part.plan(person);
        part.columns = part.signals(&steps, runs);
        part.columns.height = part.heights(person);
        part.swing(person);
        part
    }

    /// Plans all steps. Returns them, and at which points of the grid the person runs.
    fn plan(&mut self, person: &Person) -> (Vec<Step>, Vec<f64>) {
        use crate::path::Ahead;
        let begin = self.path.time(0);
        let end = self.path.time(self.path.points() - 1);
        let mut planner = Planner::new(*person, self.path.at(begin), begin);
        for side in Side::BOTH {
            self.feet[side.index()].plants.push(planner.plants[side.index()]);
        }
        let mut time = begin + 0.2 + 1.2 * person.phase;
        let mut steps: Vec<Step> = Vec::new();
        let mut runs = vec![0.0; self.path.points()];
        let mut point = 0;
        while time < end {
            let step = planner.decide(&self.path, time);
            while point < runs.len() && self.path.time(point) <= time {
                runs[point] = if planner.runs() { 1.0 } else { 0.0 };
                point += 1;
            }
            let Some(step) = step else {
                time += CELL;
                continue;
            };
            let plants = &mut self.feet[step.side.index()].plants;
            if let Some(left) = plants.last_mut() {
                left.lift = step.lift.max(left.strike + 0.05).min(step.plant.strike - 0.05);
                left.roll = step.roll;
                left.rolling = step.rolling;
            }
            plants.push(step.plant);
            steps.push(step);
            time = planner.ready;
        }
        (steps, runs)
    }

    /// Returns the columns but the height of the pelvis.
    fn signals(&self, steps: &[Step], runs: Vec<f64>) -> Columns {
        use crate::path::Ahead;
        let mut knots: Vec<(f64, f64)> = Vec::new();
        for step in steps {
            for (time, phase) in [(step.lift, step.phases[0]), (step.plant.strike, step.phases[1])] {
                if knots.last().is_none_or(|last| time > last.0 && phase > last.1) {
                    knots.push((time, phase));
                }
            }
        }
        let points = self.path.points();
        let mut phase = Vec::with_capacity(points);
        let mut next = 0;
        for point in 0..points {
            let time = self.path.time(point);
            while next < knots.len() && knots[next].0 <= time {
                next += 1;
            }
            phase.push(match (next.checked_sub(1).map(|i| knots[i]), knots.get(next)) {
                (Some(a), Some(b)) => mix(a.1, b.1, (time - a.0) / (b.0 - a.0)),
                (Some(only), None) => only.1,
                (None, Some(only)) => only.1,
                (None, None) => 0.0,
            });
        }
        let motions: Vec<_> = (0..points).map(|point| self.path.at(self.path.time(point))).collect();
        let still: Vec<f64> = motions.iter().map(|m| 1.0 - smooth(m.velocity.length() / 0.2)).collect();
        let gaze: Vec<f64> = motions
            .iter()
            .enumerate()
            .map(|(point, motion)| {
                let way = self.path.at(self.path.time(point) + 0.8).position - motion.position;
                gaze_along(direction(motion.heading), way)
            })
            .collect();
        let velocities = [0, 1].map(|axis| Column(motions.iter().map(|m| m.velocity[axis]).collect()));
        let slopes = velocities.map(|velocity| velocity.slope().0);
        let mut acceleration = [Vec::with_capacity(points), Vec::with_capacity(points)];
        for (point, motion) in motions.iter().enumerate() {
            let change = DVec2::new(slopes[0][point], slopes[1][point]);
            let ahead = direction(motion.heading);
            acceleration[0].push(ahead.dot(change));
            acceleration[1].push(ahead.perp().dot(change));
        }
        Columns {
            phase: Column(gauss(&phase, 0.06)),
            height: Column(vec![0.0; points]),
            run: Column(gauss(&runs, 0.15)),
            still: Column(gauss(&still, 0.3)),
            gaze: Column(gauss(&gaze, 0.2)),
            acceleration: acceleration.map(|values| Column(gauss(&values, 0.1))),
        }
    }

    /// Returns the height of the pelvis: as the gait has it, but so that legs on the ground reach it.
    fn heights(&self, person: &Person) -> Column {
        let heights: Vec<f64> = (0..self.path.points())
            .map(|point| {
                let time = self.path.time(point);
                let state = self.state(person, time);
                let free = free_height(person, &state);
                let hips = hip_joints(person, state.pelvis, state.pelvis_rotation());
                Side::BOTH.iter().fold(free, |height, side| {
                    let foot = &self.feet[side.index()];
                    let plant = &foot.plants[foot.plant(time)];
                    if time > plant.lift {
                        height
                    } else {
                        height.min(reachable_height(person, plant, time, hips[side.index()]))
                    }
                })
            })
            .collect();
        let last = heights.len() - 1;
        let lowest: Vec<f64> = (0..=last)
            .map(|i| heights[i.saturating_sub(4)..=(i + 4).min(last)].iter().copied().fold(f64::INFINITY, f64::min))
            .collect();
        Column(gauss(&lowest, 0.04))
    }

    /// Finds the ways of the feet between their plants.
    fn swing(&mut self, person: &Person) {
        for side in Side::BOTH {
            let plants = &self.feet[side.index()].plants;
            let swings = plants
                .windows(2)
                .map(|pair| {
                    let step = 0.005;
                    let [before, at] =
                        [pair[0].lift - step, pair[0].lift].map(|time| self.stance(person, side, &pair[0], time));
                    let middle = (pair[0].lift + pair[1].strike) / 2.0;
                    let other = &self.feet[side.other().index()];
                    let other = other.plants[other.plant(middle)].ankle;
                    let raise = lift_of_foot(person, self.state(person, middle).relative_speed);
                    Swing::new(
                        person,
                        side,
                        (at, FootPose::rate(&before, &at, step)),
                        pair[0].lift,
                        &pair[1],
                        other,
                        raise,
                    )
                })
                .collect();
            self.feet[side.index()].swings = swings;
        }
    }

    fn stance(&self, person: &Person, side: Side, plant: &Plant, time: f64) -> FootPose {
        let state = self.state(person, time);
        let hips = hip_joints(person, state.pelvis, state.pelvis_rotation());
        stance(person, plant, time, hips[side.index()])
    }

    /// Returns the state of the body at a time.
    fn state(&self, person: &Person, time: f64) -> BodyState {
        let place = self.path.place(time);
        let motion = self.path.motion(place);
        let columns = &self.columns;
        let (forward, _) = along(&motion);
        let leg = person.leg();
        let still = columns.still.at(place);
        let mut state = BodyState {
            time,
            pelvis: motion.position.extend(columns.height.at(place)),
            heading: motion.heading,
            forward: forward / leg,
            relative_speed: motion.velocity.length() / leg,
            acceleration: [columns.acceleration[0].at(place), columns.acceleration[1].at(place)],
            phase: columns.phase.at(place),
            run: columns.run.at(place),
            still,
            weight: idle_weight(person, still, time),
            gaze: columns.gaze.at(place),
        };
        state.pelvis += sway(person, &state);
        state
    }

    fn pose(&self, person: &Person, time: f64) -> Pose {
        let state = self.state(person, time);
        let pelvis = state.pelvis_rotation();
        let hips = hip_joints(person, state.pelvis, pelvis);
        let feet = Side::BOTH.map(|side| {
            let foot = &self.feet[side.index()];
            let number = foot.plant(time);
            let plant = &foot.plants[number];
            match foot.swings.get(number) {
                Some(swing) if time > plant.lift => swing.at(time),
                _ => stance(person, plant, time, hips[side.index()]),
            }
        });
        pose(person, &state, pelvis, &feet)
    }
}

/// Returns the angle by which a person that faces a direction looks aside to where it goes, rad.
pub(crate) fn gaze_along(facing: DVec2, way: DVec2) -> f64 {
    let (forward, left) = (facing.dot(way), facing.perp().dot(way));
    // a person looks where it goes, not where it steps back to
    if forward > 0.0 { libm::atan2(left, forward).clamp(-1.0, 1.0) * smooth(forward / 0.4) } else { 0.0 }
}

/// Returns how far the pelvis is from the path, m.
pub(crate) fn sway(person: &Person, state: &BodyState) -> DVec3 {
    let scale = person.leg() / 0.86;
    let walk = gait::lateral(state.relative_speed, state.phase) * person.sway * 0.8 * (1.0 - 0.8 * state.run);
    let rest = 0.025 * state.weight;
    (direction(state.heading).perp() * ((walk + rest) * scale)).extend(0.0)
}

/// Returns the height of the pelvis that the gait has, m.
pub(crate) fn free_height(person: &Person, state: &BodyState) -> f64 {
    let scale = person.leg() / 0.86;
    let rv = state.relative_speed.min(2.4);
    let duty = gait::running_duty(state.relative_speed * person.leg());
    // knees are a little bent in walking
    let bent = 0.008 * person.leg() * smooth(rv);
    let change = mix(gait::vertical(rv, state.phase), gait::running_vertical(duty, state.phase), state.run);
    standing_height(person) - bent + scale * change
}

/// Returns the height of the pelvis of a standing person, m.
fn standing_height(person: &Person) -> f64 {
    foot_at(person, DVec2::ZERO, 0.0, 0.0).ankle.z + 0.994 * person.leg()
}

/// Returns the largest height of a hip from which the leg reaches a foot on the ground, m.
pub(crate) fn reachable_height(person: &Person, plant: &Plant, time: f64, hip: DVec3) -> f64 {
    let foot = foot_at(person, plant.ankle, plant.yaw, -0.85 * allowed_roll(plant, time));
    let reach = (STRETCH - 0.004) * person.leg();
    let away = (hip.truncate() - foot.ankle.truncate()).length_squared();
    let height = foot.ankle.z + (reach * reach - away).max(0.0).sqrt();
    height.max(0.78 * standing_height(person))
}

/// Returns how far a foot is lifted in the middle of its swing, m.
pub(crate) fn lift_of_foot(person: &Person, relative_speed: f64) -> f64 {
    let fast = (relative_speed / 1.6).min(1.0);
    (0.025 + 0.03 * fast + 0.12 * (relative_speed - 2.2).clamp(0.0, 1.0)) * person.leg() / 0.86
}
