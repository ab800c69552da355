//! Trajectories as Arrow arrays, for pandas, polars, pyarrow and DuckDB.

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::types::UInt32Type;
use arrow_array::{
    ArrayRef, DictionaryArray, Float32Array, Float64Array, RecordBatch, RecordBatchIterator, StringArray, UInt32Array,
};
use arrow_schema::ArrowError;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use std::sync::Arc;
use throng::Status;
use throng_record::{Body, Frame, Setting};

/// Returns all bodies of all frames as a stream of one batch.
pub fn stream<'py>(py: Python<'py>, frames: &[Frame], setting: &Setting) -> PyResult<Bound<'py, PyCapsule>> {
    let batch = batch(frames, setting).map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let schema = batch.schema();
    let reader = RecordBatchIterator::new([Ok(batch)], schema);
    PyCapsule::new_with_value(py, FFI_ArrowArrayStream::new(Box::new(reader)), c"arrow_array_stream")
}

fn batch(frames: &[Frame], setting: &Setting) -> Result<RecordBatch, ArrowError> {
    let rows = || frames.iter().flat_map(|frame| frame.bodies.iter().map(move |body| (frame.time, body)));
    let wide = |read: fn(f64, &Body) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(rows().map(|(time, body)| read(time, body))))
    };
    let narrow = |read: fn(&Body) -> f32| -> ArrayRef {
        Arc::new(Float32Array::from_iter_values(rows().map(|(_, body)| read(body))))
    };
    let named = |names: Vec<String>, read: fn(&Body) -> u32| -> Result<ArrayRef, ArrowError> {
        let keys = UInt32Array::from_iter_values(rows().map(|(_, body)| read(body)));
        let words = Arc::new(StringArray::from_iter_values(names));
        Ok(Arc::new(DictionaryArray::<UInt32Type>::try_new(keys, words)?))
    };
    let groups = (0..setting.groups.len() as u32).map(|k| setting.group_name(k).into_owned()).collect();
    let status = [Status::Walking, Status::Waiting, Status::Arrived, Status::Stranded];
    let status = status.map(|status| format!("{status:?}").to_lowercase()).to_vec();
    RecordBatch::try_from_iter([
        ("time", wide(|time, _| time)),
        ("id", Arc::new(UInt32Array::from_iter_values(rows().map(|(_, body)| body.number))) as ArrayRef),
        ("group", named(groups, |body| body.group)?),
        ("x", wide(|_, body| body.position.x)),
        ("y", wide(|_, body| body.position.y)),
        ("z", narrow(|body| body.altitude)),
        ("vx", narrow(|body| body.velocity.x)),
        ("vy", narrow(|body| body.velocity.y)),
        ("vz", narrow(|body| body.vertical_velocity)),
        ("heading", narrow(|body| body.heading)),
        ("radius", narrow(|body| body.radius)),
        ("status", named(status, |body| body.status as u32)?),
    ])
}
