//! The definition of an experiment.

use super::{Run, motion};
use std::fmt;
use throng_scene::{Error, Scene};

/// An experiment with pedestrians.
#[derive(Clone, Copy)]
pub struct Experiment {
    /// Name on the command line.
    pub name: &'static str,
    /// Name in tables.
    pub title: &'static str,
    /// The geometry and the measures, in a sentence or two.
    pub about: &'static str,
    /// The source of the pedestrians' figures.
    pub source: &'static str,
    pub(super) cases: fn() -> Vec<Case>,
    /// Figures that compare the cases with each other.
    pub overall: Option<Overall>,
}

impl Experiment {
    /// Returns the result of this engine with its defaults before its interaction rules were rebuilt (commit 3d7b9bf):
    /// mean of seeds 1 to 5, by the same measures. The case is `all` for figures of all cases. Returns NaN if unknown.
    ///
    /// ```
    /// use throng_record::validate::EXPERIMENTS;
    /// assert!(EXPERIMENTS[0].before("2.24 per m", "v") > 1.0);
    /// ```
    pub fn before(&self, case: &str, figure: &str) -> f64 {
        // commas in names of cases are written as semicolons
        let case = case.replace(',', ";");
        let value = |line: &str| {
            let mut cells = line.split(',');
            (cells.next()? == self.name && cells.next()? == case && cells.next()? == figure).then_some(())?;
            cells.next()?.parse().ok()
        };
        include_str!("before.csv").lines().skip(1).find_map(value).unwrap_or(f64::NAN)
    }

    /// Returns the cases, in order.
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
    /// Computes the values from those of each case with one seed, empty for a case that did not run.
    pub(super) measure: fn(&[Vec<f64>]) -> Vec<f64>,
}

impl Overall {
    /// Returns the figures.
    pub fn figures(&self) -> Vec<Figure> {
        (self.figures)()
    }

    /// Computes the values from those of each of the experiment's cases with one seed, empty for a case that did not
    /// run. A value that needs such a case is NaN.
    pub fn measure(&self, cases: &[Vec<f64>]) -> Vec<f64> {
        (self.measure)(cases)
    }
}

impl fmt::Debug for Overall {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Overall").finish_non_exhaustive()
    }
}

/// A scene of an experiment and its measures.
pub struct Case {
    /// Name within the experiment.
    pub name: String,
    /// Whether the case belongs to the quick selection.
    pub quick: bool,
    /// The scene file.
    pub text: String,
    /// Interval of recorded positions, seconds.
    pub interval: f64,
    /// The figures, in the order of the values.
    pub figures: Vec<Figure>,
    pub(super) measure: Measure,
}

/// Measures a run of a case.
pub(super) type Measure = Box<dyn Fn(&Run) -> Vec<f64> + Send + Sync>;

impl Case {
    /// Creates a case that is recorded every 0.08 s. Every case also measures the agents' motion, after its own
    /// figures.
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

    /// Takes the case out of the quick selection.
    pub(super) fn slow(self) -> Self {
        Self { quick: false, ..self }
    }

    /// Returns the scene with a seed.
    ///
    /// # Errors
    /// The text is not a scene: an error in the experiment.
    pub fn scene(&self, seed: u64) -> Result<Scene, Error> {
        let mut scene: Scene = self.text.parse()?;
        scene.seed = seed;
        Ok(scene)
    }

    /// Returns the values of the figures. Unknown values are NaN.
    pub fn measure(&self, run: &Run) -> Vec<f64> {
        (self.measure)(run)
    }
}

impl fmt::Debug for Case {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Case").field("name", &self.name).field("text", &self.text).finish_non_exhaustive()
    }
}

/// A measured figure, the result of pedestrians, and the tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Symbol or name in tables.
    pub name: &'static str,
    /// Unit; empty for a pure number.
    pub unit: &'static str,
    /// What it measures, in a few words.
    pub meaning: &'static str,
    /// Range of acceptable values; `None`: no requirement.
    pub tolerance: Option<[f64; 2]>,
    /// Result of pedestrians, as text, since it may be a range or several experiments; empty if unknown.
    pub people: &'static str,
    /// Results of simulators in the same geometry, by the same measure.
    pub reference: Reference,
}

/// Results of simulators; NaN if not measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// The best of the models of JuPedSim 1.4.2.
    pub jupedsim: f64,
    /// RVO2 (pyrvo 0.4.3).
    pub rvo2: f64,
}

impl Figure {
    /// Creates a figure without a requirement.
    pub(super) fn new(name: &'static str, unit: &'static str, meaning: &'static str) -> Self {
        let reference = Reference { jupedsim: f64::NAN, rvo2: f64::NAN };
        Self { name, unit, meaning, tolerance: None, people: "", reference }
    }

    /// Requires values from `low` to `high`.
    pub(super) fn within(self, low: f64, high: f64) -> Self {
        Self { tolerance: Some([low, high]), ..self }
    }

    /// Sets the result of pedestrians.
    pub(super) fn people(self, people: &'static str) -> Self {
        Self { people, ..self }
    }

    /// Sets the results of JuPedSim's best model and RVO2.
    pub(super) fn reference(self, jupedsim: f64, rvo2: f64) -> Self {
        Self { reference: Reference { jupedsim, rvo2 }, ..self }
    }

    /// Returns the figure of agents that did not arrive, which must be 0.
    pub(super) fn left() -> Self {
        Self::new("left", "", "agents that did not arrive").within(0.0, 0.0)
    }

    /// Whether a value is acceptable; `None` without a requirement. NaN is not acceptable.
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
