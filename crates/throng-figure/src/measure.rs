//! How well feet stand: measured in any motion, ours or that of a file that was read back.

use crate::person::{Person, Side};
use crate::pose::{JOINTS, Joint, Legs, Placed};
use glam::DVec3;

/// A foot touches the ground where its heel or its ball is lower than this, m.
const CONTACT: f64 = 0.004;
/// The shortest contact that is a step, s.
const SHORTEST: f64 = 0.08;
/// Of the skating ratio: a foot lower than this (m) and faster than this (m/s) skates. Source: Karunratanakul et al.,
/// "Guided Motion Diffusion", 2023.
const SKATING_HEIGHT: f64 = 0.05;
const SKATING_SPEED: f64 = 0.5;
/// Half the window over which the speed of the skating ratio is the mean, s.
const SKATING_WINDOW: f64 = 0.1;

/// Measures the feet of a person, moment by moment.
///
/// Take moments at four times the rate of a file, so that what its readers interpolate counts too.
///
/// ```
/// use glam::DVec2;
/// use throng_figure::{Person, Sample, Skeleton, Walk, measure::FeetMeasure};
///
/// let sample = |time: f64| Sample { time, position: DVec2::new(1.3 * time, 0.0), heading: 0.0 };
/// let person = Person::new(1, 7);
/// let walk = Walk::recorded(&person, &[sample(0.0), sample(10.0)])?;
/// let skeleton = Skeleton::new(&person);
///
/// let mut feet = FeetMeasure::new(&person);
/// for moment in 0..=1000 {
///     let time = f64::from(moment) / 100.0;
///     feet.push(time, &skeleton.world(&walk.pose(time)));
/// }
/// let report = feet.report();
/// assert!(report.steps > 15 && report.mean_slide < 0.001);
/// # Ok::<(), throng_figure::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct FeetMeasure {
    body: Legs,
    height: f64,
    moments: Vec<Moment>,
}

#[derive(Debug, Clone, Copy)]
struct Moment {
    time: f64,
    feet: [FootPoints; 2],
    /// The direction to the left of the body.
    left: DVec3,
}

/// Points of a foot; the ground is at 0.
#[derive(Debug, Clone, Copy)]
struct FootPoints {
    heel: DVec3,
    /// Below the joint of the toes.
    ball: DVec3,
    tip: DVec3,
    ankle: DVec3,
}

impl FootPoints {
    fn lowest(&self) -> f64 {
        self.heel.z.min(self.ball.z).min(self.tip.z)
    }
}

/// What the feet of a person do.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FeetReport {
    /// Number of contacts of a foot with the ground.
    pub steps: usize,
    /// How far the point of contact, first the heel and then the ball, gets from where it touched the ground in a step,
    /// m: the mean over the steps.
    pub mean_slide: f64,
    /// The 95th percentile of the same over the steps, m.
    pub p95_slide: f64,
    /// The largest of the same over the steps, m.
    pub largest_slide: f64,
    /// Length of the path of the point of contact in a step, m: the mean over the steps. Every tremble counts, those of
    /// interpolation too.
    pub mean_path: f64,
    /// Share of moments at which a foot is lower than 5 cm and faster than 0.5 m/s (skating ratio of Guided Motion
    /// Diffusion).
    pub skating_ratio: f64,
    /// How far a foot is below the ground at most, m.
    pub penetration: f64,
    /// Share of moments at which no foot touches the ground: 0 in walking.
    pub airborne: f64,
    /// Least distance of an ankle from the other on its own side of the body, m: less than 0 where feet cross.
    pub least_gap: f64,
    /// Least distance of the lines from heel to toes of the two feet on the ground plane, m.
    pub least_distance: f64,
}

impl FeetMeasure {
    /// Returns the measure of a person, without moments.
    pub fn new(person: &Person) -> FeetMeasure {
        FeetMeasure { body: person.legs, height: person.height, moments: Vec::new() }
    }

    /// Adds a moment: its time (s, after that of the last) and where the joints are, in the order of [`Joint::ALL`].
    pub fn push(&mut self, time: f64, joints: &[Placed; JOINTS]) {
        let (body, h) = (&self.body, self.height);
        let feet =
            [(Joint::LeftFoot, Joint::LeftToeBase), (Joint::RightFoot, Joint::RightToeBase)].map(|(foot, toes)| {
                let (foot, toes) = (joints[foot.index()], joints[toes.index()]);
                let tip = body.foot - body.heel - body.ball;
                FootPoints {
                    heel: foot.position + foot.rotation * (DVec3::new(-body.heel, 0.0, -body.ankle) * h),
                    // the toes roll about their joint, so the joint is the point that stays
                    ball: toes.position - DVec3::Z * (body.toe_height * h),
                    tip: toes.position + toes.rotation * (DVec3::new(tip, 0.0, -body.toe_height) * h),
                    ankle: foot.position,
                }
            });
        let left = joints[Joint::Hips.index()].rotation * DVec3::Y;
        self.moments.push(Moment { time, feet, left });
    }

