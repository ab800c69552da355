//! Runs: recorded frames, and what can be made from them.

use crate::arrow;
use crate::error::{FileError, scene_error};
use crate::inner::Inner;
use crate::place::{Corners, rings};
use crate::track::State;
use crate::trajectories::Trajectories;
use crate::world::World;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use throng_draw::page::{Player, Scenery, document, escape};
use throng_draw::record::{Files, Plan, Recorder};
use throng_draw::{Still, Style, palette};
use throng_record::{Choice, Format, Frame, Output, Setting, moment};
use throng_scene::Scene as Described;

/// What a world did, at a fixed rate.
#[pyclass(frozen, module = "throng_sim._throng")]
pub struct Recording {
    pub setting: Setting,
    frames: Mutex<Vec<Frame>>,
    scene: Described,
    bounds: [glam::DVec2; 2],
    /// Seconds between two frames.
    every: f64,
    /// Steps of the world at the first frame, and steps between two frames.
    first: u64,
    steps: u64,
}

fn capture(world: &throng::World) -> Frame {
    let mut frame = Frame::default();
    moment::capture(world, &mut frame);
    frame
}

#[pymethods]
impl Recording {
    /// Begins a recording of a world at `rate` frames a second, with its present state.
    #[new]
    #[pyo3(signature = (world, rate=10.0))]
    fn new(py: Python<'_>, world: &World, rate: f64) -> PyResult<Self> {
        if !(rate > 0.0 && rate.is_finite()) {
            return Err(PyValueError::new_err(format!("the rate is {rate}, but must be more than 0 frames a second")));
        }
        let inner = world.lock(py)?;
        let step = inner.world.settings().step;
        let every = (1.0 / rate / step).round().max(1.0);
        let setting = moment::setting_with_files(&inner.world, &inner.built, &inner.scene, &inner.scene.title);
        Ok(Self {
            setting: setting.map_err(|error| scene_error(py, &error))?,
            frames: Mutex::new(vec![capture(&inner.world)]),
            scene: inner.scene.clone(),
            bounds: inner.built.bounds,
            every: every * step,
            first: inner.world.steps(),
            steps: every as u64,
        })
    }

    /// Runs the world until its scene is over, or until `until` seconds, but makes at most `most` steps. Returns whether
    /// it is at the end.
    #[pyo3(signature = (world, until=None, most=u64::MAX))]
    fn go_on(&self, py: Python<'_>, world: &World, until: Option<f64>, most: u64) -> PyResult<bool> {
        let mut inner = world.lock(py)?;
        let ends = |inner: &Inner| inner.is_at_end(until);
        inner.go(py, most, ends, |inner| {
            if (inner.world.steps() - self.first).is_multiple_of(self.steps) {
                self.frames().push(capture(&inner.world));
            }
        })?;
        let is_over = ends(&inner);
        if is_over && self.frames().last().is_none_or(|last| last.time < inner.world.time()) {
            let last = capture(&inner.world);
            self.frames().push(last);
        }
        Ok(is_over)
    }

    fn __len__(&self) -> usize {
        self.frames().len()
    }

    /// Seconds from one frame to the next.
    #[getter]
    fn every(&self) -> f64 {
        self.every
    }

    /// The times of the frames, seconds.
    fn times(&self) -> Vec<f64> {
        self.frames().iter().map(|frame| frame.time).collect()
    }

    /// The names of the groups.
    #[getter]
    fn group_names(&self) -> Vec<String> {
        (0..self.setting.groups.len() as u32).map(|k| self.setting.group_name(k).into_owned()).collect()
    }

    /// Lower left and upper right corner of the scene, metres.
    #[getter]
    fn bounds(&self) -> [[f64; 2]; 2] {
        self.bounds.map(|corner| corner.to_array())
    }

    /// Corners of the walkable areas and of their holes, metres.
    fn walkable(&self) -> Vec<Vec<Corners>> {
        rings(&self.setting.walkable)
    }

