//! Tests of people: skins and baked poses are compared with the planned poses.

use super::people::carries_feet;
use super::{FORMAT, figures};
use crate::formats::Reading;
use crate::people::FigureStyle;
use crate::people::samples::{self, assert_feet_stand, hard, planned, seldom, walkers};
use crate::{Choice, Frame, Setting};
use std::collections::BTreeSet;
use throng_figure::Joint;

/// Returns the bytes of a file with people of a style.
fn written(frames: &[Frame], figures: FigureStyle) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.glb");
    samples::write(&path, &Setting::default(), &Choice { figures, ..Choice::default() }, frames).unwrap();
    std::fs::read(path).unwrap()
}

#[test]
fn people_of_a_file_stand_on_planted_feet() {
    let found = figures::read(&written(&walkers(), FigureStyle::Auto)).unwrap();
    assert_eq!((found.all.len(), (found.period * 1e3).round()), (3, 40.0));
    assert_feet_stand(&found);
}

/// Recordings of 12.5 and of 2.5 frames a second get poses in between.
#[test]
fn people_of_a_coarse_recording_stand_on_planted_feet() {
    for step in [2, 10] {
        let found = figures::read(&written(&seldom(&walkers(), step), FigureStyle::Auto)).unwrap();
        assert_eq!((found.all.len(), (found.period * 1e3).round()), (3, 20.0));
        assert_feet_stand(&found);
    }
}

/// Where the joints of a file are, they are in the walk of the same person.
#[test]
fn joints_of_a_file_are_those_of_the_walk() {
    let frames = walkers();
    let bytes = written(&frames, FigureStyle::Auto);
    for figure in &figures::read(&bytes).unwrap().all {
        for (time, want) in planned(figure, figure.number, &frames) {
            let found = figure.joints(time - 3.0).unwrap();
            for (joint, (found, want)) in Joint::ALL.iter().zip(found.iter().zip(&want)) {
                // joints that carry no feet may be off by 0.3° each
                let off = if carries_feet(*joint) { 4e-3 } else { 12e-3 };
                assert!(found.position.distance(want.position) < off, "{time}: {joint:?} {found:?} {want:?}");
                assert!(found.rotation.angle_between(want.rotation) < 0.03, "{time}: {found:?} {want:?}");
            }
        }
    }
}

#[test]
fn hard_recordings_have_figures() {
    for frames in hard() {
        let bytes = written(&frames, FigureStyle::Auto);
        let people: BTreeSet<u32> = frames.iter().flat_map(|frame| &frame.bodies).map(|body| body.number).collect();
        let found = figures::read(&bytes).unwrap();
        assert_eq!(found.all.iter().map(|figure| figure.number).collect::<Vec<_>>(), Vec::from_iter(people));
        for figure in &found.all {
            let joints = figure.joints(figure.seconds[0]).unwrap();
            assert!(joints.iter().all(|joint| joint.position.is_finite() && joint.rotation.is_finite()));
        }
    }
}

/// Baked poses are those of the walk too, and the agents are read back as they are without figures.
#[test]
fn baked_poses_are_those_of_the_walk() {
    let frames = walkers();
    let [baked, plain] = [FigureStyle::Baked, FigureStyle::None].map(|style| written(&frames, style));
    let [tracks, same] = [&baked, &plain].map(|bytes| FORMAT.reader().unwrap()(bytes, &Reading::default()).unwrap());
    assert_eq!(tracks.spots, same.spots);
    assert!(figures::read(&plain).is_err());
    let found = figures::read(&baked).unwrap();
    assert_eq!(found.all.len(), 3);
    assert_feet_stand(&found);
    for figure in &found.all {
        for (time, want) in planned(figure, figure.number, &frames) {
            for (found, want) in figure.joints(time - 3.0).unwrap().iter().zip(&want) {
                assert!(found.position.distance(want.position) < 2e-4, "{time}: {found:?} {want:?}");
                assert!(found.rotation.angle_between(want.rotation) < 1e-4, "{time}: {found:?} {want:?}");
            }
        }
    }
    // what the description names is in the file, or an error
    let visits = b"\"visits\":[[0,400,0]]";
    let at = baked.windows(visits.len()).position(|bytes| bytes == visits).unwrap() + b"\"visits\":[[0,".len();
    for wrong in [b"900", b"401", b"  0"] {
        let mut changed = baked.clone();
        changed[at..at + 3].copy_from_slice(wrong);
        assert!(figures::read(&changed).err().unwrap().why.contains("missing poses of agent 0"));
    }
}

