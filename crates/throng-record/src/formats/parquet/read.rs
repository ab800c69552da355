//! Reads Parquet.

use crate::csv::status_of;
use crate::formats::names::Names;
use crate::formats::{FormatFlaw, Reading, describe, keys};
use crate::trajectories::{RADIUS, Sample, Trajectories};
use bytes::Bytes;
use glam::{DVec3, Vec3};
use parquet::basic::LogicalType;
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::metadata::ParquetMetaData;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use std::borrow::Cow;
use throng::Status;

const HINT: &str = "a table of trajectories has the columns number (or id), time (or frame), x and y, and may have group, z, vx, vy, \
                    vz, heading, radius and status, as `throng run -o NAME.parquet` writes them";

const TOO_MANY: &str = "the file has more rows than fit into a file of its size";

/// Rows read per batch.
const BATCH: usize = 1 << 14;

/// Reads a table that throng or another program wrote. The columns `number` (or `id`), `time` (or `frame`, with a frame
/// rate), `x` and `y` are required, of any numeric type. Other missing columns get the defaults of CSV.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<Trajectories, FormatFlaw> {
    // the Parquet reader may panic on damaged files
    let read = throng_scene::caught(|| parse(bytes, reading));
    let read = read.unwrap_or_else(|_| Err("the file is damaged: its metadata is inconsistent".to_owned()));
    read.map_err(|why| FormatFlaw { line: None, why, hint: Some(HINT) })
}

fn parse(bytes: &[u8], reading: &Reading) -> Result<Trajectories, String> {
    let file = SerializedFileReader::new(Bytes::copy_from_slice(bytes)).map_err(broken)?;
    let metadata = file.metadata();
    let chunks = metadata.row_groups().iter().flat_map(|group| group.columns());
    if chunks.into_iter().any(|chunk| chunk.data_page_offset() < 0 || chunk.compressed_size() < 0) {
        return Err("the file is damaged: a column has no position".to_owned());
    }
    let mut tracks = Trajectories::default();
    let mut names = Names::default();
    let rate = describe(metadata, &mut tracks, &mut names)?;
    let columns = ParquetColumns::find(metadata, reading.rate.or(rate))?;
    // A row takes at least an eighth of a byte, except for a crowd that stands still; such a crowd of 2^20 rows is
    // accepted in a file of any size.
    let most = (1usize << 20).saturating_add(bytes.len().saturating_mul(8));
    let rows: i64 = metadata.row_groups().iter().map(|group| group.num_rows()).fold(0, i64::saturating_add);
    let rows = usize::try_from(rows).ok().filter(|&rows| rows <= most).ok_or(TOO_MANY)?;
    tracks.spots.reserve_exact(rows);
    for group in 0..file.num_row_groups() {
        let group = file.get_row_group(group).map_err(broken)?;
        columns.rows(&*group, most, reading.unit.unwrap_or(1.0), &mut names, &mut tracks.spots)?;
    }
    tracks.setting.groups = names.into_names();
    tracks.sort();
    tracks.complete(columns.velocity[0].is_none() || columns.velocity[1].is_none(), columns.heading.is_none());
    Ok(tracks)
}

fn broken(error: ParquetError) -> String {
    format!("the file is not Parquet, or is damaged: {error}")
}

/// Reads the metadata; returns the frame rate.
fn describe(metadata: &ParquetMetaData, tracks: &mut Trajectories, names: &mut Names) -> Result<Option<f64>, String> {
    let pairs = metadata.file_metadata().key_value_metadata();
    let value = |key: &str| pairs?.iter().find(|pair| pair.key == key)?.value.clone();
    tracks.setting = describe::setting(value, names)?;
    let rate = |text: String| text.parse().map_err(|_| format!("{} is `{text}`, no number", keys::RATE));
    value(keys::RATE).map(rate).transpose()
}

/// The indices of the columns.
struct ParquetColumns {
    number: usize,
    time: usize,
    /// Length of a unit of the column `time`, seconds.
    second: f64,
    x: usize,
    y: usize,
    z: Option<usize>,
    velocity: [Option<usize>; 3],
    heading: Option<usize>,
    radius: Option<usize>,
    group: Option<usize>,
    status: Option<usize>,
    /// Whether whole numbers of 32 bits are unsigned.
    unsigned: bool,
    names: Vec<String>,
}

impl ParquetColumns {
    fn find(metadata: &ParquetMetaData, rate: Option<f64>) -> Result<Self, String> {
        let schema = metadata.file_metadata().schema_descr();
        let names: Vec<String> = schema.columns().iter().map(|column| column.name().to_lowercase()).collect();
        let column = |name: &str| names.iter().position(|other| other == name);
        let needed = |name: &str| column(name).ok_or_else(|| format!("there is no column `{name}`"));
        let number = column("number").map_or_else(|| needed("id").or_else(|_| needed("number")), Ok)?;
        let (time, second) = match (column("time"), column("frame"), rate) {
            (Some(time), ..) => (time, 1.0),
            (None, Some(frame), Some(rate)) if rate > 0.0 => (frame, 1.0 / rate),
            (None, Some(_), _) => return Err("the file counts frames, but does not state the frame rate".to_owned()),
            (None, None, _) => (needed("time")?, 1.0),
        };
        let unsigned =
            matches!(schema.column(number).logical_type_ref(), Some(LogicalType::Integer(int)) if !int.is_signed);
        Ok(Self {
            number,
            time,
            second,
            x: needed("x")?,
            y: needed("y")?,
            z: column("z"),
            velocity: ["vx", "vy", "vz"].map(column),
            heading: column("heading"),
            radius: column("radius"),
            group: column("group"),
            status: column("status"),
            unsigned,
            names,
        })
    }

