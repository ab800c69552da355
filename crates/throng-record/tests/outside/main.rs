//! Tests with recorded pedestrians. The licences of the recordings keep them out of the repository: they are read from
//! `shared/data`.

#[path = "../../../throng/tests/shared/outside.rs"]
#[allow(dead_code, reason = "these tests need no program")]
mod outside;
mod pedestrian;
mod people;
mod replay;
#[path = "../all/shared.rs"]
#[allow(dead_code, reason = "other tests use the rest")]
mod shared;

use outside::Need;
use std::path::PathBuf;

/// Returns the path of a trajectory file or folder.
fn trajectories(name: &str) -> PathBuf {
    outside::data(&format!("trajectories/{name}"))
}

macro_rules! tests {
    ($($module:ident::$test:ident,)*) => {
        vec![$(outside::test(
            concat!(stringify!($module), "::", stringify!($test)),
            &[Need::Data("trajectories")],
            $module::$test,
        )),*]
    };
}

fn main() {
    outside::run(tests![
        pedestrian::a_bottleneck_is_as_pedpy_measures_it,
        pedestrian::a_ground_with_walls_is_as_pedpy_measures_it,
        pedestrian::the_fundamental_diagram_matches_published_data,
        pedestrian::the_flow_of_a_bottleneck_matches_published_data,
        pedestrian::flow_and_lane_order_match_published_data,
        people::recorded_pedestrians_are_read,
        people::units_are_stated_or_found_by_speeds,
        people::hdf5_holds_the_walkable_area,
        people::a_broken_file_of_hdf5_is_an_error,
        replay::recorded_pedestrians_are_replayed,
    ]);
}
