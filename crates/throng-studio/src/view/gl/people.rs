//! Drawing of people: bodies as instances, poses as pictures of floating-point numbers.

use super::super::people::{BODIES, DrawnPeople, DrawnPerson, body};
use super::{Attribute, Buffer, Lighting, Program};
use crate::play::{Joints, Poses};
use bytemuck::{Pod, Zeroable};
use eframe::glow::{self, HasContext};
use glam::Vec3;
use std::sync::Arc;
use throng_figure::{Build, Character, JOINTS, LOOKS, Level, Look, Mesh, Region};

/// The number of people in a row of a picture of poses.
const IN_ROW: usize = 16;
/// The number of texels of a person.
const TEXELS: usize = size_of::<Joints>() / size_of::<[f32; 4]>();

/// The program, the bodies and the poses.
pub(super) struct PeopleCanvas {
    program: Program,
    /// The vertices of each body with its people, in the order of [`body`].
    bodies: Vec<Buffer>,
    /// The program for bodies of files, and those that were drawn last.
    of_figures: Program,
    figures: Vec<(Arc<Character>, Buffer)>,
    poses: [PoseTexture; 2],
}

/// A vertex of a body of a file.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct FigureVertex {
    /// In heights of the person.
    at: Vec3,
    normal: Vec3,
    bones: [f32; 4],
    weights: [f32; 4],
    dye: [u8; 4],
}

/// A vertex of a body at rest.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct BodyVertex {
    /// In heights of the person.
    at: Vec3,
    normal: Vec3,
    /// Two joints, the weight of the first, and the region.
    bones: [f32; 4],
}

impl PeopleCanvas {
    pub fn new(gl: &glow::Context) -> Result<Self, String> {
        let sizes = format!(
            "const int JOINTS = {JOINTS};\nconst int LOOKS = {LOOKS};\nconst int REGIONS = {};\n",
            Region::ALL.len()
        );
        let program = |kind: &str| {
            let vertex = format!("{kind}{sizes}{}", include_str!("shaders/person.vert"));
            let program = Program::new(gl, &vertex, &format!("{kind}{}", include_str!("shaders/person.frag")))?;
            for (name, value) in [("poses_before", 0), ("poses_now", 1), ("in_row", IN_ROW as i32)] {
                program.set_integer(gl, name, value);
            }
            Ok::<_, String>(program)
        };
        let (plain, of_figures) = (program("")?, program("#define FIGURE\n")?);
        plain.set_fours(gl, "palette", palette().as_flattened());
        let mut bodies = Vec::with_capacity(BODIES);
        for build in Build::ALL {
            for level in Level::ALL {
                debug_assert_eq!(bodies.len(), body(build, level));
                bodies.push(vertices(gl, &Mesh::new(build, level))?);
            }
        }
        let poses = [PoseTexture::new(gl)?, PoseTexture::new(gl)?];
        Ok(Self { program: plain, bodies, of_figures, figures: Vec::new(), poses })
    }

    /// Draws people.
    ///
    /// # Errors
    /// The graphics processor has no memory left.
    pub fn draw(&mut self, gl: &glow::Context, people: &DrawnPeople, lighting: &Lighting) -> Result<(), String> {
        if people.bodies.iter().all(Vec::is_empty) && people.figures.is_empty() {
            return Ok(());
        }
        self.hold(gl, &people.figures)?;
        let [before, now] = &people.poses;
        // the poses now were uploaded in the step before, and are those before in the next step
        if self.poses[1].holds(before) || self.poses[0].holds(now) {
            self.poses.swap(0, 1);
        }
        for (unit, (texture, poses)) in
            [glow::TEXTURE0, glow::TEXTURE1].into_iter().zip(self.poses.iter_mut().zip([before, now]))
        {
            texture.bind(gl, unit, poses);
        }
        let lighting = Lighting { share: people.share, ..*lighting };
        [&self.program, &self.of_figures].into_iter().for_each(|program| program.light(gl, &lighting));
        // SAFETY: no argument is a pointer.
        unsafe {
            gl.enable(glow::CULL_FACE);
            gl.cull_face(glow::BACK);
        }
        for (buffer, people) in self.bodies.iter_mut().zip(&people.bodies) {
            buffer.upload::<DrawnPerson>(gl, people);
            self.program.draw(gl, buffer, glow::TRIANGLES);
        }
        for ((_, buffer), (_, people)) in self.figures.iter_mut().zip(&people.figures) {
            buffer.upload::<DrawnPerson>(gl, people);
            self.of_figures.draw(gl, buffer, glow::TRIANGLES);
        }
        // SAFETY: no argument is a pointer.
        unsafe {
            gl.disable(glow::CULL_FACE);
            gl.active_texture(glow::TEXTURE0);
        }
        Ok(())
    }

