//! Checking what a scene's `[expect]` says.

use serde::Serialize;
use serde_json::{Value, json};
use throng::{Status, Summary, World};
use throng_scene::{Arrived, Expect, FlowExpect};

/// What came of the checks.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// Whether all checks passed.
    pub passed: bool,
    /// The checks, in the order of the keys of `[expect]`.
    pub checks: Vec<Check>,
}

/// One check.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// The key of `[expect]`: `arrived`, `within`, `least_separation`, `heading_change`, `mean_speed`,
    /// `flow.0.at_least` and the like.
    pub name: String,
    /// The bound: a count, seconds, metres, degrees a second, m/s, agents a second.
    pub expected: Value,
    /// What the run showed, in the same unit; null where there was nothing to measure.
    pub found: Value,
    /// Whether it is within the bound.
    pub passed: bool,
}

/// Watches a run, step by step, for what the checks need and the world's summary does not hold.
#[derive(Debug)]
pub struct Watch {
    expect: Expect,
    total: usize,
    /// How many must arrive, if that is checked.
    needed: Option<usize>,
    /// When that many had.
    reached: Option<f64>,
    /// Who has ever been there, by number, and how many that is.
    seen: Vec<bool>,
    seen_count: usize,
    radii: (f32, f32),
    headings: Vec<f32>,
    greatest_turn: f64,
    speed: (f64, u64),
    positions: Vec<glam::Vec2>,
    flows: Vec<Flow>,
}

/// Crossings of a line.
#[derive(Clone, Copy, Debug)]
struct Flow {
    line: FlowExpect,
    count: u64,
    first: f64,
    last: f64,
}

impl Watch {
    /// Begins to watch a world before its first step. `total` is the number of agents, those to come included.
    pub fn new(expect: &Expect, total: usize, world: &World) -> Self {
        let needed = match (expect.arrived, expect.within) {
            (None, None) => None,
            (None | Some(Arrived::All), _) => Some(total),
            (Some(Arrived::Number(number)), _) => Some(usize::try_from(number).unwrap_or(usize::MAX)),
            (Some(Arrived::Fraction(share)), _) => Some((share * total as f64 - 1e-9).ceil() as usize),
        };
        let flow = |line: &FlowExpect| Flow { line: *line, count: 0, first: 0.0, last: 0.0 };
        let mut watch = Self {
            flows: expect.flow.iter().map(flow).collect(),
            expect: expect.clone(),
            total,
            needed,
            reached: None,
            seen: Vec::new(),
            seen_count: 0,
            radii: (f32::INFINITY, 0.0),
            headings: Vec::new(),
            greatest_turn: 0.0,
            speed: (0.0, 0),
            positions: Vec::new(),
        };
        watch.step(world);
        watch
    }

    /// How many have arrived by now, the removed ones included; takes in the world after a step.
    pub fn step(&mut self, world: &World) -> usize {
        let agents = world.agents();
        for row in 0..agents.len() {
            let number = agents.number[row] as usize;
            if number >= self.seen.len() {
                self.seen.resize(number + 1, false);
                self.headings.resize(number + 1, f32::NAN);
                self.positions.resize(number + 1, glam::Vec2::NAN);
            }
            if !std::mem::replace(&mut self.seen[number], true) {
                self.seen_count += 1;
                self.radii.0 = self.radii.0.min(agents.radius[row]);
                self.radii.1 = self.radii.1.max(agents.radius[row]);
            }
        }
        let removed = self.seen_count.saturating_sub(agents.len());
        let arrived = removed + agents.trip.iter().filter(|trip| trip.arrived.is_some()).count();
        if self.reached.is_none() && self.needed.is_some_and(|needed| arrived >= needed) {
            self.reached = Some(world.time());
        }
        if self.expect.heading_change.is_some() {
            self.turns(world);
        }
        if self.expect.mean_speed.is_some() {
            let walking = (0..agents.len()).filter(|&row| agents.status[row] == Status::Walking);
            for row in walking.filter(|_| world.steps() > 0) {
                self.speed.0 += f64::from(agents.velocity[row].length());
                self.speed.1 += 1;
            }
        }
        if !self.flows.is_empty() {
            self.crossings(world);
        }
        arrived
    }

    fn turns(&mut self, world: &World) {
        let agents = world.agents();
        for row in 0..agents.len() {
            let before = std::mem::replace(&mut self.headings[agents.number[row] as usize], agents.heading[row]);
            let turn = f64::from(agents.heading[row]) - f64::from(before);
            // An agent that was not there before has not turned.
            if turn.is_finite() {
                let turn = turn.sin().atan2(turn.cos()).abs().to_degrees();
                self.greatest_turn = self.greatest_turn.max(turn / world.settings().step);
            }
        }
    }

