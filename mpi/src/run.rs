//! `throng-mpi run`: steps a crowd on all ranks, and writes its files.

use crate::args::RunArgs;
use crate::checkpoint::Manifest;
use crate::failure::{Failure, together};
use crate::parts::Parts;
use crate::people::{self, People};
use crate::ranks::Ranks;
use crate::signals::Signals;
use serde_json::json;
use std::fs;
use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};
use throng::halo::{Cuts, DividedWorld};
use throng::{Counts, Summary, World};
use throng_record::{Output, moment};
use throng_scene::{Built, Scene};

/// The cost of the slowest rank, relative to the mean, from which the ground is divided anew.
const UNEVEN: f64 = 1.15;
/// Time between two lines of progress.
const PROGRESS: Duration = Duration::from_secs(1);

/// Runs a scene.
///
/// # Errors
/// The scene cannot be built or divided, a file cannot be written, or the run was asked to end.
pub fn run(args: &RunArgs, mut ranks: Ranks) -> Result<(), Failure> {
    let begin = Instant::now();
    let scene = together(&ranks, scene(args))?;
    let identity = together(&ranks, identity(args, &scene))?;
    same_everywhere(&ranks, &identity)?;
    together(&ranks, threads(args, &ranks))?;
    together(&ranks, folder(args))?;
    // before this point there is nothing to save, and a signal ends the program at once
    let signals = together(&ranks, Signals::watch())?;

    let found = |ranks: &Ranks| match args.resume {
        true => Manifest::read(&args.output, VERSION, &identity).map(Some),
        false => Ok(None).and_then(|none| if ranks.is_first() { unused(args).map(|()| none) } else { Ok(none) }),
    };
    let mut last = together(&ranks, found(&ranks))?;
    let (world, built, cuts) = together(&ranks, build(args, &scene, &ranks))?;
    ranks.cuts = cuts;
    let setting = moment::setting(&world, &built, &scene.title);
    let (own, worlds) = (ranks.rank(), ranks.count());
    let divided = match &last {
        None if args.people.is_empty() => DividedWorld::new(world, ranks).map_err(Failure::from),
        None => DividedWorld::from_part(world, ranks).map_err(Failure::from),
        Some(last) => resume(args, last, world, ranks),
    };
    let mut part = divided?;
    let steps_of = |seconds: f64| if seconds > 0.0 { ((seconds / scene.time.step).round() as u64).max(1) } else { 0 };
    let mut parts = Parts::new(&args.output, own, args.format, setting, steps_of(args.every));
    let first =
        if own == 0 { Parts::remove_after(&args.output, last.as_ref().map_or(0, |last| last.steps)) } else { Ok(()) };
    together(part.halo(), first)?;

    let limit = args.time.unwrap_or(scene.time.limit);
    let mut clocks = Clocks::new(args);
    let mut pushed = if last.is_none() { parts.push(part.world()) } else { Ok(()) };
    loop {
        let over = part.world().time() + 0.5 * scene.time.step >= limit;
        let done = over || (scene.time.until != throng_scene::Until::Limit && part.finished());
        let failed = part.any(pushed.is_err());
        let asked = part.any(signals.asked());
        let due = part.any(own == 0 && clocks.checkpoint_is_due());
        if failed {
            // what was written until the last checkpoint is complete
            return pushed.and(Err(Failure::Elsewhere));
        }
        if done || asked || due {
            together(part.halo(), parts.complete())?;
        }
        if args.checkpoint > 0.0 && (asked || due) && !done {
            let manifest = Manifest {
                version: VERSION.into(),
                scene: identity.clone(),
                steps: part.world().steps(),
                ranks: worlds,
                folder: format!("checkpoint-{:010}", part.world().steps()),
            };
            let state = part.world().save();
            last = Some(manifest.write(&args.output, part.halo(), &state, last.as_ref())?);
            clocks.checkpoint = Instant::now();
        }
        if asked && !done {
            return Err(Failure::Interrupted);
        }
        if done {
            break;
        }
        clocks.step(&mut part);
        if args.hashes {
            let hash = part.state_hash();
            if own == 0 {
                println!("{:8} {hash:016x}", part.world().steps());
            }
        }
        pushed = parts.push(part.world());
        if args.balance > 0 && part.world().steps().is_multiple_of(args.balance) {
            clocks.balance(&mut part);
        }
        if part.any(own == 0 && clocks.progress_is_due(args)) {
            let counts = part.counts();
            if own == 0 {
                clocks.show(part.world().time(), limit, &counts);
            }
        }
    }
    let (summary, hash) = (part.summary(), part.state_hash());
    let figures = clocks.figures(&part);
    if own == 0 {
        if !args.quiet {
            print(&summary, hash, worlds, &figures, begin.elapsed());
        }
        write_result(args, &summary, hash, worlds, &figures)?;
    }
    Ok(())
}

