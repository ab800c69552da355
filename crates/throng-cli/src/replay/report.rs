//! What came of a replay.

use super::args::ReplayArgs;
use super::kinds::in_groups;
use crate::interrupt;
use std::path::PathBuf;
use throng_record::pedestrian::replay::{Cast, Compared, Replayed, Sample, Stage, from_entry};
use throng_record::pedestrian::{Border, Figures, People, Question, Velocities, median};

/// Predictions that begin anew.
pub struct Predicted {
    /// How often, seconds.
    pub every: f64,
    /// How many times.
    pub moments: usize,
    /// What came of them, by horizon.
    pub samples: Vec<Vec<Sample>>,
}

/// How far people were off at a horizon.
pub struct Horizon {
    /// Seconds; `None`: when they were recorded last.
    pub seconds: Option<f64>,
    /// Everybody who was recorded for so long.
    pub samples: Vec<Sample>,
}

/// What came of a replay.
pub struct Report<'a> {
    /// What was asked.
    pub args: &'a ReplayArgs,
    /// Where they walked.
    pub stage: &'a Stage,
    /// Who they are.
    pub cast: &'a Cast,
    /// The file of the map, where it is not the recording's own.
    pub map: Option<PathBuf>,
    /// How many of the recorded walk through what is solid.
    pub through: usize,
    /// Who belongs together.
    pub groups: Option<Vec<Vec<u32>>>,
    /// Whether everybody belongs to somebody, by walk.
    in_groups: Vec<bool>,
    /// What came of everybody.
    pub replayed: Replayed,
    /// How far they are off since they entered.
    pub from_entry: Vec<Horizon>,
    /// The same of predictions, where they were asked for.
    pub predicted: Option<Predicted>,
    /// What is measured of both.
    pub question: Question,
    /// Figures of the recorded and of the replayed.
    pub figures: [Figures; 2],
    /// How both are distributed.
    pub compared: Compared,
    /// Whether it was interrupted.
    pub interrupted: bool,
}

impl<'a> Report<'a> {
    /// Measures both.
    pub fn new(
        args: &'a ReplayArgs,
        stage: &'a Stage,
        cast: &'a Cast,
        map: Option<PathBuf>,
        groups: Option<Vec<Vec<u32>>>,
        replayed: Replayed,
        predicted: Option<Predicted>,
    ) -> Self {
        let horizons = args.figures.horizons.iter().copied().map(Some).chain([None]);
        let from_entry = horizons.map(|seconds| Horizon { seconds, samples: from_entry(cast, &replayed, seconds) });
        let lines = args.figures.line.into_iter().collect();
        let question = Question { interval: args.figures.interval, lines, ..Question::default() };
        let again = replayed.people();
        let velocities = |people: &People| Velocities::of(people, cast.rows, Border::OneSided);
        let both = [(&cast.people, &velocities(&cast.people)), (&again, &velocities(&again))];
        let crosses =
            |walk: &&throng_record::pedestrian::Walk| walk.places.windows(2).any(|way| stage.blocks(way[0], way[1]));
        Self {
            args,
            stage,
            cast,
            map,
            through: cast.people.walks.iter().filter(crosses).count(),
            in_groups: groups.as_deref().map_or_else(Vec::new, |groups| in_groups(cast, groups)),
            groups,
            from_entry: from_entry.collect(),
            predicted,
            figures: [&cast.people, &again].map(|people| Figures::of(people, &question)),
            compared: Compared::of(both, args.figures.line),
            question,
            replayed,
            interrupted: interrupt::asked(),
        }
    }

    /// How many have arrived.
    pub fn arrived(&self) -> usize {
        self.replayed.arrived.iter().flatten().count()
    }

    /// By how much those who arrived did so later than the recorded left; of those who stay, who arrives earlier is not late. The
    /// median, seconds.
    pub fn delay(&self) -> f64 {
        let left = self.cast.people.walks.iter().map(|walk| walk.times[walk.times.len() - 1]);
        median(self.replayed.arrived.iter().zip(left).filter_map(|(at, left)| Some((*at)? - left)).collect())
    }

    /// Those of some samples who are alone, and those who belong to somebody; `None` where nobody knows.
    pub fn split<'s>(&self, samples: &'s [Sample]) -> Option<[Vec<&'s Sample>; 2]> {
        self.groups.as_ref()?;
        Some([false, true].map(|is| samples.iter().filter(|sample| self.in_groups[sample.walk] == is).collect()))
    }

    /// The group of everybody, by walk: its place among the groups.
    pub fn group_of(&self, number: u32) -> Option<usize> {
        self.groups.as_ref()?.iter().position(|group| group.contains(&number))
    }

    /// The first moment and the last, seconds.
    pub fn span(&self) -> [f64; 2] {
        let moments = &self.cast.people.moments;
        [moments.first(), moments.last()].map(|moment| moment.map_or(f64::NAN, |moment| moment.time))
    }
}

/// Mean and median of a figure of samples.
pub fn mean_and_median<'s>(samples: impl IntoIterator<Item = &'s Sample>, figure: impl Fn(&Sample) -> f64) -> [f64; 2] {
    let all: Vec<f64> = samples.into_iter().map(figure).collect();
    [all.iter().sum::<f64>() / all.len() as f64, median(all)]
}
