//! Plans of runs.

use super::axis::Axis;
use super::file::PlanFile;
use super::one::result_names;
use super::recorded::Recorded;
use super::run::SweepRun;
use super::value::{Key, PlanValue};
use std::path::{Path, PathBuf};
use throng_scene::{Error, Kind, Plugins, Scene, TomlFile, TomlStep};

/// The largest number of runs of a plan.
pub const MOST_RUNS: usize = 1_000_000;

/// A plan of runs: all combinations of its scenes, its parameters and its seeds. The [module](super) has an example,
/// and `docs/sweeps.md` describes the file.
#[derive(Clone, Debug)]
pub struct Plan {
    /// A title of one line; empty if the plan has none.
    pub title: String,
    /// The scenes, in the order of the plan.
    pub scenes: Vec<PlannedScene>,
    /// The seeds; empty for the own seed of each scene.
    pub seeds: Vec<u64>,
    /// The latest end of all runs, seconds; `None` for the scenes' own.
    pub limit: Option<f64>,
    pub(super) set: Vec<(Key, PlanValue)>,
    pub(super) axes: Vec<Axis>,
    pub(super) recorded: Recorded,
    length: usize,
}

/// A scene of a plan.
#[derive(Clone, Debug)]
pub struct PlannedScene {
    /// The name, as in the plan.
    pub name: String,
    /// The scene, before parameters are set.
    pub scene: Scene,
    /// What the importer of the scene left out or changed, one sentence each.
    pub notes: Vec<String>,
}

impl Plan {
    /// Reads the file of a plan. Names of files in it are relative to its folder.
    ///
    /// # Errors
    /// Those of [`parse`](Self::parse), or the file cannot be read.
    pub fn open(path: impl AsRef<Path>, plugins: &Plugins) -> Result<Self, Error> {
        let path = path.as_ref();
        Self::read(&TomlFile::open(path)?, path.parent().unwrap_or(Path::new("")), plugins)
    }

    /// Reads the text of a plan; errors use `name` as the file name, and names of files are relative to `folder`.
    ///
    /// # Errors
    /// The text is not a plan, a scene cannot be read, a scene does not have a key that is set, the plan has no values
    /// or no scenes, or more than [`MOST_RUNS`] runs. Whether a value is within its limits shows when a run is made.
    pub fn parse(name: &str, text: &str, folder: impl AsRef<Path>, plugins: &Plugins) -> Result<Self, Error> {
        Self::read(&TomlFile::new(name, text), folder.as_ref(), plugins)
    }

    fn read(at: &TomlFile, folder: &Path, plugins: &Plugins) -> Result<Self, Error> {
        let file: PlanFile = at.read()?;
        if file.scenes.0.is_empty() {
            let hint = "name scenes of the gallery, or files: scenes = [\"corridor\", \"hall.toml\"]";
            return Err(at.error(Kind::Count, ["scenes"], "the plan has no scenes", hint));
        }
        if let Some(limit) = file.limit.filter(|&limit| limit <= 0.0 || !limit.is_finite()) {
            return Err(at.error(
                Kind::OutOfRange,
                ["limit"],
                format!("limit is {limit}"),
                "write more than 0, seconds",
            ));
        }
        let set = Key::start(vec!["set".into()]).flatten(&file.set, |_| false);
        let set: Vec<_> = set.into_iter().map(|(key, value)| (key, PlanValue::constant(value))).collect();
        let axes = file.vary.iter().enumerate().map(|(k, table)| Axis::of(at, k, table, MOST_RUNS));
        let mut axes: Vec<Axis> = axes.collect::<Result<_, _>>()?;
        name_columns(at, &file, &mut axes)?;
        check_keys(at, file.limit, &set, &axes)?;
        let seeds = file.seeds.map_or_else(Vec::new, |seeds| seeds.0);
        let mut sizes = axes.iter().map(|axis| axis.length).chain([seeds.len().max(1)]);
        let length = sizes.try_fold(file.scenes.0.len(), usize::checked_mul);
        let Some(length) = length.filter(|&length| length <= MOST_RUNS) else {
            let message = format!("the plan has more than {MOST_RUNS} runs");
            let place: Vec<TomlStep> = if axes.is_empty() { vec!["seeds".into()] } else { vec!["vary".into()] };
            return Err(at.error(Kind::Count, place, message, "give it fewer values, or write several plans"));
        };
        let recorded = Recorded::new(file.record, at)?;
        check_columns(at, &axes, &recorded)?;
        let scenes = file.scenes.0.iter().enumerate();
        let scenes = scenes.map(|(k, name)| {
            PlannedScene::open(name, folder, plugins).map_err(|error| {
                let hint = error.hint.clone().unwrap_or_else(|| "names of files are relative to the plan".into());
                match error.file {
                    // the mistake is in the scene's own file
                    Some(_) => error,
                    None => at.error(error.kind, ["scenes".into(), TomlStep::from(k)], error.message, hint),
                }
            })
        });
        let scenes = scenes.collect::<Result<_, _>>()?;
        let plan = Self { title: file.title, scenes, seeds, limit: file.limit, set, axes, recorded, length };
        plan.check_values(at)?;
        Ok(plan)
    }

