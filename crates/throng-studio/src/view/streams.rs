//! The fields of groups on the ground, as lines and arrows.

use super::derived::Derived;
use super::geometry::{Disc, Geometry, GroundPicture, Stroke};
use super::layers::Layers;
use crate::play::RunMoment;
use eframe::egui::Context;
use glam::{DVec2, Vec2};
use std::sync::Arc;
use throng_draw::{
    Camera, Color, FlowLayer, FlowMarks, FlowStyle, Image, Primitive, Projector, Style, Theme, WorldBox,
};

/// The drawing of fields.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Streams {
    /// Not drawn.
    #[default]
    None,
    /// Arrows on a regular grid.
    Arrows,
    /// Streamlines.
    Lines,
}

impl Streams {
    /// All choices.
    pub const ALL: [Self; 3] = [Self::None, Self::Arrows, Self::Lines];

    /// Returns the label.
    pub fn label(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Arrows => "arrows",
            Self::Lines => "streamlines",
        }
    }
}

/// The settings of the drawn fields.
#[derive(Clone, Debug, PartialEq)]
pub struct Currents {
    /// The drawing of the fields.
    pub streams: Streams,
    /// Whether colours on the ground show the speed.
    pub speed: bool,
    /// The visible field. `None` for all fields.
    pub only: Option<usize>,
    /// The colours.
    pub theme: Theme,
}

/// The longer side of the drawing, pixels.
const SIDE: f64 = 1000.0;
/// The rate at which fields that change are redrawn, per second.
const RATE: f64 = 4.0;

/// The fields as drawn last.
#[derive(Default)]
pub struct StreamMap {
    made: Derived<(u64, u64, WorldBox, Currents), StreamSheet>,
}

/// The result of the background computation.
struct StreamSheet {
    layer: Arc<Geometry>,
    fastest: Option<f32>,
}

impl StreamMap {
    /// Returns the fields of a moment on the visible ground, and the maximum of their colour scale, m/s.
    pub fn layer(
        &mut self,
        shown: &RunMoment,
        currents: &Currents,
        (projector, size): (&Projector, Vec2),
        ctx: &Context,
    ) -> (Arc<Geometry>, Option<f32>) {
        let flows = &shown.setting.flows;
        if (currents.streams == Streams::None && !currents.speed) || flows.is_empty() {
            *self = Self::default();
            return Default::default();
        }
        let only = currents.only.filter(|&at| at < flows.len());
        // the shares of several fields move with the agents
        let still = flows.len() == 1
            && flows.iter().enumerate().all(|(at, flow)| flow.still || only.is_some_and(|only| only != at));
        let turn = if still { 0 } else { (shown.time() * RATE) as u64 };
        let seen = seen(projector, size, shown.bounds);
        let (setting, first, now) = (shown.setting.clone(), shown.first.clone(), shown.frame.clone());
        let dear = currents.clone();
        let make = move || {
            let flows = setting.flows.iter().enumerate().filter(|(at, _)| only.is_none_or(|only| only == *at));
            let setting =
                throng_record::Setting { flows: flows.map(|(_, flow)| flow.clone()).collect(), ..(*setting).clone() };
            let marks = FlowMarks::new(&setting, &style(&dear, seen), &first, &now);
            let layer = marks.as_ref().map(|marks| Arc::new(geometry(marks, setting.origin)));
            StreamSheet { layer: layer.unwrap_or_default(), fastest: marks.and_then(|marks| marks.fastest) }
        };
        let sheet = self.made.of((shown.run, turn, seen, currents.clone()), ctx, make);
        sheet.map(|sheet| (sheet.layer.clone(), sheet.fastest)).unwrap_or_default()
    }
}

/// Returns how a recording draws fields: as the scene does, if the view draws fields; without the scene's, as the view.
pub fn flow(layers: &Layers, said: Option<FlowStyle>) -> Option<FlowStyle> {
    let drawn = drawn(layers.streams, layers.stream_speed);
    (!drawn.is_empty()).then(|| said.unwrap_or_else(|| FlowStyle::of(drawn)))
}

/// Returns the layers of the drawing of fields.
fn drawn(streams: Streams, speed: bool) -> Vec<FlowLayer> {
    let lines = match streams {
        Streams::None => None,
        Streams::Arrows => Some(FlowLayer::Arrows),
        Streams::Lines => Some(FlowLayer::Streamlines),
    };
    lines.into_iter().chain(speed.then_some(FlowLayer::Speed)).collect()
}

fn style(currents: &Currents, seen: WorldBox) -> Style {
    let size = seen.max - seen.min;
    let [width, height] = (size * (SIDE / size.max_element())).to_array().map(|side| side.clamp(16.0, SIDE) as u32);
    let flow = Some(FlowStyle::of(drawn(currents.streams, currents.speed)));
    Style { width, height, flow, view: Some(seen), legend: false, theme: currents.theme.clone(), ..Style::default() }
}

