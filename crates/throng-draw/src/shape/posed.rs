//! Draws a body as a moving shape, face by face.

use super::{Shape, Vertex};
use crate::Color;
use crate::look::Coat;
use crate::primitive::{Primitive, Stroke};
use crate::projector::Projector;
use glam::{DVec3, Mat3, Vec2, Vec3};
use std::collections::BTreeMap;
use throng_record::{Body, Frame};
use throng_render::Mesh;

/// The direction of the light, the colour that unlit faces are mixed with, and the share of that colour.
const LIGHT: Vec3 = Vec3::new(-0.35, -0.35, 0.87);
const DARK: Color = Color::rgb(0x1c2026);
const SHADE: f32 = 0.5;
/// The least radius of a shape, pixels.
const LEAST: f32 = 2.2;
/// The radius, pixels, above which faces get an outline in their own colour that hides the seams.
const SEAMED: f32 = 4.0;

/// The walked distance of each agent.
#[derive(Clone, Debug, Default)]
pub(crate) struct Strides(BTreeMap<u32, (DVec3, f32)>);

impl Strides {
    /// Adds a moment; absent agents are dropped.
    pub fn follow(&mut self, frame: &Frame) {
        let before = std::mem::take(&mut self.0);
        self.0.extend(frame.bodies.iter().map(|body| {
            let at = body.center();
            let way = before.get(&body.number).map_or(0.0, |(last, way)| way + last.distance(at) as f32);
            (body.number, (at, way))
        }));
    }

    /// Returns the phase of an agent's motion at a time, radians.
    fn phase(&self, shape: Shape, body: &Body, time: f64) -> f32 {
        let way = self.0.get(&body.number).map_or(0.0, |(_, way)| *way);
        // Phases differ between agents.
        2.4 * body.number as f32 + shape.phase(time as f32, way, body.radius)
    }
}

/// Returns the visible faces of a body, far to near.
pub(crate) fn marks(
    shape: Shape,
    body: &Body,
    (strides, time): (&Strides, f64),
    coat: Coat,
    projector: &Projector,
) -> Vec<Primitive> {
    let center = body.center();
    let sight = projector.sight(center).as_vec3();
    let radius = shape.unit(body).max(LEAST / projector.scale(center) as f32);
    let turn = turn(body);
    let phase = strides.phase(shape, body, time);
    let mut faces: Vec<(f32, Vec<Primitive>)> = Vec::new();
    let seamed = radius * projector.scale(center) as f32 > SEAMED;
    for face in outlines(&shape.mesh()) {
        let corners: Vec<Vec3> = face.iter().map(|vertex| turn * posed(vertex, phase) * radius).collect();
        let outwards = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        if shape.is_closed() && outwards.dot(sight) <= 0.0 {
            continue;
        }
        let ring = corners.iter().map(|corner| projector.pixel(center + corner.as_dvec3()));
        let Some(points) = ring.collect::<Option<Vec<Vec2>>>() else { continue };
        let dark = SHADE * (0.5 - 0.5 * (turn * face[0].normal).dot(LIGHT));
        let fill = coat.fill.mix(DARK, dark);
        // The outline hides the seams between faces.
        let stroke = Stroke::plain(0.5, fill);
        let seam = seamed.then(|| Primitive::Line { points: points.clone(), closed: true, stroke });
        let near = corners.iter().sum::<Vec3>().dot(sight) / corners.len() as f32;
        faces.push((near, [Primitive::Area { rings: vec![points], fill }].into_iter().chain(seam).collect()));
    }
    faces.sort_by(|a, b| a.0.total_cmp(&b.0));
    faces.into_iter().flat_map(|(_, marks)| marks).collect()
}

/// Returns the axes of a body: ahead, to the left, and up.
fn turn(body: &Body) -> Mat3 {
    let ahead = body.basis.map_or_else(|| Vec2::from_angle(body.heading).extend(0.0), |basis| basis.forward);
    let left = body.basis.map_or(Vec3::Z, |basis| basis.up).cross(ahead).normalize_or(Vec3::Y);
    Mat3::from_cols(ahead, left, ahead.cross(left))
}