const VERSION: &str = env!("CARGO_PKG_VERSION");

fn scene(args: &RunArgs) -> Result<Scene, Failure> {
    let mut scene = throng_scene::open(&args.scene)?.scene;
    for (key, value) in &args.set {
        scene.set(key, value)?;
    }
    Ok(scene)
}

/// Returns a hash of the scene and of what changes it, as text.
fn identity(args: &RunArgs, scene: &Scene) -> Result<String, Failure> {
    let sizes = args.people.iter().map(|path| fs::metadata(path).map_or(0, |file| file.len()));
    let said = format!("{}{:?}{:?}", scene.to_toml()?, args.people, sizes.collect::<Vec<_>>());
    // FNV-1a, RFC 9923
    let hash = said
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
    Ok(format!("{hash:016x}"))
}

/// Checks that all ranks have the same program and the same scene.
fn same_everywhere(ranks: &Ranks, identity: &str) -> Result<(), Failure> {
    let number =
        |text: &str| text.bytes().fold(0u64, |number, byte| number.wrapping_mul(257).wrapping_add(byte.into()));
    for (own, what) in [(number(VERSION), "version of throng-mpi"), (number(identity), "scene, people or options")] {
        let all = ranks.gather(own);
        if let Some(other) = all.iter().position(|value| *value != all[0]) {
            let text = format!("rank {other} has another {what} than rank 0");
            let same = Failure::hint(text, "start the same program with the same files on all machines");
            return Err(if ranks.is_first() { same } else { Failure::Elsewhere });
        }
    }
    Ok(())
}

fn threads(args: &RunArgs, ranks: &Ranks) -> Result<(), Failure> {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let threads = args.threads.unwrap_or((cores / ranks.on_this_machine()).max(1));
    // this thread is one of them, because MPI is called from the main thread
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).use_current_thread().build_global();
    pool.map_err(|error| Failure::Here(format!("cannot start {threads} threads: {error}")))
}

fn folder(args: &RunArgs) -> Result<(), Failure> {
    let made = fs::create_dir_all(&args.output);
    made.map_err(|error| Failure::Here(format!("cannot make the folder {}: {error}", args.output.display())))
}

/// Refuses to begin a run in the folder of another one.
fn unused(args: &RunArgs) -> Result<(), Failure> {
    let path = args.output.join("checkpoint.json");
    if path.exists() {
        let text = format!("{} exists: the folder holds a run that can go on", path.display());
        return Err(Failure::hint(text, "add --resume, choose another folder, or remove this one"));
    }
    Ok(())
}

/// Returns the world of this rank, and cuts that give all ranks as many agents.
fn build(args: &RunArgs, scene: &Scene, ranks: &Ranks) -> Result<(World, Built, Cuts), Failure> {
    if args.people.is_empty() {
        let (world, built) = scene.build()?;
        let cuts = Cuts::balanced(ranks.count(), &people::load(&world, built.bounds));
        return Ok((world, built, cuts));
    }
    let (mut world, built) = scene.build_without_agents()?;
    let Some(group) = built.groups.first() else {
        return Err(Failure::hint("the scene has no group for the people", "add a [[group]] to the scene"));
    };
    let People { load, added, .. } = People::add(&args.people, scene, group.id, built.bounds, ranks, &mut world)?;
    if !args.resume {
        world.face_ways(&added);
    }
    Ok((world, built, Cuts::balanced(ranks.count(), &load)))
}

/// Goes on from a checkpoint. Each rank reads the states of some ranks of the run before.
fn resume(args: &RunArgs, last: &Manifest, world: World, ranks: Ranks) -> Result<DividedWorld<Ranks>, Failure> {
    let (own, worlds) = (ranks.rank(), ranks.count());
    let read = || {
        let shared = last.read_state(&args.output, 0)?;
        let states = (own..last.ranks).step_by(worlds).map(|rank| last.read_state(&args.output, rank));
        Ok((shared, states.collect::<Result<Vec<_>, _>>()?))
    };
    let (shared, states) = together(&ranks, read())?;
    Ok(DividedWorld::resume(world, &shared, states, ranks)?)
}

/// Times and costs of a rank.
struct Clocks {
    /// When the last checkpoint was written, and the time between two; `None`: none are written.
    checkpoint: Instant,
    period: Option<Duration>,
    shown: Instant,
    begin: Instant,
    /// Time computed since the ground was divided, and in the whole run.
    since: Duration,
    computed: Duration,
    divisions: u32,
}

