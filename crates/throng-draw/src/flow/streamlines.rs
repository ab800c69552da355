//! Evenly spaced streamlines by Jobard and Lefer 1997: each new line starts beside an existing one and ends where it
//! comes too near to another. Lines taper where they crowd.

use super::Lay;
use super::blade::{blade, head};
use crate::primitive::Primitive;
use glam::Vec2;

/// The distance between lines at their starts, in units of the layout.
const APART: f32 = 15.0;
/// The least distance between lines, relative to that.
const NEAREST: f32 = 0.5;
/// The length of integration steps, in units of the layout.
const STEP: f32 = 1.6;
/// The least length of lines, relative to their distance.
const SHORTEST: f32 = 1.6;
/// Half the width of lines where a field is fastest and slowest, the distance of heads, and their length, in units of
/// the layout.
const HALF: [f32; 2] = [0.62, 0.3];
const HEADS: f32 = 120.0;
const HEAD: f32 = 5.2;
/// The opacity of lines.
pub(super) const OPACITY: f32 = 0.62;
/// The maximum number of points of all lines together; normal pictures stay below it.
const MOST: usize = 4_000_000;

/// A line in the direction of the flow.
pub(super) type Line = Vec<Vec2>;

/// A point of a line: its position, its line, and the number of steps from the seed of the line.
#[derive(Clone, Copy, Debug)]
struct Point {
    at: Vec2,
    line: u32,
    step: i32,
}

/// Traces lines and keeps all their points, in square cells as wide as the distance of lines.
struct Tracer<'a> {
    lay: &'a Lay<'a>,
    apart: f32,
    step: f32,
    columns: usize,
    cells: Vec<Vec<Point>>,
    count: usize,
}

/// Returns the lines as primitives.
pub(super) fn streamlines(lay: &Lay<'_>) -> Vec<Primitive> {
    let mut tracer = Tracer::new(lay);
    let lines = tracer.all();
    (0..).zip(&lines).flat_map(|(index, line)| tracer.marks(index, line)).collect()
}

impl<'a> Tracer<'a> {
    pub fn new(lay: &'a Lay<'a>) -> Self {
        let (turn, of) = lay.turn;
        // Lines of several fields cross each other and need a little more space.
        let apart = APART * lay.canvas.unit * lay.style.spread() * (of as f32).sqrt() * (1.0 + 0.001 * turn as f32);
        let [columns, rows] = (lay.canvas.size / apart).ceil().to_array().map(|count| count as usize + 1);
        let step = (STEP * lay.canvas.unit).min(0.2 * apart);
        Self { lay, apart, step, columns, cells: vec![Vec::new(); columns * rows], count: 0 }
    }

    /// Traces lines until the picture is full.
    pub fn all(&mut self) -> Vec<Line> {
        let mut lines: Vec<Line> = Vec::new();
        let mut next = 0;
        // Seeds on a lattice, fastest first, reach the regions that no existing line leads to.
        for seed in self.lattice() {
            self.draw(seed, &mut lines);
            while next < lines.len() {
                let line = lines[next].clone();
                let every = ((0.5 * self.apart / self.step) as usize).max(1);
                for index in (0..line.len()).step_by(every) {
                    let along =
                        (line[(index + 1).min(line.len() - 1)] - line[index.saturating_sub(1)]).normalize_or_zero();
                    for side in [along.perp(), -along.perp()] {
                        self.draw(line[index] + side * (1.001 * self.apart), &mut lines);
                    }
                }
                next += 1;
            }
        }
        lines
    }

    /// Returns seeds all over the picture, fastest first.
    fn lattice(&self) -> Vec<Vec2> {
        let size = self.lay.canvas.size;
        let [columns, rows] = (size / self.apart).ceil().to_array().map(|count| count as usize);
        let middle = |index: usize| (Vec2::new((index % columns) as f32, (index / columns) as f32) + 0.5) * self.apart;
        let speed = |at: Vec2| (self.lay.flow(at).length(), at);
        let mut seeds: Vec<(f32, Vec2)> = (0..columns * rows).map(middle).map(speed).collect();
        seeds.sort_by(|a, b| b.0.total_cmp(&a.0));
        seeds.into_iter().take_while(|seed| seed.0 > 0.0).map(|seed| seed.1).collect()
    }

