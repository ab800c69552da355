//! Writes people as skeletons ([UsdSkel](https://openusd.org/release/api/usd_skel_page_front.html)).
//!
//! The `SkelRoot` of a person is where its hips are, so the translations and scales of its joints are constant. All
//! three of translations, rotations and scales are written: readers ignore an animation that lacks one.

use super::text::{indented, list, quoted, tuple};
use crate::color::light;
use crate::formats::spill::SpilledState;
use crate::people::PersonBody;
use glam::{DMat4, DQuat, DVec3, Vec3};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use throng_figure::{JOINTS, Joint, Mesh, Pose, Region, Skeleton, Walk};

/// The paths of the bodies and of their material.
const BODIES: &str = "/World/People/Bodies";
const MATERIAL: &str = "/World/People/Look";
/// The lengths of the legs of a person with the body of a file, in heights.
pub const LEGS: &str = "throng:legs";
/// Decimals of positions (m), of weights and normals, and of rotations.
const PLACE: usize = 5;
const SHADE: usize = 3;
const TURN: usize = 5;

/// Returns the beginning of the prim of all people: their material and the bodies that they refer to.
pub fn bodies<'a>(worn: impl Iterator<Item = PersonBody<'a>>) -> String {
    let mut looks: BTreeMap<String, (PersonBody<'_>, BTreeSet<u8>)> = BTreeMap::new();
    for body in worn {
        looks.entry(named(body)).or_insert((body, BTreeSet::new())).1.insert(body.look());
    }
    let mut text = String::from("\ndef Scope \"People\"\n{\n");
    text.push_str(&indented(&material(), "    "));
    text.push_str("\n    class Scope \"Bodies\"\n    {\n");
    for (name, (known, looks)) in looks {
        let mesh = known.mesh();
        text.push_str(&indented(&shape(&name, &known.skeleton(1.0), &mesh), "        "));
        // looks that wear the same share the triangles
        let mut cuts: Vec<Vec<Region>> = Vec::new();
        for look in looks {
            let body = known.with_look(look);
            let worn = body.worn(&mesh);
            let cut = cuts.iter().position(|known| *known == worn).unwrap_or_else(|| {
                cuts.push(worn);
                text.push_str(&indented(&faces(&name, cuts.len() - 1, &body.triangles(&mesh)), "        "));
                cuts.len() - 1
            });
            let color = |out: &mut String, [r, g, b]: [u8; 3]| tuple(out, [r, g, b].map(|c| light(c).into()), SHADE);
            let colors = list(body.colours(&mesh).iter().copied(), color);
            let dressed = format!(
                "
def SkelRoot \"{name}_{look}\" (
    prepend references = <{BODIES}/{name}_cut_{cut}>
)
{{
    over \"Body\"
    {{
        color3f[] primvars:displayColor = {colors} (
            interpolation = \"vertex\"
        )
    }}
}}
"
            );
            text.push_str(&indented(&dressed, "        "));
        }
    }
    text.push_str("    }\n");
    indented(&text, "    ")
}

/// Returns the name of the prim of a body.
fn named(body: PersonBody<'_>) -> String {
    body.name().replace(' ', "_")
}

/// Returns the material of all people, which has the colours of the vertices.
fn material() -> String {
    format!(
        "
def Material \"Look\"
{{
    token outputs:surface.connect = <{MATERIAL}/Surface.outputs:surface>

    def Shader \"Surface\"
    {{
        uniform token info:id = \"UsdPreviewSurface\"
        color3f inputs:diffuseColor.connect = <{MATERIAL}/Colours.outputs:result>
        float inputs:roughness = 0.85
        token outputs:surface
    }}

    def Shader \"Colours\"
    {{
        uniform token info:id = \"UsdPrimvarReader_float3\"
        string inputs:varname = \"displayColor\"
        float3 outputs:result
    }}
}}
"
    )
}

/// Returns a body with the triangles of what some looks wear.
fn faces(name: &str, cut: usize, triangles: &[[u32; 3]]) -> String {
    let corners = list(triangles.iter().flatten(), |out, at| out.push_str(&at.to_string()));
    let counts = list(triangles.iter(), |out, _| out.push('3'));
    format!(
        "
def SkelRoot \"{name}_cut_{cut}\" (
    prepend references = <{BODIES}/{name}>
)
{{
    over \"Body\"
    {{
        int[] faceVertexCounts = {counts}
        int[] faceVertexIndices = {corners}
    }}
}}
"
    )
}

