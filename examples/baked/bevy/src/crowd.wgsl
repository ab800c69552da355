// Moves the vertices of people by poses that stay on the graphics processor.
#import bevy_pbr::mesh_functions::{get_tag, get_world_from_local, mesh_normal_local_to_world}
#import bevy_pbr::view_transformations::position_world_to_clip
#ifdef PREPASS_PIPELINE
#import bevy_pbr::prepass_io::VertexOutput
#else
#import bevy_pbr::forward_io::VertexOutput
#endif

struct Person {
    // the first rotations of the poses before and after, and the share of the way between them
    before: u32,
    after: u32,
    share: f32,
    // the first colour of the look, the first joint of the body
    colours: u32,
    joints: u32,
}

// lengths are those of a height of 1 m; the transform of the person has the hips and the height
struct Joint {
    offset: vec3<f32>,
    parent: i32,
    rest: vec3<f32>,
}

struct Vertex {
    @builtin(instance_index) instance_index: u32,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) colour: vec4<f32>,
    @location(3) region: i32,
    @location(4) joints: vec4<u32>,
    @location(5) weights: vec4<f32>,
}

@group(#{MATERIAL_BIND_GROUP}) @binding(100) var<storage, read> people: array<Person>;
@group(#{MATERIAL_BIND_GROUP}) @binding(101) var<storage, read> joints: array<Joint>;
@group(#{MATERIAL_BIND_GROUP}) @binding(102) var<storage, read> turns: array<vec2<u32>>;
// not worn where alpha is 0
@group(#{MATERIAL_BIND_GROUP}) @binding(103) var<storage, read> colours: array<vec4<f32>>;

// The most joints on the way to the hips. With loops of unknown length Mesa 22's software driver displaces vertices.
const STEPS: i32 = 8;

fn rotated(q: vec4<f32>, v: vec3<f32>) -> vec3<f32> {
    return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}

fn turn(at: u32) -> vec4<f32> {
    return vec4(unpack2x16snorm(turns[at].x), unpack2x16snorm(turns[at].y));
}

// The rotation of a joint, from the axes of the body to those of the file.
fn turned(person: Person, joint: u32) -> vec4<f32> {
    let a = turn(person.before + joint);
    let b = turn(person.after + joint);
    return normalize(mix(a, select(b, -b, dot(a, b) < 0.0), person.share));
}

// The place of a joint, from the hips.
fn placed(person: Person, joint: u32) -> vec3<f32> {
    var at = vec3(0.0);
    var below = joint;
    for (var k = 0; k < STEPS; k++) {
        let step = joints[person.joints + below];
        if step.parent < 0 {
            break;
        }
        below = u32(step.parent);
        at += rotated(turned(person, below), step.offset);
    }
    return at;
}

@vertex
fn vertex(vertex: Vertex) -> VertexOutput {
    let person = people[get_tag(vertex.instance_index)];
    var position = vec3(0.0);
    var normal = vec3(0.0);
    for (var k = 0; k < 4; k++) {
        let weight = vertex.weights[k];
        if weight > 0.0 {
            let joint = vertex.joints[k];
            let rotation = turned(person, joint);
            let arm = vertex.position - joints[person.joints + joint].rest;
            position += weight * (placed(person, joint) + rotated(rotation, arm));
            normal += weight * rotated(rotation, vertex.normal);
        }
    }
    var colour = vertex.colour;
    if vertex.region >= 0 {
        colour = colours[person.colours + u32(vertex.region)];
        if colour.a == 0.0 {
            // all vertices in one place: the triangles have no area
            position = vec3(0.0);
        }
    }

    var out: VertexOutput;
    out.world_position = get_world_from_local(vertex.instance_index) * vec4(position, 1.0);
    out.position = position_world_to_clip(out.world_position.xyz);
    out.color = colour;
#ifdef PREPASS_PIPELINE
#ifdef UNCLIPPED_DEPTH_ORTHO_EMULATION
    out.unclipped_depth = out.position.z;
    out.position.z = min(out.position.z, 1.0);
#endif
#ifdef NORMAL_PREPASS_OR_DEFERRED_PREPASS
    out.world_normal = mesh_normal_local_to_world(normal, vertex.instance_index);
#endif
#ifdef MOTION_VECTOR_PREPASS
    // the poses of the last picture are not known
    out.previous_world_position = out.world_position;
#endif
#else
    out.world_normal = mesh_normal_local_to_world(normal, vertex.instance_index);
#endif
#ifdef VERTEX_OUTPUT_INSTANCE_INDEX
    out.instance_index = vertex.instance_index;
#endif
    return out;
}
