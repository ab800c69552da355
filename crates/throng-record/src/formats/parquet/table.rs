//! Writes tables as Parquet.

use super::write::system;
use crate::formats::PROGRAM;
use crate::sweep::ResultColumn;
use crate::{Cell, Output, OutputError, Table};
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use std::sync::Arc;

/// The values of a column; unknown ones are null.
enum Values {
    Wholes(Vec<Option<i64>>),
    Numbers(Vec<Option<f64>>),
    Truths(Vec<Option<bool>>),
    Texts(Vec<Option<ByteArray>>),
}

impl Table {
    /// Writes the table as Apache Parquet: columns of doubles, which may be null.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub fn write_parquet(&self, output: Output) -> Result<(), OutputError> {
        let known = |values: &Vec<f64>| {
            Values::Numbers(values.iter().map(|value| Some(*value).filter(|value| value.is_finite())).collect())
        };
        let columns = self.names.iter().map(String::as_str).zip(self.columns.iter().map(known));
        write(output, "figures", &columns.collect::<Vec<_>>())
    }
}

/// Writes the results of a sweep.
///
/// # Errors
/// A system error, such as a full disk.
pub fn write_results(output: Output, columns: &[ResultColumn]) -> Result<(), OutputError> {
    let columns = columns.iter().map(|column| (column.name.as_str(), Values::of(&column.cells)));
    write(output, "runs", &columns.collect::<Vec<_>>())
}

impl Values {
    /// Returns cells as whole numbers, numbers or truths if all of them are, else as texts.
    fn of(cells: &[Option<Cell>]) -> Self {
        let all = |test: fn(&Cell) -> bool| cells.iter().flatten().all(test);
        let each = cells.iter().map(Option::as_ref);
        if all(|cell| matches!(cell, Cell::Whole(_))) {
            Self::Wholes(
                each.map(|cell| if let Some(Cell::Whole(value)) = cell { Some(*value) } else { None }).collect(),
            )
        } else if all(|cell| matches!(cell, Cell::Whole(_) | Cell::Number(_))) {
            Self::Numbers(each.map(|cell| cell.and_then(Cell::number)).collect())
        } else if all(|cell| matches!(cell, Cell::Truth(_))) {
            Self::Truths(each.map(|cell| if let Some(Cell::Truth(value)) = cell { *value } else { None }).collect())
        } else {
            let text = |cell: &Cell| {
                Some(cell).filter(|cell| **cell != Cell::Text(None)).map(|cell| cell.text().as_str().into())
            };
            Self::Texts(each.map(|cell| cell.and_then(text)).collect())
        }
    }

    fn field(&self, name: &str) -> Result<Type, ParquetError> {
        let column = |physical| Type::primitive_type_builder(name, physical).with_repetition(Repetition::OPTIONAL);
        match self {
            Self::Wholes(_) => column(Physical::INT64),
            Self::Numbers(_) => column(Physical::DOUBLE),
            Self::Truths(_) => column(Physical::BOOLEAN),
            Self::Texts(_) => column(Physical::BYTE_ARRAY).with_logical_type(Some(LogicalType::String)),
        }
        .build()
    }

    fn write(&self, to: &mut SerializedRowGroupWriter<'_, Output>) -> Result<(), ParquetError> {
        match self {
            Self::Wholes(values) => column::<Int64Type>(to, values),
            Self::Numbers(values) => column::<DoubleType>(to, values),
            Self::Truths(values) => column::<BoolType>(to, values),
            Self::Texts(values) => column::<ByteArrayType>(to, values),
        }
    }
}

/// Writes the next column.
fn column<T: DataType>(
    to: &mut SerializedRowGroupWriter<'_, Output>,
    values: &[Option<T::T>],
) -> Result<(), ParquetError> {
    let known: Vec<T::T> = values.iter().flatten().cloned().collect();
    let levels: Vec<i16> = values.iter().map(|value| value.is_some().into()).collect();
    let mut column = to.next_column()?.expect("the schema has as many columns");
    column.typed::<T>().write_batch(&known, Some(&levels), None)?;
    column.close()
}

fn write(output: Output, name: &str, columns: &[(&str, Values)]) -> Result<(), OutputError> {
    let path = output.path().to_path_buf();
    let written = written(output, name, columns).map_err(|error| OutputError::new(&path, system(error)))?;
    written.finish()
}

fn written(output: Output, name: &str, columns: &[(&str, Values)]) -> Result<Output, ParquetError> {
    let field = |(name, values): &(&str, Values)| Ok(Arc::new(values.field(name)?));
    let fields = columns.iter().map(field).collect::<Result<_, ParquetError>>()?;
    let schema = Type::group_type_builder(name).with_fields(fields).build()?;
    let properties = WriterProperties::builder()
        .set_created_by(PROGRAM.to_owned())
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(1)?));
    let mut file = SerializedFileWriter::new(output, Arc::new(schema), Arc::new(properties.build()))?;
    let mut group = file.next_row_group()?;
    columns.iter().try_for_each(|(_, values)| values.write(&mut group))?;
    group.close()?;
    file.into_inner()
}
