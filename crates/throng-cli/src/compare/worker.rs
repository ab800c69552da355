//! Models in Python, each in a process of its own. `python/throng_sim/_worker.py` is that process, and describes what the two
//! tell each other.

use crate::failure::Failure;
use bytemuck::{cast_slice, cast_slice_mut};
use glam::Vec2;
use serde::Deserialize;
use std::io::{self, BufRead, BufReader, BufWriter, Read, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use throng::Group;
use throng::avoid::{AvoidanceInput, Crowd, CrowdArrays, CrowdModel, LocalModel, Workspace};

/// The number of the protocol.
const PROTOCOL: u32 = 1;

/// A file of Python with a model.
pub struct Script {
    label: String,
    path: PathBuf,
    /// The name of the model, if the file has several.
    name: Option<String>,
}

impl Script {
    /// Returns the script that a text names: `mine.py`, or `mine.py:NAME`.
    pub fn named(text: &str) -> Option<Self> {
        let label = text.trim();
        let (path, name) = match label.split_once(".py:") {
            Some((stem, name)) => (format!("{stem}.py"), Some(name.to_owned())),
            None => (label.to_owned(), None),
        };
        path.ends_with(".py").then(|| Self { label: label.to_owned(), path: path.into(), name })
    }

    /// Returns the text that names the script.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// Starts a process with the model.
    ///
    /// # Errors
    /// There is no Python, Python has no package `throng_sim` or one of another version, or the script fails.
    pub fn start(&self) -> Result<WorkerModel, Failure> {
        if !self.path.is_file() {
            let hint = "models in Python are files such as mine.py; models of the engine have names such as orca";
            return Err(Failure::hint(format!("there is no file {}", self.path.display()), hint));
        }
        let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".into());
        let mut command = Command::new(&python);
        command.args(["-m", "throng_sim._worker"]).arg(&self.path).args(&self.name);
        let spawned = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = spawned.map_err(|error| {
            let hint = "install Python, or name the program in the environment variable PYTHON";
            Failure::hint(format!("cannot run {python}: {error}"), hint)
        })?;
        let (Some(to), Some(from)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(Failure::Error(format!("{python} has no standard input and output")));
        };
        let mut worker = Worker { child, to: BufWriter::new(to), from: BufReader::new(from) };
        let mut line = String::new();
        let read = worker.from.read_line(&mut line);
        let first = read.ok().and_then(|_| serde_json::from_str(&line).ok());
        let options = match first {
            Some(First::Options(options)) if options.protocol == PROTOCOL => options,
            Some(First::Error { error }) => return Err(Failure::Error(error)),
            Some(First::Options(_)) => return Err(without(&python, "is not of the version of this program")),
            None => return Err(without(&python, "does not start")),
        };
        Ok(WorkerModel { label: self.label.clone(), options, worker: Mutex::new(worker), failed: Mutex::default() })
    }
}

fn without(python: &str, what: &str) -> Failure {
    let hint = format!("{python} -m pip install ./python, in the folder of throng; PYTHON names another program");
    Failure::hint(format!("the package throng_sim of {python} {what}"), hint)
}

/// The first line of a worker.
#[derive(Deserialize)]
#[serde(untagged)]
enum First {
    Error { error: String },
    Options(Options),
}

/// What a model asks of the engine.
#[derive(Debug, Deserialize)]
struct Options {
    protocol: u32,
    /// Metres in which an agent sees walls, from its body.
    sees: f32,
    /// Metres in which it sees neighbours, if not those of the scene.
    reach: Option<f32>,
    /// How many neighbours it sees, if not those of the scene.
    neighbors: Option<usize>,
}

/// The process.
#[derive(Debug)]
struct Worker {
    child: Child,
    to: BufWriter<ChildStdin>,
    from: BufReader<ChildStdout>,
}

impl Worker {
    /// Asks for the velocities of a crowd: an error is a broken pipe, a text is what the model's exception says.
    fn ask(&mut self, crowd: &Crowd<'_>) -> io::Result<Result<Vec<Vec2>, String>> {
        write(&mut self.to, &CrowdArrays::of(crowd))?;
        self.to.flush()?;
        let mut failed = [0];
        self.from.read_exact(&mut failed)?;
        if failed == [0] {
            let mut velocities = vec![Vec2::ZERO; crowd.len()];
            self.from.read_exact(cast_slice_mut(&mut velocities))?;
            return Ok(Ok(velocities));
        }
        let mut length = [0; 4];
        self.from.read_exact(&mut length)?;
        let mut text = vec![0; u32::from_ne_bytes(length) as usize];
        self.from.read_exact(&mut text)?;
        Ok(Err(String::from_utf8_lossy(&text).into_owned()))
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        // the process may have ended by itself
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Writes the head and the arrays, in the order of `_worker.py`.
fn write(to: &mut impl Write, crowd: &CrowdArrays) -> io::Result<()> {
    let counts = [crowd.numbers.len(), crowd.near_numbers.len(), crowd.walls.len()].map(|count| count as u64);
    let head: [&[u8]; 3] = [cast_slice(&counts), &crowd.time.to_ne_bytes(), &crowd.seconds.to_ne_bytes()];
    let agents: [&[u8]; 7] = [
        cast_slice(&crowd.numbers),
        cast_slice(&crowd.positions),
        cast_slice(&crowd.velocities),
        cast_slice(&crowd.preferred),
        cast_slice(&crowd.radii),
        cast_slice(&crowd.max_speeds),
        cast_slice(&crowd.headings),
    ];
    let near: [&[u8]; 6] = [
        cast_slice(&crowd.near_start),
        cast_slice(&crowd.near_numbers),
        cast_slice(&crowd.near_offsets),
        cast_slice(&crowd.near_velocities),
        cast_slice(&crowd.near_radii),
        cast_slice(&crowd.near_shares),
    ];
    let walls: [&[u8]; 2] = [cast_slice(&crowd.wall_start), cast_slice(&crowd.walls)];
    [&head[..], &agents, &near, &walls].into_iter().flatten().try_for_each(|bytes| to.write_all(bytes))
}

/// A local model in Python. An error is kept until the step ends: a model cannot report one.
#[derive(Debug)]
pub struct WorkerModel {
    label: String,
    options: Options,
    worker: Mutex<Worker>,
    failed: Mutex<Option<String>>,
}

impl WorkerModel {
    /// Returns a group with this model.
    pub fn lead(self: &Arc<Self>, mut group: Group) -> Group {
        group.model = self.clone();
        group.neighbour_distance = self.options.reach.unwrap_or(group.neighbour_distance);
        group.neighbours = self.options.neighbors.unwrap_or(group.neighbours);
        group
    }

    /// Checks that the model has not failed.
    ///
    /// # Errors
    /// It raised an exception, or its process ended.
    pub fn check(&self, seed: u64) -> Result<(), Failure> {
        let failed = lock(&self.failed).take();
        failed.map_or(Ok(()), |text| Err(Failure::Error(format!("{} with seed {seed}: {text}", self.label))))
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl LocalModel for WorkerModel {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        view.preferred
    }

    fn together(&self) -> Option<&dyn CrowdModel> {
        Some(self)
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius + self.options.sees
    }
}

impl CrowdModel for WorkerModel {
    fn choose(&self, crowd: &mut Crowd<'_>) {
        let mut failed = lock(&self.failed);
        if failed.is_some() {
            return;
        }
        match lock(&self.worker).ask(crowd) {
            Ok(Ok(velocities)) => {
                velocities.into_iter().enumerate().for_each(|(k, velocity)| crowd.set_horizontal(k, velocity));
            }
            Ok(Err(text)) => *failed = Some(text),
            // a pipe breaks where the process has ended
            Err(_) => *failed = Some(format!("the process of the model ended at {:.2} s", crowd.time())),
        }
    }
}
