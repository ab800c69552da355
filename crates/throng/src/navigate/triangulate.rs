//! Constrained Delaunay triangulation of polygons with holes, on the lattice.

use super::error::NavError;
use super::lattice::{LatticePoint, steps};
use super::outline::Shapes;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Stands for "no triangle" or "no vertex".
pub(super) const NONE: u32 = u32::MAX;

/// A triangulation.
pub(super) struct Triangles {
    /// The vertices.
    pub points: Vec<LatticePoint>,
    /// The vertices of each triangle, counter-clockwise.
    pub corners: Vec<[u32; 3]>,
    /// The triangle behind the edge from corner k to corner k + 1, or [`NONE`].
    pub neighbours: Vec<[u32; 3]>,
}

/// Triangulates the inside of `shapes`.
pub(super) fn triangulate(shapes: &Shapes) -> Result<Triangles, NavError> {
    let failed = |what: String| NavError::Triangulation(what);
    let mut points: Vec<LatticePoint> = shapes.iter().flatten().flatten().copied().collect();
    points.sort_unstable_by_key(|point| (point.x, point.y));
    points.dedup();
    let handle = |point: &LatticePoint| points.binary_search_by_key(&(point.x, point.y), |p| (p.x, p.y)).unwrap_or(0);
    let places = points.iter().map(|&point| Point2::new(steps(point).x, steps(point).y)).collect();
    let mut cdt: ConstrainedDelaunayTriangulation<Point2<f64>> =
        ConstrainedDelaunayTriangulation::bulk_load_cdt(places, Vec::new())
            .map_err(|error| failed(error.to_string()))?;

    let mut boundary = Vec::new();
    for contour in shapes.iter().flatten() {
        for (at, point) in contour.iter().enumerate() {
            let (from, to) = (handle(point), handle(&contour[(at + 1) % contour.len()]));
            let (from, to) = (FixedVertexHandle::from_index(from), FixedVertexHandle::from_index(to));
            let edges = cdt.try_add_constraint(from, to);
            if edges.is_empty() && from != to {
                return Err(failed(format!("the boundary crosses itself near vertex {}", from.index())));
            }
            boundary.extend(edges);
        }
    }

    // the ground lies to the left of every boundary edge and spreads from there to the next constraint
    let mut inside = vec![false; cdt.num_all_faces()];
    let mut open: Vec<_> = boundary.iter().map(|&edge| cdt.directed_edge(edge).face().fix()).collect();
    while let Some(face) = open.pop() {
        let Some(inner) = cdt.face(face).as_inner() else { continue };
        if inside[face.index()] {
            continue;
        }
        inside[face.index()] = true;
        for edge in inner.adjacent_edges() {
            if !edge.is_constraint_edge() {
                open.push(edge.rev().face().fix());
            }
        }
    }

    let mut number = vec![NONE; cdt.num_all_faces()];
    let mut corners = Vec::new();
    for face in cdt.inner_faces().filter(|face| inside[face.fix().index()]) {
        number[face.fix().index()] = corners.len() as u32;
        corners.push(face.vertices().map(|vertex| vertex.fix().index() as u32));
    }
    let neighbours = cdt
        .inner_faces()
        .filter(|face| inside[face.fix().index()])
        .map(|face| face.adjacent_edges().map(|edge| number[edge.rev().face().fix().index()]))
        .collect();
    Ok(Triangles { points, corners, neighbours })
}
