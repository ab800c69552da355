//! Triangle meshes in Wavefront OBJ, as surfaces for steering. Has its own reader: of the format's many statements a
//! surface needs two, `v` and `f`, and existing readers do not report the wrong number with its line.

use crate::error::{Error, Kind};
use earcut::Earcut;
use glam::Vec3;
use std::path::Path;
use throng::space::surface::Mesh;

/// The axis of a file that points up. In scenes it is z; most programs write OBJ with y up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ObjUp {
    /// x to the right, y up, z to the viewer: rotated so that y becomes z.
    #[default]
    Y,
    /// z up: not rotated.
    Z,
}

/// The triangles of an OBJ file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// Points, metres.
    pub points: Vec<Vec3>,
    /// Indices of the triangles' corners in `points`.
    pub triangles: Vec<[u32; 3]>,
}

/// Reads the surface in an OBJ file, in metres.
///
/// # Errors
/// The file cannot be read, no triangle has three different corners, or an error of [`triangles`].
pub fn load(path: impl AsRef<Path>, up: ObjUp) -> Result<Mesh, Error> {
    let path = path.as_ref();
    let text = crate::file::read_text(path)?;
    let Triangles { points, triangles } =
        triangles(&text, up).map_err(|error| error.file(path.display().to_string()))?;
    Mesh::new(&points, &triangles)
        .map_err(|error| Error::new(Kind::Geometry, error.to_string()).file(path.display().to_string()))
}

/// Reads the triangles of an OBJ text. Faces with more corners are cut into triangles. Statements other than points and
/// faces are ignored.
///
/// ```
/// use throng_scene::import::obj::{ObjUp, triangles};
///
/// let roof = triangles("v 0 1 0\nv 4 1 0\nv 4 2 -3\nv 0 2 -3\nf 1 2 3 4\n", ObjUp::Y)?;
/// assert_eq!(roof.triangles, [[0, 1, 2], [0, 2, 3]]);
/// assert_eq!(roof.points[2].to_array(), [4.0, 3.0, 2.0]);
/// # Ok::<(), throng_scene::Error>(())
/// ```
///
/// # Errors
/// A coordinate is not a finite number, a face has fewer than three corners or refers to a point that does not exist,
/// or the text has no faces. The error has line and column.
pub fn triangles(text: &str, up: ObjUp) -> Result<Triangles, Error> {
    let reader = Reader { text };
    let mut out = Triangles::default();
    for (_, words) in reader.statements("v") {
        let [x, y, z] = reader.point(&words)?;
        out.points.push(match up {
            ObjUp::Y => Vec3::new(x, -z, y),
            ObjUp::Z => Vec3::new(x, y, z),
        });
    }
    for (before, words) in reader.statements("f") {
        let corners: Vec<u32> =
            words[1..].iter().map(|word| reader.corner(word, before, out.points.len())).collect::<Result<_, _>>()?;
        if corners.len() < 3 {
            let message = format!("this face has {} corners, but needs at least 3", corners.len());
            return Err(reader.wrong(words[0], Kind::Geometry, message));
        }
        let points: Vec<Vec3> = corners.iter().map(|&i| out.points[i as usize]).collect();
        let parts =
            if is_convex(&points) { (2..corners.len()).map(|k| [0, k - 1, k]).collect() } else { ears(&points) };
        out.triangles.extend(parts.into_iter().map(|part: [usize; 3]| part.map(|k| corners[k])));
    }
    if out.triangles.is_empty() {
        let hint = "a surface in OBJ has points, lines `v x y z`, and faces that name them from 1, lines `f 1 2 3`";
        return Err(Error::new(Kind::Geometry, "this file has no faces").hint(hint));
    }
    Ok(out)
}

/// The text, in which errors locate words.
struct Reader<'t> {
    text: &'t str,
}

