//! Tests of bodies of files: figures of blocks, as several programs write them, against what they were made of.

#[path = "../../../../examples/figure/blocks.rs"]
pub(crate) mod blocks;

use super::read;
use base64::Engine;
use blocks::file::packed;
use blocks::{Blocks, Names};
use glam::{DMat4, DVec2, DVec3};
use serde_json::{Value, json};
use throng_figure::measure::FeetMeasure;
use throng_figure::{Character, JOINTS, Joint, Person, Pose, Sample, Side, Skeleton, Walk};

/// The figures: proportions, poses, names, axes and units differ.
fn figures() -> Vec<Blocks> {
    let plain = Blocks::default();
    let tall = Blocks { thigh: 0.52, shank: 0.47, torso: 0.55, hip: 0.085, names: Names::Prefixed, ..plain.clone() };
    let small =
        Blocks { thigh: 0.25, shank: 0.23, foot: 0.2, ball: 0.1, heel: 0.04, torso: 0.4, head: 0.35, ..plain.clone() };
    let wide =
        Blocks { hip: 0.15, shoulder: 0.3, ankle: 0.11, toe_height: 0.035, foot: 0.34, ball: 0.17, ..plain.clone() };
    vec![
        plain.clone(),
        Blocks { drop: 0.8, yaw: 0.7, turned: true, ..tall.clone() },
        Blocks { drop: 0.8, names: Names::Blender, turned: true, ..small.clone() },
        Blocks { centimetres: true, turned: true, names: Names::Unreal, yaw: -2.0, ..wide.clone() },
        Blocks { centimetres: true, extra: true, names: Names::Vrm, ..tall },
        Blocks {
            drop: 1.2,
            extra: true,
            turned: true,
            yaw: std::f64::consts::PI,
            names: Names::Extension(true),
            ..small
        },
        Blocks { names: Names::Extension(false), ..wide.clone() },
        Blocks { toes: false, turned: true, centimetres: true, ..wide },
    ]
}

fn character(blocks: &Blocks) -> Character {
    read(&blocks.glb()).unwrap_or_else(|flaw| panic!("{blocks:?}: {}", flaw.why))
}

/// Ways that are hard on feet: straight on, slow, a circle, sideways, stop and go.
fn ways() -> Vec<Vec<Sample>> {
    let way = |at: &dyn Fn(f64) -> (DVec2, f64)| -> Vec<Sample> {
        let moments = (0..=300).map(|moment| f64::from(moment) / 25.0);
        moments
            .map(|time| (time, at(time)))
            .map(|(time, (position, heading))| Sample { time, position, heading })
            .collect()
    };
    vec![
        way(&|time| (DVec2::new(1.3 * time, 0.0), 0.0)),
        way(&|time| (DVec2::new(0.4 * time, 2.0), 0.0)),
        way(&|time| (DVec2::from_angle(time) * 1.1, time + std::f64::consts::FRAC_PI_2)),
        way(&|time| (DVec2::new(0.0, 0.4 * time), 0.0)),
        way(&|time| (DVec2::new(0.6 * (time - time.sin()), -5.0), 0.0)),
    ]
}

/// Returns the matrices that move a body at rest: by the offsets of the skeleton and its inverse bind matrices, and by nothing else
/// of the library.
fn matrices(skeleton: &Skeleton, pose: &Pose) -> [DMat4; JOINTS] {
    let mut world = [DMat4::IDENTITY; JOINTS];
    for (index, joint) in Joint::ALL.into_iter().enumerate() {
        let own = DMat4::from_quat(pose.rotations[index]);
        world[index] = match joint.parent() {
            None => DMat4::from_translation(pose.hips) * own,
            Some(parent) => world[parent.index()] * DMat4::from_translation(skeleton.offset(joint)) * own,
        };
    }
    let binds = skeleton.inverse_bind_matrices();
    std::array::from_fn(|joint| world[joint] * binds[joint])
}

