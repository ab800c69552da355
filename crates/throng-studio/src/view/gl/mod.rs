//! Drawing of layers with OpenGL 3.3 or WebGL 2.
//!
//! This is the only module of the workspace that may use `unsafe`: OpenGL trusts the buffer layouts that it is given.
//! Each buffer is described and filled in one place ([`Buffer::upload`]), from the type with the fields that the
//! shader reads, so that layout and content agree.
#![allow(unsafe_code)]

mod buffer;
mod people;
mod program;
mod texture;

use super::geometry::{Corner, Disc, Figure, Geometry, Line};
use buffer::Buffer;
use eframe::glow::{self, HasContext};
use glam::{Mat4, Vec2, Vec3};
use people::PeopleCanvas;
use program::{Attribute, Program};
use std::sync::Arc;
use texture::Texture;
use throng_draw::{Color, Shape, Vertex};

/// The uniforms of the shaders.
#[derive(Clone, Copy, Debug)]
pub struct Lighting {
    /// From points relative to the world's origin to clip coordinates.
    pub clip: Mat4,
    /// Size of the picture, pixels.
    pub size: Vec2,
    /// Pixels per point of the screen.
    pub unit: f32,
    /// Pixels per metre at a distance of one metre. In a plan, pixels per metre.
    pub focal: f32,
    /// Distance of the near plane, metres. 0 in a plan.
    pub near: f32,
    /// Interpolation weight between the previous and the current state.
    pub share: f32,
    /// The direction to the sun.
    pub sun: Vec3,
    /// Whether shadows are drawn on the ground.
    pub shadows: bool,
    /// The colour of notches.
    pub notch: Color,
}

/// The opacity of shadows.
const SHADE: f32 = 0.2;

/// The programs and buffers of the graphics processor.
pub struct Canvas {
    areas: Program,
    discs: Program,
    lines: Program,
    figures: Program,
    images: Program,
    /// The corners of each shape, and their number.
    meshes: Vec<(glow::Buffer, i32)>,
    /// The bodies and poses of people, once there are any.
    people: Option<PeopleCanvas>,
    layers: Vec<Layer>,
}

/// The buffers of a layer and their content.
struct Layer {
    of: Option<Arc<Geometry>>,
    image: Texture,
    areas: Buffer,
    discs: Buffer,
    lines: Buffer,
    /// By shape.
    figures: Vec<Buffer>,
}

impl Canvas {
    /// Creates the programs and meshes.
    ///
    /// # Errors
    /// A shader does not compile. The message is that of the compiler.
    pub fn new(gl: &glow::Context) -> Result<Self, String> {
        Ok(Self {
            areas: Program::new(gl, include_str!("shaders/area.vert"), include_str!("shaders/area.frag"))?,
            discs: Program::new(gl, include_str!("shaders/disc.vert"), include_str!("shaders/disc.frag"))?,
            lines: Program::new(gl, include_str!("shaders/line.vert"), include_str!("shaders/line.frag"))?,
            figures: Program::new(gl, include_str!("shaders/figure.vert"), include_str!("shaders/figure.frag"))?,
            images: Program::new(gl, include_str!("shaders/image.vert"), include_str!("shaders/image.frag"))?,
            meshes: Shape::ALL.iter().map(|shape| mesh(gl, &shape.mesh())).collect::<Result<_, _>>()?,
            people: None,
            layers: Vec::new(),
        })
    }

    fn programs(&self) -> [&Program; 5] {
        [&self.images, &self.areas, &self.discs, &self.lines, &self.figures]
    }

    /// Draws layers into the current viewport, the first one below the others. Unchanged layers are not uploaded again.
    ///
    /// # Errors
    /// The graphics processor has no memory left.
    pub fn paint(&mut self, gl: &glow::Context, layers: &[Arc<Geometry>], lighting: &Lighting) -> Result<(), String> {
        while self.layers.len() < layers.len() {
            self.layers.push(Layer::new(gl, &self.meshes)?);
        }
        // SAFETY: no argument is a pointer.
        unsafe {
            gl.enable(glow::BLEND);
            gl.blend_func(glow::ONE, glow::ONE_MINUS_SRC_ALPHA);
            gl.depth_func(glow::LEQUAL);
            gl.depth_mask(true);
            gl.clear_depth_f32(1.0);
            gl.clear(glow::DEPTH_BUFFER_BIT);
        }
        self.programs().into_iter().for_each(|program| program.light(gl, lighting));
        for (layer, geometry) in self.layers.iter_mut().zip(layers) {
            layer.hold(gl, geometry);
            depth(gl, geometry.deep, geometry.deep);
            layer.image.draw(gl, &self.images);
            self.areas.draw(gl, &layer.areas, glow::TRIANGLES);
            // antialiased edges do not write depth
            depth(gl, geometry.deep, false);
            if lighting.shadows {
                self.discs.shadows(gl, Some(SHADE));
                self.discs.draw(gl, &layer.discs, glow::TRIANGLE_STRIP);
            }
            self.discs.shadows(gl, None);
            self.discs.draw(gl, &layer.discs, glow::TRIANGLE_STRIP);
            self.lines.draw(gl, &layer.lines, glow::TRIANGLE_STRIP);
            depth(gl, geometry.deep, geometry.deep);
            layer.figures.iter().for_each(|figures| self.figures.draw(gl, figures, glow::TRIANGLES));
            if let Some(people) = &geometry.people {
                if self.people.is_none() {
                    self.people = Some(PeopleCanvas::new(gl)?);
                }
                self.people.iter_mut().try_for_each(|canvas| canvas.draw(gl, people, lighting))?;
            }
        }
        depth(gl, false, true);
        Ok(())
    }

