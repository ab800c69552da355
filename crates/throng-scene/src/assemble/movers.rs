//! Moving obstacles.

use super::check::{check_body, check_layers};
use super::limits::{Limit, check, check_point, check_some};
use super::plan::PlannedAgent;
use super::size::Size;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::DVec2;
use crate::scene::{Mover, Scene};
use std::sync::Arc;
use throng::avoid::NoAvoidance;
use throng::motion::Holonomic;
use throng::{Agent, Keyframe, Script};

/// Default ratio of a mover's greatest speed and turn rate to what its script needs, so that it can catch up.
const CATCH_UP: f64 = 1.5;
/// Least speed, m/s, and turn rate, radians a second, of a mover with a script that needs none.
const LEAST: f64 = 0.5;

/// Checks the numbers of a mover.
pub(super) fn check_mover(path: &Path, mover: &Mover) -> Result<(), Problem> {
    check_body(&path.key("body"), &mover.body)?;
    let least = if mover.repeat { 2 } else { 1 };
    if mover.script.len() < least {
        let message = format!("script has {} entries, but must have at least {least}", mover.script.len());
        let hint = "give its position over time with `time`, `at` and `heading`";
        return Err(Problem::new(&path.key("script"), Kind::Count, message).hint(hint));
    }
    let mut before = f64::NEG_INFINITY;
    for (i, keyframe) in mover.script.iter().enumerate() {
        let path = path.key("script").index(i);
        check(&path.key("time"), keyframe.time, Limit::NotNegative)?;
        check_point(&path.key("at"), &keyframe.at)?;
        check(&path.key("heading"), keyframe.heading, Limit::Between(-1e7, 1e7))?;
        if keyframe.time <= before {
            let message = format!("time is {}, but the entry before is at {before}", keyframe.time);
            return Err(Problem::new(&path.key("time"), Kind::OutOfRange, message)
                .hint("put the entries into the order of their times"));
        }
        before = keyframe.time;
    }
    check_some(&path.key("max_speed"), mover.max_speed, Limit::UpTo(1000.0))?;
    check_some(&path.key("turn_rate"), mover.turn_rate, Limit::Positive)?;
    check_layers(&path.key("layers"), &mover.layers)
}

/// Returns a group for each mover.
pub(super) fn groups(scene: &Scene) -> impl Iterator<Item = throng::Group> + '_ {
    scene.movers.iter().enumerate().map(|(i, mover)| throng::Group {
        name: Mover::name_at(&mover.name, i),
        model: Arc::new(NoAvoidance),
        guard: mover.guard,
        ..throng::Group::default()
    })
}

/// Adds the movers to the agents. Returns their scripts.
pub(super) fn add(scene: &Scene, agents: &mut Vec<PlannedAgent>) -> Vec<Script> {
    let mut scripts = vec![];
    for (i, mover) in scene.movers.iter().enumerate() {
        let script = script(mover);
        let (speed, turn_rate) = needs(&script);
        let start = script.at(0.0);
        let heading = start.heading.rem_euclid(std::f64::consts::TAU) as f32;
        let agent = Agent {
            position: start.at.extend(0.0),
            heading: Some(heading),
            preferred_speed: 0.0,
            motor: Holonomic {
                max_speed: mover.max_speed.unwrap_or(CATCH_UP * speed.max(LEAST)).min(1e3) as f32,
                max_turn_rate: mover.turn_rate.map_or(CATCH_UP * turn_rate.max(LEAST), f64::to_radians) as f32,
                ..Holonomic::default()
            }
            .into(),
            layers: mover.layers.iter().fold(0u32, |bits, layer| bits | 1 << u32::from(*layer).min(31)),
            avoids: 0,
            number: Some(agents.len() as u32),
            ..Agent::default()
        };
        let agent = agent.with_body(size(mover).body);
        let (group, script_index) = (scene.groups.len() + i, scripts.len());
        agents.push(PlannedAgent { agent, group, journey: None, script: Some(script_index), enters: None });
        scripts.push(script);
    }
    scripts
}

/// Returns the size of a mover; the least if its body is drawn from a distribution.
pub(super) fn size(mover: &Mover) -> Size {
    Size::of(&mover.body, |_, number| number.bounds()[0])
}

fn script(mover: &Mover) -> Script {
    let keyframes = mover.script.iter().map(|keyframe| Keyframe {
        time: keyframe.time,
        at: DVec2::from_array(keyframe.at),
        heading: keyframe.heading.to_radians(),
    });
    Script { keyframes: keyframes.collect(), repeat: mover.repeat }
}

/// Returns the greatest speed and turn rate between two keyframes.
fn needs(script: &Script) -> (f64, f64) {
    script.keyframes.windows(2).fold((0.0, 0.0), |(speed, turn_rate): (f64, f64), pair| {
        let time = pair[1].time - pair[0].time;
        let turned = (pair[1].heading - pair[0].heading).abs();
        (speed.max(pair[0].at.distance(pair[1].at) / time), turn_rate.max(turned / time))
    })
}
