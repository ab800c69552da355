//! Figures of a run over time.
//!
//! | figure | what | unit |
//! |---|---|---|
//! | `arrived` | agents at the end of their journeys, including agents removed by exits | agents |
//! | `separation` | least distance of two centres (of two cores for bodies other than discs) over the sum of their radii, over all pairs; 1: two agents touch | |
//! | `speed` | mean speed of walking agents | m/s |
//! | `turning` | mean absolute change of heading of walking agents since the previous frame | °/s |
//! | `swing` | mean swing of the velocities of walking agents over the last three frames (see [`swing`]) | m/s |
//!
//! A mean over no agents is NaN. The figures are of the frames that are pushed; the program pushes one frame per step.
//! A summary looks at every sub-step and may therefore report a smaller separation.

use crate::{Body, Frame};
use glam::Vec2;
use std::f32::consts::TAU;
use throng::Status;
use throng::space::Core;

/// The figures of one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeriesPoint {
    /// Time since the start, seconds.
    pub time: f64,
    /// Number of agents at the end of their journeys.
    pub arrived: usize,
    /// Least separation of two bodies; infinite for fewer than two bodies.
    pub separation: f64,
    /// Mean speed, m/s.
    pub speed: f64,
    /// Mean change of heading, °/s.
    pub turning: f64,
    /// Mean swing of velocities, m/s.
    pub swing: f64,
}

/// Figures over time. The [module](self) defines them.
///
/// ```
/// use throng_record::{Frame, series::Series};
/// let mut series = Series::default();
/// series.push(&Frame::default());
/// assert_eq!(series.points()[0].arrived, 0);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Series {
    points: Vec<SeriesPoint>,
    /// The last two frames, latest first.
    before: [Frame; 2],
    /// The three consecutive frames of the greatest swing, and that swing.
    peak: Option<(f64, [Frame; 3])>,
}

impl Series {
    /// Adds the figures of the next frame.
    pub fn push(&mut self, frame: &Frame) {
        let [last, older] = &self.before;
        let walks = |body: &&Body| body.status == Status::Walking;
        let seconds = frame.time - last.time;
        let (mut turning, mut swinging) = (Mean::default(), Mean::default());
        for body in frame.bodies.iter().filter(walks) {
            let Some(last) = find(last, body.number) else { continue };
            turning.add(f64::from(turn(last.heading, body.heading)).to_degrees() / seconds);
            if let Some(older) = find(older, body.number) {
                swinging.add(f64::from(swing(older.velocity, last.velocity, body.velocity)));
            }
        }
        let mut speed = Mean::default();
        frame.bodies.iter().filter(walks).for_each(|body| speed.add(f64::from(body.speed())));
        self.points.push(SeriesPoint {
            time: frame.time,
            arrived: frame.arrived,
            separation: least_separation(&frame.bodies),
            speed: speed.value(),
            turning: turning.value(),
            swing: swinging.value(),
        });
        if swinging.sum > self.peak.as_ref().map_or(0.0, |peak| peak.0) {
            self.peak = Some((swinging.sum, [older.clone(), last.clone(), frame.clone()]));
        }
        self.before.swap(0, 1);
        self.before[0].clone_from(frame);
    }

    /// Returns the figures of every frame.
    pub fn points(&self) -> &[SeriesPoint] {
        &self.points
    }

    /// Returns the mean of a figure over all frames at which it is known; NaN if there are none.
    pub fn mean(&self, figure: impl Fn(&SeriesPoint) -> f64) -> f64 {
        let mut mean = Mean::default();
        self.points.iter().map(figure).filter(|value| value.is_finite()).for_each(|value| mean.add(value));
        mean.value()
    }

    /// Returns the three consecutive frames with the greatest swing, summed over all walking agents. Returns `None` if
    /// no velocity swung.
    pub fn peak(&self) -> Option<&[Frame; 3]> {
        self.peak.as_ref().map(|(_, frames)| frames)
    }

    /// Returns at most `most` points. Each point summarises a run of consecutive points: the least separation, the
    /// means of speed, turning and swing, and the time and the arrivals of the last point.
    pub fn thinned(&self, most: usize) -> Vec<SeriesPoint> {
        let stretch = self.points.len().div_ceil(most.max(1)).max(1);
        self.points.chunks(stretch).map(summed_up).collect()
    }
}

/// Returns the swing of three consecutive velocities, m/s: the distance from the first by way of the second to the
/// third, less the distance from the first to the third. The swing is 0 where the velocity only turns on or changes its
/// speed in one direction. It is twice the change where the third velocity equals the first.
pub fn swing(a: Vec2, b: Vec2, c: Vec2) -> f32 {
    (a.distance(b) + b.distance(c) - a.distance(c)).max(0.0)
}

/// Returns the least distance of two centres, in space, over the sum of their radii; infinite for fewer than two
/// bodies. Bodies other than discs are measured between their cores. For overlapping cores, the distance is the
/// negative of the least shift that separates them.
pub fn least_separation(bodies: &[Body]) -> f64 {
    let mut order: Vec<&Body> = bodies.iter().filter(|body| body.position.is_finite()).collect();
    order.sort_by(|a, b| a.position.x.total_cmp(&b.position.x));
    let largest = order.iter().map(|body| f64::from(body.radius)).fold(0.0, f64::max);
    let reach = |body: &Body| f64::from(body.core.length());
    let farthest = order.iter().map(|body| reach(body)).fold(0.0, f64::max);
    // Adjacent bodies of the order come first: a small distance found early shortens the search of all pairs.
    let mut least = order.windows(2).map(|pair| apart(pair[0], pair[1])).fold(f64::INFINITY, f64::min);
    for (k, a) in order.iter().enumerate() {
        for b in &order[k + 1..] {
            let radii = f64::from(a.radius) + if least > 0.0 { largest } else { 0.0 };
            if b.position.x - a.position.x - reach(a) - farthest > least * radii {
                break;
            }
            least = least.min(apart(a, b));
        }
    }
    least
}

