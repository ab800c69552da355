//! Agents on wheels: cars, and robots on two wheels. Wheels roll by the distance that they drive.

mod car;
mod loft;
mod motion;
mod robot;
mod symbol;

use crate::look::{Coat, Look};
use crate::primitive::Primitive;
use crate::projector::Projector;
use crate::{AgentShape, Color, Shape};
use glam::{DVec2, Mat3, Vec2, Vec3};
use motion::Drive;
use std::collections::BTreeMap;
use throng_record::{Body, Frame};
use throng_render::{Mesh, linear};

/// The least half width of a vehicle, pixels.
const LEAST: f32 = 1.5;

/// The vehicles of a recording, by agent number.
#[derive(Clone, Debug, Default)]
pub(crate) struct Vehicles {
    all: BTreeMap<u32, Drive>,
    time: f64,
}

/// A part of a vehicle in the axes of the world about the middle of the agent, with how much it mirrors, 0 to 1.
pub(crate) struct VehiclePart {
    pub mesh: Mesh<'static>,
    pub gloss: f32,
}

/// The sizes of a vehicle, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Chassis {
    /// Half the length and half the width.
    half: Vec2,
    /// The distance from the middle to the axles, ahead and behind; 0 for a single axle.
    axle: f32,
    /// The distance from the middle to the wheels, to both sides.
    track: f32,
    /// The radius and half the width of a wheel.
    wheel: Vec2,
}

impl Vehicles {
    /// Moves the wheels to a moment. Absent vehicles are dropped.
    pub fn follow(&mut self, frame: &Frame, look: &Look) {
        let step = (frame.time - self.time) as f32;
        self.time = frame.time;
        let before = std::mem::take(&mut self.all);
        let drive = |body: &Body| {
            let chassis = chassis(body, look)?;
            let known = before.get(&body.number).filter(|_| step > 0.0);
            Some((body.number, known.map_or_else(|| Drive::new(body), |drive| drive.next(body, chassis, step))))
        };
        self.all.extend(frame.bodies.iter().filter_map(drive));
    }

    /// Returns the parts of a vehicle at a scale in pixels per metre; none if the agent has no wheels.
    pub fn parts(&self, body: &Body, look: &Look, scale: f32) -> Vec<VehiclePart> {
        let Some((drive, chassis)) = self.all.get(&body.number).zip(chassis(body, look)) else { return Vec::new() };
        let size = grown(&chassis, scale);
        let (sin, cos) = libm::sincosf(body.heading);
        let turn = Mat3::from_cols(Vec3::new(cos, sin, 0.0), Vec3::new(-sin, cos, 0.0), Vec3::Z) * size;
        let fine = chassis.half.x * size * scale > 40.0;
        let coat = look.coat(body).fill;
        let parts = match look.shape(body) {
            Some(Shape::Robot) => robot::parts(&chassis, drive, coat, fine),
            _ => car::parts(&chassis, drive, coat, fine),
        };
        parts.into_iter().map(|(loft, gloss)| VehiclePart { mesh: loft.mesh(turn), gloss }).collect()
    }

    /// Returns the symbol of a vehicle from above; `None` if the agent has no wheels.
    pub fn symbol(&self, body: &Body, look: &Look, projector: &Projector) -> Option<Vec<Primitive>> {
        let (drive, chassis) = self.all.get(&body.number).zip(chassis(body, look))?;
        let size = grown(&chassis, projector.scale(body.center()) as f32);
        let ahead = DVec2::from_angle(f64::from(body.heading));
        let pixel = |at: Vec2| {
            let place = body.position + ahead.rotate((at * size).as_dvec2());
            projector.pixel(place.extend(0.0)).filter(|pixel| pixel.is_finite())
        };
        let Coat { fill, rim } = look.coat(body);
        let areas = match look.shape(body)? {
            Shape::Robot => symbol::robot(&chassis, fill, rim),
            _ => symbol::car(&chassis, drive, fill, rim),
        };
        let area = |(ring, fill): (Vec<Vec2>, Color)| {
            let ring = ring.into_iter().map(&pixel).collect::<Option<Vec<Vec2>>>()?;
            Some(Primitive::Area { rings: vec![ring], fill })
        };
        areas.into_iter().map(area).collect()
    }
}

/// Returns the sizes of an agent that is a vehicle with a finite heading.
fn chassis(body: &Body, look: &Look) -> Option<Chassis> {
    let made = match look.form(body) {
        AgentShape::Shaped(Shape::Car) => car::chassis(body),
        AgentShape::Shaped(Shape::Robot) => robot::chassis(body),
        _ => return None,
    };
    let finite = body.heading.is_finite() && body.position.is_finite() && made.half.is_finite();
    (finite && made.half.min_element() > 0.0).then_some(made)
}

/// Returns the factor that makes a vehicle large enough to be seen.
fn grown(chassis: &Chassis, scale: f32) -> f32 {
    (LEAST / (chassis.half.y * scale)).max(1.0)
}

/// Returns a colour as linear light.
fn light(color: u32) -> Vec3 {
    linear(color)
}

