//! What came of a replay.

use super::kinds::in_groups;
use super::setup::Setup;
use crate::interrupt;
use throng_record::pedestrian::replay::{Cast, Compared, PREDICTORS, Replayed, Sample, from_entry};
use throng_record::pedestrian::{Border, Figures, Microscopic, People, Question, Velocities, median};

/// The predictors that know nothing of others, as keys.
const KEYS: [&str; 2] = ["constant_velocity", "straight"];

/// Predictions that begin anew.
pub struct Predicted {
    /// How often, seconds.
    pub every: f64,
    /// How many times.
    pub moments: usize,
    /// How far ahead, seconds: those that were asked for, then those of a page.
    pub horizons: Vec<f64>,
    /// What came of them, by model and horizon.
    pub samples: Vec<Vec<Vec<Sample>>>,
}

/// How far people were off at a horizon.
pub struct Horizon {
    /// Seconds; `None`: when they were recorded last.
    pub seconds: Option<f64>,
    /// Everybody who was recorded for so long, by model.
    pub samples: Vec<Vec<Sample>>,
}

/// What came of a model.
pub struct Came {
    /// What came of everybody.
    pub replayed: Replayed,
    /// Their figures.
    pub figures: Figures,
    /// How they are distributed, beside the recorded.
    pub compared: Compared,
    /// How they move next to each other.
    pub microscopic: Microscopic,
}

/// What came of a replay.
pub struct Report<'a> {
    /// What was replayed.
    pub setup: &'a Setup<'a>,
    /// How many of the recorded walk through what is solid.
    pub through: usize,
    /// Whether everybody belongs to somebody, by walk.
    in_groups: Vec<bool>,
    /// What came of each model.
    pub models: Vec<Came>,
    /// How far people are off since they entered.
    pub from_entry: Vec<Horizon>,
    /// The same of predictions, where they were asked for.
    pub predicted: Option<Predicted>,
    /// What is measured of all.
    pub question: Question,
    /// Figures of the recorded.
    pub recorded: Figures,
    /// How the recorded move next to each other.
    pub microscopic: Microscopic,
    /// Whether it was interrupted.
    pub interrupted: bool,
}

/// The pauses that agents are given.
pub struct Pauses {
    /// How many people pause.
    pub people: usize,
    /// How many pauses they make.
    pub count: usize,
    /// How long these are together, seconds.
    pub seconds: f64,
}

impl Pauses {
    /// Those of all recorded people.
    pub fn of(cast: &Cast) -> Self {
        let all = || cast.walkers.iter().flat_map(|walker| &walker.pauses);
        Self {
            people: cast.walkers.iter().filter(|walker| !walker.pauses.is_empty()).count(),
            count: all().count(),
            seconds: all().fold(0.0, |sum, pause| sum + (pause.until - pause.from)),
        }
    }
}

/// One of those that say where people will be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Predictor<'a> {
    /// What it is called.
    pub name: &'a str,
    /// By which model its samples are, and which of their figures are its own.
    model: usize,
    own: usize,
}

impl Predictor<'_> {
    /// Its displacement over the time, metres.
    pub fn average(&self, sample: &Sample) -> f64 {
        sample.average[self.own]
    }

    /// Its displacement at the end, metres.
    pub fn last(&self, sample: &Sample) -> f64 {
        sample.last[self.own]
    }

    /// Its own of the samples of all models.
    pub fn samples<'s, S: AsRef<[Sample]>>(&self, all: &'s [S]) -> &'s [Sample] {
        all[self.model].as_ref()
    }

    /// Its name as a key.
    pub fn key(&self) -> String {
        match self.own {
            0 => self.name.to_owned(),
            own => KEYS[own - 1].to_owned(),
        }
    }
}

