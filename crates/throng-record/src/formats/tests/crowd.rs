//! Random crowds.

use crate::{Body, Frame, Setting};
use glam::{DVec2, Vec2};
use proptest::prelude::*;
use throng::{Obstacle, Status, Walkable};

/// The times of frames.
#[derive(Clone, Copy)]
pub(super) enum Times {
    Even,
    Uneven,
}

/// An agent: the frames in which it is present, and its motion.
#[derive(Clone, Debug)]
struct One {
    from: usize,
    to: usize,
    group: u32,
    start: DVec2,
    velocity: Vec2,
    radius: f32,
}

/// A setting and the frames of a crowd in it: several groups, random numbers, agents that appear and disappear.
pub(super) fn crowd(times: Times) -> impl Strategy<Value = (Setting, Vec<Frame>)> {
    let agent =
        (0..30usize, 1..30usize, 0..3u32, (-500.0..500.0, -500.0..500.0), (-3.0..3f32, -3.0..3f32), 0.1..0.5f32);
    let agent = agent.prop_map(|(from, stays, group, start, velocity, radius)| One {
        from,
        to: from + stays,
        group,
        start: start.into(),
        velocity: velocity.into(),
        radius,
    });
    let agents = proptest::collection::hash_map(any::<u32>(), agent, 1..20);
    let steps = proptest::collection::vec(0.01..0.5, 40);
    (agents, steps, -100.0..1e5, any::<u64>()).prop_map(move |(agents, steps, start, salt)| {
        let agents: Vec<_> = agents.into_iter().collect();
        let mut time = start;
        let frames = steps.iter().enumerate().map(|(k, step)| {
            let there = agents.iter().filter(|(_, agent)| (agent.from..agent.to).contains(&k));
            let bodies = there.map(|(number, agent)| body(*number, agent, k as f32 * 0.1, salt)).collect();
            let frame = Frame { time, bodies, ..Frame::default() };
            match times {
                Times::Even => time = start + (k + 1) as f64 * 0.1,
                Times::Uneven => time += step,
            }
            frame
        });
        (setting(), frames.collect())
    })
}

/// Many agents over many frames at intervals of 0.1 s. Agents appear within the first 100 frames and disappear within
/// the last 100.
pub(super) fn large(agents: u32, moments: usize) -> (Setting, Vec<Frame>) {
    let agent = |number: u32| One {
        from: number as usize * 7 % 100,
        to: moments - number as usize * 13 % 100,
        group: number % 3,
        start: DVec2::new(f64::from(number % 100), f64::from(number / 100)) * 5.0 - 250.0,
        velocity: Vec2::from_angle(number as f32) * 2.0,
        radius: 0.2,
    };
    let agents: Vec<One> = (0..agents).map(agent).collect();
    let frames = (0..moments).map(|k| {
        let there = (0..).zip(&agents).filter(|(_, agent)| (agent.from..agent.to).contains(&k));
        let bodies = there.map(|(number, agent)| body(number, agent, k as f32 * 0.1, 7)).collect();
        Frame { time: k as f64 * 0.1, bodies, ..Frame::default() }
    });
    (setting(), frames.collect())
}

/// Returns an agent after `time` seconds: all move along a line with random deviations.
fn body(number: u32, agent: &One, time: f32, salt: u64) -> Body {
    let mut state = salt ^ u64::from(number) ^ u64::from(time.to_bits()) << 20;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1u64 << 23) as f32 - 1.0
    };
    let velocity = agent.velocity + Vec2::new(draw(), draw()) * 0.1;
    Body {
        group: agent.group,
        velocity,
        altitude: 2.0 + draw(),
        vertical_velocity: draw(),
        heading: 8.0 * draw(),
        radius: agent.radius,
        core: Vec2::new(0.2, 0.1),
        status: [Status::Walking, Status::Waiting, Status::Arrived, Status::Stranded][number as usize % 4],
        ..Body::walking(number, agent.start + (agent.velocity * time).as_dvec2() + f64::from(draw()) * 1e-3)
    }
}

fn setting() -> Setting {
    let square = |low: f64, high: f64| [(low, low), (high, low), (high, high), (low, high)].map(DVec2::from).to_vec();
    Setting {
        title: "A \"crowd\", of\tmany & <more>".into(),
        walkable: vec![Walkable { outer: square(-600.0, 600.0), holes: vec![square(-1.0, 1.0)] }],
        obstacles: vec![
            Obstacle::Polygon { corners: square(3.0, 4.0) },
            Obstacle::Wall { points: square(6.0, 7.0) },
            Obstacle::Circle { center: DVec2::new(9.0, 9.0), radius: 0.5 },
        ],
        groups: vec!["a, \"b\"\nc".into(), "größe <&>".into(), "third".into()],
        in_space: true,
        origin: DVec2::new(0.125, -7.0),
        ..Setting::default()
    }
}

/// Three agents over four frames.
pub(super) fn small() -> (Setting, Vec<Frame>) {
    let frames = (0..4u32).map(|k| {
        let there = [(7, 0..4), (3, 1..4), (900, 0..2)];
        let there = there.into_iter().filter(|(_, when)| when.contains(&k));
        let bodies = there.map(|(number, _)| {
            let at = DVec2::new(f64::from(number), 0.1 * f64::from(k));
            Body { group: number % 3, ..Body::walking(number, at) }
        });
        Frame { time: 0.1 * f64::from(k), bodies: bodies.collect(), ..Frame::default() }
    });
    (setting(), frames.collect())
}
