//! Upright solids: obstacles, walls and oblong bodies as prisms with shaded faces.

use super::Lens;
use crate::Color;
use crate::primitive::{Primitive, Stroke};
use glam::DVec2;
use throng::Obstacle;

/// The number of corners of a round obstacle.
const ROUND: usize = 32;
/// The direction of the light (from the left and the front), the darkening of a face that faces away from it, and the
/// least darkening.
const LIGHT: DVec2 = DVec2::new(-0.6, -0.8);
const SHADE: f32 = 0.28;
const AWAY: f32 = 0.1;

/// The colours of a solid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tone {
    pub fill: Color,
    pub edge: Color,
    /// The colour of faces that face away from the light.
    pub dark: Color,
    /// The colour of the haze.
    pub air: Color,
}

/// An upright solid.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    /// The corners, counter-clockwise if the solid is closed.
    corners: Vec<DVec2>,
    /// Whether the solid is a prism; otherwise it is a thin wall from corner to corner.
    closed: bool,
    low: f64,
    high: f64,
}

/// A part of a solid, with its horizontal distance from the viewpoint.
pub(super) type Face = (f64, Vec<Primitive>);

impl Solid {
    pub fn obstacle(obstacle: &Obstacle, height: f64) -> Self {
        match obstacle {
            Obstacle::Circle { center, radius } => {
                let around = (0..ROUND).map(|k| DVec2::from_angle(k as f64 * std::f64::consts::TAU / ROUND as f64));
                Self::prism(around.map(|out| *center + out * *radius).collect(), 0.0, height)
            }
            Obstacle::Polygon { corners } => Self::prism(corners.clone(), 0.0, height),
            Obstacle::Wall { points } => Self { corners: points.clone(), closed: false, low: 0.0, high: height },
        }
    }

    /// Creates a prism from the height `low` to `high` over a ring of corners.
    pub fn prism(mut corners: Vec<DVec2>, low: f64, high: f64) -> Self {
        let edges = corners.iter().zip(corners.iter().cycle().skip(1));
        if edges.map(|(a, b)| a.perp_dot(*b)).sum::<f64>() < 0.0 {
            corners.reverse();
        }
        Self { corners, closed: true, low, high }
    }

    /// Adds the visible faces, in pieces of at most `piece` metres, so that bodies can be drawn between two pieces.
    pub fn faces(&self, tone: Tone, lens: &Lens, piece: f64, unit: f32, faces: &mut Vec<Face>) {
        let corners = &self.corners;
        if corners.iter().any(|corner| !corner.is_finite()) || corners.len() < 2 {
            return;
        }
        if self.closed && lens.eye.z > self.high {
            let top = corners.iter().map(|corner| corner.extend(self.high));
            let away = top.clone().map(|corner| lens.away(corner)).fold(0.0, f64::max);
            let (points, fill) = (lens.area(top), tone.fill.mix(tone.air, lens.haze(corners[0].extend(self.high))));
            let area = Primitive::Area { rings: vec![points.clone()], fill };
            let edge = Primitive::Line { points, closed: true, stroke: Stroke::plain(unit, tone.edge) };
            faces.push((away, vec![area, edge]));
        }
        let edges = if self.closed { corners.len() } else { corners.len() - 1 };
        for k in 0..edges {
            let (from, to) = (corners[k], corners[(k + 1) % corners.len()]);
            let out = (from - to).perp().normalize_or_zero();
            let seen = (lens.eye.truncate() - from).dot(out) > 0.0;
            if seen || !self.closed {
                let out = if seen { out } else { -out };
                let dark = AWAY + SHADE * (0.5 - 0.5 * out.dot(LIGHT) as f32);
                // A side has one colour; haze by piece would show steps.
                let middle = ((from + to) * 0.5).extend(0.5 * (self.low + self.high));
                let side = Tone { fill: tone.fill.mix(tone.dark, dark).mix(tone.air, lens.haze(middle)), ..tone };
                let parts = ((from.distance(to) / piece).ceil() as usize).clamp(1, 64);
                let at = |part: usize| from.lerp(to, part as f64 / parts as f64);
                faces.extend((0..parts).map(|part| self.side([at(part), at(part + 1)], side, lens, unit)));
            }
        }
    }

    fn side(&self, [from, to]: [DVec2; 2], tone: Tone, lens: &Lens, unit: f32) -> Face {
        let middle = ((from + to) * 0.5).extend(0.5 * (self.low + self.high));
        let ring =
            lens.area([from.extend(self.low), to.extend(self.low), to.extend(self.high), from.extend(self.high)]);
        // The line hides the seams between pieces.
        let seam = Primitive::Line { points: ring.clone(), closed: true, stroke: Stroke::plain(0.6, tone.fill) };
        let mut marks = vec![Primitive::Area { rings: vec![ring], fill: tone.fill }, seam];
        if let Some(points) = lens.line(from.extend(self.high), to.extend(self.high)) {
            marks.push(Primitive::Line {
                points: points.to_vec(),
                closed: false,
                stroke: Stroke::plain(unit, tone.edge),
            });
        }
        (lens.away(middle), marks)
    }
}
