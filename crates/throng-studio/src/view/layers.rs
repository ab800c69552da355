//! What can be laid on the ground, and what is there now.

use super::geometry::Geometry;
use super::heat::{Heat, HeatMap, Heating};
use super::mesh::MeshMap;
use super::streams::{Currents, StreamMap, Streams};
use crate::play::Shown;
use crate::settings::Settings;
use eframe::egui::Context;
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use throng_draw::Projector;

/// What people have chosen to see beside the crowd.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Layers {
    /// What the ground's colour says of the crowd.
    pub heat: Heat,
    /// Over how many seconds that is the mean; 0: what is now.
    pub window: f32,
    /// How the fields that lead groups are drawn.
    pub streams: Streams,
    /// Whether the ground's colour says how fast fields are.
    pub stream_speed: bool,
    /// Which of the fields is seen; `None`: all.
    pub field: Option<usize>,
    /// The triangles that ways are planned on.
    pub mesh: bool,
    /// The way that the selected agent has planned.
    pub paths: bool,
    /// Shadows on the ground.
    pub shadows: bool,
    /// What colours and lines say.
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
            key: true,
        }
    }
}

/// The density at which one hardly moves any more, agents a square metre: colours tell no more apart.
pub const DENSE: f32 = 4.0;

/// What lies on the ground.
#[derive(Default)]
pub struct Ground {
    heat: HeatMap,
    streams: StreamMap,
    mesh: MeshMap,
    /// The speed that is drawn as the fastest of the crowd and of the fields, m/s.
    walking: f32,
    flowing: Option<f32>,
}

impl Ground {
    /// Heat, fields, and the navigation mesh, for the selected agent's body or else for the first one's, as far as they are wanted.
    pub fn layers(
        &mut self,
        shown: &Shown,
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

    /// The most that the colours of a heat map tell apart: agents a square metre, or m/s.
    pub fn most(&self, heat: Heat) -> f32 {
        if heat == Heat::Speed { self.walking } else { DENSE }
    }

    /// The speed that fields are drawn as fastest at, m/s, where some are seen.
    pub fn fastest(&self) -> Option<f32> {
        self.flowing
    }
}
