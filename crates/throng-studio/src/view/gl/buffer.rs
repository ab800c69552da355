//! Buffers of the graphics processor.

use super::program::{Attribute, place};
use bytemuck::Pod;
use eframe::glow::{self, HasContext};

/// A buffer of items of one type.
pub(super) struct Buffer {
    pub array: glow::VertexArray,
    buffer: glow::Buffer,
    /// Bytes per item.
    stride: usize,
    /// The number of corners of an instanced item. `None` if each item is a corner.
    pub corners: Option<i32>,
    /// The corners of an instanced item, and their order in triangles, if the buffer owns them.
    vertices: Option<glow::Buffer>,
    pub triangles: Option<glow::Buffer>,
    pub count: i32,
}

impl Buffer {
    /// Creates a buffer for items with these fields.
    pub fn new(gl: &glow::Context, fields: &[(&str, Attribute)], corners: Option<i32>) -> Result<Self, String> {
        let stride = fields.iter().map(|(_, field)| field.bytes()).sum();
        // SAFETY: no argument is a pointer.
        let (array, buffer) = unsafe { (gl.create_vertex_array()?, gl.create_buffer()?) };
        let new = Self { array, buffer, stride, corners, vertices: None, triangles: None, count: 0 };
        new.read(gl, buffer, fields, u32::from(corners.is_some()));
        Ok(new)
    }

    /// Describes consecutive fields of a buffer to the shaders. `each` is 1 for fields per item, 0 for fields per
    /// corner.
    pub fn read(&self, gl: &glow::Context, buffer: glow::Buffer, fields: &[(&str, Attribute)], each: u32) {
        let stride: usize = fields.iter().map(|(_, field)| field.bytes()).sum();
        // SAFETY: the described fields are those of the items in the buffer.
        unsafe {
            gl.bind_vertex_array(Some(self.array));
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
            let mut offset = 0;
            for (name, field) in fields {
                let place = place(name);
                let (count, kind, normalized) = field.layout();
                gl.enable_vertex_attrib_array(place);
                gl.vertex_attrib_pointer_f32(place, count, kind, normalized, stride as i32, offset as i32);
                gl.vertex_attrib_divisor(place, each);
                offset += field.bytes();
            }
            gl.bind_vertex_array(None);
        }
    }

    /// Holds the corners of each item, and the triangles that they form.
    pub fn hold<T: Pod>(
        &mut self,
        gl: &glow::Context,
        corners: &[T],
        fields: &[(&str, Attribute)],
        triangles: &[u32],
    ) -> Result<(), String> {
        // SAFETY: the bytes are copied during the calls. The array keeps the binding of the triangles.
        unsafe {
            let [vertices, order] = [gl.create_buffer()?, gl.create_buffer()?];
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(vertices));
            gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytemuck::cast_slice(corners), glow::STATIC_DRAW);
            self.read(gl, vertices, fields, 0);
            gl.bind_vertex_array(Some(self.array));
            gl.bind_buffer(glow::ELEMENT_ARRAY_BUFFER, Some(order));
            gl.buffer_data_u8_slice(glow::ELEMENT_ARRAY_BUFFER, bytemuck::cast_slice(triangles), glow::STATIC_DRAW);
            gl.bind_vertex_array(None);
            (self.vertices, self.triangles) = (Some(vertices), Some(order));
        }
        self.corners = Some(triangles.len() as i32);
        Ok(())
    }

    pub fn destroy(&self, gl: &glow::Context) {
        // SAFETY: all belong to this context and are not used again.
        unsafe {
            gl.delete_vertex_array(self.array);
            for buffer in [Some(self.buffer), self.vertices, self.triangles].into_iter().flatten() {
                gl.delete_buffer(buffer);
            }
        }
    }

    pub fn upload<T: Pod>(&mut self, gl: &glow::Context, items: &[T]) {
        assert_eq!(size_of::<T>(), self.stride, "the fields of the items are those that the shader reads");
        self.count = items.len() as i32;
        // SAFETY: the bytes are copied during the call.
        unsafe {
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(self.buffer));
            gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytemuck::cast_slice(items), glow::STREAM_DRAW);
        }
    }
}
