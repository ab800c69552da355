//! Things that stand: obstacles, holes in the ground, and surfaces.

use super::light::light_of;
use crate::Color;
use glam::{DVec2, DVec3, Mat3, Vec2, Vec3};
use std::collections::BTreeMap;
use throng::Obstacle;
use throng_record::{SetMesh, Shell};
use throng_render::{Body, Line, LineEnd, Material, Mesh, Pattern};

/// The number of corners of a round obstacle.
const ROUND: usize = 48;
/// Half the thickness of walls that have none, metres.
const THIN: f64 = 0.04;
/// The strength of the grain of obstacles.
const GRAIN: f32 = 0.08;
/// The cosine of the angle between two facets below which their common edge is not drawn as an edge.
const SMOOTH: f32 = 0.85;
/// The opacity of the lines of containers: of sharp edges, and of lines on round surfaces.
const EDGE: f32 = 0.8;
const LINE: f32 = 0.22;

/// A mesh at a place.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    mesh: Mesh<'static>,
    place: DVec3,
    material: Material,
    thin: bool,
}

impl Solid {
    /// Returns the parts of an obstacle from the ground to a height, metres.
    pub fn obstacle(obstacle: &Obstacle, height: f64, color: Color) -> Vec<Self> {
        let prism = |corners: &[DVec2]| Self::prism(corners, [0.0, height], color);
        match obstacle {
            Obstacle::Circle { center, radius } => {
                let around = (0..ROUND).map(|k| DVec2::from_angle(k as f64 * std::f64::consts::TAU / ROUND as f64));
                vec![prism(&around.map(|out| *center + out * *radius).collect::<Vec<_>>())]
            }
            Obstacle::Polygon { corners } => vec![prism(corners)],
            Obstacle::Wall { points } => {
                let part = |ends: &[DVec2]| {
                    let along = (ends[1] - ends[0]).normalize_or_zero() * THIN;
                    let (from, to, side) = (ends[0] - along, ends[1] + along, along.perp());
                    prism(&[from - side, to - side, to + side, from + side])
                };
                points.windows(2).map(part).collect()
            }
        }
    }

    /// Returns a prism over a ring of corners from the first to the second height, metres.
    pub fn prism(corners: &[DVec2], [low, high]: [f64; 2], color: Color) -> Self {
        let place = origin(corners);
        let ring: Vec<Vec2> = corners.iter().map(|corner| (*corner - place).as_vec2()).collect();
        let mesh = Mesh::prism(&[ring], 0.0, (high - low) as f32);
        Self { mesh, place: place.extend(low), material: material(color), thin: false }
    }

    /// Returns a surface; `None` for a container, which has lines instead.
    pub fn shell(shell: &Shell, origin: DVec2, color: Color) -> Option<Self> {
        if shell.hollow {
            return None;
        }
        let mut mesh = Mesh::default();
        shell.facets.iter().for_each(|facet| mesh.face(facet));
        // A single facet is a sheet, which has two sides.
        let thin = shell.facets.len() == 1;
        Some(Self { mesh, place: origin.extend(0.0), material: material(color), thin })
    }

    /// Returns a set, at the origin of the setting.
    pub fn set(set: &SetMesh, origin: DVec2) -> Self {
        let colors: Vec<Vec3> = set.colors.iter().map(|&[r, g, b]| light_of(Color { r, g, b, a: 255 })).collect();
        let mesh = Mesh::new(set.positions.clone(), set.normals.clone(), colors, set.triangles.clone());
        let mesh = mesh.unwrap_or_default();
        Self { mesh, place: origin.extend(0.0), material: Material::plain(Vec3::ONE), thin: true }
    }

    /// Returns it as a part of a scene.
    pub fn body(&self) -> Body<'_> {
        let Self { mesh, place, material, thin } = self;
        Body { mesh, place: *place, turn: Mat3::IDENTITY, material: *material, thin: *thin }
    }
}

fn origin(corners: &[DVec2]) -> DVec2 {
    corners.iter().copied().find(|corner| corner.is_finite()).unwrap_or_default()
}

fn material(color: Color) -> Material {
    Material { pattern: Pattern::Grain { strength: GRAIN }, ..Material::plain(light_of(color)) }
}

/// Returns the edges of a container as lines.
pub(super) fn container(shell: &Shell, origin: DVec2, width: f32, color: Color) -> Vec<Line> {
    /// The ends of an edge, whether the surface is bent at it, and the normal of its first facet.
    type Edge = ([Vec3; 2], bool, Vec3);
    if !shell.hollow {
        return Vec::new();
    }
    let mut edges: BTreeMap<[[u32; 3]; 2], Edge> = BTreeMap::new();
    let key = |point: Vec3| point.to_array().map(f32::to_bits);
    for facet in &shell.facets {
        let sides = || facet.iter().copied().zip(facet.iter().copied().cycle().skip(1));
        let normal = sides().map(|(a, b)| (a - facet[0]).cross(b - facet[0])).sum::<Vec3>().normalize_or_zero();
        for (from, to) in sides() {
            match edges.get_mut(&[key(to), key(from)]) {
                Some((_, sharp, twin)) => *sharp = twin.dot(normal) < SMOOTH,
                None => _ = edges.insert([key(from), key(to)], ([from, to], true, normal)),
            }
        }
    }
    let line = |(ends, sharp, _): &Edge| {
        let opacity = if *sharp { EDGE } else { LINE };
        let end = |at: Vec3| LineEnd { at: at.as_dvec3() + origin.extend(0.0), width, opacity };
        Line { ends: ends.map(end).to_vec(), color: light_of(color), flat: false }
    };
    edges.values().map(line).collect()
}