impl<'t> Reader<'t> {
    /// Returns the words of the lines that start with `name`, and the number of points defined before each line.
    fn statements(&self, name: &'static str) -> impl Iterator<Item = (usize, Vec<&'t str>)> + use<'t> {
        let lines = self.text.lines().map(|line| line.split('#').next().unwrap_or_default());
        let mut points = 0;
        lines.filter_map(move |line| {
            let first = line.split_whitespace().next()?;
            let before = points;
            points += usize::from(first == "v");
            (first == name).then(|| (before, line.split_whitespace().collect()))
        })
    }

    /// Returns the coordinates of a point.
    fn point(&self, words: &[&'t str]) -> Result<[f32; 3], Error> {
        if words.len() < 4 {
            let message = format!("this point has {} coordinates, but needs 3", words.len() - 1);
            return Err(self.wrong(words[0], Kind::Syntax, message));
        }
        let mut point = [0.0f32; 3];
        for (x, word) in point.iter_mut().zip(&words[1..]) {
            *x = word.parse().map_err(|_| self.wrong(word, Kind::Syntax, format!("`{word}` is not a number")))?;
            if !x.is_finite() {
                return Err(self.wrong(word, Kind::OutOfRange, format!("the coordinate `{word}` is not finite")));
            }
        }
        Ok(point)
    }

    /// Returns the index of the point that a corner of a face refers to: counted from 1, or back from the last point
    /// before it. Numbers after a slash are for texture and light.
    fn corner(&self, word: &'t str, before: usize, points: usize) -> Result<u32, Error> {
        let number = word.split('/').next().unwrap_or_default();
        let index: i64 = number.parse().map_err(|_| {
            let message = format!("`{word}` names no point");
            self.wrong(word, Kind::Syntax, message).hint("a corner is the number of a point, such as 7 or 7/1/3")
        })?;
        let place = if index < 0 { before as i64 + index } else { index - 1 };
        let place = usize::try_from(place).ok().filter(|&place| place < points);
        place.map(|place| place as u32).ok_or_else(|| {
            let message = format!("there is no point {index}");
            self.wrong(word, Kind::OutOfRange, message).hint(format!("there are {points}, counted from 1"))
        })
    }

    fn wrong(&self, word: &'t str, kind: Kind, message: impl Into<String>) -> Error {
        let start = word.as_ptr() as usize - self.text.as_ptr() as usize;
        Error::new(kind, message).place(self.text, start..start + word.len())
    }
}

/// Returns the triangles of a polygon that is not convex, flattened along its mean normal, with the same orientation.
fn ears(points: &[Vec3]) -> Vec<[usize; 3]> {
    let normal = normal(points).normalize_or(Vec3::Z);
    let x = normal.any_orthonormal_vector();
    let y = normal.cross(x);
    let flat = points.iter().map(|p| [f64::from(p.dot(x)), f64::from(p.dot(y))]);
    let mut ends: Vec<usize> = vec![];
    Earcut::new().earcut(flat, &[], &mut ends);
    let front = |[a, b, c]: [usize; 3]| (points[b] - points[a]).cross(points[c] - points[a]).dot(normal) >= 0.0;
    let turned = |[a, b, c]: [usize; 3]| if front([a, b, c]) { [a, b, c] } else { [a, c, b] };
    ends.chunks_exact(3).map(|ends| turned([ends[0], ends[1], ends[2]])).collect()
}

/// Returns the sum of the normals of a fan of triangles.
fn normal(points: &[Vec3]) -> Vec3 {
    (2..points.len()).map(|k| (points[k - 1] - points[0]).cross(points[k] - points[0])).sum()
}

/// Whether a polygon in space is convex, as seen along its mean normal.
fn is_convex(points: &[Vec3]) -> bool {
    let n = points.len();
    let normal = normal(points);
    (0..n).all(|i| {
        let (a, b, c) = (points[i], points[(i + 1) % n], points[(i + 2) % n]);
        // rounding may turn straight corners either way
        (b - a).cross(c - b).dot(normal) >= -1e-4 * normal.length_squared()
    })
}
