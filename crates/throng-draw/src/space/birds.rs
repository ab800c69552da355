//! Birds: they beat their wings to climb and to speed up, and glide down.

use crate::look::Look;
use crate::{AgentShape, Shape};
use glam::{Mat3, Vec2, Vec3};
use std::collections::BTreeMap;
use std::f32::consts::TAU;
use throng::motion::Basis;
use throng_record::{Body, Frame};
use throng_render::Mesh;

/// The frequency of beats of a bird of the usual radius, 1/s; it falls with the square root of the radius. The usual
/// radius, metres, and the limits of the frequency.
const BEAT: f32 = 3.4;
const USUAL: f32 = 0.4;
const BEATS: [f32; 2] = [2.0, 9.0];
/// The effort of level flight at a constant speed, 0 to 1; what climbing adds for each unit of its slope, and what each
/// m/s² of acceleration adds.
const LEVEL: f32 = 0.62;
const CLIMB: f32 = 2.2;
const PUSH: f32 = 0.06;
/// Below this effort a bird glides.
const GLIDE: f32 = 0.3;
/// The time in which the effort follows, seconds.
const EASE: f32 = 0.35;
/// The angles of the inner and the outer wing above level while gliding, and their amplitudes at full effort, radians;
/// and how far the outer wing is behind the inner one.
const RAISED: [f32; 2] = [0.14, -0.08];
const SWING: [f32; 2] = [0.62, 0.5];
const BEHIND: f32 = 1.1;
/// The wing, in radii: its root, its joint and its tip, each the front edge and the back edge (ahead, to the left).
const WING: [[Vec2; 2]; 3] = [
    [Vec2::new(0.62, 0.16), Vec2::new(-0.28, 0.16)],
    [Vec2::new(0.66, 1.15), Vec2::new(-0.2, 1.15)],
    [Vec2::new(-0.12, 2.5), Vec2::new(-0.3, 2.42)],
];
/// The body from tail to head: position along the axis and radius, in radii.
const BODY: [[f32; 2]; 6] = [[-1.15, 0.02], [-0.75, 0.16], [0.0, 0.27], [0.5, 0.22], [0.85, 0.17], [1.2, 0.02]];
/// The number of corners around the body.
const AROUND: u32 = 8;
/// The tail: ahead and to the left, in radii.
const TAIL: [Vec2; 3] = [Vec2::new(-0.8, 0.1), Vec2::new(-1.75, 0.42), Vec2::new(-1.65, 0.0)];

/// The flight of each bird.
#[derive(Clone, Debug, Default)]
pub(crate) struct Birds {
    all: BTreeMap<u32, Flight>,
    time: f64,
}

/// The state of a bird's wings.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Flight {
    /// How far the beat is, radians.
    phase: f32,
    /// How strongly it beats, 0 to 1.
    effort: f32,
    speed: f32,
}

impl Birds {
    /// Moves the wings to a moment. Absent birds are dropped.
    pub fn follow(&mut self, frame: &Frame, look: &Look) {
        let step = (frame.time - self.time).clamp(0.0, 1.0) as f32;
        self.time = frame.time;
        let before = std::mem::take(&mut self.all);
        let birds = frame.bodies.iter().filter(|body| look.form(body) == AgentShape::Shaped(Shape::Bird));
        self.all.extend(birds.map(|body| (body.number, Flight::next(before.get(&body.number), body, step))));
    }

    /// Returns the shape of a bird about its position, enlarged by `growth`; `None` if it is none.
    pub fn mesh(&self, body: &Body, growth: f32) -> Option<Mesh<'static>> {
        let flight = self.all.get(&body.number)?;
        let basis = body.basis.unwrap_or_else(|| Basis::facing(Vec2::from_angle(body.heading).extend(0.0)));
        let turn = Mat3::from_cols(basis.forward, basis.side, basis.up) * (body.radius * growth);
        let mut mesh = Mesh::default();
        let mut add = |corners: &[Vec3]| mesh.face(&corners.iter().map(|corner| turn * *corner).collect::<Vec<_>>());
        let ring = |k: u32, [x, radius]: [f32; 2]| {
            Vec2::from_angle(TAU * k as f32 / AROUND as f32).extend(0.0) * radius + Vec3::Z * x
        };
        // the axis of the body is ahead
        let ahead = |corner: Vec3| Vec3::new(corner.z, corner.x, corner.y);
        for parts in BODY.windows(2) {
            for k in 0..AROUND {
                let corners = [ring(k, parts[0]), ring(k + 1, parts[0]), ring(k + 1, parts[1]), ring(k, parts[1])];
                add(&corners.map(ahead));
            }
        }
        let angles = flight.angles();
        for side in [1.0, -1.0] {
            let mirrored = |corner: Vec3| Vec3::new(corner.x, corner.y * side, corner.z);
            let [root, joint, tip] = wing(angles).map(|edges| edges.map(mirrored));
            add(&[root[0], joint[0], joint[1], root[1]]);
            add(&[joint[0], tip[0], tip[1], joint[1]]);
            let [a, b, c] = TAIL.map(|corner| mirrored(corner.extend(0.03)));
            add(&[a, b, c]);
        }
        Some(mesh)
    }
}

