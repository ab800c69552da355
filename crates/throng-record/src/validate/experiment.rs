//! What an experiment is.

use super::{Run, motion};
use std::fmt;
use throng_scene::{Error, Scene};

/// An experiment with people.
#[derive(Clone, Copy)]
pub struct Experiment {
    /// Its name on the command line.
    pub name: &'static str,
    /// Its name in tables.
    pub title: &'static str,
    /// The geometry and what is measured, in a sentence or two.
    pub about: &'static str,
    /// Where the figures of people are from.
    pub source: &'static str,
    pub(super) cases: fn() -> Vec<Case>,
    /// Figures that compare the cases with each other.
    pub overall: Option<Overall>,
}

impl Experiment {
    /// What this engine did with its defaults before its interaction rules were rebuilt (commit 3d7b9bf): mean of seeds 1 to 5, by these measures. The case is `all` for
    /// figures of all cases. Not a number where it is not known.
    ///
    /// ```
    /// use throng_record::validate::EXPERIMENTS;
    /// assert!(EXPERIMENTS[0].before("2.24 per m", "v") > 1.0);
    /// ```
    pub fn before(&self, case: &str, figure: &str) -> f64 {
        // names of cases may have commas: they are written as semicolons
        let case = case.replace(',', ";");
        let value = |line: &str| {
            let mut cells = line.split(',');
            (cells.next()? == self.name && cells.next()? == case && cells.next()? == figure).then_some(())?;
            cells.next()?.parse().ok()
        };
        include_str!("before.csv").lines().skip(1).find_map(value).unwrap_or(f64::NAN)
    }

    /// Its cases, in order.
    pub fn cases(&self) -> Vec<Case> {
        (self.cases)()
    }
}

impl fmt::Debug for Experiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Experiment").field("name", &self.name).finish_non_exhaustive()
    }
}

/// Figures of all cases of an experiment together.
#[derive(Clone, Copy)]
pub struct Overall {
    pub(super) figures: fn() -> Vec<Figure>,
    /// From the values of each case, empty for a case that did not run, of one seed.
    pub(super) measure: fn(&[Vec<f64>]) -> Vec<f64>,
}

impl Overall {
    /// The figures.
    pub fn figures(&self) -> Vec<Figure> {
        (self.figures)()
    }

    /// Their values, from the values of each of the experiment's cases with one seed; empty for a case that did not run. Not a number where they need such a case.
    pub fn measure(&self, cases: &[Vec<f64>]) -> Vec<f64> {
        (self.measure)(cases)
    }
}

impl fmt::Debug for Overall {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Overall").finish_non_exhaustive()
    }
}

/// A scene of an experiment, and what is measured on it.
pub struct Case {
    /// Its name within the experiment.
    pub name: String,
    /// Whether it belongs to the quick selection.
    pub quick: bool,
    /// The scene file.
    pub text: String,
    /// Seconds from one recorded position to the next.
    pub interval: f64,
    /// What is measured, in the order of the values.
    pub figures: Vec<Figure>,
    pub(super) measure: Measure,
}

/// Measures a run of a case.
pub(super) type Measure = Box<dyn Fn(&Run) -> Vec<f64> + Send + Sync>;

impl Case {
    /// A case that is recorded every 0.08 s. How the agents move is measured in every case, after its own figures.
    pub(super) fn new(
        name: impl Into<String>,
        text: String,
        mut figures: Vec<Figure>,
        measure: impl Fn(&Run) -> Vec<f64> + Send + Sync + 'static,
    ) -> Self {
        figures.extend(motion::figures());
        let measure = move |run: &Run| {
            let mut values = measure(run);
            values.extend(motion::measure(run));
            values
        };
        Self { name: name.into(), quick: true, text, interval: 0.08, figures, measure: Box::new(measure) }
    }

    /// The same case, outside of the quick selection.
    pub(super) fn slow(self) -> Self {
        Self { quick: false, ..self }
    }

    /// Its scene with a seed.
    ///
    /// # Errors
    /// The text is no scene: a mistake in the experiment.
    pub fn scene(&self, seed: u64) -> Result<Scene, Error> {
        let mut scene: Scene = self.text.parse()?;
        scene.seed = seed;
        Ok(scene)
    }

    /// The values of its figures. What is not known is not a number.
    pub fn measure(&self, run: &Run) -> Vec<f64> {
        (self.measure)(run)
    }
}

impl fmt::Debug for Case {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Case").field("name", &self.name).field("text", &self.text).finish_non_exhaustive()
    }
}

/// What is measured, what people did, and what is tolerated.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its symbol or name in tables.
    pub name: &'static str,
    /// Its unit; empty for a pure number.
    pub unit: &'static str,
    /// What it is, in a few words.
    pub meaning: &'static str,
    /// From where to where a model may be; `None`: only shown.
    pub tolerance: Option<[f64; 2]>,
    /// What people did, as text, since it may be a range or several experiments. Empty: not known.
    pub people: &'static str,
    /// What simulators did in the same geometry, measured the same way.
    pub reference: Reference,
}

/// What simulators did. Not a number where it was not measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// The best of the models of JuPedSim 1.4.2.
    pub jupedsim: f64,
    /// RVO2 (pyrvo 0.4.3).
    pub rvo2: f64,
}

impl Figure {
    /// A figure that is only shown.
    pub(super) fn new(name: &'static str, unit: &'static str, meaning: &'static str) -> Self {
        let reference = Reference { jupedsim: f64::NAN, rvo2: f64::NAN };
        Self { name, unit, meaning, tolerance: None, people: "", reference }
    }

    /// Has to be from `low` to `high`.
    pub(super) fn within(self, low: f64, high: f64) -> Self {
        Self { tolerance: Some([low, high]), ..self }
    }

    /// What people did.
    pub(super) fn people(self, people: &'static str) -> Self {
        Self { people, ..self }
    }

    /// What JuPedSim's best and RVO2 did.
    pub(super) fn reference(self, jupedsim: f64, rvo2: f64) -> Self {
        Self { reference: Reference { jupedsim, rvo2 }, ..self }
    }

    /// Agents that did not arrive: there have to be none.
    pub(super) fn left() -> Self {
        Self::new("left", "", "agents that did not arrive").within(0.0, 0.0)
    }

    /// Whether a value is tolerated; `None`: nothing is required. A value that is not known is not tolerated.
    ///
    /// ```
    /// use throng_record::validate::EXPERIMENTS;
    /// let case = &EXPERIMENTS[0].cases()[2];
    /// assert_eq!([0.58, 1.18, f64::NAN].map(|speed| case.figures[0].is_met(speed)), [true, false, false].map(Some));
    /// ```
    pub fn is_met(&self, value: f64) -> Option<bool> {
        self.tolerance.map(|[low, high]| (low..=high).contains(&value))
    }
}
