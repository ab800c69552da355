//! Uneven ground: heights on a grid.

use super::sweep::{finite, touch_convex};
use super::triangle::Triangle;
use super::{Bounds, Bvh, Surface, SurfaceHit, SurfacePoint, Sweep};
use crate::error::Error;
use glam::{Vec2, Vec3, Vec3Swizzles};

/// The solid below a ground of given heights. Each cell consists of two triangles that meet along its rising diagonal
/// (from the least x and y to the greatest). Beyond the edge of the grid the ground continues at the height of the
/// edge, for 100 km.
///
/// ```
/// use glam::{Vec2, Vec3};
/// use throng::space::surface::{HeightField, Surface};
///
/// // a slope of 45 degrees up along x
/// let slope = HeightField::new(Vec2::ZERO, 10.0, 2, vec![0.0, 10.0, 0.0, 10.0])?;
/// assert_eq!(slope.height(Vec2::new(4.0, 7.0)), 4.0);
/// assert!((slope.query(Vec3::new(4.0, 5.0, 6.0)).distance - 2.0f32.sqrt()).abs() < 1e-5);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct HeightField {
    grid: HeightGrid,
    /// A hierarchy over the cells of the grid.
    bvh: Bvh,
}

/// Heights on a grid, surrounded by a ring of very large cells.
#[derive(Clone, Debug, PartialEq)]
struct HeightGrid {
    low: Vec2,
    /// Width of a cell.
    cell: f32,
    /// Number of heights along x.
    columns: usize,
    /// Number of heights along y.
    rows: usize,
    heights: Vec<f32>,
}

/// Distance that the ground continues beyond the edge of the grid, metres.
const BEYOND: f32 = 1e5;

impl HeightField {
    /// Returns a ground with its lower left corner at `low`, square cells of width `cell`, and heights row by row:
    /// `columns` of them along x, then the next row. All in metres.
    ///
    /// # Errors
    /// [`Error::Limit`] if the corner or a height is not finite, or the width not greater than 0 and finite;
    /// [`Error::Shape`] if there are not at least two columns and two complete rows.
    pub fn new(low: Vec2, cell: f32, columns: usize, heights: Vec<f32>) -> Result<Self, Error> {
        finite("the corner of a height field", low.extend(0.0))?;
        Error::unless_positive("the width of the cells of a height field", cell)?;
        heights.iter().try_for_each(|&z| Error::unless_finite("a height", z.into()))?;
        let rows = heights.len().checked_div(columns).unwrap_or(0);
        if columns < 2 || rows < 2 || rows * columns != heights.len() {
            let count = heights.len();
            let why = format!("{count} heights in rows of {columns} are not at least two full rows of at least two");
            return Err(Error::Shape { what: "a height field".into(), why });
        }
        let grid = HeightGrid { low, cell, columns, rows, heights };
        let cells = ((columns + 1) * (rows + 1)) as u32;
        let boxes: Vec<Bounds> = (0..cells).map(|cell| Bounds::around(grid.corners(cell))).collect();
        Ok(Self { grid, bvh: Bvh::new(&boxes) })
    }

    /// Returns the height of the ground at a point of the plan, metres.
    pub fn height(&self, at: Vec2) -> f32 {
        self.grid.height(at)
    }
}

impl HeightGrid {
    fn height(&self, at: Vec2) -> f32 {
        let most = Vec2::new((self.columns - 1) as f32, (self.rows - 1) as f32);
        let place = ((at - self.low) / self.cell).clamp(Vec2::ZERO, most);
        let (column, row) = ((place.x as usize).min(self.columns - 2), (place.y as usize).min(self.rows - 2));
        let (x, y) = (place.x - column as f32, place.y - row as f32);
        let height = |right: usize, up: usize| self.heights[(row + up) * self.columns + column + right];
        let (near, far) = (height(0, 0), height(1, 1));
        if x >= y {
            near + x * (height(1, 0) - near) + y * (far - height(1, 0))
        } else {
            near + y * (height(0, 1) - near) + x * (far - height(0, 1))
        }
    }

    /// Returns the corners of a cell of the hierarchy, counter-clockwise from the least x and y.
    fn corners(&self, cell: u32) -> [Vec3; 4] {
        let across = self.columns + 1;
        let (column, row) = (cell as usize % across, cell as usize / across);
        // grid lines are numbered including the outer line of the ring on each side
        let line = |k: usize, low: f32, count: usize| {
            let inner = low + k.clamp(1, count).saturating_sub(1) as f32 * self.cell;
            match k {
                0 => inner - BEYOND,
                _ if k > count => inner + BEYOND,
                _ => inner,
            }
        };
        [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(right, up)| {
            let (i, j) = (column + right, row + up);
            let inner = |k: usize, count: usize| k.clamp(1, count) - 1;
            let z = self.heights[inner(j, self.rows) * self.columns + inner(i, self.columns)];
            Vec3::new(line(i, self.low.x, self.columns), line(j, self.low.y, self.rows), z)
        })
    }

    fn triangles(&self, cell: u32) -> [Triangle; 2] {
        let [a, b, c, d] = self.corners(cell);
        [Triangle::new([a, b, c]), Triangle::new([a, c, d])]
    }
}

impl Surface for HeightField {
    fn query(&self, point: Vec3) -> SurfacePoint {
        let look = |cell: u32| {
            let [a, b] = self.grid.triangles(cell).map(|triangle| triangle.query(point).0);
            let nearer = if b.distance < a.distance { b } else { a };
            (nearer.distance, nearer)
        };
        let sheet = self.bvh.nearest(point, look).map(|found| found.1);
        let sheet = sheet.unwrap_or(SurfacePoint { point, normal: Vec3::Z, distance: 0.0 });
        // the normals of a solid below a graph point up: a point that sees the surface from below is inside
        let inside = sheet.normal.z < 0.0 && sheet.distance > 0.0;
        let sign = if inside { -1.0 } else { 1.0 };
        SurfacePoint { normal: sheet.normal * sign, distance: sheet.distance * sign, ..sheet }
    }

    fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit> {
        let hit = self.bvh.first_touched(sweep, |cell, sweep| {
            let hits = self.grid.triangles(cell).map(|triangle| touch_convex(|p| triangle.query(p).0, sweep));
            hits.into_iter().flatten().reduce(|a, b| if b.distance < a.distance { b } else { a })
        })?;
        Some(hit.of_solid(sweep.origin.z >= self.height(sweep.origin.xy())))
    }

    fn facets(&self, _: &Bounds) -> Vec<Vec<Vec3>> {
        let HeightGrid { columns, rows, .. } = self.grid;
        // without the ring of large cells
        let cells = (1..rows).flat_map(|row| (1..columns).map(move |column| (row * (columns + 1) + column) as u32));
        let corners = cells.map(|cell| self.grid.corners(cell));
        corners.flat_map(|[a, b, c, d]| [vec![a, b, c], vec![a, c, d]]).collect()
    }

    fn bounds(&self) -> Bounds {
        let high = self.grid.heights.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        Bounds { high: Vec3::INFINITY.with_z(high), ..Bounds::EVERYWHERE }
    }
}
