//! The fields of one recording, redrawn when they change.

use super::critical::{RADIUS, Symbol, symbols};
use super::grid::fastest;
use super::key::Said;
use super::{Canvas, FlowLayer, FlowStyle, Grid, Lay, Mask};
use super::{anchors::anchors, arrows::arrows, speed::speed, streamlines::streamlines, texture::texture};
use crate::annotate::Row;
use crate::legend::Layout;
use crate::look::Look;
use crate::primitive::Primitive;
use crate::{Camera, Color, Style, Theme};
use glam::Vec2;
use throng_record::{Flow, Setting};

/// A field with its state.
#[derive(Clone, Debug)]
struct DrawnField {
    flow: Flow,
    ink: Color,
    /// The field when it was last drawn; `None` before that, and if the picture shows nothing of it.
    grid: Option<Grid>,
    /// The time at which it was last sampled.
    time: Option<f64>,
}

/// All fields of a picture.
#[derive(Clone, Debug)]
pub(crate) struct Sheets {
    canvas: Canvas,
    style: FlowStyle,
    theme: Theme,
    shown: Vec<DrawnField>,
    fastest: Option<f32>,
    symbols: Vec<Symbol>,
    /// The background strips of the title and the legend.
    strips: Vec<Primitive>,
    /// The primitives, in the order of the layers.
    pub marks: Vec<Primitive>,
}

impl Sheets {
    /// Returns the fields of a setting in a style; `None` if there are no fields or the style does not draw them.
    pub fn new(setting: &Setting, style: &Style, camera: Camera, layout: &Layout, look: &Look) -> Option<Self> {
        let unit = layout.unit;
        let flow = style.flow.clone().filter(|flow| !flow.layers.is_empty() && !setting.flows.is_empty())?;
        let free = Mask::new((style.width, style.height), setting, &camera, unit);
        let size = Vec2::new(style.width as f32, style.height as f32);
        let canvas = Canvas { camera, origin: setting.origin, size, unit, free };
        let quiet = style.theme.goal.mix(style.theme.text, 0.45);
        // A single field has a neutral colour; each of several fields has the colour of its first group.
        let ink = |flow: &Flow| match flow.groups.first() {
            Some(&group) if setting.flows.len() > 1 => look.group(group as usize).mix(style.theme.text, 0.2),
            _ => quiet,
        };
        let shown = |flow: &Flow| DrawnField { flow: flow.clone(), ink: ink(flow), grid: None, time: None };
        Some(Self {
            canvas,
            shown: setting.flows.iter().map(shown).collect(),
            fastest: flow.max_speed.filter(|&speed| speed > 0.0 && speed.is_finite()),
            style: flow,
            theme: style.theme.clone(),
            symbols: Vec::new(),
            strips: if style.legend { strips(setting, style, layout.room(true).0.y) } else { Vec::new() },
            marks: Vec::new(),
        })
    }

    /// Redraws the fields that have changed at a time. Returns whether any has.
    pub fn turn(&mut self, time: f64) -> bool {
        let mut changed = false;
        for shown in &mut self.shown {
            let known = shown.time.is_some_and(|then| shown.flow.still || then == time);
            if !known {
                let first = shown.time.is_none();
                let grid = Grid::of(&shown.flow, &self.canvas, time);
                changed |= first || grid != shown.grid;
                (shown.grid, shown.time) = (grid, Some(time));
            }
        }
        if changed {
            let grids = self.shown.iter().filter_map(|shown| shown.grid.as_ref());
            self.fastest = self.fastest.or_else(|| fastest(grids, &self.canvas));
            self.draw();
        }
        changed
    }

    /// Returns the speed that is drawn as the fastest, m/s; `None` until a field flows.
    pub fn fastest(&self) -> Option<f32> {
        self.fastest
    }