    /// Traces the line through a seed, if there is space for it.
    fn draw(&mut self, seed: Vec2, lines: &mut Vec<Line>) {
        let number = lines.len() as u32;
        if self.lay.flow(seed) == Vec2::ZERO || self.is_near(seed, self.apart, |_| true) || self.count > MOST {
            return;
        }
        let (ahead, closed) = self.trace(seed, 1, number);
        let behind = if closed { Vec::new() } else { self.trace(seed, -1, number).0 };
        let length = (ahead.len() + behind.len()) as f32 * self.step;
        if length < SHORTEST * self.apart {
            self.forget(number, ahead.iter().chain(&behind));
            return;
        }
        self.keep(Point { at: seed, line: number, step: 0 });
        lines.push(behind.into_iter().rev().chain([seed]).chain(ahead).collect());
    }

    /// Traces from a seed with the flow or against it. Returns the line and whether it leads back to the seed.
    fn trace(&mut self, seed: Vec2, sense: i32, line: u32) -> (Line, bool) {
        let way = |at: Vec2| self.lay.flow(at).try_normalize().map(|way| way * sense as f32);
        let (mut at, mut points): (Vec2, Line) = (seed, Vec::new());
        let nearest = NEAREST * self.apart;
        let few = (3.0 * nearest / self.step) as i32;
        let mut kept = Vec::new();
        let mut closed = false;
        for step in 1..(MOST as i32) {
            // The midpoint rule.
            let Some(half) = way(at).and_then(|first| way(at + first * (0.5 * self.step))) else { break };
            let to = at + half * self.step;
            if self.lay.flow(to) == Vec2::ZERO {
                break;
            }
            if step > few && to.distance(seed) < self.step {
                points.push(seed);
                closed = true;
                break;
            }
            // Points of the line itself count too, except those just behind, and those near the seed, where the line
            // may close.
            let others = |other: &Point| {
                other.line != line
                    || (other.step != 0 && (step - other.step * sense).abs() > few && other.step.abs() > few)
            };
            if self.is_near(to, nearest, others)
                || kept
                    .iter()
                    .rev()
                    .skip(few as usize)
                    .any(|&p: &Vec2| p.distance(to) < 0.5 * nearest && p.distance(seed) > nearest)
            {
                break;
            }
            points.push(to);
            kept.push(to);
            at = to;
            if self.count + kept.len() > MOST {
                break;
            }
        }
        (0..).zip(&points).for_each(|(index, &at)| self.keep(Point { at, line, step: (index + 1) * sense }));
        (points, closed)
    }

    fn cell(&self, at: Vec2) -> Option<usize> {
        let cell = (at / self.apart).max(Vec2::ZERO);
        let index = cell.y as usize * self.columns + cell.x as usize;
        ((cell.x as usize) < self.columns && index < self.cells.len()).then_some(index)
    }

    fn keep(&mut self, point: Point) {
        if let Some(cell) = self.cell(point.at) {
            self.cells[cell].push(point);
            self.count += 1;
        }
    }

