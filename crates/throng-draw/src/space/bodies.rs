//! The bodies of agents as meshes.

use super::light::light_of;
use super::{SpaceScene, footprint};
use crate::look::Look;
use crate::plan::{LEAST_RADIUS, middle};
use crate::{Painter, shape};
use glam::{DVec3, Mat3, Vec3};
use throng::motion::Basis;
use throng_record::Body;
use throng_render::{Body as Placed, Material, Mesh};

/// The nose, the left tip, the notch between the wings, and the right tip of a dart: forward, left and up, in radii.
const DART: [Vec3; 4] =
    [Vec3::new(1.9, 0.0, 0.0), Vec3::new(-1.3, 1.35, 0.35), Vec3::new(-0.75, 0.0, -0.1), Vec3::new(-1.3, -1.35, 0.35)];
/// The numbers of corners around balls, and the radii from which each is used, pixels.
const BALLS: [(u32, f32); 3] = [(8, 0.0), (16, 6.0), (32, 24.0)];
/// The dark part of a ball, which shows the heading: the least cosine of the angle to it, seen from the middle of the ball,
/// and the factor of its colour.
const FRONT: f32 = 0.9;
const MARKED: f32 = 0.25;

/// The meshes that agents share: a ball for each size in the picture, and a dart.
#[derive(Clone, Debug)]
pub(super) struct Stock {
    balls: [Mesh<'static>; BALLS.len()],
    dart: Mesh<'static>,
}

impl Stock {
    /// Creates the meshes; `headings`: balls show where they head.
    pub fn new(headings: bool) -> Self {
        let mut dart = Mesh::default();
        let [nose, left, notch, right] = DART;
        dart.face(&[nose, left, notch]);
        dart.face(&[nose, notch, right]);
        Self { balls: BALLS.map(|(around, _)| ball(around, headings)), dart }
    }
}

/// Returns a ball of radius 1.
fn ball(around: u32, headings: bool) -> Mesh<'static> {
    let ball = Mesh::capsule(Vec3::ZERO, Vec3::ZERO, [1.0; 2], around);
    let tone = |normal: &Vec3| Vec3::splat(if normal.x > FRONT { MARKED } else { 1.0 });
    let colors: Vec<Vec3> = if headings { ball.normals().iter().map(tone).collect() } else { Vec::new() };
    let arrays = (ball.positions().to_vec(), ball.normals().to_vec(), ball.triangles().to_vec());
    Mesh::new(arrays.0, arrays.1, colors, arrays.2).unwrap_or(ball)
}

/// How an agent is drawn.
enum Form {
    /// A mesh of its own, in the axes of the world about the middle of the agent; `plain`: it has the colour of the agent.
    Own { mesh: Mesh<'static>, place: DVec3, thin: bool, plain: bool, gloss: f32 },
    /// A ball.
    Ball(usize),
    /// A dart.
    Dart(Basis),
}

/// The agents of a moment, with one or several forms each.
pub(super) struct Agents<'a> {
    all: Vec<(&'a Body, Form)>,
}

impl<'a> Agents<'a> {
    /// Creates the meshes of `bodies` at a time.
    pub fn new(bodies: impl Iterator<Item = &'a Body>, stage: &SpaceScene, painter: &Painter, time: f64) -> Self {
        let Painter { look, people, birds, vehicles, strides, .. } = painter;
        let mut all = Vec::new();
        for body in bodies {
            let scale = stage.lens.scale(body.center()) as f32;
            let own = |mesh, thin| Form::Own { mesh, place: body.center(), thin, plain: true, gloss: 0.0 };
            let tinted = |mesh, gloss| Form::Own { mesh, place: body.center(), thin: false, plain: false, gloss };
            let parts = vehicles.parts(body, look, scale);
            if !parts.is_empty() {
                all.extend(parts.into_iter().map(|part| (body, tinted(part.mesh, part.gloss))));
                continue;
            }
            if let Some(mesh) = people.mesh(body, look, scale) {
                all.push((body, tinted(mesh, 0.0)));
                continue;
            }
            if let Some(mesh) = birds.mesh(body, stage.growth) {
                all.push((body, own(mesh, true)));
                continue;
            }
            if let Some(shape) = look.shape(body) {
                all.push((body, own(shape::mesh(shape, body, (strides, time), scale), true)));
                continue;
            }
            let form = match body.basis {
                Some(basis) => Form::Dart(basis),
                None if body.core != glam::Vec2::ZERO => {
                    let low = body.center().truncate();
                    let ring = footprint(body).into_iter().map(|corner| (corner - low).as_vec2()).collect();
                    own(Mesh::prism(&[ring], 0.0, 2.0 * body.shape().clearance_radius()), false)
                }
                None => Form::Ball(BALLS.iter().rposition(|(_, least)| body.radius * scale >= *least).unwrap_or(0)),
            };
            all.push((body, form));
        }
        Self { all }
    }

    /// Returns the agents as parts of a scene.
    pub fn placed<'b>(&'b self, stage: &'b SpaceScene, look: &Look) -> impl Iterator<Item = Placed<'b>> {
        self.all.iter().map(move |(body, form)| {
            let color = light_of(look.coat(body).fill);
            match form {
                Form::Own { mesh, place, thin, plain, gloss } => {
                    let material =
                        Material { gloss: *gloss, ..Material::plain(if *plain { color } else { Vec3::ONE }) };
                    Placed { mesh, place: *place, turn: Mat3::IDENTITY, material, thin: *thin }
                }
                Form::Ball(level) => {
                    let place = middle(body);
                    let least = LEAST_RADIUS / stage.lens.scale(place) as f32;
                    let ball =
                        Placed::standing(&stage.stock.balls[*level], place, body.heading, Material::plain(color));
                    Placed { turn: ball.turn * body.radius.max(least), ..ball }
                }
                Form::Dart(basis) => {
                    let turn = Mat3::from_cols(basis.forward, basis.side, basis.up) * (body.radius * stage.growth);
                    let material = Material::plain(color);
                    Placed { mesh: &stage.stock.dart, place: body.center(), turn, material, thin: true }
                }
            }
        })
    }
}
