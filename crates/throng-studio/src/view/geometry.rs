//! Geometry relative to the world's origin, in the layout of the graphics buffers: areas, discs, lines and figures.

use super::people::DrawnPeople;
use bytemuck::{Pod, Zeroable};
use glam::{DVec2, Vec2, Vec3};
use throng_draw::{Coat, Color, Shape};
use throng_record::Body;

/// Red, green, blue and opacity, not premultiplied.
type Paint = [u8; 4];

/// A corner of a triangle.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Corner {
    at: Vec3,
    color: Paint,
}

/// A line of constant width on the screen.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Line {
    from: Vec3,
    to: Vec3,
    color: Paint,
    /// Width, and length of dashes and gaps (0: no dashes), points of the screen.
    stroke: Vec2,
}

#[cfg(test)]
impl Line {
    /// Returns the start and the end.
    pub fn ends(&self) -> [Vec3; 2] {
        [self.from, self.to]
    }
}

/// A horizontal body, interpolated between two states.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Disc {
    before: [f32; 4],
    now: [f32; 4],
    /// Radius, half extents of the core, and 0.
    body: [f32; 4],
    /// Width of the rim, points of the screen (negative: share of the radius); least radius, points; opacity of the
    /// notch; 1: draws only the shadow.
    look: [f32; 4],
    fill: Paint,
    rim: Paint,
}

/// An agent drawn as a shape, interpolated between two states.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Figure {
    /// Position, and phase of the motion.
    before: [f32; 4],
    now: [f32; 4],
    /// Current forward direction, and radius.
    body: [f32; 4],
    /// Up direction; least radius, points of the screen.
    look: [f32; 4],
    fill: Paint,
    /// Previous forward direction.
    turn: [f32; 4],
}

impl Figure {
    /// Creates the figure of an agent between two states. `phases` are the phases of its motion in both states.
    pub fn new(shape: Shape, [before, now]: [&Body; 2], phases: [f32; 2], fill: Color, origin: DVec2) -> Self {
        let ahead =
            |body: &Body| body.basis.map_or_else(|| Vec2::from_angle(body.heading).extend(0.0), |basis| basis.forward);
        let at = |body: &Body, phase: f32| [pose(body, origin)[0], pose(body, origin)[1], body.altitude, phase];
        Self {
            before: at(before, phases[0]),
            now: at(now, phases[1]),
            body: ahead(now).extend(shape.unit(now)).to_array(),
            look: now.basis.map_or(Vec3::Z, |basis| basis.up).extend(LEAST_FIGURE).to_array(),
            fill: paint(fill),
            turn: ahead(before).extend(0.0).to_array(),
        }
    }
}

/// The least drawn radius of a shape, points of the screen.
const LEAST_FIGURE: f32 = 2.2;
/// The least drawn radius of a disc, points of the screen.
const LEAST_RADIUS: f32 = 1.5;

impl Disc {
    /// Creates the disc of an agent between two states.
    pub fn agent(before: &Body, now: &Body, coat: Coat, origin: DVec2) -> Self {
        let stranded = now.status == throng::Status::Stranded;
        Self {
            before: pose(before, origin),
            now: pose(now, origin),
            body: [now.radius, now.core.x, now.core.y, 0.0],
            look: [if stranded { -0.34 } else { -0.13 }, LEAST_RADIUS, 1.0, 0.0],
            fill: paint(coat.fill),
            rim: paint(coat.rim),
        }
    }

    /// Creates the shadow of an agent.
    pub fn shadow(before: &Body, now: &Body, coat: Coat, origin: DVec2) -> Self {
        let disc = Self::agent(before, now, coat, origin);
        let [rim, least, notch, _] = disc.look;
        Self { look: [rim, least, notch, 1.0], ..disc }
    }

