//! Random crowds.

use crate::{Body, Frame, Setting};
use glam::{DVec2, Vec2};
use proptest::prelude::*;
use throng::{Obstacle, Status, Walkable};

/// When moments come.
#[derive(Clone, Copy)]
pub(super) enum Times {
    Even,
    Uneven,
}

/// Somebody: from when to when, who, of which group, where from, how fast.
#[derive(Clone, Debug)]
struct One {
    from: usize,
    to: usize,
    group: u32,
    start: DVec2,
    velocity: Vec2,
    radius: f32,
}

/// A place with names, and moments of a crowd in it: several groups, numbers in no order, some come later and some go.
pub(super) fn crowd(times: Times) -> impl Strategy<Value = (Setting, Vec<Frame>)> {
    let one = (0..30usize, 1..30usize, 0..3u32, (-500.0..500.0, -500.0..500.0), (-3.0..3f32, -3.0..3f32), 0.1..0.5f32);
    let one = one.prop_map(|(from, stays, group, start, velocity, radius)| One {
        from,
        to: from + stays,
        group,
        start: start.into(),
        velocity: velocity.into(),
        radius,
    });
    let people = proptest::collection::hash_map(any::<u32>(), one, 1..20);
    let steps = proptest::collection::vec(0.01..0.5, 40);
    (people, steps, -100.0..1e5, any::<u64>()).prop_map(move |(people, steps, start, salt)| {
        let people: Vec<_> = people.into_iter().collect();
        let mut time = start;
        let frames = steps.iter().enumerate().map(|(k, step)| {
            let there = people.iter().filter(|(_, one)| (one.from..one.to).contains(&k));
            let bodies = there.map(|(number, one)| body(*number, one, k as f32 * 0.1, salt)).collect();
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

/// Many people over many moments, a tenth of a second apart: who comes and who goes does so in the first and the last hundred.
pub(super) fn large(people: u32, moments: usize) -> (Setting, Vec<Frame>) {
    let one = |number: u32| One {
        from: number as usize * 7 % 100,
        to: moments - number as usize * 13 % 100,
        group: number % 3,
        start: DVec2::new(f64::from(number % 100), f64::from(number / 100)) * 5.0 - 250.0,
        velocity: Vec2::from_angle(number as f32) * 2.0,
        radius: 0.2,
    };
    let people: Vec<One> = (0..people).map(one).collect();
    let frames = (0..moments).map(|k| {
        let there = (0..).zip(&people).filter(|(_, one)| (one.from..one.to).contains(&k));
        let bodies = there.map(|(number, one)| body(number, one, k as f32 * 0.1, 7)).collect();
        Frame { time: k as f64 * 0.1, bodies, ..Frame::default() }
    });
    (setting(), frames.collect())
}

/// Who was somewhere after so many seconds: most go straight on, all tremble.
fn body(number: u32, one: &One, time: f32, salt: u64) -> Body {
    let mut state = salt ^ u64::from(number) ^ u64::from(time.to_bits()) << 20;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1u64 << 23) as f32 - 1.0
    };
    let velocity = one.velocity + Vec2::new(draw(), draw()) * 0.1;
    Body {
        group: one.group,
        velocity,
        altitude: 2.0 + draw(),
        climb: draw(),
        heading: 8.0 * draw(),
        radius: one.radius,
        core: Vec2::new(0.2, 0.1),
        status: [Status::Walking, Status::Waiting, Status::Arrived, Status::Stranded][number as usize % 4],
        ..Body::walking(number, one.start + (one.velocity * time).as_dvec2() + f64::from(draw()) * 1e-3)
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

/// Three people over four moments.
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
