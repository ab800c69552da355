//! Writes tables of figures as Parquet.

use super::write::system;
use crate::formats::PROGRAM;
use crate::{Output, OutputError, Table};
use parquet::basic::{Compression, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use std::sync::Arc;

impl Table {
    /// Writes the table as Apache Parquet: columns of doubles, which may be null.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub fn write_parquet(&self, output: Output) -> Result<(), OutputError> {
        let path = output.path().to_path_buf();
        let written = self.parquet(output).map_err(|error| OutputError::new(&path, system(error)))?;
        written.finish()
    }

    fn parquet(&self, output: Output) -> Result<Output, ParquetError> {
        let field = |name: &String| {
            let column = Type::primitive_type_builder(name, Physical::DOUBLE).with_repetition(Repetition::OPTIONAL);
            Ok(Arc::new(column.build()?))
        };
        let fields = self.names.iter().map(field).collect::<Result<_, ParquetError>>()?;
        let schema = Type::group_type_builder("figures").with_fields(fields).build()?;
        let properties = WriterProperties::builder()
            .set_created_by(PROGRAM.to_owned())
            .set_compression(Compression::ZSTD(ZstdLevel::try_new(1)?));
        let mut file = SerializedFileWriter::new(output, Arc::new(schema), Arc::new(properties.build()))?;
        let mut group = file.next_row_group()?;
        for values in &self.columns {
            let known: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
            let levels: Vec<i16> = values.iter().map(|value| value.is_finite().into()).collect();
            let mut column = group.next_column()?.expect("the schema has as many columns");
            column.typed::<DoubleType>().write_batch(&known, Some(&levels), None)?;
            column.close()?;
        }
        group.close()?;
        file.into_inner()
    }
}
