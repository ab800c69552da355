//! Places: floor plans, meshes, and the maps and groups of data sets.

use super::{scenes, scratch};
use throng_scene::import::obj::{self, ObjUp};
use throng_scene::import::plan::{self, PlanOptions};

/// Reads a floor plan of this name: its walkable area, and its scene.
pub(super) fn plan(name: &str, bytes: &[u8]) -> Result<(), String> {
    scratch::file(name, bytes, |path| {
        let ground = plan::ground(path, &PlanOptions::default());
        if let Ok(ground) = &ground {
            let corners = ground.areas.iter().flat_map(|area| area.holes.iter().flatten().chain(&area.outer));
            assert!(corners.into_iter().all(|corner| corner.is_finite()), "a corner of the ground is not finite");
        }
        // with the plan's exit, or with a given one
        let exit = PlanOptions { exit: Some([17.0, 2.0, 2.0, 4.0]), people: Some(20), ..PlanOptions::default() };
        let scene = plan::load(path, &PlanOptions::default()).or_else(|_| plan::load(path, &exit));
        match scene {
            Ok(imported) => scenes::check(&imported.scene),
            Err(error) => ground.map(drop).map_err(|_| error.to_string()),
        }
    })
}

/// Reads a mesh: as a floor plan, with each axis up, and as a surface of a scene.
pub(super) fn obj(bytes: &[u8]) -> Result<(), String> {
    let walked = plan("input.obj", bytes);
    let surface = scratch::file("input.obj", bytes, |path| {
        obj::load(path, ObjUp::Y).map_err(|error| error.to_string())?;
        let text = "
            [[surface]]
            name = \"walls\"
            shape.mesh = { file = \"input.obj\", up = \"z\" }
            seen_from = \"both\"
            [[group]]
            count = 3
            place.points = [[0, 0], [2, 1], [4, 4]]
            vehicle = { max_speed = 1.5, max_force = 5.0 }
            steer.contain = { surface = \"walls\" }";
        let scene = path.with_file_name("mesh.toml");
        std::fs::write(&scene, text).expect("a file in the temporary folder");
        scenes::check(&throng_scene::Scene::load(scene).expect("a scene"))
    });
    walked.or(surface)
}

/// Reads a `map.xml`.
pub(super) fn map(bytes: &[u8]) -> Result<(), String> {
    throng_record::map(bytes).map(drop).map_err(|flaw| flaw.to_string())
}

/// Reads a `groups.txt`.
pub(super) fn groups(bytes: &[u8]) -> Result<(), String> {
    throng_record::pedestrian::groups(bytes).map(drop).map_err(|flaw| flaw.to_string())
}