/// Returns the colour of an agent as linear light.
fn paint(Color { r, g, b, .. }: Color) -> Vec3 {
    linear(u32::from_be_bytes([0, r, g, b]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Style;
    use throng_record::Setting;

    /// Returns a car of 4.2 m by 1.8 m at the origin.
    pub fn body() -> Body {
        Body { number: 1, radius: 0.3, core: Vec2::new(1.8, 0.6), preferred_speed: 2.0, ..crate::harness::body() }
    }

    fn look(shape: Shape) -> Look {
        let style = Style { forms: vec![AgentShape::Shaped(shape)], ..Style::default() };
        Look::new(&Setting::default(), &style, &Frame::default())
    }

    /// Returns the parts of a vehicle that stands.
    fn standing(shape: Shape, body: Body, scale: f32) -> Vec<VehiclePart> {
        let (look, mut vehicles) = (look(shape), Vehicles::default());
        vehicles.follow(&Frame { bodies: vec![body], ..Frame::default() }, &look);
        vehicles.parts(&body, &look, scale)
    }

    #[test]
    fn vehicles_stand_on_the_ground_within_their_bodies() {
        let disc = Body { core: Vec2::ZERO, radius: 0.7, ..body() };
        for (shape, body) in [(Shape::Car, body()), (Shape::Car, disc), (Shape::Robot, disc)] {
            for scale in [5.0, 200.0] {
                let parts = standing(shape, body, scale);
                let corners: Vec<Vec3> = parts.iter().flat_map(|part| part.mesh.positions().to_vec()).collect();
                let low = corners.iter().copied().fold(Vec3::INFINITY, Vec3::min);
                let high = corners.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
                assert!(low.z.abs() < 0.02 * high.z, "{shape:?} stands: {low}");
                let outside = |at: &Vec3| {
                    let beyond = (at.truncate().abs() - body.core).max(Vec2::ZERO);
                    if body.core == Vec2::ZERO {
                        beyond.length() - body.radius
                    } else {
                        beyond.max_element() - body.radius
                    }
                };
                let most = corners.iter().map(outside).fold(f32::NEG_INFINITY, f32::max);
                let wide = if scale < 10.0 { 0.5 } else { 0.02 };
                assert!(most < wide * body.radius, "{shape:?} at {scale}: {most} m outside");
                let long = if body.core == Vec2::ZERO { 0.9 * body.radius } else { body.core.x + body.radius };
                assert!(shape == Shape::Robot || high.x > 0.98 * long && low.x < -0.98 * long, "{low} to {high}");
            }
        }
    }

    #[test]
    fn shells_are_closed_and_face_outward() {
        for (shape, half) in [(Shape::Car, car::chassis(&body())), (Shape::Robot, robot::chassis(&body()))] {
            let drive = Drive::new(&body());
            let parts = match shape {
                Shape::Car => car::parts(&half, &drive, Color::rgb(0), true),
                _ => robot::parts(&half, &drive, Color::rgb(0), true),
            };
            let mut edges: BTreeMap<[[i32; 3]; 2], i32> = BTreeMap::new();
            let key = |at: Vec3| (at * 1e4).round().as_ivec3().to_array();
            let mut volume = 0.0;
            for [a, b, c] in parts[0].0.corners() {
                volume += a.dot(b.cross(c)) / 6.0;
                for (from, to) in [(a, b), (b, c), (c, a)].map(|(from, to)| (key(from), key(to))) {
                    *edges.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
                }
            }
            let open = edges.iter().filter(|([from, to], sum)| from != to && **sum != 0).count();
            // the eyes of a robot are flat
            assert_eq!(open, if shape == Shape::Robot { 20 } else { 0 }, "{shape:?}");
            // a car is at most a block as high as its cabin; a robot is about a cylinder of 0.72 by 1.19 radii
            let block = 4.0 * half.half.x * half.half.y * 1.56 * half.half.y;
            let cylinder = std::f32::consts::PI * 0.72 * 0.72 * 1.19 * half.half.x.powi(3);
            let [low, high] = if shape == Shape::Car { [0.45 * block, block] } else { [0.85 * cylinder, cylinder] };
            assert!((low..high).contains(&volume), "{shape:?}: {volume}, not {low} to {high}");
        }
    }

    #[test]
    fn symbols_have_the_size_of_the_body() {
        let camera = crate::Camera { center: DVec2::ZERO, anchor: Vec2::ZERO, scale: 50.0 };
        let body = Body { heading: 0.5, ..body() };
        let (look, mut vehicles) = (look(Shape::Car), Vehicles::default());
        vehicles.follow(&Frame { bodies: vec![body], ..Frame::default() }, &look);
        let marks = vehicles.symbol(&body, &look, &Projector::Plan(camera)).unwrap();
        let corners = marks.iter().flat_map(|mark| match mark {
            Primitive::Area { rings, .. } => rings[0].clone(),
            _ => Vec::new(),
        });
        // rows of a picture count downwards
        let turned: Vec<Vec2> = corners.map(|at| Vec2::from_angle(0.5).rotate(at) / 50.0).collect();
        let most = turned.iter().fold(Vec2::ZERO, |most, at| most.max(at.abs()));
        assert!((most - Vec2::new(2.1, 0.9)).abs().max_element() < 0.01, "{most}");
    }

    #[test]
    fn bodies_without_a_place_or_a_size_are_left_out() {
        for body in [
            Body { heading: f32::NAN, ..body() },
            Body { position: DVec2::NAN, ..body() },
            Body { radius: f32::NAN, ..body() },
            Body { radius: 0.0, core: Vec2::ZERO, ..body() },
        ] {
            assert!(standing(Shape::Car, body, 50.0).is_empty() && standing(Shape::Robot, body, 50.0).is_empty());
        }
    }
}
