//! The colours of vertices: materials, colours of vertices, and textures where a vertex is on them.

use super::data::{Data, number};
use super::part::attribute;
use super::texture::Texture;
use crate::color::{self, light};
use serde_json::Value;
use std::collections::BTreeMap;

/// The most pixels of all textures of a file.
pub(super) const MOST_PIXELS: usize = 1 << 26;

/// The materials of a file.
#[derive(Default)]
pub(super) struct Materials {
    /// The textures that were read, by image; `None`: another format than PNG, JPEG and WebP.
    textures: BTreeMap<usize, Option<Texture>>,
}

impl Materials {
    /// Returns the colour of each vertex of a part of a mesh (sRGB): the base colour of the material, times the colour of the
    /// vertex, times that of the texture there.
    ///
    /// # Errors
    /// Colours or places on the texture are damaged, or a texture is.
    pub fn colours(&mut self, data: &Data, primitive: &Value, vertices: u64) -> Result<Vec<[u8; 3]>, String> {
        let material = number(&primitive["material"]).and_then(|at| data.root.materials.get(at));
        let surface = material.map_or(&Value::Null, |material| &material["pbrMetallicRoughness"]);
        let base = [0, 1, 2].map(|part| surface["baseColorFactor"][part].as_f64().map_or(1.0, |part| part as f32));
        let attributes = &primitive["attributes"];
        let own: Option<Vec<[f32; 3]>> = match attribute(data, attributes, "COLOR_0", vertices)? {
            Some(at) if data.root.accessors.get(at).is_some_and(|accessor| accessor.kind == "VEC4") => {
                Some(data.numbers::<4>(at)?.into_iter().map(|[r, g, b, _]| [r, g, b]).collect())
            }
            Some(at) => Some(data.numbers::<3>(at)?),
            None => None,
        };
        let said = &surface["baseColorTexture"];
        let places = format!("TEXCOORD_{}", number(&said["texCoord"]).unwrap_or(0));
        let places = attribute(data, attributes, &places, vertices)?;
        let texture = match (image(data, said), places) {
            (Some(image), Some(places)) => self.texture(data, image)?.zip(Some(data.numbers::<2>(places)?)),
            _ => None,
        };
        let colour = |vertex: usize| {
            let own = own.as_ref().and_then(|own| own.get(vertex)).copied().unwrap_or([1.0; 3]);
            let place = texture.as_ref().and_then(|(texture, places)| Some(texture.at(*places.get(vertex)?)));
            let painted = place.unwrap_or([255; 3]).map(light);
            [0, 1, 2].map(|part| color::part(base[part] * own[part] * painted[part]))
        };
        Ok((0..vertices as usize).map(colour).collect())
    }

    /// Returns the texture of an image; `None`: another format than PNG, JPEG and WebP.
    fn texture(&mut self, data: &Data, image: usize) -> Result<Option<&Texture>, String> {
        if !self.textures.contains_key(&image) {
            let pixels: usize = self.textures.values().flatten().map(Texture::pixels).sum();
            let texture =
                Texture::of(data, image, MOST_PIXELS - pixels).map_err(|why| format!("image {image}: {why}"))?;
            self.textures.insert(image, texture);
        }
        Ok(self.textures.get(&image).and_then(Option::as_ref))
    }
}

/// Returns the image of the texture of a material: where there are two, the one that every program reads.
fn image(data: &Data, said: &Value) -> Option<usize> {
    let texture = data.root.textures.get(number(&said["index"])?)?;
    number(&texture["source"]).or_else(|| number(&texture["extensions"]["EXT_texture_webp"]["source"]))
}