#[test]
fn a_file_is_read_as_it_was_made_whatever_its_axes_names_and_units() {
    for blocks in figures() {
        let character = character(&blocks);
        let (height, legs) = (character.height(), character.person(Person::new(1, 1)).legs);
        assert!((height - blocks.height()).abs() < 1e-5, "{blocks:?}: {height} m");
        let mut pairs = vec![
            (legs.thigh, blocks.thigh),
            (legs.shank, blocks.shank),
            (legs.ankle, blocks.ankle),
            (legs.heel, blocks.heel),
            (legs.foot, blocks.foot),
            (legs.hip, blocks.hip),
        ];
        if blocks.toes {
            pairs.extend([(legs.ball, blocks.ball), (legs.toe_height, blocks.toe_height)]);
        }
        for (got, want) in pairs {
            assert!((got * height - want).abs() < 1e-5, "{blocks:?}: {legs:?} x {height}");
        }
        // all vertices are where they were made
        let vertices = blocks.vertices();
        assert_eq!(character.mesh().positions.len(), vertices.len());
        for (got, (want, _)) in character.mesh().positions.iter().zip(&vertices) {
            assert!((got.as_dvec3() * height).distance(*want) < 1e-5, "{blocks:?}: {got} is not {want}");
        }
        assert_eq!(character.colours().len(), vertices.len());
    }
}

/// Bones keep their lengths, and what is rigid stays rigid: every block is moved as a whole.
#[test]
fn blocks_are_moved_as_a_whole_by_the_joints_they_belong_to() {
    for blocks in figures() {
        let character = character(&blocks);
        let person = character.person(Person::new(5, 1));
        let skeleton = character.skeleton(person.height);
        let walk = Walk::recorded(&person, &ways()[0]).unwrap();
        let vertices = blocks.vertices();
        for moment in 0..40 {
            let pose = walk.pose(2.0 + f64::from(moment) / 20.0);
            let joints = skeleton.world(&pose);
            let moved = character.mesh().posed(&skeleton, person.height, &joints);
            let oracle = matrices(&skeleton, &pose);
            for (k, (got, (rest, joint))) in moved.iter().zip(&vertices).enumerate() {
                if !blocks.toes && (13..19).contains(joint) {
                    continue;
                }
                let want = oracle[*joint].transform_point3(*rest);
                assert!(got.distance(want) < 1e-5, "{blocks:?}: vertex {k} is {got}, not {want}");
            }
            let place = |joint: Joint| joints[joint.index()].position;
            for (from, to, length) in [
                (Joint::LeftUpLeg, Joint::LeftLeg, blocks.thigh),
                (Joint::RightLeg, Joint::RightFoot, blocks.shank),
                (Joint::LeftArm, Joint::LeftForeArm, blocks.arm),
                (Joint::RightForeArm, Joint::RightHand, blocks.forearm),
            ] {
                assert!((place(from).distance(place(to)) - length).abs() < 1e-5);
            }
            // the face looks where the figure goes, the shoes are below the knees
            let nose = moved[24 * 6 - 1];
            assert!(nose.x > place(Joint::Head).x && nose.z > place(Joint::LeftLeg).z);
        }
    }
}

/// How far the soles of shoes move while they touch the ground: each corner of the sole, from where it touched.
fn slide_of_soles(blocks: &Blocks, character: &Character, walk: &Walk) -> (f64, f64) {
    let person = walk.person();
    let skeleton = character.skeleton(person.height);
    let vertices = blocks.vertices();
    let (mut largest, mut lowest) = (0.0_f64, 0.0_f64);
    for side in Side::BOTH {
        let toes = 14 + 4 * side.index();
        // under the toes, which lie flat while the heel rises
        let under: Vec<usize> =
            (0..vertices.len()).filter(|&k| vertices[k].1 == toes && vertices[k].0.z < 1e-6).collect();
        for plant in walk.plants(side) {
            let (start, end) = walk.span();
            let flat = plant.strike + plant.landing.min(0.3 * (plant.lift - plant.strike));
            let (from, to) = (flat.max(start), plant.lift.min(end));
            let mut first: Option<Vec<DVec3>> = None;
            let mut time = from;
            while time < to {
                let moved = matrices(&skeleton, &walk.pose(time));
                let places: Vec<DVec3> = under.iter().map(|&k| moved[toes].transform_point3(vertices[k].0)).collect();
                let first = first.get_or_insert_with(|| places.clone());
                for (place, first) in places.iter().zip(first.iter()) {
                    largest = largest.max(place.distance(*first));
                    lowest = lowest.min(place.z);
                }
                time += 0.011;
            }
        }
    }
    (largest, lowest)
}

