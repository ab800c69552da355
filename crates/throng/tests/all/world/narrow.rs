//! Narrow places: where two agents cannot pass, one steps aside, and all agents get through.

use crate::world::common::{Draw, journey_to, run, run_for, with_settings};
use crate::world::oracle::assert_free;
use glam::DVec2;
use std::sync::Arc;
use throng::avoid::{Hrvo, LocalModel, NoAvoidance, Orca, Rvo, Vo};
use throng::navigate::Turn;
use throng::{Agent, Group, GroupId, Obstacle, SubSteps, World};

/// Radius of the bodies for which the widths of the passages are chosen, metres.
const RADIUS: f32 = 0.14;

/// A rotated and moved place: a world, and the directions of its x and y axes.
struct Place {
    world: World,
    angle: f64,
    group: GroupId,
}

impl Place {
    fn new(model: Arc<dyn LocalModel>, step: f64, angle: f64) -> Self {
        let origin = DVec2::new(700.0 * angle, -1800.0);
        let mut world = with_settings(step, SubSteps::Auto, origin);
        let group = world.add_group(Group { model, ..Group::default() }).unwrap();
        Self { world, angle, group }
    }

    fn at(&self, x: f64, y: f64) -> DVec2 {
        self.world.settings().origin + DVec2::from_angle(self.angle).rotate(DVec2::new(x, y))
    }

    fn wall(&mut self, points: &[(f64, f64)]) {
        let points = points.iter().map(|&(x, y)| self.at(x, y)).collect();
        self.world.add_obstacle(Obstacle::Wall { points }).unwrap();
    }

    fn walker(&mut self, from: (f64, f64), to: (f64, f64)) {
        self.add(from, to, Agent { radius: RADIUS, ..Agent::default() });
    }

    fn add(&mut self, from: (f64, f64), to: (f64, f64), like: Agent) {
        let to = self.at(to.0, to.1);
        let journey = journey_to(&mut self.world, to);
        let position = self.at(from.0, from.1);
        self.world.add_agent(Agent { position: position.extend(0.0), journey, group: self.group, ..like }).unwrap();
    }

    /// Builds two halls; the wall between them is as thick as the passage through it is long.
    fn passage(&mut self, width: f64, length: f64) {
        let (x, y) = (0.5 * length, 0.5 * width);
        for side in [-1.0, 1.0] {
            self.wall(&[(-x, 12.0 * side), (-x, y * side), (x, y * side), (x, 12.0 * side)]);
        }
    }

    /// Adds numbers of agents on the left and on the right, in rows before the passage, each with a goal beyond it.
    fn both_ways(&mut self, counts: [usize; 2], length: f64) {
        for (side, count) in [-1.0, 1.0].into_iter().zip(counts) {
            for k in 0..count {
                let (x, y) = (
                    0.5 * length + 1.2 + 0.7 * (k / 3) as f64,
                    0.9 * (k % 3) as f64 - 0.45 * (count.min(3) - 1) as f64,
                );
                self.walker((side * x, y), (-side * (x + 0.8), -y));
            }
        }
    }

    /// Runs until all agents have arrived, without overlaps; fails after `limit` seconds.
    fn all_arrive(mut self, limit: f64, label: &str) {
        run(&mut self.world, limit, assert_free);
        let summary = self.world.summary();
        assert!(self.world.finished(), "{label}: not there after {limit} s: {summary:?}");
        // no agent hesitates: to the goal, back, and to the goal again is 3 path lengths at most
        assert!(summary.path_ratio < 2.2, "{label}: {summary:?}");
    }
}

fn orca() -> Arc<dyn LocalModel> {
    Arc::new(Orca::default())
}

