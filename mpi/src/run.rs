//! `throng-mpi run`: steps a crowd on all ranks, and writes its files.

use crate::args::RunArgs;
use crate::checkpoint::Manifest;
use crate::clocks::Clocks;
use crate::failure::{Failure, together};
use crate::parts::Parts;
use crate::people::People;
use crate::ranks::Ranks;
use crate::report;
use crate::signals::Signals;
use crate::threads;
use glam::DVec2;
use std::fs;
use std::time::Instant;
use throng::World;
use throng::halo::{Cuts, DividedWorld, Load};
use throng_record::moment;
use throng_scene::{Built, Scene, Until};

/// Runs a scene.
///
/// # Errors
/// The scene cannot be built or divided, a file cannot be written, or the run was asked to end.
pub fn run(args: &RunArgs, mut ranks: Ranks) -> Result<(), Failure> {
    let begin = Instant::now();
    let scene = together(&ranks, scene(args))?;
    let identity = together(&ranks, identity(args, &scene))?;
    same_everywhere(&ranks, identity)?;
    let identity = format!("{identity:016x}");
    together(&ranks, threads::start(args, &ranks))?;
    together(&ranks, folder(args))?;
    let last = match args.resume {
        true => Manifest::read(&args.output, VERSION, &identity).map(Some),
        false => unused(args).map(|()| None),
    };
    // all ranks look before the first of them writes
    let last = together(&ranks, last)?;
    let (world, built) = together(&ranks, build(args, &scene, &ranks))?;
    let setting = moment::setting(&world, &built, &scene.title);
    let rank = ranks.rank();
    let part = if last.is_none() && args.people.is_empty() {
        ranks.cuts = Cuts::balanced(ranks.count(), &load(&world, built.bounds));
        DividedWorld::new(world, ranks)?
    } else {
        let mut part = match &last {
            None => DividedWorld::from_part(world, ranks)?,
            Some(last) => resume(args, last, world, ranks)?,
        };
        // the agents are on any rank, and move in the first step
        part.halo_mut().cuts = part.balanced(0.0);
        part
    };
    let checkpoint = last.as_ref().map(|last| last.steps);
    let removed = if rank == 0 { Parts::remove_after(&args.output, checkpoint) } else { Ok(()) };
    together(part.halo(), removed)?;
    let steps_of = |seconds: f64| if seconds > 0.0 { ((seconds / scene.time.step).round() as u64).max(1) } else { 0 };
    let parts = Parts::new(&args.output, rank, args.format, setting, steps_of(args.every));
    let signals = together(part.halo(), Signals::watch())?;
    let clocks = Clocks::new(args);
    let mut job = Job { args, scene: &scene, identity, part, parts, clocks, last, signals };
    job.go()?;

    let (summary, hash) = (job.part.summary(), job.part.state_hash());
    let figures = job.clocks.figures(&job.part);
    if rank > 0 {
        return Ok(());
    }
    let ranks = job.part.halo().count();
    if !args.quiet {
        report::print(&summary, hash, ranks, &figures, begin.elapsed());
    }
    report::write(args, &summary, hash, ranks, &figures)
}

/// A run on this rank.
struct Job<'a> {
    args: &'a RunArgs,
    scene: &'a Scene,
    identity: String,
    part: DividedWorld<Ranks>,
    parts: Parts,
    clocks: Clocks,
    /// The last checkpoint.
    last: Option<Manifest>,
    signals: Signals,
}

