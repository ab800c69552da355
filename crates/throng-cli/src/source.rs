//! Options for the scene of a command.

use crate::failure::Failure;
use crate::look::parse_positive;
use crate::progress::waiting;
use clap::Args;
use std::path::{Path, PathBuf};
use throng::World;
use throng_record::{Setting, moment};
use throng_scene::import::plan;
use throng_scene::{Built, Kind, Scene, gallery};

/// Options for a scene and its changes.
#[derive(Args, Debug)]
pub struct SceneArgs {
    /// The scene: a name of the gallery (see `throng list`) or a file
    ///
    /// Files: a scene file (.toml); a JuPedSim scenario (a folder with config.json, a .zip of the folder, or a .json);
    /// a project of Menge (its .xml, or the folder); or a floor plan (.wkt, .geojson, .dxf, .svg, .obj), with --exit
    /// and --people if the plan does not define them.
    #[arg(value_name = "SCENE")]
    pub scene: PathBuf,

    /// Changes to the scene.
    #[command(flatten)]
    pub changes: Changes,
}

/// Options for reading floor plans.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanArgs {
    /// For floor plans: metres per unit of length, such as 0.001 [default: from the plan, else 1; 0.01 for SVG]
    #[arg(long, value_name = "METRES", value_parser = parse_positive)]
    pub plan_unit: Option<f64>,

    /// For meshes with several levels: the level, from 1 for the lowest; `throng check` lists them [default: the
    /// largest]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub level: Option<u64>,
}

impl PlanArgs {
    /// Returns the options as a request to the importer of floor plans.
    pub fn ask(&self) -> plan::PlanOptions {
        plan::PlanOptions { unit: self.plan_unit, level: self.level, ..plan::PlanOptions::default() }
    }

    /// Reads the ground of a floor plan.
    ///
    /// # Errors
    /// The file cannot be read or is not a floor plan.
    pub fn ground(&self, path: &Path) -> Result<plan::PlanGround, Failure> {
        Ok(plan::ground(path, &self.ask())?)
    }
}

/// Options that change a scene.
#[derive(Args, Debug, Default)]
pub struct Changes {
    /// The seed of the random number generator, instead of the scene's
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..=i64::MAX as u64))]
    pub seed: Option<u64>,

    /// Applies a preset of the scene, before --set; `throng list SCENE` lists them
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,

    /// Changes one value of the scene; can be given several times
    ///
    /// KEY is the path of the value in the scene file. A key of a group changes all groups; `group.NAME.` before it
    /// changes one group. Examples: --set avoid.orca.time_horizon=3  --set group.left.speed.preferred=1 --set
    /// time.step=0.1  --set expect.within=20
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_change)]
    pub set: Vec<(String, String)>,

    /// For floor plans: the exit's lower left corner, width and height in metres [default: the plan's own]
    #[arg(long, value_name = "X,Y,W,H", value_parser = parse_four, allow_hyphen_values = true)]
    pub exit: Option<[f64; 4]>,

    /// For floor plans: the number of people [default: from the plan, else 1 per 4 m²]
    #[arg(long, value_name = "N")]
    pub people: Option<u64>,

    /// How floor plans are read.
    #[command(flatten)]
    pub plan: PlanArgs,
}

/// A scene, its name, and the notes of its importer.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The stem for the names of output files.
    pub name: String,
    /// The scene, with `--preset`, `--set` and `--seed` applied.
    pub scene: Scene,
    /// What the importer left out or changed, one sentence each.
    pub notes: Vec<String>,
    /// The path that the scene was read from.
    path: PathBuf,
    /// Whether the path is a floor plan, with the rest of the scene from the command line.
    plan: bool,
}

impl Loaded {
    /// Returns the scene's title; its name if it has no title.
    pub fn title(&self) -> &str {
        if self.scene.title.is_empty() { &self.name } else { &self.scene.title }
    }

