//! JuPedSim, on its own work and on floor plans that throng simulates too.

use crate::contest::Contestant;
use crate::crossing::Throng;
use crate::python::Python;
use std::error::Error;
use std::path::Path;
use throng_scene::import::plan::{self, PlanOptions};

/// The script of JuPedSim.
pub const SCRIPT: &str = include_str!("../scripts/jupedsim.py");

/// Returns JuPedSim with `agents` agents in a square.
///
/// # Errors
/// Python does not answer.
pub fn own_work(python: &Path, agents: usize) -> Result<Box<dyn Contestant>, Box<dyn Error>> {
    // the script draws their positions
    let people = vec![String::new(); agents];
    Ok(Box::new(Python::start(python, "jupedsim", SCRIPT, &[], &[&people])?))
}

/// Returns throng and JuPedSim with the same agents at random on a floor plan, bound for an exit `x,y,width,height`.
/// throng makes steps of 0.05 s, JuPedSim its own.
///
/// # Errors
/// The plan cannot be loaded, the exit has no room, or Python does not answer.
pub fn evacuation(
    plan: &str,
    exit: &str,
    people: u64,
    python: Option<&Path>,
) -> Result<Vec<Box<dyn Contestant>>, Box<dyn Error>> {
    let numbers: Vec<f64> = exit.split(',').map(str::parse).collect::<Result<_, _>>()?;
    let exit: [f64; 4] = numbers.try_into().map_err(|_| "the exit is x,y,width,height")?;
    let mut scene =
        plan::load(plan, &PlanOptions { exit: Some(exit), people: Some(people), ..PlanOptions::default() })?.scene;
    scene.time.step = 0.05;
    let (world, _) = scene.build()?;
    let origin = world.settings().origin;
    let agents = world.relative_columns();
    let rows: Vec<String> = (0..agents.len())
        .map(|row| {
            let at = agents.position[row].as_dvec2() + origin;
            format!("{} {} {}", at.x, at.y, agents.preferred_speed[row])
        })
        .collect();
    let mut contestants: Vec<Box<dyn Contestant>> = vec![Box::new(Throng::new("throng with its guard", world))];
    if let Some(python) = python {
        let [x, y, width, height] = exit;
        let corners = [x, y, x + width, y, x + width, y + height, x, y + height];
        let arguments: Vec<String> =
            std::iter::once(plan.to_owned()).chain(corners.iter().map(f64::to_string)).collect();
        contestants.push(Box::new(Python::start(python, "jupedsim", SCRIPT, &arguments, &[&rows])?));
    }
    Ok(contestants)
}