/// Returns the distance of two bodies over the sum of their radii.
fn apart(a: &Body, b: &Body) -> f64 {
    let discs = a.core == Vec2::ZERO && b.core == Vec2::ZERO;
    let core = |body: &Body| Core::new(body.position, body.heading, body.core);
    let distance = if discs { a.center().distance(b.center()) } else { core(a).separation(&core(b)).distance };
    distance / (f64::from(a.radius) + f64::from(b.radius))
}

/// Finds an agent by its number.
fn find(frame: &Frame, number: u32) -> Option<&Body> {
    frame.bodies.binary_search_by_key(&number, |body| body.number).ok().map(|k| &frame.bodies[k])
}

/// Returns the angle between two headings, radians.
fn turn(from: f32, to: f32) -> f32 {
    let turned = (to - from).abs() % TAU;
    turned.min(TAU - turned)
}

fn summed_up(points: &[SeriesPoint]) -> SeriesPoint {
    let mean = |figure: fn(&SeriesPoint) -> f64| {
        let mut mean = Mean::default();
        points.iter().map(figure).filter(|value| value.is_finite()).for_each(|value| mean.add(value));
        mean.value()
    };
    let last = points[points.len() - 1];
    SeriesPoint {
        separation: points.iter().map(|point| point.separation).fold(f64::INFINITY, f64::min),
        speed: mean(|point| point.speed),
        turning: mean(|point| point.turning),
        swing: mean(|point| point.swing),
        ..last
    }
}

/// The sum and the count of a mean.
#[derive(Default)]
struct Mean {
    sum: f64,
    count: u32,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1;
    }

    fn value(&self) -> f64 {
        self.sum / f64::from(self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draws::draws;
    use glam::DVec2;

    #[test]
    fn the_least_separation_is_that_of_all_pairs() {
        let mut draw = draws(7);
        for count in [0, 1, 2, 3, 10, 200] {
            let one = |k| {
                let core = if k % 3 == 0 { Vec2::new(draw() as f32, 0.1) } else { Vec2::ZERO };
                let (radius, heading) = ((0.05 + draw()) as f32, 6.0 * draw() as f32);
                let altitude = if k % 4 == 1 { 2.0 * draw() as f32 } else { 0.0 };
                Body { radius, heading, core, altitude, ..Body::walking(k, DVec2::new(30.0 * draw(), 3.0 * draw())) }
            };
            let bodies: Vec<Body> = (0..count).map(one).collect();
            let pairs = bodies.iter().enumerate().flat_map(|(k, a)| bodies[..k].iter().map(move |b| (a, b)));
            let least = pairs.map(|(a, b)| apart(a, b)).fold(f64::INFINITY, f64::min);
            let (want, found) = (least, least_separation(&bodies));
            assert!(want == found || (want - found).abs() < 1e-6, "{count}: {found}, not {want}");
        }
    }

    #[test]
    fn turning_on_is_no_swing_and_there_and_back_is() {
        let (x, y) = (Vec2::X, Vec2::Y);
        assert_eq!(swing(x, x, x), 0.0);
        assert!(swing(x, x * 1.5, x * 2.0) < 1e-6);
        assert!(swing(x, (x + y).normalize(), y) < 0.2);
        assert!((swing(x, y, x) - 2.0 * 2f32.sqrt()).abs() < 1e-6);
    }

    #[test]
    fn an_agent_that_swings_is_found_and_its_frames_are_kept() {
        let mut series = Series::default();
        for k in 0..20u8 {
            let mut bodies =
                vec![Body::walking(3, DVec2::ZERO), Body::walking(5, DVec2::X), Body::walking(9, DVec2::Y)];
            // 3 leaves, 5 swings for a while, 9 has arrived and does not count
            if k > 4 {
                bodies.remove(0);
            }
            let n = bodies.len();
            bodies[n - 2].velocity = if k >= 10 && k % 2 == 1 { Vec2::Y } else { Vec2::X };
            bodies[n - 2].heading = f32::from(k) * 0.4;
            bodies[n - 1].status = Status::Arrived;
            bodies[n - 1].heading = f32::from(k);
            series.push(&Frame { time: f64::from(k) * 0.1, bodies, arrived: 1, total: 3, ..Frame::default() });
        }
        let points = series.points();
        assert!(
            points[0].turning.is_nan() && points[1].swing.is_nan() && points[0].separation == 1.0 / f64::from(0.4f32)
        );
        assert!((points[3].turning - 0.5 * 4f64.to_degrees()).abs() < 1e-3, "a mean over two: {}", points[3].turning);
        assert!((points[19].turning - 4f64.to_degrees()).abs() < 1e-3, "{}", points[19].turning);
        assert_eq!((points[9].swing, points[8].speed), (0.0, 1.0));
        assert!((points[12].swing - 8f64.sqrt()).abs() < 1e-6);
        let times = series.peak().unwrap().each_ref().map(|frame| (frame.time * 10.0).round());
        assert_eq!(times, [10.0, 11.0, 12.0]);
        let thin = series.thinned(5);
        assert_eq!((thin.len(), thin[4].time, thin[1].arrived), (5, points[19].time, 1));
    }
}