    fn forget<'p>(&mut self, line: u32, points: impl Iterator<Item = &'p Vec2>) {
        for point in points {
            if let Some(cell) = self.cell(*point) {
                let before = self.cells[cell].len();
                self.cells[cell].retain(|point| point.line != line);
                self.count -= before - self.cells[cell].len();
            }
        }
    }

    /// Returns the points in the cells around a position: all points within the distance of lines, and some farther
    /// ones.
    fn round(&self, at: Vec2) -> impl Iterator<Item = &Point> {
        let cell = (at / self.apart).floor();
        let neighbours = (0..9).map(move |k| cell + Vec2::new((k % 3) as f32 - 1.0, (k / 3) as f32 - 1.0));
        neighbours
            .filter(|cell| cell.cmpge(Vec2::ZERO).all())
            .filter_map(|cell| self.cell((cell + 0.5) * self.apart))
            .flat_map(|cell| &self.cells[cell])
    }

    fn is_near(&self, at: Vec2, distance: f32, counts: impl Fn(&Point) -> bool) -> bool {
        self.round(at).any(|point| point.at.distance_squared(at) < distance * distance && counts(point))
    }

    /// Returns a line as a blade with heads.
    fn marks(&self, index: u32, line: &Line) -> Vec<Primitive> {
        let (lay, unit) = (self.lay, self.lay.canvas.unit);
        let fill = super::line(lay.ink, lay.theme);
        let taper = |at: Vec2| {
            let others = self.round(at).filter(|point| point.line != index);
            let nearest = others.map(|point| point.at.distance(at)).fold(self.apart, f32::min);
            ((nearest / self.apart - NEAREST) / (1.0 - NEAREST)).clamp(0.0, 1.0)
        };
        let tip = 0.5 * self.apart / self.step;
        let half = |index: usize, at: Vec2| {
            let part = lay.part(lay.grid.at(at)).sqrt();
            // Both ends taper off.
            let end = ((index.min(line.len() - 1 - index) as f32 + 0.5) / tip).min(1.0);
            unit * (HALF[1] + (HALF[0] - HALF[1]) * part) * (0.55 + 0.45 * taper(at)) * end.max(0.25)
        };
        let points: Vec<(Vec2, f32)> = (0..).zip(line).map(|(index, &at)| (at, half(index, at))).collect();
        // A line that turns little needs only a few points.
        let few: Vec<(Vec2, f32)> = thin(&points, 0.08 * unit);
        let length = (line.len() - 1) as f32 * self.step;
        let heads = (length / (HEADS * unit * lay.style.spread().sqrt())).round().max(1.0);
        let head_at = |k: usize| {
            let at = ((k as f32 + 0.5) / heads * (line.len() - 1) as f32) as usize;
            let along = (line[(at + 1).min(line.len() - 1)] - line[at.saturating_sub(1)]).normalize_or_zero();
            let size = HEAD * unit * (0.7 + 0.3 * lay.part(lay.grid.at(line[at])));
            let ring = head(line[at] + along * (0.5 * size), along, size);
            Primitive::Area { rings: vec![ring], fill: fill.alpha(f32::from(fill.a) / 255.0 + 0.15) }
        };
        let pieces: Vec<&[(Vec2, f32)]> = match lay.cut {
            Some(cut) => pieces(&few, cut),
            None => vec![&few],
        };
        pieces.into_iter().filter_map(|piece| blade(piece, fill)).chain((0..heads as usize).map(head_at)).collect()
    }
}

/// Cuts a line into pieces of at least `cut` pixels, each of which begins where the one before it ends.
fn pieces(points: &[(Vec2, f32)], cut: f32) -> Vec<&[(Vec2, f32)]> {
    let (mut pieces, mut first, mut length) = (Vec::new(), 0, 0.0);
    for index in 1..points.len() {
        length += points[index].0.distance(points[index - 1].0);
        if length >= cut || index + 1 == points.len() {
            pieces.push(&points[first..=index]);
            (first, length) = (index, 0.0);
        }
    }
    pieces
}

/// Drops points that lie within `off` of the straight line between their kept neighbours.
fn thin(points: &[(Vec2, f32)], off: f32) -> Vec<(Vec2, f32)> {
    /// The maximum number of consecutive dropped points.
    const ROW: usize = 8;
    let mut few: Vec<(Vec2, f32)> = points.first().copied().into_iter().collect();
    let mut last = 0;
    for index in 1..points.len() {
        let end = index + 1 == points.len();
        let strays = !end && {
            let (from, to) = (points[last].0, points[index + 1].0);
            let along = (to - from).normalize_or_zero();
            points[last + 1..=index].iter().any(|point| along.perp_dot(point.0 - from).abs() > off)
        };
        if end || strays || index - last >= ROW {
            few.push(points[index]);
            last = index;
        }
    }
    few
}

