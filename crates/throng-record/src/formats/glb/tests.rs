//! Tests of what is particular to glTF; the tests of all formats are in `formats/tests`.

use super::data::Data;
use super::sampler::Channels;
use super::{FORMAT, figures, seconds};
use crate::formats::Reading;
use crate::people::{MOST_SKINS, axes};
use crate::trajectories::Trajectories;
use crate::{Body, Choice, Frame, Output, Setting};
use glam::{DVec2, DVec3, Quat, Vec3};
use serde_json::{Value, json};
use std::f64::consts::FRAC_1_SQRT_2;
use throng::motion::Basis;

fn written(setting: &Setting, frames: &[Frame]) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.glb");
    let mut writer = FORMAT.create(Output::create(&path).unwrap(), setting, &Choice::default()).unwrap().unwrap();
    frames.iter().for_each(|frame| writer.push(frame).unwrap());
    writer.finish().unwrap();
    std::fs::read(path).unwrap()
}

/// A file of a JSON and a binary chunk.
fn file(json: &Value, bin: &[u8]) -> Vec<u8> {
    let mut json = json.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let size = |size: usize| (size as u32).to_le_bytes();
    let head = [*b"glTF", size(2), size(28 + json.len() + bin.len()), size(json.len()), *b"JSON"].concat();
    [head, json, size(bin.len()).to_vec(), b"BIN\0".to_vec(), bin.to_vec()].concat()
}

fn read(json: &Value, bin: &[u8]) -> Result<Trajectories, String> {
    FORMAT.reader().unwrap()(&file(json, bin), &Reading::default()).map_err(|flaw| flaw.why)
}

