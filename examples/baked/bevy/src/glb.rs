//! Reads `.glb` files: their description, buffer views and accessors.

use serde::Deserialize;
use std::collections::BTreeMap;
use std::io::{Read, Seek, SeekFrom};

/// The parts of the description that this program reads.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Root {
    pub asset: Asset,
    #[serde(default)]
    pub nodes: Vec<Node>,
    #[serde(default)]
    pub meshes: Vec<Mesh>,
    #[serde(default)]
    pub materials: Vec<Material>,
    #[serde(default)]
    accessors: Vec<Accessor>,
    #[serde(default)]
    buffer_views: Vec<View>,
}

#[derive(Debug, Deserialize)]
pub struct Asset {
    #[serde(default)]
    pub extras: Extras,
}

/// What throng writes about the whole file.
#[derive(Debug, Default, Deserialize)]
pub struct Extras {
    #[serde(rename = "throng.baked")]
    pub baked: Option<Baked>,
    /// The buffer view of the seconds of the frames.
    #[serde(rename = "throng.times")]
    pub times: Option<usize>,
}

/// The description of the poses.
#[derive(Debug, Default, Deserialize)]
pub struct Baked {
    pub joints: Vec<String>,
    pub parents: Vec<i32>,
    pub bodies: Vec<Body>,
    pub looks: Vec<Vec<Option<[f32; 3]>>>,
    /// Buffer views.
    pub hips: usize,
    pub rotations: usize,
    pub people: Vec<Person>,
}

/// A body of a height of 1 m.
#[derive(Debug, Deserialize)]
pub struct Body {
    pub offsets: Vec<[f32; 3]>,
    /// What only a body of a file has.
    pub figure: Option<Figure>,
    /// The meshes, the finest first.
    pub levels: Vec<usize>,
}

/// A body of a file: where its joints are in the mesh.
#[derive(Debug, Deserialize)]
pub struct Figure {
    pub rests: Vec<[f32; 3]>,
}

#[derive(Debug, Deserialize)]
pub struct Person {
    pub number: u32,
    pub body: usize,
    /// None for a body of a file, which has colours of its own.
    pub look: Option<usize>,
    pub height: f32,
    /// The first frame, the number of frames, and the first pose of each visit.
    pub visits: Vec<[u64; 3]>,
}

#[derive(Debug, Deserialize)]
pub struct Node {
    #[serde(default)]
    pub name: String,
    pub mesh: Option<usize>,
}

#[derive(Debug, Deserialize)]
pub struct Mesh {
    pub primitives: Vec<Primitive>,
}