    fn crossings(&mut self, world: &World) {
        let (agents, origin) = (world.agents(), world.settings().origin);
        for row in 0..agents.len() {
            let now = agents.position[row];
            let before = std::mem::replace(&mut self.positions[agents.number[row] as usize], now);
            if !before.is_finite() {
                continue;
            }
            for flow in &mut self.flows {
                let line = (glam::DVec2::from(flow.line.from), glam::DVec2::from(flow.line.to));
                if crosses(before.as_dvec2() + origin, now.as_dvec2() + origin, line) {
                    flow.first = if flow.count == 0 { world.time() } else { flow.first };
                    flow.last = world.time();
                    flow.count += 1;
                }
            }
        }
    }

    /// What came of it.
    pub fn verdict(&self, summary: &Summary) -> Verdict {
        let mut checks = Vec::new();
        let mut check = |name: &str, expected: Value, found: Value, passed: bool| {
            checks.push(Check { name: name.to_owned(), expected, found, passed });
        };
        if let Some(needed) = self.needed {
            check("arrived", json!(needed), json!(summary.arrived), summary.arrived >= needed);
        }
        if let Some(within) = self.expect.within {
            let passed = self.reached.is_some_and(|time| time <= within + 1e-9);
            check("within", json!(within), json!(self.reached), passed);
        }
        if let Some(least) = self.expect.least_separation {
            let found = self.least_gap(summary.least_separation);
            check("least_separation", json!(least), number(found), found >= least - 1e-9);
        }
        if let Some(most) = self.expect.heading_change {
            check("heading_change", json!(most), json!(self.greatest_turn), self.greatest_turn <= most + 1e-6);
        }
        if let Some(least) = self.expect.mean_speed {
            let mean = (self.speed.1 > 0).then(|| self.speed.0 / self.speed.1 as f64);
            check("mean_speed", json!(least), json!(mean), mean.is_some_and(|mean| mean >= least - 1e-9));
        }
        for (index, flow) in self.flows.iter().enumerate() {
            let rate = flow.rate();
            if let Some(least) = flow.line.at_least {
                check(&format!("flow.{index}.at_least"), json!(least), json!(rate), rate.unwrap_or(0.0) >= least);
            }
            if let Some(most) = flow.line.at_most {
                check(&format!("flow.{index}.at_most"), json!(most), json!(rate), rate.unwrap_or(0.0) <= most);
            }
        }
        Verdict { passed: checks.iter().all(|check| check.passed), checks }
    }

    /// The least gap between two bodies in metres, from that in sums of radii. Where radii differ, it is not known
    /// whose gap it was, and the answer is on the safe side.
    fn least_gap(&self, ratio: f64) -> f64 {
        let radius = if ratio < 1.0 { self.radii.1 } else { self.radii.0 };
        (ratio - 1.0) * 2.0 * f64::from(radius)
    }

    /// How many agents there are in all.
    pub fn total(&self) -> usize {
        self.total
    }
}

impl Flow {
    /// Agents a second between the first and the last crossing; `None` for fewer than two.
    fn rate(&self) -> Option<f64> {
        (self.count > 1 && self.last > self.first).then(|| (self.count - 1) as f64 / (self.last - self.first))
    }
}

/// Whether the way from `a` to `b` crosses the line. Its start counts to the side it lies on, so that a way that
/// touches the line is counted once.
fn crosses(a: glam::DVec2, b: glam::DVec2, (from, to): (glam::DVec2, glam::DVec2)) -> bool {
    let side = |p: glam::DVec2| (to - from).perp_dot(p - from);
    let (before, after) = (side(a), side(b));
    if (before < 0.0) == (after < 0.0) {
        return false;
    }
    let at = a + (b - a) * (before / (before - after));
    let along = (at - from).dot(to - from);
    (0.0..=(to - from).length_squared()).contains(&along)
}

/// A number; null for one that is infinite or none.
pub fn number(value: f64) -> Value {
    if value.is_finite() { json!(value) } else { Value::Null }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    #[test]
    fn a_way_crosses_a_line_only_between_its_ends_and_once() {
        let line = (dvec2(0.0, -1.0), dvec2(0.0, 1.0));
        assert!(crosses(dvec2(-1.0, 0.0), dvec2(1.0, 0.5), line));
        assert!(crosses(dvec2(1.0, 0.0), dvec2(-1.0, 0.5), line));
        assert!(!crosses(dvec2(-1.0, 2.0), dvec2(1.0, 2.0), line));
        let (a, touch, b) = (dvec2(-1.0, 0.0), dvec2(0.0, 0.0), dvec2(1.0, 0.0));
        assert_eq!(u8::from(crosses(a, touch, line)) + u8::from(crosses(touch, b, line)), 1);
    }
}
