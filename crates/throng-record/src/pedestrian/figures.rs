//! All figures of a recording at once.

use super::lanes::{Directions, order};
use super::{Area, Border, Contacts, Crossing, Ground, Line, Motion, People, Velocities, Ways, voronoi};

/// What is to be measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Question {
    /// Time over which a velocity is taken, seconds: as many rows before and after as come nearest to it, one at least.
    pub interval: f64,
    /// Where densities and speeds are measured.
    pub areas: Vec<Area>,
    /// Which lines people are counted at.
    pub lines: Vec<Line>,
    /// How far Voronoi cells reach.
    pub ground: Ground,
}

/// One moment. What is not known is not a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Seconds.
    pub time: f64,
    /// How many are there.
    pub people: usize,
    /// Mean speed of those whose is known, m/s.
    pub speed: f64,
    /// Lane order parameter.
    pub lane_order: f64,
}

/// An area at one moment. What is not known is not a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inside {
    /// Classic density of the area, 1/m².
    pub density: f64,
    /// Mean speed in the area, m/s.
    pub speed: f64,
    /// Voronoi density of the area, 1/m².
    pub voronoi_density: f64,
    /// Voronoi speed of the area, m/s.
    pub voronoi_speed: f64,
}

/// The figures of a recording.
#[derive(Clone, Debug)]
pub struct Figures {
    /// How many people.
    pub people: usize,
    /// Time from row to row, seconds.
    pub interval: f64,
    /// Rows to each side that a velocity is taken over.
    pub rows: usize,
    /// Moment by moment.
    pub instants: Vec<Instant>,
    /// How people move.
    pub motion: Motion,
    /// Their ways.
    pub ways: Ways,
    /// How near they come.
    pub contacts: Contacts,
    /// Of each area, moment by moment.
    pub areas: Vec<Vec<Inside>>,
    /// Of each line, who crosses it, and when.
    pub crossings: Vec<Vec<Crossing>>,
    /// How many go each way along the axis most go along.
    pub directions: [usize; 2],
}

impl Figures {
    /// Measures people.
    ///
    /// ```
    /// use throng_record::pedestrian::{Figures, People, Question};
    /// let figures = Figures::of(&People::default(), &Question::default());
    /// assert_eq!((figures.people, figures.instants.len()), (0, 0));
    /// ```
    pub fn of(people: &People, question: &Question) -> Self {
        let interval = people.interval();
        let rows = (0.5 * question.interval / interval).round();
        let rows = if rows >= 1.0 { rows as usize } else { 1 };
        let velocities = Velocities::of(people, rows, Border::OneSided);
        let directions = Directions::of(people);
        let inside = |area: &Area| {
            let at = |moment| {
                let cells = voronoi::cells(people, moment, &question.ground, area);
                Inside {
                    density: area.density(people, moment),
                    speed: area.speed(people, moment, &velocities),
                    voronoi_density: voronoi::density(&cells, area),
                    voronoi_speed: voronoi::speed(&cells, area, |here| velocities.at(here)),
                }
            };
            people.moments.iter().map(at).collect()
        };
        let instant = |moment: &super::Moment| {
            let speeds = moment.here.iter().filter_map(|&here| velocities.at(here)).map(glam::DVec2::length);
            let (sum, known) = speeds.fold((0.0, 0u32), |(sum, known), speed| (sum + speed, known + 1));
            Instant {
                time: moment.time,
                people: moment.here.len(),
                speed: sum / f64::from(known),
                lane_order: order(people, moment, &directions).unwrap_or(f64::NAN),
            }
        };
        Self {
            people: people.walks.len(),
            interval,
            rows,
            instants: people.moments.iter().map(instant).collect(),
            motion: Motion::of(people, &velocities, rows),
            ways: Ways::of(people),
            contacts: Contacts::of(people, &velocities),
            areas: question.areas.iter().map(inside).collect(),
            crossings: question.lines.iter().map(|line| line.crossings(people)).collect(),
            directions: directions.counts(),
        }
    }

    /// The mean over moments of what is known.
    pub fn mean(&self, figure: impl Fn(&Instant) -> f64) -> f64 {
        mean(self.instants.iter().map(figure))
    }

    /// The mean lane order parameter of the middle half of the time in which both directions are there: when lanes have formed.
    pub fn steady_lane_order(&self) -> f64 {
        let known: Vec<&Instant> = self.instants.iter().filter(|at| at.lane_order.is_finite()).collect();
        let (Some(first), Some(last)) = (known.first(), known.last()) else { return f64::NAN };
        let (start, quarter) = (first.time, 0.25 * (last.time - first.time));
        let middle = known.iter().filter(|at| (quarter..=3.0 * quarter).contains(&(at.time - start)));
        mean(middle.map(|at| at.lane_order))
    }
}

impl Inside {
    /// The mean over moments of what is known.
    pub fn mean(of: &[Self], figure: impl Fn(&Self) -> f64) -> f64 {
        mean(of.iter().map(figure))
    }

    /// The fundamental diagram: Voronoi density and mean speed of an area at every moment at which somebody is in it. Voronoi speeds
    /// would be too low where cells are cut off and leave ground to nobody.
    pub fn fundamental_diagram(of: &[Self]) -> Vec<[f64; 2]> {
        let known = of.iter().filter(|at| at.voronoi_density > 0.0 && at.speed.is_finite());
        known.map(|at| [at.voronoi_density, at.speed]).collect()
    }
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let known = values.filter(|value| value.is_finite());
    let (sum, count) = known.fold((0.0, 0u32), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count)
}
