//! The worlds to measure.

use super::args::BenchArgs;
use super::machine::free_memory;
use crate::failure::Failure;
use crate::source::Loaded;
use std::path::Path;
use throng::World;
use throng_bench::{WORKS, Work, work};
use throng_scene::gallery;

/// The works that are measured without arguments.
const DEFAULT: [&str; 2] = ["crossing", "crossing-shuffled"];

/// The bytes that an agent of a large work needs: its world, a copy of the world that makes the steps (up to 490 bytes
/// each), and the data the world was built from.
const BYTES_AN_AGENT: u64 = 1_500;

/// A world to measure.
pub enum BenchSubject {
    /// A reference work.
    Work {
        /// The work.
        work: &'static Work,
        /// The number of agents.
        agents: usize,
        /// Whether the guard is on.
        guard: bool,
    },
    /// A scene.
    Scene(Box<Loaded>),
}

impl BenchSubject {
    /// Returns the name of the work or scene.
    pub fn name(&self) -> &str {
        match self {
            Self::Work { work, .. } => work.name,
            Self::Scene(loaded) => &loaded.name,
        }
    }

    /// Builds the world.
    ///
    /// # Errors
    /// The scene cannot be built, or the work cannot have this number of agents.
    pub fn build(&self) -> Result<World, Failure> {
        match self {
            Self::Work { work, agents, guard } => work
                .world(*agents, *guard)
                .map_err(|error| Failure::Error(format!("{} with {agents} agents: {error}", work.name))),
            Self::Scene(loaded) => Ok(loaded.build(true)?.0),
        }
    }
}

/// Returns the worlds to measure, in order.
///
/// # Errors
/// A work or scene does not exist, an option does not apply to it, or the agents do not fit into memory.
pub fn subjects(args: &BenchArgs) -> Result<Vec<BenchSubject>, Failure> {
    let (mut subjects, free) = (Vec::new(), free_memory());
    let named = args.works.iter().map(|path| path.as_path());
    let default = DEFAULT.iter().filter(|_| args.works.is_empty()).map(Path::new);
    for path in named.chain(default) {
        let works = works(path);
        if works.is_empty() {
            scene(path, args, &mut subjects)?;
        }
        for work in works {
            let sizes = if args.agents.is_empty() { work.sizes } else { &args.agents };
            for &agents in sizes {
                fits(work.name, agents, free)?;
                for guard in args.guards() {
                    subjects.push(BenchSubject::Work { work, agents, guard: guard.unwrap_or(false) });
                }
            }
        }
    }
    let changed = [
        ("--seed", args.changes.seed.is_some()),
        ("--set", !args.changes.set.is_empty()),
        ("--exit", args.changes.exit.is_some()),
        ("--people", args.changes.people.is_some()),
    ];
    if let Some((option, _)) = changed.iter().find(|(_, given)| *given)
        && let Some(BenchSubject::Work { work, .. }) =
            subjects.iter().find(|run| matches!(run, BenchSubject::Work { .. }))
    {
        let text = format!("{option} is for scenes; {} is a reference work, which is always the same", work.name);
        return Err(Failure::hint(text, "leave it out; --agents and --guard change a work"));
    }
    Ok(subjects)
}

/// Returns the works that a name stands for; none if it names a scene.
fn works(path: &Path) -> Vec<&'static Work> {
    match path.to_str() {
        Some("all") => WORKS.iter().collect(),
        Some("densities") => WORKS.iter().filter(|work| work.name.starts_with("density-")).collect(),
        name => name.and_then(work).into_iter().collect(),
    }
}

fn scene(path: &Path, args: &BenchArgs, subjects: &mut Vec<BenchSubject>) -> Result<(), Failure> {
    let plain = path.to_str().filter(|name| !name.contains(['.', '/', '\\']));
    if let Some(name) = plain
        && gallery::text(name).is_none()
        && !path.exists()
    {
        let works: Vec<&str> = WORKS.iter().map(|work| work.name).collect();
        let hint = format!("the works are {}, densities and all; `throng list` has the scenes", works.join(", "));
        return Err(Failure::hint(format!("there is no work and no scene `{name}`"), hint));
    }
    if !args.agents.is_empty() {
        let text = format!("--agents is for reference works; {} is a scene", path.display());
        return Err(Failure::hint(text, "a scene says how many agents there are; --set count=N changes it"));
    }
    let loaded = args.changes.load(path)?;
    for guard in args.guards() {
        let mut loaded = loaded.clone();
        if let Some(guard) = guard {
            loaded.scene.set("guard", &guard.to_string())?;
        }
        subjects.push(BenchSubject::Scene(Box::new(loaded)));
    }
    Ok(())
}

/// Checks that this number of agents fits into the free memory, where that is known.
fn fits(name: &str, agents: usize, free: Option<u64>) -> Result<(), Failure> {
    let needed = agents as u64 * BYTES_AN_AGENT;
    let Some(free) = free.filter(|free| needed > *free) else { return Ok(()) };
    let gib = |bytes: u64| bytes as f64 / f64::from(1 << 30);
    let (needs, has) = (gib(needed), gib(free));
    let text = format!("{name} with {agents} agents needs up to {needs:.1} GiB of memory, and {has:.1} GiB are free");
    Err(Failure::hint(text, format!("up to {} agents fit", free / BYTES_AN_AGENT)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_than_fits_into_memory_is_refused() {
        let free = 4 << 30;
        let most = (free / BYTES_AN_AGENT) as usize;
        assert!(fits("crossing", most, Some(free)).is_ok() && fits("crossing", most + 1, None).is_ok());
        let error = fits("crossing", 2 * most, Some(free)).unwrap_err();
        let text = error.text().unwrap();
        assert!(text.contains("8.0 GiB") && text.contains("4.0 GiB") && text.contains(&most.to_string()), "{text}");
    }
}