    /// Deletes all programs and buffers.
    pub fn destroy(&self, gl: &glow::Context) {
        self.programs().into_iter().for_each(|program| program.destroy(gl));
        for &(mesh, _) in &self.meshes {
            // SAFETY: the buffer belongs to this context and is not used again.
            unsafe { gl.delete_buffer(mesh) }
        }
        let plain = self.layers.iter().flat_map(|layer| [&layer.areas, &layer.discs, &layer.lines]);
        plain.chain(self.layers.iter().flat_map(|layer| &layer.figures)).for_each(|buffer| buffer.destroy(gl));
        self.layers.iter().for_each(|layer| layer.image.destroy(gl));
        self.people.iter().for_each(|people| people.destroy(gl));
    }
}

/// Sets whether the next items are hidden by nearer ones, and whether they hide farther ones.
fn depth(gl: &glow::Context, hidden: bool, hides: bool) {
    // SAFETY: no argument is a pointer.
    unsafe {
        if hidden {
            gl.enable(glow::DEPTH_TEST);
        } else {
            gl.disable(glow::DEPTH_TEST);
        }
        gl.depth_mask(hides);
    }
}

/// Uploads the corners of a shape.
fn mesh(gl: &glow::Context, corners: &[Vertex]) -> Result<(glow::Buffer, i32), String> {
    let fields: Vec<[Vec3; 3]> = corners.iter().map(|vertex| [vertex.corner, vertex.normal, vertex.joint]).collect();
    // SAFETY: the bytes are copied during the call.
    unsafe {
        let buffer = gl.create_buffer()?;
        gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
        gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytemuck::cast_slice(&fields), glow::STATIC_DRAW);
        Ok((buffer, corners.len() as i32))
    }
}

/// The fields of a shape's corners.
const VERTEX: [(&str, Attribute); 3] =
    [("corner_at", Attribute::Floats(3)), ("normal", Attribute::Floats(3)), ("joint", Attribute::Floats(3))];

impl Layer {
    fn new(gl: &glow::Context, meshes: &[(glow::Buffer, i32)]) -> Result<Self, String> {
        use Attribute::{Colour, Floats};
        let figure = [
            ("before", Floats(4)),
            ("now", Floats(4)),
            ("body", Floats(4)),
            ("look", Floats(4)),
            ("fill", Colour),
            ("turn", Floats(4)),
        ];
        let figures = meshes.iter().map(|&(mesh, corners)| {
            let buffer = Buffer::new(gl, &figure, Some(corners))?;
            buffer.read(gl, mesh, &VERTEX, 0);
            Ok(buffer)
        });
        Ok(Self {
            of: None,
            image: Texture::new(gl)?,
            figures: figures.collect::<Result<_, String>>()?,
            areas: Buffer::new(gl, &[("at", Floats(3)), ("color", Colour)], None)?,
            discs: Buffer::new(
                gl,
                &[
                    ("before", Floats(4)),
                    ("now", Floats(4)),
                    ("body", Floats(4)),
                    ("look", Floats(4)),
                    ("fill", Colour),
                    ("rim", Colour),
                ],
                Some(4),
            )?,
            lines: Buffer::new(
                gl,
                &[("from", Floats(3)), ("to", Floats(3)), ("color", Colour), ("stroke", Floats(2))],
                Some(4),
            )?,
        })
    }

    fn hold(&mut self, gl: &glow::Context, geometry: &Arc<Geometry>) {
        if self.of.as_ref().is_some_and(|held| Arc::ptr_eq(held, geometry)) {
            return;
        }
        self.image.upload(gl, geometry.picture.as_ref());
        self.areas.upload::<Corner>(gl, &geometry.areas);
        self.discs.upload::<Disc>(gl, &geometry.discs);
        self.lines.upload::<Line>(gl, &geometry.lines);
        for (buffer, figures) in self.figures.iter_mut().zip(&geometry.figures) {
            buffer.upload::<Figure>(gl, figures);
        }
        self.of = Some(geometry.clone());
    }
}
