//! One crowd in several worlds, each in its thread, has the bits of one world.

mod behaviours;
mod common;
mod crowds;
mod cuts;
#[path = "../shared/draw.rs"]
mod draw;
mod features;
#[path = "../shared/irregular.rs"]
mod irregular;
mod parts;
mod refusals;
mod threads;

use std::sync::mpsc;
use std::thread;
use threads::Threads;
use throng::halo::{Cuts, DividedWorld};
use throng::{Counts, Error, Event, EventKind, Summary, World};

/// What is compared of an agent: its number and all that is saved of it.
type AgentBits = (u32, Vec<u8>);

/// What is compared after a step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    agents: Vec<AgentBits>,
    events: Vec<(u64, u32, EventKind)>,
    stranded: Vec<(u32, String)>,
    /// Agents present, arrived and removed; agent-steps, overlaps and standoffs.
    counts: [u64; 6],
}

impl Snapshot {
    fn of(world: &World) -> Self {
        let agents = world.relative_columns();
        let bits = |row: usize| {
            let place = (agents.position[row], agents.velocity[row], agents.heading[row], agents.spin[row]);
            let way = (agents.status[row], &agents.travel[row], agents.progress_mark[row], agents.journey[row]);
            let trip = (agents.entered[row], agents.arrived[row], agents.on_way[row], agents.walked[row]);
            let sums = (agents.turned[row], agents.course_turned[row], agents.shortest[row]);
            let air = (agents.altitude[row], agents.vertical_velocity[row]);
            let given = (agents.radius[row], agents.group[row], agents.user_data[row], agents.max_speed[row]);
            let steered = (agents.attitude[row], agents.memory.of(row), agents.vehicle[row]);
            (agents.number[row], postcard::to_stdvec(&(place, way, trip, sums, (given, air, steered))).unwrap())
        };
        let event = |event: &Event| (event.time.to_bits(), event.number, event.kind);
        let (counts, summary) = (world.counts(), world.summary());
        let counts = [counts.present, counts.arrived, counts.removed].map(|count| count as u64);
        Self {
            agents: (0..agents.len()).map(bits).collect(),
            events: world.events().iter().map(event).collect(),
            stranded: world.stranded().iter().map(|(number, why)| (*number, why.to_string())).collect(),
            counts: [counts[0], counts[1], counts[2], summary.agent_steps, summary.overlaps, summary.standoffs],
        }
    }

    /// Joins the parts of a division.
    fn join(parts: impl IntoIterator<Item = Self>) -> Self {
        let mut all = Self::default();
        for part in parts {
            all.agents.extend(part.agents);
            all.events.extend(part.events);
            all.stranded.extend(part.stranded);
            all.counts.iter_mut().zip(part.counts).for_each(|(sum, count)| *sum += count);
        }
        all.sorted()
    }

    fn sorted(mut self) -> Self {
        self.agents.sort();
        self.events.sort();
        self.stranded.sort();
        self
    }

    /// Returns the first difference, in words.
    fn difference(&self, other: &Self) -> Option<String> {
        let mut pairs = self.agents.iter().zip(&other.agents);
        if let Some((one, two)) = pairs.find(|(one, two)| one != two) {
            let at = one.1.iter().zip(&two.1).position(|(a, b)| a != b);
            return Some(format!("agent {} or {}, byte {at:?}", one.0, two.0));
        }
        let numbers = |all: &Self| all.agents.len();
        (self != other).then(|| {
            format!(
                "{} and {} agents, {:?} and {:?}, {:?} and {:?}, {:?} and {:?}",
                numbers(self),
                numbers(other),
                self.events,
                other.events,
                self.stranded,
                other.stranded,
                self.counts,
                other.counts
            )
        })
    }
}

/// What all worlds of a division agree on.
#[derive(Clone, Debug, PartialEq)]
struct Together {
    hash: u64,
    counts: Counts,
    /// Without the least separation, which a division knows only of agents that could touch.
    summary: Summary,
}

impl Together {
    fn of(world: &World) -> Self {
        let summary = Summary { least_separation: 0.0, ..world.summary() };
        Self { hash: world.state_hash(), counts: world.counts(), summary }
    }