impl Job<'_> {
    /// Steps until the run is over.
    fn go(&mut self) -> Result<(), Failure> {
        // a run that goes on has written the moment of its checkpoint
        let mut pushed = if self.last.is_none() { self.parts.push(self.part.world()) } else { Ok(()) };
        loop {
            // what was written until the last checkpoint is complete
            together(self.part.halo(), pushed)?;
            let done = self.is_over();
            let due = self.is_first() && self.clocks.checkpoint_is_due();
            let [asked, due] = self.part.halo().any([self.signals.asked(), due]).map(|any| any && !done);
            if done || asked || due {
                together(self.part.halo(), self.parts.complete())?;
            }
            if asked || due {
                self.save()?;
            }
            if asked {
                return Err(Failure::Interrupted);
            }
            if done {
                return Ok(());
            }
            self.step();
            pushed = self.parts.push(self.part.world());
        }
    }

    fn is_first(&self) -> bool {
        self.part.halo().is_first()
    }

    fn is_over(&mut self) -> bool {
        let time = &self.scene.time;
        let limit = self.part.world().time() + 0.5 * time.step >= self.limit();
        limit || (time.until != Until::Limit && self.part.finished())
    }

    /// Returns the simulated time of the latest end, seconds.
    fn limit(&self) -> f64 {
        self.args.time.unwrap_or(self.scene.time.limit)
    }

    fn step(&mut self) {
        self.clocks.step(&mut self.part);
        let steps = self.part.world().steps();
        if self.args.hashes {
            let hash = self.part.state_hash();
            if self.is_first() {
                println!("{steps:8} {hash:016x}");
            }
        }
        if self.args.balance > 0 && steps.is_multiple_of(self.args.balance) {
            self.clocks.balance(&mut self.part);
        }
        let due = self.is_first() && self.clocks.progress_is_due(self.args);
        if self.part.halo().any([due]) == [true] {
            let counts = self.part.counts();
            if self.is_first() {
                self.clocks.show(self.part.world().time(), self.limit(), &counts);
            }
        }
    }

    /// Writes a checkpoint.
    fn save(&mut self) -> Result<(), Failure> {
        let steps = self.part.world().steps();
        let manifest = Manifest {
            version: VERSION.into(),
            scene: self.identity.clone(),
            steps,
            ranks: self.part.halo().count(),
            folder: format!("checkpoint-{steps:010}"),
        };
        let state = self.part.world().save();
        self.last = Some(manifest.write(&self.args.output, self.part.halo(), &state, self.last.as_ref())?);
        self.clocks.checkpoint = Instant::now();
        Ok(())
    }
}

/// The version of the program.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

fn scene(args: &RunArgs) -> Result<Scene, Failure> {
    let mut scene = throng_scene::open(&args.scene)?.scene;
    for (key, value) in &args.set {
        scene.set(key, value)?;
    }
    Ok(scene)
}

/// Returns a hash of the scene and of what changes it.
fn identity(args: &RunArgs, scene: &Scene) -> Result<u64, Failure> {
    let sizes = args.people.iter().map(|path| fs::metadata(path).map_or(0, |file| file.len()));
    Ok(hash(&format!("{}{:?}{:?}", scene.to_toml()?, args.people, sizes.collect::<Vec<_>>())))
}

/// Returns the FNV-1a hash of a text, 64 bits. Source: RFC 9923, section 2.
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// Checks that all ranks have the same program and the same scene.
fn same_everywhere(ranks: &Ranks, identity: u64) -> Result<(), Failure> {
    for (own, what) in [(hash(VERSION), "version of throng-mpi"), (identity, "scene, people or options")] {
        let all = ranks.gather(own);
        if let Some(other) = all.iter().position(|value| *value != all[0]) {
            let text = format!("rank {other} has another {what} than rank 0");
            let same = Failure::hint(text, "start the same program with the same files on all machines");
            return Err(if ranks.is_first() { same } else { Failure::Elsewhere });
        }
    }
    Ok(())
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

/// Returns the world of this rank: with all agents of the scene, or with its share of the people. A run that goes on has the
/// people of its checkpoint.
fn build(args: &RunArgs, scene: &Scene, ranks: &Ranks) -> Result<(World, Built), Failure> {
    if args.people.is_empty() {
        return Ok(scene.build()?);
    }
    let (mut world, built) = scene.build_without_agents()?;
    let Some(group) = built.groups.first() else {
        return Err(Failure::hint("the scene has no group for the people", "add a [[group]] to the scene"));
    };
    if !args.resume {
        People::add(&args.people, scene, group.id, ranks, &mut world)?;
    }
    Ok((world, built))
}

/// Returns the load of a world with all agents.
fn load(world: &World, bounds: [DVec2; 2]) -> Load {
    let [low, high] = bounds.map(|corner| (corner - world.settings().origin).as_vec2());
    let mut load = Load::within(low, high);
    world.relative_columns().position.iter().for_each(|&place| load.add(place, 1));
    load
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
