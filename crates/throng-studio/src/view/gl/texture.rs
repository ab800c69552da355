//! A picture that the graphics processor holds.

use super::super::geometry::{Picture, Tile};
use super::{Attribute, Buffer, Program};
use eframe::glow::{self, HasContext};

/// A picture, and where it lies.
pub(super) struct Texture {
    texture: glow::Texture,
    tiles: Buffer,
}

impl Texture {
    pub fn new(gl: &glow::Context) -> Result<Self, String> {
        let tiles = Buffer::new(gl, &[("from", Attribute::Floats(3)), ("to", Attribute::Floats(3))], Some(4))?;
        // SAFETY: calls without arguments that point anywhere.
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

    /// Takes another picture, or none. One that has not the pixels that it says is none.
    pub fn upload(&mut self, gl: &glow::Context, picture: Option<&Picture>) {
        let picture = picture.filter(|picture| picture.pixels.len() == picture.size[0] * picture.size[1]);
        let tile: Option<Tile> = picture.map(|picture| picture.tile);
        self.tiles.upload(gl, tile.as_slice());
        let Some(Picture { size: [width, height], pixels, .. }) = picture else { return };
        let bytes = glow::PixelUnpackData::Slice(Some(bytemuck::cast_slice(pixels)));
        let (kind, format) = (glow::UNSIGNED_BYTE, glow::RGBA);
        // SAFETY: there are as many bytes as the size says, which are copied during the call.
        unsafe {
            gl.bind_texture(glow::TEXTURE_2D, Some(self.texture));
            let size = (*width as i32, *height as i32);
            gl.tex_image_2d(glow::TEXTURE_2D, 0, glow::RGBA8 as i32, size.0, size.1, 0, format, kind, bytes);
        }
    }

    pub fn draw(&self, gl: &glow::Context, program: &Program) {
        // SAFETY: it is of this context; the program reads the first texture.
        unsafe {
            gl.active_texture(glow::TEXTURE0);
            gl.bind_texture(glow::TEXTURE_2D, Some(self.texture));
        }
        program.draw(gl, &self.tiles, glow::TRIANGLE_STRIP);
    }

    pub fn destroy(&self, gl: &glow::Context) {
        self.tiles.destroy(gl);
        // SAFETY: it is of this context and not used again.
        unsafe { gl.delete_texture(self.texture) }
    }
}