#[test]
fn joints_are_no_agents() {
    let tracks = FORMAT.reader().unwrap()(&written(&walkers(), FigureStyle::Auto), &Reading::default()).unwrap();
    assert_eq!(tracks.spots.len(), 1200);
    let last = tracks.spots.iter().rfind(|spot| spot.number == 0).unwrap();
    assert!((last.place.x - 1.3 * 0.04 * 399.0).abs() < 2e-3 && last.place.z.abs() < 1e-6, "{last:?}");
}

/// People with a body from a file are written with its mesh, its joints and its legs: read back, they are where the walk of that
/// body has them, and their feet stand.
#[test]
fn bodies_from_files_are_written_and_walk() {
    let dressed = samples::Dressed::new();
    let bytes = dressed.written("run.glb");
    let found = figures::read(&bytes).unwrap();
    let figure = found.all.iter().find(|figure| figure.number == 1).unwrap();
    let (body, person) = (&dressed.body, dressed.walk.person());
    assert!((figure.person.height - body.height()).abs() < 1e-6);
    assert!(
        (figure.person.leg() - person.leg()).abs() < 1e-6 && (figure.person.legs.hip - person.legs.hip).abs() < 1e-9
    );
    dressed.assert_walks(figure, 0.0, 12e-3);
    // the mesh is in the file once, with all of its vertices, bound as the file has it
    let data = super::data::Data::open(&bytes).unwrap();
    let mesh = data.root.meshes.iter().find(|mesh| mesh["name"] == "figure 1").unwrap();
    let at = mesh["primitives"][0]["attributes"]["POSITION"].as_u64().unwrap() as usize;
    assert_eq!(data.numbers::<3>(at).unwrap().len(), body.mesh().positions.len());
    assert_eq!(data.root.skins.len(), 3);
}

/// Baked poses of a person with a body from a file are those of the walk on its legs, and its mesh is in the file once.
#[test]
fn baked_bodies_from_files_walk() {
    let dressed = samples::Dressed::new();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.glb");
    let choice = Choice { figures: FigureStyle::Baked, ..Choice::default() };
    samples::write(&path, &dressed.setting, &choice, &dressed.frames).unwrap();
    let bytes = std::fs::read(path).unwrap();
    let found = figures::read(&bytes).unwrap();
    assert_eq!(found.all.len(), 3);
    assert_feet_stand(&found);
    let figure = found.all.iter().find(|figure| figure.number == 1).unwrap();
    let person = dressed.walk.person();
    assert!((figure.person.height - dressed.body.height()).abs() < 1e-6);
    assert!((figure.person.leg() - person.leg()).abs() < 1e-6);
    dressed.assert_walks(figure, 0.0, 2e-4);
    let data = super::data::Data::open(&bytes).unwrap();
    let known = &data.root.asset.extras[super::baked::BAKED];
    let (body, look) = (&known["people"][1]["body"], known["people"][1].get("look"));
    let body = &known["bodies"][body.as_u64().unwrap() as usize];
    assert_eq!((&body["build"], look), (&"figure 1".into(), None));
    let mesh = &data.root.meshes[body["levels"][0].as_u64().unwrap() as usize];
    let attributes = &mesh["primitives"][0]["attributes"];
    let positions = data.numbers::<3>(attributes["POSITION"].as_u64().unwrap() as usize).unwrap();
    assert_eq!((positions.len(), body["levels"].as_array().unwrap().len()), (dressed.body.mesh().positions.len(), 1));
    assert!(attributes["COLOR_0"].is_u64() && attributes["_REGION"].is_null());
}
