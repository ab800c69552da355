//! Draws the people of a `.glb` that `throng run SCENE --figures baked -o run.glb` wrote.
//!
//! The poses stay on the graphics processor. For each person a picture needs two numbers of poses and the share of the
//! way between them. People of the same body and level of detail are instances of one mesh.

use crate::glb::{self, Baked, Glb, Primitive};
use bevy::asset::{RenderAssetUsages, load_internal_asset, uuid_handle};
use bevy::camera::primitives::Aabb;
use bevy::camera::visibility::NoAutoAabb;
use bevy::math::Vec3A;
use bevy::mesh::{
    Indices, MeshTag, MeshVertexAttribute, MeshVertexBufferLayoutRef, PrimitiveTopology, VertexAttributeValues,
};
use bevy::pbr::{ExtendedMaterial, MaterialExtension, MaterialExtensionKey, MaterialExtensionPipeline};
use bevy::prelude::*;
use bevy::render::render_resource::{
    AsBindGroup, RenderPipelineDescriptor, ShaderType, SpecializedMeshPipelineError, VertexFormat,
};
use bevy::render::renderer::RenderDevice;
use bevy::render::storage::ShaderBuffer;
use bevy::shader::ShaderRef;
use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

const SHADER: Handle<Shader> = uuid_handle!("5d0f9c1e-6a43-4b7e-9a5b-0c6f1f7b2d38");

/// The region of a vertex; -1 where the vertex has a colour of its own.
const REGION: MeshVertexAttribute = MeshVertexAttribute::new("BakedRegion", 7_402_118_341, VertexFormat::Sint32);
const JOINTS: MeshVertexAttribute = MeshVertexAttribute::new("BakedJoints", 7_402_118_342, VertexFormat::Uint8x4);
const WEIGHTS: MeshVertexAttribute = MeshVertexAttribute::new("BakedWeights", 7_402_118_343, VertexFormat::Float32x4);

/// The most joints on the way to the hips that the shader follows; throng's people have five.
const STEPS: usize = 8;

/// Draws each [`BakedCrowd`].
pub struct BakedCrowdPlugin;

impl Plugin for BakedCrowdPlugin {
    fn build(&self, app: &mut App) {
        load_internal_asset!(app, SHADER, "crowd.wgsl", Shader::from_wgsl);
        app.add_plugins(MaterialPlugin::<PeopleMaterial>::default())
            .add_systems(PostUpdate, (spawn, walk).chain().before(TransformSystems::Propagate));
    }
}

/// The people of a file. Spawn it; its axes are those of the node `World` of the file, with y upwards.
#[derive(Component)]
#[require(Transform, Visibility)]
pub struct BakedCrowd {
    /// The second that is drawn, from the beginning.
    pub second: f64,
    /// Distances from the camera up to which each level of detail is drawn, metres. The last level has no end.
    pub levels: Vec<f32>,
    /// The ground and the obstacles with their colours, for programs without a scene of their own.
    pub scene: Vec<(Mesh, Color)>,
    file: Baked,
    times: Vec<f64>,
    hips: Vec<Vec3>,
    turns: Vec<[i16; 4]>,
    bodies: Vec<Body>,
}

/// A body of a height of 1 m.
struct Body {
    /// The places of the joints while the rotations are none.
    rests: Vec<Vec3>,
    /// The distance from the hips that no vertex exceeds in any pose.
    reach: f32,
    /// The meshes, the finest first, until they are drawn.
    levels: Vec<Mesh>,
}

/// The numbers of the poses before and after a moment, and the share of the way between them.
type Moment = (usize, usize, f32);

impl BakedCrowd {
    /// Reads a file.
    pub fn open(path: &Path) -> Result<Self, String> {
        let named = |error: String| format!("{}: {error}", path.display());
        let file = File::open(path).map_err(|error| named(error.to_string()))?;
        Self::read(BufReader::new(file)).map_err(named)
    }