    /// Returns what was measured. Without moments all numbers are 0.
    pub fn report(&self) -> FeetReport {
        let moments = &self.moments;
        if moments.is_empty() {
            return FeetReport::default();
        }
        let (mut slides, paths): (Vec<f64>, Vec<f64>) = Side::BOTH.iter().flat_map(|&side| self.slides(side)).unzip();
        slides.sort_by(f64::total_cmp);
        let steps = slides.len();
        let share = |count: usize| count as f64 / moments.len() as f64;
        let airborne = moments.iter().filter(|m| m.feet.iter().all(|foot| foot.lowest() > 2.0 * CONTACT)).count();
        let skating = (0..moments.len()).filter(|&i| Side::BOTH.iter().any(|&side| self.skates(side, i))).count();
        let least = |of: &dyn Fn(&Moment) -> f64| moments.iter().map(of).fold(f64::INFINITY, f64::min);
        FeetReport {
            steps,
            mean_slide: slides.iter().sum::<f64>() / steps.max(1) as f64,
            p95_slide: slides.get((steps * 95).div_ceil(100).max(1) - 1).copied().unwrap_or(0.0),
            largest_slide: slides.last().copied().unwrap_or(0.0),
            mean_path: paths.iter().sum::<f64>() / steps.max(1) as f64,
            skating_ratio: share(skating),
            penetration: -least(&|m| m.feet[0].lowest().min(m.feet[1].lowest())).min(0.0),
            airborne: share(airborne),
            least_gap: least(&|m| {
                m.left.truncate().normalize_or_zero().dot((m.feet[0].ankle - m.feet[1].ankle).truncate())
            }),
            least_distance: least(&|m| distance(&m.feet)),
        }
    }

    /// Returns, for each step of a side, how far the point of contact gets from where it touched, and the length of its
    /// path.
    fn slides(&self, side: Side) -> Vec<(f64, f64)> {
        let mut slides = Vec::new();
        let mut contact = Contact::default();
        for moment in &self.moments {
            let foot = moment.feet[side.index()];
            if !contact.continues(moment.time, [foot.heel, foot.ball]) {
                slides.extend(std::mem::take(&mut contact).step());
            }
        }
        slides.extend(contact.step());
        slides
    }

    fn skates(&self, side: Side, index: usize) -> bool {
        let moment = &self.moments[index];
        let of = |moment: &Moment| moment.feet[side.index()].ball;
        let from = self.moments[..=index].partition_point(|m| m.time < moment.time - SKATING_WINDOW);
        let to = index + self.moments[index..].partition_point(|m| m.time <= moment.time + SKATING_WINDOW) - 1;
        let window = &self.moments[from..=to];
        let duration = window[window.len() - 1].time - window[0].time;
        let path: f64 = window.windows(2).map(|pair| (of(&pair[1]) - of(&pair[0])).truncate().length()).sum();
        window.iter().all(|m| of(m).z < SKATING_HEIGHT) && duration > 0.0 && path / duration > SKATING_SPEED
    }
}

/// A contact of a foot with the ground.
#[derive(Debug, Clone, Copy, Default)]
struct Contact {
    since: Option<f64>,
    last: f64,
    /// Where the heel and the ball touched the ground, and where they were last, while they touch it.
    points: [Option<(DVec3, DVec3)>; 2],
    slide: f64,
    path: f64,
}

impl Contact {
    /// Adds a moment. Returns whether the foot touches the ground.
    fn continues(&mut self, time: f64, points: [DVec3; 2]) -> bool {
        // where both points are on the ground, the steadier counts
        let (mut slide, mut path) = (f64::INFINITY, f64::INFINITY);
        let mut touches = false;
        for (state, point) in self.points.iter_mut().zip(points) {
            if point.z >= CONTACT {
                *state = None;
                continue;
            }
            touches = true;
            if let Some((first, last)) = state {
                slide = slide.min((point - *first).truncate().length());
                path = path.min((point - *last).truncate().length());
            }
            *state = Some((state.map_or(point, |(first, _)| first), point));
        }
        if slide.is_finite() {
            self.slide = self.slide.max(slide);
            self.path += path;
        }
        if touches {
            self.since.get_or_insert(time);
            self.last = time;
        }
        touches
    }

    /// Returns the slide and the path, if the contact was long enough for a step.
    fn step(self) -> Option<(f64, f64)> {
        (self.last - self.since? >= SHORTEST).then_some((self.slide, self.path))
    }
}

/// Returns the distance of the feet on the ground plane: of the lines from the heel to the tip.
fn distance(feet: &[FootPoints; 2]) -> f64 {
    let line = |foot: &FootPoints| [foot.heel.truncate(), foot.tip.truncate()];
    let [a, b] = [line(&feet[0]), line(&feet[1])];
    let side = |line: [glam::DVec2; 2], point: glam::DVec2| (line[1] - line[0]).perp_dot(point - line[0]);
    if side(a, b[0]) * side(a, b[1]) < 0.0 && side(b, a[0]) * side(b, a[1]) < 0.0 {
        return 0.0;
    }
    let to = |line: [glam::DVec2; 2], point: glam::DVec2| {
        let along = line[1] - line[0];
        let share = ((point - line[0]).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
        point.distance(line[0] + along * share)
    };
    to(a, b[0]).min(to(a, b[1])).min(to(b, a[0])).min(to(b, a[1]))
}