/// Returns the skeleton and the vertices of a body, as it was modelled, with the hips at the origin and a height of 1 m.
fn shape(name: &str, skeleton: &Skeleton, mesh: &Mesh) -> String {
    let hips = skeleton.offset(Joint::Hips);
    let matrix = |out: &mut String, moves: DMat4| {
        out.push('(');
        for axis in [moves.x_axis, moves.y_axis, moves.z_axis] {
            tuple(out, axis.to_array(), PLACE + 1);
            out.push_str(", ");
        }
        tuple(out, moves.w_axis.to_array(), PLACE + 1);
        out.push(')');
    };
    let from_hips = DMat4::from_translation(-hips);
    let binds = list(skeleton.bind_matrices().into_iter(), |out, bind| matrix(out, from_hips * bind));
    let rests = list(offsets(skeleton).into_iter(), |out, offset| matrix(out, DMat4::from_translation(offset)));
    let vector = |decimals| move |out: &mut String, at: Vec3| tuple(out, at.to_array().map(f64::from), decimals);
    let points = || mesh.positions.iter().map(|&point| (point.as_dvec3() - hips).as_vec3());
    let within = |of: fn(Vec3, Vec3) -> Vec3| points().reduce(of).unwrap_or_default();
    let extent = list([within(Vec3::min), within(Vec3::max)].into_iter(), vector(PLACE));
    let whole = |out: &mut String, at: &u8| out.push_str(&at.to_string());
    // joints without a weight are left out
    let most = (1..4).rev().find(|&k| mesh.weights.iter().any(|weights| weights[k] > 0.0)).unwrap_or(1) + 1;
    let numbers = list(mesh.joints.iter().flat_map(|of| &of[..most]), whole);
    let parts = |weights: &[f32; 4]| {
        let mut parts = weights.map(|weight| (f64::from(weight) * 1e3).round());
        // the sum is 1
        let largest = (0..most).fold(0, |largest, k| if parts[k] > parts[largest] { k } else { largest });
        parts[largest] += 1e3 - parts[..most].iter().sum::<f64>();
        parts.into_iter().take(most).map(|part| part / 1e3)
    };
    let weights = list(mesh.weights.iter().flat_map(parts), |out, part| out.push_str(&part.to_string()));
    let (points, normals) = (list(points(), vector(PLACE)), list(mesh.normals.iter().copied(), vector(SHADE)));
    let path = format!("{BODIES}/{name}");
    format!(
        "
def SkelRoot \"{name}\"
{{
    def Skeleton \"Skeleton\"
    {{
        uniform matrix4d[] bindTransforms = {binds}
        uniform token[] joints = {}
        uniform matrix4d[] restTransforms = {rests}
    }}

    def Mesh \"Body\" (
        prepend apiSchemas = [\"SkelBindingAPI\"]
    )
    {{
        float3[] extent = {extent}
        normal3f[] normals = {normals} (
            interpolation = \"vertex\"
        )
        point3f[] points = {points}
        matrix4d primvars:skel:geomBindTransform = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
        int[] primvars:skel:jointIndices = {numbers} (
            elementSize = {most}
            interpolation = \"vertex\"
        )
        float[] primvars:skel:jointWeights = {weights} (
            elementSize = {most}
            interpolation = \"vertex\"
        )
        rel skel:skeleton = <{path}/Skeleton>
        uniform token subdivisionScheme = \"none\"
    }}
}}
",
        joints()
    )
}

