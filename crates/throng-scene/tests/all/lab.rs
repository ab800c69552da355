//! The lab in Rust (labs/rust): with the solution, its own test passes, and its scene runs as with ORCA.

#[path = "../../../../labs/solutions/half_plane.rs"]
mod half_plane;
#[path = "../../../../labs/rust/src/orca.rs"]
mod orca;
/// What students start from compiles.
#[path = "../../../../labs/rust/src/half_plane.rs"]
#[allow(dead_code, clippy::todo)]
mod unwritten;

use throng_scene::{Plugins, Scene};

const RING: &str = include_str!("../../../../labs/rust/src/ring.toml");

#[test]
fn the_ring_of_the_lab_arrives() {
    let mut scene = Scene::parse("ring.toml", RING).unwrap();
    Plugins::new().model::<orca::MyOrca>().equip(&mut scene);
    let (mut world, _) = scene.build().unwrap();
    while !scene.time.over(&world) {
        world.step();
    }
    let summary = world.summary();
    assert_eq!((summary.arrived, summary.overlaps), (summary.agents, 0));
}
