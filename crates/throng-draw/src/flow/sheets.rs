//! The fields of one recording, redrawn when they change.

use super::alone;
use super::critical::{RADIUS, Symbol, symbols};
use super::grid::fastest;
use super::key::Said;
use super::shares::Shares;
use super::{Canvas, FlowLayer, FlowStyle, Grid, Lay, Mask};
use super::{anchors::anchors, arrows::arrows, speed::speed, streamlines::streamlines, texture::texture};
use crate::annotate::Row;
use crate::legend::Layout;
use crate::look::Look;
use crate::primitive::Primitive;
use crate::text::{Type, Typeface};
use crate::{Camera, Color, Image, Style, Theme, raster};
use glam::{DVec2, Vec2};
use std::sync::Arc;
use throng::field::Field;
use throng_record::{AdaptedField, Flow, Frame, Setting};

/// A field with its state.
#[derive(Clone, Debug)]
struct DrawnField {
    flow: Flow,
    ink: Color,
    /// The field when it was last drawn; `None` before that, and if the picture shows nothing of it.
    grid: Option<Grid>,
    /// The time at which it was last sampled.
    time: Option<f64>,
    /// The present state of a field that adapts to the crowd.
    adapted: Option<AdaptedField>,
    /// The memory of such a field, and the index of the interval of its last update, if frames do not hold its state:
    /// files do not.
    memory: Option<(Vec<f32>, f64)>,
}

impl DrawnField {
    /// Updates the memory with the positions in a frame, once in each interval. Returns the new state of the field;
    /// `None` in an interval with an update.
    fn notice(&mut self, frame: &Frame, origin: DVec2) -> Option<Arc<dyn Field>> {
        let adaptive = self.flow.field.adaptive()?;
        let interval = (frame.time / adaptive.interval()).floor();
        let (memory, last) = self.memory.get_or_insert_with(|| (adaptive.memory(), f64::NAN));
        if *last == interval {
            return None;
        }
        *last = interval;
        let people: Vec<Vec2> = frame.bodies.iter().map(|body| (body.position - origin).as_vec2()).collect();
        adaptive.notice(memory, &people);
        Some(adaptive.adapted(memory))
    }

    /// Takes the state of an adaptive field from a frame, or updates it with the positions in the frame.
    fn see(&mut self, frame: &Frame, origin: DVec2) {
        if !self.flow.governs || self.flow.field.adaptive().is_none() {
            return;
        }
        let given = frame.fields.iter().find(|adapted| self.flow.groups.contains(&adapted.group));
        let now = match given {
            Some(given) => given.clone(),
            None => match self.notice(frame, origin) {
                Some(field) => AdaptedField { group: 0, field },
                None => return,
            },
        };
        if self.adapted.as_ref() != Some(&now) {
            (self.adapted, self.time) = (Some(now), None);
        }
    }
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
    /// The floor below the fields, where pictures of several fields are mixed.
    floor: Option<Image>,
    /// The primitives of each field, in the order of the layers, and their pictures above the floor.
    parts: Vec<Vec<Primitive>>,
    pictures: Vec<Image>,
    /// The symbols above all fields.
    over: Vec<Primitive>,
    /// The shares of several fields.
    shares: Option<Shares>,
    /// The primitives, in the order of the layers.
    pub marks: Vec<Primitive>,
}

impl Sheets {
    /// Returns the fields of a setting in a style; `None` if there are no fields or the style does not draw them. Several
    /// fields are mixed above a floor; without a floor, the opacity of their primitives shows their shares.
    pub fn new(
        setting: &Setting,
        style: &Style,
        camera: Camera,
        layout: &Layout,
        look: &Look,
        floor: Option<Image>,
    ) -> Option<Self> {
        let unit = layout.unit;
        let flow = style.flow.clone().filter(|flow| !flow.layers.is_empty() && !setting.flows.is_empty())?;
        let free = Mask::new((style.width, style.height), setting, &camera, unit);
        let size = Vec2::new(style.width as f32, style.height as f32);
        let canvas = Canvas { camera, origin: setting.origin, size, unit, free };
        let quiet = alone(&style.theme);
        // A single field has a neutral colour; each of several fields has the colour of its first group.
        let ink = |flow: &Flow| match flow.groups.first() {
            Some(&group) if setting.flows.len() > 1 => look.group(group as usize).mix(style.theme.text, 0.2),
            _ => quiet,
        };
        let shown = |flow: &Flow| DrawnField {
            flow: flow.clone(),
            ink: ink(flow),
            grid: None,
            time: None,
            adapted: None,
            memory: None,
        };
        Some(Self {
            canvas,
            shown: setting.flows.iter().map(shown).collect(),
            fastest: flow.max_speed.filter(|&speed| speed > 0.0 && speed.is_finite()),
            style: flow,
            theme: style.theme.clone(),
            symbols: Vec::new(),
            strips: if style.legend { strips(setting, style, layout.room(true).0.y) } else { Vec::new() },
            floor,
            parts: Vec::new(),
            pictures: Vec::new(),
            over: Vec::new(),
            shares: None,
            marks: Vec::new(),
        })
    }

    /// Updates the fields that adapt to the crowd.
    pub fn follow(&mut self, frame: &Frame) {
        self.shown.iter_mut().for_each(|shown| shown.see(frame, self.canvas.origin));
    }

