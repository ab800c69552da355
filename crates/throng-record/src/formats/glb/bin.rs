//! The binary chunk of a file, which waits on disk until the JSON is written, and its views and accessors.

use super::json::{Accessor, BufferView, FLOAT, SHORT, UNSIGNED_BYTE, UNSIGNED_INT, Word};
use crate::Output;
use crate::formats::spill::beside;
use glam::{Mat4, Quat, Vec3};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufWriter, Read, Seek, Write};

/// The error of a file that becomes too large.
pub const TOO_LARGE: &str =
    "a .glb file holds at most 4 GiB; write fewer frames or agents, several files, or a .usda file";
/// Repeated data of at most this many bytes are written once.
const SMALL: usize = 64;

/// A binary chunk under construction.
#[derive(Debug)]
pub struct Bin {
    file: BufWriter<File>,
    len: u64,
    pub views: Vec<BufferView>,
    pub accessors: Vec<Accessor>,
    /// Accessors of small data of the current view, by type and bytes.
    small: BTreeMap<(u32, Word, Vec<u8>), usize>,
}

impl Bin {
    /// Starts an empty chunk.
    ///
    /// # Errors
    /// A system error.
    pub fn new(output: &Output) -> io::Result<Self> {
        let file = BufWriter::new(beside(output)?);
        Ok(Self { file, len: 0, views: Vec::new(), accessors: Vec::new(), small: BTreeMap::new() })
    }

    /// Starts a view for the data that follow, or uses the last one if it is empty. Returns its index.
    ///
    /// # Errors
    /// A system error, or [`TOO_LARGE`].
    pub fn view(&mut self, target: Option<u32>) -> io::Result<usize> {
        // aligned for the widest number
        self.append(&[0; 7][..(self.len.wrapping_neg() % 8) as usize])?;
        self.small.clear();
        self.views.pop_if(|last| last.byte_length == 0);
        self.views.push(BufferView { byte_offset: self.len, target, ..BufferView::default() });
        Ok(self.views.len() - 1)
    }

