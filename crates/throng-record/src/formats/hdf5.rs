//! HDF5 files of the Pedestrian Dynamics Data Archive.
//!
//! The dataset `trajectory` is a table with the columns `id`, `frame`, `x`, `y` and optionally `z`, the height of the
//! head, which is not read; units are metres. Its attribute `fps` is the frame rate. The optional attribute
//! `wkt_geometry` of the file is the walkable area.

use super::text::{people, person, rate, walker};
use super::{Format, FormatFlaw, Reading};
use crate::trajectories::Trajectories;
use glam::DVec2;
use hdf5_reader::{Dataset, Datatype, Hdf5File, OpenOptions};
use throng::Walkable;
use throng_scene::import::wkt;

/// Read only.
pub(super) const FORMAT: Format = Format {
    ending: "h5",
    title: "people's trajectories in HDF5: the Pedestrian Dynamics Data Archive's",
    columns: false,
    styles: &[],
    create: None,
    read: Some(read),
    figures: None,
    kept: false,
    sniff: None,
};

const HINT: &str = "such a file has a dataset `trajectory` with the columns id, frame, x and y, and its attribute fps";
/// Greatest ratio of the size of the uncompressed table to that of the file.
const LARGER: usize = 100;

fn read(bytes: &[u8], reading: &Reading) -> Result<Trajectories, FormatFlaw> {
    let limits = OpenOptions::default()
        .with_max_read_bytes(bytes.len().saturating_mul(LARGER))
        .with_max_chunk_bytes(bytes.len().saturating_mul(LARGER));
    let file = Hdf5File::from_bytes_with_options(bytes, limits).map_err(flaw)?;
    let table = file.dataset("trajectory").map_err(flaw)?;
    let fps = table.attribute("fps").and_then(|fps| fps.read_as_f64()).ok();
    let rate = rate(fps, reading)?;
    let unit = reading.unit.unwrap_or(1.0);
    let columns = Hdf5Columns::of(&table)?;
    let rows = table.read_native_bytes().map_err(flaw)?;
    let spot = |(at, row): (usize, &[u8])| {
        let wrong = |what: &str| FormatFlaw {
            line: None,
            why: format!("row {at} of `trajectory` has no {what}"),
            hint: Some(HINT),
        };
        let [id, frame, x, y] = columns.0.map(|column| column.value(row).filter(|value| value.is_finite()));
        let number = id.and_then(person).ok_or_else(|| wrong("agent number as id"))?;
        let values = frame.zip(x).zip(y).ok_or_else(|| wrong("finite frame, x and y"));
        let ((frame, x), y) = values?;
        Ok(walker(number, frame / rate, DVec2::new(x, y) * unit))
    };
    let spots = rows.chunks_exact(columns.1).enumerate().map(spot).collect::<Result<_, FormatFlaw>>()?;
    let mut tracks = people(spots, false)?;
    if let Ok(text) = file.root_group().and_then(|root| root.attribute("wkt_geometry")?.read_string()) {
        tracks.setting.walkable = walkable(&text, unit)?;
    }
    Ok(tracks)
}

fn flaw(error: hdf5_reader::error::Error) -> FormatFlaw {
    FormatFlaw { line: None, why: error.to_string(), hint: Some(HINT) }
}

fn walkable(text: &str, unit: f64) -> Result<Vec<Walkable>, FormatFlaw> {
    let wrong = |error| FormatFlaw {
        line: None,
        why: format!("the attribute wkt_geometry: {error}"),
        hint: Some("write the walkable area as WKT, such as POLYGON ((0 0, 9 0, 9 5, 0 0))"),
    };
    let ring = |ring: Vec<[f64; 2]>| ring.into_iter().map(|corner| DVec2::from_array(corner) * unit).collect();
    let areas = wkt::areas(text).map_err(wrong)?.into_iter();
    Ok(areas
        .map(|area| Walkable { outer: ring(area.outer), holes: area.holes.into_iter().map(ring).collect() })
        .collect())
}

/// The positions of id, frame, x and y within a row, and the length of a row, bytes.
struct Hdf5Columns([Hdf5Column; 4], usize);

impl Hdf5Columns {
    fn of(table: &Dataset) -> Result<Self, FormatFlaw> {
        let wrong = |why: String| FormatFlaw { line: None, why, hint: Some(HINT) };
        let Datatype::Compound { size, fields } = table.dtype() else {
            return Err(wrong("the dataset `trajectory` is not a table".into()));
        };
        let mut columns = [Hdf5Column::default(); 4];
        for (column, name) in columns.iter_mut().zip(["id", "frame", "x", "y"]) {
            let field = fields.iter().find(|field| field.name == name);
            let field = field.ok_or_else(|| wrong(format!("`trajectory` has no column `{name}`")))?;
            let kind =
                Kind::of(&field.datatype).ok_or_else(|| wrong(format!("the column `{name}` holds no numbers")))?;
            *column = Hdf5Column { offset: field.byte_offset as usize, kind };
        }
        match *size {
            0 => Err(wrong("the rows of `trajectory` are empty".into())),
            size => Ok(Self(columns, size as usize)),
        }
    }
}

#[derive(Clone, Copy, Default)]
struct Hdf5Column {
    offset: usize,
    kind: Kind,
}

/// The type of a number, in the byte order of the machine.
#[derive(Clone, Copy, Default)]
enum Kind {
    #[default]
    F64,
    F32,
    I64,
    I32,
    I16,
    U64,
    U32,
    U16,
}

impl Kind {
    fn of(datatype: &Datatype) -> Option<Self> {
        Some(match datatype {
            Datatype::FloatingPoint { size: 8, .. } => Self::F64,
            Datatype::FloatingPoint { size: 4, .. } => Self::F32,
            Datatype::FixedPoint { size: 8, signed: true, .. } => Self::I64,
            Datatype::FixedPoint { size: 4, signed: true, .. } => Self::I32,
            Datatype::FixedPoint { size: 2, signed: true, .. } => Self::I16,
            Datatype::FixedPoint { size: 8, .. } => Self::U64,
            Datatype::FixedPoint { size: 4, .. } => Self::U32,
            Datatype::FixedPoint { size: 2, .. } => Self::U16,
            _ => return None,
        })
    }
}

impl Hdf5Column {
    /// Returns the number of the column in a row; `None` if the row is too short.
    fn value(&self, row: &[u8]) -> Option<f64> {
        let bytes = row.get(self.offset..)?;
        Some(match self.kind {
            Kind::F64 => f64::from_ne_bytes(*bytes.first_chunk()?),
            Kind::F32 => f32::from_ne_bytes(*bytes.first_chunk()?).into(),
            Kind::I64 => i64::from_ne_bytes(*bytes.first_chunk()?) as f64,
            Kind::I32 => i32::from_ne_bytes(*bytes.first_chunk()?).into(),
            Kind::I16 => i16::from_ne_bytes(*bytes.first_chunk()?).into(),
            Kind::U64 => u64::from_ne_bytes(*bytes.first_chunk()?) as f64,
            Kind::U32 => u32::from_ne_bytes(*bytes.first_chunk()?).into(),
            Kind::U16 => u16::from_ne_bytes(*bytes.first_chunk()?).into(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_files_are_errors() {
        for bytes in [&b""[..], b"1 2 3", b"\x89HDF\r\n\x1a\n", &[0; 4096]] {
            assert!(read(bytes, &Reading::default()).unwrap_err().hint.unwrap().contains("trajectory"));
        }
    }
}
