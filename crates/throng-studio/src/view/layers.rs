//! Layers on the ground.

use super::geometry::Geometry;
use super::heat::{Heat, HeatMap, Heating};
use super::mesh::MeshMap;
use super::streams::{Currents, StreamMap, Streams};
use crate::play::RunMoment;
use crate::settings::Settings;
use eframe::egui::Context;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use throng_draw::Projector;

/// The visible layers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Layers {
    /// The quantity of the heat map.
    pub heat: Heat,
    /// The averaging window of the heat map, seconds. 0 for the current state only.
    pub window: f32,
    /// How the fields of groups are drawn.
    pub streams: Streams,
    /// Whether colours on the ground show the speed of fields.
    pub stream_speed: bool,
    /// The visible field. `None` for all fields.
    pub field: Option<usize>,
    /// Whether the navigation mesh is drawn.
    pub mesh: bool,
    /// Whether the planned path of the selected agent is drawn.
    pub paths: bool,
    /// Whether shadows are drawn.
    pub shadows: bool,
    /// Whether people are drawn as walking people in a view in space.
    pub people: bool,
    /// Whether the key is shown.
    pub key: bool,
}

impl Default for Layers {
    fn default() -> Self {
        Self {
            heat: Heat::None,
            window: 0.0,
            streams: Streams::None,
            stream_speed: false,
            field: None,
            mesh: false,
            paths: false,
            shadows: true,
            people: true,
            key: true,
        }
    }
}

/// The maximum of the density scale, agents per square metre. Agents hardly move at this density.
pub const DENSE: f32 = 4.0;

/// The layers on the ground.
#[derive(Default)]
pub struct Ground {
    heat: HeatMap,
    streams: StreamMap,
    mesh: MeshMap,
    /// The maximum speeds of the colour scales of the crowd and of fields, m/s.
    walking: f32,
    flowing: Option<f32>,
}

impl Ground {
    /// Returns the heat map, the fields and the navigation mesh, as far as they are visible. The mesh is that of the
    /// selected agent's body, or of the first agent's.
    pub fn layers(
        &mut self,
        shown: &RunMoment,
        settings: &Settings,
        sight: (&Projector, Vec2),
        selected: Option<u32>,
        ctx: &Context,
    ) -> [Arc<Geometry>; 3] {
        let (layers, theme, dark) = (&settings.layers, settings.theme(), settings.dark);
        let preferred = shown.first.bodies.iter().map(|body| body.preferred_speed).filter(|speed| speed.is_finite());
        self.walking = Some(preferred.fold(0.0, f32::max)).filter(|&speed| speed > 0.0).unwrap_or(1.5);
        let most = if layers.heat == Heat::Speed { self.walking } else { DENSE };
        let heat = self.heat.layer(shown, Heating { heat: layers.heat, window: layers.window, most, dark }, ctx);
        let currents =
            Currents { streams: layers.streams, speed: layers.stream_speed, only: layers.field, theme: theme.clone() };
        let (streams, flowing) = self.streams.layer(shown, &currents, sight, ctx);
        self.flowing = flowing;
        let mesh = if layers.mesh {
            let bodies = &shown.frame.bodies;
            let whose = bodies.iter().find(|body| Some(body.number) == selected).or(bodies.first());
            self.mesh.layer(shown, whose.map_or(0.2, |body| body.radius), &theme, dark, ctx)
        } else {
            Arc::default()
        };
        [heat, streams, mesh]
    }

    /// Returns the maximum of the colour scale of a heat map: agents per square metre, or m/s.
    pub fn most(&self, heat: Heat) -> f32 {
        if heat == Heat::Speed { self.walking } else { DENSE }
    }

    /// Returns the maximum speed of the visible fields, m/s, if there are any.
    pub fn fastest(&self) -> Option<f32> {
        self.flowing
    }
}
