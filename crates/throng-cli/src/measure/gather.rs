//! Measures a running scene or a file of trajectories.

use super::args::MeasureArgs;
use super::{Measured, MeasuredSubject, people};
use crate::failure::Failure;
use crate::files::title;
use crate::out::note;
use crate::progress::{Progress, share, waiting};
use crate::source::Loaded;
use crate::{interrupt, threads};
use std::path::Path;
use throng_record::swarm::Swarm;
use throng_record::{Frame, Sample, Trajectories, moment};

/// Measures a scene or a file. Groups without agents in the measured time are left out.
///
/// # Errors
/// The scene or file cannot be read or built, or does not have the given group.
pub fn gather(args: &MeasureArgs) -> Result<MeasuredSubject, Failure> {
    let mut subject = if Trajectories::are_in(&args.of) && !args.of.is_dir() {
        let changes = &args.changes;
        if changes.seed.is_some() || !changes.set.is_empty() || changes.exit.is_some() || changes.people.is_some() {
            let text = format!("{}: a recording cannot be changed", args.of.display());
            return Err(Failure::hint(text, "leave out --seed, --set, --exit and --people"));
        }
        recorded(args)?
    } else {
        people::not_of_scenes(args)?;
        let loaded = args.changes.load(&args.of)?;
        if !args.report.quiet {
            note(&loaded.notes);
        }
        let groups = threads::with(args.threads.count(), || simulated(args, &loaded))?;
        MeasuredSubject { title: loaded.name.clone(), name: loaded.name, groups, beside: None, people: None }
    };
    subject.beside = args.beside.as_ref().map(|path| beside(args, path)).transpose()?;
    subject.groups.retain(|group| group.swarm.moments().iter().any(|moment| moment.count > 0));
    Ok(subject)
}

fn simulated(args: &MeasureArgs, loaded: &Loaded) -> Result<Vec<Measured>, Failure> {
    let (mut world, built) = loaded.build(args.report.quiet)?;
    interrupt::watch();
    if !args.report.quiet {
        note(&built.notes);
    }
    let scene = &loaded.scene;
    let names: Vec<String> = built.groups[..scene.groups.len()].iter().map(|group| group.name.clone()).collect();
    let chosen = chosen(args, &names)?;
    let mut groups: Vec<Measured> = chosen.iter().map(|&k| begin(args, &names[k])).collect();
    let progress = Progress::new(args.report.quiet);
    let mut frame = Frame::default();
    // Half a step of tolerance keeps rounding from leaving out a moment.
    let (half, to) = (0.5 * scene.time.step, args.to.unwrap_or(f64::INFINITY));
    loop {
        let time = world.time();
        if time >= args.from - half {
            moment::capture(&world, &mut frame);
            for (&k, group) in chosen.iter().zip(&mut groups) {
                group.swarm.push_frame(&frame, k as u32);
            }
        }
        let over = if args.to.is_some() { time + half >= to } else { scene.time.over(&world) };
        if over || interrupt::asked() {
            break;
        }
        world.step();
        if progress.is_due() {
            progress.show(share(&world, to.min(scene.time.limit)), || format!("{time:.1} s"));
        }
    }
    progress.done();
    Ok(groups)
}

fn recorded(args: &MeasureArgs) -> Result<MeasuredSubject, Failure> {
    let tracks = args.tracks.read(&args.of, args.report.quiet)?;
    if !args.report.quiet {
        note(&tracks.notes);
    }
    let chosen = chosen(args, &tracks.setting.groups)?;
    // A small tolerance keeps rounding from leaving out a moment.
    let within = args.from - 1e-9..=args.to.unwrap_or(f64::INFINITY) + 1e-9;
    let measured = |&k: &usize| {
        let mut group = begin(args, &tracks.setting.groups[k]);
        let moments = tracks.moments(k as u32).filter(|(time, _)| within.contains(time));
        moments.for_each(|(time, places)| group.swarm.push(time, &places));
        group
    };
    let counts = |spot: &Sample| within.contains(&spot.time) && chosen.contains(&(spot.group as usize));
    let (groups, people) = waiting(args.report.quiet, "measuring", || {
        (chosen.iter().map(measured).collect(), people::of(args, &tracks, counts))
    });
    let people = people?;
    Ok(MeasuredSubject { name: args.of.display().to_string(), title: title(&args.of), groups, beside: None, people })
}

/// Measures a file to compare with: all of its groups together.
fn beside(args: &MeasureArgs, path: &Path) -> Result<Measured, Failure> {
    let tracks = args.tracks.read(path, args.report.quiet)?;
    let mut measured = begin(args, &title(path));
    for spots in tracks.spots.chunk_by(|a, b| a.time == b.time) {
        let places: Vec<_> = spots.iter().map(|spot| (spot.number, spot.place)).collect();
        measured.swarm.push(spots[0].time, &places);
    }
    if measured.swarm.moments().is_empty() {
        let text = format!("--beside {}: it has no agents", path.display());
        return Err(Failure::hint(text, "give a file with trajectories"));
    }
    Ok(measured)
}

fn begin(args: &MeasureArgs, name: &str) -> Measured {
    Measured { name: name.to_owned(), swarm: Swarm::new(args.lag) }
}

/// Returns the indices of the groups to measure.
fn chosen(args: &MeasureArgs, names: &[String]) -> Result<Vec<usize>, Failure> {
    let Some(name) = &args.group else { return Ok((0..names.len()).collect()) };
    let found: Vec<usize> = (0..names.len()).filter(|&k| names[k] == *name).collect();
    if found.is_empty() {
        let text = format!("--group {name}: there is no group `{name}` in {}", args.of.display());
        return Err(Failure::hint(text, format!("the groups are: {}", names.join(", "))));
    }
    Ok(found)
}
