//! Writes Parquet.

use crate::csv::status_name;
use crate::formats::{Column, PROGRAM, Writer, describe, keys, rate::Rate};
use crate::{Body, Frame, Output, OutputError, Setting};
use parquet::basic::{Compression, Encoding, ZstdLevel};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, FloatType, Int32Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::parser::parse_message_type;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use throng::Status;

/// Rows of a row group; they are held in memory and written together.
const ROWS: usize = 1 << 17;

/// Columns with values that rarely repeat. They are encoded by byte-stream split, which compresses best.
const SPLIT: [&str; 6] = ["x", "y", "z", "vx", "vy", "heading"];

/// Writes trajectories during a run, a row group at a time. The [module](super) describes the columns.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run.parquet");
/// use throng_record::formats::parquet::ParquetWriter;
/// use throng_record::{Frame, Output, Setting, Writer};
/// let mut writer = ParquetWriter::new(Output::create(&path)?, &Setting::default(), &[])?;
/// writer.push(&Frame::default())?;
/// Box::new(writer).finish()?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct ParquetWriter {
    file: SerializedFileWriter<Output>,
    path: PathBuf,
    setting: Setting,
    /// The names of the groups.
    groups: Vec<ByteArray>,
    /// The names of [`STATES`].
    states: [ByteArray; 4],
    rows: Vec<Rows>,
    /// Number of rows that wait.
    waiting: usize,
    rate: Rate,
}

const STATES: [Status; 4] = [Status::Walking, Status::Waiting, Status::Arrived, Status::Stranded];

/// Rows of a column that are not written yet.
enum Rows {
    Number(Vec<i32>),
    Group(Vec<ByteArray>),
    Time(Vec<f64>),
    X(Vec<f64>),
    Y(Vec<f64>),
    Single(fn(&Body) -> f32, Vec<f32>),
    Status(Vec<ByteArray>),
}

impl ParquetWriter {
    /// Starts a file with these columns; without columns, those of the [module](super).
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub fn new(output: Output, setting: &Setting, columns: &[Column]) -> Result<Self, OutputError> {
        let path = output.path().to_path_buf();
        let columns = if columns.is_empty() { &Column::ALL } else { columns };
        let fields: String = columns.iter().map(|&column| format!("required {}; ", typed(column))).collect();
        let schema = parse_message_type(&format!("message trajectories {{ {fields} }}")).expect("the schema is one");
        let mut properties = WriterProperties::builder()
            .set_created_by(PROGRAM.to_owned())
            .set_compression(Compression::ZSTD(ZstdLevel::try_new(1).expect("1 is a level")))
            .set_column_dictionary_enabled("number".into(), false)
            .set_column_encoding("number".into(), Encoding::DELTA_BINARY_PACKED);
        for column in SPLIT {
            properties = properties
                .set_column_dictionary_enabled(column.into(), false)
                .set_column_encoding(column.into(), Encoding::BYTE_STREAM_SPLIT);
        }
        let file = SerializedFileWriter::new(output, Arc::new(schema), Arc::new(properties.build()));
        let file = file.map_err(|error| OutputError::new(&path, system(error)))?;
        let groups = (0..setting.groups.len() as u32).map(|k| ByteArray::from(&*setting.group_name(k)));
        let groups = groups.collect();
        let states = STATES.map(|status| status_name(status).into());
        let rows = columns.iter().map(|&column| Rows::of(column)).collect();
        Ok(Self { file, path, setting: setting.clone(), groups, states, rows, waiting: 0, rate: Rate::default() })
    }

