//! Tests that need no graphics processor.

use crate::crowd::BakedCrowd;
use crate::glb::Glb;
use bevy::math::Vec3;
use naga_oil::compose::{
    ComposableModuleDescriptor, Composer, ComposerError, NagaModuleDescriptor, ShaderDefValue, ShaderType,
};
use serde_json::{Value, json};
use std::f32::consts::FRAC_1_SQRT_2;
use std::io::Cursor;

/// A file from its description and its buffer.
fn glb(json: &Value, bin: &[u8]) -> Vec<u8> {
    let mut json = json.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let len = |bytes: usize| (bytes as u32).to_le_bytes();
    let total = len(28 + json.len() + bin.len());
    let parts: [&[u8]; 9] =
        [b"glTF", &len(2), &total, &len(json.len()), b"JSON", &json, &len(bin.len()), b"BIN\0", bin];
    parts.concat()
}

/// One person of three joints and of a height of 2 m, there in the frames 1 and 2 of four.
fn person() -> (Value, Vec<u8>) {
    let (mut bin, mut views) = (Vec::new(), Vec::new());
    let mut view = |bytes: Vec<u8>| {
        views.push(json!({ "buffer": 0, "byteOffset": bin.len(), "byteLength": bytes.len() }));
        bin.extend(bytes);
        bin.resize(bin.len().next_multiple_of(8), 0);
    };
    let floats = |all: &[f32]| all.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<_>>();
    view([0.0_f64, 0.5, 1.0, 1.5].iter().flat_map(|second| second.to_le_bytes()).collect());
    view(floats(&[5.0, 1.0, -3.0, 6.0, 1.0, -3.0]));
    let quarter = (FRAC_1_SQRT_2 * 32767.0).round() as i16;
    let turns: [[i16; 4]; 6] = [
        // a quarter around y, a quarter around x, none
        [0, quarter, 0, quarter],
        [quarter, 0, 0, quarter],
        [0, 0, 0, 32767],
        // the same quarter around y with other signs, none, none
        [0, -quarter, 0, -quarter],
        [0, 0, 0, 32767],
        [0, 0, 0, 32767],
    ];
    view(turns.as_flattened().iter().flat_map(|part| part.to_le_bytes()).collect());
    view(floats(&[0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 1.0, 0.0]));
    view(floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]));
    view(vec![0, 0, 0, 0, 1, 2, 0, 0, 2, 0, 0, 0]);
    view(vec![255, 0, 0, 0, 51, 204, 0, 0, 255, 0, 0, 0]);
    view(floats(&[0.0, 0.0, 1.0]));
    view(vec![0, 0, 1, 0, 2, 0]);
    let accessor = |view: usize, of: u32, count: usize, kind: &str| {
        let mut all = json!({ "bufferView": view, "componentType": of, "type": kind });
        all["count"] = count.into();
        all
    };
    let mut weights = accessor(6, 5121, 3, "VEC4");
    weights["normalized"] = true.into();
    let attributes = json!({ "POSITION": 0, "NORMAL": 1, "JOINTS_0": 2, "WEIGHTS_0": 3, "_REGION": 4 });
    let baked = json!({
        "joints": ["Hips", "Spine", "Head"],
        "parents": [-1, 0, 1],
        "bodies": [{ "build": "woman", "offsets": [[0, 0.5, 0], [0, 0.1, 0.02], [0.03, 0.3, 0]], "levels": [0] }],
        "looks": [[[0.2, 0.3, 0.4], null]],
        "hips": 1,
        "rotations": 2,
        "people": [{ "number": 7, "body": 0, "look": 0, "height": 2.0, "visits": [[1, 2, 0]] }],
    });
    let json = json!({
        "asset": { "version": "2.0", "extras": { "throng.times": 0, "throng.baked": baked } },
        "meshes": [{ "primitives": [{ "attributes": attributes, "indices": 5 }] }],
        "accessors": [
            accessor(3, 5126, 3, "VEC3"),
            accessor(4, 5126, 3, "VEC3"),
            accessor(5, 5121, 3, "VEC4"),
            weights,
            accessor(7, 5126, 3, "SCALAR"),
            accessor(8, 5123, 3, "SCALAR"),
        ],
        "bufferViews": views,
    });
    (json, bin)
}

