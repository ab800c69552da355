//! What a group shows over time: distances, speeds, order; and the figures of a game.

use super::{Expectation, Figure, at_least, at_most, nanometres};
use crate::assemble::Built;
use crate::scene::{DistanceExpect, Expect, FigureExpect, GroupExpect, To, When};
use glam::DVec3;
use std::sync::Arc;
use throng::World;
use throng::space::Pathway;
use throng::space::surface::{Barrier, SeenFrom, Surface};

/// One expectation of a group, and what was measured so far.
#[derive(Clone, Debug)]
pub(super) struct Gauge {
    /// `distance.0` and the like.
    name: String,
    what: GaugeKind,
    /// The group's index in the world; `None`: all agents.
    of: Option<usize>,
    bounds: [Option<f64>; 2],
    when: When,
    after: f64,
    /// The least and the greatest value that counts of each agent, by its number; NaN before the first value.
    shown: Vec<[f64; 2]>,
}

#[derive(Clone, Debug)]
enum GaugeKind {
    DistanceTo(DVec3),
    /// To the nearest agent of a group.
    DistanceFrom(usize),
    /// To a surface, from the side it is seen from.
    DistanceToSurface(Barrier<Arc<dyn Surface>>),
    /// To the spine of a path.
    DistanceToPath(Arc<Pathway>),
    Speed,
    Order,
    /// A figure of the rules, by name.
    Figure(String),
}

impl Gauge {
    /// Returns all expectations of groups in `[expect]`.
    pub fn all(expect: &Expect, world: &World, built: &Built) -> Vec<Self> {
        // the first group of a world is not a group of the scene
        let group = |name: &String| world.groups().iter().rposition(|group| group.name == *name).unwrap_or(usize::MAX);
        let gauge = |key: &str, index: usize, what: GaugeKind, said: &GroupExpect| Self {
            name: format!("{key}.{index}"),
            what,
            of: said.of.as_ref().map(group),
            bounds: [said.at_least, said.at_most],
            when: said.when,
            after: said.after,
            shown: vec![],
        };
        let distances = expect.distance.iter().enumerate().map(|(i, said @ DistanceExpect { to, .. })| {
            let what = match to {
                To::Place(place) => GaugeKind::DistanceTo(DVec3::from_array(place.0)),
                To::Named(name) => {
                    let surface = || built.surfaces.iter().find(|(known, _)| known == name);
                    let path = || built.paths.iter().find(|(known, _)| known == name);
                    let surface = || Some(GaugeKind::DistanceToSurface(surface()?.1.clone()));
                    let path = || Some(GaugeKind::DistanceToPath(path()?.1.clone()));
                    let known = world.groups().iter().any(|group| group.name == *name);
                    let other = if known { None } else { surface().or_else(path) };
                    other.unwrap_or_else(|| GaugeKind::DistanceFrom(group(name)))
                }
            };
            gauge("distance", i, what, &said.of_group())
        });
        let speeds = expect.speed.iter().enumerate().map(|(i, said)| gauge("speed", i, GaugeKind::Speed, said));
        let orders = expect.order.iter().enumerate().map(|(i, said)| gauge("order", i, GaugeKind::Order, said));
        let figures = expect.figure.iter().enumerate().map(|(i, said)| {
            let FigureExpect { of, at_least, at_most, when, after } = said.clone();
            gauge("figure", i, GaugeKind::Figure(of), &GroupExpect { of: None, at_least, at_most, when, after })
        });
        distances.chain(speeds).chain(orders).chain(figures).collect()
    }

    /// Records the world after a step.
    pub fn step(&mut self, world: &World) {
        if world.time() < self.after - 1e-9 {
            return;
        }
        if self.when == When::End {
            self.shown.clear();
        }
        for (number, value) in self.now(world) {
            if number >= self.shown.len() {
                self.shown.resize(number + 1, [f64::NAN; 2]);
            }
            let [low, high] = &mut self.shown[number];
            (*low, *high) = match self.when {
                When::End => (value, value),
                When::Always => (value.min(*low), value.max(*high)),
                When::Ever => (value.max(*low), value.min(*high)),
            };
        }
    }

