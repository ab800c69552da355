//! What a group shows as time goes by: distances, speeds, order; and the figures of a game.

use super::{Check, Figure, at_least, at_most, nanometres};
use crate::build::Built;
use crate::scene::{DistanceExpect, Expect, FigureExpect, GroupExpect, To, When};
use glam::DVec3;
use std::sync::Arc;
use throng::World;
use throng::space::Pathway;
use throng::space::surface::{Barrier, SeenFrom, Surface};

/// One thing that is expected of a group, and what it has shown so far.
#[derive(Clone, Debug)]
pub(super) struct Gauge {
    /// `distance.0` and the like.
    name: String,
    what: What,
    /// The group's index in the world; `None`: everybody.
    of: Option<usize>,
    bounds: [Option<f64>; 2],
    when: When,
    after: f64,
    /// What counts of each agent, by its number: the least and the most; NaN before there was any.
    shown: Vec<[f64; 2]>,
}

#[derive(Clone, Debug)]
enum What {
    DistanceTo(DVec3),
    /// To the nearest of a group.
    DistanceFrom(usize),
    /// To a surface, from the side from which it is seen.
    DistanceToSurface(Barrier<Arc<dyn Surface>>),
    /// To the spine of a path.
    DistanceToPath(Arc<Pathway>),
    Speed,
    Order,
    /// Of the rules, by name.
    Figure(String),
}

impl Gauge {
    /// All that `[expect]` says of groups.
    pub fn all(expect: &Expect, world: &World, built: &Built) -> Vec<Self> {
        // the first of a world is nobody's
        let group = |name: &String| world.groups().iter().rposition(|group| group.name == *name).unwrap_or(usize::MAX);
        let gauge = |key: &str, index: usize, what: What, said: &GroupExpect| Self {
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
                To::Place(place) => What::DistanceTo(DVec3::from_array(place.0)),
                To::Named(name) => {
                    let surface = || built.surfaces.iter().find(|(known, _)| known == name);
                    let path = || built.paths.iter().find(|(known, _)| known == name);
                    let surface = || Some(What::DistanceToSurface(surface()?.1.clone()));
                    let path = || Some(What::DistanceToPath(path()?.1.clone()));
                    let known = world.groups().iter().any(|group| group.name == *name);
                    let other = if known { None } else { surface().or_else(path) };
                    other.unwrap_or_else(|| What::DistanceFrom(group(name)))
                }
            };
            gauge("distance", i, what, &said.of_group())
        });
        let speeds = expect.speed.iter().enumerate().map(|(i, said)| gauge("speed", i, What::Speed, said));
        let orders = expect.order.iter().enumerate().map(|(i, said)| gauge("order", i, What::Order, said));
        let figures = expect.figure.iter().enumerate().map(|(i, said)| {
            let FigureExpect { of, at_least, at_most, when, after } = said.clone();
            gauge("figure", i, What::Figure(of), &GroupExpect { of: None, at_least, at_most, when, after })
        });
        distances.chain(speeds).chain(orders).chain(figures).collect()
    }

    /// Takes in the world after a step.
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

    /// What the agents of the group show now, by their numbers; of order the group, and of figures the game, under the
    /// number 0.
    fn now(&self, world: &World) -> Vec<(usize, f64)> {
        let agents = world.agents();
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
            What::DistanceTo(to) => each(&|row| place(row).distance(*to)),
            What::DistanceToSurface(barrier) => each(&|row| {
                let distance = barrier.surface.query(local(row)).distance;
                f64::from(match barrier.seen_from {
                    SeenFrom::Outside => distance,
                    SeenFrom::Inside => -distance,
                    SeenFrom::Both => distance.abs(),
                })
            }),
            What::DistanceToPath(path) => each(&|row| f64::from(path.nearest(local(row)).point.distance(local(row)))),
            What::DistanceFrom(group) => each(&|row| {
                let others = rows(Some(*group)).filter(|&other| other != row);
                others.map(|other| place(row).distance(place(other))).fold(f64::INFINITY, f64::min)
            }),
            What::Speed => each(&|row| f64::from(agents.speed(row))),
            What::Figure(name) => world.figure(name).map(|value| (0, value)).into_iter().collect(),
            What::Order => {
                // in whole numbers, whose sums do not depend on the order of rows
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

    /// What came of it.
    pub fn checks(&self) -> impl Iterator<Item = Check> + '_ {
        let rules = [("at_least", at_least as super::Holds), ("at_most", at_most)];
        let found = self.shown.iter().copied().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or([f64::NAN; 2]);
        self.bounds.iter().zip(found).zip(rules).filter_map(|((bound, found), (rule, holds))| {
            let bound = (*bound)?;
            let name = format!("{}.{rule}", self.name);
            let expected = Figure::Measure(bound);
            Some(Check { name, expected, found: Figure::measure(found), passed: holds(found, bound) })
        })
    }
}

/// Where somebody goes, or faces at rest.
fn direction(world: &World, row: usize) -> glam::Vec3 {
    let agents = world.agents();
    let velocity = agents.velocity[row].extend(agents.climb[row]);
    if velocity.length() > REST {
        return velocity.normalize();
    }
    let (sin, cos) = libm::sincosf(agents.heading[row]);
    glam::Vec3::new(cos, sin, 0.0)
}

/// Speed below which the velocity says nothing about the direction, m/s.
const REST: f32 = 0.01;
