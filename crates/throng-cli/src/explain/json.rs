//! An explanation as JSON; `throng explain --help` describes the keys.

use glam::{DVec2, Vec2};
use serde_json::{Value, json};
use std::path::PathBuf;
use throng::Explanation;
use throng::avoid::{AvoidanceReason, Cause, Forbidden, HalfPlane};

/// Returns the explanation as one JSON object.
pub fn of(scene: &str, why: &Explanation, files: &[PathBuf]) -> Value {
    let neighbours = why.neighbours.iter().map(|other| {
        json!({
            "agent": other.number,
            "offset": vector(other.seen.offset),
            "velocity": vector(other.velocity),
            "radius": number(other.radius),
            "seen_velocity": vector(other.seen.velocity),
            "radii": number(other.seen.radii),
            "share": number(other.seen.share),
            "room": number(other.seen.room),
        })
    });
    let edges = why.edges.iter().map(|edge| json!({ "start": vector(edge.start), "end": vector(edge.end) }));
    let discs = why.discs.iter().map(|disc| json!({ "offset": vector(disc.offset), "radius": disc.disc.radius }));
    let held = why.held_by(why.chosen);
    let held = held.iter().map(|&(by, depth)| json!({ "cause": cause(by, why), "depth": number(depth) }));
    let DVec2 { x, y } = why.position;
    json!({
        "scene": scene,
        "agent": why.number,
        "time": why.time,
        "seconds": number(why.seconds),
        "model": why.model,
        "position": [x, y],
        "heading": number(why.heading),
        "radius": number(why.radius),
        "max_speed": number(why.max_speed),
        "max_acceleration": number(why.max_acceleration),
        "velocity": vector(why.velocity),
        "preferred": vector(why.preferred),
        "relaxed": vector(why.relaxed),
        "chosen": vector(why.chosen),
        "limited": vector(why.limited),
        "guarded": vector(why.guarded),
        "neighbours": neighbours.collect::<Vec<_>>(),
        "edges": edges.collect::<Vec<_>>(),
        "discs": discs.collect::<Vec<_>>(),
        "reasons": why.reasons.iter().map(|entry| reason(entry, why)).collect::<Vec<_>>(),
        "held_by": held.collect::<Vec<_>>(),
        "collision": { "preferred": collision(why, why.preferred), "chosen": collision(why, why.chosen) },
        "files": files,
    })
}

fn reason(reason: &AvoidanceReason, why: &Explanation) -> Value {
    match *reason {
        AvoidanceReason::Permits(by, permitted) => json!({ "cause": cause(by, why), "permits": line(permitted) }),
        AvoidanceReason::Forbids(by, region) => json!({ "cause": cause(by, why), "forbids": forbidden(&region) }),
        AvoidanceReason::Push(by, push) => json!({ "cause": cause(by, why), "push": vector(push) }),
        AvoidanceReason::Candidate { velocity, cost } => {
            json!({ "candidate": { "velocity": vector(velocity), "cost": number(cost) } })
        }
    }
}

fn forbidden(region: &Forbidden) -> Value {
    match *region {
        Forbidden::Cone { apex, right, left } => {
            json!({ "cone": { "apex": vector(apex), "right": vector(right), "left": vector(left) } })
        }
        Forbidden::Truncated { apex, right, left, center, radius } => json!({ "truncated": {
            "apex": vector(apex),
            "right": vector(right),
            "left": vector(left),
            "center": vector(center),
            "radius": number(radius),
        } }),
        Forbidden::RightOf(other) => json!({ "right_of": line(other) }),
    }
}

fn line(line: HalfPlane) -> Value {
    json!({ "point": vector(line.point), "direction": vector(line.direction) })
}

fn cause(cause: Cause, why: &Explanation) -> Value {
    match cause {
        Cause::Neighbour(index) => json!({ "neighbour": why.neighbours.get(index).map(|other| other.number) }),
        Cause::Edge(index) => json!({ "edge": index }),
        Cause::Disc(index) => json!({ "disc": index }),
        Cause::Body => "body".into(),
    }
}

fn collision(why: &Explanation, velocity: Vec2) -> Value {
    let first = why.collision(velocity);
    first.map_or(Value::Null, |(time, with)| json!({ "time": number(time), "cause": cause(with, why) }))
}

fn vector(v: Vec2) -> Value {
    json!([number(v.x), number(v.y)])
}

/// Returns the number with the fewest digits that identify it; `null` for numbers that JSON does not have.
fn number(x: f32) -> Value {
    x.to_string().parse::<f64>().map_or(Value::Null, Value::from)
}
