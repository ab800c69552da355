//! A picture in the memory of the graphics processor.

use super::super::geometry::{GroundPicture, Tile};
use super::{Attribute, Buffer, Program};
use eframe::glow::{self, HasContext};

/// A texture and its position on the ground.
pub(super) struct Texture {
    texture: glow::Texture,
    tiles: Buffer,
}

impl Texture {
    pub fn new(gl: &glow::Context) -> Result<Self, String> {
        let tiles = Buffer::new(gl, &[("from", Attribute::Floats(3)), ("to", Attribute::Floats(3))], Some(4))?;
        // SAFETY: no argument is a pointer.
        unsafe {
            let texture = gl.create_texture()?;
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            for (name, value) in [
                (glow::TEXTURE_MIN_FILTER, glow::LINEAR),
                (glow::TEXTURE_MAG_FILTER, glow::LINEAR),
                (glow::TEXTURE_WRAP_S, glow::CLAMP_TO_EDGE),
                (glow::TEXTURE_WRAP_T, glow::CLAMP_TO_EDGE),
            ] {
                gl.tex_parameter_i32(glow::TEXTURE_2D, name, value as i32);
            }
            Ok(Self { texture, tiles })
        }
    }

    /// Uploads another picture, or none. A picture is ignored if its size does not match its pixels.
    pub fn upload(&mut self, gl: &glow::Context, picture: Option<&GroundPicture>) {
        let picture = picture.filter(|picture| picture.pixels.len() == picture.size[0] * picture.size[1]);
        let tile: Option<Tile> = picture.map(|picture| picture.tile);
        self.tiles.upload(gl, tile.as_slice());
        let Some(GroundPicture { size: [width, height], pixels, .. }) = picture else { return };
        let bytes = glow::PixelUnpackData::Slice(Some(bytemuck::cast_slice(pixels)));
        let (kind, format) = (glow::UNSIGNED_BYTE, glow::RGBA);
        // SAFETY: the number of bytes matches the size, and the bytes are copied during the call.
        unsafe {
            gl.bind_texture(glow::TEXTURE_2D, Some(self.texture));
            let size = (*width as i32, *height as i32);
            gl.tex_image_2d(glow::TEXTURE_2D, 0, glow::RGBA8 as i32, size.0, size.1, 0, format, kind, bytes);
        }
    }

    pub fn draw(&self, gl: &glow::Context, program: &Program) {
        // SAFETY: the texture belongs to this context, and the program reads texture unit 0.
        unsafe {
            gl.active_texture(glow::TEXTURE0);
            gl.bind_texture(glow::TEXTURE_2D, Some(self.texture));
        }
        program.draw(gl, &self.tiles, glow::TRIANGLE_STRIP);
    }

    pub fn destroy(&self, gl: &glow::Context) {
        self.tiles.destroy(gl);
        // SAFETY: the texture belongs to this context and is not used again.
        unsafe { gl.delete_texture(self.texture) }
    }
}