fn read(json: &Value, bin: &[u8]) -> Result<BakedCrowd, String> {
    BakedCrowd::read(Cursor::new(glb(json, bin)))
}

#[test]
fn numbers_of_all_types() {
    let bin: Vec<u8> = [[1, 255, 0, 1, 2, 0, 0, 0], [0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0]].concat();
    let accessor = |at: usize, of: u32, normalized: bool, kind: &str| {
        let mut all = json!({ "bufferView": 0, "byteOffset": at, "componentType": of, "count": 1, "type": kind });
        all["normalized"] = normalized.into();
        all
    };
    let accessors = [
        accessor(0, 5121, false, "VEC2"),
        accessor(0, 5121, true, "VEC2"),
        accessor(2, 5123, false, "SCALAR"),
        accessor(4, 5125, false, "SCALAR"),
        accessor(8, 5126, false, "VEC2"),
        accessor(12, 5126, false, "VEC2"),
    ];
    let views = [json!({ "byteLength": 16 })];
    let json = json!({ "asset": {}, "accessors": accessors, "bufferViews": views });
    let mut glb = Glb::read(Cursor::new(glb(&json, &bin))).unwrap();
    assert_eq!(glb.numbers::<2>(0), Ok(vec![[1.0, 255.0]]));
    assert_eq!(glb.numbers::<2>(1), Ok(vec![[1.0 / 255.0, 1.0]]));
    assert_eq!(glb.numbers::<1>(2), Ok(vec![[256.0]]));
    assert_eq!(glb.numbers::<1>(3), Ok(vec![[2.0]]));
    assert_eq!(glb.numbers::<2>(4), Ok(vec![[1.0, -2.0]]));
    assert!(glb.numbers::<2>(5).is_err_and(|error| error.contains("beyond its view")));
    assert!(glb.numbers::<3>(0).is_err_and(|error| error.contains("VEC2")));
}

/// The places follow from the quarters by hand: around y (x, y, z) becomes (z, y, -x), around x it becomes (x, -z, y).
#[test]
fn joints_are_where_the_rotations_put_them() {
    let (json, bin) = person();
    let crowd = read(&json, &bin).unwrap();
    assert_eq!((crowd.people(), crowd.duration(), crowd.joint("Head")), (1, 1.5, Some(2)));
    let hips = Vec3::new(5.0, 1.0, -3.0);
    let spine = hips + 2.0 * Vec3::new(0.02, 0.1, 0.0);
    let head = spine + 2.0 * Vec3::new(0.03, 0.0, 0.3);
    // half of the way to the second pose the hips are 0.5 m on, and the quarter around x is an eighth
    let later = Vec3::new(0.5, 0.0, 0.0);
    let half = spine + later + 2.0 * Vec3::new(0.03, 0.3 * FRAC_1_SQRT_2, 0.3 * FRAC_1_SQRT_2);
    for (joint, second, place) in [
        (0, 0.5, hips),
        (1, 0.5, spine),
        (2, 0.5, head),
        (0, 0.75, hips + later),
        (1, 0.75, spine + later),
        (2, 0.75, half),
    ] {
        let found = crowd.place(0, joint, second).unwrap();
        assert!(found.distance(place) < 1e-4, "joint {joint} at {second} s: {found}, not {place}");
    }
    assert_eq!((crowd.place(0, 0, 0.49), crowd.place(0, 0, 1.5)), (None, None));
    assert!(crowd.place(0, 2, 1.49).is_some());
}

