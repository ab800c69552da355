//! Measures of pedestrians: those of `throng measure`.

use crate::run::Recording;
use glam::DVec2;
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use throng_record::pedestrian::{
    Area, Figures, Ground, Inside, Instant, Line, People, Question, Walk, flow, steady_flow,
};

/// What to measure: areas by their corners, lines by their ends.
type Places = (Vec<Vec<[f64; 2]>>, Vec<[[f64; 2]; 2]>);

/// Measures a recording, or one group of it, between two times. Velocities are displacements over `interval`
/// seconds.
#[pyfunction]
#[pyo3(signature = (recording, places, interval, cut_off=None, group=None, within=(0.0, f64::INFINITY)))]
pub fn figures<'py>(
    py: Python<'py>,
    recording: &Recording,
    places: Places,
    interval: f64,
    cut_off: Option<f64>,
    group: Option<&str>,
    within: (f64, f64),
) -> PyResult<Bound<'py, PyDict>> {
    let (areas, lines) = places;
    let areas: Vec<Area> = areas.into_iter().map(area).collect::<PyResult<_>>()?;
    let line = |[from, to]: [[f64; 2]; 2]| Line { from: from.into(), to: to.into() };
    let lines: Vec<Line> = lines.into_iter().map(line).collect();
    let people = recording.people(group, within)?;
    let ground = Ground::new(recording.setting.walkable.clone(), cut_off);
    let question = Question { interval, areas, lines, ground };
    let figures = py.detach(|| Figures::of(&people, &question));
    let out = PyDict::new(py);
    let instants = |read: fn(&Instant) -> f64| PyArray1::from_iter(py, figures.instants.iter().map(read));
    out.set_item("time", instants(|at| at.time))?;
    out.set_item("people", instants(|at| at.people as f64))?;
    out.set_item("speed", instants(|at| at.speed))?;
    out.set_item("lane_order", instants(|at| at.lane_order))?;
    out.set_item("steady_lane_order", figures.steady_lane_order())?;
    let inside = |all: &Vec<Inside>| -> PyResult<_> {
        let column = |read: fn(&Inside) -> f64| PyArray1::from_iter(py, all.iter().map(read));
        let area = PyDict::new(py);
        area.set_item("density", column(|at| at.density))?;
        area.set_item("speed", column(|at| at.speed))?;
        area.set_item("voronoi_density", column(|at| at.voronoi_density))?;
        area.set_item("voronoi_speed", column(|at| at.voronoi_speed))?;
        Ok(area)
    };
    out.set_item("areas", figures.areas.iter().map(inside).collect::<PyResult<Vec<_>>>()?)?;
    let mut crossed = vec![];
    for crossings in &figures.crossings {
        let line = PyDict::new(py);
        line.set_item("time", PyArray1::from_iter(py, crossings.iter().map(|crossing| crossing.time)))?;
        line.set_item("id", PyArray1::from_iter(py, crossings.iter().map(|crossing| crossing.number)))?;
        line.set_item("flow", flow(crossings))?;
        line.set_item("steady_flow", steady_flow(crossings))?;
        crossed.push(line);
    }
    out.set_item("lines", crossed)?;
    Ok(out)
}

impl Recording {
    fn people(&self, group: Option<&str>, (since, until): (f64, f64)) -> PyResult<People> {
        let names: Vec<_> = (0..self.setting.groups.len() as u32).map(|k| self.setting.group_name(k)).collect();
        let chosen = match group {
            None => None,
            Some(name) => Some(names.iter().position(|other| other == name).ok_or_else(|| {
                PyValueError::new_err(format!("there is no group `{name}`; there are: {}", names.join(", ")))
            })? as u32),
        };
        let within = |time: f64| time >= since - 1e-9 && time <= until + 1e-9;
        let mut rows: Vec<(u32, f64, DVec2, f32)> = vec![];
        for frame in self.frames().iter().filter(|frame| within(frame.time)) {
            let bodies = frame.bodies.iter().filter(|body| chosen.is_none_or(|chosen| body.group == chosen));
            rows.extend(bodies.map(|body| (body.number, frame.time, body.position, body.radius)));
        }
        // frames are in the order of time, and the sort is stable
        rows.sort_by_key(|row| row.0);
        let walk = |own: &[(u32, f64, DVec2, f32)]| Walk {
            number: own[0].0,
            radius: own[0].3.into(),
            times: own.iter().map(|row| row.1).collect(),
            places: own.iter().map(|row| row.2).collect(),
        };
        Ok(People::new(rows.chunk_by(|a, b| a.0 == b.0).map(walk).collect()))
    }
}

fn area(corners: Vec<[f64; 2]>) -> PyResult<Area> {
    let text = format!("an area with {} corners has no size: give at least three, not in a line", corners.len());
    Area::new(corners.into_iter().map(DVec2::from).collect()).ok_or_else(|| PyValueError::new_err(text))
}
