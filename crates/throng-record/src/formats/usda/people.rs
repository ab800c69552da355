//! Writes people as skeletons ([UsdSkel](https://openusd.org/release/api/usd_skel_page_front.html)).
//!
//! The `SkelRoot` of a person is where its hips are, so the translations and scales of its joints are constant. All
//! three of translations, rotations and scales are written: readers ignore an animation that lacks one.

use super::text::{indented, list, quoted, tuple};
use crate::color::light;
use crate::formats::spill::SpilledState;
use glam::{DQuat, DVec3, Vec3};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use throng_figure::{Build, JOINTS, Joint, Level, Look, Mesh, Person, Pose, Region, Skeleton, Walk};

/// The paths of the bodies and of their material.
const BODIES: &str = "/World/People/Bodies";
const MATERIAL: &str = "/World/People/Look";
/// Joints that move a vertex.
const JOINTS_OF_VERTEX: usize = 2;
/// Decimals of positions (m), of weights and normals, and of rotations.
const PLACE: usize = 5;
const SHADE: usize = 3;
const TURN: usize = 5;

/// Returns the beginning of the prim of all people: their material and the bodies that they refer to.
pub fn bodies(people: &[Person]) -> String {
    let mut looks: BTreeMap<&str, (Build, Vec<u8>)> = BTreeMap::new();
    for person in people {
        let (_, looks) = looks.entry(person.build.name()).or_insert((person.build, Vec::new()));
        looks.push(person.look);
    }
    let mut text = String::from("\ndef Scope \"People\"\n{\n");
    text.push_str(&indented(&material(), "    "));
    text.push_str("\n    class Scope \"Bodies\"\n    {\n");
    for (build, (known, mut looks)) in looks {
        let mesh = Mesh::new(known, Level::Fine);
        text.push_str(&indented(&body(build, known, &mesh), "        "));
        looks.sort_unstable();
        looks.dedup();
        // looks that wear the same share the triangles
        let mut cuts: Vec<Vec<Region>> = Vec::new();
        for number in looks {
            let look = Look::new(number);
            let worn = mesh.worn(&look);
            let cut = cuts.iter().position(|known| *known == worn).unwrap_or_else(|| {
                cuts.push(worn);
                text.push_str(&indented(&faces(build, cuts.len() - 1, &mesh.triangles_of(&look)), "        "));
                cuts.len() - 1
            });
            let color = |out: &mut String, [r, g, b]: [u8; 3]| tuple(out, [r, g, b].map(|c| light(c).into()), SHADE);
            let colors = list(mesh.colours(&look).into_iter(), color);
            let dressed = format!(
                "
def SkelRoot \"{build}_{number}\" (
    prepend references = <{BODIES}/{build}_cut_{cut}>
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

/// Returns a body of a build with the triangles of what some looks wear.
fn faces(build: &str, cut: usize, triangles: &[[u32; 3]]) -> String {
    let corners = list(triangles.iter().flatten(), |out, at| out.push_str(&at.to_string()));
    let counts = list(triangles.iter(), |out, _| out.push('3'));
    format!(
        "
def SkelRoot \"{build}_cut_{cut}\" (
    prepend references = <{BODIES}/{build}>
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

/// Returns the skeleton and the vertices of a build, in the pose at rest, with the hips at the origin and a height of 1 m.
fn body(name: &str, build: Build, mesh: &Mesh) -> String {
    let skeleton = Skeleton::scaled(build, 1.0);
    let rest = skeleton.world(&skeleton.rest()).map(|joint| joint.position);
    let hips = rest[Joint::Hips.index()];
    let matrix = |out: &mut String, place: DVec3| {
        out.push_str("((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), ");
        tuple(out, place.extend(1.0).to_array(), PLACE + 1);
        out.push(')');
    };
    let binds = list(rest.iter(), |out, &place| matrix(out, place - hips));
    let rests = list(offsets(build).iter(), |out, &offset| matrix(out, offset));
    let vector = |decimals| move |out: &mut String, at: Vec3| tuple(out, at.to_array().map(f64::from), decimals);
    let points = || mesh.positions.iter().map(|&point| (point.as_dvec3() - hips).as_vec3());
    let within = |of: fn(Vec3, Vec3) -> Vec3| points().reduce(of).unwrap_or_default();
    let extent = list([within(Vec3::min), within(Vec3::max)].into_iter(), vector(PLACE));
    let whole = |out: &mut String, at: &u8| out.push_str(&at.to_string());
    let numbers = list(mesh.joints.iter().flat_map(|of| &of[..JOINTS_OF_VERTEX]), whole);
    let parts = |weights: &[f32; 4]| {
        let first = (f64::from(weights[0]) * 1e3).round() / 1e3;
        [first, ((1.0 - first) * 1e3).round() / 1e3]
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
            elementSize = {JOINTS_OF_VERTEX}
            interpolation = \"vertex\"
        )
        float[] primvars:skel:jointWeights = {weights} (
            elementSize = {JOINTS_OF_VERTEX}
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

/// Returns a person. `codes` and `times` are those of all frames.
pub fn person(agent: u32, walk: &Walk, track: &[(u32, SpilledState)], (codes, times): (&[f64], &[f64])) -> String {
    let person = walk.person();
    let (build, look, height) = (person.build.name(), person.look, person.height);
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
    let translations = list(offsets(person.build).into_iter(), |out, offset| tuple(out, offset.to_array(), PLACE + 1));
    let scales = list(0..JOINTS, |out, _| out.push_str("(1, 1, 1)"));
    let path = format!("/World/People/Agent_{agent}");
    let (joints, build_text) = (joints(), quoted(build));
    format!(
        "
def SkelRoot \"Agent_{agent}\" (
    prepend apiSchemas = [\"SkelBindingAPI\", \"MaterialBindingAPI\"]
    prepend references = <{BODIES}/{build}_{look}>
)
{{
    rel material:binding = <{MATERIAL}>
    rel skel:animationSource = <{path}/Walk>
    custom string throng:build = {build_text}
    custom double throng:height = {height}
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

/// Returns the offsets of the joints for a height of 1 m, against the hips.
fn offsets(build: Build) -> [DVec3; JOINTS] {
    let skeleton = Skeleton::scaled(build, 1.0);
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