impl<'a> Report<'a> {
    /// Measures all.
    pub fn new(setup: &'a Setup<'a>, replayed: Vec<Replayed>, predicted: Option<Predicted>) -> Self {
        let (args, cast) = (setup.args, &setup.cast);
        let horizons = args.figures.horizons.iter().copied().map(Some).chain([None]);
        let from_entry = horizons.map(|seconds| Horizon {
            seconds,
            samples: replayed.iter().map(|replayed| from_entry(cast, replayed, seconds)).collect(),
        });
        let from_entry = from_entry.collect();
        let lines = args.figures.line.into_iter().collect();
        let question = Question { interval: args.figures.interval, lines, ..Question::default() };
        let velocities = |people: &People| Velocities::of(people, cast.rows, Border::OneSided);
        let recorded = velocities(&cast.people);
        let [start, _] = setup.span();
        let came = |replayed: Replayed| {
            let people = replayed.people();
            let both = [(&cast.people, &recorded), (&people, &velocities(&people))];
            let compared = Compared::of(both, args.figures.line);
            let microscopic = Microscopic::of(&people, start);
            Came { figures: Figures::of(&people, &question), compared, microscopic, replayed }
        };
        let models = replayed.into_iter().map(came).collect();
        let groups = setup.groups.as_deref();
        Self {
            setup,
            through: setup.through(),
            in_groups: groups.map_or_else(Vec::new, |groups| in_groups(cast, groups)),
            models,
            from_entry,
            predicted,
            recorded: Figures::of(&cast.people, &question),
            microscopic: Microscopic::of(&cast.people, start),
            question,
            interrupted: interrupt::asked(),
        }
    }

    /// The models, and the two that know nothing of others, in order.
    pub fn predictors(&self) -> Vec<Predictor<'_>> {
        let models = self.setup.models.iter().enumerate().map(|(model, name)| Predictor { name, model, own: 0 });
        let simple = PREDICTORS.iter().enumerate().skip(1).map(|(own, name)| Predictor { name, model: 0, own });
        models.chain(simple).collect()
    }

    /// The longest of the horizons of predictions that were asked for, with the samples of all models.
    pub fn longest(&self) -> Option<(f64, Vec<&[Sample]>)> {
        let predicted = self.predicted.as_ref()?;
        let asked = self.setup.args.figures.horizons.iter().copied().enumerate();
        let (at, seconds) = asked.max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some((seconds, predicted.samples.iter().map(|samples| &samples[at][..]).collect()))
    }

    /// Those of some samples who are alone, and those who belong to somebody; `None` where nobody knows.
    pub fn split(&self, samples: &[Sample]) -> Option<[Vec<Sample>; 2]> {
        self.setup.groups.as_ref()?;
        let of = |is: bool| samples.iter().filter(|sample| self.in_groups[sample.walk] == is).copied().collect();
        Some([false, true].map(of))
    }

    /// The group of everybody, by number: its place among the groups.
    pub fn group_of(&self, number: u32) -> Option<usize> {
        self.setup.groups.as_ref()?.iter().position(|group| group.contains(&number))
    }

    /// By how much those who arrived by a model did so later than the recorded left; of those who stay, who arrives earlier is not
    /// late. The median, seconds.
    pub fn delay(&self, came: &Came) -> f64 {
        let left = self.setup.cast.people.walks.iter().map(|walk| walk.times[walk.times.len() - 1]);
        median(came.replayed.arrived.iter().zip(left).filter_map(|(at, left)| Some((*at)? - left)).collect())
    }
}

impl Came {
    /// How many have arrived.
    pub fn arrived(&self) -> usize {
        self.replayed.arrived.iter().flatten().count()
    }

    /// How many were on their way at the end.
    pub fn walking(&self) -> usize {
        self.replayed.entered.saturating_sub(self.arrived())
    }
}

/// Mean and median of a figure of samples.
pub fn mean_and_median(samples: &[Sample], figure: impl Fn(&Sample) -> f64) -> [f64; 2] {
    let all: Vec<f64> = samples.iter().map(figure).collect();
    [all.iter().sum::<f64>() / all.len() as f64, median(all)]
}
