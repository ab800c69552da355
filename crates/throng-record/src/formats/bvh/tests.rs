//! Tests of BVH: files are read back and compared with the planned poses.

use super::read::read;
use crate::people::samples::{assert_feet_stand, hard, planned, seldom, walkers, write};
use crate::{Body, Choice, Frame, Setting};
use glam::DVec2;
use std::path::Path;

/// Returns the bytes of each person's file.
fn written(folder: &Path, setting: &Setting, frames: &[Frame]) -> Vec<(u32, Vec<u8>)> {
    write(&folder.join("a-*-b.bvh"), setting, &Choice::default(), frames).unwrap();
    let mut all: Vec<(u32, Vec<u8>)> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            let number = name.strip_prefix("a-").unwrap().strip_suffix("-b.bvh").unwrap();
            let bytes = std::fs::read(&path).unwrap();
            std::fs::remove_file(path).unwrap();
            (number.parse().unwrap(), bytes)
        })
        .collect();
    all.sort_by_key(|(number, _)| *number);
    all
}

#[test]
fn joints_of_files_are_those_of_the_walk() {
    let (folder, frames) = (tempfile::tempdir().unwrap(), walkers());
    let files = written(folder.path(), &Setting::default(), &frames);
    assert_eq!(files.len(), 3);
    for (number, bytes) in files {
        let figures = read(&bytes).unwrap();
        let figure = &figures.all[0];
        assert!((figures.period - 0.04).abs() < 1e-9);
        for (time, want) in planned(figure, number, &frames) {
            let found = figure.joints(time - 3.0).unwrap();
            for (found, want) in found.iter().zip(&want) {
                assert!(found.position.distance(want.position) < 1e-5, "{number} {time}: {found:?} {want:?}");
                // 13 µrad of three angles of 5e-5° for each of five joints, and positions of agents are singles on their
                // way: 1 µm at the 0.13 m from the ankle to the toes
                assert!(found.rotation.angle_between(want.rotation) < 3e-5, "{number} {time}: {found:?} {want:?}");
            }
        }
        assert_feet_stand(&figures);
    }
}

/// A person with the body of a file has the joints of that body.
#[cfg(feature = "glb")]
#[test]
fn bodies_from_files_are_written_and_walk() {
    let (folder, dressed) = (tempfile::tempdir().unwrap(), crate::people::samples::Dressed::new());
    let files = written(folder.path(), &dressed.setting, &dressed.frames);
    let figures = read(&files[1].1).unwrap();
    dressed.assert_walks(&figures.all[0], 0.0, 1e-4);
}

/// A recording of 2.5 frames a second gets poses in between.
#[test]
fn people_of_a_coarse_recording_stand_on_planted_feet() {
    let folder = tempfile::tempdir().unwrap();
    for (_, bytes) in written(folder.path(), &Setting::default(), &seldom(&walkers(), 10)) {
        let figures = read(&bytes).unwrap();
        assert!((figures.period - 0.02).abs() < 1e-9);
        assert_feet_stand(&figures);
    }
}