/// Returns a body as a mesh about its position, at a scale in pixels per metre.
pub(crate) fn mesh(shape: Shape, body: &Body, (strides, time): (&Strides, f64), scale: f32) -> Mesh<'static> {
    let turn = turn(body) * shape.unit(body).max(LEAST / scale);
    let phase = strides.phase(shape, body, time);
    let mut mesh = Mesh::default();
    for face in outlines(&shape.mesh()) {
        let corners: Vec<Vec3> = face.iter().map(|vertex| turn * posed(vertex, phase)).collect();
        mesh.face(&corners);
    }
    mesh
}

/// Returns the outlines of faces: two consecutive triangles with a common side are one face.
fn outlines(mesh: &[Vertex]) -> Vec<Vec<Vertex>> {
    let mut all: Vec<Vec<Vertex>> = Vec::new();
    for face in mesh.chunks_exact(3) {
        match all.last_mut() {
            Some(last) if last.len() == 3 && [last[0], last[2]] == [face[0], face[1]] => last.push(face[2]),
            _ => all.push(face.to_vec()),
        }
    }
    all
}

/// Returns the position of a corner at a phase: wings beat, limbs swing.
fn posed(vertex: &Vertex, phase: f32) -> Vec3 {
    let Vertex { corner, joint, .. } = *vertex;
    let (beat, swing) = (joint.x * phase.sin() * corner.y.signum(), joint.y * phase.sin());
    let beaten = Vec2::from_angle(beat).rotate(Vec2::new(corner.y, corner.z));
    let swung = Vec2::from_angle(-swing).rotate(Vec2::new(corner.x, beaten.y - joint.z));
    Vec3::new(swung.x, beaten.x, swung.y + joint.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Camera;
    use glam::DVec2;

    fn body(position: DVec2, heading: f32) -> Body {
        Body { position, heading, ..crate::harness::body() }
    }

    #[test]
    fn the_rest_pose_is_the_mesh_and_limbs_keep_their_lengths() {
        for shape in Shape::ALL {
            for vertex in shape.mesh() {
                assert!((posed(&vertex, 0.0) - vertex.corner).length() < 1e-6);
                let from = |at: Vec3| (at - Vec3::Z * vertex.joint.z).length();
                let beats = vertex.joint.x == 0.0 || vertex.joint.z == 0.0;
                assert!(!beats || (from(posed(&vertex, 1.0)) - from(vertex.corner)).abs() < 1e-5, "{shape:?}");
            }
        }
    }

    #[test]
    fn blocks_have_six_sides() {
        let sides = outlines(&Shape::Walker.mesh());
        assert!(sides.len() == 6 * 6 && sides.iter().all(|side| side.len() == 4));
        let length: usize = Shape::ALL.iter().map(|shape| outlines(&shape.mesh()).concat().len()).sum();
        assert!(length < Shape::ALL.iter().map(|shape| shape.mesh().len()).sum());
    }

    #[test]
    fn two_steps_of_a_walker_are_one_period() {
        let (mut strides, mut frame) = (Strides::default(), Frame::default());
        for k in 0..=24 {
            frame.bodies = vec![body(DVec2::X * 0.05 * f64::from(k), 0.0)];
            strides.follow(&frame);
        }
        let phase = strides.phase(Shape::Walker, &frame.bodies[0], 0.0);
        assert!((phase - std::f32::consts::TAU).abs() < 1e-3, "{phase}");
        frame.bodies.clear();
        strides.follow(&frame);
        assert!(strides.0.is_empty());
    }

    #[test]
    fn from_above_a_walker_stays_within_its_reach_and_its_head_is_last() {
        let body = body(DVec2::new(3.0, 2.0), 0.7);
        let camera = Camera { center: DVec2::ZERO, anchor: Vec2::ZERO, scale: 100.0 };
        let coat = Coat { fill: Color::rgb(0x3060c0), rim: Color::rgb(0) };
        let marks = marks(Shape::Walker, &body, (&Strides::default(), 0.0), coat, &Projector::Plan(camera));
        let reach = 4.0 * body.radius * 100.0;
        let middle = camera.pixel(body.position);
        let areas: Vec<&Vec<Vec2>> = marks
            .iter()
            .filter_map(|mark| if let Primitive::Area { rings, .. } = mark { Some(&rings[0]) } else { None })
            .collect();
        assert!(areas.len() >= 6, "the top of each block");
        assert!(areas.iter().all(|ring| ring.iter().all(|at| at.distance(middle) < reach)));
        let last = areas[areas.len() - 1];
        assert!(last.iter().all(|at| at.distance(middle) < body.radius * 100.0), "the top of the head");
    }
}