    /// Returns the present values of the agents, by their numbers. An order (of the group) and a figure (of the game)
    /// have the number 0.
    fn now(&self, world: &World) -> Vec<(usize, f64)> {
        let agents = world.relative_columns();
        let rows = |group: Option<usize>| {
            (0..agents.len()).filter(move |&row| group.is_none_or(|group| agents.group[row].index() == group))
        };
        let local = |row: usize| agents.position[row].extend(agents.altitude[row]);
        let place = |row: usize| {
            let at = agents.position[row].as_dvec2() + world.settings().origin;
            at.extend(f64::from(agents.altitude[row]))
        };
        let each = |value: &dyn Fn(usize) -> f64| {
            let all = rows(self.of).map(|row| (agents.number[row] as usize, value(row)));
            all.filter(|(_, value)| value.is_finite()).collect()
        };
        match &self.what {
            GaugeKind::DistanceTo(to) => each(&|row| place(row).distance(*to)),
            GaugeKind::DistanceToSurface(barrier) => each(&|row| {
                let distance = barrier.surface.query(local(row)).distance;
                f64::from(match barrier.seen_from {
                    SeenFrom::Outside => distance,
                    SeenFrom::Inside => -distance,
                    SeenFrom::Both => distance.abs(),
                })
            }),
            GaugeKind::DistanceToPath(path) => {
                each(&|row| f64::from(path.nearest(local(row)).point.distance(local(row))))
            }
            GaugeKind::DistanceFrom(group) => each(&|row| {
                let others = rows(Some(*group)).filter(|&other| other != row);
                others.map(|other| place(row).distance(place(other))).fold(f64::INFINITY, f64::min)
            }),
            GaugeKind::Speed => each(&|row| f64::from(agents.speed(row))),
            GaugeKind::Figure(name) => world.figure(name).map(|value| (0, value)).into_iter().collect(),
            GaugeKind::Order => {
                // whole numbers: their sum does not depend on the order of the rows
                let (mut sum, mut count) = ([0_i128; 3], 0_i128);
                for row in rows(self.of) {
                    let direction = direction(world, row).to_array().map(nanometres);
                    (0..3).for_each(|i| sum[i] += direction[i]);
                    count += 1;
                }
                let sum = DVec3::from_array(sum.map(|sum| sum as f64 * 1e-9));
                if count > 0 { vec![(0, sum.length() / count as f64)] } else { vec![] }
            }
        }
    }

    /// Returns the outcome of the checks.
    pub fn checks(&self) -> impl Iterator<Item = Expectation> + '_ {
        let rules = [("at_least", at_least as super::Holds), ("at_most", at_most)];
        let found = self.shown.iter().copied().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or([f64::NAN; 2]);
        self.bounds.iter().zip(found).zip(rules).filter_map(|((bound, found), (rule, holds))| {
            let bound = (*bound)?;
            let name = format!("{}.{rule}", self.name);
            let expected = Figure::Measure(bound);
            Some(Expectation { name, expected, found: Figure::measure(found), passed: holds(found, bound) })
        })
    }
}

/// Returns the direction in which an agent moves, or faces if it stands.
fn direction(world: &World, row: usize) -> glam::Vec3 {
    let agents = world.relative_columns();
    let velocity = agents.velocity[row].extend(agents.vertical_velocity[row]);
    if velocity.length() > REST {
        return velocity.normalize();
    }
    let (sin, cos) = libm::sincosf(agents.heading[row]);
    glam::Vec3::new(cos, sin, 0.0)
}

/// Speed below which the velocity does not tell the direction, m/s.
const REST: f32 = 0.01;
