//! The results of a replay.

use super::kinds::in_groups;
use super::setup::Setup;
use crate::interrupt;
use throng_record::pedestrian::replay::{Compared, PREDICTORS, PredictionSample, RecordedPeople, Replayed, from_entry};
use throng_record::pedestrian::{Border, Figures, Microscopic, People, Question, Velocities, median};

/// The keys of the predictors without interaction.
const KEYS: [&str; 2] = ["constant_velocity", "straight"];

/// Predictions that restart from the recording at regular intervals.
pub struct Predicted {
    /// The interval between starts, seconds.
    pub every: f64,
    /// The number of starts.
    pub moments: usize,
    /// The horizons, seconds: those of the arguments, followed by those of a page.
    pub horizons: Vec<f64>,
    /// The samples, by model and horizon.
    pub samples: Vec<Vec<Vec<PredictionSample>>>,
}

/// The displacements at a horizon.
pub struct Horizon {
    /// The horizon, seconds; `None` for the time of the last recorded sample.
    pub seconds: Option<f64>,
    /// The samples of all people recorded for that long, by model.
    pub samples: Vec<Vec<PredictionSample>>,
}

/// The results of a model.
pub struct ModelResults {
    /// The replayed people.
    pub replayed: Replayed,
    /// Their figures.
    pub figures: Figures,
    /// The distributions of recorded and replayed people.
    pub compared: Compared,
    /// Their microscopic figures.
    pub microscopic: Microscopic,
}

/// The results of a replay.
pub struct ReplayReport<'a> {
    /// What was replayed.
    pub setup: &'a Setup<'a>,
    /// The number of recorded people that walk through solids.
    pub through: usize,
    /// Whether each walk belongs to a member of a group.
    in_groups: Vec<bool>,
    /// The results of each model.
    pub models: Vec<ModelResults>,
    /// The displacements since entry.
    pub from_entry: Vec<Horizon>,
    /// The predictions, if they were requested.
    pub predicted: Option<Predicted>,
    /// What is measured of all people.
    pub question: Question,
    /// The figures of the recording.
    pub recorded: Figures,
    /// The microscopic figures of the recording.
    pub microscopic: Microscopic,
    /// Whether the replay was interrupted.
    pub interrupted: bool,
}

/// The pauses of the agents.
pub struct Pauses {
    /// The number of people with pauses.
    pub people: usize,
    /// The number of pauses.
    pub count: usize,
    /// The total length of the pauses, seconds.
    pub seconds: f64,
}

impl Pauses {
    /// Returns the pauses of all recorded people.
    pub fn of(cast: &RecordedPeople) -> Self {
        let all = || cast.walkers.iter().flat_map(|walker| &walker.pauses);
        Self {
            people: cast.walkers.iter().filter(|walker| !walker.pauses.is_empty()).count(),
            count: all().count(),
            seconds: all().fold(0.0, |sum, pause| sum + (pause.until - pause.from)),
        }
    }
}

/// A predictor of positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Predictor<'a> {
    /// The name.
    pub name: &'a str,
    /// The index of the model that provides the samples, and the index of the predictor's figures in a sample.
    model: usize,
    own: usize,
}

impl Predictor<'_> {
    /// Returns its average displacement over the time, metres.
    pub fn average(&self, sample: &PredictionSample) -> f64 {
        sample.average[self.own]
    }

    /// Returns its displacement at the end, metres.
    pub fn last(&self, sample: &PredictionSample) -> f64 {
        sample.last[self.own]
    }

    /// Returns its samples, of the samples of all models.
    pub fn samples<'s, S: AsRef<[PredictionSample]>>(&self, all: &'s [S]) -> &'s [PredictionSample] {
        all[self.model].as_ref()
    }

    /// Returns its name as a key.
    pub fn key(&self) -> String {
        match self.own {
            0 => self.name.to_owned(),
            own => KEYS[own - 1].to_owned(),
        }
    }
}

impl<'a> ReplayReport<'a> {
    /// Measures the recording and all replays.
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
            ModelResults { figures: Figures::of(&people, &question), compared, microscopic, replayed }
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

    /// Returns the predictors in order: the models and the two without interaction.
    pub fn predictors(&self) -> Vec<Predictor<'_>> {
        let models = self.setup.models.iter().enumerate().map(|(model, name)| Predictor { name, model, own: 0 });
        let simple = PREDICTORS.iter().enumerate().skip(1).map(|(own, name)| Predictor { name, model: 0, own });
        models.chain(simple).collect()
    }

    /// Returns the longest requested horizon of predictions, with the samples of all models.
    pub fn longest(&self) -> Option<(f64, Vec<&[PredictionSample]>)> {
        let predicted = self.predicted.as_ref()?;
        let requested = self.setup.args.figures.horizons.iter().copied().enumerate();
        let (at, seconds) = requested.max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some((seconds, predicted.samples.iter().map(|samples| &samples[at][..]).collect()))
    }

    /// Splits samples into people alone and people in groups; `None` without known groups.
    pub fn split(&self, samples: &[PredictionSample]) -> Option<[Vec<PredictionSample>; 2]> {
        self.setup.groups.as_ref()?;
        let of = |is: bool| samples.iter().filter(|sample| self.in_groups[sample.walk] == is).copied().collect();
        Some([false, true].map(of))
    }

    /// Returns the group of a person, by number: its index in the list of groups.
    pub fn group_of(&self, number: u32) -> Option<usize> {
        self.setup.groups.as_ref()?.iter().position(|group| group.contains(&number))
    }

    /// Returns the median time from the recorded leaving to the arrival by the model, seconds. An agent that waits at
    /// its goal for the recorded person to leave counts with its arrival, so that an early arrival is not late.
    pub fn delay(&self, came: &ModelResults) -> f64 {
        let left = self.setup.cast.people.walks.iter().map(|walk| walk.times[walk.times.len() - 1]);
        median(came.replayed.arrived.iter().zip(left).filter_map(|(at, left)| Some((*at)? - left)).collect())
    }
}

impl ModelResults {
    /// Returns the number of agents that have arrived.
    pub fn arrived(&self) -> usize {
        self.replayed.arrived.iter().flatten().count()
    }

    /// Returns the number of agents that were still walking at the end.
    pub fn walking(&self) -> usize {
        self.replayed.entered.saturating_sub(self.arrived())
    }
}

/// Returns mean and median of a figure of samples.
pub fn mean_and_median(samples: &[PredictionSample], figure: impl Fn(&PredictionSample) -> f64) -> [f64; 2] {
    let all: Vec<f64> = samples.iter().map(figure).collect();
    [all.iter().sum::<f64>() / all.len() as f64, median(all)]
}
