//! Triangles: the nearest point, and the feature of the triangle that contains it. In `f64`, because long thin
//! triangles are common.

use super::SurfacePoint;
use glam::{DVec3, Vec3};

/// A triangle, a sheet with two sides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    corners: [DVec3; 3],
    /// Unit vector to the side from which the corners are counter-clockwise; zero for a triangle without area.
    normal: DVec3,
}

/// A feature of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TriangleFeature {
    /// The interior.
    Face,
    /// The edge from the corner with this index to the next.
    Edge(usize),
    /// The corner with this index.
    Corner(usize),
}

impl Triangle {
    pub fn new(corners: [Vec3; 3]) -> Self {
        let corners = corners.map(|corner| corner.as_dvec3());
        let [a, b, c] = corners;
        Self { corners, normal: (b - a).cross(c - a).normalize_or_zero() }
    }

    /// Returns the unit normal; zero for a triangle without area.
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Returns the nearest point to `p`, and the feature that contains it. The normal points to the side of `p`.
    pub fn query(&self, p: Vec3) -> (SurfacePoint, TriangleFeature) {
        let p = p.as_dvec3();
        let (point, part) = self.nearest(p);
        let offset = p - point;
        let facing = if offset.dot(self.normal) < 0.0 { -self.normal } else { self.normal };
        let normal = if part == TriangleFeature::Face { facing } else { offset.normalize_or(facing) };
        let (point, normal) = (point.as_vec3(), normal.as_vec3());
        (SurfacePoint { point, normal, distance: offset.length() as f32 }, part)
    }

    fn nearest(&self, p: DVec3) -> (DVec3, TriangleFeature) {
        let edge = |i: usize| (self.corners[i], self.corners[(i + 1) % 3]);
        let beyond = |i: &usize| {
            let (start, end) = edge(*i);
            self.normal == DVec3::ZERO || self.normal.cross(end - start).dot(p - start) < 0.0
        };
        let on_edge = |i: usize| {
            let (start, end) = edge(i);
            let along = end - start;
            let t = (p - start).dot(along) / along.length_squared();
            if t >= 1.0 {
                (end, TriangleFeature::Corner((i + 1) % 3))
            } else if t > 0.0 {
                (start + along * t, TriangleFeature::Edge(i))
            } else {
                (start, TriangleFeature::Corner(i))
            }
        };
        let nearer = |a: (DVec3, TriangleFeature), b: (DVec3, TriangleFeature)| {
            if b.0.distance_squared(p) < a.0.distance_squared(p) { b } else { a }
        };
        // a point beyond no edge is above the interior; otherwise the nearest point is on an edge that `p` is beyond
        (0..3).filter(beyond).map(on_edge).reduce(nearer).unwrap_or_else(|| {
            let above = (p - self.corners[0]).dot(self.normal);
            (p - self.normal * above, TriangleFeature::Face)
        })
    }
}