impl Flight {
    /// Returns the flight after `step` seconds.
    fn next(before: Option<&Self>, body: &Body, step: f32) -> Self {
        let speed = body.velocity.length().hypot(body.vertical_velocity);
        let slope = if speed > 0.1 { body.vertical_velocity / speed } else { 0.0 };
        let faster = before.filter(|_| step > 0.0).map_or(0.0, |before| (speed - before.speed) / step);
        let wanted = (LEVEL + CLIMB * slope + PUSH * faster).clamp(0.0, 1.0);
        let wanted = if wanted < GLIDE { 0.0 } else { wanted };
        // Phases differ between birds.
        let first = || Self { phase: (2.4 * body.number as f32) % TAU, effort: wanted, speed };
        let Self { phase, effort, .. } =
            before.copied().filter(|before| before.phase.is_finite()).unwrap_or_else(first);
        let effort = effort + (wanted - effort) * (step / EASE).min(1.0);
        let beats = (BEAT * (USUAL / body.radius.max(1e-3)).sqrt()).clamp(BEATS[0], BEATS[1]);
        Self { phase: (phase + TAU * beats * (0.75 + 0.25 * effort) * step) % TAU, effort, speed }
    }

    /// Returns the angles of the inner and the outer wing above level, radians.
    fn angles(&self) -> [f32; 2] {
        let swing = |k: usize, behind: f32| RAISED[k] + SWING[k] * self.effort * libm::sinf(self.phase - behind);
        let inner = swing(0, 0.0);
        [inner, inner + swing(1, BEHIND)]
    }
}

/// Returns the corners of the left wing: its root, its joint and its tip.
fn wing([inner, outer]: [f32; 2]) -> [[Vec3; 2]; 3] {
    let [root, joint, tip] = WING;
    let along = |angle: f32, length: f32| Vec2::new(libm::cosf(angle), libm::sinf(angle)) * length;
    let start = Vec2::new(root[0].y, 0.08);
    let elbow = start + along(inner, joint[0].y - root[0].y);
    let place = |edge: Vec2, at: Vec2| Vec3::new(edge.x, at.x, at.y);
    let end = |edge: Vec2| place(edge, elbow + along(outer, edge.y - joint[0].y));
    [root.map(|edge| place(edge, start)), joint.map(|edge| place(edge, elbow)), tip.map(end)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Style;
    use throng_record::Setting;

    fn body(climb: f32) -> Body {
        Body {
            number: 3,
            altitude: 20.0,
            velocity: Vec2::X * 6.0,
            vertical_velocity: climb,
            radius: 0.4,
            preferred_speed: 6.0,
            ..crate::harness::body()
        }
    }

    /// Returns the heights of the left tip over two seconds, in radii.
    fn tips(climb: f32) -> Vec<f32> {
        let style = Style { forms: vec![AgentShape::Shaped(Shape::Bird)], ..Style::default() };
        let look = Look::new(&Setting::default(), &style, &Frame::default());
        let mut birds = Birds::default();
        let moments =
            (0..100).map(|k| Frame { time: f64::from(k) * 0.02, bodies: vec![body(climb)], ..Frame::default() });
        let tip = |frame: Frame| {
            birds.follow(&frame, &look);
            let mesh = birds.mesh(&frame.bodies[0], 1.0).expect("it is a bird");
            mesh.positions().iter().copied().max_by(|a, b| a.y.total_cmp(&b.y)).map_or(0.0, |tip| tip.z / 0.4)
        };
        moments.map(tip).collect()
    }

    #[test]
    fn birds_beat_their_wings_to_climb_and_glide_down() {
        let swing = |tips: &[f32]| {
            let low = tips.iter().copied().fold(f32::INFINITY, f32::min);
            tips.iter().copied().fold(f32::NEG_INFINITY, f32::max) - low
        };
        let [up, level, down] = [2.0, 0.0, -2.0].map(tips);
        assert!(swing(&up) > swing(&level) && swing(&level) > 0.8, "{} and {} radii", swing(&up), swing(&level));
        assert!(swing(&down[50..]) < 0.01, "it glides: {}", swing(&down[50..]));
        let turns = up.windows(3).filter(|z| z[1] > z[0] && z[1] > z[2]).count();
        assert!((5..=8).contains(&turns), "{turns} beats in two seconds");
    }

    #[test]
    fn wings_keep_their_lengths() {
        let lengths = |angles: [f32; 2]| {
            let [root, joint, tip] = wing(angles);
            [root[0].distance(joint[0]), joint[0].distance(tip[0]), joint[0].distance(tip[1])]
        };
        let level = lengths([0.0, 0.0]);
        for angles in [[0.5, 0.9], [-0.4, -0.9]] {
            for (a, b) in lengths(angles).into_iter().zip(level) {
                assert!((a - b).abs() < 1e-5, "{a} and {b}");
            }
        }
    }
}
