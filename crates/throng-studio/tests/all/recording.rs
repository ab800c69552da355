//! Recording: the output equals that of `throng run`.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;
use throng_draw::record::{Plan, Recorder};
use throng_draw::{Film, Sheet, Style};
use throng_record::csv::CsvWriter;
use throng_record::{Choice, Column, Frame, Output, Setting, Writer, moment};
use throng_scene::gallery;
use throng_studio::record::{Format, Job, Subject, Take, ThreadedJob};

fn begin(path: &Path, plan: &Plan) -> Result<Recorder, String> {
    Recorder::create(path, plan).map_err(|error| error.to_string())
}

/// Creates an output as in a web page, but writes it to a folder.
fn handed(path: &Path, plan: &Plan) -> Result<Recorder, String> {
    let output = Output::handed(path, |path, bytes| std::fs::write(path, bytes));
    Recorder::to(output, plan).map_err(|error| error.to_string())
}

fn subject(name: &str) -> Subject {
    Subject::Scene(name.into(), Arc::new(gallery::scene(name).unwrap()))
}

fn take(path: &Path) -> Take {
    let style = Style { width: 64, height: 48, ..Style::default() };
    Take { path: path.into(), choice: Choice::default(), rate: 10.0, speed_up: 1.0, style }
}

fn record(subject: &Subject, take: &Take) -> Result<(), String> {
    let mut job = Job::new(subject, take, begin)?;
    while !job.work(Duration::from_millis(20))? {}
    Ok(())
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Visits every moment of a scene, computed by the engine alone.
fn moments(name: &str, mut see: impl FnMut(&Setting, &Frame)) {
    let scene = gallery::scene(name).unwrap();
    let (mut world, built) = scene.build().unwrap();
    let setting = moment::setting(&world, &built, &scene.title);
    let mut frame = Frame::default();
    moment::capture(&world, &mut frame);
    see(&setting, &frame);
    while !scene.time.over(&world) {
        world.step();
        moment::capture(&world, &mut frame);
        see(&setting, &frame);
    }
}

#[test]
fn trajectories_are_those_of_the_scene_to_the_byte() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["circle", "boids"] {
        let (path, expected) = (folder.path().join("a.csv"), folder.path().join("b.csv"));
        record(&subject(name), &take(&path)).unwrap();
        let mut writer = None;
        moments(name, |setting, frame| {
            let writer = writer.get_or_insert_with(|| CsvWriter::create(&expected, setting).unwrap());
            writer.push(frame).unwrap();
        });
        writer.unwrap().finish().unwrap();
        assert!(std::fs::read(&path).unwrap() == std::fs::read(&expected).unwrap(), "{name}");
    }
}

/// Each file that the studio offers for a purpose can be read again, with all agents.
#[test]
fn files_for_every_purpose_are_read_again() {
    let folder = tempfile::tempdir().unwrap();
    let files = throng_studio::panels::purposes().filter(|purpose| purpose.format == Format::Trajectories);
    let mut count = 0;
    for purpose in files {
        // a .bvh holds one person
        let agents = if purpose.ending.contains('*') { 1 } else { 36 };
        let path = folder.path().join(format!("circle{}", purpose.ending));
        let mut take = take(&path);
        take.choice.to = 1.0;
        if agents == 1 {
            take.choice.agents = vec![3..=3];
        }
        record(&subject("circle"), &take).unwrap_or_else(|error| panic!("{}: {error}", purpose.title));
        let path = folder.path().join(format!("circle{}", purpose.ending.replace('*', "3")));
        count += 1;
        if agents == 1 {
            // throng writes this kind, and does not read it
            let text = std::fs::read_to_string(&path).unwrap();
            assert!(text.starts_with("HIERARCHY") && text.contains("\nMOTION\n"));
            continue;
        }
        let read =
            throng_record::Trajectories::read(&path).unwrap_or_else(|error| panic!("{}: {error}", purpose.title));
        let numbers: BTreeSet<u32> = read.spots.iter().map(|spot| spot.number).collect();
        assert_eq!(numbers.len(), agents, "{}", purpose.title);
    }
    assert_eq!(count, 7);
}