    /// Reads a file from its bytes.
    pub fn read(reader: impl Read + Seek) -> Result<Self, String> {
        let mut glb = Glb::read(reader)?;
        let without = "it has no baked people: `throng run SCENE --figures baked -o run.glb` writes them";
        let file = glb.root.asset.extras.baked.take().ok_or(without)?;
        let times = glb.view(glb.root.asset.extras.times.ok_or("it has no times")?)?;
        let times = times.as_chunks().0.iter().copied().map(f64::from_le_bytes).collect();
        let floats = glb.view(file.hips)?;
        let floats: Vec<f32> = floats.as_chunks().0.iter().copied().map(f32::from_le_bytes).collect();
        let hips = floats.as_chunks().0.iter().copied().map(Vec3::from_array).collect();
        let shorts = glb.view(file.rotations)?;
        let shorts: Vec<i16> = shorts.as_chunks().0.iter().copied().map(i16::from_le_bytes).collect();
        let mut crowd = Self {
            second: 0.0,
            levels: vec![8.0, 25.0, 60.0],
            scene: Vec::new(),
            file,
            times,
            hips,
            turns: shorts.as_chunks().0.to_vec(),
            bodies: Vec::new(),
        };
        crowd.check()?;
        for number in 0..crowd.file.bodies.len() {
            let body = crowd.body(&mut glb, number)?;
            crowd.bodies.push(body);
        }
        crowd.scene = scene(&mut glb)?;
        Ok(crowd)
    }

    /// Refuses numbers that stand for nothing in the file.
    fn check(&self) -> Result<(), String> {
        let Baked { joints, parents, bodies, looks, people, .. } = &self.file;
        let (joints, regions) = (joints.len(), looks.first().map_or(0, Vec::len));
        let mut steps: Vec<usize> = Vec::new();
        for &parent in parents {
            let way = usize::try_from(parent).map_or(Some(0), |parent| Some(steps.get(parent)? + 1));
            steps.push(way.filter(|&way| way <= STEPS).ok_or("a joint has no parent before it, or too many")?);
        }
        if joints == 0 || parents.len() != joints {
            return Err("its numbers of joints and of parents do not match".to_owned());
        }
        if self.turns.len() != joints * self.hips.len() {
            return Err("its numbers of hips and of rotations do not match".to_owned());
        }
        if regions == 0 || looks.iter().any(|look| look.len() != regions) {
            return Err("its looks differ in their number of regions".to_owned());
        }
        let rests = |body: &glb::Body| body.figure.as_ref().map_or(joints, |figure| figure.rests.len());
        if bodies.iter().any(|body| [body.offsets.len(), rests(body)] != [joints; 2] || body.levels.is_empty()) {
            return Err("a body has too few joints or no mesh".to_owned());
        }
        for person in people {
            let poses = self.hips.len() as u64;
            let known = |&[_, count, pose]: &[u64; 3]| pose.checked_add(count).is_some_and(|end| end <= poses);
            if person.body >= bodies.len()
                || person.look.is_some_and(|look| look >= looks.len())
                || !person.visits.iter().all(known)
                || !person.visits.is_sorted_by_key(|visit| visit[0])
            {
                return Err(format!("person {} has a body, a look or poses that are not there", person.number));
            }
        }
        Ok(())
    }

    /// Reads a body.
    fn body<R: Read + Seek>(&self, glb: &mut Glb<R>, number: usize) -> Result<Body, String> {
        let body = &self.file.bodies[number];
        let (mut rests, mut chains): (Vec<Vec3>, Vec<f32>) = (Vec::new(), Vec::new());
        for (joint, (&offset, &parent)) in body.offsets.iter().zip(&self.file.parents).enumerate() {
            let offset = Vec3::from(offset);
            let above = usize::try_from(parent).ok();
            // a body of a file is modelled in a pose of its own
            let own = body.figure.as_ref().map(|figure| Vec3::from(figure.rests[joint]));
            rests.push(own.unwrap_or_else(|| above.map_or(offset, |above| rests[above] + offset)));
            chains.push(above.map_or(0.0, |above| chains[above] + offset.length()));
        }
        let (mut levels, mut reach) = (Vec::new(), 0.0_f32);
        for &level in &body.levels {
            let primitive = glb.primitive(level)?;
            let mut mesh = shape(glb, &primitive)?;
            let points = glb.attribute::<3>(&primitive, "POSITION")?.unwrap_or_default();
            let joints = glb.attribute::<4>(&primitive, "JOINTS_0")?.unwrap_or_default();
            let weights = glb.attribute::<4>(&primitive, "WEIGHTS_0")?.unwrap_or_default();
            let regions = glb.attribute::<1>(&primitive, "_REGION")?;
            let colours = glb.attribute::<4>(&primitive, "COLOR_0")?;
            let regions = regions.unwrap_or_else(|| vec![[-1.0]; points.len()]);
            let colours = colours.unwrap_or_else(|| vec![[1.0; 4]; points.len()]);
            if [joints.len(), weights.len(), regions.len(), colours.len()] != [points.len(); 4]
                || joints.iter().flatten().any(|&joint| joint >= rests.len() as f64)
                || regions.iter().any(|&[region]| region >= self.file.looks[0].len() as f64)
            {
                return Err(format!("the vertices of mesh {level} lack joints, weights or colours that are there"));
            }
            for ((point, joints), weights) in points.iter().zip(&joints).zip(&weights) {
                for (&joint, _) in joints.iter().zip(weights).filter(|&(_, &weight)| weight > 0.0) {
                    let joint = joint as usize;
                    reach = reach.max(chains[joint] + rests[joint].distance(Vec3::from_array(point.map(|x| x as f32))));
                }
            }
            mesh.insert_attribute(Mesh::ATTRIBUTE_COLOR, floats(&colours));
            mesh.insert_attribute(REGION, regions.iter().map(|&[region]| region as i32).collect::<Vec<_>>());
            let joints = joints.iter().map(|of| of.map(|joint| joint as u8)).collect();
            mesh.insert_attribute(JOINTS, VertexAttributeValues::Uint8x4(joints));
            mesh.insert_attribute(WEIGHTS, floats(&weights));
            levels.push(mesh);
        }
        Ok(Body { rests, reach, levels })
    }

