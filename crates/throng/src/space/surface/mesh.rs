//! Triangle meshes.

use super::sweep::{finite, rounding, touch_convex};
use super::triangle::{Triangle, TriangleFeature};
use super::{Bounds, Bvh, Surface, SurfaceHit, SurfacePoint, Sweep, topology};
use crate::error::Error;
use glam::{DVec3, Vec3};

/// A mesh of triangles. If every edge belongs to two triangles, the mesh is the surface of a solid, whatever the
/// orientation of its triangles. Otherwise it is a sheet with two sides.
///
/// The side of a closed mesh on which a point lies follows from the normal at the nearest point. On edges and corners
/// that is the angle-weighted mean of the normals around it (Baerentzen and Aanaes, *Signed distance computation using
/// the angle weighted pseudonormal*, IEEE TVCG 11(3), 2005). The triangles must not intersect each other.
///
/// ```
/// use glam::Vec3;
/// use throng::space::surface::{Mesh, Surface};
///
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
/// let tetrahedron = Mesh::new(&corners, &[[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]])?;
/// assert!(tetrahedron.is_closed());
/// assert!((tetrahedron.query(Vec3::splat(0.1)).distance + 0.1).abs() < 1e-6);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    points: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    bvh: Bvh,
    /// Present if the mesh is closed.
    solid: Option<InsideTest>,
}

/// The data that distinguishes inside from outside.
#[derive(Clone, Debug, PartialEq)]
struct InsideTest {
    /// The triangle across each edge.
    across: Vec<[u32; 3]>,
    /// The normal at each point.
    corners: Vec<DVec3>,
}

impl Mesh {
    /// Returns a mesh of triangles, each given by the indices of its corners among the points, metres. Points at the
    /// same place are merged. Triangles with two corners at the same place are left out.
    ///
    /// # Errors
    /// [`Error::Limit`] if a point is not finite; [`Error::Shape`] if a triangle has an index out of range, or no
    /// triangle is left.
    pub fn new(points: &[Vec3], triangles: &[[u32; 3]]) -> Result<Self, Error> {
        let fail = |why: String| Err(Error::Shape { what: "a mesh".into(), why });
        points.iter().try_for_each(|&point| finite("a point of a mesh", point))?;
        for (t, corners) in triangles.iter().enumerate() {
            if let Some(index) = corners.iter().find(|&&index| index as usize >= points.len()) {
                return fail(format!("triangle {t} names point {index}, but there are {}", points.len()));
            }
        }
        let (points, mut triangles) = topology::weld(points, triangles);
        if triangles.is_empty() {
            return fail("it has no triangle with three different corners".into());
        }
        let mut across = topology::neighbours(&triangles);
        let closed = across.as_mut().is_some_and(|across| topology::turn_out(&points, &mut triangles, across));
        let at = |corners: &[u32; 3]| corners.map(|i| points[i as usize]);
        let boxes: Vec<Bounds> = triangles.iter().map(|corners| Bounds::around(at(corners))).collect();
        let corners = corner_normals(&points, &triangles);
        let solid = across.filter(|_| closed).map(|across| InsideTest { across, corners });
        Ok(Self { bvh: Bvh::new(&boxes), points, triangles, solid })
    }

    /// Whether the mesh is the surface of a solid.
    pub fn is_closed(&self) -> bool {
        self.solid.is_some()
    }

    /// Returns the number of triangles.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether the mesh has no triangles. Always false.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    fn triangle(&self, index: u32) -> Triangle {
        Triangle::new(self.triangles[index as usize].map(|i| self.points[i as usize]))
    }

    /// Returns the normal of the solid at a feature of a triangle.
    fn normal(&self, solid: &InsideTest, index: u32, part: TriangleFeature) -> DVec3 {
        let face = self.triangle(index).normal();
        match part {
            TriangleFeature::Face => face,
            TriangleFeature::Edge(k) => face + self.triangle(solid.across[index as usize][k]).normal(),
            TriangleFeature::Corner(k) => solid.corners[self.triangles[index as usize][k] as usize],
        }
    }
}

impl Surface for Mesh {
    fn query(&self, point: Vec3) -> SurfacePoint {
        let look = |index: u32| {
            let (near, part) = self.triangle(index).query(point);
            (near.distance, (near, index, part))
        };
        let nearest = self.bvh.nearest(point, look).map(|found| found.1);
        let Some((near, index, part)) = nearest else {
            return SurfacePoint { point, normal: Vec3::Z, distance: 0.0 };
        };
        let behind = |solid: &InsideTest| self.normal(solid, index, part).dot(near.normal.as_dvec3()) < 0.0;
        let sign = if self.solid.as_ref().is_some_and(behind) { -1.0 } else { 1.0 };
        SurfacePoint { normal: near.normal * sign, distance: near.distance * sign, ..near }
    }

    fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit> {
        let hit = self.bvh.first_touched(sweep, |index, sweep| {
            let triangle = self.triangle(index);
            touch_convex(|p| triangle.query(p).0, sweep)
        })?;
        if !self.is_closed() {
            return Some(hit);
        }
        // the side is determined at the contact, which is faster: on the surface itself by the direction of motion,
        // else by the sign of the distance, since the nearest part may be one that the ball touched at the start and
        // leaves
        let there = self.query(sweep.at(hit.distance));
        let towards = there.normal.dot(sweep.direction) <= 0.0;
        let on_surface = hit.distance > 0.0 && there.distance.abs() <= 4.0 * rounding(there.point);
        Some(hit.of_solid(if on_surface { towards } else { !there.is_inside() }))
    }

    fn facets(&self, _: &Bounds) -> Vec<Vec<Vec3>> {
        self.triangles.iter().map(|corners| corners.map(|i| self.points[i as usize]).to_vec()).collect()
    }

    fn bounds(&self) -> Bounds {
        self.bvh.bounds()
    }
}

/// Returns, for each point, the angle-weighted sum of the normals of the triangles around it.
fn corner_normals(points: &[Vec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; points.len()];
    for corners in triangles {
        let at = corners.map(|i| points[i as usize]);
        let normal = Triangle::new(at).normal();
        for k in 0..3 {
            let arm = |other: usize| (at[other % 3] - at[k]).as_dvec3();
            let (next, last) = (arm(k + 1), arm(k + 2));
            normals[corners[k] as usize] += normal * libm::atan2(next.cross(last).length(), next.dot(last));
        }
    }
    normals
}