#[test]
fn a_film_is_that_of_its_moments() {
    let folder = tempfile::tempdir().unwrap();
    let (path, expected) = (folder.path().join("a.gif"), folder.path().join("b.gif"));
    let mut take = take(&path);
    (take.rate, take.choice.to) = (12.5, 1.0);
    record(&subject("circle"), &take).unwrap();
    let mut film = None;
    // a picture every second step of 0.04 s
    moments("circle", |setting, frame| {
        let film = film.get_or_insert_with(|| Film::create(&expected, setting, &take.style, take.rate).unwrap());
        let step = (frame.time / 0.04).round() as u64;
        if step.is_multiple_of(2) && step < 25 || step == 25 {
            film.push(frame).unwrap();
        }
    });
    film.unwrap().finish().unwrap();
    let bytes = std::fs::read(&path).unwrap();
    assert!(bytes == std::fs::read(&expected).unwrap());
    let in_memory = folder.path().join("c.gif");
    let mut job = Job::new(&subject("circle"), &Take { path: in_memory.clone(), ..take }, handed).unwrap();
    while !job.work(Duration::from_millis(5)).unwrap() {
        assert!(!in_memory.exists());
    }
    assert!(std::fs::read(&in_memory).unwrap() == bytes, "the output in a page is equal");
}

#[test]
fn a_part_of_a_scene_is_what_was_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("part.csv");
    let part = Take { choice: Choice { from: 2.0, to: 3.0, ..Choice::default() }, ..take(&path) };
    record(&subject("circle"), &part).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let times: Vec<f64> = text.lines().skip(1).map(|line| line.split(',').nth(2).unwrap().parse().unwrap()).collect();
    assert!((times[0] - 2.0).abs() < 1e-9 && (times[times.len() - 1] - 3.0).abs() < 1e-9);
    assert_eq!(times.len(), 26 * 36);

    let pictures = folder.path().join("pictures/");
    let part = Take { path: pictures.clone(), ..part };
    record(&subject("circle"), &part).unwrap();
    // at 2.0, 2.1 .. 3.0 s
    assert_eq!(names(&pictures).len(), 11);

    let late = Choice { from: 1e4, ..Choice::default() };
    let after = Take { path: folder.path().join("after.csv"), choice: late, ..take(&path) };
    let says = record(&subject("circle"), &after).unwrap_err();
    assert!(says.contains("before the recording begins"), "{says}");
    assert_eq!(names(folder.path()), ["part.csv", "pictures"]);
}

/// The chosen part is written as if the engine's moments were pushed to the writer.
#[test]
fn trajectories_have_what_is_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let expected = folder.path().join("expected.csv");
    let some = Choice {
        from: 0.53,
        to: 2.2,
        rate: Some(3.0),
        agents: vec![2..=5, 9..=9],
        columns: vec![Column::Time, Column::Number, Column::X],
        ..Choice::default()
    };
    let format = throng_record::Format::of("a.csv").unwrap();
    for choice in [some, Choice { from: 1.0, ..Choice::default() }] {
        let mut writer = None;
        moments("circle", |setting, frame| {
            if choice.rate.is_some() || frame.time > choice.from - 1e-6 {
                let writer = writer.get_or_insert_with(|| {
                    choice.create(format, Output::create(&expected).unwrap(), setting, || false).unwrap().unwrap()
                });
                writer.push(frame).unwrap();
            }
        });
        writer.unwrap().finish().unwrap();
        let path = folder.path().join("part.csv");
        record(&subject("circle"), &Take { choice, ..take(&path) }).unwrap();
        let [part, expected] = [&path, &expected].map(|path| std::fs::read_to_string(path).unwrap());
        assert!(part.lines().count() > 20 && part == expected, "{part}");
        std::fs::remove_file(path).unwrap();
    }
    let missing = Choice { groups: vec!["up".into()], ..Choice::default() };
    let says = record(&subject("doorway"), &Take { choice: missing, ..take(&folder.path().join("b.csv")) });
    assert!(says.unwrap_err().contains("there is no group `up`"));
}