    /// The seconds from the first frame to the last.
    pub fn duration(&self) -> f64 {
        self.times.last().zip(self.times.first()).map_or(0.0, |(last, first)| last - first)
    }

    /// The number of people.
    pub fn people(&self) -> usize {
        self.file.people.len()
    }

    /// The number of a joint, such as `Head`.
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.file.joints.iter().position(|joint| joint == name)
    }

    /// The frame of a second: a whole number and the share of the way to the next.
    fn frame(&self, second: f64) -> f64 {
        let Some(first) = self.times.first() else { return 0.0 };
        let time = first + second;
        let low = self.times.partition_point(|&at| at <= time).saturating_sub(1);
        let share = match self.times.get(low + 1) {
            Some(next) if *next > self.times[low] => (time - self.times[low]) / (next - self.times[low]),
            _ => 0.0,
        };
        low as f64 + share.clamp(0.0, 1.0 - 1e-6)
    }

    /// The poses of a person at a frame; none while the person is not there.
    fn moment(&self, person: usize, frame: f64) -> Option<Moment> {
        let visits = &self.file.people.get(person)?.visits;
        let [first, count, pose] = *visits.iter().rfind(|visit| visit[0] as f64 <= frame)?;
        let at = frame - first as f64;
        if at >= count as f64 {
            return None;
        }
        let before = at as usize;
        let after = (before + 1).min(count as usize - 1);
        Some((pose as usize + before, pose as usize + after, at.fract() as f32))
    }

    fn hips(&self, (before, after, share): Moment) -> Vec3 {
        self.hips[before].lerp(self.hips[after], share)
    }

    fn turn(&self, (before, after, share): Moment, joint: usize) -> Quat {
        let turn = |pose: usize| {
            let parts = self.turns[pose * self.file.joints.len() + joint];
            Vec4::from_array(parts.map(|part| f32::from(part) / f32::from(i16::MAX)))
        };
        let (a, b) = (turn(before), turn(after));
        Quat::from_vec4(a.lerp(if a.dot(b) < 0.0 { -b } else { b }, share)).normalize()
    }

    /// The place of a joint at a second, against the crowd: what is to follow a head or a hand needs it. None while the
    /// person is not there.
    pub fn place(&self, person: usize, joint: usize, second: f64) -> Option<Vec3> {
        let moment = self.moment(person, self.frame(second))?;
        let known = &self.file.people[person];
        let (mut at, mut below) = (self.hips(moment), joint);
        while let Ok(parent) = usize::try_from(*self.file.parents.get(below)?) {
            let offset = Vec3::from(self.file.bodies[known.body].offsets[below]);
            at += self.turn(moment, parent) * offset * known.height;
            below = parent;
        }
        Some(at)
    }

    /// The middle of the people at a second, and the distance within which nine of ten are.
    pub fn ball(&self, second: f64) -> (Vec3, f32) {
        let frame = self.frame(second);
        let there = (0..self.people()).filter_map(|person| self.moment(person, frame));
        let places: Vec<Vec3> = there.map(|moment| self.hips(moment)).collect();
        let middle = places.iter().sum::<Vec3>() / places.len().max(1) as f32;
        let mut far: Vec<f32> = places.iter().map(|place| place.distance(middle)).collect();
        far.sort_by(f32::total_cmp);
        (middle, far.get(9 * far.len() / 10).copied().unwrap_or(5.0))
    }
}

