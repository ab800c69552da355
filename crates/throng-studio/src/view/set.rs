//! The set of a scene: meshes of a file that are only looked at.

use super::derived::Derived;
use super::geometry::Geometry;
use super::scenery::LIGHT;
use crate::play::RunMoment;
use eframe::egui::Context;
use glam::DVec2;
use std::path::PathBuf;
use std::sync::Arc;
use throng_draw::Color;
use throng_record::{SetMesh, moment};
use throng_scene::StageSet;

/// The brightness of faces in the shade, of 1.
const SHADE: f32 = 0.5;

/// The set as it was read last.
#[derive(Default)]
pub struct Set {
    read: Derived<(StageSet, PathBuf, DVec2), Result<Arc<Geometry>, String>>,
}

impl Set {
    /// Returns the geometry of the scene's set, once its file is read, or why there is none; `None` without a set.
    pub fn layer(&mut self, shown: &RunMoment, ctx: &Context) -> Option<Result<Arc<Geometry>, String>> {
        let said = shown.scene.view.set.clone()?;
        if cfg!(target_arch = "wasm32") {
            return Some(Err(format!("a page does not read {}: open the scene in the program's window", said.file)));
        }
        let (scene, origin) = (shown.scene.clone(), shown.setting.origin);
        let key = (said, scene.origin.folder.clone(), origin);
        let made = self.read.of(key, ctx, move || match moment::set(&scene, origin) {
            Ok(set) => Ok(Arc::new(set.map_or_else(Geometry::default, |set| drawn(&set)))),
            Err(error) => Err(error.to_string()),
        });
        made.map(|made| (*made).clone())
    }
}

/// Returns the triangles of a set, shaded by their direction.
fn drawn(set: &SetMesh) -> Geometry {
    let mut geometry = Geometry { deep: true, ..Geometry::default() };
    for corners in &set.triangles {
        let [a, b, c] = corners.map(|at| at as usize);
        // both sides of a triangle are seen
        let light = SHADE
            + (1.0 - SHADE)
                * (set.normals[a] + set.normals[b] + set.normals[c]).normalize_or_zero().dot(LIGHT).max(0.0);
        let part = |part: usize| {
            let sum: f32 = [a, b, c].iter().map(|&at| f32::from(set.colors[at][part])).sum();
            (light * sum / 3.0) as u8
        };
        let color = Color { r: part(0), g: part(1), b: part(2), a: 255 };
        geometry.facet(&[a, b, c].map(|at| set.positions[at]), color);
    }
    geometry
}