/// Programs interpolate each angle by itself: from frame to frame none may jump by a whole turn.
#[test]
fn angles_do_not_jump() {
    let folder = tempfile::tempdir().unwrap();
    for (number, bytes) in written(folder.path(), &Setting::default(), &walkers()) {
        let text = String::from_utf8(bytes).unwrap();
        let (_, motion) = text.split_once("Frame Time: 0.040000000\n").unwrap();
        let frames: Vec<Vec<f64>> =
            motion.lines().map(|line| line.split(' ').map(|word| word.parse().unwrap()).collect()).collect();
        assert_eq!((frames.len(), frames[0].len()), (400, 60));
        for pair in frames.windows(2) {
            let jump = pair[0][3..].iter().zip(&pair[1][3..]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(jump < 40.0, "{number}: {jump}° in a frame");
        }
    }
}

/// The place in the world is that of the scene, whatever its origin.
#[test]
fn people_are_where_the_scene_has_them() {
    let folder = tempfile::tempdir().unwrap();
    let at = DVec2::new(5e5, -4e6);
    let frames: Vec<Frame> =
        (0..20).map(|k| Frame { time: f64::from(k), bodies: vec![Body::walking(1, at)], ..Frame::default() }).collect();
    let files = written(folder.path(), &Setting { origin: at, ..Setting::default() }, &frames);
    let joints = read(&files[0].1).unwrap().all[0].joints(3.0).unwrap();
    assert!(joints[0].position.truncate().distance(at) < 0.1, "{:?}", joints[0]);
}

#[test]
fn hard_recordings_have_files() {
    for frames in hard() {
        let folder = tempfile::tempdir().unwrap();
        for (_, bytes) in written(folder.path(), &Setting::default(), &frames) {
            let figures = read(&bytes).unwrap();
            let figure = &figures.all[0];
            for second in figure.seconds {
                let joints = figure.joints(second).unwrap();
                assert!(joints.iter().all(|joint| joint.position.is_finite() && joint.rotation.is_finite()));
            }
        }
    }
}

#[test]
fn what_cannot_be_written_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let error = |name: &str, setting: &Setting, body: Body| {
        let frames = [Frame { bodies: vec![body], ..Frame::default() }];
        write(&folder.path().join(name), setting, &Choice::default(), &frames).unwrap_err().to_string()
    };
    let here = Body::walking(7, DVec2::ZERO);
    let message = error("run.bvh", &Setting::default(), here);
    assert!(message.contains("holds one person") && message.ends_with("run-*.bvh"), "{message}");
    let message = error("*.bvh", &Setting { in_space: true, ..Setting::default() }, here);
    assert!(message.contains("fly"), "{message}");
    let message = error("*.bvh", &Setting::default(), Body { position: DVec2::NAN, ..here });
    assert!(message.contains("agent 7: sample 0: a number is not finite"), "{message}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    // wide agents are no people
    let frames = [Frame { bodies: vec![Body { radius: 2.0, ..here }], ..Frame::default() }];
    assert!(written(folder.path(), &Setting::default(), &frames).is_empty());
}

#[test]
fn damaged_files_name_their_line() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = written(folder.path(), &Setting::default(), &walkers()[..3]).remove(0).1;
    let text = String::from_utf8(bytes.clone()).unwrap();
    let flaw = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        let flaw = read(text.replacen(from, to, 1).as_bytes()).unwrap_err();
        (flaw.line.unwrap(), flaw.why)
    };
    assert_eq!(flaw("HIERARCHY", "HIERARCHIE"), (1, "`HIERARCHIE` stands where `HIERARCHY` is expected".to_owned()));
    assert_eq!(flaw("OFFSET 0.0000", "OFFSET x"), (4, "`x` is no number".to_owned()));
    assert_eq!(flaw("CHANNELS 3", "CHANNELS 7").1, "a joint has 0 to 6 channels, not 7");
    assert_eq!(flaw("Zrotation Yrotation", "Zrotation Wrotation").1, "`Wrotation` is no channel");
    assert_eq!(flaw("JOINT LeftFoot", "JOINT LeftPaw").1, "there is no joint LeftFoot");
    assert_eq!(flaw("Frames: 3", "Frames: 4000000000").1, "the file is cut off: it has fewer frames than it states");
    assert_eq!(flaw("Frames: 3", "Frames: 0").1, "0 frames, 0.04 s apart, are no motion");
    for end in (0..bytes.len() - 4).step_by(7) {
        assert!(read(&bytes[..end]).is_err(), "{end} of {} bytes", bytes.len());
    }
    let mut changed = bytes.clone();
    for at in 0..bytes.len() {
        for turn in [0x01, 0x80, 0xff] {
            changed[at] ^= turn;
            let _ = read(&changed);
            changed[at] ^= turn;
        }
    }
    assert!(read(b"").is_err());
}