    /// Returns the number of runs; at least 1.
    #[expect(clippy::len_without_is_empty, reason = "a plan has at least one run")]
    pub fn len(&self) -> usize {
        self.length
    }

    /// Returns the run with a number, from 0; `None` if the plan has fewer runs. The seed changes fastest, then the last
    /// table `[[vary]]`, and the scene slowest.
    pub fn run(&self, index: usize) -> Option<SweepRun<'_>> {
        if index >= self.length {
            return None;
        }
        let mut rest = index;
        let mut part = |size: usize| {
            let part = rest % size;
            rest /= size;
            part
        };
        let seed = part(self.seeds.len().max(1));
        let mut choice: Vec<usize> = self.axes.iter().rev().map(|axis| part(axis.length)).collect();
        choice.reverse();
        Some(SweepRun { plan: self, index, scene: &self.scenes[rest], choice, seed: self.seeds.get(seed).copied() })
    }

    /// Returns all runs, in the order of their numbers.
    pub fn runs(&self) -> impl ExactSizeIterator<Item = SweepRun<'_>> + DoubleEndedIterator {
        (0..self.length).map(|index| self.run(index).expect("the plan has as many runs"))
    }

    /// Checks each value of each parameter in each scene, with the first values of all other parameters.
    fn check_values(&self, at: &TomlFile) -> Result<(), Error> {
        for scene in &self.scenes {
            let mut choice = vec![0; self.axes.len()];
            self.check_choice(at, scene, &choice)?;
            for (k, axis) in self.axes.iter().enumerate() {
                for value in axis.tested().skip(1) {
                    choice[k] = value;
                    self.check_choice(at, scene, &choice)?;
                }
                choice[k] = 0;
            }
        }
        Ok(())
    }

    fn check_choice(&self, at: &TomlFile, scene: &PlannedScene, choice: &[usize]) -> Result<(), Error> {
        let mut changed = scene.scene.clone();
        for (mut steps, name, value) in self.changes(choice) {
            changed.set(name, &value.toml()).map_err(|error| {
                // the key is wrong, not one of its values
                if error.kind == Kind::UnknownKey && matches!(steps.last(), Some(TomlStep::Index(_))) {
                    steps.pop();
                }
                let message = format!("{name} = {} in the scene `{}`: {}", value.toml(), scene.name, error.message);
                at.error(error.kind, steps, message, error.hint.unwrap_or_else(|| "see `throng run --help`".into()))
            })?;
        }
        Ok(())
    }

    /// Returns what is set in a run: the place in the plan, the key and the value.
    pub(super) fn changes(&self, choice: &[usize]) -> impl Iterator<Item = (Vec<TomlStep>, &str, &PlanValue)> {
        let constant = self.set.iter().map(|(key, value)| (key.steps.clone(), key.name.as_str(), value));
        let varied = self.axes.iter().zip(choice.to_vec()).flat_map(|(axis, value)| {
            axis.parameters.iter().map(move |parameter| {
                let steps = parameter.key.steps.iter().cloned().chain([TomlStep::Index(value)]).collect();
                (steps, parameter.key.name.as_str(), &parameter.values[value])
            })
        });
        constant.chain(varied)
    }
}

