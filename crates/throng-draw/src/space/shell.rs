//! Surfaces in perspective: solids as shaded faces, containers as thin lines.

use super::Lens;
use super::solid::{Face, Tone};
use crate::place::SEAM;
use crate::primitive::{Primitive, Stroke};
use glam::{DVec2, DVec3, Vec3};
use std::collections::HashMap;
use throng_record::Shell;

/// The cosine of the angle between two facets below which their common edge is not drawn.
const SMOOTH: f64 = 0.85;
/// The direction of the light.
const LIGHT: DVec3 = DVec3::new(-0.42, -0.56, 0.71);
/// The darkening of a facet that faces away from the light.
const SHADE: f32 = 0.34;
/// The opacity of the lines of containers: of sharp edges, and of lines on round surfaces.
const EDGE: f32 = 0.8;
const LINE: f32 = 0.22;
/// The maximum number of pieces of a facet in each direction.
const PIECES: f64 = 12.0;

/// A surface with its edges.
#[derive(Clone, Debug)]
pub(super) struct Hull {
    facets: Vec<Facet>,
    edges: Vec<Edge>,
    hollow: bool,
}

#[derive(Clone, Debug)]
struct Facet {
    corners: Vec<DVec3>,
    normal: DVec3,
}

/// The common edge of two facets, or the border of one facet.
#[derive(Clone, Copy, Debug)]
struct Edge {
    from: DVec3,
    to: DVec3,
    /// Whether the surface is bent at the edge.
    sharp: bool,
    /// The facets on both sides; the same facet twice at a border.
    sides: [usize; 2],
}

impl Hull {
    pub fn new(shell: &Shell, origin: DVec2) -> Self {
        let place = |corner: &Vec3| corner.as_dvec3() + origin.extend(0.0);
        let facet = |corners: &Vec<Vec3>| {
            let corners: Vec<DVec3> = corners.iter().map(place).collect();
            let normal: DVec3 = pairs(&corners).map(|(a, b)| (a - corners[0]).cross(b - corners[0])).sum();
            Facet { normal: normal.normalize_or_zero(), corners }
        };
        let facets: Vec<Facet> = shell.facets.iter().map(facet).collect();
        let mut open: HashMap<[[u64; 3]; 2], usize> = HashMap::new();
        let mut edges = Vec::new();
        let key = |point: DVec3| point.to_array().map(f64::to_bits);
        for (index, facet) in facets.iter().enumerate() {
            for (from, to) in pairs(&facet.corners) {
                match open.remove(&[key(to), key(from)]) {
                    Some(twin) => {
                        let sharp = facets[twin].normal.dot(facet.normal) < SMOOTH;
                        edges.push(Edge { from, to, sharp, sides: [index, twin] });
                    }
                    None => _ = open.insert([key(from), key(to)], index),
                }
            }
        }
        let ends = open.into_iter().map(|([from, to], index)| {
            let [from, to] = [from, to].map(|point| DVec3::from_array(point.map(f64::from_bits)));
            Edge { from, to, sharp: true, sides: [index, index] }
        });
        let mut ends: Vec<Edge> = ends.collect();
        ends.sort_by_key(|edge| (edge.sides[0], key(edge.from)));
        edges.extend(ends);
        Self { facets, edges, hollow: shell.hollow }
    }

    /// Adds the visible parts of the surface, in pieces of at most `piece` metres.
    pub fn faces(&self, tone: Tone, lens: &Lens, piece: f64, unit: f32, faces: &mut Vec<Face>) {
        if self.hollow {
            faces.extend(self.edges.iter().filter_map(|edge| {
                let middle = (edge.from + edge.to) * 0.5;
                let opacity = if edge.sharp { EDGE } else { LINE } * (1.0 - lens.haze(middle));
                line(edge, lens, Stroke::plain(0.9 * unit, tone.edge.alpha(opacity)))
            }));
            return;
        }
        let seen = |facet: &Facet| (lens.eye - facet.corners[0]).dot(facet.normal) > 0.0;
        let sheet = self.facets.len() == 1;
        for facet in self.facets.iter().filter(|facet| sheet || seen(facet)) {
            let normal = if seen(facet) { facet.normal } else { -facet.normal };
            let middle = facet.corners.iter().sum::<DVec3>() / facet.corners.len() as f64;
            let dark = SHADE * (0.5 - 0.5 * normal.dot(LIGHT) as f32);
            let fill = tone.fill.mix(tone.dark, dark).mix(tone.air, lens.haze(middle));
            for corners in pieces(&facet.corners, piece) {
                let away = corners.iter().map(|corner| lens.away(*corner));
                // Level faces are drawn before the bodies that stand on them.
                let level = normal.z > 0.7;
                let away = if level { away.fold(0.0, f64::max) } else { away.sum::<f64>() / corners.len() as f64 };
                let ring = lens.area(corners);
                let seam = Primitive::Line { points: ring.clone(), closed: true, stroke: Stroke::plain(SEAM, fill) };
                faces.push((away, vec![Primitive::Area { rings: vec![ring], fill }, seam]));
            }
        }
        let stroke = Stroke::plain(unit, tone.edge);
        let borders = self.edges.iter().filter(|edge| edge.sides.iter().any(|&side| seen(&self.facets[side]) || sheet));
        // Edges of the outline, and sharp edges.
        let shown = borders.filter(|edge| edge.sharp || !edge.sides.iter().all(|&side| seen(&self.facets[side])));
        faces.extend(shown.filter_map(|edge| line(edge, lens, stroke)));
    }
}

fn pairs(corners: &[DVec3]) -> impl Iterator<Item = (DVec3, DVec3)> {
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}

/// Returns a line in front of the facets that it bounds.
fn line(edge: &Edge, lens: &Lens, stroke: Stroke) -> Option<Face> {
    let points = lens.line(edge.from, edge.to)?.to_vec();
    let away = lens.away(edge.from).min(lens.away(edge.to));
    Some((away, vec![Primitive::Line { points, closed: false, stroke }]))
}

/// Splits a facet with four corners into pieces; other facets stay whole.
fn pieces(corners: &[DVec3], piece: f64) -> Vec<Vec<DVec3>> {
    let &[a, b, c, d] = corners else { return vec![corners.to_vec()] };
    let parts = |length: f64| (length / piece).ceil().clamp(1.0, PIECES) as usize;
    let (along, across) = (parts(a.distance(b).max(d.distance(c))), parts(a.distance(d).max(b.distance(c))));
    let at = |i: usize, j: usize| {
        let (s, t) = (i as f64 / along as f64, j as f64 / across as f64);
        a.lerp(b, s).lerp(d.lerp(c, s), t)
    };
    let quad = |i: usize, j: usize| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    (0..along).flat_map(|i| (0..across).map(move |j| (i, j))).map(|(i, j)| quad(i, j)).collect()
}