fn bytes(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// A file of another program: an animated node below a rotated and scaled node, with another animated node below it.
fn theirs() -> (Value, Vec<u8>) {
    let json = json!({
        "asset": { "version": "2.0" },
        "nodes": [
            { "translation": [10, 0, 0], "rotation": [0, FRAC_1_SQRT_2, 0, FRAC_1_SQRT_2], "scale": [2, 2, 2], "children": [1], "extras": 3 },
            { "children": [2], "extras": { "a": 1 } },
            { "name": "bone" },
        ],
        "animations": [{
            "channels": [
                { "sampler": 0, "target": { "node": 1, "path": "translation" } },
                { "sampler": 0, "target": { "node": 2, "path": "translation" } },
                { "sampler": 0, "target": { "node": 1, "path": "weights" } },
            ],
            "samplers": [{ "input": 0, "output": 1 }],
        }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "SCALAR" },
            { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3", "byteOffset": 4 },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 12 },
            { "buffer": 0, "byteOffset": 12, "byteLength": 48, "byteStride": 16 },
        ],
        "buffers": [{ "byteLength": 60 }],
    });
    let values = [0.5, 1.0, 2.0, 9.0, 0.0, 0.0, 0.0, 9.0, 0.0, 0.0, 1.0, 9.0, 0.0, 3.0, 1.0];
    (json, bytes(&values))
}

#[test]
fn a_node_that_another_program_moves_is_a_trajectory() {
    let (json, bin) = theirs();
    let tracks = read(&json, &bin).unwrap();
    let found: Vec<_> = tracks.spots.iter().map(|spot| (spot.number, spot.time, spot.place)).collect();
    // the parent turns +z to +x and doubles lengths
    let want = [(0.5, (10.0, 0.0, 0.0)), (1.0, (12.0, 0.0, 0.0)), (2.0, (12.0, 0.0, 6.0))];
    assert_eq!(found.len(), want.len());
    for ((number, time, place), (then, at)) in found.into_iter().zip(want) {
        assert_eq!((number, time), (1, then));
        assert!(place.distance(DVec3::from(at)) < 1e-6, "{place}");
    }
}

#[test]
fn files_without_trajectories_are_errors() {
    let why = |change: &dyn Fn(&mut Value)| {
        let (mut json, bin) = theirs();
        change(&mut json);
        read(&json, &bin).map(|tracks| tracks.spots.len()).unwrap_err()
    };
    assert_eq!(why(&|json| json["animations"] = json!([])), "no animation moves a node");
    assert_eq!(why(&|json| json["nodes"][2]["children"] = json!([0])), "node 1 is its own ancestor");
    assert_eq!(
        why(&|json| json["accessors"][1]["count"] = json!(4)),
        "accessor 1 reads beyond the end of its buffer view"
    );
    assert_eq!(why(&|json| json["accessors"][1]["count"] = json!(2)), "accessor 0 has 3 times for 2 values");
    assert_eq!(why(&|json| json["accessors"][1]["sparse"] = json!({})), "accessor 1 does not hold plain VEC3 numbers");
    assert_eq!(
        why(&|json| json["bufferViews"][1]["byteOffset"] = json!(u64::MAX)),
        "buffer view 1 extends beyond the end of the file"
    );
    assert_eq!(
        why(&|json| json["buffers"][0]["uri"] = json!("x.bin")),
        "the bytes of buffer view 0 are not in the file"
    );
    assert!(
        why(&|json| json["animations"][0]["samplers"][0]["interpolation"] = json!("CUBICSPLINE"))
            .contains("CUBICSPLINE")
    );
    assert!(why(&|json| json["nodes"] = json!(3)).starts_with("its JSON is not valid glTF"));
    assert!(why(&|json| json["nodes"][0]["matrix"] = json!(vec![1e308; 16])).contains("not finite"));
    let (json, bin) = theirs();
    let mut old = file(&json, &bin);
    old[4] = 1;
    assert_eq!(FORMAT.reader().unwrap()(&old, &Reading::default()).unwrap_err().why, "the file is glTF 1, not 2");
}

/// An animation that reads the same second many times must not make the reader allocate as many samples.
#[test]
fn few_bytes_do_not_make_many_samples() {
    let (mut json, mut bin) = theirs();
    bin.extend(bytes(&vec![0.0; 9000]));
    json["buffers"][0]["byteLength"] = json!(bin.len());
    json["bufferViews"][1]["byteLength"] = json!(bin.len() - 12);
    json["accessors"][1] = json!({ "bufferView": 1, "componentType": 5126, "count": 3000, "type": "VEC3" });
    let channel = json!({ "sampler": 0, "target": { "node": 1, "path": "translation" } });
    json["animations"][0]["channels"] = vec![channel; 5000].into();
    assert!(read(&json, &bin).unwrap_err().contains("too often"));
}

#[test]
fn flying_agents_keep_their_whole_rotation() {
    let bases: Vec<Basis> = (0..200)
        .map(|k| {
            let angle = 0.05 * k as f32;
            let ahead = Vec3::new(angle.cos(), (0.7 * angle).sin(), (1.3 * angle).sin());
            Basis::default().turned_to(ahead.normalize(), Vec3::new(0.3, (2.0 * angle).sin(), 1.0))
        })
        .collect();
    let frames: Vec<Frame> = bases
        .iter()
        .enumerate()
        .map(|(k, &basis)| {
            let body =
                Body { basis: Some(basis), heading: basis.heading(), ..Body::walking(7, DVec2::new(k as f64, 0.0)) };
            Frame { time: 5.0 + 0.04 * k as f64, bodies: vec![body], ..Frame::default() }
        })
        .collect();
    let bytes = written(&Setting { in_space: true, ..Setting::default() }, &frames);
    let data = Data::open(&bytes).unwrap();
    let channels = Channels::new(&data, usize::MAX).unwrap();
    let at = data.root.nodes.iter().position(|node| node.name == "Agent_7").unwrap();
    let sampled = channels.of(&data, at, &data.root.nodes[at]).unwrap();
    let times: Vec<f64> = frames.iter().map(|frame| frame.time).collect();
    for (second, basis) in seconds(&times).into_iter().zip(&bases) {
        let turn: Quat = sampled.rotation(second);
        for (own, want) in [(Vec3::X, basis.forward), (Vec3::Y, basis.side), (Vec3::Z, basis.up)] {
            let off = (turn * axes::own(own)).angle_between(axes::point(want));
            assert!(off < 0.4f32.to_radians(), "{off}");
        }
    }
    let tracks = FORMAT.reader().unwrap()(&bytes, &Reading::default()).unwrap();
    assert_eq!((tracks.spots.len(), tracks.spots[0].time), (200, 5.0));
}

#[test]
fn files_without_figures_are_errors() {
    let (json, bin) = theirs();
    assert_eq!(figures::read(&file(&json, &bin)).err().unwrap().why, "the file does not say the times of its frames");
    let (mut json, bin) = theirs();
    json["skins"] = json!([{ "joints": [0, 1] }]);
    json["asset"]["extras"][super::TIMES] = json!(0);
    assert!(figures::read(&file(&json, &bin)).is_err());
}

/// Calls `found` with every value of a key, at any depth.
fn values_of(json: &Value, key: &str, found: &mut impl FnMut(&Value)) {
    match json {
        Value::Object(map) => map.iter().for_each(|(name, value)| {
            if name == key {
                found(value);
            }
            values_of(value, key, found);
        }),
        Value::Array(list) => list.iter().for_each(|value| values_of(value, key, found)),
        _ => {}
    }
}

#[test]
fn every_accessor_and_buffer_view_is_used() {
    let still = |_: u32| DVec2::ZERO;
    let straight = |k: u32| DVec2::new(f64::from(k), 0.0);
    let crooked = |k: u32| DVec2::new(f64::from(k), f64::from(k * k % 7));
    for path in [still, straight, crooked] {
        let frame = |k: u32| Frame { time: f64::from(k), bodies: vec![Body::walking(3, path(k))], ..Frame::default() };
        let bytes = written(&Setting::default(), &(0..50).map(frame).collect::<Vec<_>>());
        let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
        let json: Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
        let used = |keys: &[&str]| {
            let mut used = std::collections::BTreeSet::new();
            keys.iter().for_each(|key| values_of(&json, key, &mut |value| used.extend(value.as_u64())));
            used.into_iter().collect::<Vec<_>>()
        };
        let all = |list: &str| (0..json[list].as_array().unwrap().len() as u64).collect::<Vec<_>>();
        let vertices = ["POSITION", "NORMAL", "JOINTS_0", "WEIGHTS_0", "COLOR_0"];
        let others = ["input", "output", "indices", "inverseBindMatrices"];
        assert_eq!(used(&[&vertices[..], &others].concat()), all("accessors"));
        assert_eq!(used(&["bufferView", super::TIMES]), all("bufferViews"));
    }
}

#[test]
fn standing_agents_take_almost_no_space() {
    let frames = |count: u32| -> Vec<Frame> {
        let frame = |k: u32| {
            // too many for figures, which shift their weight while they stand
            let bodies = (0..=MOST_SKINS as u32).map(|n| Body::walking(n, DVec2::new(f64::from(n), 0.0))).collect();
            Frame { time: 0.04 * f64::from(k), bodies, ..Frame::default() }
        };
        (0..count).map(frame).collect()
    };
    let [few, many] = [10, 1010].map(|count| written(&Setting::default(), &frames(count)).len());
    // the times, as `f32` and as `f64`
    assert!(many - few < 1000 * 12 + 100, "{few} to {many} bytes");
}

#[test]
fn a_file_without_agents_or_frames_is_valid() {
    for frames in [vec![], vec![Frame::default()]] {
        let tracks = FORMAT.reader().unwrap()(&written(&Setting::default(), &frames), &Reading::default()).unwrap();
        assert!(tracks.spots.is_empty());
    }
}

#[test]
fn seconds_grow_even_where_singles_do_not() {
    let times: Vec<f64> = (0..5).map(|k| if k == 0 { -3.0 } else { 1e9 + f64::from(k) }).collect();
    assert!(seconds(&times).windows(2).all(|two| two[0] < two[1]));
    assert_eq!(seconds(&[2.0, 2.5]), [0.0, 0.5]);
    assert!(seconds(&[]).is_empty());
}
