//! Layers of geometry, drawn by OpenGL 3.3 or WebGL 2.
//!
//! This is the only module of the workspace that is allowed `unsafe`: the calls of OpenGL are, since it believes what it is
//! told about buffers. Here each buffer is written and described by one function ([`Buffer::upload`]), with the type
//! whose fields the shader reads, so that the two agree.
#![allow(unsafe_code)]

mod program;

use super::geometry::{Corner, Disc, Geometry, Line};
use bytemuck::Pod;
use eframe::glow::{self, HasContext};
use glam::{Mat4, Vec2};
use program::{Attribute, Program};
use std::sync::Arc;
use throng_draw::Color;

/// How the world is seen, for the shaders.
#[derive(Clone, Copy, Debug)]
pub struct Lighting {
    /// Points relative to the world's origin to clip coordinates.
    pub clip: Mat4,
    /// Size of the picture, pixels.
    pub size: Vec2,
    /// Pixels of a point of the screen.
    pub unit: f32,
    /// Pixels of a metre a metre away; from straight above, of any metre.
    pub focal: f32,
    /// What is nearer is not seen, metres; from straight above 0.
    pub near: f32,
    /// How far the clock is from the state before to the state now.
    pub share: f32,
    /// The colour of notches.
    pub notch: Color,
}

/// The opacity of shadows.
const SHADE: f32 = 0.13;

/// What has been drawn with before: programs and buffers of the graphics processor.
pub struct Canvas {
    areas: Program,
    discs: Program,
    lines: Program,
    layers: Vec<Layer>,
}

/// The buffers of a layer, and what they hold.
struct Layer {
    of: Option<Arc<Geometry>>,
    areas: Buffer,
    discs: Buffer,
    lines: Buffer,
}

impl Canvas {
    /// # Errors
    /// What the compiler of shaders says.
    pub fn new(gl: &glow::Context) -> Result<Self, String> {
        Ok(Self {
            areas: Program::new(gl, include_str!("shaders/area.vert"), include_str!("shaders/area.frag"))?,
            discs: Program::new(gl, include_str!("shaders/disc.vert"), include_str!("shaders/disc.frag"))?,
            lines: Program::new(gl, include_str!("shaders/line.vert"), include_str!("shaders/line.frag"))?,
            layers: Vec::new(),
        })
    }

    /// Draws layers, the first below the others, into the current viewport. A layer that is the same as the last time is not
    /// handed over again.
    ///
    /// # Errors
    /// The graphics processor has no memory left.
    pub fn paint(&mut self, gl: &glow::Context, layers: &[Arc<Geometry>], lighting: &Lighting) -> Result<(), String> {
        while self.layers.len() < layers.len() {
            self.layers.push(Layer::new(gl)?);
        }
        // SAFETY: calls without arguments that point anywhere.
        unsafe {
            gl.enable(glow::BLEND);
            gl.blend_func(glow::ONE, glow::ONE_MINUS_SRC_ALPHA);
        }
        for program in [&self.areas, &self.discs, &self.lines] {
            program.light(gl, lighting);
        }
        for (layer, geometry) in self.layers.iter_mut().zip(layers) {
            layer.hold(gl, geometry);
            self.areas.draw(gl, &layer.areas, glow::TRIANGLES);
            self.discs.shadows(gl, Some(SHADE));
            self.discs.draw(gl, &layer.discs, glow::TRIANGLE_STRIP);
            self.discs.shadows(gl, None);
            self.discs.draw(gl, &layer.discs, glow::TRIANGLE_STRIP);
            self.lines.draw(gl, &layer.lines, glow::TRIANGLE_STRIP);
        }
        Ok(())
    }

    /// Gives everything back.
    pub fn destroy(&self, gl: &glow::Context) {
        for program in [&self.areas, &self.discs, &self.lines] {
            program.destroy(gl);
        }
        for buffer in self.layers.iter().flat_map(|layer| [&layer.areas, &layer.discs, &layer.lines]) {
            // SAFETY: both are of this context and not used again.
            unsafe {
                gl.delete_vertex_array(buffer.array);
                gl.delete_buffer(buffer.buffer);
            }
        }
    }
}

impl Layer {
    fn new(gl: &glow::Context) -> Result<Self, String> {
        use Attribute::{Colour, Floats};
        Ok(Self {
            of: None,
            areas: Buffer::new(gl, &[("at", Floats(3)), ("color", Colour)], false)?,
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
                true,
            )?,
            lines: Buffer::new(
                gl,
                &[("from", Floats(3)), ("to", Floats(3)), ("color", Colour), ("stroke", Floats(2))],
                true,
            )?,
        })
    }

    fn hold(&mut self, gl: &glow::Context, geometry: &Arc<Geometry>) {
        if self.of.as_ref().is_some_and(|held| Arc::ptr_eq(held, geometry)) {
            return;
        }
        self.areas.upload::<Corner>(gl, &geometry.areas);
        self.discs.upload::<Disc>(gl, &geometry.discs);
        self.lines.upload::<Line>(gl, &geometry.lines);
        self.of = Some(geometry.clone());
    }
}

/// Some items of one kind.
struct Buffer {
    array: glow::VertexArray,
    buffer: glow::Buffer,
    /// Bytes of an item.
    stride: usize,
    /// Whether an item is a quad; else a corner.
    instanced: bool,
    count: i32,
}

impl Buffer {
    /// A buffer for items with these fields, in the order of [`program::ATTRIBUTES`].
    fn new(gl: &glow::Context, fields: &[(&str, Attribute)], instanced: bool) -> Result<Self, String> {
        let stride: usize = fields.iter().map(|(_, field)| field.bytes()).sum();
        // SAFETY: what is described are the fields of the items that `upload` will write, one after the other.
        unsafe {
            let (array, buffer) = (gl.create_vertex_array()?, gl.create_buffer()?);
            gl.bind_vertex_array(Some(array));
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
            let mut offset = 0;
            for (name, field) in fields {
                let place = program::place(name);
                gl.enable_vertex_attrib_array(place);
                let (count, kind, normalized) = field.layout();
                gl.vertex_attrib_pointer_f32(place, count, kind, normalized, stride as i32, offset as i32);
                gl.vertex_attrib_divisor(place, u32::from(instanced));
                offset += field.bytes();
            }
            gl.bind_vertex_array(None);
            Ok(Self { array, buffer, stride, instanced, count: 0 })
        }
    }

    fn upload<T: Pod>(&mut self, gl: &glow::Context, items: &[T]) {
        assert_eq!(size_of::<T>(), self.stride, "the fields of the items are those that the shader reads");
        self.count = items.len() as i32;
        // SAFETY: the bytes are copied during the call.
        unsafe {
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(self.buffer));
            gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytemuck::cast_slice(items), glow::STREAM_DRAW);
        }
    }
}
