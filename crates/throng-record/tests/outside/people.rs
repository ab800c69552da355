//! Tests that the recorded trajectories of pedestrians are read correctly.

use super::shared::draws;
use super::trajectories;
use std::collections::BTreeSet;
use throng_record::{Reading, Trajectories, TrajectoriesError};

const FROM_FILE: Reading = Reading { rate: None, unit: None };
const AT_25: Reading = Reading { rate: Some(25.0), unit: None };

/// The properties of a file, as in [`FILES`].
type Known = (&'static str, Reading, usize, usize, f64, [f64; 2]);

/// A file, its reading, its numbers of pedestrians and of rows, its frame rate, and limits of the median speed, m/s: a
/// wrong unit or rate would exceed them by far.
const FILES: [Known; 9] = [
    ("juelich/040_c_56_h-.txt", FROM_FILE, 75, 63110, 25.0, [0.1, 0.6]),
    ("juelich/AO_300_bottleneck.txt", FROM_FILE, 348, 128_783, 16.0, [0.2, 0.9]),
    ("juelich/bi_corr_400_b_03.txt", FROM_FILE, 480, 120_790, 25.0, [0.7, 1.3]),
    ("juelich/traj_UNI_CORR_500_01.txt", FROM_FILE, 148, 25536, 25.0, [1.0, 1.8]),
    ("juelich/corner_traj.txt", FROM_FILE, 137, 18704, 16.0, [0.7, 1.6]),
    // 34 walk in the oval; the camera sees a part of it, and a pedestrian that reappears gets a new number
    ("juelich/n34_cam2.csv", AT_25, 71, 1101, 2.5, [0.1, 0.5]),
    ("juelich/00_01a.h5", FROM_FILE, 46, 30701, 25.0, [0.1, 0.6]),
    ("ucy/zara01/obsmat.txt", FROM_FILE, 148, 5024, 2.5, [1.0, 1.3]),
    ("ucy/students03/obsmat.txt", FROM_FILE, 428, 21846, 2.5, [0.6, 1.1]),
];

pub fn recorded_pedestrians_are_read() {
    for (name, reading, people, lines, rate, [slow, fast]) in FILES {
        let path = trajectories(name);
        let tracks = Trajectories::read_as(&path, &reading).unwrap();
        let numbers: BTreeSet<u32> = tracks.spots.iter().map(|spot| spot.number).collect();
        assert_eq!((numbers.len(), tracks.spots.len()), (people, lines), "{name}");
        let mut own = tracks.spots.clone();
        own.sort_by_key(|spot| spot.number);
        let pairs = || own.windows(2).filter(|pair| pair[0].number == pair[1].number);
        let mut steps: Vec<f64> = pairs().map(|pair| pair[1].time - pair[0].time).collect();
        let mut speeds: Vec<f32> = own.iter().map(|spot| spot.velocity.length()).collect();
        steps.sort_by(f64::total_cmp);
        speeds.sort_by(f32::total_cmp);
        let (step, speed) = (steps[steps.len() / 2], f64::from(speeds[speeds.len() / 2]));
        assert!((step * rate - 1.0).abs() < 1e-6, "{name}: {step} s");
        assert!((slow..fast).contains(&speed), "{name}: {speed} m/s");
        assert!(tracks.spots.iter().all(|spot| spot.place.z == 0.0), "{name}: they walk on the ground");
    }
}

pub fn units_are_stated_or_found_by_speeds() {
    for (name, unit) in [("040_c_56_h-.txt", 1.0), ("AO_300_bottleneck.txt", 1.0), ("bi_corr_400_b_03.txt", 0.01)] {
        let path = trajectories(&format!("juelich/{name}"));
        assert_eq!(Trajectories::read(&path).unwrap().unit, Some(unit), "{name}");
        let bytes = std::fs::read(&path).unwrap();
        let said: Vec<&[u8]> = bytes.split(|&byte| byte == b'\n').filter(|line| !line.starts_with(b"#")).collect();
        let silent =
            Trajectories::of_file(&path, &said.join(&b'\n'), &Reading { rate: Some(25.0), unit: None }).unwrap();
        assert_eq!(silent.unit, Some(unit), "{name} without its comments");
    }
}

pub fn hdf5_holds_the_walkable_area() {
    let path = trajectories("juelich/00_01a.h5");
    let walkable = Trajectories::read(path).unwrap().setting.walkable;
    assert_eq!((walkable.len(), walkable[0].outer.len(), walkable[0].holes.len()), (1, 4, 2));
}

pub fn a_broken_file_of_hdf5_is_an_error() {
    let path = trajectories("juelich/00_01a.h5");
    let bytes = std::fs::read(path).unwrap();
    let mut draw = draws();
    for k in 0..300 {
        let mut broken = bytes.clone();
        if k % 3 == 0 {
            broken.truncate(k * bytes.len() / 300);
        }
        // in the first bytes, which hold the structure, or anywhere
        for _ in 0..k % 7 {
            let reach = if draw().is_multiple_of(2) { 8192 } else { bytes.len() };
            let at = draw() % reach.min(broken.len().max(1));
            if let Some(byte) = broken.get_mut(at) {
                *byte = draw() as u8;
            }
        }
        if let Err(error) = Trajectories::of_file("a.h5", &broken, &FROM_FILE) {
            assert!(matches!(error, TrajectoriesError::Content { .. }) && error.to_string().starts_with("a.h5"));
        }
    }
}