    /// Builds the world. Errors name the file, and the option that caused them. If building takes long, a line on
    /// standard error says so, unless `quiet`.
    ///
    /// # Errors
    /// Those of [`Scene::build`].
    pub fn build(&self, quiet: bool) -> Result<(World, Built), Failure> {
        let doing = format!("building {}", self.name);
        waiting(quiet, &doing, || self.scene.build()).map_err(|mut error| {
            if self.plan && matches!(error.kind, Kind::NoRoom | Kind::Count) {
                error.hint = Some("change --people".into());
            }
            error.file.get_or_insert_with(|| self.path.display().to_string().into());
            error.into()
        })
    }

    /// Returns the place, the names, and the bodies that groups have from files.
    ///
    /// # Errors
    /// Those of [`moment::setting_with_files`].
    pub fn setting(&self, world: &World, built: &Built) -> Result<Setting, Failure> {
        moment::setting_with_files(world, built, &self.scene, self.title()).map_err(|mut error| {
            error.file.get_or_insert_with(|| self.path.display().to_string().into());
            error.into()
        })
    }
}

impl SceneArgs {
    /// Reads the scene and applies the changes.
    ///
    /// # Errors
    /// Those of [`Changes::load`].
    pub fn load(&self) -> Result<Loaded, Failure> {
        self.changes.load(&self.scene)
    }
}

impl Changes {
    /// Reads a scene and applies `--preset`, `--set` and `--seed`.
    ///
    /// # Errors
    /// The scene does not exist, the file is not a scene, or a change cannot be applied.
    pub fn load(&self, path: &Path) -> Result<Loaded, Failure> {
        let (mut scene, notes) = self.read(path)?;
        if let Some(name) = &self.preset {
            scene = scene.with_preset(name)?;
        }
        for (key, value) in &self.set {
            scene.set(key, value)?;
        }
        if let Some(seed) = self.seed {
            scene.seed = seed;
        }
        Ok(Loaded { name: name(path), scene, notes, path: path.to_path_buf(), plan: plan::is_plan(path) })
    }

    fn read(&self, path: &Path) -> Result<(Scene, Vec<String>), Failure> {
        let ask = plan::PlanOptions { exit: self.exit, people: self.people, ..self.plan.ask() };
        if plan::is_plan(path) {
            if let Some([_, _, width, height]) = self.exit.filter(|exit| exit[2] <= 0.0 || exit[3] <= 0.0) {
                let text = format!("--exit: the exit is {width} m wide and {height} m high");
                return Err(Failure::hint(text, "give x,y,width,height, the last two greater than 0"));
            }
            let imported = plan::load(path, &ask).map_err(|mut error| {
                if error.kind == Kind::GoalInWall && self.exit.is_some() {
                    error.hint = Some("change --exit: x,y,width,height, x and y of the lower left corner".into());
                }
                error
            })?;
            return Ok((imported.scene, imported.notes));
        }
        if ask != plan::PlanOptions::default() {
            let text =
                format!("--exit, --people, --plan-unit and --level are for floor plans, not for {}", path.display());
            return Err(Failure::hint(text, "change the goal and the count with --set, or in the scene file"));
        }
        let imported = throng_scene::open(path)?;
        Ok((imported.scene, imported.notes))
    }
}

/// Returns the stem for the names of output files of a scene.
fn name(path: &Path) -> String {
    let whole = path.to_str().filter(|name| gallery::text(name).is_some() && !path.exists());
    match whole {
        Some(name) => name.to_owned(),
        // `folder/.` and `..` have no file stem.
        None => path
            .canonicalize()
            .ok()
            .as_deref()
            .unwrap_or(path)
            .file_stem()
            .map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into_owned()),
    }
}

/// Parses a key and its value.
pub fn parse_change(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.trim().to_owned())),
        _ => Err("write KEY=VALUE, such as avoid.orca.time_horizon=3".into()),
    }
}

/// Parses four finite numbers separated by commas.
pub fn parse_four(text: &str) -> Result<[f64; 4], String> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|part| part.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
    numbers
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| "write four numbers with commas between them, such as 0,0,20,10".into())
}