    /// Redraws the fields that have changed at a moment, and their shares. Returns whether the picture of the fields has
    /// changed. Call [`follow`](Self::follow) before.
    pub fn turn(&mut self, frame: &Frame) -> bool {
        let time = frame.time;
        let mut changed = false;
        for shown in &mut self.shown {
            let known = shown.time.is_some_and(|then| shown.flow.still || then == time);
            if !known {
                let first = shown.time.is_none();
                let field = shown.adapted.as_ref().map_or(&shown.flow.field, |adapted| &adapted.field);
                let grid = Grid::of(&**field, &self.canvas, time);
                changed |= first || grid != shown.grid;
                (shown.grid, shown.time) = (grid, Some(time));
            }
        }
        if changed {
            let grids = self.shown.iter().filter_map(|shown| shown.grid.as_ref());
            self.fastest = self.fastest.or_else(|| fastest(grids, &self.canvas));
            self.draw();
        }
        let several = self.shown.len() > 1 && self.fastest.is_some();
        let shares = several.then(|| Shares::new(self.shown.iter().map(|shown| &shown.flow), &self.canvas, frame));
        changed |= shares != self.shares;
        if changed {
            self.shares = shares;
            self.put_together();
        }
        changed
    }

    /// Joins the drawings of the fields.
    fn put_together(&mut self) {
        self.marks = match (&self.shares, &self.floor) {
            (None, _) => self.parts.iter().flatten().cloned().collect(),
            (Some(shares), Some(floor)) => vec![Primitive::Pixels(shares.mix(floor, &self.pictures))],
            (Some(shares), None) => {
                let parts = self.parts.iter().enumerate();
                parts.flat_map(|(field, part)| part.iter().filter_map(move |mark| faded(mark, shares, field))).collect()
            }
        };
        self.marks.extend_from_slice(&self.over);
    }

    /// Returns the speed that is drawn as the fastest, m/s; `None` until a field flows.
    pub fn fastest(&self) -> Option<f32> {
        self.fastest
    }

    fn draw(&mut self) {
        /// The length of pieces of streamlines, which differ in opacity, in units of the layout.
        const CUT: f32 = 12.0;
        self.over.clear();
        self.parts = vec![Vec::new(); self.shown.len()];
        let Some(fastest) = self.fastest else { return };
        let of = self.shown.len();
        let cut = (of > 1 && self.floor.is_none()).then_some(CUT * self.canvas.unit);
        let lays = self.shown.iter().enumerate().filter_map(|(turn, shown)| {
            let grid = shown.grid.as_ref()?;
            let (canvas, style, theme) = (&self.canvas, &self.style, &self.theme);
            Some((shown, Lay { grid, canvas, style, theme, ink: shown.ink, fastest, turn: (turn, of), cut }))
        });
        let lays: Vec<(&DrawnField, Lay<'_>)> = lays.collect();
        let mut layers = self.style.layers.clone();
        layers.sort_unstable();
        layers.dedup();
        for layer in layers {
            for (shown, lay) in &lays {
                let marks = &mut self.parts[lay.turn.0];
                match layer {
                    FlowLayer::Speed => marks.push(speed(lay)),
                    FlowLayer::Lic => marks.push(texture(lay)),
                    FlowLayer::Streamlines => marks.extend(streamlines(lay)),
                    FlowLayer::Arrows => marks.extend(arrows(lay)),
                    FlowLayer::Anchors => self.over.extend(anchors(lay, &shown.flow.anchors)),
                    FlowLayer::Critical => {
                        for (at, symbol) in symbols(lay) {
                            self.over.extend(symbol.marks(at, RADIUS * self.canvas.unit, &self.theme));
                            if !self.symbols.iter().any(|other| other.is_like(&symbol)) {
                                self.symbols.push(symbol);
                            }
                        }
                    }
                }
            }
        }
        self.over.extend_from_slice(&self.strips);
        if let Some(floor) = self.floor.as_ref().filter(|_| of > 1) {
            let mut typeface = Type::of(&Typeface::default());
            let picture = |part: &Vec<Primitive>| {
                let mut picture = floor.clone();
                raster::draw(&mut picture, &mut typeface, part);
                picture
            };
            self.pictures = self.parts.iter().map(picture).collect();
        }
    }

    /// Returns the key's rows for everything drawn so far.
    pub fn rows(&self, size: f32) -> Vec<Row<'_>> {
        let said = Said {
            style: &self.style,
            theme: &self.theme,
            ink: self.shown.first().map_or(self.theme.goal, |shown| shown.ink),
            fastest: self.fastest,
            has_anchors: self.shown.iter().any(|shown| !shown.flow.anchors.is_empty()),
            fields: self.shown.len(),
            symbols: Symbol::all().filter(|kind| self.symbols.iter().any(|seen| seen.is_like(kind))).collect(),
        };
        said.rows(size)
    }
}

/// Returns a primitive of a field with the opacity of the field's share; `None` if the share is small.
fn faded(mark: &Primitive, shares: &Shares, field: usize) -> Option<Primitive> {
    /// Smaller shares are invisible.
    const LEAST: f32 = 0.03;
    match mark {
        Primitive::Area { rings, fill } => {
            let corners = rings.first()?;
            let middle = corners.iter().sum::<Vec2>() / corners.len().max(1) as f32;
            let share = shares.at(field, middle);
            let fill = fill.faded(share);
            (share >= LEAST).then(|| Primitive::Area { rings: rings.clone(), fill })
        }
        Primitive::Pixels(image) => {
            let (mut image, width) = (image.clone(), image.width() as usize);
            for (k, pixel) in image.data_mut().chunks_exact_mut(4).enumerate().filter(|(_, pixel)| pixel[3] > 0) {
                let at = Vec2::new((k % width) as f32, (k / width) as f32) + 0.5;
                pixel[3] = (f32::from(pixel[3]) * shares.at(field, at)) as u8;
            }
            Some(Primitive::Pixels(image))
        }
        other => Some(other.clone()),
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
    use glam::Vec3;
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