#[derive(Clone, Debug, Deserialize)]
pub struct Primitive {
    pub attributes: BTreeMap<String, usize>,
    pub indices: Option<usize>,
    pub material: Option<usize>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Material {
    #[serde(default)]
    pub pbr_metallic_roughness: Surface,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Surface {
    pub base_color_factor: Option<[f32; 4]>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Accessor {
    buffer_view: usize,
    #[serde(default)]
    byte_offset: usize,
    component_type: u32,
    #[serde(default)]
    normalized: bool,
    count: usize,
    #[serde(rename = "type")]
    kind: String,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct View {
    #[serde(default)]
    byte_offset: u64,
    byte_length: u64,
    byte_stride: Option<usize>,
}

/// A file. Its buffer waits on the disk.
pub struct Glb<R> {
    pub root: Root,
    reader: R,
    /// The place and the length of the binary chunk.
    bin: (u64, u64),
}

impl<R: Read + Seek> Glb<R> {
    /// Reads the description.
    pub fn read(mut reader: R) -> Result<Self, String> {
        let mut head = [0; 12];
        if reader.read_exact(&mut head).is_err() || &head[..4] != b"glTF" || head[4..8] != 2u32.to_le_bytes() {
            return Err("it is no .glb file of version 2".to_owned());
        }
        let (kind, len) = chunk(&mut reader)?;
        if kind != *b"JSON" {
            return Err("its first chunk is not JSON".to_owned());
        }
        let json = taken(&mut reader, len)?;
        let root = serde_json::from_slice(&json).map_err(|error| format!("its JSON is not readable: {error}"))?;
        // a file without a buffer ends here
        let (kind, len) = chunk(&mut reader).unwrap_or((*b"BIN\0", 0));
        if kind != *b"BIN\0" {
            return Err("its second chunk is not binary".to_owned());
        }
        let at = reader.stream_position().map_err(|error| error.to_string())?;
        if reader.seek(SeekFrom::End(0)).map_err(|error| error.to_string())? < at + len {
            return Err("it ends too early".to_owned());
        }
        Ok(Self { root, reader, bin: (at, len) })
    }

    /// Reads the bytes of a buffer view.
    pub fn view(&mut self, view: usize) -> Result<Vec<u8>, String> {
        let view = self.root.buffer_views.get(view).ok_or_else(|| format!("it has no buffer view {view}"))?;
        if view.byte_offset.checked_add(view.byte_length).is_none_or(|end| end > self.bin.1) {
            return Err("a buffer view is beyond its end".to_owned());
        }
        self.reader.seek(SeekFrom::Start(self.bin.0 + view.byte_offset)).map_err(|error| error.to_string())?;
        taken(&mut self.reader, view.byte_length)
    }

    /// Reads the numbers of an accessor, element by element, `N` each. Normalized integers become parts of 1.
    pub fn numbers<const N: usize>(&mut self, accessor: usize) -> Result<Vec<[f64; N]>, String> {
        let known = self.root.accessors.get(accessor).ok_or_else(|| format!("it has no accessor {accessor}"))?;
        let Accessor { buffer_view, byte_offset, component_type, normalized, count, ref kind } = *known;
        let parts = match kind.as_str() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 0,
        };
        if parts != N {
            return Err(format!("accessor {accessor} has elements of the type {kind}, not of {N} numbers"));
        }
        let (size, one) = match component_type {
            5121 => (1, f64::from(u8::MAX)),
            5123 => (2, f64::from(u16::MAX)),
            5125 => (4, f64::from(u32::MAX)),
            5126 => (4, 1.0),
            other => return Err(format!("accessor {accessor} has numbers of the unknown type {other}")),
        };
        let one = if normalized { one } else { 1.0 };
        let stride = self.root.buffer_views.get(buffer_view).and_then(|view| view.byte_stride).unwrap_or(N * size);
        let bytes = self.view(buffer_view)?;
        let number = |bytes: &[u8]| match (component_type, bytes) {
            (5126, &[a, b, c, d]) => f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => bytes.iter().rev().fold(0.0, |sum, &byte| 256.0 * sum + f64::from(byte)) / one,
        };
        let element = |at: usize| {
            let from = at.checked_mul(stride)?.checked_add(byte_offset)?;
            let bytes = bytes.get(from..from.checked_add(N * size)?)?;
            Some(std::array::from_fn(|part| number(&bytes[part * size..][..size])))
        };
        (0..count).map(|at| element(at).ok_or_else(|| format!("accessor {accessor} is beyond its view"))).collect()
    }

    /// Reads an attribute of a primitive; none if the primitive does not have it.
    pub fn attribute<const N: usize>(&mut self, of: &Primitive, name: &str) -> Result<Option<Vec<[f64; N]>>, String> {
        of.attributes.get(name).map(|&accessor| self.numbers(accessor)).transpose()
    }

    /// The one primitive of a mesh.
    pub fn primitive(&self, mesh: usize) -> Result<Primitive, String> {
        match self.root.meshes.get(mesh).map(|mesh| mesh.primitives.as_slice()) {
            Some([one]) => Ok(one.clone()),
            Some(_) => Err(format!("mesh {mesh} has more than one primitive, or none")),
            None => Err(format!("it has no mesh {mesh}")),
        }
    }
}

/// Reads the kind and the length of a chunk.
fn chunk(reader: &mut impl Read) -> Result<([u8; 4], u64), String> {
    let mut head = [0; 8];
    reader.read_exact(&mut head).map_err(|_| "it ends too early".to_owned())?;
    let [a, b, c, d, kind @ ..] = head;
    Ok((kind, u32::from_le_bytes([a, b, c, d]).into()))
}

/// Reads this number of bytes.
fn taken(reader: &mut impl Read, len: u64) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    reader.take(len).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() as u64 == len { Ok(bytes) } else { Err("it ends too early".to_owned()) }
}
