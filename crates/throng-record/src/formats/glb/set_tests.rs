//! Tests of sets: files made by hand, against what they were made of.

use super::character::tests::blocks::file::packed;
use super::set::read;
use crate::SetMesh;
use glam::{DVec3, Vec3};
use serde_json::{Value, json};

/// Corners of a triangle in the file: 2 wide, 1 high, at the depth 3. Seen from +z it is anticlockwise.
const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 3.0], [2.0, 0.0, 3.0], [0.0, 1.0, 3.0]];

/// Returns a file of one triangle.
fn triangle() -> (Value, Vec<u8>) {
    let bin: Vec<u8> = CORNERS.iter().flatten().flat_map(|part| part.to_le_bytes()).collect();
    let json = json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] }],
        "materials": [{ "pbrMetallicRoughness": { "baseColorFactor": [1.0, 0.0, 0.0, 0.3] } }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
        "buffers": [{ "byteLength": 36 }],
    });
    (json, bin)
}

fn changed(change: impl FnOnce(&mut Value)) -> Result<SetMesh, String> {
    let (mut json, bin) = triangle();
    change(&mut json);
    read(&packed(&json, &bin)).map_err(|flaw| {
        assert!(flaw.hint.is_some_and(|hint| hint.contains(".glb")));
        flaw.why
    })
}

#[test]
fn y_is_up_and_triangles_without_normals_are_flat() {
    let set = changed(|_| ()).unwrap();
    assert_eq!(set.positions, [Vec3::new(0.0, -3.0, 0.0), Vec3::new(2.0, -3.0, 0.0), Vec3::new(0.0, -3.0, 1.0)]);
    assert_eq!((set.normals, set.triangles), (vec![Vec3::NEG_Y; 3], vec![[0, 1, 2]]));
    // an opacity counts only in materials that are blended
    assert_eq!((set.colors, set.replaces), (vec![[255, 0, 0]; 3], false));
}

#[test]
fn nodes_move_turn_scale_and_mirror() {
    let nested = changed(|json| {
        json["nodes"] = json!([
            { "children": [1], "translation": [10.0, 0.0, 0.0], "scale": [2.0, 2.0, 2.0] },
            { "mesh": 0, "translation": [0.0, 5.0, 0.0] },
        ]);
    });
    assert_eq!(nested.unwrap().positions[1], Vec3::new(14.0, -6.0, 10.0));
    let mirrored = changed(|json| json["nodes"][0]["scale"] = json!([-1.0, 1.0, 1.0])).unwrap();
    assert_eq!(mirrored.positions[2], Vec3::new(-2.0, -3.0, 0.0), "the triangle is still anticlockwise from its front");
    assert_eq!(mirrored.normals, [Vec3::NEG_Y; 3]);
    let twice = changed(|json| json["nodes"] = json!([{ "mesh": 0 }, { "mesh": 0, "translation": [0.0, 0.0, 1.0] }]));
    assert_eq!(twice.unwrap().triangles, [[0, 1, 2], [3, 4, 5]]);
}

#[test]
fn a_set_is_placed() {
    let set = changed(|_| ()).unwrap().placed(DVec3::new(1.0, 2.0, 3.0), std::f64::consts::FRAC_PI_2, 0.5);
    let wanted = [Vec3::new(2.5, 2.0, 3.0), Vec3::new(2.5, 3.0, 3.0), Vec3::new(2.5, 2.0, 3.5)];
    assert!(set.positions.iter().zip(wanted).all(|(have, want)| have.distance(want) < 1e-6), "{:?}", set.positions);
    assert!(set.normals[0].distance(Vec3::X) < 1e-6, "{:?}", set.normals);
}

#[test]
fn what_one_sees_through_is_left_out() {
    let clear = |json: &mut Value| json["materials"][0]["alphaMode"] = "BLEND".into();
    assert_eq!(changed(clear), Err("the file has no triangles".into()));
    let half = changed(|json| {
        clear(json);
        json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][3] = 0.6.into();
    });
    assert_eq!(half.unwrap().triangles.len(), 1);
}

#[test]
fn bad_files_are_errors() {
    for bytes in [&b""[..], b"glTF", b"a set", b"{}", b"{ \"nodes\": 3 }"] {
        read(bytes).unwrap_err();
    }
    assert_eq!(changed(|json| json["nodes"] = json!([])), Err("the file has no triangles".into()));
    assert_eq!(changed(|json| json["nodes"][0]["mesh"] = 7.into()), Err("there is no mesh 7".into()));
    assert_eq!(changed(|json| json["nodes"][0]["children"] = json!([0])), Err("node 0 is its own ancestor".into()));
    let packed = changed(|json| json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]));
    assert!(packed.unwrap_err().contains("without compression"));
    let far = changed(|json| json["nodes"][0]["scale"] = json!([3e38, 3e38, 3e38]));
    assert_eq!(far, Err("node 0 has a vertex that is not finite".into()));
    let many = changed(|json| json["accessors"][0]["count"] = 7_000_000.into());
    assert!(many.unwrap_err().contains("export a coarser set"));
}
