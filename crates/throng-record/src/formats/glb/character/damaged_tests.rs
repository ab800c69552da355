//! Tests of bodies of files that are damaged, incomplete or too large.

use super::read;
use super::tests::blocks::Blocks;
use super::tests::blocks::file::packed;
use super::tests::put;
use serde_json::{Value, json};

/// Returns the error of a changed file.
fn wrong(change: impl FnOnce(&mut Value, &mut Vec<u8>)) -> String {
    let (mut json, mut bin) = Blocks::default().parts();
    change(&mut json, &mut bin);
    let flaw = read(&packed(&json, &bin)).unwrap_err();
    assert!(flaw.hint.is_some_and(|hint| hint.contains("Mixamo")));
    flaw.why
}

#[test]
fn bad_files_are_errors_that_say_what_is_wrong() {
    for bytes in [&b""[..], b"glTF", b"solid cube", b"{}", b"{ \"nodes\": 3 }"] {
        read(bytes).unwrap_err();
    }
    assert_eq!(wrong(|json, _| json["skins"] = json!([])), "the file has no skin: no joints move its mesh");
    assert_eq!(wrong(|json, _| json["nodes"] = json!([])), "the file has no skin: no joints move its mesh");
    let lost = wrong(|json, _| {
        json["nodes"][5]["name"] = "Kopf".into();
        json["nodes"][13]["name"] = "Bein".into();
    });
    assert!(lost.starts_with("missing joints: Head, LeftLeg; the joints of the file: Hips, Spine,"), "{lost}");
    assert!(lost.contains("Kopf"), "{lost}");
    let two = wrong(|json, _| json["nodes"][5]["name"] = "mixamorig:Hips".into());
    assert!(two.starts_with("two joints are Hips: `Hips` (node 1) and `mixamorig:Hips` (node 5)"), "{two}");
    let cycle = wrong(|json, _| json["nodes"][5]["children"] = json!([2]));
    assert!(cycle.ends_with("is its own ancestor"), "{cycle}");
    assert_eq!(wrong(|json, _| json["nodes"][5]["children"] = json!([999])), "there is no node 999");
    let mirrored = wrong(|json, _| json["nodes"][0]["matrix"][0] = (-1.0).into());
    assert!(mirrored.contains("mirrors the mesh") && mirrored.contains("negative determinant"), "{mirrored}");
    let flat = wrong(|json, _| json["nodes"][0]["matrix"][0] = 0.0.into());
    assert!(flat.contains("flattens the mesh"), "{flat}");
    let far = wrong(|json, _| json["nodes"][1]["translation"] = json!([1e300, 1e300, 0.0]));
    assert!(far.contains("0.0000 m tall"), "{far}");
    let huge = wrong(|json, _| {
        json["nodes"][0]["matrix"][0] = 1e300.into();
        json["nodes"][1]["translation"] = json!([1e300, 1e300, 0.0]);
    });
    assert!(huge.contains("the transform of node"), "{huge}");
    let empty = wrong(|json, _| json["meshes"][0]["primitives"] = json!([]));
    assert!(empty.starts_with("the body has 0 vertices and 0 triangles"), "{empty}");
    let strips = wrong(|json, _| json["meshes"][0]["primitives"][0]["mode"] = 5.into());
    assert!(strips.contains("export plain triangles"), "{strips}");
    let packed = wrong(|json, _| json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]));
    assert!(packed.contains("without compression"), "{packed}");
    let tall = wrong(|json, _| {
        for k in [0, 5, 10] {
            json["nodes"][0]["matrix"][k] = 100.0.into();
        }
    });
    assert!(tall.contains("m tall") && tall.contains("scale it before export"), "{tall}");
    let said = wrong(|json, _| {
        json["extensions"] = json!({ "VRMC_vrm": { "humanoid": { "humanBones": { "hips": { "node": 4000 } } } } });
    });
    assert!(said.contains("node 4000, which does not exist"), "{said}");
}

#[test]
fn bad_numbers_are_errors_that_say_where() {
    let attributes = |json: &Value, name: &str| json["meshes"][0]["primitives"][0]["attributes"][name].clone();
    let nan = wrong(|json, bin| put(json, bin, &attributes(json, "POSITION"), 24, &f32::NAN.to_le_bytes()));
    assert!(nan.ends_with("holds a number that is not finite"), "{nan}");
    let nan = wrong(|json, bin| {
        put(json, bin, &json["skins"][0]["inverseBindMatrices"].clone(), 0, &f32::INFINITY.to_le_bytes())
    });
    assert!(nan.ends_with("holds a number that is not finite"), "{nan}");
    let outside = wrong(|json, bin| put(json, bin, &attributes(json, "JOINTS_0"), 8, &[77]));
    assert_eq!(outside, "vertex 2 of skin 0: it names joint 77 of 19");
    for weight in [0.0_f32, -1.0] {
        let none = wrong(|json, bin| put(json, bin, &attributes(json, "WEIGHTS_0"), 0, &weight.to_le_bytes()));
        assert!(none.starts_with("vertex 0 of skin 0: it has no weight"), "{none}");
    }
    let index =
        wrong(|json, bin| put(json, bin, &json["meshes"][0]["primitives"][0]["indices"].clone(), 0, &[255, 255]));
    assert!(index.starts_with("a triangle names vertex 65535"), "{index}");
    for count in [4_000_001, u64::MAX] {
        let many = wrong(|json, _| json["accessors"][0]["count"] = count.into());
        assert!(many.contains("or 4000000 vertices"), "{many}");
    }
    let many = wrong(|json, _| json["accessors"][5]["count"] = 2_000_000.into());
    assert!(many.contains("more than 400000 triangles"), "{many}");
    let many = wrong(|json, _| json["accessors"][0]["count"] = 100_000.into());
    assert!(many.contains("reads beyond the end"), "{many}");
    let few = wrong(|json, _| json["accessors"][3]["count"] = 5.into());
    assert!(few.contains("but 5 values of JOINTS_0"), "{few}");
    let few = wrong(|json, _| json["accessors"][6]["count"] = 5.into());
    assert!(few.contains("19 joints, but 5 inverse bind matrices"), "{few}");
    let many = wrong(|json, _| json["skins"][0]["joints"].as_array_mut().unwrap().extend(vec![json!(1); 5000]));
    assert_eq!(many, "skin 0 has more than 4096 joints");
    let many = wrong(|json, _| {
        let node = json["nodes"].as_array().unwrap().last().unwrap().clone();
        json["nodes"].as_array_mut().unwrap().extend(vec![node; 1024]);
    });
    assert!(many.contains("more than 1024 parts") || many.contains("200000 vertices"), "{many}");
    let loose = wrong(|json, _| {
        let attributes = json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap();
        attributes.retain(|name, _| !name.starts_with("JOINTS"));
    });
    assert_eq!(loose, "a mesh with a skin has no joints and weights");
    let skin = wrong(|json, _| json["skins"][0]["joints"][18] = (-1).into());
    assert!(skin.contains("missing joints: RightToeBase") || skin.contains("does not exist"), "{skin}");
}
