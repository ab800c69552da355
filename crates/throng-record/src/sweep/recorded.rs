//! What a plan records of its runs beside the summary.

use super::file::{AreaFile, AreaShape, RecordFile};
use crate::Cell;
use crate::pedestrian::{Area, Figures, Ground, Inside, Line, People, Question};
use crate::swarm::Distribution;
use glam::DVec2;
use throng::Walkable;
use throng_scene::{Error, Kind, TomlFile, TomlStep};

/// What is recorded.
#[derive(Clone, Debug)]
pub(super) struct Recorded {
    /// The settings, as the file says them.
    pub file: RecordFile,
    question: Question,
}

/// A name and a value of a figure of people.
type PeopleFigure = (&'static str, fn(&Figures) -> &Distribution);

/// The means of figures of people.
const PEOPLE: [PeopleFigure; 7] = [
    ("speed", |figures| &figures.motion.speed),
    ("turning", |figures| &figures.motion.turning),
    ("acceleration", |figures| &figures.motion.acceleration),
    ("effort", |figures| &figures.motion.effort),
    ("travel_time", |figures| &figures.ways.time),
    ("path_length", |figures| &figures.ways.length),
    ("path_ratio", |figures| &figures.ways.ratio),
];

impl Recorded {
    /// # Errors
    /// A time is not positive, or a line or an area has no extent.
    pub fn new(file: RecordFile, at: &TomlFile) -> Result<Self, Error> {
        let positive = |key: &str, value: f64| match value > 0.0 && value.is_finite() {
            true => Ok(()),
            false => {
                Err(wrong(at, ["record".into(), key.into()], format!("{key} is {value}"), "write more than 0, seconds"))
            }
        };
        positive("interval", file.interval)?;
        positive("velocity_interval", file.velocity_interval)?;
        if file.from < 0.0 || !file.from.is_finite() {
            let hint = "write 0 or more, seconds";
            return Err(wrong(at, ["record".into(), "from".into()], format!("from is {}", file.from), hint));
        }
        if let Some(to) = file.to.filter(|&to| to <= file.from || !to.is_finite()) {
            let message = format!("to is {to}, and recording begins at {} s", file.from);
            return Err(wrong(at, ["record".into(), "to".into()], message, "write more than `from`, seconds"));
        }
        let line = |(k, line): (usize, &super::file::LineFile)| {
            let [from, to] = [line.from, line.to].map(DVec2::from);
            match from.is_finite() && to.is_finite() && from.distance(to) > 0.0 {
                true => Ok(Line { from, to }),
                false => {
                    let place = ["record".into(), "line".into(), k.into()];
                    Err(wrong(at, place, format!("the line `{}` has no length", line.name), "give it two ends apart"))
                }
            }
        };
        let area = |(k, area): (usize, &AreaFile)| {
            polygon(&area.shape).and_then(Area::new).ok_or_else(|| {
                let place = ["record".into(), "area".into(), k.into()];
                wrong(at, place, format!("`{}` has no area", area.name), "give it a size, or corners, metres")
            })
        };
        let question = Question {
            interval: file.velocity_interval,
            lines: file.lines.iter().enumerate().map(line).collect::<Result<_, _>>()?,
            areas: file.areas.iter().enumerate().map(area).collect::<Result<_, _>>()?,
            ground: Ground::default(),
        };
        Ok(Self { file, question })
    }

    /// Whether positions are recorded.
    pub fn positions(&self) -> bool {
        self.file.people || !self.file.lines.is_empty() || !self.file.areas.is_empty()
    }

    /// Whether positions at this time are recorded. A small tolerance keeps rounding from leaving out a moment.
    pub fn covers(&self, time: f64) -> bool {
        time >= self.file.from - 1e-9 && time <= self.file.to.unwrap_or(f64::INFINITY) + 1e-9
    }

    /// Returns the figures of recorded people, by the names of columns.
    pub fn cells(&self, people: &People, walkable: &[Walkable]) -> Vec<(String, Cell)> {
        if !self.positions() {
            return Vec::new();
        }
        // without known ground, cells reach 1 m
        let cut_off = walkable.is_empty().then_some(1.0);
        let ground = Ground { walkable: walkable.to_vec(), cut_off };
        let question = Question { ground, ..self.question.clone() };
        let figures = Figures::of(people, &question);
        let mut cells = Vec::new();
        let mut add = |name: &str, of: &[(&'static str, Cell)]| {
            cells.extend(of.iter().map(|(figure, cell)| (format!("{name}.{figure}"), cell.clone())));
        };
        for ((line, file), crossings) in question.lines.iter().zip(&self.file.lines).zip(&figures.crossings) {
            add(&file.name, &line.cells(crossings));
        }
        for (file, inside) in self.file.areas.iter().zip(&figures.areas) {
            add(&file.name, &Inside::cells(inside));
        }
        if self.file.people {
            add("people", &PEOPLE.map(|(name, figure)| (name, figure(&figures).mean().into())));
            add("people", &figures.cells());
        }
        cells
    }
}

fn wrong<const N: usize>(at: &TomlFile, place: [TomlStep; N], message: String, hint: &str) -> Error {
    at.error(Kind::OutOfRange, place, message, hint)
}

/// Returns the corners of an area; `None` if a coordinate is not finite.
fn polygon(shape: &AreaShape) -> Option<Vec<DVec2>> {
    let corners = match shape {
        AreaShape::Polygon(corners) => corners.iter().map(|&corner| DVec2::from(corner)).collect(),
        AreaShape::Rectangle(rectangle) => {
            let (center, half) = (DVec2::from(rectangle.center), 0.5 * DVec2::from(rectangle.size));
            let turn = DVec2::from_angle(rectangle.rotation.to_radians());
            let corner = |[x, y]: [f64; 2]| center + turn.rotate(half * DVec2::new(x, y));
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(corner).to_vec()
        }
    };
    Some(corners).filter(|corners: &Vec<DVec2>| corners.iter().all(|corner| corner.is_finite()))
}
