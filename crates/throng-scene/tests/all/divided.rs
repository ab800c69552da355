//! Scenes of the gallery in several worlds have the bits of one world, or are refused with the reason.

use crate::draw::Draw;
use crate::random_cuts::random_cuts;
use crate::threads::{Threads, halos};
use glam::Vec2;
use std::thread;
use throng::halo::{Cuts, DividedWorld};
use throng::{Error, World};
use throng_scene::gallery;

/// Returns the hashes of the states after each step.
fn hashes(mut world: World, steps: u64) -> Vec<u64> {
    let step = |_| {
        world.step();
        world.state_hash()
    };
    (0..steps).map(step).collect()
}

/// Returns the hashes of the states after each step of a division, with other cuts every ten steps.
fn hashes_of_division(world: &World, cuts: impl Fn(u64) -> Cuts + Sync, steps: u64) -> Result<Vec<u64>, Error> {
    let run = |halo: Threads| {
        let mut part = DividedWorld::new(world.clone(), halo)?;
        let step = |step: u64| {
            part.halo_mut().set(cuts(step / 10));
            part.step();
            part.state_hash()
        };
        Ok::<_, Error>((0..steps).map(step).collect::<Vec<u64>>())
    };
    let parts: Vec<_> = thread::scope(|scope| {
        let handles: Vec<_> = halos(cuts(0)).into_iter().map(|halo| scope.spawn(|| run(halo))).collect();
        handles.into_iter().map(|handle| handle.join().unwrap()).collect()
    });
    let parts: Vec<_> = parts.into_iter().collect::<Result<_, _>>()?;
    assert!(parts.windows(2).all(|pair| pair[0] == pair[1]), "the worlds agree on the hash");
    Ok(parts.into_iter().next().unwrap())
}

#[test]
fn all_scenes_of_the_gallery_have_the_bits_of_one_world() {
    let (steps, mut divided) = (60, 0);
    for (index, name) in gallery::names().enumerate() {
        let (world, _) = gallery::scene(name).unwrap().build().unwrap();
        let worlds = [1, 2, 3, 4, 9][index % 5];
        let places = &world.relative_columns().position;
        let corner = |pick: fn(Vec2, Vec2) -> Vec2| places.iter().copied().reduce(pick).unwrap_or(Vec2::ZERO);
        let (low, high) = (corner(Vec2::min), corner(Vec2::max));
        let cuts = |turn: u64| random_cuts(&mut Draw::new(31 * index as u64 + turn), worlds, low, high);
        match hashes_of_division(&world, cuts, steps) {
            Ok(hashes_of_division) => {
                assert_eq!(hashes_of_division, hashes(world, steps), "{name} in {worlds} worlds");
                divided += 1;
            }
            Err(Error::Undivided { what }) => assert!(what.len() > 20, "{name}: {what}"),
            Err(error) => panic!("{name}: {error}"),
        }
    }
    assert!(divided > 30, "{divided} scenes");
}