impl PlannedScene {
    /// Opens a file of the folder, or else a scene by its name.
    fn open(name: &str, folder: &Path, plugins: &Plugins) -> Result<Self, Error> {
        let file: PathBuf = folder.join(name);
        let (scene, notes) = if !file.exists() && plugins.text(name).is_some() {
            (plugins.open(name)?, Vec::new())
        } else {
            let mut imported = throng_scene::open(&file)?;
            plugins.equip(&mut imported.scene);
            (imported.scene, imported.notes)
        };
        Ok(Self { name: name.to_owned(), scene, notes })
    }
}

/// Gives the columns of parameters the names of `[columns]`.
fn name_columns(at: &TomlFile, file: &PlanFile, axes: &mut [Axis]) -> Result<(), Error> {
    for (key, name) in Key::start(vec!["columns".into()]).flatten(&file.columns, |_| false) {
        let Some(name) = name.as_str().filter(|name| !name.trim().is_empty()) else {
            let message = format!("the column of `{}` needs a name", key.name);
            return Err(at.error(Kind::WrongType, key.steps, message, "write a text, such as \"width\""));
        };
        let mut all = axes.iter_mut().flat_map(|axis| &mut axis.parameters);
        match all.find(|parameter| parameter.key.name == key.name) {
            Some(parameter) => parameter.column = name.trim().to_owned(),
            None => {
                let known: Vec<&str> = axes
                    .iter()
                    .flat_map(|axis| &axis.parameters)
                    .map(|parameter| parameter.key.name.as_str())
                    .collect();
                let hint = format!("the keys that vary are: {}", known.join(", "));
                return Err(at.error(Kind::UnknownKey, key.steps, format!("`{}` does not vary", key.name), hint));
            }
        }
    }
    Ok(())
}

/// Checks that no key is set twice, and that seeds and limits are given in one place.
fn check_keys(at: &TomlFile, limit: Option<f64>, set: &[(Key, PlanValue)], axes: &[Axis]) -> Result<(), Error> {
    let varied = axes.iter().flat_map(|axis| &axis.parameters).map(|parameter| &parameter.key);
    let keys: Vec<&Key> = set.iter().map(|(key, _)| key).chain(varied).collect();
    for (k, key) in keys.iter().enumerate() {
        let (message, hint) = match key.name.as_str() {
            "seed" => {
                ("`seed` is not a parameter of a plan".to_owned(), "write seeds = [1, 2, 3], or seeds = \"1..10\"")
            }
            "time.limit" if limit.is_some() => {
                ("`time.limit` and `limit` are both given".to_owned(), "leave one of the two out")
            }
            name if keys[..k].iter().any(|other| other.name == name) => {
                (format!("`{name}` is given twice"), "leave one of the two out")
            }
            _ => continue,
        };
        return Err(at.error(Kind::Conflict, key.steps.clone(), message, hint));
    }
    Ok(())
}

/// Checks that no two columns of the table have the same name.
fn check_columns(at: &TomlFile, axes: &[Axis], recorded: &Recorded) -> Result<(), Error> {
    let mut known: Vec<String> = ["index", "scene", "seed"].map(str::to_owned).into();
    known.extend(result_names(recorded));
    let file = &recorded.file;
    let named = file.lines.iter().map(|line| &line.name).chain(file.areas.iter().map(|area| &area.name));
    if let Some(twice) = known.iter().enumerate().find(|(k, name)| known[..*k].contains(name)).map(|(_, name)| name) {
        let same = named.clone().find(|name| twice.starts_with(&format!("{name}.")));
        let message = format!("two lines or areas have the name `{}`", same.map_or("people", String::as_str));
        return Err(at.error(Kind::Conflict, ["record"], message, "give each its own name"));
    }
    for parameter in axes.iter().flat_map(|axis| &axis.parameters) {
        let counted = parameter.column.starts_with("figures.");
        if counted || known.contains(&parameter.column) {
            let message = format!("two columns of the table have the name `{}`", parameter.column);
            let hint = format!("name this one otherwise: [columns] \"{}\" = \"my-name\"", parameter.key.name);
            return Err(at.error(Kind::Conflict, parameter.key.steps.clone(), message, hint));
        }
        known.push(parameter.column.clone());
    }
    Ok(())
}
