//! Fields that scenes load from files: pictures and tables.

use super::{scenes, scratch};
use std::path::Path;
use throng_scene::Scene;

const CROWD: &str = "
    [[group]]
    count = 2
    place.points = [[1, 1], [2, 1]]
    goal.point = [5, 0]
    field.of.named = \"it\"";

/// Reads a PNG as a flow map, as directions, and as a weight map, at a metre per pixel.
pub(super) fn picture(bytes: &[u8]) -> Result<(), String> {
    let side = |at: usize| bytes.get(at..at + 4).and_then(|word| word.try_into().ok()).map_or(3, u32::from_be_bytes);
    let size = format!("min = [0, 0], max = [{}, {}]", side(16), side(20));
    scratch::file("input.png", bytes, |path| {
        let flow =
            |encoding: &str| format!("flow.picture = {{ file = \"input.png\", {size}, encoding = \"{encoding}\" }}");
        let map = format!("flow.sum = [{{ of.uniform = [1, 0], map = {{ file = \"input.png\", {size} }} }}]");
        let all = [flow("flow_map"), flow("direction"), map].map(|flow| with_field(path, &flow));
        all.into_iter().reduce(Result::or).expect("three fields")
    })
}

/// Reads a vector field from a file of this name.
pub(super) fn table(name: &str, bytes: &[u8]) -> Result<(), String> {
    scratch::file(name, bytes, |path| with_field(path, &format!("flow.table = {{ file = \"{name}\" }}")))
}

/// Uses a scene with a field from a file beside it.
fn with_field(file: &Path, field: &str) -> Result<(), String> {
    let scene = file.with_file_name("field.toml");
    std::fs::write(&scene, format!("[[field]]\nname = \"it\"\n{field}\n{CROWD}\n"))
        .expect("a file in the temporary folder");
    scenes::check(&Scene::load(&scene).unwrap_or_else(|error| panic!("{error}")))
}