/// Returns a person with a body. `codes` and `times` are those of all frames.
pub fn person(
    agent: u32,
    (walk, body): (&Walk, PersonBody<'_>),
    track: &[(u32, SpilledState)],
    (codes, times): (&[f64], &[f64]),
) -> String {
    let person = walk.person();
    let (name, look, height) = (named(body), body.look(), person.height);
    let moments: Vec<usize> = track.iter().map(|&(moment, _)| moment as usize).collect();
    let mut poses: Vec<Pose> = Vec::with_capacity(moments.len());
    for &moment in &moments {
        // each with the sign closer to the one before, so that every reader interpolates along the shorter arc
        let pose = walk.pose(times[moment]);
        poses.push(poses.last().map_or(pose, |before| pose.near(before)));
    }
    let samples = |entry: &dyn Fn(&mut String, &Pose)| {
        let mut text = String::from("{\n");
        for (&moment, pose) in moments.iter().zip(&poses) {
            let _ = write!(text, "        {}: ", codes[moment]);
            entry(&mut text, pose);
            text.push_str(",\n");
        }
        text + "    }"
    };
    let places = samples(&|out, pose| tuple(out, pose.hips.to_array(), PLACE));
    let turns = samples(&|out, pose| turn(out, pose.rotations[Joint::Hips.index()]));
    // the hips turn with the prim
    let rotations = samples(&|out, pose| {
        let own = pose.rotations.iter().enumerate().map(|(k, &own)| if k == 0 { DQuat::IDENTITY } else { own });
        out.push_str(&list(own, turn));
    });
    let changes = presence(&moments, codes.len());
    let visible = changes.iter().map(|&(moment, there)| {
        format!("{}: {}", codes[moment], if there { "\"inherited\"" } else { "\"invisible\"" })
    });
    let visible = format!("{{ {} }}", visible.collect::<Vec<_>>().join(", "));
    let scale = scale(&changes, codes, height);
    let translations =
        list(offsets(&body.skeleton(1.0)).into_iter(), |out, offset| tuple(out, offset.to_array(), PLACE + 1));
    let scales = list(0..JOINTS, |out, _| out.push_str("(1, 1, 1)"));
    let path = format!("/World/People/Agent_{agent}");
    let (joints, build) = (joints(), quoted(person.build.name()));
    let legs = match body {
        PersonBody::Build(..) => String::new(),
        PersonBody::Character(..) => {
            let lengths = list(person.legs.lengths().into_iter(), |out, length| out.push_str(&length.to_string()));
            format!("\n    custom double[] {LEGS} = {lengths}")
        }
    };
    format!(
        "
def SkelRoot \"Agent_{agent}\" (
    prepend apiSchemas = [\"SkelBindingAPI\", \"MaterialBindingAPI\"]
    prepend references = <{BODIES}/{name}_{look}>
)
{{
    rel material:binding = <{MATERIAL}>
    rel skel:animationSource = <{path}/Walk>
    custom string throng:build = {build}
    custom double throng:height = {height}{legs}
    custom int64 throng:number = {agent}
    token visibility.timeSamples = {visible}
    quatf xformOp:orient.timeSamples = {turns}
    float3 xformOp:scale{scale}
    double3 xformOp:translate.timeSamples = {places}
    uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\", \"xformOp:scale\"]

    def SkelAnimation \"Walk\"
    {{
        uniform token[] joints = {joints}
        quatf[] rotations.timeSamples = {rotations}
        half3[] scales = {scales}
        float3[] translations = {translations}
    }}
}}
"
    )
}

/// Returns the offsets of the joints, against the hips.
fn offsets(skeleton: &Skeleton) -> [DVec3; JOINTS] {
    Joint::ALL.map(|joint| if joint == Joint::Hips { DVec3::ZERO } else { skeleton.offset(joint) })
}

/// Returns the paths of the joints.
fn joints() -> String {
    let mut paths: Vec<String> = Vec::new();
    for joint in Joint::ALL {
        let above = joint.parent().map(|parent| format!("{}/", paths[parent.index()])).unwrap_or_default();
        paths.push(above + joint.name());
    }
    list(paths.iter(), |out, path| out.push_str(&quoted(path)))
}

/// Writes a rotation, the real part first.
fn turn(out: &mut String, rotation: DQuat) {
    let DQuat { x, y, z, w } = rotation;
    tuple(out, [w, x, y, z], TURN);
}

/// Returns the value of the scale of a person: its height, and 0 while it is away, for programs that ignore visibility.
fn scale(changes: &[(usize, bool)], codes: &[f64], height: f64) -> String {
    let size = |there: bool| if there { format!("({height}, {height}, {height})") } else { "(0, 0, 0)".to_owned() };
    if changes.len() < 2 {
        return format!(" = {}", size(true));
    }
    let mut text = String::from(".timeSamples = { ");
    for (k, &(moment, there)) in changes.iter().enumerate() {
        if k > 0 {
            // readers interpolate: the size changes within a thousandth of a frame
            let shortly = codes[moment] - 1e-3 * (codes[moment] - codes[moment - 1]);
            if shortly > codes[moment - 1] && shortly < codes[moment] {
                let _ = write!(text, ", {shortly}: {}", size(!there));
            }
            text.push_str(", ");
        }
        let _ = write!(text, "{}: {}", codes[moment], size(there));
    }
    text + " }"
}

/// Returns the frames at which a person appears or disappears, the first frame included, and whether it is there from
/// each on.
fn presence(moments: &[usize], frames: usize) -> Vec<(usize, bool)> {
    let mut changes = Vec::new();
    if moments.first().is_some_and(|&first| first > 0) {
        changes.push((0, false));
    }
    for run in moments.chunk_by(|a, b| a + 1 == *b) {
        changes.extend([(run[0], true), (run[0] + run.len(), false)]);
    }
    changes.retain(|&(moment, _)| moment < frames);
    changes
}
