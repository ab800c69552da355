//! All figures of a recording.

use super::lanes::{Directions, order};
use super::{Area, Border, Contacts, Crossing, Ground, Line, People, PeopleMotion, Velocities, Ways, voronoi};

/// The settings of a measurement.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Question {
    /// Interval of velocities, seconds; rounded to rows before and after, at least a row each.
    pub interval: f64,
    /// Areas of densities and speeds.
    pub areas: Vec<Area>,
    /// Lines at which pedestrians are counted.
    pub lines: Vec<Line>,
    /// The extent of Voronoi cells.
    pub ground: Ground,
}

/// Figures at a time. Unknown values are NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Seconds.
    pub time: f64,
    /// Number of pedestrians.
    pub people: usize,
    /// Mean speed of the pedestrians with a known velocity, m/s.
    pub speed: f64,
    /// Lane order parameter.
    pub lane_order: f64,
}

/// Figures of an area at a time. Unknown values are NaN.
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
    /// Number of pedestrians.
    pub people: usize,
    /// Interval of rows, seconds.
    pub interval: f64,
    /// Number of rows before and after over which a velocity is taken.
    pub rows: usize,
    /// Figures at every time.
    pub instants: Vec<Instant>,
    /// The motion of the pedestrians.
    pub motion: PeopleMotion,
    /// The ways of the pedestrians.
    pub ways: Ways,
    /// The contacts of the pedestrians.
    pub contacts: Contacts,
    /// By area: figures at every time.
    pub areas: Vec<Vec<Inside>>,
    /// By line: the crossings.
    pub crossings: Vec<Vec<Crossing>>,
    /// Number of pedestrians in each direction along the main axis.
    pub directions: [usize; 2],
}

impl Figures {
    /// Measures a recording.
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
        let instant = |moment: &super::PeopleMoment| {
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
            motion: PeopleMotion::of(people, &velocities, rows),
            ways: Ways::of(people),
            contacts: Contacts::of(people, &velocities),
            areas: question.areas.iter().map(inside).collect(),
            crossings: question.lines.iter().map(|line| line.crossings(people)).collect(),
            directions: directions.counts(),
        }
    }

    /// Returns the mean of a figure over all times at which it is known.
    pub fn mean(&self, figure: impl Fn(&Instant) -> f64) -> f64 {
        mean(self.instants.iter().map(figure))
    }

    /// Returns the mean lane order parameter over the middle half of the time in which both directions are present:
    /// lanes have formed then.
    pub fn steady_lane_order(&self) -> f64 {
        let known: Vec<&Instant> = self.instants.iter().filter(|at| at.lane_order.is_finite()).collect();
        let (Some(first), Some(last)) = (known.first(), known.last()) else { return f64::NAN };
        let (start, quarter) = (first.time, 0.25 * (last.time - first.time));
        let middle = known.iter().filter(|at| (quarter..=3.0 * quarter).contains(&(at.time - start)));
        mean(middle.map(|at| at.lane_order))
    }
}

impl Inside {
    /// Returns the mean of a figure over all times at which it is known.
    pub fn mean(of: &[Self], figure: impl Fn(&Self) -> f64) -> f64 {
        mean(of.iter().map(figure))
    }

    /// Returns the fundamental diagram: Voronoi density and mean speed of an area at every time at which it is not
    /// empty. Voronoi speeds would be too low: if cells are cut off, a part of the area belongs to no pedestrian.
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
