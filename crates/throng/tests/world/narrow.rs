//! Narrow places: where two cannot pass, somebody steps aside, and everybody gets through.

use crate::common::{journey_to, run, with_settings};
use crate::oracle::assert_free;
use glam::DVec2;
use std::sync::Arc;
use throng::avoid::{Hrvo, LocalModel, Orca, Rvo, Unavoiding, Vo};
use throng::{Agent, Group, GroupId, Obstacle, SubSteps, World};

/// A place turned and shifted: a world, and where its x and y axes point.
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
        self.add(from, to, Agent::default());
    }

    fn add(&mut self, from: (f64, f64), to: (f64, f64), like: Agent) {
        let to = self.at(to.0, to.1);
        let journey = journey_to(&mut self.world, to);
        let position = self.at(from.0, from.1);
        self.world.add_agent(Agent { position, journey, group: self.group, ..like }).unwrap();
    }

    /// Two halls, the wall between them as thick as the passage through it is long.
    fn passage(&mut self, width: f64, length: f64) {
        let (x, y) = (0.5 * length, 0.5 * width);
        for side in [-1.0, 1.0] {
            self.wall(&[(-x, 12.0 * side), (-x, y * side), (x, y * side), (x, 12.0 * side)]);
        }
    }

    /// So many from the left and from the right, in rows before the passage, each to a place beyond it.
    fn both_ways(&mut self, counts: [usize; 2], length: f64) {
        for (side, count) in [-1.0, 1.0].into_iter().zip(counts) {
            for k in 0..count {
                let (x, y) = (0.5 * length + 1.2 + 0.7 * (k / 3) as f64, 0.9 * (k % 3) as f64 - 0.45 * (count.min(3) - 1) as f64);
                self.walker((side * x, y), (-side * (x + 0.8), -y));
            }
        }
    }

    /// Runs until everybody is there, without overlaps; the seconds it took.
    fn all_arrive(mut self, limit: f64, label: &str) -> f64 {
        let trace = std::env::var("TRACE").is_ok();
        let angle = self.angle;
        run(&mut self.world, limit, |world| {
            assert_free(world);
            if trace && world.steps() % (0.5 / world.settings().step) as u64 == 0 {
                let agents = world.agents();
                print!("{:5.1}", world.time());
                for row in 0..agents.len() {
                    let p = DVec2::from_angle(-angle).rotate(agents.position[row].as_dvec2());
                    let turn = match agents.travel[row].turn { throng::navigate::Turn::Free => ' ', throng::navigate::Turn::First => '>', _ => 'a' };
                    print!(" | {}{turn}{:6.2} {:5.2} s{:4.0}", agents.number[row], p.x, p.y, agents.travel[row].stalled);
                }
                println!();
            }
        });
        let left: Vec<_> = (0..self.world.agents().len())
            .filter(|&row| self.world.agents().trip[row].arrived.is_none())
            .map(|row| (self.world.agents().number[row], self.world.agents().position[row]))
            .collect();
        let summary = self.world.summary();
        println!("{label}: {:.1} s, standoffs {}, path {:.2} {}", self.world.time(), summary.standoffs, summary.path_ratio, left.len());
        if trace { return self.world.time(); }
        assert!(left.is_empty() && self.world.finished(), "{label}: not there after {limit} s: {left:?}");
        self.world.time()
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
        ("none", Arc::new(Unavoiding)),
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
    for (counts, width, angle, step) in
        [([2, 2], 0.6, 0.3, 0.04), ([3, 3], 0.48, 1.1, 0.1), ([3, 3], 0.6, 2.6, 1.0 / 60.0), ([5, 1], 0.6, 4.0, 0.04), ([1, 5], 0.48, 0.1, 0.04)]
    {
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
fn who_is_in_a_dead_end_comes_out_first() {
    for (width, angle, step) in [(0.6, 0.0, 0.04), (0.48, 1.3, 0.1), (0.5, 4.4, 1.0 / 60.0)] {
        let mut place = Place::new(orca(), step, angle);
        let y = 0.5 * width;
        place.wall(&[(0.0, 9.0), (0.0, y), (6.0, y), (6.0, -y), (0.0, -y), (0.0, -9.0)]);
        place.walker((5.0, 0.0), (-3.0, 0.5));
        place.walker((-2.0, 0.0), (5.5, 0.0));
        place.all_arrive(60.0, &format!("a dead end of {width} m at {angle} rad, {step} s"));
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
