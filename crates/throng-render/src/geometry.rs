//! The triangles of a scene, placed before the viewpoint.

use crate::material::Patterns;
use crate::raster::{Cover, Plane, area};
use crate::simd::{Floats, LANES, Vec3s, mask, set3};
use crate::{Area, Body, Material, Mesh, Scene, View, parallel};
use fearless_simd::prelude::*;
use glam::{Vec2, Vec3};
use std::borrow::Cow;

/// No triangle: the sky. And the ground.
pub(crate) const SKY: u32 = u32::MAX;
pub(crate) const GROUND: u32 = u32::MAX - 1;
/// Triangles are cut at this many pictures from the middle of the picture, so that their corners stay small numbers.
const GUARD: f32 = 4.0;

/// All triangles of a scene.
pub(crate) struct Geometry<'a> {
    pub surfaces: Vec<Surface<'a>>,
    /// The index of the surface of each triangle.
    owners: Vec<u32>,
    /// The number of areas on the ground, which are the first surfaces.
    pub areas: usize,
}

/// The triangles of a body or of an area on the ground.
pub(crate) struct Surface<'a> {
    pub material: Material,
    /// Whether both sides are seen.
    pub thin: bool,
    /// The number of its first triangle.
    first: u32,
    /// The places of the vertices relative to the viewpoint, metres.
    pub places: Vec<Vec3>,
    normals: Vec<Vec3>,
    colors: &'a [Vec3],
    pub triangles: &'a [[u32; 3]],
}

/// What some pixels see, one in each element.
pub(crate) struct Hits<S: Simd> {
    /// The normals towards the viewpoint, and those of the triangles, of any length.
    pub normal: Vec3s<S>,
    pub face: Vec3s<S>,
    /// The colours without patterns.
    pub color: Vec3s<S>,
    pub patterns: Patterns,
}

/// The corners of the triangles that some pixels see, one triangle in each element.
struct Corners<S: Simd> {
    places: [Vec3s<S>; 3],
    normals: [Vec3s<S>; 3],
    /// The colours of the corners; the colours of the materials.
    colors: [Vec3s<S>; 3],
    material: Vec3s<S>,
    /// The elements that see the ground, those with colours of corners, and those with two seen sides.
    ground: S::mask32s,
    colored: S::mask32s,
    thin: S::mask32s,
}

impl<'a> Geometry<'a> {
    pub fn new(scene: &'a Scene<'_>, view: &View) -> Self {
        let areas = scene.areas.len();
        let mut surfaces = parallel::map(areas + scene.bodies.len(), |index| match scene.areas.get(index) {
            Some(area) => Surface::area(area, view),
            None => Surface::body(&scene.bodies[index - areas], view),
        });
        let mut owners = Vec::new();
        for (index, surface) in surfaces.iter_mut().enumerate() {
            surface.first = owners.len() as u32;
            owners.resize(owners.len() + surface.triangles.len(), index as u32);
        }
        Self { surfaces, owners, areas }
    }

    /// Returns the triangles in the picture: those of areas, and those of bodies. `clear` chooses bodies that one can
    /// see through, from far to near, or all others.
    pub fn covers(&self, view: &View, size: [u32; 2], clear: bool) -> Vec<Vec<Cover>> {
        let mut order: Vec<usize> =
            (0..self.surfaces.len()).filter(|&index| self.surfaces[index].material.is_clear() == clear).collect();
        if clear {
            let depth = |index: &usize| self.surfaces[*index].depth(view);
            order.sort_by(|a, b| depth(b).total_cmp(&depth(a)));
        }
        let guard = Guard::new(view, size);
        parallel::map(order.len(), |k| self.surfaces[order[k]].covers(view, &guard, order[k] < self.areas))
    }

    /// Returns the number of the surface of a triangle.
    pub fn owner(&self, id: u32) -> u32 {
        self.owners[id as usize]
    }

