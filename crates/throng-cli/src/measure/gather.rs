//! What is measured, from a scene that runs or from a file.

use super::args::MeasureArgs;
use super::{Measured, Subject, people};
use crate::failure::Failure;
use crate::files::title;
use crate::out::note;
use crate::progress::{Progress, share};
use crate::source::Loaded;
use crate::{interrupt, threads};
use throng_record::swarm::Swarm;
use throng_record::{Frame, Spot, Tracks, moment};

/// What was measured; of its groups those of which somebody was there.
///
/// # Errors
/// It cannot be read or built, or has no such group.
pub fn gather(args: &MeasureArgs) -> Result<Subject, Failure> {
    let mut subject = if Tracks::are_in(&args.of) && !args.of.is_dir() {
        let changes = &args.changes;
        if changes.seed.is_some() || !changes.set.is_empty() || changes.exit.is_some() || changes.people.is_some() {
            let text = format!("{}: what is recorded cannot be changed", args.of.display());
            return Err(Failure::hint(text, "leave out --seed, --set, --exit and --people"));
        }
        recorded(args)?
    } else {
        people::not_of_scenes(args)?;
        let loaded = args.changes.load(&args.of)?;
        if !args.quiet {
            note(&loaded.notes);
        }
        let groups = threads::with(args.threads.count(), || simulated(args, &loaded))?;
        Subject { title: loaded.name.clone(), name: loaded.name, groups, people: None }
    };
    subject.groups.retain(|group| group.swarm.moments().iter().any(|moment| moment.count > 0));
    Ok(subject)
}

fn simulated(args: &MeasureArgs, loaded: &Loaded) -> Result<Vec<Measured>, Failure> {
    let (mut world, built) = loaded.build()?;
    if !args.quiet {
        note(&built.notes);
    }
    let scene = &loaded.scene;
    let names: Vec<String> = built.groups[..scene.groups.len()].iter().map(|group| group.name.clone()).collect();
    let chosen = chosen(args, &names)?;
    let mut groups: Vec<Measured> = chosen.iter().map(|&k| begin(args, &names[k])).collect();
    let progress = Progress::new(args.quiet);
    let mut frame = Frame::default();
    // half a step, so that rounding leaves out nothing
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
        progress.show(share(&world, to.min(scene.time.limit)), || format!("{time:.1} s"));
    }
    progress.done();
    Ok(groups)
}

fn recorded(args: &MeasureArgs) -> Result<Subject, Failure> {
    let tracks = args.tracks.read(&args.of)?;
    if !args.quiet {
        note(&tracks.notes);
    }
    let chosen = chosen(args, &tracks.setting.groups)?;
    // a little more, so that rounding leaves out nothing
    let within = args.from - 1e-9..=args.to.unwrap_or(f64::INFINITY) + 1e-9;
    let measured = |&k: &usize| {
        let mut group = begin(args, &tracks.setting.groups[k]);
        let moments = tracks.moments(k as u32).filter(|(time, _)| within.contains(time));
        moments.for_each(|(time, places)| group.swarm.push(time, &places));
        group
    };
    let counts = |spot: &Spot| within.contains(&spot.time) && chosen.contains(&(spot.group as usize));
    let groups = chosen.iter().map(measured).collect();
    let people = people::of(args, &tracks, counts)?;
    Ok(Subject { name: args.of.display().to_string(), title: title(&args.of), groups, people })
}

fn begin(args: &MeasureArgs, name: &str) -> Measured {
    Measured { name: name.to_owned(), swarm: Swarm::new(args.lag) }
}

/// The groups that are asked for, by index.
fn chosen(args: &MeasureArgs, names: &[String]) -> Result<Vec<usize>, Failure> {
    let Some(name) = &args.group else { return Ok((0..names.len()).collect()) };
    let found: Vec<usize> = (0..names.len()).filter(|&k| names[k] == *name).collect();
    if found.is_empty() {
        let text = format!("--group {name}: there is no group `{name}` in {}", args.of.display());
        return Err(Failure::hint(text, format!("there is: {}", names.join(", "))));
    }
    Ok(found)
}
