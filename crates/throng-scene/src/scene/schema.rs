//! The JSON schema of scene files, for editors.

use super::Scene;

/// The JSON schema (draft 2020-12) of scene files. Editors that know it complete and check keys while one types.
pub fn schema() -> serde_json::Value {
    let schema = schemars::SchemaGenerator::default().into_root_schema_for::<Scene>();
    schema.to_value()
}
