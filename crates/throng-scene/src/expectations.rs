//! Checks the expectations of a scene (`[expect]`).

mod gauge;
mod walking_speed;

use self::gauge::Gauge;
pub use self::walking_speed::WalkingSpeed;
use self::walking_speed::nanometres;
use crate::assemble::Built;
use crate::geometry::DVec2;
use crate::scene::{Arrived, Expect, FlowExpect};
use serde::Serialize;
use std::fmt;
use throng::World;
use throng::space::crosses_line;

/// The expectations of a scene (`[expect]`), measured step by step during a run.
///
/// ```
/// use throng_scene::{Expectations, gallery};
///
/// let scene = gallery::scene("headon")?;
/// let (mut world, built) = scene.build()?;
/// let mut watch = Expectations::new(&scene.expect, &world, &built);
/// while !scene.time.over(&world) {
///     world.step();
///     watch.step(&world);
/// }
/// let verdict = watch.verdict(&world);
/// assert!(verdict.passed, "{verdict}");
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Expectations {
    expect: Expect,
    /// The time at which enough agents had arrived.
    reached: Option<f64>,
    speed: WalkingSpeed,
    /// The last position of each agent, by its number; not finite before the agent entered.
    positions: Vec<DVec2>,
    flows: Vec<LineFlow>,
    gauges: Vec<Gauge>,
}

/// The outcome of the checks.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Outcome {
    /// Whether all checks passed.
    pub passed: bool,
    /// The checks, in the order of the keys of `[expect]`.
    pub checks: Vec<Expectation>,
}

/// One check.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Expectation {
    /// The key of `[expect]`: `arrived`, `within`, `least_separation`, `least_wall_separation`, `heading_change`,
    /// `mean_speed`, `final_speed`, `blocked`, `stuck`, `flow.0.at_least`, `distance.0.at_most`, `figure.0.at_least` and the like.
    pub name: String,
    /// The bound: a count, seconds, a ratio, degrees a second, m/s, agents a second, metres, or the unit of a game's
    /// figure.
    pub expected: Figure,
    /// The measured value, in the same unit; `None` if there was nothing to measure.
    pub found: Option<Figure>,
    /// Whether the measured value is within the bound.
    pub passed: bool,
}

/// A figure of a check.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Figure {
    /// A count.
    Count(usize),
    /// A finite measure.
    Measure(f64),
}

/// Crossings of a line.
#[derive(Clone, Copy, Debug)]
struct LineFlow {
    line: FlowExpect,
    count: u64,
    first: f64,
    last: f64,
}

impl Expectations {
    /// Starts to observe a world built from a scene, best before its first step.
    pub fn new(expect: &Expect, world: &World, built: &Built) -> Self {
        let flow = |line: &FlowExpect| LineFlow { line: *line, count: 0, first: 0.0, last: 0.0 };
        let mut watch = Self {
            flows: expect.flow.iter().map(flow).collect(),
            gauges: Gauge::all(expect, world, built),
            expect: expect.clone(),
            reached: None,
            speed: WalkingSpeed::default(),
            positions: Vec::new(),
        };
        watch.arrivals(world);
        watch.crossings(world);
        watch
    }

    /// Records the world after a step.
    pub fn step(&mut self, world: &World) {
        self.arrivals(world);
        self.crossings(world);
        self.gauges.iter_mut().for_each(|gauge| gauge.step(world));
        if self.expect.mean_speed.is_some() {
            self.speed.step(world);
        }
    }

    /// Returns how many of `agents` must arrive, if that is checked.
    fn needed(&self, agents: usize) -> Option<usize> {
        match (self.expect.arrived, self.expect.within) {
            (None, None) => None,
            (None | Some(Arrived::All), _) => Some(agents),
            (Some(Arrived::Number(number)), _) => Some(usize::try_from(number).unwrap_or(usize::MAX)),
            // a share of 0.9 of 10 agents is 9, whatever the rounding
            (Some(Arrived::Fraction(share)), _) => Some((share * agents as f64 - 1e-9).ceil() as usize),
        }
    }

    fn arrivals(&mut self, world: &World) {
        if self.reached.is_some() || self.needed(0).is_none() {
            return;
        }
        let counts = world.counts();
        if self.needed(counts.agents).is_some_and(|needed| counts.arrived >= needed) {
            self.reached = Some(world.time());
        }
    }

    fn crossings(&mut self, world: &World) {
        if self.flows.is_empty() {
            return;
        }
        let (agents, origin) = (world.relative_columns(), world.settings().origin);
        for row in 0..agents.len() {
            let number = agents.number[row] as usize;
            if number >= self.positions.len() {
                self.positions.resize(number + 1, DVec2::NAN);
            }
            let now = agents.position[row].as_dvec2() + origin;
            let before = std::mem::replace(&mut self.positions[number], now);
            // an agent that is replaced or enters did not walk from its last position
            if !before.is_finite() || agents.entered[row] >= world.time() {
                continue;
            }
            for flow in &mut self.flows {
                if crosses_line(before, now, [flow.line.from.into(), flow.line.to.into()]) {
                    flow.first = if flow.count == 0 { world.time() } else { flow.first };
                    flow.last = world.time();
                    flow.count += 1;
                }
            }
        }
    }

