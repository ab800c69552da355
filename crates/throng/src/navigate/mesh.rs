//! The navigation mesh: triangles of the ground that is free for the centre of a disc.

use super::bend::{VertexBend, bends};
use super::bridges::Bridges;
use super::error::NavError;
use super::fan::Fans;
use super::lattice::Lattice;
use super::locate::sorted;
use super::outline::free_ground;
use super::tangents::Tangents;
use super::triangulate::{NONE, Triangles, triangulate};
use crate::space::{Obstacle, Walkable};
use glam::DVec2;

/// The ground that is free for the centre of a disc, as constrained Delaunay triangles with their neighbours.
///
/// Coordinates are those of the input, metres. Far from the origin (5 000 km), f64 has a resolution of nanometres only;
/// a caller with map coordinates should make them relative to a local origin.
///
/// # Precision
/// The ground is computed on a lattice of 2^-24 m (60 nm), whatever its size, at most 1000 km wide. Walls are inflated
/// by the radius plus half a micrometre. Arcs round their corners are polygons outside the true arc by at most 4 mm. A
/// gap wider than two radii and 9 mm is open; a gap narrower than two radii is closed.
#[derive(Clone, Debug)]
pub struct NavMesh {
    pub(super) radius: f64,
    pub(super) lattice: Lattice,
    pub(super) vertices: Vec<DVec2>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) neighbours: Vec<[u32; 3]>,
    /// How a shortest path can bend at each vertex, if it can.
    pub(super) bends: Vec<Option<VertexBend>>,
    pub(super) fans: Fans,
    pub(super) tangents: Tangents,
    pub(super) islands: Vec<u32>,
    pub(super) island_count: u32,
    pub(super) grid: crate::space::Cells,
    pub(super) bridges: Bridges,
    outline: Vec<Vec<DVec2>>,
}

impl NavMesh {
    /// Builds the mesh for discs of `radius` on the union of the `walkable` areas minus the `obstacles`. Without
    /// walkable areas, the ground is a box around `bounds` and all obstacles with room to pass around them.
    ///
    /// # Errors
    /// Rings that cross themselves or have too few corners; values that are not finite; a radius that is not positive;
    /// no free ground.
    ///
    /// ```
    /// use glam::DVec2;
    /// use throng::{Obstacle, Walkable, navigate::{NavMesh, PathSearch}};
    ///
    /// let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)];
    /// let room = Walkable { outer: corners.map(DVec2::from).to_vec(), holes: vec![] };
    /// let wall = Obstacle::Wall { points: vec![DVec2::new(5.0, 0.0), DVec2::new(5.0, 4.0)] };
    /// let mesh = NavMesh::build(&[room], &[wall], 0.3, (DVec2::ZERO, DVec2::ZERO))?;
    /// let path = mesh.path(&mut PathSearch::new(), DVec2::new(1.0, 1.0), DVec2::new(9.0, 1.0)).unwrap();
    /// assert!(path.length > 10.0 && path.length < 11.0);
    /// # Ok::<(), throng::navigate::NavError>(())
    /// ```
    pub fn build(
        walkable: &[Walkable],
        obstacles: &[Obstacle],
        radius: f64,
        bounds: (DVec2, DVec2),
    ) -> Result<Self, NavError> {
        let (lattice, ground) = free_ground(walkable, obstacles, radius, bounds)?;
        let triangles = triangulate(&ground)?;
        let outline = ground.iter().flatten().map(|ring| ring.iter().map(|&p| lattice.metres(p)).collect()).collect();
        Ok(Self::assemble(radius, lattice, &triangles, outline))
    }

    fn assemble(radius: f64, lattice: Lattice, parts: &Triangles, outline: Vec<Vec<DVec2>>) -> Self {
        let vertices: Vec<DVec2> = parts.points.iter().map(|&point| lattice.metres(point)).collect();
        let (islands, island_count) = islands(&parts.neighbours);
        let grid = sorted(&vertices, &parts.corners);
        Self {
            radius,
            lattice,
            bends: bends(parts),
            fans: Fans::new(vertices.len(), &parts.corners),
            tangents: Tangents::new(vertices.len()),
            bridges: Bridges::new(&parts.neighbours),
            triangles: parts.corners.clone(),
            neighbours: parts.neighbours.clone(),
            vertices,
            islands,
            island_count,
            grid,
            outline,
        }
    }

    /// Returns the radius of the discs, metres.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Returns the corners of the triangles.
    pub fn vertices(&self) -> &[DVec2] {
        &self.vertices
    }

    /// Returns the indices of the corners of each triangle, counter-clockwise.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Returns the triangle behind the edge from corner k to corner k + 1 of a triangle, or `None` for a wall.
    pub fn neighbour(&self, triangle: u32, edge: usize) -> Option<u32> {
        let neighbour = self.neighbours[triangle as usize][edge];
        (neighbour != NONE).then_some(neighbour)
    }

    /// Returns the boundary rings of the mesh, with the ground to their left.
    pub fn outline(&self) -> &[Vec<DVec2>] {
        &self.outline
    }

    /// Returns the area of the mesh, square metres.
    pub fn area_size(&self) -> f64 {
        (0..self.triangles.len() as u32)
            .map(|triangle| {
                let [a, b, c] = self.corners(triangle);
                (b - a).perp_dot(c - a) * 0.5
            })
            .sum()
    }

    /// Returns the number of islands: parts of the mesh with no connection between them.
    pub fn island_count(&self) -> u32 {
        self.island_count
    }

    /// Returns the island that a point is on; `None` off the mesh.
    pub fn island(&self, point: DVec2) -> Option<u32> {
        self.locate(point).map(|triangle| self.islands[triangle as usize])
    }

    /// Returns the corners of a triangle.
    pub(super) fn corners(&self, triangle: u32) -> [DVec2; 3] {
        self.triangles[triangle as usize].map(|vertex| self.vertices[vertex as usize])
    }

    /// Returns the edge of `triangle` that leads to `neighbour`.
    pub(super) fn edge_to(&self, triangle: u32, neighbour: u32) -> usize {
        let edges = self.neighbours[triangle as usize];
        (0..2).find(|&edge| edges[edge] == neighbour).unwrap_or(2)
    }
}

/// Returns the island of each triangle, and the number of islands.
fn islands(neighbours: &[[u32; 3]]) -> (Vec<u32>, u32) {
    let mut islands = vec![NONE; neighbours.len()];
    let mut count = 0;
    let mut open = Vec::new();
    for first in 0..neighbours.len() {
        if islands[first] != NONE {
            continue;
        }
        islands[first] = count;
        open.push(first);
        while let Some(triangle) = open.pop() {
            for next in neighbours[triangle].into_iter().filter(|&next| next != NONE) {
                if islands[next as usize] == NONE {
                    islands[next as usize] = count;
                    open.push(next as usize);
                }
            }
        }
        count += 1;
    }
    (islands, count)
}

/// Returns the corners or neighbours of a triangle, rotated so that another edge is the first.
pub(super) fn rotated<T: Copy>([a, b, c]: [T; 3], by: usize) -> [T; 3] {
    match by {
        0 => [a, b, c],
        1 => [b, c, a],
        _ => [c, a, b],
    }
}
