//! Agents that are not as most are.

use crate::draw::Draw;
use glam::DVec2;
use throng::motion::{Holonomic, TwoWheels};
use throng::{Agent, Body, Keyframe, Script, World};

/// Makes 5 of `of` agents irregular: long, with two wheels, in a layer of its own, or led by a script.
pub fn irregular(world: &mut World, agent: Agent, draw: &mut Draw, of: usize) -> Agent {
    match draw.index(of) {
        0 => agent.with_body(Body::capsule(1.2, 0.3)),
        1 => agent.with_body(Body::rectangle(2.0, 0.8)),
        2 => Agent {
            motor: TwoWheels { max_turn_rate: 1.0, tracking_error: 0.1, ..TwoWheels::default() }.into(),
            ..agent
        },
        3 => Agent { layers: 2, avoids: 3, ..agent },
        4 => {
            let at = agent.position.truncate();
            let keyframe = |time: f64, at: DVec2| Keyframe { time, at, heading: time };
            let keyframes = vec![keyframe(0.0, at), keyframe(2.0, at + DVec2::new(1.0, 2.0)), keyframe(4.0, at)];
            let script = world.add_script(Script { keyframes, repeat: true }).unwrap();
            let body = draw.one_of(&[Body::disc(0.2), Body::rectangle(1.0, 0.2)]);
            let motor = Holonomic { max_turn_rate: 3.0, ..Holonomic::default() }.into();
            Agent { script: Some(script), avoids: 0, motor, ..agent }.with_body(body)
        }
        _ => agent,
    }
}