    /// Adds bytes to the view.
    ///
    /// # Errors
    /// A system error, or [`TOO_LARGE`].
    pub fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.append(bytes)?;
        if let Some(view) = self.views.last_mut() {
            view.byte_length = self.len - view.byte_offset;
        }
        Ok(())
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.len += bytes.len() as u64;
        if self.len > u64::from(u32::MAX) { Err(io::Error::other(TOO_LARGE)) } else { self.file.write_all(bytes) }
    }

    /// Adds an accessor and its bytes. Returns its index.
    fn accessor(&mut self, accessor: Accessor, bytes: &[u8]) -> io::Result<usize> {
        let key = (accessor.component_type, accessor.kind.clone(), bytes.to_vec());
        if bytes.len() <= SMALL
            && let Some(&same) = self.small.get(&key)
        {
            return Ok(same);
        }
        let view = self.views.len() - 1;
        let byte_offset = self.len - self.views[view].byte_offset;
        self.put(bytes)?;
        self.accessors.push(Accessor { buffer_view: Some(view), byte_offset, ..accessor });
        let at = self.accessors.len() - 1;
        if bytes.len() <= SMALL {
            self.small.insert(key, at);
        }
        Ok(at)
    }

    /// Adds increasing seconds.
    ///
    /// # Errors
    /// A system error, or [`TOO_LARGE`].
    pub fn times(&mut self, seconds: &[f32]) -> io::Result<usize> {
        let bytes: Vec<u8> = seconds.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(times(seconds), &bytes)
    }

    /// Adds an accessor of the seconds of consecutive frames, starting at `from`. The caller sets its view later.
    pub fn times_of(&mut self, from: usize, seconds: &[f32]) -> usize {
        self.accessors.push(Accessor { byte_offset: 4 * from as u64, ..times(seconds) });
        self.accessors.len() - 1
    }

    /// Adds numbers.
    ///
    /// # Errors
    /// A system error, or [`TOO_LARGE`].
    pub fn scalars(&mut self, values: &[f32]) -> io::Result<usize> {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(of(FLOAT, "SCALAR", values.len()), &bytes)
    }

    /// Adds points or sizes. `bounds`: whether the accessor states their minimum and maximum, as points of meshes
    /// require.
    ///
    /// # Errors
    /// A system error, or [`TOO_LARGE`].
    pub fn vectors(&mut self, vectors: &[Vec3], bounds: bool) -> io::Result<usize> {
        let bytes: Vec<u8> = vectors.iter().flat_map(|v| v.to_array()).flat_map(f32::to_le_bytes).collect();
        let mut accessor = of(FLOAT, "VEC3", vectors.len());
        if bounds && !vectors.is_empty() {
            let within = |of: fn(Vec3, Vec3) -> Vec3| vectors.iter().copied().reduce(of).unwrap_or_default();
            (accessor.min, accessor.max) = (within(Vec3::min).to_array().into(), within(Vec3::max).to_array().into());
        }
        self.accessor(accessor, &bytes)
    }

    /// Adds rotations, 16 bits per number.
    ///
    /// # Errors
    /// A system error, or [`TOO_LARGE`].
    pub fn turns(&mut self, turns: &[Quat]) -> io::Result<usize> {
        let short = |value: f32| (value * f32::from(i16::MAX)).round() as i16;
        let bytes = turns.iter().flat_map(|turn| turn.to_array()).flat_map(|value| short(value).to_le_bytes());
        let bytes: Vec<u8> = bytes.collect();
        self.accessor(Accessor { normalized: true, ..of(SHORT, "VEC4", turns.len()) }, &bytes)
    }

    /// Adds four values per point: numbers of joints, or parts of 1 in 255ths.
    ///
    /// # Errors
    /// A system error, or [`TOO_LARGE`].
    pub fn fours(&mut self, fours: &[[u8; 4]], normalized: bool) -> io::Result<usize> {
        self.accessor(Accessor { normalized, ..of(UNSIGNED_BYTE, "VEC4", fours.len()) }, fours.as_flattened())
    }

    /// Adds transforms.
    ///
    /// # Errors
    /// A system error, or [`TOO_LARGE`].
    pub fn matrices(&mut self, matrices: &[Mat4]) -> io::Result<usize> {
        let bytes = matrices.iter().flat_map(|matrix| matrix.to_cols_array()).flat_map(f32::to_le_bytes);
        self.accessor(of(FLOAT, "MAT4", matrices.len()), &bytes.collect::<Vec<_>>())
    }

    /// Adds triangles of point indices.
    ///
    /// # Errors
    /// A system error, or [`TOO_LARGE`].
    pub fn triangles(&mut self, triangles: &[[u32; 3]]) -> io::Result<usize> {
        let bytes: Vec<u8> = triangles.iter().flatten().flat_map(|at| at.to_le_bytes()).collect();
        self.accessor(of(UNSIGNED_INT, "SCALAR", 3 * triangles.len()), &bytes)
    }

    /// Returns the number of bytes, padded to a whole word, and a reader of them.
    ///
    /// # Errors
    /// A system error, or [`TOO_LARGE`].
    pub fn read(mut self) -> io::Result<(u64, impl Read)> {
        self.append(&[0; 3][..(self.len.wrapping_neg() % 4) as usize])?;
        let mut file = self.file.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.rewind()?;
        Ok((self.len, file))
    }
}

fn of(component_type: u32, kind: &'static str, count: usize) -> Accessor {
    Accessor { component_type, kind: kind.into(), count: count as u64, ..Accessor::default() }
}

fn times(seconds: &[f32]) -> Accessor {
    let ends = [seconds.first(), seconds.last()].map(|end| end.copied().into_iter().collect());
    let [min, max] = ends;
    Accessor { min, max, ..of(FLOAT, "SCALAR", seconds.len()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_gets_no_larger_than_it_can() {
        let folder = tempfile::tempdir().unwrap();
        let mut bin = Bin::new(&Output::create(folder.path().join("run.glb")).unwrap()).unwrap();
        bin.view(None).unwrap();
        bin.len = u64::from(u32::MAX) - 4;
        bin.put(&[1; 4]).unwrap();
        assert!(bin.put(&[1; 4]).unwrap_err().to_string().contains("4 GiB"));
    }

    #[test]
    fn repeated_small_data_are_written_once() {
        let folder = tempfile::tempdir().unwrap();
        let mut bin = Bin::new(&Output::create(folder.path().join("run.glb")).unwrap()).unwrap();
        bin.view(None).unwrap();
        let [first, other, again] = [[0.0, 1.0], [0.0, 2.0], [0.0, 1.0]].map(|seconds| bin.times(&seconds).unwrap());
        assert!(first == again && first != other);
        assert_eq!((bin.accessors.len(), bin.read().unwrap().0), (2, 16));
    }
}