    /// The trajectories in the Arrow C stream interface.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // the interface allows to ignore the request; the consumer then casts
        let _ = requested_schema;
        arrow::stream(py, &self.frames(), &self.setting)
    }

    /// Returns a web page that plays the recording, without a network.
    fn player(&self, py: Python<'_>) -> String {
        py.detach(|| self.page())
    }

    /// Returns what the agents did so far.
    fn trajectories(&self, py: Python<'_>) -> Trajectories {
        py.detach(|| self.trajectories_of())
    }

    /// Writes files of the kinds that `throng run` writes.
    #[pyo3(signature = (paths, rate=25.0, speed_up=1.0, size=None, moment=None))]
    fn save(
        &self,
        py: Python<'_>,
        paths: Vec<PathBuf>,
        rate: f64,
        speed_up: f64,
        size: Option<(u32, u32)>,
        moment: Option<f64>,
    ) -> PyResult<()> {
        for (name, number) in [("rate", rate), ("speed_up", speed_up)] {
            if !(number > 0.0 && number.is_finite()) {
                return Err(PyValueError::new_err(format!("{name} is {number}, but must be more than 0")));
            }
        }
        py.detach(|| self.write(&paths, (rate, speed_up), size, moment))
    }
}

impl Recording {
    fn page(&self) -> String {
        let frames = self.frames();
        let Some(first) = frames.first() else { return String::new() };
        let style = Style::said(&self.scene);
        let scenery = Scenery::of_scene(self.setting.clone(), &style, first, self.bounds, first.total);
        let numbers = frames.iter().flat_map(|frame| &frame.bodies).map(|body| body.number as usize + 1);
        let mut player = Player::new(scenery, 1, numbers.max().unwrap_or(0), self.every);
        for frame in frames.iter() {
            let moments = ((frame.time - first.time) / self.every).round();
            player.push(moments as u64, [(0, frame)]);
        }
        if let Some(last) = frames.last() {
            player.end(0, last);
        }
        let title = escape(&self.setting.title);
        document(&title, &player.section(std::slice::from_ref(&title), ""), &player.script())
    }

    fn write(
        &self,
        paths: &[PathBuf],
        (rate, speed_up): (f64, f64),
        size: Option<(u32, u32)>,
        moment: Option<f64>,
    ) -> PyResult<()> {
        let said = Style::said(&self.scene);
        let (width, height) = size.unwrap_or((said.width, said.height));
        let style = Style { width, height, ..said };
        let choice = Choice::default();
        let still = Still::Time(moment.unwrap_or_else(|| self.scene.moment().min(self.end())));
        let plan = Plan {
            setting: &self.setting,
            sheet: None,
            style: &style,
            rate,
            speed_up,
            still,
            from: 0.0,
            choice: &choice,
            stop: || false,
        };
        let failed = |path: &Path, error: &dyn std::fmt::Display| {
            FileError::new_err(format!("cannot write {}: {error}", path.display()))
        };
        paths.iter().for_each(Output::remove_leftovers);
        let kinds = paths.iter().filter(|path| !path.is_dir()).filter_map(Format::of);
        choice.check(&self.setting, kinds).map_err(|error| PyValueError::new_err(error.to_string()))?;
        let begin = |path: &PathBuf| Recorder::create(path, &plan).map_err(|error| failed(path, &error));
        let begun = paths.iter().map(begin).collect::<PyResult<_>>()?;
        let mut files = Files::new(begun, plan.pace(), &choice);
        let all = || paths.first().map_or(Path::new(""), PathBuf::as_path);
        let frames = self.frames();
        for frame in frames.iter() {
            let pushed = files.push(frame.time, self.every, |to| to.clone_from(frame));
            pushed.map_err(|error| failed(all(), &error))?;
        }
        let Some(last) = frames.last() else { return Ok(()) };
        files.finish(last.time, |to| to.clone_from(last)).map_err(|error| failed(all(), &error))
    }

    /// Returns the trajectories so far.
    pub fn trajectories_of(&self) -> Trajectories {
        let frames = self.frames();
        let states = frames.iter().flat_map(|frame| frame.bodies.iter().map(move |body| (frame.time, body)));
        let states = states.map(|(time, body)| State {
            number: body.number,
            group: body.group,
            radius: body.radius,
            time,
            place: body.center(),
            heading: body.heading.into(),
        });
        Trajectories::new(self.setting.clone(), vec![], states)
    }

    /// Returns the frames so far.
    pub fn frames(&self) -> MutexGuard<'_, Vec<Frame>> {
        self.frames.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The time of the last frame.
    fn end(&self) -> f64 {
        self.frames().last().map_or(0.0, |frame| frame.time)
    }
}

/// Returns the first colours of the project, for groups and lines.
#[pyfunction(name = "palette")]
pub fn colors(count: usize) -> Vec<String> {
    (0..count).map(|k| palette(k).hex()).collect()
}
