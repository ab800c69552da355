//! Memory during the construction of a mesh.
//!
//! This binary is separate: it counts the memory of the whole process.
#![allow(clippy::print_stdout)]

use glam::DVec2;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use throng::navigate::NavMesh;
use throng::{Obstacle, Walkable};

#[global_allocator]
static MEMORY: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Bytes that are allocated while a mesh is built round this number of overlapping discs.
fn bytes(discs: u32) -> usize {
    let corners = [(-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0)];
    let room = Walkable { outer: corners.map(DVec2::from).to_vec(), holes: vec![] };
    let disc = |index| DVec2::from_angle(f64::from(index) * 2.4) * f64::from(index).sqrt() * 0.03;
    let discs: Vec<_> = (0..discs).map(|index| Obstacle::Circle { center: disc(index), radius: 2.0 }).collect();
    let region = Region::new(MEMORY);
    NavMesh::build(&[room], &discs, 0.2, (DVec2::ZERO, DVec2::ZERO)).unwrap();
    region.change().bytes_allocated
}

#[test]
fn obstacles_that_all_overlap_take_memory_by_their_number_and_not_by_its_square() {
    let [few, many] = [500, 2000].map(bytes);
    println!("500 discs take {few} bytes, 2000 take {many}");
    assert!(many < 6 * few, "{few} bytes for 500 discs, {many} for 2000");
}
