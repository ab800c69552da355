//! The JSON schema of scene files matches the types.

use std::path::Path;
use throng_scene::Scene;

/// `UPDATE=1 cargo test -p throng-scene schema` writes the file again.
#[test]
fn the_schema_is_that_of_the_types() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scene.schema.json");
    let now = format!("{:#}\n", schemars::schema_for!(Scene).to_value());
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, &now).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap();
    assert!(kept == now, "{} is not current: UPDATE=1 cargo test -p throng-scene schema", path.display());
}

#[test]
fn it_is_there_unpacked() {
    assert_eq!(throng_scene::schema(), schemars::schema_for!(Scene).to_value());
}
