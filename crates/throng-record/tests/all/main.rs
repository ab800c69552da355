//! Tests of the library as its users call it.

mod fields;
mod frame_rates;
#[cfg(all(feature = "parquet", feature = "sqlite", feature = "usda", feature = "glb", feature = "hdf5"))]
mod kept;
mod microscopic;
mod pauses;
mod pedestrian;
mod people;
mod replay;
mod shared;
#[cfg(feature = "parquet")]
mod sweep;
mod validate;
