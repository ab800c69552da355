//! Works with walls: throng, RVO2 and JuPedSim on the same agents, walls and goals.

use crate::contest::{self, Contestant, Outcome};
use crate::crossing::{Throng, WARM_UP, goal};
use crate::plans::SCRIPT;
use crate::python::Python;
use glam::DVec2;
use std::error::Error;
use std::path::Path;
use throng::navigate::{NavMesh, PathSearch};
use throng::{Group, Obstacle};
use throng_bench::{Crowd, work};

/// Distance that paths keep from walls beyond the agents' radius, metres: throng's own.
const CLEARANCE: f64 = 0.001;

/// Measures a work with walls, `agents` agents.
///
/// # Errors
/// The work cannot be built, or Python does not answer.
pub fn measure(name: &str, agents: usize, repeat: u32, python: &Path) -> Result<Vec<Outcome>, Box<dyn Error>> {
    let work = work(name).ok_or("no such work")?;
    let crowd = work.crowd(agents).ok_or("not a work of pedestrians")?;
    let bare = crowd.world(Group { guard: false, ..Crowd::bare() }, f32::INFINITY)?;
    let people: Vec<String> =
        crowd.people.iter().map(|person| format!("{} {}", row(&[person.position]), person.preferred_speed)).collect();
    let rings = rings(&crowd);
    // RVO2 plans no paths: it gets throng's
    let routes: Vec<String> = routes(&crowd)?.iter().map(|corners| row(corners)).collect();
    let rvo2 = [crowd.step, crowd.radius].map(|number| number.to_string());
    let goals: Vec<String> = crowd.people.iter().map(|person| row(&[goal(&crowd, person.way)])).collect();
    // as long a warm-up as throng's, in steps of 0.01 s
    let warm_up = f64::from(WARM_UP) * crowd.step / 0.01;
    let exit = crowd.exit.unwrap_or(0.0);
    let jupedsim = ["work".to_owned(), format!("{warm_up:.0}"), exit.to_string(), crowd.radius.to_string()];
    let contestants: Vec<Box<dyn Contestant>> = vec![
        Box::new(Throng::new("throng", bare)),
        Box::new(Throng::new("throng with rules and its guard", work.world(agents, true)?)),
        Box::new(Python::start(
            python,
            "pyrvo",
            include_str!("../scripts/rvo2.py"),
            &rvo2,
            &[&people, &routes, &rings],
        )?),
        Box::new(Python::start(python, "jupedsim", SCRIPT, &jupedsim, &[&people, &goals, &rings])?),
    ];
    let steps = (1_000_000 / agents.max(1)).clamp(10, 100) as u32;
    contest::measure(contestants, steps, repeat)
}

/// Returns points as a line of numbers.
fn row(points: &[DVec2]) -> String {
    let numbers: Vec<String> = points.iter().flat_map(|p| p.to_array()).map(|x| x.to_string()).collect();
    numbers.join(" ")
}

/// Returns the boundary of the walkable area and the obstacles, a ring of corners each. A ring of two is a thin wall.
fn rings(crowd: &Crowd) -> Vec<String> {
    let areas = crowd.walkable.iter().map(|area| row(&area.outer));
    let obstacles = crowd.obstacles.iter().flat_map(|obstacle| match obstacle {
        Obstacle::Polygon { corners } => vec![row(corners)],
        Obstacle::Wall { points } => points.windows(2).map(row).collect(),
        Obstacle::Circle { .. } => vec![],
    });
    areas.chain(obstacles).collect()
}

/// Returns the corners of the shortest path of each agent, and its end.
fn routes(crowd: &Crowd) -> Result<Vec<Vec<DVec2>>, Box<dyn Error>> {
    let extent = (DVec2::ZERO, DVec2::ZERO);
    let mesh = NavMesh::build(&crowd.walkable, &crowd.obstacles, crowd.radius + CLEARANCE, extent)?;
    let mut search = PathSearch::new();
    let route = |person: &throng_bench::Person| {
        let path = mesh.path(&mut search, person.position, goal(crowd, person.way));
        Ok(path.map_err(|_| "a goal cannot be reached")?.corners)
    };
    crowd.people.iter().map(route).collect()
}