fn models() -> [(&'static str, Arc<dyn LocalModel>); 5] {
    [
        ("orca", orca()),
        ("vo", Arc::new(Vo::default())),
        ("rvo", Arc::new(Rvo::default())),
        ("hrvo", Arc::new(Hrvo::default())),
        ("none", Arc::new(NoAvoidance)),
    ]
}

#[test]
fn two_pass_a_corridor_as_wide_as_one() {
    for (width, angle, step) in [(0.6, 0.0, 0.04), (0.6, 0.7, 1.0 / 60.0), (0.48, 2.0, 0.1), (0.48, 5.1, 0.04)] {
        let mut place = Place::new(orca(), step, angle);
        place.passage(width, 10.0);
        place.both_ways([1, 1], 10.0);
        place.all_arrive(60.0, &format!("{width} m at {angle} rad, {step} s"));
    }
}

#[test]
fn sides_pass_one_after_the_other() {
    for (counts, width, angle, step) in [
        ([2, 2], 0.6, 0.3, 0.04),
        ([3, 3], 0.48, 1.1, 0.1),
        ([3, 3], 0.6, 2.6, 1.0 / 60.0),
        ([5, 1], 0.6, 4.0, 0.04),
        ([1, 5], 0.48, 0.1, 0.04),
    ] {
        let mut place = Place::new(orca(), step, angle);
        place.passage(width, 10.0);
        place.both_ways(counts, 10.0);
        place.all_arrive(90.0, &format!("{counts:?} in {width} m at {angle} rad, {step} s"));
    }
}

#[test]
fn a_door_for_one_is_used_both_ways() {
    for (width, angle, step) in [(0.6, 0.0, 0.04), (0.5, 0.8, 0.1), (0.5, 3.9, 1.0 / 60.0), (0.6, 5.5, 0.04)] {
        let mut place = Place::new(orca(), step, angle);
        place.passage(width, 0.2);
        place.both_ways([5, 5], 0.2);
        place.all_arrive(60.0, &format!("a door of {width} m at {angle} rad, {step} s"));
    }
}

#[test]
fn an_agent_in_a_dead_end_comes_out_first() {
    for (width, angle, step) in [(0.6, 0.0, 0.04), (0.48, 1.3, 0.1), (0.5, 4.4, 1.0 / 60.0)] {
        let mut place = Place::new(orca(), step, angle);
        let y = 0.5 * width;
        place.wall(&[(0.0, 9.0), (0.0, y), (6.0, y), (6.0, -y), (0.0, -y), (0.0, -9.0)]);
        place.walker((5.0, 0.0), (-3.0, 0.5));
        place.walker((-2.0, 0.0), (5.5, 0.0));
        place.all_arrive(60.0, &format!("a dead end of {width} m at {angle} rad, {step} s"));
    }
}

/// Untuned values: any width, length, angle, step, body, speed and number of agents.
#[test]
fn any_narrow_place_is_passed() {
    let mut draw = Draw::new(41);
    for round in 0..12 {
        let (angle, step) = (draw.between(0.0, std::f64::consts::TAU), draw.one_of(&[1.0 / 60.0, 0.04, 0.1]));
        let radius = draw.between(0.15, 0.3);
        let (width, length) = (radius * draw.between(2.2, 3.3), draw.one_of(&[0.1, 0.3, 2.0, 6.0, 10.0]));
        let counts = [1 + draw.index(5), 1 + draw.index(5)];
        let mut place = Place::new(orca(), step, angle);
        place.passage(width, length);
        for (side, count) in [-1.0, 1.0].into_iter().zip(counts) {
            for k in 0..count {
                let (x, y) =
                    (0.5 * length + 1.0 + 0.9 * (k / 3) as f64, 0.9 * (k % 3) as f64 - 0.9 + draw.between(-0.1, 0.1));
                let preferred_speed = draw.between(1.0, 1.6) as f32;
                let like = Agent { radius: radius as f32, preferred_speed, ..Agent::default() };
                place.add((side * x, y), (-side * (x + 1.0), draw.between(-0.2, 0.2) - y), like);
            }
        }
        let label = format!(
            "round {round}: {counts:?} of {radius:.2} m in {width:.2} by {length} m at {angle:.2} rad, {step:.3} s"
        );
        place.all_arrive(90.0, &label);
    }
}

#[test]
fn every_model_gets_through() {
    for (name, model) in models() {
        let mut place = Place::new(model.clone(), 0.04, 0.9);
        place.passage(0.6, 10.0);
        place.both_ways([2, 2], 10.0);
        place.all_arrive(90.0, &format!("{name} in a corridor"));
        let mut place = Place::new(model, 0.04, 3.3);
        place.passage(0.6, 0.2);
        place.both_ways([5, 5], 0.2);
        place.all_arrive(90.0, &format!("{name} at a door"));
    }
}

#[test]
fn agents_without_agreement_stand_there() {
    let standoffs = [true, false].map(|resolve| {
        let mut place = Place::new(orca(), 0.05, 1.7);
        let model = Arc::new(Orca { time_horizon: 2.0, ..Orca::default() });
        let group = Group { model, resolve, look_ahead: false, ..Group::default() };
        place.group = place.world.add_group(group).unwrap();
        place.passage(0.55, 6.0);
        place.both_ways([1, 1], 6.0);
        run_for(&mut place.world, 30.0, assert_free);
        (place.world.summary().standoffs, place.world.finished())
    });
    assert_eq!(standoffs, [(1, true), (0, false)]);
}

#[test]
fn the_higher_priority_goes_first() {
    for first in [0, 1] {
        let mut place = Place::new(orca(), 0.05, 0.4);
        place.passage(0.5, 8.0);
        // the agent that comes later would have less way back
        for (number, side, from) in [(0, -1.0, 5.0), (1, 1.0, 6.5)] {
            let like = Agent {
                priority: 0.2 * f32::from(number == first),
                number: Some(number.into()),
                radius: RADIUS,
                ..Agent::default()
            };
            place.add((side * from, 0.0), (-side * 6.0, 0.0), like);
        }
        let mut arrived = Vec::new();
        run(&mut place.world, 40.0, |world| {
            let there = (0..2).filter(|&row| world.relative_columns().trip(row).arrived.is_some());
            arrived.extend(there.map(|row| world.relative_columns().number[row] as u8));
        });
        assert_eq!(arrived.first(), Some(&first));
    }
}

/// Three against three, while they retreat and pass: the saved state is complete, and the order does not matter.
#[test]
fn a_standoff_is_saved_and_knows_no_order() {
    let build = |order: u64| {
        let mut place = Place::new(orca(), 0.05, 0.2);
        place.passage(0.5, 6.0);
        let mut agents: Vec<(f64, u32)> = (0..6).map(|k| (if k < 3 { -1.0 } else { 1.0 }, k)).collect();
        if order > 0 {
            Draw::new(order).shuffle(&mut agents);
        }
        for (side, number) in agents {
            let y = 0.9 * f64::from(number % 3) - 0.9;
            let like = Agent { number: Some(number), radius: RADIUS, ..Agent::default() };
            place.add((side * (4.0 + 0.1 * y), y), (-side * 5.0, -y), like);
        }
        place.world
    };
    let (mut original, mut other) = (build(0), build(3));
    let aside = |world: &World| world.relative_columns().travel.iter().any(|travel| travel.turn == Turn::Aside);
    let mut loaded = None;
    for step in 0..600 {
        original.step();
        other.step();
        assert_eq!(original.state_hash(), other.state_hash(), "another order, step {step}");
        let loaded = loaded.get_or_insert_with(|| build(0));
        if aside(&original) && step % 20 == 0 {
            loaded.load(&original.save()).unwrap();
        } else if loaded.steps() > 0 {
            loaded.step();
            assert_eq!(original.state_hash(), loaded.state_hash(), "loaded, step {step}");
        }
    }
    assert!(original.finished() && original.summary().standoffs > 0, "{:?}", original.summary());
}