    /// Returns the surface of a triangle.
    pub fn surface(&self, id: u32) -> &Surface<'a> {
        &self.surfaces[self.owner(id) as usize]
    }

    /// Returns what pixels see of triangles and of the `ground` in the directions `rays`. The sky counts as ground.
    #[inline(always)]
    pub fn hits<S: Simd>(&self, simd: S, ids: &[u32; LANES], rays: Vec3s<S>, ground: &Material) -> Hits<S> {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let zero = splat(0.0);
        let (corners, patterns) = self.corners(simd, ids, ground);
        let up = Vec3s::splat(simd, Vec3::Z);
        if corners.ground.all_true() {
            return Hits { normal: up, face: up, color: corners.material, patterns };
        }
        let [a, b, c] = corners.places;
        // The shares of the corners: the volumes between the direction and the edges.
        let shares = [b.cross(c).dot(rays), c.cross(a).dot(rays), a.cross(b).dot(rays)];
        let turned = (shares[0] + shares[1] + shares[2]).simd_lt(zero);
        let least = shares.map(|share| turned.select(-share, share).max(zero));
        let whole = splat(1.0) / (least[0] + least[1] + least[2]).max(splat(f32::MIN_POSITIVE));
        let least = least.map(|share| share * whole);
        let mix = |of: [Vec3s<S>; 3]| of[0] * least[0] + of[1] * least[1] + of[2] * least[2];
        let face = (b - a).cross(c - a);
        let normal = mix(corners.normals).normalize_or(simd, face.normalize_or(simd, up));
        let face = Vec3s::select(face.dot(rays).simd_gt(zero), face.negated(), face);
        let away = corners.thin & normal.dot(rays).simd_gt(zero);
        let normal = Vec3s::select(away, normal.negated(), normal);
        let own = mix(corners.colors).times(corners.material);
        Hits {
            normal: Vec3s::select(corners.ground, up, normal),
            face: Vec3s::select(corners.ground, up, face),
            color: Vec3s::select(corners.colored, own, corners.material),
            patterns,
        }
    }

    /// Returns the corners of triangles, and the patterns of their surfaces.
    #[inline(always)]
    fn corners<S: Simd>(&self, simd: S, ids: &[u32; LANES], ground: &Material) -> (Corners<S>, Patterns) {
        let mut patterns = Patterns::NONE;
        let mut vectors: [[Floats; 3]; 10] = [[[0.0; LANES]; 3]; 10];
        let [mut grounds, mut colored, mut thin] = [[false; LANES]; 3];
        for (k, &id) in ids[..S::f32s::LEN].iter().enumerate() {
            let mut set = |vector: usize, value: Vec3| set3(&mut vectors[vector], k, value);
            let material = if id >= GROUND {
                grounds[k] = true;
                ground
            } else {
                let surface = self.surface(id);
                let corners = surface.triangles[(id - surface.first) as usize];
                for (at, corner) in corners.into_iter().enumerate() {
                    set(at, surface.places[corner as usize]);
                    set(3 + at, surface.normals[corner as usize]);
                    if let Some(color) = surface.colors.get(corner as usize) {
                        set(6 + at, *color);
                        colored[k] = true;
                    }
                }
                thin[k] = surface.thin;
                &surface.material
            };
            set(9, material.color);
            patterns.set(k, material.pattern);
        }
        let [a, b, c, d, e, f, g, h, i, material] = vectors.map(|vector| Vec3s::load(simd, &vector));
        let [ground, colored, thin] = [grounds, colored, thin].map(|flags| mask(simd, &flags));
        let corners =
            Corners { places: [a, b, c], normals: [d, e, f], colors: [g, h, i], material, ground, colored, thin };
        (corners, patterns)
    }
}

impl<'a> Surface<'a> {
    fn area(area: &'a Area, view: &View) -> Self {
        let ground = |corner: &glam::DVec2| view.relative(corner.extend(0.0));
        let places: Vec<Vec3> = area.corners.iter().map(ground).collect();
        let normals = vec![Vec3::Z; places.len()];
        Self { material: area.material, thin: true, first: 0, places, normals, colors: &[], triangles: &area.triangles }
    }

    fn body(body: &'a Body<'_>, view: &View) -> Self {
        let mesh: &Mesh<'_> = body.mesh;
        let origin = view.relative(body.place);
        // Normals stay upright on a body that is scaled equally in all directions.
        let upright = body.turn / body.turn.x_axis.length().max(f32::MIN_POSITIVE);
        Self {
            material: body.material,
            thin: body.thin,
            first: 0,
            places: mesh.positions().iter().map(|&place| origin + body.turn * place).collect(),
            normals: mesh.normals().iter().map(|&normal| upright * normal).collect(),
            colors: mesh.colors(),
            triangles: mesh.triangles(),
        }
    }

    /// Returns the depth of its middle.
    fn depth(&self, view: &View) -> f32 {
        let sum: Vec3 = self.places.iter().sum();
        view.turned(sum / self.places.len().max(1) as f32).z
    }

    fn covers(&self, view: &View, guard: &Guard, flat: bool) -> Vec<Cover> {
        let turned: Vec<Vec3> = self.places.iter().map(|&place| view.turned(place)).collect();
        let outside: Vec<u8> = turned.iter().map(|&place| guard.outside(place)).collect();
        let mut covers = Vec::new();
        for (index, corners) in self.triangles.iter().enumerate() {
            let [i, j, k] = [corners[0] as usize, corners[1] as usize, corners[2] as usize];
            let (a, b, c) = (outside[i], outside[j], outside[k]);
            if a & b & c != 0 {
                continue;
            }
            let whole @ [from, to, other] = [turned[i], turned[j], turned[k]];
            let normal = (to - from).cross(other - from);
            // The axes right, up, forward are a mirror image of those of the world.
            let facing = normal.dot(from);
            if !facing.is_finite() || (facing <= 0.0 && !self.thin) {
                continue;
            }
            let near = if flat { Some(ground(view)) } else { plane(view, normal, normal.dot(from)) };
            let Some(near) = near else { continue };
            let ring = if a | b | c == 0 { Cow::Borrowed(&whole[..]) } else { Cow::Owned(guard.cut(&whole)) };
            if ring.len() < 3 {
                continue;
            }
            let limits = if flat { [0.0, f32::INFINITY] } else { limits(&ring) };
            let id = self.first + index as u32;
            let pixel = |k: usize| view.corner(ring[k]);
            let (first, mut last) = (pixel(0), pixel(1));
            for k in 2..ring.len() {
                let corners = [first, last, pixel(k)];
                last = corners[2];
                // What is turned away by rounding is turned away.
                if self.thin || area(corners) < 0 {
                    covers.extend(Cover::new(corners, near, limits, id));
                }
            }
        }
        covers
    }
}