    /// Holds the bodies of these figures, in their order, and no others.
    fn hold(&mut self, gl: &glow::Context, drawn: &[(Arc<Character>, Vec<DrawnPerson>)]) -> Result<(), String> {
        let mut held = std::mem::take(&mut self.figures);
        for (character, _) in drawn {
            let known = held.iter().position(|(known, _)| Arc::ptr_eq(known, character));
            self.figures.push(match known {
                Some(at) => held.swap_remove(at),
                None => (character.clone(), figure_vertices(gl, character)?),
            });
        }
        held.iter().for_each(|(_, buffer)| buffer.destroy(gl));
        Ok(())
    }

    pub fn destroy(&self, gl: &glow::Context) {
        self.program.destroy(gl);
        self.of_figures.destroy(gl);
        self.figures.iter().for_each(|(_, buffer)| buffer.destroy(gl));
        self.bodies.iter().for_each(|buffer| buffer.destroy(gl));
        self.poses.iter().for_each(|texture| texture.destroy(gl));
    }
}

/// Returns the colours of the regions of all looks, with what a region is: 0: not worn, 1: worn, 2: of the colour of the
/// top.
fn palette() -> Vec<[f32; 4]> {
    let entry = |look: Look, region| {
        let [r, g, b] = look.colour(region).unwrap_or_default().map(|part| f32::from(part) / 255.0);
        [r, g, b, if look.is_top(region) { 2.0 } else { u8::from(look.wears(region)).into() }]
    };
    (0..LOOKS).map(Look::new).flat_map(|look| Region::ALL.map(|region| entry(look, region))).collect()
}

/// The fields of a [`DrawnPerson`].
const PERSON: [(&str, Attribute); 2] = [("slots", Attribute::Floats(4)), ("fill", Attribute::Colour)];

/// Uploads the vertices and triangles of a body of a file.
fn figure_vertices(gl: &glow::Context, character: &Character) -> Result<Buffer, String> {
    let mesh = character.mesh();
    let vertex = |(k, &[r, g, b]): (usize, &[u8; 3])| FigureVertex {
        at: mesh.positions[k],
        normal: mesh.normals[k],
        bones: mesh.joints[k].map(f32::from),
        weights: mesh.weights[k],
        dye: [r, g, b, 255],
    };
    let vertices: Vec<FigureVertex> = character.colours().iter().enumerate().map(vertex).collect();
    let mut buffer = Buffer::new(gl, &PERSON, Some(0))?;
    let [three, four] = [3, 4].map(Attribute::Floats);
    let corners = [("at", three), ("normal", three), ("bones", four), ("weights", four), ("dye", Attribute::Colour)];
    buffer.hold(gl, &vertices, &corners, mesh.triangles.as_flattened())?;
    Ok(buffer)
}