#[cfg(test)]
mod tests {
    use super::super::{Canvas, FlowStyle, Grid, Mask};
    use super::*;
    use crate::{Camera, Theme, WorldBox};
    use glam::{DVec2, Vec3};
    use throng_record::Setting;

    /// Returns the lines of a field over 20 by 15 m at 20 pixels per metre.
    fn lines(field: fn(Vec3) -> Vec3) -> (Vec<Line>, f32) {
        let half = DVec2::new(10.0, 7.5);
        let size = Vec2::new(400.0, 300.0);
        let camera = Camera::fit(WorldBox { min: -half, max: half }, Vec2::ZERO, size);
        let free = Mask::new((400, 300), &Setting::default(), &camera, 1.0);
        let canvas = Canvas { camera, origin: DVec2::ZERO, size, unit: 1.0, free };
        let flow = move |place: Vec3, _: f64| field(place);
        let grid = Grid::of(&flow, &canvas, 0.0).unwrap();
        let (style, theme) = (FlowStyle::default(), Theme::light());
        let ink = theme.text;
        let lay = Lay {
            grid: &grid,
            canvas: &canvas,
            style: &style,
            theme: &theme,
            ink,
            fastest: 5.0,
            turn: (0, 1),
            cut: None,
        };
        let mut tracer = Tracer::new(&lay);
        (tracer.all(), tracer.apart)
    }

    const FIELDS: [fn(Vec3) -> Vec3; 5] = [
        |_| Vec3::new(1.0, 0.3, 0.0),
        |at| Vec3::Z.cross(at),
        |at| Vec3::new(at.x, -at.y, 0.0),
        |at| Vec3::Z.cross(at) * 0.5 - at * 0.3,
        |at| Vec3::new(2.0, (0.7 * at.x).sin() * 2.0, 0.0),
    ];

    #[test]
    fn lines_follow_the_field() {
        for field in FIELDS {
            for pair in lines(field).0.iter().flat_map(|line| line.windows(2)) {
                let middle = (pair[0] + pair[1]) * 0.5;
                let place = Vec3::new((middle.x - 200.0) / 20.0, (150.0 - middle.y) / 20.0, 0.0);
                let want = (field(place).truncate() * Vec2::new(1.0, -1.0)).normalize_or_zero();
                let way = (pair[1] - pair[0]).normalize_or(want);
                assert!(way.dot(want) > 0.0 && way.perp_dot(want).abs() < 0.05, "{way}, not {want}, at {place}");
            }
        }
    }

    #[test]
    fn lines_keep_their_distance_and_fill_the_picture() {
        for field in FIELDS {
            let (lines, apart) = lines(field);
            for (index, line) in lines.iter().enumerate() {
                let others = || lines[..index].iter().flatten();
                let nearest = |at: &Vec2| others().map(|other| other.distance(*at)).fold(f32::INFINITY, f32::min);
                let near = line.iter().map(nearest).fold(f32::INFINITY, f32::min);
                assert!(near >= NEAREST * apart - 1e-3, "{near} pixels between lines");
            }
            // Every position is near a line, except where a line would be too short.
            let spots = (2..18).flat_map(|x| (2..13).map(move |y| Vec2::new(x as f32, y as f32) * 20.0));
            let gaps = spots
                .map(|spot| lines.iter().flatten().map(|point| point.distance(spot)).fold(f32::INFINITY, f32::min));
            let widest = gaps.fold(0.0, f32::max);
            assert!(widest <= 1.5 * apart, "a gap of {widest} pixels");
        }
    }
}