    /// Creates a ring around an agent.
    pub fn round_agent(before: &Body, now: &Body, color: Color, origin: DVec2) -> Self {
        let disc = Self::agent(before, now, Coat { fill: color.alpha(0.0), rim: color }, origin);
        let [radius, along, across, rest] = disc.body;
        Self { body: [1.35 * radius, along, across, rest], look: [1.8, 6.0, 0.0, 0.0], ..disc }
    }

    /// Returns the altitude.
    pub fn altitude(&self) -> f32 {
        self.now[2]
    }

    /// Creates a disc with a rim of this width and at least this radius, points of the screen.
    pub fn round(center: Vec3, radius: f32, fill: Color, rim: (f32, Color), least: f32) -> Self {
        let at = center.extend(0.0).to_array();
        let (width, rim) = rim;
        let (fill, rim) = (paint(fill), paint(rim));
        Self { before: at, now: at, body: [radius, 0.0, 0.0, 0.0], look: [width, least, 0.0, 0.0], fill, rim }
    }
}

fn pose(body: &Body, origin: DVec2) -> [f32; 4] {
    (body.position - origin).as_vec2().extend(body.altitude).extend(body.heading).to_array()
}

/// Returns a colour as the buffers have it.
pub fn paint(color: Color) -> Paint {
    [color.r, color.g, color.b, color.a]
}

/// The corners of a picture with the least and the greatest coordinates.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Tile {
    from: Vec3,
    to: Vec3,
}

/// A picture on the ground.
#[derive(Clone, Debug)]
pub struct GroundPicture {
    /// The position.
    pub tile: Tile,
    /// Pixels along x and along y.
    pub size: [usize; 2],
    /// Rows from the corner with the least coordinates, with premultiplied opacity.
    pub pixels: Vec<Paint>,
}

impl GroundPicture {
    /// Creates a picture between two corners on the ground, relative to the world's origin.
    pub fn new([low, high]: [DVec2; 2], size: [usize; 2], pixels: impl Iterator<Item = Color>) -> Self {
        let [from, to] = [low, high].map(|corner| corner.as_vec2().extend(0.0));
        let multiplied = |color: Color| {
            let part = |channel: u8| (u16::from(channel) * u16::from(color.a) / 255) as u8;
            [part(color.r), part(color.g), part(color.b), color.a]
        };
        Self { tile: Tile { from, to }, size, pixels: pixels.map(multiplied).collect() }
    }
}

/// The content of a layer. Areas cover the picture, discs cover areas, lines cover discs.
#[derive(Clone, Debug, Default)]
pub struct Geometry {
    /// The picture on the ground.
    pub picture: Option<GroundPicture>,
    /// Triangles, three corners each.
    pub areas: Vec<Corner>,
    /// Bodies and circles.
    pub discs: Vec<Disc>,
    /// Lines.
    pub lines: Vec<Line>,
    /// Agents drawn as shapes, by [`Shape`].
    pub figures: [Vec<Figure>; Shape::ALL.len()],
    /// Agents drawn as people.
    pub people: Option<DrawnPeople>,
    /// Whether the depth test applies. Otherwise later items cover earlier ones.
    pub deep: bool,
}

impl Geometry {
    /// Returns the size of the buffers in bytes.
    pub fn bytes(&self) -> usize {
        let figures: usize = self.figures.iter().map(|figures| size_of_val(figures.as_slice())).sum();
        let picture = self.picture.as_ref().map_or(0, |picture| size_of_val(picture.pixels.as_slice()));
        let plain = picture + size_of_val(self.areas.as_slice()) + size_of_val(self.discs.as_slice());
        let people = self.people.as_ref().map_or(0, DrawnPeople::bytes);
        plain + size_of_val(self.lines.as_slice()) + figures + people
    }

    /// Adds a polygon with holes on the ground. The first ring is the outer one.
    pub fn area(&mut self, rings: &[Vec<DVec2>], origin: DVec2, color: Color) {
        self.area_at(rings, origin, 0.0, color);
    }