/// Uploads the vertices and triangles of a body.
fn vertices(gl: &glow::Context, mesh: &Mesh) -> Result<Buffer, String> {
    let vertex = |k: usize| {
        let (joints, weights) = (mesh.joints[k], mesh.weights[k]);
        let bones = [joints[0].into(), joints[1].into(), weights[0], mesh.regions[k] as u8 as f32];
        BodyVertex { at: mesh.positions[k], normal: mesh.normals[k], bones }
    };
    let vertices: Vec<BodyVertex> = (0..mesh.positions.len()).map(vertex).collect();
    let triangles: Vec<u32> = mesh.triangles.iter().flat_map(|&triangle| painted(mesh, triangle)).collect();
    let mut buffer = Buffer::new(gl, &PERSON, Some(0))?;
    let corners = [("at", Attribute::Floats(3)), ("normal", Attribute::Floats(3)), ("bones", Attribute::Floats(4))];
    buffer.hold(gl, &vertices, &corners, &triangles)?;
    Ok(buffer)
}

/// Returns a triangle with the vertex of its first region last. A triangle has the colour of its last vertex, so regions
/// meet along rings.
fn painted(mesh: &Mesh, mut triangle: [u32; 3]) -> [u32; 3] {
    let region = |vertex: u32| mesh.regions[vertex as usize];
    let first = (0..3).min_by_key(|&corner| region(triangle[corner])).unwrap_or(2);
    triangle.rotate_left((first + 1) % 3);
    triangle
}

/// Poses in the memory of the graphics processor.
struct PoseTexture {
    texture: glow::Texture,
    of: Option<Arc<Poses>>,
    rows: usize,
}

impl PoseTexture {
    fn new(gl: &glow::Context) -> Result<Self, String> {
        // SAFETY: no argument is a pointer.
        let texture = unsafe { gl.create_texture()? };
        Ok(Self { texture, of: None, rows: 0 })
    }

    fn holds(&self, poses: &Arc<Poses>) -> bool {
        self.of.as_ref().is_some_and(|held| Arc::ptr_eq(held, poses))
    }

    /// Binds the texture to a unit, with these poses.
    fn bind(&mut self, gl: &glow::Context, unit: u32, poses: &Arc<Poses>) {
        // SAFETY: the texture belongs to this context.
        unsafe {
            gl.active_texture(unit);
            gl.bind_texture(glow::TEXTURE_2D, Some(self.texture));
        }
        if !self.holds(poses) {
            self.upload(gl, &poses.joints);
            self.of = Some(poses.clone());
        }
    }

    /// Uploads poses to the bound texture.
    fn upload(&mut self, gl: &glow::Context, joints: &[Joints]) {
        let rows = joints.len().div_ceil(IN_ROW).max(1);
        let width = (IN_ROW * TEXELS) as i32;
        let (kind, format) = (glow::FLOAT, glow::RGBA);
        // SAFETY: the numbers of bytes match the sizes, and the bytes are copied during the calls.
        unsafe {
            if rows > self.rows {
                let nothing = glow::PixelUnpackData::Slice(None);
                let height = rows.next_power_of_two();
                gl.tex_image_2d(
                    glow::TEXTURE_2D,
                    0,
                    glow::RGBA32F as i32,
                    width,
                    height as i32,
                    0,
                    format,
                    kind,
                    nothing,
                );
                for name in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
                    gl.tex_parameter_i32(glow::TEXTURE_2D, name, glow::NEAREST as i32);
                }
                self.rows = height;
            }
            let (full, rest) = joints.split_at(joints.len() - joints.len() % IN_ROW);
            let high = (full.len() / IN_ROW) as i32;
            for (part, row, size) in [(full, 0, (width, high)), (rest, high, ((rest.len() * TEXELS) as i32, 1))] {
                if !part.is_empty() {
                    let bytes = glow::PixelUnpackData::Slice(Some(bytemuck::cast_slice(part)));
                    gl.tex_sub_image_2d(glow::TEXTURE_2D, 0, 0, row, size.0, size.1, format, kind, bytes);
                }
            }
        }
    }

    fn destroy(&self, gl: &glow::Context) {
        // SAFETY: the texture belongs to this context and is not used again.
        unsafe { gl.delete_texture(self.texture) }
    }
}