#[test]
fn feet_of_every_figure_stand_as_firmly_as_those_of_throngs() {
    for blocks in figures() {
        let character = character(&blocks);
        for (number, way) in ways().iter().enumerate() {
            let person = character.person(Person::new(3, number as u64));
            let walk = Walk::recorded(&person, way).unwrap();
            let (skeleton, mut feet) = (character.skeleton(person.height), FeetMeasure::new(&person));
            for moment in 0..1200 {
                let time = f64::from(moment) / 100.0;
                feet.push(time, &skeleton.world(&walk.pose(time)));
            }
            let report = feet.report();
            assert!(report.mean_slide < 0.001 && report.largest_slide < 0.004, "{blocks:?}, way {number}: {report:?}");
            assert!(report.penetration < 1e-4 && report.airborne == 0.0, "{blocks:?}, way {number}: {report:?}");
            if blocks.toes {
                let (slide, lowest) = slide_of_soles(&blocks, &character, &walk);
                assert!(slide < 1e-3 && lowest > -1e-3, "{blocks:?}, way {number}: {slide} m, {lowest} m");
            }
        }
    }
}

#[test]
fn fingers_and_twists_move_with_the_joint_above() {
    let blocks = figures().into_iter().find(|blocks| blocks.extra).unwrap();
    let with = character(&blocks);
    let without = character(&Blocks { extra: false, ..blocks });
    assert_eq!(with.mesh().joints.len(), without.mesh().joints.len());
    for (a, b) in with.mesh().weights.iter().zip(&without.mesh().weights) {
        assert!((a[0] - b[0]).abs() < 1e-6 && (a.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{a:?}");
    }
}

#[test]
fn a_gltf_file_with_everything_in_it_is_the_same() {
    let (mut json, bin) = Blocks::default().parts();
    let text = base64::engine::general_purpose::STANDARD.encode(&bin);
    json["buffers"][0]["uri"] = format!("data:application/octet-stream;base64,{text}").into();
    assert_eq!(read(&serde_json::to_vec(&json).unwrap()).unwrap(), read(&Blocks::default().glb()).unwrap());
    json["buffers"][0]["uri"] = "figure.bin".into();
    let flaw = read(&serde_json::to_vec(&json).unwrap()).unwrap_err();
    assert!(flaw.why.ends_with("are not in the file"), "{flaw}");
}

/// A hat without a skin, below the head, is a part of the body; a floor is not.
#[test]
fn what_a_joint_carries_is_a_part_of_the_body() {
    let (mut json, bin) = Blocks::default().parts();
    let nodes = json["nodes"].as_array().unwrap().len();
    let copy = json["meshes"][0].clone();
    json["meshes"].as_array_mut().unwrap().push(copy);
    let attributes = &mut json["meshes"][1]["primitives"][0]["attributes"];
    attributes.as_object_mut().unwrap().retain(|name, _| name == "POSITION");
    json["nodes"].as_array_mut().unwrap().push(json!({ "name": "Hat", "mesh": 1, "scale": [0.1, 0.1, 0.1] }));
    let plain = read(&packed(&json, &bin)).unwrap().mesh().positions.len();
    assert_eq!(plain, Blocks::default().vertices().len());
    json["nodes"][5]["children"] = json!([nodes]);
    let hat = read(&packed(&json, &bin)).unwrap();
    assert_eq!(hat.mesh().positions.len(), 2 * plain);
    assert!(hat.mesh().joints[plain..].iter().all(|numbers| numbers[0] == Joint::Head as u8));
    assert!(hat.mesh().normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-3));
}

/// Changes a number of an accessor.
pub(super) fn put(json: &Value, bin: &mut [u8], accessor: &Value, at: usize, bytes: &[u8]) {
    let view = json["accessors"][accessor.as_u64().unwrap() as usize]["bufferView"].as_u64().unwrap() as usize;
    let at = json["bufferViews"][view]["byteOffset"].as_u64().unwrap() as usize + at;
    bin[at..at + bytes.len()].copy_from_slice(bytes);
}

/// Weights that do not sum to 1 are shares.
#[test]
fn weights_are_normalised() {
    let (json, mut bin) = Blocks::default().parts();
    let attributes = &json["meshes"][0]["primitives"][0]["attributes"];
    put(&json, &mut bin, &attributes["WEIGHTS_0"], 0, &0.25_f32.to_le_bytes());
    assert_eq!(read(&packed(&json, &bin)).unwrap(), read(&Blocks::default().glb()).unwrap());
}

/// Mirrored limbs, as Blender's modifiers leave them, are right where their matrices mirror twice.
#[test]
fn a_mirrored_limb_whose_bind_matrix_mirrors_too_is_right() {
    let (mut json, mut bin) = Blocks::default().parts();
    let binds = json["skins"][0]["inverseBindMatrices"].clone();
    // the right hand: scale -1 along x, and the same in its inverse bind matrix
    json["nodes"][11]["scale"] = json!([-1.0, 1.0, 1.0]);
    for column in 0..4 {
        let view = json["accessors"][binds.as_u64().unwrap() as usize]["bufferView"].as_u64().unwrap() as usize;
        let from = json["bufferViews"][view]["byteOffset"].as_u64().unwrap() as usize + 10 * 64 + 16 * column;
        let value = f32::from_le_bytes(bin[from..from + 4].try_into().unwrap());
        put(&json, &mut bin, &binds, 10 * 64 + 16 * column, &(-value).to_le_bytes());
    }
    let (found, want) = (read(&packed(&json, &bin)).unwrap(), read(&Blocks::default().glb()).unwrap());
    for (a, b) in found.mesh().positions.iter().zip(&want.mesh().positions) {
        assert!(a.distance(*b) < 1e-6);
    }
}

/// A vertex has the colour of the material, times its own, times that of the texture where it is.
#[test]
fn colours_are_those_of_materials_vertices_and_textures() {
    let (mut json, mut bin) = Blocks::default().parts();
    let count = json["accessors"][0]["count"].as_u64().unwrap() as usize;
    // two pixels, red and white, and all vertices on the red one but the last
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 2, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[255, 0, 0, 255, 255, 255]).unwrap();
    let mut add = |json: &mut Value, bytes: &[u8]| {
        let views = json["bufferViews"].as_array_mut().unwrap();
        views.push(json!({ "buffer": 0, "byteOffset": bin.len(), "byteLength": bytes.len() }));
        bin.extend_from_slice(bytes);
        bin.resize(bin.len().next_multiple_of(4), 0);
        json["bufferViews"].as_array().unwrap().len() - 1
    };
    let image = add(&mut json, &file);
    let mut places = vec![[0.2_f32, 0.5]; count];
    places[count - 1] = [-0.2, 7.5];
    let places: Vec<u8> = places.iter().flatten().flat_map(|part| part.to_le_bytes()).collect();
    let places = add(&mut json, &places);
    json["accessors"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "bufferView": places, "componentType": 5126, "type": "VEC2", "count": count }));
    let accessor = json["accessors"].as_array().unwrap().len() - 1;
    json["images"] = json!([{ "bufferView": image, "mimeType": "image/png" }]);
    json["textures"] = json!([{ "source": 0 }]);
    json["materials"] = json!([{ "pbrMetallicRoughness": {
        "baseColorFactor": [1.0, 0.5, 1.0, 1.0], "baseColorTexture": { "index": 0 },
    } }]);
    let primitive = &mut json["meshes"][0]["primitives"][0];
    primitive["material"] = 0.into();
    primitive["attributes"]["TEXCOORD_0"] = accessor.into();
    primitive["attributes"].as_object_mut().unwrap().retain(|name, _| name != "COLOR_0");
    let body = read(&packed(&json, &bin)).unwrap();
    assert_eq!(body.colours()[0], [255, 0, 0]);
    // half the light is 188 of 255 in sRGB
    assert_eq!(body.colours()[count - 1], [255, 188, 255]);
    // the texture of an extension is read; where there is another for all programs, that one is
    json["textures"] = json!([{ "extensions": { "EXT_texture_webp": { "source": 0 } } }]);
    assert_eq!(read(&packed(&json, &bin)).unwrap().colours()[0], [255, 0, 0]);
    json["textures"] = json!([{ "source": 0, "extensions": { "EXT_texture_webp": { "source": 7 } } }]);
    assert_eq!(read(&packed(&json, &bin)).unwrap().colours()[0], [255, 0, 0]);
    // a picture that is not in the file leaves the colour of the material
    json["images"][0] = json!({ "uri": "skin.jpg" });
    assert_eq!(read(&packed(&json, &bin)).unwrap().colours()[0], [255, 188, 255]);
    json["images"] = json!([]);
    assert!(read(&packed(&json, &bin)).unwrap_err().why.contains("image 0: it does not exist"));
    // a damaged picture is an error
    json["images"] = json!([{ "bufferView": image }]);
    let view = json["bufferViews"][image]["byteOffset"].as_u64().unwrap() as usize;
    bin[view + 20] = 77;
    let flaw = read(&packed(&json, &bin)).unwrap_err();
    assert!(flaw.why.contains("the PNG is damaged"), "{flaw}");
}
