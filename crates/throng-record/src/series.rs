//! Figures over time: how a run goes, moment by moment.
//!
//! | figure | what | unit |
//! |---|---|---|
//! | `arrived` | agents at the end of their journeys, those removed by exits included | agents |
//! | `separation` | least distance of two centres (of cores, for bodies that are no discs) over the sum of their radii, of all pairs present; 1: they touch | |
//! | `speed` | mean speed of those who walk | m/s |
//! | `turning` | mean change of heading, either way, of those who walk, since the moment before | °/s |
//! | `swing` | mean of how far velocities went there and back over the last two moments, of those who walk (see [`swing`]) | m/s |
//!
//! What is a mean over nobody is not a number. Moments are what is pushed, in the program every step: a summary,
//! which looks at every sub-step, can know of a closer meeting.

use crate::{Body, Frame};
use glam::Vec2;
use std::f32::consts::TAU;
use throng::Status;
use throng::space::Core;

/// Figures of one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Seconds since the start.
    pub time: f64,
    /// Agents at the end of their journeys.
    pub arrived: usize,
    /// Least separation of two bodies; infinite for fewer than two.
    pub separation: f64,
    /// Mean speed, m/s.
    pub speed: f64,
    /// Mean change of heading, degrees a second.
    pub turning: f64,
    /// Mean swing of velocities, m/s.
    pub swing: f64,
}

/// Figures over time. See the [module](self) for what they are.
///
/// ```
/// use throng_record::{Frame, series::Series};
/// let mut series = Series::default();
/// series.push(&Frame::default());
/// assert_eq!(series.points()[0].arrived, 0);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Series {
    points: Vec<Point>,
    /// The last two moments, the last one first.
    before: [Frame; 2],
    /// The consecutive moments of the greatest swing, and that swing.
    peak: Option<(f64, [Frame; 3])>,
}

impl Series {
    /// Takes in the next moment.
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
        self.points.push(Point {
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

    /// The figures of every moment.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// The three consecutive moments in which velocities swung most, summed over all who walk; `None` where nobody's
    /// did.
    pub fn peak(&self) -> Option<&[Frame; 3]> {
        self.peak.as_ref().map(|(_, frames)| frames)
    }

    /// At most `most` points: stretches of as many moments each become one, with the least separation, the means of
    /// speed, turning and swing, and time and arrivals of the last.
    pub fn thinned(&self, most: usize) -> Vec<Point> {
        let stretch = self.points.len().div_ceil(most.max(1)).max(1);
        self.points.chunks(stretch).map(summed_up).collect()
    }
}

/// How far a velocity goes there and back over three moments, m/s: the way from the first by the second to the third,
/// less the way from the first to the third. 0 where it only turns or only changes its speed one way; twice the change
/// for one that is back where it was.
pub fn swing(a: Vec2, b: Vec2, c: Vec2) -> f32 {
    (a.distance(b) + b.distance(c) - a.distance(c)).max(0.0)
}

/// Least distance of two centres, in space, over the sum of their radii; infinite for fewer than two. Of bodies that are no discs,
/// what counts is the distance of their cores; where those overlap, the negative of the least shift that parts them.
pub fn least_separation(bodies: &[Body]) -> f64 {
    let mut order: Vec<&Body> = bodies.iter().filter(|body| body.position.is_finite()).collect();
    order.sort_by(|a, b| a.position.x.total_cmp(&b.position.x));
    let largest = order.iter().map(|body| f64::from(body.radius)).fold(0.0, f64::max);
    let reach = |body: &Body| f64::from(body.core.length());
    let farthest = order.iter().map(|body| reach(body)).fold(0.0, f64::max);
    // Neighbours in the order come first: what they find ends the search of the others early.
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

/// Distance of two bodies over the sum of their radii.
fn apart(a: &Body, b: &Body) -> f64 {
    let discs = a.core == Vec2::ZERO && b.core == Vec2::ZERO;
    let core = |body: &Body| Core::new(body.position, body.heading, body.core);
    let distance = if discs { a.center().distance(b.center()) } else { core(a).separation(&core(b)).distance };
    distance / (f64::from(a.radius) + f64::from(b.radius))
}

/// An agent by its number.
fn find(frame: &Frame, number: u32) -> Option<&Body> {
    frame.bodies.binary_search_by_key(&number, |body| body.number).ok().map(|k| &frame.bodies[k])
}

/// The angle between two headings, radians.
fn turn(from: f32, to: f32) -> f32 {
    let turned = (to - from).abs() % TAU;
    turned.min(TAU - turned)
}

fn summed_up(points: &[Point]) -> Point {
    let mean = |figure: fn(&Point) -> f64| {
        let mut mean = Mean::default();
        points.iter().map(figure).filter(|value| value.is_finite()).for_each(|value| mean.add(value));
        mean.value()
    };
    let last = points[points.len() - 1];
    Point {
        separation: points.iter().map(|point| point.separation).fold(f64::INFINITY, f64::min),
        speed: mean(|point| point.speed),
        turning: mean(|point| point.turning),
        swing: mean(|point| point.swing),
        ..last
    }
}

/// A mean while it is counted.
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
    fn one_who_swings_is_seen_and_the_moments_are_kept() {
        let mut series = Series::default();
        for k in 0..20u8 {
            let mut bodies =
                vec![Body::walking(3, DVec2::ZERO), Body::walking(5, DVec2::X), Body::walking(9, DVec2::Y)];
            // 3 leaves, 5 swings for a while, 9 has arrived and counts for nothing
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