    fn draw(&mut self) {
        self.marks.clear();
        let Some(fastest) = self.fastest else { return };
        let of = self.shown.len();
        let lays = self.shown.iter().enumerate().filter_map(|(turn, shown)| {
            let grid = shown.grid.as_ref()?;
            let (canvas, style, theme) = (&self.canvas, &self.style, &self.theme);
            Some((shown, Lay { grid, canvas, style, theme, ink: shown.ink, fastest, turn: (turn, of) }))
        });
        let lays: Vec<(&DrawnField, Lay<'_>)> = lays.collect();
        let mut marks = Vec::new();
        let mut layers = self.style.layers.clone();
        layers.sort_unstable();
        layers.dedup();
        for layer in layers {
            for (shown, lay) in &lays {
                match layer {
                    FlowLayer::Speed => marks.push(speed(lay)),
                    FlowLayer::Lic => marks.push(texture(lay)),
                    FlowLayer::Streamlines => marks.extend(streamlines(lay)),
                    FlowLayer::Arrows => marks.extend(arrows(lay)),
                    FlowLayer::Anchors => marks.extend(anchors(lay, &shown.flow.anchors)),
                    FlowLayer::Critical => {
                        for (at, symbol) in symbols(lay) {
                            marks.extend(symbol.marks(at, RADIUS * self.canvas.unit, &self.theme));
                            if !self.symbols.iter().any(|other| other.is_like(&symbol)) {
                                self.symbols.push(symbol);
                            }
                        }
                    }
                }
            }
        }
        marks.extend_from_slice(&self.strips);
        self.marks = marks;
    }

    /// Returns the key's rows for everything drawn so far.
    pub fn rows(&self, size: f32) -> Vec<Row<'_>> {
        let said = Said {
            style: &self.style,
            theme: &self.theme,
            ink: self.shown.first().map_or(self.theme.goal, |shown| shown.ink),
            fastest: self.fastest,
            has_anchors: self.shown.iter().any(|shown| !shown.flow.anchors.is_empty()),
            symbols: Symbol::all().filter(|kind| self.symbols.iter().any(|seen| seen.is_like(kind))).collect(),
        };
        said.rows(size)
    }
}

/// Returns strips along the upper and the lower edge of a picture, where fields fade out below the type.
fn strips(setting: &Setting, style: &Style, height: f32) -> Vec<Primitive> {
    const STEPS: usize = 16;
    /// The opacity of the strips at the edge.
    const PAPER: f32 = 0.85;
    let paper = if setting.walkable.is_empty() { style.theme.ground } else { style.theme.outside };
    let (width, bottom) = (style.width as f32, style.height as f32);
    let edge = |k: usize| (1.2 * height * k as f32 / STEPS as f32).round();
    let step = |k: usize| {
        let t = (k as f32 + 0.5) / STEPS as f32;
        let fill = paper.alpha(PAPER * (1.0 - t * t * (3.0 - 2.0 * t)));
        let band = |top: f32, bottom: f32| {
            let ring = [(0.0, top), (width, top), (width, bottom), (0.0, bottom)].map(Vec2::from).to_vec();
            Primitive::Area { rings: vec![ring], fill }
        };
        [band(edge(k), edge(k + 1)), band(bottom - edge(k + 1), bottom - edge(k))]
    };
    (0..STEPS).flat_map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Painter, WorldBox};
    use glam::{DVec2, Vec3};
    use std::sync::Arc;
    use throng_field::Anchor;
    use throng_record::Frame;

    #[test]
    fn documents_hold_the_primitives_of_pictures() {
        let drain = |place: Vec3, _: f64| Vec3::Z.cross(place) - 0.2 * place;
        let anchors = [DVec2::X, DVec2::Y].map(|place| Anchor::new(place, place)).to_vec();
        let flows = vec![Flow { anchors, ..Flow::of(Arc::new(drain)) }];
        let setting = Setting { flows, ..Setting::default() };
        let view = Some(WorldBox { min: DVec2::splat(-3.0), max: DVec2::splat(3.0) });
        let style = Style { flow: Some(FlowStyle::of(FlowLayer::ALL)), view, ..Style::default() };
        let mut painter = Painter::new(&setting, &style, &Frame::default()).unwrap();
        let svg = painter.svg(&Frame::default());
        let flow = svg.split(r#"<g id="flow">"#).nth(1).and_then(|rest| rest.split("</g>").next()).unwrap();
        let marks = &painter.flows.as_ref().unwrap().marks;
        let count = |tag: &str| flow.matches(tag).count();
        assert_eq!(count("<path") + count("<circle") + count("<image"), marks.len());
        let discs = marks.iter().filter(|mark| matches!(mark, Primitive::Disc { .. } | Primitive::Ring { .. })).count();
        assert_eq!((count("<circle"), count("<image")), (discs, 2));
        assert!(marks.len() > 100, "{}", marks.len());
    }
}
