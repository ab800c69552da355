//! Drawn pathways of behaviours: level ribbons with thin spines.

use crate::primitive::Stroke;
use crate::{Color, Theme};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use throng::space::Pathway;

/// The number of edges of the round end of a segment.
const ROUND: usize = 12;

/// The drawing of a pathway in the world.
#[derive(Clone, Debug)]
pub(crate) struct Ribbon {
    /// The area of each segment.
    pub areas: Vec<Vec<DVec3>>,
    /// The points of the spine.
    pub spine: Vec<DVec3>,
}

impl Ribbon {
    /// Creates the ribbon of a path relative to an origin.
    pub fn new(path: &Pathway, origin: DVec2) -> Self {
        let place = |point: glam::Vec3| point.as_dvec3() + origin.extend(0.0);
        let segments = path.segments();
        let spine = segments.iter().map(|segment| segment.start).chain(segments.last().map(|last| last.end));
        let areas = segments.iter().filter(|segment| segment.radius > 0.0).map(|segment| {
            let ahead = segment.tangent.truncate().as_dvec2().normalize_or(DVec2::X);
            // Half a circle around each end.
            let half = |center: DVec3, out: DVec2| {
                let corner = move |k: usize| DVec2::from_angle(PI * (k as f64 / ROUND as f64 - 0.5)).rotate(out);
                (0..=ROUND).map(move |k| center + (corner(k) * f64::from(segment.radius)).extend(0.0))
            };
            half(place(segment.end), ahead).chain(half(place(segment.start), -ahead)).collect()
        });
        Self { areas: areas.collect(), spine: spine.map(place).collect() }
    }

    /// Returns the colour of the areas: opaque, because segments overlap.
    pub fn tone(theme: &Theme) -> Color {
        theme.ground.mix(theme.goal, 0.13)
    }

    /// Returns the stroke of the spine.
    pub fn stroke(theme: &Theme, unit: f32) -> Stroke {
        Stroke::plain(unit, theme.goal.alpha(0.8))
    }
}
