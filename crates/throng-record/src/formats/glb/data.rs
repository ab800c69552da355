//! The chunks of a file and the numbers in its binary chunk.

use super::json::{Accessor, BYTE, BufferView, FLOAT, Root, SHORT, UNSIGNED_BYTE, UNSIGNED_INT, UNSIGNED_SHORT};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;
use std::borrow::Cow;

/// A file in memory.
pub struct Data<'a> {
    pub root: Root,
    /// The bytes of each buffer; `None`: they are not in the file.
    buffers: Vec<Option<Cow<'a, [u8]>>>,
}

impl<'a> Data<'a> {
    /// Parses the chunks of a file.
    ///
    /// # Errors
    /// The file is not binary glTF 2, or is cut off.
    pub fn open(bytes: &'a [u8]) -> Result<Self, String> {
        let word = |at: usize| bytes.get(at..at + 4).map(|word| [word[0], word[1], word[2], word[3]]);
        let number = |at: usize| word(at).map(u32::from_le_bytes);
        if word(0) != Some(*b"glTF") {
            return Err("the file does not begin like binary glTF".to_owned());
        }
        match number(4) {
            Some(2) => {}
            Some(version) => return Err(format!("the file is glTF {version}, not 2")),
            None => return Err("the file is cut off: a part is missing".to_owned()),
        }
        let length = number(8).map_or(0, |length| length as usize);
        if length < 12 || bytes.len() < length {
            return Err("the file is cut off: a part is missing".to_owned());
        }
        let (mut json, mut bin, mut at) = (None, None, 12);
        while let (Some(size), Some(kind)) = (number(at), word(at + 4)) {
            let end = (at + 8).saturating_add(size as usize);
            let part = bytes[..length].get(at + 8..end).ok_or("a chunk extends beyond the end of the file")?;
            match &kind {
                b"JSON" if json.is_none() => json = Some(part),
                b"BIN\0" if bin.is_none() => bin = Some(part),
                _ => {}
            }
            at = end;
        }
        let json = json.ok_or("it has no JSON")?;
        Self::of(json, bin.unwrap_or_default())
    }

    /// Parses a file: binary glTF 2, or JSON with its buffers embedded (`.gltf`).
    ///
    /// # Errors
    /// The file is neither, or is cut off.
    pub fn open_any(bytes: &'a [u8]) -> Result<Self, String> {
        let text = bytes.trim_ascii_start();
        if text.starts_with(b"{") { Self::of(text, &[]) } else { Self::open(bytes) }
    }

    /// Parses the JSON of a file. `bin` is its binary chunk.
    fn of(json: &[u8], bin: &'a [u8]) -> Result<Self, String> {
        let root: Root =
            serde_json::from_slice(json).map_err(|error| format!("its JSON is not valid glTF: {error}"))?;
        let buffer = |(at, buffer): (usize, &super::json::Buffer)| match &buffer.uri {
            None => (at == 0).then_some(Cow::Borrowed(bin)),
            Some(uri) => embedded(uri).map(Cow::Owned),
        };
        let buffers = root.buffers.iter().enumerate().map(buffer).collect();
        Ok(Self { root, buffers })
    }

    /// Returns the bytes of a buffer view and its stride, bytes, if it has one.
    ///
    /// # Errors
    /// There is no such view, or its bytes are not in the file.
    pub fn view(&self, at: usize) -> Result<(&[u8], Option<u64>), String> {
        let view = self.root.buffer_views.get(at).ok_or_else(|| format!("there is no buffer view {at}"))?;
        let &BufferView { buffer, byte_offset, byte_length, byte_stride, .. } = view;
        let Some(buffer) = self.buffers.get(buffer).and_then(Option::as_deref) else {
            return Err(format!("the bytes of buffer view {at} are not in the file"));
        };
        let range = usize::try_from(byte_offset).ok().zip(usize::try_from(byte_length).ok());
        let bytes = range.and_then(|(from, length)| buffer.get(from..from.checked_add(length)?));
        let bytes = bytes.ok_or_else(|| format!("buffer view {at} extends beyond the end of the file"))?;
        Ok((bytes, byte_stride))
    }