/// Reads the shape of a primitive.
fn shape<R: Read + Seek>(glb: &mut Glb<R>, of: &Primitive) -> Result<Mesh, String> {
    let points = glb.attribute::<3>(of, "POSITION")?.ok_or("a mesh has no positions")?;
    let normals = glb.attribute::<3>(of, "NORMAL")?;
    let indices = glb.numbers::<1>(of.indices.ok_or("a mesh has no indices")?)?;
    if indices.iter().any(|&[index]| index >= points.len() as f64)
        || normals.as_ref().is_some_and(|normals| normals.len() != points.len())
    {
        return Err("a mesh has triangles or normals of vertices that are not there".to_owned());
    }
    let mut mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default());
    mesh.insert_attribute(Mesh::ATTRIBUTE_POSITION, floats(&points));
    mesh.insert_indices(Indices::U32(indices.iter().map(|&[index]| index as u32).collect()));
    match normals {
        Some(normals) => mesh.insert_attribute(Mesh::ATTRIBUTE_NORMAL, floats(&normals)),
        None => {
            mesh.duplicate_vertices();
            mesh.compute_flat_normals();
        }
    }
    Ok(mesh)
}

fn floats<const N: usize>(of: &[[f64; N]]) -> Vec<[f32; N]> {
    of.iter().map(|element| element.map(|number| number as f32)).collect()
}

/// Reads the ground and the obstacles.
fn scene<R: Read + Seek>(glb: &mut Glb<R>) -> Result<Vec<(Mesh, Color)>, String> {
    let nodes = glb.root.nodes.iter().filter(|node| matches!(node.name.as_str(), "Ground" | "Obstacles"));
    let meshes: Vec<usize> = nodes.filter_map(|node| node.mesh).collect();
    let read = |mesh| {
        let primitive = glb.primitive(mesh)?;
        let material = primitive.material.and_then(|material| glb.root.materials.get(material));
        let rgba = material.and_then(|material| material.pbr_metallic_roughness.base_color_factor);
        let [r, g, b, a] = rgba.unwrap_or([1.0; 4]);
        Ok((shape(glb, &primitive)?, Color::linear_rgba(r, g, b, a)))
    };
    meshes.into_iter().map(read).collect()
}

/// The material of all people.
type PeopleMaterial = ExtendedMaterial<StandardMaterial, Poses>;

/// What the shader knows: `crowd.wgsl` describes the elements.
#[derive(Asset, AsBindGroup, TypePath, Clone)]
struct Poses {
    #[storage(100, read_only, visibility(vertex))]
    people: Handle<ShaderBuffer>,
    #[storage(101, read_only, visibility(vertex))]
    joints: Handle<ShaderBuffer>,
    #[storage(102, read_only, visibility(vertex))]
    turns: Handle<ShaderBuffer>,
    #[storage(103, read_only, visibility(vertex))]
    colours: Handle<ShaderBuffer>,
}

#[derive(Clone, Default, ShaderType)]
struct PersonState {
    before: u32,
    after: u32,
    share: f32,
    colours: u32,
    joints: u32,
}

#[derive(ShaderType)]
struct JointState {
    offset: Vec3,
    parent: i32,
    rest: Vec3,
}

impl MaterialExtension for Poses {
    fn vertex_shader() -> ShaderRef {
        SHADER.into()
    }

    fn prepass_vertex_shader() -> ShaderRef {
        SHADER.into()
    }

    fn specialize(
        _: &MaterialExtensionPipeline,
        descriptor: &mut RenderPipelineDescriptor,
        layout: &MeshVertexBufferLayoutRef,
        _: MaterialExtensionKey<Self>,
    ) -> Result<(), SpecializedMeshPipelineError> {
        let attributes = [
            Mesh::ATTRIBUTE_POSITION.at_shader_location(0),
            Mesh::ATTRIBUTE_NORMAL.at_shader_location(1),
            Mesh::ATTRIBUTE_COLOR.at_shader_location(2),
            REGION.at_shader_location(3),
            JOINTS.at_shader_location(4),
            WEIGHTS.at_shader_location(5),
        ];
        descriptor.vertex.buffers = vec![layout.0.get_layout(&attributes)?];
        Ok(())
    }
}

/// What a crowd became.
#[derive(Component)]
struct Drawn {
    people: Vec<Entity>,
    /// By body and level.
    meshes: Vec<Vec<Handle<Mesh>>>,
    states: Handle<ShaderBuffer>,
}