/// Returns the nearness of the ground.
pub(crate) fn ground(view: &View) -> Plane {
    let up = Vec3::new(view.right.z, view.up.z, view.forward.z);
    plane(view, up, -view.eye.z as f32).unwrap_or(Plane { at: 0.0, step: Vec2::ZERO })
}

/// Returns the nearness, 1/m, of the plane with `normal` at `distance` from the viewpoint, in the axes of the picture;
/// `None` if the viewpoint is in the plane.
fn plane(view: &View, normal: Vec3, distance: f32) -> Option<Plane> {
    let per_pixel = normal / distance;
    let step = Vec2::new(per_pixel.x, -per_pixel.y) / view.focal;
    let plane = Plane { at: per_pixel.z - step.dot(view.centre), step };
    (plane.at.is_finite() && plane.step.is_finite()).then_some(plane)
}

/// Returns the least and the greatest nearness of places in the axes of the picture.
fn limits(ring: &[Vec3]) -> [f32; 2] {
    let near = ring.iter().map(|place| 1.0 / place.z);
    [near.clone().fold(f32::INFINITY, f32::min), near.fold(0.0, f32::max)]
}

/// The room before the viewpoint in which corners have pixels.
pub(crate) struct Guard {
    /// The normals of its sides, in the axes of the picture, and their distances.
    sides: [(Vec3, f32); 5],
}

impl Guard {
    pub fn new(view: &View, [width, height]: [u32; 2]) -> Self {
        let size = Vec2::new(width as f32, height as f32);
        // the slopes of the sides
        let low = (-view.centre - size * (GUARD - 1.0)) / view.focal;
        let high = (size * GUARD - view.centre) / view.focal;
        let sides = [
            (Vec3::Z, view.near),
            (Vec3::new(1.0, 0.0, -low.x), 0.0),
            (Vec3::new(-1.0, 0.0, high.x), 0.0),
            (Vec3::new(0.0, -1.0, -low.y), 0.0),
            (Vec3::new(0.0, 1.0, high.y), 0.0),
        ];
        Self { sides }
    }

    /// Returns the sides that a place is outside of, as bits.
    fn outside(&self, place: Vec3) -> u8 {
        let sides = self.sides.iter().enumerate();
        sides.fold(0, |bits, (k, (normal, distance))| bits | u8::from(normal.dot(place) < *distance) << k)
    }

    /// Whether a place is within.
    pub fn holds(&self, place: Vec3) -> bool {
        place.is_finite() && self.outside(place) == 0
    }

    /// Returns where the part of a line within begins and ends, as shares of the line; `None` if all of it is outside.
    pub fn part(&self, from: Vec3, to: Vec3) -> Option<[f32; 2]> {
        let [mut low, mut high] = [0.0f32, 1.0f32];
        for (normal, distance) in &self.sides {
            let [a, b] = [from, to].map(|place| normal.dot(place) - distance);
            match (a >= 0.0, b >= 0.0) {
                (true, true) => {}
                (true, false) => high = high.min(a / (a - b)),
                (false, true) => low = low.max(a / (a - b)),
                (false, false) => return None,
            }
        }
        (low < high && from.is_finite() && to.is_finite()).then_some([low, high])
    }

    /// Returns the part of a polygon within (Sutherland, Hodgman, 1974). Edges that two polygons share are cut at the
    /// same place: from the end within to the end outside.
    fn cut(&self, ring: &[Vec3]) -> Vec<Vec3> {
        let mut ring = ring.to_vec();
        for &(normal, distance) in &self.sides {
            let mut part = Vec::with_capacity(ring.len() + 2);
            for (k, &to) in ring.iter().enumerate() {
                let from = ring[(k + ring.len() - 1) % ring.len()];
                let [a, b] = [from, to].map(|place| normal.dot(place) - distance);
                if (a < 0.0) != (b < 0.0) {
                    let ((inner, i), (outer, o)) = if a < 0.0 { ((to, b), (from, a)) } else { ((from, a), (to, b)) };
                    part.push(inner + (outer - inner) * (i / (i - o)));
                }
                if b >= 0.0 {
                    part.push(to);
                }
            }
            ring = part;
        }
        ring.retain(|place| place.is_finite() && place.z > 0.0);
        ring
    }
}