    /// Returns the outcome of the checks.
    pub fn verdict(&self, world: &World) -> Outcome {
        let (expect, summary) = (&self.expect, world.summary());
        let mut checks = Vec::new();
        let mut check = |name: String, expected: Figure, found: Option<Figure>, passed: bool| {
            checks.push(Expectation { name, expected, found, passed });
        };
        if let Some(needed) = self.needed(summary.agents) {
            let arrived = summary.arrived;
            check("arrived".into(), Figure::Count(needed), Some(Figure::Count(arrived)), arrived >= needed);
        }
        let agents = world.relative_columns();
        let speeds = (0..agents.len()).map(|row| nanometres(agents.speed(row)));
        let final_speed = speeds.sum::<i128>() as f64 * 1e-9 / agents.len().max(1) as f64;
        let bounds = [
            ("within", expect.within, self.reached.unwrap_or(f64::INFINITY), at_most as Holds),
            ("least_separation", expect.least_separation, summary.least_separation, at_least),
            ("least_wall_separation", expect.least_wall_separation, summary.least_wall_separation, at_least),
            ("heading_change", expect.heading_change, summary.heading_change_deg_per_s, at_most),
            ("mean_speed", expect.mean_speed, self.speed.mean(), at_least),
            ("final_speed", expect.final_speed, final_speed, at_most),
        ];
        for (name, bound, found, holds) in bounds {
            if let Some(bound) = bound {
                check(name.into(), Figure::Measure(bound), Figure::measure(found), holds(found, bound));
            }
        }
        let hindered = summary.hindered;
        let counts = [
            ("waiting_for_room", expect.waiting_for_room, hindered.waiting_for_room),
            ("blocked", expect.blocked, hindered.blocked),
            ("oscillating", expect.oscillating, hindered.oscillating),
            ("stuck", expect.stuck, summary.stuck),
            ("without_progress_30s", expect.without_progress_30s, saturating(summary.without_progress_30s)),
        ];
        for (name, most, found) in counts {
            if let Some(most) = most.map(saturating) {
                check(name.into(), Figure::Count(most), Some(Figure::Count(found)), found <= most);
            }
        }
        for (index, flow) in self.flows.iter().enumerate() {
            let (rate, FlowExpect { at_least: least, at_most: most, .. }) = (flow.rate(), flow.line);
            let found = rate.and_then(Figure::measure);
            if let Some(least) = least {
                check(
                    format!("flow.{index}.at_least"),
                    Figure::Measure(least),
                    found,
                    at_least(rate.unwrap_or(0.0), least),
                );
            }
            if let Some(most) = most {
                check(
                    format!("flow.{index}.at_most"),
                    Figure::Measure(most),
                    found,
                    at_most(rate.unwrap_or(0.0), most),
                );
            }
        }
        checks.extend(self.gauges.iter().flat_map(Gauge::checks));
        Outcome { passed: checks.iter().all(|check| check.passed), checks }
    }
}

/// Converts a count; one that is too large becomes the largest `usize`.
fn saturating(count: u64) -> usize {
    usize::try_from(count).unwrap_or(usize::MAX)
}

/// Whether a measured value is within a bound.
type Holds = fn(found: f64, bound: f64) -> bool;

/// Bounds are written in decimals: the tolerance of 1e-9 absorbs their rounding.
fn at_least(found: f64, least: f64) -> bool {
    found >= least - 1e-9
}

fn at_most(found: f64, most: f64) -> bool {
    found <= most + 1e-9
}

impl Figure {
    /// Returns a figure; `None` for a value that is not finite.
    fn measure(value: f64) -> Option<Self> {
        value.is_finite().then_some(Self::Measure(value))
    }
}

impl fmt::Display for Figure {
    /// Writes at most four decimals.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Count(count) => count.fmt(f),
            Self::Measure(value) => ((value * 1e4).round() / 1e4).fmt(f),
        }
    }
}

impl fmt::Display for Expectation {
    /// Writes `within passed: expected 15.1, found 13.4`.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { name, expected, passed, .. } = self;
        write!(f, "{name} {}: expected {expected}, found ", if *passed { "passed" } else { "FAILED" })?;
        match &self.found {
            Some(found) => found.fmt(f),
            None => f.write_str("nothing"),
        }
    }
}

impl fmt::Display for Outcome {
    /// Writes the checks, one a line.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let lines: Vec<String> = self.checks.iter().map(Expectation::to_string).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl LineFlow {
    /// Returns the agents a second between the first and the last crossing; `None` for fewer than two crossings.
    fn rate(&self) -> Option<f64> {
        (self.count > 1 && self.last > self.first).then(|| (self.count - 1) as f64 / (self.last - self.first))
    }
}