    /// Reads a row group; `spots` may have at most `most` samples in all.
    fn rows(
        &self,
        group: &dyn RowGroupReader,
        most: usize,
        unit: f64,
        names: &mut Names,
        spots: &mut Vec<Sample>,
    ) -> Result<(), String> {
        let left = most.saturating_sub(spots.len());
        let cells = |column: usize| cells(group, column, left).map_err(|why| self.about(column, &why));
        let numbers = |column: usize| match cells(column)? {
            Cells::Numbers(numbers) => Ok(numbers),
            Cells::Words(_) => Err(self.about(column, "the values are texts, not numbers")),
        };
        let or = |column: Option<usize>| column.map(numbers).transpose();
        let (number, time, x, y) = (numbers(self.number)?, numbers(self.time)?, numbers(self.x)?, numbers(self.y)?);
        let [vx, vy, vz] = self.velocity.map(or);
        let (z, vx, vy, vz) = (or(self.z)?, vx?, vy?, vz?);
        let (heading, radius) = (or(self.heading)?, or(self.radius)?);
        let (groups, states) = (self.group.map(cells).transpose()?, self.status.map(cells).transpose()?);
        let rows = number.len();
        let counts = [Some(&time), Some(&x), Some(&y), z.as_ref(), vx.as_ref(), vy.as_ref(), vz.as_ref()];
        let counts = counts.into_iter().chain([heading.as_ref(), radius.as_ref()]).flatten().map(Vec::len);
        if counts.chain([&groups, &states].into_iter().flatten().map(Cells::len)).any(|count| count != rows) {
            return Err("the file is damaged: its columns differ in length".to_owned());
        }
        let single = |column: &Option<Vec<f64>>, row: usize, or: f32| column.as_ref().map_or(or, |c| c[row] as f32);
        for row in 0..rows {
            let place = DVec3::new(x[row], y[row], z.as_ref().map_or(0.0, |z| z[row])) * unit;
            let time = time[row] * self.second;
            if !place.is_finite() || !time.is_finite() {
                return Err(format!("row {} of a group has a position or a time that is not finite", row + 1));
            }
            let velocity = Vec3::new(single(&vx, row, 0.0), single(&vy, row, 0.0), single(&vz, row, 0.0));
            spots.push(Sample {
                number: self.agent(number[row])?,
                group: names.index(&groups.as_ref().map_or(Ok("".into()), |groups| groups.word(row))?),
                time,
                place,
                velocity: velocity * unit as f32,
                heading: single(&heading, row, 0.0),
                radius: radius.as_ref().map_or(RADIUS, |radius| (radius[row] * unit) as f32),
                status: states.as_ref().map_or(Ok(Status::Walking), |states| {
                    let name = states.word(row)?;
                    status_of(&name).ok_or_else(|| format!("`{name}` is no status"))
                })?,
            });
        }
        Ok(())
    }

    /// Returns an agent number; an unsigned number is stored as a signed one.
    fn agent(&self, number: f64) -> Result<u32, String> {
        let number = if self.unsigned && number < 0.0 { number + 4_294_967_296.0 } else { number };
        let fits = number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number);
        if fits { Ok(number as u32) } else { Err(format!("`{number}` is not an agent number")) }
    }

    fn about(&self, column: usize, why: &str) -> String {
        format!("column `{}`: {why}", self.names[column])
    }
}

/// The values of a column.
enum Cells {
    Numbers(Vec<f64>),
    Words(Vec<ByteArray>),
}

impl Cells {
    fn len(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Words(words) => words.len(),
        }
    }

    fn word(&self, row: usize) -> Result<Cow<'_, str>, String> {
        match self {
            Self::Numbers(numbers) => Ok(numbers[row].to_string().into()),
            Self::Words(words) => words[row].as_utf8().map(Cow::from).map_err(|_| "a name is not text".to_owned()),
        }
    }
}

fn cells(group: &dyn RowGroupReader, column: usize, most: usize) -> Result<Cells, String> {
    Ok(match group.get_column_reader(column).map_err(broken)? {
        ColumnReader::Int32ColumnReader(from) => numbers(from, most, f64::from)?,
        ColumnReader::Int64ColumnReader(from) => numbers(from, most, |value| value as f64)?,
        ColumnReader::FloatColumnReader(from) => numbers(from, most, f64::from)?,
        ColumnReader::DoubleColumnReader(from) => numbers(from, most, |value| value)?,
        ColumnReader::ByteArrayColumnReader(from) => Cells::Words(values(from, most)?),
        _ => return Err("the values are neither numbers nor texts".to_owned()),
    })
}

fn numbers<T: DataType>(from: ColumnReaderImpl<T>, most: usize, number: fn(T::T) -> f64) -> Result<Cells, String> {
    Ok(Cells::Numbers(values(from, most)?.into_iter().map(number).collect()))
}

fn values<T: DataType>(mut from: ColumnReaderImpl<T>, most: usize) -> Result<Vec<T::T>, String> {
    let (mut values, mut missing) = (Vec::new(), Vec::new());
    loop {
        missing.clear();
        let (records, found, _) = from.read_records(BATCH, Some(&mut missing), None, &mut values).map_err(broken)?;
        if records == 0 {
            return Ok(values);
        }
        if found != records {
            return Err("a value is missing".to_owned());
        }
        if values.len() > most {
            return Err(TOO_MANY.to_owned());
        }
    }
}
