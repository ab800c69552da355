//! Parquet written.

use crate::csv::status_name;
use crate::formats::{PROGRAM, Writer, describe, keys, names, rate::Rate};
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

/// Rows that are held in memory, and written together.
const ROWS: usize = 1 << 17;

const SCHEMA: &str = "message trajectories {
    required int32 number (integer(32, false));
    required binary group (string);
    required double time;
    required double x;
    required double y;
    required float z;
    required float vx;
    required float vy;
    required float vz;
    required float heading;
    required float radius;
    required binary status (string);
}";

/// Columns whose values hardly repeat: their bytes are laid side by side, which is what compresses best.
const SPLIT: [&str; 6] = ["x", "y", "z", "vx", "vy", "heading"];

/// Writes trajectories as they happen, a group of rows at a time. See the [module](super) for the columns.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run.parquet");
/// use throng_record::formats::parquet::ParquetWriter;
/// use throng_record::{Frame, Output, Setting, Writer};
/// let mut writer = ParquetWriter::new(Output::create(&path)?, &Setting::default())?;
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
    rows: Rows,
    rate: Rate,
}

const STATES: [Status; 4] = [Status::Walking, Status::Waiting, Status::Arrived, Status::Stranded];

/// Rows that are not yet written, by columns.
#[derive(Default)]
struct Rows {
    number: Vec<i32>,
    group: Vec<ByteArray>,
    time: Vec<f64>,
    /// `x` and `y`.
    position: [Vec<f64>; 2],
    /// From `z` to `radius`.
    singles: [Vec<f32>; 6],
    status: Vec<ByteArray>,
}

impl ParquetWriter {
    /// Begins a file.
    ///
    /// # Errors
    /// The system's, such as a full disk.
    pub fn new(output: Output, setting: &Setting) -> Result<Self, OutputError> {
        let path = output.path().to_path_buf();
        let schema = parse_message_type(SCHEMA).expect("the schema is one");
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
        let groups = (0..setting.groups.len() as u32).map(|k| ByteArray::from(&*names::name(setting, k)));
        let groups = groups.collect();
        let states = STATES.map(|status| status_name(status).into());
        let (rows, rate) = (Rows::default(), Rate::default());
        Ok(Self { file, path, setting: setting.clone(), groups, states, rows, rate })
    }

    fn add(&mut self, body: &Body, time: f64) -> Result<(), OutputError> {
        let rows = &mut self.rows;
        // the bits of a number without sign
        rows.number.push(body.number.cast_signed());
        let group = self.groups.get(body.group as usize).cloned();
        rows.group.push(group.unwrap_or_else(|| (&*names::name(&self.setting, body.group)).into()));
        rows.time.push(time);
        rows.position.iter_mut().zip(body.position.to_array()).for_each(|(column, value)| column.push(value));
        let [vx, vy] = body.velocity.to_array();
        let singles = [body.altitude, vx, vy, body.climb, body.heading, body.shape().girth()];
        rows.singles.iter_mut().zip(singles).for_each(|(column, value)| column.push(value));
        let status = STATES.iter().position(|&status| status == body.status).unwrap_or(0);
        rows.status.push(self.states[status].clone());
        if rows.number.len() == ROWS { self.flush() } else { Ok(()) }
    }

    /// Writes the rows that wait.
    fn flush(&mut self) -> Result<(), OutputError> {
        let Self { file, rows, .. } = self;
        rows.write(file).map_err(|error| OutputError::new(&self.path, system(error)))?;
        rows.clear();
        Ok(())
    }

    /// What is known of the file when everybody is in it.
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
        frame.bodies.iter().try_for_each(|body| self.add(body, frame.time))
    }

    fn finish(mut self: Box<Self>) -> Result<(), OutputError> {
        if !self.rows.number.is_empty() {
            self.flush()?;
        }
        self.describe();
        let Self { file, path, .. } = *self;
        file.into_inner().map_err(|error| OutputError::new(&path, system(error)))?.finish()
    }
}

impl Rows {
    fn write(&self, file: &mut SerializedFileWriter<Output>) -> Result<(), ParquetError> {
        let mut group = file.next_row_group()?;
        let to = &mut group;
        write::<Int32Type>(to, &self.number)?;
        write::<ByteArrayType>(to, &self.group)?;
        write::<DoubleType>(to, &self.time)?;
        self.position.iter().try_for_each(|column| write::<DoubleType>(to, column))?;
        self.singles.iter().try_for_each(|column| write::<FloatType>(to, column))?;
        write::<ByteArrayType>(to, &self.status)?;
        group.close()?;
        Ok(())
    }

    /// Keeps the memory.
    fn clear(&mut self) {
        let Self { number, group, time, position, singles, status } = self;
        number.clear();
        [group, status].into_iter().for_each(Vec::clear);
        position.iter_mut().chain([time]).for_each(Vec::clear);
        singles.iter_mut().for_each(Vec::clear);
    }
}

/// Writes the next column.
fn write<T: DataType>(to: &mut SerializedRowGroupWriter<'_, Output>, values: &[T::T]) -> Result<(), ParquetError> {
    let mut column = to.next_column()?.expect("the schema has as many columns");
    column.typed::<T>().write_batch(values, None, None)?;
    column.close()
}

/// What the system said.
fn system(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(error) => match error.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(error) => io::Error::other(error),
        },
        error => io::Error::other(error),
    }
}
