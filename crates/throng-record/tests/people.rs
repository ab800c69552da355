//! The recorded trajectories of real people that lie in shared/data are read as what they are. Skipped where they are not there.

mod shared;

use shared::data;
use std::collections::BTreeSet;
use throng_record::{Reading, Tracks, TracksError};

const FROM_FILE: Reading = Reading { rate: None, unit: None };
const AT_25: Reading = Reading { rate: Some(25.0), unit: None };

/// What is known of a file, as in [`FILES`].
type Known = (&'static str, Reading, usize, usize, f64, [f64; 2]);

/// A file, what people must say of it, how many are in it, how many lines it has, how many of its frames are a second, and between
/// which the median of all speeds must be, m/s: a wrong unit or rate is far from it.
const FILES: [Known; 9] = [
    ("juelich/040_c_56_h-.txt", FROM_FILE, 75, 63110, 25.0, [0.1, 0.6]),
    ("juelich/AO_300_bottleneck.txt", FROM_FILE, 348, 128_783, 16.0, [0.2, 0.9]),
    ("juelich/bi_corr_400_b_03.txt", FROM_FILE, 480, 120_790, 25.0, [0.7, 1.3]),
    ("juelich/traj_UNI_CORR_500_01.txt", FROM_FILE, 148, 25536, 25.0, [1.0, 1.8]),
    ("juelich/corner_traj.txt", FROM_FILE, 137, 18704, 16.0, [0.7, 1.6]),
    // 34 walk in the oval; the camera sees a part of it, and counts who comes again anew
    ("juelich/n34_cam2.csv", AT_25, 71, 1101, 2.5, [0.1, 0.5]),
    ("juelich/00_01a.h5", FROM_FILE, 46, 30701, 25.0, [0.1, 0.6]),
    ("ucy/zara01/obsmat.txt", FROM_FILE, 148, 5024, 2.5, [1.0, 1.3]),
    ("ucy/students03/obsmat.txt", FROM_FILE, 428, 21846, 2.5, [0.6, 1.1]),
];

#[test]
fn recorded_people_are_read() {
    for (name, reading, people, lines, rate, [slow, fast]) in FILES {
        let Some(path) = data(name) else { continue };
        let tracks = Tracks::read_as(&path, &reading).unwrap();
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

#[test]
fn units_are_as_the_files_say_or_as_people_walk() {
    for (name, unit) in [("040_c_56_h-.txt", 1.0), ("AO_300_bottleneck.txt", 1.0), ("bi_corr_400_b_03.txt", 0.01)] {
        let Some(path) = data(&format!("juelich/{name}")) else { continue };
        assert_eq!(Tracks::read(&path).unwrap().unit, Some(unit), "{name}");
        let bytes = std::fs::read(&path).unwrap();
        let said: Vec<&[u8]> = bytes.split(|&byte| byte == b'\n').filter(|line| !line.starts_with(b"#")).collect();
        let silent = Tracks::of_file(&path, &said.join(&b'\n'), &Reading { rate: Some(25.0), unit: None }).unwrap();
        assert_eq!(silent.unit, Some(unit), "{name} without its comments");
    }
}

#[test]
fn hdf5_says_the_walkable_area() {
    let Some(path) = data("juelich/00_01a.h5") else { return };
    let walkable = Tracks::read(path).unwrap().setting.walkable;
    assert_eq!((walkable.len(), walkable[0].outer.len(), walkable[0].holes.len()), (1, 4, 2));
}

/// A generator of numbers that look random.
fn draws() -> impl FnMut() -> usize {
    let mut state = 11u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize
    }
}

#[test]
fn broken_text_is_an_error_or_read_and_never_large() {
    let files: [(&str, &str); 5] = [
        ("a.txt", "# framerate: 25\n# id frame x/cm y/cm\n1 0 10.5 -2 176\n1 1 11 -2.5 176\n2 1 0 0 180\n"),
        ("obsmat.txt", "1 1 2.5 0 3 0.1 0 -1\n11 1 2.6 0 2 0.1 0 -1\n"),
        ("a.traj", "pedestrianId simTime endTime-PID1 startX startY endX endY\n1 0 0.5 0 0 1 1\n1 0.5 1 1 1 2 1\n"),
        ("b.traj", "timeStep pedestrianId x y targetId\n1 1 0.5 2 1\n2 1 0.7 2 1\n"),
        ("a.csv", "ID,Frame,x,y,v_x,v_y\n21,1010,0.2,-0.1,0.4,0.09\n21,1020,0.3,-0.1,0.4,0.03\n"),
    ];
    let mut draw = draws();
    let pieces: [&[u8]; 9] = [b"\n", b" ", b"-", b"1e300", b"nan", b"#", b"\xff", b",\"", b"4294967296"];
    for (name, text) in files {
        assert!(Tracks::of_file(name, text.as_bytes(), &AT_25).is_ok(), "{name}");
        for _ in 0..4000 {
            let mut bytes = text.as_bytes().to_vec();
            for _ in 0..=draw() % 4 {
                let at = draw() % (bytes.len() + 1);
                match draw() % 3 {
                    0 => bytes.truncate(at),
                    1 => drop(bytes.splice(at..at, pieces[draw() % pieces.len()].iter().copied())),
                    _ => bytes.get_mut(at).into_iter().for_each(|byte| *byte = draw() as u8),
                }
            }
            match Tracks::of_file(name, &bytes, &AT_25) {
                Ok(tracks) => assert!(tracks.spots.len() <= 1000 * bytes.len()),
                Err(error) => assert!(matches!(error, TracksError::Content { .. })),
            }
        }
    }
}

#[test]
fn a_broken_file_of_hdf5_is_an_error() {
    let Some(path) = data("juelich/00_01a.h5") else { return };
    let bytes = std::fs::read(path).unwrap();
    let mut draw = draws();
    for k in 0..300 {
        let mut broken = bytes.clone();
        if k % 3 == 0 {
            broken.truncate(k * bytes.len() / 300);
        }
        // where the structure is, and anywhere
        for _ in 0..k % 7 {
            let reach = if draw().is_multiple_of(2) { 8192 } else { bytes.len() };
            let at = draw() % reach.min(broken.len().max(1));
            if let Some(byte) = broken.get_mut(at) {
                *byte = draw() as u8;
            }
        }
        if let Err(error) = Tracks::of_file("a.h5", &broken, &FROM_FILE) {
            assert!(matches!(error, TracksError::Content { .. }) && error.to_string().starts_with("a.h5"));
        }
    }
}
