//! Parts of meshes: the vertices and triangles of one material, as the file has them.

use super::data::{Data, number};
use super::materials::Materials;
use serde_json::Value;

/// The most vertices of all parts, before those that are not used are left out.
const MOST_VERTICES: u64 = 4_000_000;

/// How much of a file is read.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    /// What the file holds, for messages.
    pub of: &'static str,
    /// The most parts.
    pub parts: usize,
    /// The most triangles of all parts.
    pub triangles: usize,
}

/// A part of a mesh.
pub(super) struct Part {
    pub positions: Vec<[f32; 3]>,
    pub normals: Option<Vec<[f32; 3]>>,
    /// The colours of the vertices, sRGB.
    pub colours: Vec<[u8; 3]>,
    /// The vertices of the triangles, three each.
    pub corners: Vec<u32>,
}

/// Reads the parts of a file, one after another.
pub(super) struct Parts<'a> {
    data: &'a Data<'a>,
    limits: Limits,
    materials: Materials,
    /// How many parts, vertices and triangles were read.
    parts: usize,
    vertices: u64,
    triangles: u64,
}

impl<'a> Parts<'a> {
    /// Begins to read a file.
    ///
    /// # Errors
    /// The meshes of the file are compressed.
    pub fn of(data: &'a Data<'a>, limits: Limits) -> Result<Self, String> {
        let packed =
            |name: &&String| name.contains("draco") || name.contains("meshopt") || name.contains("quantization");
        if let Some(name) = data.root.extensions_required.iter().find(packed) {
            return Err(format!("the mesh is compressed ({name}); export it without compression"));
        }
        Ok(Self { data, limits, materials: Materials::default(), parts: 0, vertices: 0, triangles: 0 })
    }

    /// Reads a part; `None` for points and lines.
    ///
    /// # Errors
    /// The part is damaged, has strips or fans of triangles, or there is too much of it.
    pub fn read(&mut self, primitive: &Value) -> Result<Option<Part>, String> {
        match primitive["mode"].as_u64().unwrap_or(4) {
            4 => {}
            // points and lines
            0..=3 => return Ok(None),
            mode => {
                return Err(format!("a mesh has strips or fans of triangles (mode {mode}); export plain triangles"));
            }
        }
        let data = self.data;
        let attributes = &primitive["attributes"];
        let positions = number(&attributes["POSITION"]).ok_or("a mesh has no positions")?;
        let vertices = data.root.accessors.get(positions).map_or(0, |accessor| accessor.count);
        self.count(vertices)?;
        let positions = data.numbers::<3>(positions)?;
        let normals = attribute(data, attributes, "NORMAL", vertices)?.map(|at| data.numbers::<3>(at)).transpose()?;
        let colours = self.materials.colours(data, primitive, vertices)?;
        let corners = self.corners(primitive, positions.len())?;
        Ok(Some(Part { positions, normals, colours, corners }))
    }

    /// Counts a part that is to be read.
    fn count(&mut self, vertices: u64) -> Result<(), String> {
        (self.parts, self.vertices) = (self.parts + 1, self.vertices.saturating_add(vertices));
        let Limits { of, parts, .. } = self.limits;
        if self.parts > parts || self.vertices > MOST_VERTICES {
            return Err(format!(
                "the meshes have more than {parts} parts or {MOST_VERTICES} vertices; export a coarser {of}"
            ));
        }
        Ok(())
    }

    /// Returns the vertices of the corners of triangles of a part with so many vertices.
    fn corners(&mut self, primitive: &Value, vertices: usize) -> Result<Vec<u32>, String> {
        let indices = number(&primitive["indices"]);
        let count = |at: usize| self.data.root.accessors.get(at).map_or(0, |accessor| accessor.count);
        let corners = indices.map_or(vertices as u64, count);
        self.triangles = self.triangles.saturating_add(corners / 3);
        let Limits { of, triangles, .. } = self.limits;
        if self.triangles > triangles as u64 {
            return Err(format!("the {of} has more than {triangles} triangles; export a coarser {of}"));
        }
        let Some(at) = indices else { return Ok((0..vertices as u32).collect()) };
        let corners: Vec<u32> = self.data.whole_numbers::<1>(at)?.into_iter().map(|[index]| index).collect();
        match corners.iter().find(|&&index| index as usize >= vertices) {
            Some(index) => Err(format!("a triangle names vertex {index} of {vertices}")),
            None => Ok(corners),
        }
    }
}

/// Returns the accessor of an attribute of `vertices` vertices, if there is one.
///
/// # Errors
/// It holds another number of values.
pub(super) fn attribute(data: &Data, attributes: &Value, name: &str, vertices: u64) -> Result<Option<usize>, String> {
    let Some(at) = number(&attributes[name]) else { return Ok(None) };
    let accessor = data.root.accessors.get(at).ok_or_else(|| format!("there is no accessor {at}"))?;
    let count = accessor.count;
    if count == vertices {
        Ok(Some(at))
    } else {
        Err(format!("a mesh has {vertices} vertices, but {count} values of {name}"))
    }
}