impl Clocks {
    fn new(args: &RunArgs) -> Self {
        let now = Instant::now();
        let period = (args.checkpoint > 0.0).then(|| Duration::from_secs_f64((args.checkpoint * 60.0).min(1e9)));
        Self {
            checkpoint: now,
            period,
            shown: now,
            begin: now,
            since: Duration::ZERO,
            computed: Duration::ZERO,
            divisions: 1,
        }
    }

    fn checkpoint_is_due(&self) -> bool {
        self.period.is_some_and(|period| self.checkpoint.elapsed() >= period)
    }

    fn progress_is_due(&mut self, args: &RunArgs) -> bool {
        let due = !args.quiet && std::io::stderr().is_terminal() && self.shown.elapsed() >= PROGRESS;
        if due {
            self.shown = Instant::now();
        }
        due
    }

    /// Makes a step, and measures it without the time in which the rank waits.
    fn step(&mut self, part: &mut DividedWorld<Ranks>) {
        let (start, waited) = (Instant::now(), part.halo().waited);
        part.step();
        let computed = start.elapsed().saturating_sub(part.halo().waited - waited);
        self.since += computed;
        self.computed += computed;
    }

    /// Divides the ground anew if the ranks are uneven.
    fn balance(&mut self, part: &mut DividedWorld<Ranks>) {
        let costs = part.halo().gather(self.since.as_secs_f64());
        let mean = costs.iter().sum::<f64>() / costs.len() as f64;
        let most = costs.iter().copied().fold(0.0, f64::max);
        if most > UNEVEN * mean {
            let cuts = part.balanced(self.since.as_secs_f64());
            part.halo_mut().cuts = cuts;
            self.divisions += 1;
        }
        self.since = Duration::ZERO;
    }

    fn show(&self, time: f64, limit: f64, counts: &Counts) {
        let share = (time / limit).max(counts.arrived as f64 / counts.agents.max(1) as f64).min(1.0);
        let left = self.begin.elapsed().as_secs_f64() * (1.0 / share.max(1e-6) - 1.0);
        let line = format!(
            "{time:.1} s, {}/{} arrived, {:.0} %, {left:.0} s left",
            counts.arrived,
            counts.agents,
            share * 100.0
        );
        // progress that cannot be shown is no error
        let _ = write!(std::io::stderr(), "\r\x1b[K{line}");
    }

    /// Returns the figures of all ranks.
    fn figures(&self, part: &DividedWorld<Ranks>) -> Figures {
        let ranks = part.halo();
        let mean = |own: f64| ranks.gather(own).iter().sum::<f64>() / ranks.count() as f64;
        Figures {
            stepping: self.begin.elapsed().as_secs_f64(),
            computing: mean(self.computed.as_secs_f64()),
            waiting: mean(ranks.waited.as_secs_f64()),
            sent: ranks.gather(ranks.sent).iter().sum(),
            divisions: self.divisions,
        }
    }
}

/// What a run has cost: seconds, means over the ranks; bytes sent by all ranks; and how often the ground was divided.
struct Figures {
    stepping: f64,
    computing: f64,
    waiting: f64,
    sent: u64,
    divisions: u32,
}

fn print(summary: &Summary, hash: u64, ranks: usize, figures: &Figures, wall: Duration) {
    let Summary { agents, arrived, removed, time, steps, agent_steps, .. } = summary;
    let per_step = figures.computing * ranks as f64 * 1e9 / (*agent_steps).max(1) as f64;
    println!("{time:.2} s simulated in {steps} steps by {ranks} ranks");
    println!("  agents     {arrived} of {agents} arrived, {removed} left by exits, {} overlaps", summary.overlaps);
    println!("  state      {hash:016x}");
    println!(
        "  computing  {:.1} s in all; a rank computes {:.1} s and waits {:.1} s; {per_step:.0} ns an agent-step; {:.1} MB sent",
        wall.as_secs_f64(),
        figures.computing,
        figures.waiting,
        figures.sent as f64 / 1e6,
    );
    println!("  ground     divided {} times", figures.divisions);
}

fn write_result(args: &RunArgs, summary: &Summary, hash: u64, ranks: usize, figures: &Figures) -> Result<(), Failure> {
    let Figures { stepping, computing, waiting, sent, divisions } = figures;
    let result = json!({
        "version": VERSION,
        "scene": args.scene.display().to_string(),
        "ranks": ranks,
        "state_hash": format!("{hash:016x}"),
        "summary": summary,
        "step_seconds": stepping,
        "computing_seconds": computing,
        "waiting_seconds": waiting,
        "bytes_sent": sent,
        "divisions": divisions,
    });
    let path = args.output.join("run.json");
    let mut output = Output::create(&path)?;
    let written = output.write_all(format!("{result:#}\n").as_bytes());
    written.map_err(|error| throng_record::OutputError::new(&path, error))?;
    Ok(output.finish()?)
}
