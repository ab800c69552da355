//! Shader programs, their attributes and uniforms.

use super::{Buffer, Lighting};
use eframe::glow::{self, HasContext};

/// The names of the attributes by location. No shader uses two names of one location.
const ATTRIBUTES: [(u32, &str); 19] = [
    (0, "at"),
    (0, "before"),
    (0, "from"),
    (1, "now"),
    (1, "to"),
    (1, "slots"),
    (2, "color"),
    (2, "body"),
    (3, "look"),
    (3, "stroke"),
    (4, "fill"),
    (5, "rim"),
    (6, "turn"),
    (7, "corner_at"),
    (8, "normal"),
    (9, "joint"),
    (9, "bones"),
    (10, "weights"),
    (11, "dye"),
];

/// Returns the location of an attribute.
pub(super) fn place(name: &str) -> u32 {
    ATTRIBUTES.iter().find(|(_, known)| *known == name).map_or(0, |(place, _)| *place)
}

/// A field of the items of a buffer.
#[derive(Clone, Copy, Debug)]
pub(super) enum Attribute {
    /// This number of floats.
    Floats(i32),
    /// Four bytes.
    Colour,
}

impl Attribute {
    pub fn bytes(self) -> usize {
        match self {
            Self::Floats(count) => 4 * count as usize,
            Self::Colour => 4,
        }
    }

    /// Returns the number of components, their type, and whether they are normalised to 0 to 1.
    pub fn layout(self) -> (i32, u32, bool) {
        match self {
            Self::Floats(count) => (count, glow::FLOAT, false),
            Self::Colour => (4, glow::UNSIGNED_BYTE, true),
        }
    }
}

/// A linked program of a vertex and a fragment shader.
pub(super) struct Program {
    program: glow::Program,
}

const COMMON: &str = include_str!("shaders/common.glsl");

impl Program {
    pub fn new(gl: &glow::Context, vertex: &str, fragment: &str) -> Result<Self, String> {
        // SAFETY: the shaders and the program belong to this context, which checks their sources.
        unsafe {
            let header =
                if gl.version().is_embedded { "#version 300 es\nprecision highp float;\n" } else { "#version 330\n" };
            let program = gl.create_program()?;
            let sources = [
                (glow::VERTEX_SHADER, format!("{header}{COMMON}{vertex}")),
                (glow::FRAGMENT_SHADER, format!("{header}{fragment}")),
            ];
            for (kind, source) in &sources {
                let shader = gl.create_shader(*kind)?;
                gl.shader_source(shader, source);
                gl.compile_shader(shader);
                if !gl.get_shader_compile_status(shader) {
                    return Err(gl.get_shader_info_log(shader));
                }
                gl.attach_shader(program, shader);
                gl.delete_shader(shader);
            }
            for (place, name) in ATTRIBUTES {
                gl.bind_attrib_location(program, place, name);
            }
            gl.link_program(program);
            if !gl.get_program_link_status(program) {
                return Err(gl.get_program_info_log(program));
            }
            Ok(Self { program })
        }
    }

    /// Sets the uniforms of the view.
    pub fn light(&self, gl: &glow::Context, lighting: &Lighting) {
        // SAFETY: a uniform that the program lacks has no location, and setting it has no effect.
        unsafe {
            gl.use_program(Some(self.program));
            let at = |name| gl.get_uniform_location(self.program, name);
            gl.uniform_matrix_4_f32_slice(at("clip").as_ref(), false, lighting.clip.as_ref());
            gl.uniform_2_f32(at("size").as_ref(), lighting.size.x, lighting.size.y);
            for (name, value) in
                [("unit", lighting.unit), ("focal", lighting.focal), ("near", lighting.near), ("share", lighting.share)]
            {
                gl.uniform_1_f32(at(name).as_ref(), value);
            }
            gl.uniform_3_f32_slice(at("sun").as_ref(), lighting.sun.as_ref());
            let [r, g, b, a] =
                [lighting.notch.r, lighting.notch.g, lighting.notch.b, lighting.notch.a].map(|c| f32::from(c) / 255.0);
            gl.uniform_4_f32(at("notch").as_ref(), r, g, b, a);
        }
    }

    /// Sets a uniform number.
    pub fn set_integer(&self, gl: &glow::Context, name: &str, value: i32) {
        // SAFETY: as in `light`.
        unsafe {
            gl.use_program(Some(self.program));
            gl.uniform_1_i32(gl.get_uniform_location(self.program, name).as_ref(), value);
        }
    }

    /// Sets a uniform array of vectors with four numbers each.
    pub fn set_fours(&self, gl: &glow::Context, name: &str, values: &[f32]) {
        // SAFETY: as in `light`; the numbers are copied during the call.
        unsafe {
            gl.use_program(Some(self.program));
            gl.uniform_4_f32_slice(gl.get_uniform_location(self.program, name).as_ref(), values);
        }
    }

    /// Draws shadows of this opacity instead of bodies, or bodies if `None`.
    pub fn shadows(&self, gl: &glow::Context, opacity: Option<f32>) {
        // SAFETY: as in `light`.
        unsafe {
            gl.use_program(Some(self.program));
            let at = |name| gl.get_uniform_location(self.program, name);
            gl.uniform_1_i32(at("shadows").as_ref(), i32::from(opacity.is_some()));
            gl.uniform_4_f32(at("shade").as_ref(), 0.0, 0.0, 0.0, opacity.unwrap_or_default());
        }
    }

    /// Draws all items of a buffer, as instances or as triangles of three items.
    pub fn draw(&self, gl: &glow::Context, buffer: &Buffer, mode: u32) {
        if buffer.count == 0 {
            return;
        }
        // SAFETY: the buffer holds `count` items with the fields that the program reads.
        unsafe {
            gl.use_program(Some(self.program));
            gl.bind_vertex_array(Some(buffer.array));
            match (buffer.corners, &buffer.triangles) {
                (Some(corners), Some(_)) => {
                    gl.draw_elements_instanced(mode, corners, glow::UNSIGNED_INT, 0, buffer.count);
                }
                (Some(corners), None) => gl.draw_arrays_instanced(mode, 0, corners, buffer.count),
                (None, _) => gl.draw_arrays(mode, 0, buffer.count),
            }
            gl.bind_vertex_array(None);
        }
    }

    pub fn destroy(&self, gl: &glow::Context) {
        // SAFETY: the program belongs to this context and is not used again.
        unsafe { gl.delete_program(self.program) }
    }
}