    fn of_division(part: &mut DividedWorld<Threads>) -> Self {
        let summary = Summary { least_separation: 0.0, ..part.summary() };
        Self { hash: part.state_hash(), counts: part.counts(), summary }
    }
}

/// What a division did in a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Work {
    /// Agents that changed their world.
    pub migrants: usize,
    /// Bytes of ghosts and others.
    pub bytes: usize,
}

/// Steps a world and its division side by side, and compares them after every step. `change` may change the cuts after a
/// step, and `each` is called in every world of the division and in the undivided world, with the step.
pub fn compare(
    world: World,
    cuts: impl Fn(u64) -> Cuts + Sync,
    steps: u64,
    change: impl Fn(u64, Part<'_>) + Sync,
) -> Result<Work, String> {
    let whole = world.clone();
    compare_with(whole, cuts, steps, change, |_, halo| DividedWorld::new(world.clone(), halo))
}

/// As [`compare`], with worlds that `begin` returns from their index and their halo.
pub fn compare_with(
    world: World,
    cuts: impl Fn(u64) -> Cuts + Sync,
    steps: u64,
    change: impl Fn(u64, Part<'_>) + Sync,
    begin: impl Fn(usize, Threads) -> Result<DividedWorld<Threads>, Error> + Sync,
) -> Result<Work, String> {
    let worlds = cuts(0).worlds();
    let (send, receive): (Vec<_>, Vec<_>) = (0..worlds).map(|_| mpsc::channel()).unzip();
    thread::scope(|scope| {
        let mut handles = Vec::new();
        for (index, (halo, send)) in threads::halos(cuts(0)).into_iter().zip(send).enumerate() {
            let (begin, cuts, change) = (&begin, &cuts, &change);
            handles.push(scope.spawn(move || {
                let mut part = begin(index, halo).map_err(|error| error.to_string())?;
                let mut migrants = 0;
                for step in 0..steps {
                    change(step, Part::Divided(&mut part));
                    part.halo_mut().set(cuts(step));
                    let before: Vec<u32> = part.world().relative_columns().number.clone();
                    part.step();
                    let entered = part.world().events().iter().filter(|event| event.kind == EventKind::Entered);
                    let entered: Vec<u32> = entered.map(|event| event.number).collect();
                    let now = &part.world().relative_columns().number;
                    migrants +=
                        now.iter().filter(|number| !before.contains(number) && !entered.contains(number)).count();
                    let together = Together::of_division(&mut part);
                    if send.send((Snapshot::of(part.world()), together)).is_err() {
                        break;
                    }
                }
                Ok::<Work, String>(Work { migrants, bytes: part.halo().bytes })
            }));
        }
        let mut whole = world;
        let mut differs = None;
        for step in 0..steps {
            change(step, Part::Whole(&mut whole));
            whole.step();
            let parts: Result<Vec<_>, _> = receive.iter().map(|receive| receive.recv()).collect();
            let Ok(parts) = parts else { break };
            let (parts, together): (Vec<Snapshot>, Vec<Together>) = parts.into_iter().unzip();
            let of_whole = Together::of(&whole);
            let why = Snapshot::of(&whole).sorted().difference(&Snapshot::join(parts)).or_else(|| {
                let other = together.iter().find(|together| **together != of_whole)?;
                Some(format!("{of_whole:?} and {other:?}"))
            });
            if let Some(why) = why {
                differs = Some(format!("{worlds} worlds differ after step {step}: {why}"));
                break;
            }
        }
        drop(receive);
        let mut work = Work::default();
        for handle in handles {
            // the other worlds end when one of them ends early
            match handle.join() {
                Ok(part) => {
                    let part = part?;
                    work.migrants += part.migrants;
                    work.bytes += part.bytes;
                }
                Err(_) if differs.is_some() => {}
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        differs.map_or(Ok(work), Err)
    })
}

/// A world that steps.
pub enum Part<'a> {
    /// The undivided world.
    Whole(&'a mut World),
    /// A world of the division.
    Divided(&'a mut DividedWorld<Threads>),
}