/// Returns the ground to draw fields on, rounded to steps. A plan draws a margin around the visible part, so that small
/// camera motions need no redraw. A view in space draws the whole scene.
fn seen(projector: &Projector, size: Vec2, bounds: WorldBox) -> WorldBox {
    let Projector::Plan(camera) = projector else { return bounds };
    let [low, high] = [camera.point(Vec2::new(0.0, size.y)), camera.point(Vec2::new(size.x, 0.0))];
    let step = 2f64.powf((high - low).max_element().max(1e-3).log2().floor() - 2.0);
    let [low, high] = [(low / step).floor() * step, (high / step).ceil() * step];
    // fields are unbounded, so they are drawn in a margin around the scene only
    let room = 0.25 * (bounds.max - bounds.min).max_element().max(1.0);
    let [near, far] = [low.max(bounds.min - room), high.min(bounds.max + room)];
    if near.cmplt(far).all() { WorldBox { min: near, max: far } } else { bounds }
}

/// Converts the primitives of a picture to geometry on the ground.
fn geometry(marks: &FlowMarks, origin: DVec2) -> Geometry {
    let camera = &marks.camera;
    let point = |pixel: Vec2| camera.point(pixel);
    let local = |pixel: Vec2| (point(pixel) - origin).as_vec2().extend(0.0);
    let mut ground = Geometry::default();
    for mark in &marks.marks {
        match mark {
            Primitive::Area { rings, fill } => {
                let rings: Vec<Vec<DVec2>> =
                    rings.iter().map(|ring| ring.iter().map(|&at| point(at)).collect()).collect();
                ground.area(&rings, origin, *fill);
            }
            Primitive::Line { points, closed, stroke } => {
                let points: Vec<_> = points.iter().map(|&at| local(at)).collect();
                ground.line(&points, *closed, Stroke::plain(stroke.width, stroke.color));
            }
            Primitive::Disc { center, radius, fill } => {
                let radius = f64::from(*radius) / camera.scale;
                ground.discs.push(Disc::round(local(*center), radius as f32, *fill, (0.0, *fill), 0.0));
            }
            Primitive::Pixels(image) => ground.picture = Some(picture(image, camera, origin)),
            _ => {}
        }
    }
    ground
}

fn picture(image: &Image, camera: &Camera, origin: DVec2) -> GroundPicture {
    let size = [image.width(), image.height()].map(|side| side as usize);
    let corners = [Vec2::new(0.0, size[1] as f32), Vec2::new(size[0] as f32, 0.0)];
    let rows = image.data().chunks_exact(4 * size[0].max(1)).rev();
    let pixels = rows.flat_map(|row| row.chunks_exact(4)).map(|c| Color { r: c[0], g: c[1], b: c[2], a: c[3] });
    GroundPicture::new(corners.map(|corner| camera.point(corner) - origin), size, pixels)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use throng_record::{Flow, Frame, Setting};

    const SIZE: Vec2 = Vec2::new(800.0, 600.0);

    fn bounds() -> WorldBox {
        WorldBox { min: DVec2::new(-1810.0, 3.0), max: DVec2::new(-1790.0, 13.0) }
    }

    #[test]
    fn a_plan_has_fields_wherever_it_shows_the_place_and_keeps_them_while_the_eye_moves_a_little() {
        for (scale, shift) in [(30.0, 0.0), (35.0, 1.3), (400.0, 4.0), (3.0, 0.0)] {
            let camera = |by: f64| Camera { center: DVec2::new(-1801.0 + by, 8.0), anchor: SIZE * 0.5, scale };
            let drawn = seen(&Projector::Plan(camera(shift)), SIZE, bounds());
            let [low, high] = [Vec2::new(0.0, SIZE.y), Vec2::new(SIZE.x, 0.0)].map(|at| camera(shift).point(at));
            assert!(drawn.min.cmple(low.max(bounds().min)).all() && drawn.max.cmpge(high.min(bounds().max)).all());
            // few of a hundred small motions redraw the fields
            let moves =
                (0..100).map(|k| seen(&Projector::Plan(camera(shift + f64::from(k) * 0.5 / scale)), SIZE, bounds()));
            let mut boxes: Vec<WorldBox> = moves.collect();
            boxes.dedup();
            assert!(boxes.len() <= 3, "{}", boxes.len());
        }
    }

    #[test]
    fn the_ground_is_fast_where_the_field_is() {
        let origin = DVec2::new(-1800.0, 8.0);
        // the speed increases to the north and to the east
        let field = |place: Vec3, _: f64| Vec3::X * (1.0 + 0.05 * place.x + 0.1 * place.y);
        let setting = Setting { flows: vec![Flow::of(Arc::new(field))], origin, ..Setting::default() };
        let theme = Theme::light();
        let currents = Currents { streams: Streams::Arrows, speed: true, only: None, theme: theme.clone() };
        let marks =
            FlowMarks::new(&setting, &style(&currents, bounds()), &Frame::default(), &Frame::default()).unwrap();
        let ground = geometry(&marks, origin);
        let picture = ground.picture.as_ref().unwrap();
        let [width, height] = picture.size;
        let red = |x: usize, y: usize| picture.pixels[y * width + x][0];
        // tones become darker than the ground with speed
        assert!(red(width / 2, height - 2) < red(width / 2, 1) && red(width - 2, height / 2) < red(1, height / 2));
        assert!(ground.areas.len() > 300 && ground.bytes() > 4 * width * height);
    }
}