#[test]
fn two_models_are_recorded_side_by_side() {
    let folder = tempfile::tempdir().unwrap();
    let (path, expected) = (folder.path().join("a.gif"), folder.path().join("b.gif"));
    let scene = gallery::scene("circle").unwrap();
    let other = scene.with_model(&"rvo".parse().unwrap()).unwrap();
    let both = [("orca".to_owned(), Arc::new(scene.clone())), ("rvo".to_owned(), Arc::new(other.clone()))];
    let subject = Subject::Beside("circle".into(), both);
    let take = Take { choice: Choice { to: 0.6, ..Choice::default() }, rate: 25.0, ..take(&path) };
    record(&subject, &take).unwrap();
    let mut runs: Vec<_> = [&scene, &other].map(|scene| scene.build().unwrap()).into_iter().collect();
    let settings = runs.iter().map(|(world, built)| moment::setting(world, built, &scene.title));
    let panels = settings.zip(["orca", "rvo"]).map(|(setting, name)| Setting { title: name.into(), ..setting });
    let sheet = Sheet { title: scene.title.clone(), panels: panels.collect(), columns: 2 };
    let mut film = Film::create(&expected, sheet, &take.style, take.rate).unwrap();
    // a picture every step of 0.04 s
    for step in 0..=15 {
        let mut frames = vec![Frame::default(); 2];
        runs.iter().zip(&mut frames).for_each(|((world, _), frame)| moment::capture(world, frame));
        film.push_all(&frames.iter().collect::<Vec<_>>()).unwrap();
        assert!(step == 0 || frames[0] != frames[1]);
        runs.iter_mut().for_each(|(world, _)| world.step());
    }
    film.finish().unwrap();
    assert!(std::fs::read(&path).unwrap() == std::fs::read(&expected).unwrap());
    // a trajectory file holds the first run
    let [table, alone] = ["a.csv", "b.csv"].map(|name| folder.path().join(name));
    record(&subject, &Take { path: table.clone(), ..take.clone() }).unwrap();
    record(&Subject::Scene("circle".into(), Arc::new(scene)), &Take { path: alone.clone(), ..take }).unwrap();
    assert!(std::fs::read(table).unwrap() == std::fs::read(alone).unwrap());
}

#[test]
fn what_is_cancelled_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.mp4", "a.gif", "a.csv", "pictures/"] {
        let mut job = Job::new(&subject("circle"), &take(&folder.path().join(name)), begin).unwrap();
        // short slices: no machine is fast enough to finish in them
        (0..5).for_each(|_| assert!(!job.work(Duration::from_micros(20)).unwrap()));
        assert!(job.share() > 0.0 && job.share() < 1.0);
        drop(job);
        assert_eq!(names(folder.path()), Vec::<String>::new(), "{name}");
    }
    let thread = ThreadedJob::start(subject("boids"), take(&folder.path().join("b.csv")), begin, || {}).unwrap();
    drop(thread);
    assert_eq!(names(folder.path()), Vec::<String>::new());
}

#[test]
fn what_is_finished_early_is_the_first_part() {
    let folder = tempfile::tempdir().unwrap();
    let (path, whole) = (folder.path().join("part.csv"), folder.path().join("whole.csv"));
    let mut job = Job::new(&subject("circle"), &take(&path), begin).unwrap();
    while job.share() < 0.02 {
        assert!(!job.work(Duration::from_micros(20)).unwrap());
    }
    job.finish().unwrap();
    assert!(job.work(Duration::from_millis(1)).unwrap());
    record(&subject("circle"), &take(&whole)).unwrap();
    let [part, whole] = [path, whole].map(|path| std::fs::read_to_string(path).unwrap());
    assert!(part.lines().count() > 36 && part.len() < whole.len() && whole.starts_with(&part));
    let late = take(&folder.path().join("late.csv"));
    let mut job =
        Job::new(&subject("circle"), &Take { choice: Choice { from: 1e3, ..Choice::default() }, ..late }, begin)
            .unwrap();
    assert!(job.finish().is_err());
    drop(job);
    assert_eq!(names(folder.path()), ["part.csv", "whole.csv"]);
}

#[test]
fn a_thread_records_and_says_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    let wait = |mut thread: ThreadedJob| loop {
        match thread.done() {
            Ok(false) => std::thread::sleep(Duration::from_millis(5)),
            other => return other,
        }
    };
    let start = |path: &Path| wait(ThreadedJob::start(subject("headon"), take(path), begin, || {}).unwrap());
    assert_eq!(start(&path), Ok(true));
    let there = std::fs::read(&path).unwrap();
    record(&subject("headon"), &take(&path)).unwrap();
    assert!(std::fs::read(&path).unwrap() == there);
    let missing = start(&folder.path().join("nowhere/a.mp4")).unwrap_err();
    assert!(missing.contains("there is no folder"), "{missing}");
    let unknown = Format::of(Path::new("a.xyz")).unwrap_err();
    assert!(unknown.contains("a.xyz") && unknown.contains(".csv"), "{unknown}");
    assert_eq!(Format::of(Path::new("A.CSV")), Ok(Format::Trajectories));
}