/// Hands new crowds to the graphics processor, and spawns their people.
fn spawn(
    mut commands: Commands,
    mut crowds: Query<(Entity, &mut BakedCrowd), Added<BakedCrowd>>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<PeopleMaterial>>,
    mut buffers: ResMut<Assets<ShaderBuffer>>,
    device: Option<Res<RenderDevice>>,
    mut exits: MessageWriter<AppExit>,
) {
    for (crowd, mut baked) in &mut crowds {
        if baked.people() == 0 || baked.hips.is_empty() {
            continue;
        }
        let turns: Vec<u8> = baked.turns.as_flattened().iter().flat_map(|part| part.to_le_bytes()).collect();
        let most = device.as_ref().map_or(u64::MAX, |device| device.limits().max_storage_buffer_binding_size);
        if turns.len() as u64 > most {
            let (len, most) = (turns.len() >> 20, most >> 20);
            error!("the poses have {len} MiB, and this graphics processor allows {most} MiB: write fewer frames");
            exits.write(AppExit::error());
            continue;
        }
        let joints = baked.bodies.iter().zip(&baked.file.bodies).flat_map(|(body, known)| {
            let parts = known.offsets.iter().zip(&baked.file.parents).zip(&body.rests);
            parts.map(|((&offset, &parent), &rest)| JointState { offset: offset.into(), parent, rest })
        });
        let colours = baked.file.looks.iter().flatten();
        let colours = colours.map(|rgb| rgb.map_or(Vec4::ZERO, |rgb| Vec3::from(rgb).extend(1.0)));
        let states = vec![PersonState::default(); baked.people()];
        let poses = Poses {
            people: buffers.add(ShaderBuffer::from(states)),
            joints: buffers.add(ShaderBuffer::from(joints.collect::<Vec<_>>())),
            turns: buffers.add(ShaderBuffer::new(&turns, RenderAssetUsages::RENDER_WORLD)),
            colours: buffers.add(ShaderBuffer::from(colours.collect::<Vec<_>>())),
        };
        let states = poses.people.clone();
        let base = StandardMaterial { perceptual_roughness: 0.85, ..default() };
        let material = materials.add(ExtendedMaterial { base, extension: poses });
        let levels =
            |body: &mut Body| std::mem::take(&mut body.levels).into_iter().map(|mesh| meshes.add(mesh)).collect();
        let meshes: Vec<Vec<_>> = baked.bodies.iter_mut().map(levels).collect();
        let spawned = baked.file.people.iter().enumerate().map(|(number, person)| {
            let parts = (
                Name::new(format!("Person {}", person.number)),
                Mesh3d(meshes[person.body][0].clone()),
                MeshMaterial3d(material.clone()),
                MeshTag(number as u32),
                // the processor does not know where the vertices are
                Aabb { center: Vec3A::ZERO, half_extents: Vec3A::splat(baked.bodies[person.body].reach) },
                NoAutoAabb,
                Visibility::Hidden,
                ChildOf(crowd),
            );
            commands.spawn(parts).id()
        });
        let people = spawned.collect();
        commands.entity(crowd).insert(Drawn { people, meshes, states });
    }
}

/// Moves all people to the second of their crowd. The distance from the camera selects the levels.
fn walk(
    crowds: Query<(&BakedCrowd, &Drawn, &GlobalTransform)>,
    cameras: Query<&GlobalTransform, With<Camera3d>>,
    mut people: Query<(&mut Transform, &mut Visibility, &mut Mesh3d)>,
    mut buffers: ResMut<Assets<ShaderBuffer>>,
) {
    let eye = cameras.iter().next().map_or(Vec3::ZERO, GlobalTransform::translation);
    for (baked, drawn, place) in &crowds {
        let (frame, to_world) = (baked.frame(baked.second), place.affine());
        let (joints, regions) = (baked.file.joints.len(), baked.file.looks[0].len());
        let mut states = vec![PersonState::default(); baked.people()];
        for (number, person) in baked.file.people.iter().enumerate() {
            let Ok((mut transform, mut visibility, mut mesh)) = people.get_mut(drawn.people[number]) else { continue };
            let Some(moment) = baked.moment(number, frame) else {
                visibility.set_if_neq(Visibility::Hidden);
                continue;
            };
            let hips = baked.hips(moment);
            *transform = Transform::from_translation(hips).with_scale(Vec3::splat(person.height));
            visibility.set_if_neq(Visibility::Inherited);
            let far = eye.distance(to_world.transform_point3(hips));
            let levels = &drawn.meshes[person.body];
            let level = baked.levels.iter().filter(|&&most| far > most).count().min(levels.len() - 1);
            if mesh.0 != levels[level] {
                mesh.0 = levels[level].clone();
            }
            let (before, after, share) = moment;
            states[number] = PersonState {
                before: (before * joints) as u32,
                after: (after * joints) as u32,
                share,
                colours: (person.look.unwrap_or(0) * regions) as u32,
                joints: (person.body * joints) as u32,
            };
        }
        if let Some(mut buffer) = buffers.get_mut(&drawn.states) {
            buffer.set_data(states);
        }
    }
}