#[test]
fn damaged_files_are_refused() {
    let (json, bin) = person();
    let whole = glb(&json, &bin);
    for len in 0..whole.len() {
        assert!(BakedCrowd::read(Cursor::new(&whole[..len])).is_err(), "the first {len} bytes");
    }
    let people = "/asset/extras/throng.baked/people/0";
    for (at, value) in [
        (format!("{people}/body"), json!(1)),
        (format!("{people}/look"), json!(1)),
        (format!("{people}/visits"), json!([[1, 3, 0]])),
        (format!("{people}/visits"), json!([[1, u64::MAX, 1]])),
        ("/asset/extras/throng.baked/parents".to_owned(), json!([-1, 2, 1])),
        ("/asset/extras/throng.baked/looks".to_owned(), json!([[null]])),
        ("/asset/extras/throng.baked/hips".to_owned(), json!(99)),
        ("/accessors/0/count".to_owned(), json!(2)),
        ("/accessors/0/bufferView".to_owned(), json!(7)),
        ("/bufferViews/8/byteOffset".to_owned(), json!(u64::MAX)),
    ] {
        let mut json = json.clone();
        *json.pointer_mut(&at).unwrap_or_else(|| panic!("{at}")) = value.clone();
        assert!(read(&json, &bin).is_err(), "{at} = {value}");
    }
}

#[test]
fn files_without_baked_people_say_so() {
    let plain = json!({ "asset": { "version": "2.0" } });
    let error = read(&plain, &[]).err().unwrap_or_default();
    assert!(error.contains("--figures baked"), "{error}");
    let text = BakedCrowd::read(Cursor::new(b"solid nothing at all")).err().unwrap_or_default();
    assert!(text.contains("no .glb file"), "{text}");
    let missing = BakedCrowd::open("missing.glb".as_ref()).err().unwrap_or_default();
    assert!(missing.starts_with("missing.glb: "), "{missing}");
}

/// What the shader imports from Bevy, with the same types.
const IMPORTED: [&str; 4] = [
    "#define_import_path bevy_pbr::mesh_functions
    fn get_tag(instance: u32) -> u32 { return instance; }
    fn get_world_from_local(instance: u32) -> mat4x4<f32> { return mat4x4<f32>(); }
    fn mesh_normal_local_to_world(normal: vec3<f32>, instance: u32) -> vec3<f32> { return normal; }",
    "#define_import_path bevy_pbr::view_transformations
    fn position_world_to_clip(place: vec3<f32>) -> vec4<f32> { return vec4(place, 1.0); }",
    "#define_import_path bevy_pbr::forward_io
    struct VertexOutput {
        @builtin(position) position: vec4<f32>,
        @location(0) world_position: vec4<f32>,
        @location(1) world_normal: vec3<f32>,
        @location(5) color: vec4<f32>,
        @location(6) @interpolate(flat) instance_index: u32,
    }",
    "#define_import_path bevy_pbr::prepass_io
    struct VertexOutput {
        @builtin(position) position: vec4<f32>,
        @location(2) world_normal: vec3<f32>,
        @location(4) world_position: vec4<f32>,
        @location(5) previous_world_position: vec4<f32>,
        @location(6) unclipped_depth: f32,
        @location(7) instance_index: u32,
        @location(8) color: vec4<f32>,
    }",
];

#[test]
fn the_shader_is_valid() {
    let all = [
        "PREPASS_PIPELINE",
        "VERTEX_OUTPUT_INSTANCE_INDEX",
        "UNCLIPPED_DEPTH_ORTHO_EMULATION",
        "NORMAL_PREPASS_OR_DEFERRED_PREPASS",
        "MOTION_VECTOR_PREPASS",
    ];
    let valid = |defines: &[&str]| -> Result<(), Box<ComposerError>> {
        let mut composer = Composer::default();
        for source in IMPORTED {
            composer.add_composable_module(ComposableModuleDescriptor { source, ..Default::default() })?;
        }
        let defines = defines.iter().map(|&name| (name.to_owned(), ShaderDefValue::Bool(true)));
        let group = ("MATERIAL_BIND_GROUP".to_owned(), ShaderDefValue::UInt(3));
        composer.make_naga_module(NagaModuleDescriptor {
            source: include_str!("crowd.wgsl"),
            file_path: "crowd.wgsl",
            shader_type: ShaderType::Wgsl,
            shader_defs: defines.chain([group]).collect(),
            additional_imports: &[],
        })?;
        Ok(())
    };
    for defines in [&[][..], &all[1..2], &all[..1], &all[..2], &all] {
        assert!(valid(defines).is_ok(), "{defines:?}: {:?}", valid(defines));
    }
}