    /// Returns the numbers of an accessor, `N` per element.
    ///
    /// # Errors
    /// The numbers have another type, are not in the file, or are not finite.
    pub fn numbers<const N: usize>(&self, at: usize) -> Result<Vec<[f32; N]>, String> {
        let elements = self.elements::<N, f32>(at, decimal)?;
        let finite = elements.as_flattened().iter().all(|value| value.is_finite());
        if finite { Ok(elements) } else { Err(format!("accessor {at} holds a number that is not finite")) }
    }

    /// Returns the whole numbers of an accessor, `N` per element.
    ///
    /// # Errors
    /// The numbers have another type, or are not in the file.
    pub fn whole_numbers<const N: usize>(&self, at: usize) -> Result<Vec<[u32; N]>, String> {
        self.elements(at, whole_number)
    }

    /// Returns the elements of an accessor. `decoder` returns the size of its numbers, bytes, and how they are decoded;
    /// `None` if they are not of the type.
    fn elements<const N: usize, T: Copy + Default>(
        &self,
        at: usize,
        decoder: fn(&Accessor) -> Decoder<T>,
    ) -> Result<Vec<[T; N]>, String> {
        let accessor = self.root.accessors.get(at).ok_or_else(|| format!("there is no accessor {at}"))?;
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"].get(N - 1).copied().unwrap_or("MAT4");
        let decoder = decoder(accessor).filter(|_| accessor.kind == kind && accessor.sparse.is_null());
        let (size, decode) = decoder.ok_or_else(|| format!("accessor {at} does not hold plain {kind} numbers"))?;
        let (bytes, stride) = self.view(accessor.buffer_view.ok_or_else(|| format!("accessor {at} reads nothing"))?)?;
        let behind = || format!("accessor {at} reads beyond the end of its buffer view");
        let size_of = |value: u64| usize::try_from(value).map_err(|_| behind());
        let bytes = bytes.get(size_of(accessor.byte_offset)?..).ok_or_else(behind)?;
        let (element, count) = (N * size, size_of(accessor.count)?);
        let stride = size_of(stride.unwrap_or(element as u64))?.max(element);
        let fits = bytes.len().saturating_add(stride).saturating_sub(element) / stride;
        if count > fits {
            return Err(behind());
        }
        let elements = (0..count).map(|k| {
            let bytes = &bytes[k * stride..][..element];
            let mut values = [T::default(); N];
            values.iter_mut().zip(bytes.chunks_exact(size)).for_each(|(value, bytes)| *value = decode(bytes));
            values
        });
        Ok(elements.collect())
    }
}

/// Returns the number of an accessor or another part of the file.
pub fn number(value: &Value) -> Option<usize> {
    usize::try_from(value.as_u64()?).ok()
}

/// Returns the bytes of a location that holds them; `None` if they are elsewhere.
pub fn embedded(uri: &str) -> Option<Vec<u8>> {
    let (_, text) = uri.strip_prefix("data:")?.split_once(";base64,")?;
    STANDARD.decode(text).ok()
}

/// The size of a number in bytes, and what decodes it.
type Decoder<T> = Option<(usize, fn(&[u8]) -> T)>;

/// Returns the size of an accessor's numbers in bytes, and their decoder. Normalised integers become fractions of their
/// greatest value.
fn decimal(accessor: &Accessor) -> Decoder<f32> {
    Some(match (accessor.component_type, accessor.normalized) {
        (FLOAT, _) => (4, |b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
        (SHORT, true) => (2, |b| (f32::from(i16::from_le_bytes([b[0], b[1]])) / 32767.0).max(-1.0)),
        (UNSIGNED_SHORT, true) => (2, |b| f32::from(u16::from_le_bytes([b[0], b[1]])) / 65535.0),
        (BYTE, true) => (1, |b| (f32::from(b[0].cast_signed()) / 127.0).max(-1.0)),
        (UNSIGNED_BYTE, true) => (1, |b| f32::from(b[0]) / 255.0),
        _ => return None,
    })
}

/// Returns the size of an accessor's whole numbers in bytes, and their decoder.
fn whole_number(accessor: &Accessor) -> Decoder<u32> {
    Some(match (accessor.component_type, accessor.normalized) {
        (UNSIGNED_BYTE, false) => (1, |b| u32::from(b[0])),
        (UNSIGNED_SHORT, false) => (2, |b| u32::from(u16::from_le_bytes([b[0], b[1]]))),
        (UNSIGNED_INT, false) => (4, |b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
        _ => return None,
    })
}
