//! Paths in the floor plans of JuPedSim. Their licence keeps them out of the repository: they are read from `shared/data`.

#[path = "../shared/area.rs"]
mod area;
#[path = "../shared/oracle.rs"]
#[allow(dead_code, reason = "other tests use the rest")]
mod oracle;
#[path = "../shared/outside.rs"]
#[allow(dead_code, reason = "these tests need no program")]
mod outside;
mod plans;

use outside::Need;

fn main() {
    let data = [Need::Data("geometry")];
    outside::run(vec![
        outside::test(
            "all_floor_plans_mesh_and_their_paths_keep_clear_of_walls",
            &data,
            plans::all_floor_plans_mesh_and_their_paths_keep_clear_of_walls,
        ),
        outside::test(
            "paths_in_small_floor_plans_are_as_short_as_in_the_visibility_graph",
            &data,
            plans::paths_in_small_floor_plans_are_as_short_as_in_the_visibility_graph,
        ),
    ]);
}