    /// Adds a polygon with holes at a height, metres.
    pub fn area_at(&mut self, rings: &[Vec<DVec2>], origin: DVec2, height: f32, color: Color) {
        let corners: Vec<[f64; 2]> = rings.iter().flatten().map(|&corner| (corner - origin).to_array()).collect();
        if corners.len() < 3 || corners.iter().flatten().any(|x| !x.is_finite()) {
            return;
        }
        let holes = rings.iter().scan(0, |end, ring| {
            *end += ring.len();
            Some(*end)
        });
        let holes: Vec<u32> = holes.take(rings.len() - 1).map(|hole| hole as u32).collect();
        let mut triangles: Vec<u32> = Vec::new();
        earcut::Earcut::new().earcut(corners.iter().copied(), &holes, &mut triangles);
        let corner = |k: u32| {
            let [x, y] = corners[k as usize];
            Corner { at: Vec3::new(x as f32, y as f32, height), color: paint(color) }
        };
        self.areas.extend(triangles.into_iter().map(corner));
    }

    /// Adds a flat convex polygon in space.
    pub fn facet(&mut self, corners: &[Vec3], color: Color) {
        let color = paint(color);
        for pair in corners.windows(2).skip(1) {
            self.areas.extend([corners[0], pair[0], pair[1]].map(|at| Corner { at, color }));
        }
    }

    /// Adds a horizontal ribbon through points: position, half width in metres, and colour.
    pub fn ribbon(&mut self, ends: &[(Vec3, f32, Color)]) {
        let sides = |k: usize| {
            let (at, half, color) = ends[k];
            let along = ends[(k + 1).min(ends.len() - 1)].0 - ends[k.saturating_sub(1)].0;
            let aside = along.truncate().perp().normalize_or_zero().extend(0.0) * half;
            [at + aside, at - aside].map(|at| Corner { at, color: paint(color) })
        };
        for k in 1..ends.len() {
            let ([a, b], [c, d]) = (sides(k - 1), sides(k));
            self.areas.extend([a, b, c, c, b, d]);
        }
    }

    /// Adds a line through points.
    pub fn line(&mut self, points: &[Vec3], closed: bool, stroke: Stroke) {
        let Stroke { width, color, dash } = stroke;
        let (color, stroke) = (paint(color), Vec2::new(width, dash));
        let ends = points.windows(2).map(|pair| (pair[0], pair[1]));
        let back = points.last().zip(points.first()).filter(|_| closed).map(|(&last, &first)| (last, first));
        let lines = ends.chain(back).filter(|(from, to)| from.is_finite() && to.is_finite());
        self.lines.extend(lines.map(|(from, to)| Line { from, to, color, stroke }));
    }
}

/// The style of a line.
#[derive(Clone, Copy, Debug)]
pub struct Stroke {
    /// Width, points of the screen.
    pub width: f32,
    /// Colour.
    pub color: Color,
    /// Length of dashes and gaps, points of the screen. 0 for a solid line.
    pub dash: f32,
}

impl Stroke {
    /// Creates a solid stroke.
    pub fn plain(width: f32, color: Color) -> Self {
        Self { width, color, dash: 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_with_a_hole_keeps_its_area() {
        let square =
            |half: f64| [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| DVec2::new(x, y) * half);
        let mut geometry = Geometry::default();
        geometry.area(&[square(2.0).to_vec(), square(1.0).to_vec()], DVec2::ZERO, Color::rgb(0));
        let area = |t: &[Corner]| 0.5 * (t[1].at - t[0].at).cross(t[2].at - t[0].at).length();
        assert_eq!(geometry.areas.chunks(3).map(area).sum::<f32>(), 12.0);
        geometry.area(&[vec![DVec2::NAN; 3]], DVec2::ZERO, Color::rgb(0));
        assert_eq!(geometry.areas.len(), 24);
    }
}