    /// Adds bodies of a frame to the waiting rows. They must fit into the row group.
    fn add(&mut self, bodies: &[Body], time: f64) {
        let Self { groups, states, setting, .. } = self;
        let group = |body: &Body| {
            let known = groups.get(body.group as usize).cloned();
            known.unwrap_or_else(|| (&*setting.group_name(body.group)).into())
        };
        let status = |body: &Body| states[STATES.iter().position(|&status| status == body.status).unwrap_or(0)].clone();
        for rows in &mut self.rows {
            match rows {
                // Parquet stores unsigned numbers as signed ones
                Rows::Number(rows) => rows.extend(bodies.iter().map(|body| body.number.cast_signed())),
                Rows::Group(rows) => rows.extend(bodies.iter().map(group)),
                Rows::Time(rows) => rows.resize(rows.len() + bodies.len(), time),
                Rows::X(rows) => rows.extend(bodies.iter().map(|body| body.position.x)),
                Rows::Y(rows) => rows.extend(bodies.iter().map(|body| body.position.y)),
                Rows::Single(value, rows) => rows.extend(bodies.iter().map(&*value)),
                Rows::Status(rows) => rows.extend(bodies.iter().map(status)),
            }
        }
        self.waiting += bodies.len();
    }

    /// Writes the waiting rows.
    fn flush(&mut self) -> Result<(), OutputError> {
        self.waiting = 0;
        write(&mut self.file, &mut self.rows).map_err(|error| OutputError::new(&self.path, system(error)))
    }

    /// Adds the metadata, which depend on all frames.
    fn describe(&mut self) {
        let rate = self.rate.even().map(|rate| (keys::RATE, rate.to_string()));
        let pairs = describe::pairs(&self.setting).into_iter().chain(rate);
        for (key, value) in pairs {
            self.file.append_key_value_metadata(KeyValue::new(key.to_owned(), value));
        }
    }
}

impl Writer for ParquetWriter {
    fn push(&mut self, frame: &Frame) -> Result<(), OutputError> {
        self.rate.push(frame.time);
        let mut bodies = frame.bodies.as_slice();
        while !bodies.is_empty() {
            let (now, rest) = bodies.split_at(bodies.len().min(ROWS - self.waiting));
            self.add(now, frame.time);
            if self.waiting == ROWS {
                self.flush()?;
            }
            bodies = rest;
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> Result<(), OutputError> {
        if self.waiting > 0 {
            self.flush()?;
        }
        self.describe();
        let Self { file, path, .. } = *self;
        file.into_inner().map_err(|error| OutputError::new(&path, system(error)))?.finish()
    }
}

/// Returns a column and its type as a field of the schema.
fn typed(column: Column) -> String {
    match column {
        Column::Number => format!("int32 {column} (integer(32, false))"),
        Column::Group | Column::Status => format!("binary {column} (string)"),
        Column::Time | Column::X | Column::Y => format!("double {column}"),
        _ => format!("float {column}"),
    }
}

impl Rows {
    /// Returns no rows of a column.
    fn of(column: Column) -> Self {
        match column {
            Column::Number => Self::Number(Vec::new()),
            Column::Group => Self::Group(Vec::new()),
            Column::Time => Self::Time(Vec::new()),
            Column::X => Self::X(Vec::new()),
            Column::Y => Self::Y(Vec::new()),
            Column::Status => Self::Status(Vec::new()),
            _ => Self::Single(column.single().expect("the others are single"), Vec::new()),
        }
    }
}

/// Writes a row group and clears the rows; their memory is kept.
fn write(file: &mut SerializedFileWriter<Output>, rows: &mut [Rows]) -> Result<(), ParquetError> {
    let mut group = file.next_row_group()?;
    let to = &mut group;
    for rows in rows {
        match rows {
            Rows::Number(rows) => column::<Int32Type>(to, rows)?,
            Rows::Group(rows) | Rows::Status(rows) => column::<ByteArrayType>(to, rows)?,
            Rows::Time(rows) | Rows::X(rows) | Rows::Y(rows) => column::<DoubleType>(to, rows)?,
            Rows::Single(_, rows) => column::<FloatType>(to, rows)?,
        }
    }
    group.close()?;
    Ok(())
}

/// Writes the next column.
fn column<T: DataType>(
    to: &mut SerializedRowGroupWriter<'_, Output>,
    rows: &mut Vec<T::T>,
) -> Result<(), ParquetError> {
    let mut column = to.next_column()?.expect("the schema has as many columns");
    column.typed::<T>().write_batch(rows, None, None)?;
    rows.clear();
    column.close()
}

/// Returns the system error within an error of Parquet.
pub(super) fn system(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(error) => match error.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(error) => io::Error::other(error),
        },
        error => io::Error::other(error),
    }
}
