//! The triangles of a scene, placed before the viewpoint.

use crate::raster::{Cover, Plane, area};
use crate::{Area, Body, Material, Mesh, Scene, View, parallel};
use glam::{IVec2, Vec2, Vec3};
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

/// What is seen at a place of a triangle.
pub(crate) struct Hit {
    /// The normal towards the viewpoint, and that of the triangle, of any length.
    pub normal: Vec3,
    pub face: Vec3,
    pub color: Vec3,
    pub material: Material,
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

    /// Returns what is seen of a triangle in a direction.
    pub fn hit(&self, id: u32, ray: Vec3) -> Hit {
        let surface = self.surface(id);
        let corners = surface.triangles[(id - surface.first) as usize].map(|corner| corner as usize);
        let [a, b, c] = corners.map(|corner| surface.places[corner]);
        // The shares of the corners: the volumes between the direction and the edges.
        let shares = [b.cross(c).dot(ray), c.cross(a).dot(ray), a.cross(b).dot(ray)];
        let sum = shares[0] + shares[1] + shares[2];
        let least = if sum < 0.0 { shares.map(|share| (-share).max(0.0)) } else { shares.map(|share| share.max(0.0)) };
        let whole = 1.0 / (least[0] + least[1] + least[2]).max(f32::MIN_POSITIVE);
        let least = least.map(|share| share * whole);
        let mix = |of: &[Vec3]| of[corners[0]] * least[0] + of[corners[1]] * least[1] + of[corners[2]] * least[2];
        let face = (b - a).cross(c - a);
        let normal = mix(&surface.normals).normalize_or(face.normalize_or(Vec3::Z));
        let face = if face.dot(ray) > 0.0 { -face } else { face };
        let normal = if surface.thin && normal.dot(ray) > 0.0 { -normal } else { normal };
        let color = if surface.colors.is_empty() { Vec3::ONE } else { mix(surface.colors) };
        Hit { normal, face, color, material: surface.material }
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
            let corners = corners.map(|corner| corner as usize);
            let [a, b, c] = corners.map(|corner| outside[corner]);
            if a & b & c != 0 {
                continue;
            }
            let whole = corners.map(|corner| turned[corner]);
            let [from, to, other] = whole;
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
            let pixels: Vec<IVec2> = ring.iter().map(|&place| view.corner(place)).collect();
            let id = self.first + index as u32;
            for k in 1..pixels.len() - 1 {
                let corners = [pixels[0], pixels[k], pixels[k + 1]];
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
