//! Replay of files that `throng run` wrote.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use throng_draw::Style;
use throng_draw::record::Recorder;
use throng_record::csv::CsvWriter;
use throng_record::{Choice, Frame, Writer, moment};
use throng_scene::gallery;
use throng_studio::play::{Command, Engine, Film, Quantity, RunMoment, Speed, ThreadedEngine, Trouble};
use throng_studio::record::{Job, Subject, Take, Which};

/// Writes the trajectories of a scene and returns its frames.
fn written(name: &str, path: &Path) -> Vec<Frame> {
    let scene = gallery::scene(name).unwrap();
    let (mut world, built) = scene.build().unwrap();
    let mut writer = CsvWriter::create(path, &moment::setting(&world, &built, "")).unwrap();
    let mut frames = Vec::new();
    loop {
        let mut frame = Frame::default();
        moment::capture(&world, &mut frame);
        writer.push(&frame).unwrap();
        frames.push(frame);
        if scene.time.over(&world) {
            writer.finish().unwrap();
            return frames;
        }
        world.step();
    }
}

fn settle(engine: &mut Engine) -> Arc<RunMoment> {
    while engine.idle().is_some() {
        engine.work(Duration::from_millis(50));
    }
    engine.work(Duration::from_millis(50));
    engine.shown().unwrap()
}

/// Returns a trajectory file with a scene of the gallery as its surroundings.
fn film(path: &Path, scene: &str) -> Film {
    let place = (scene.into(), Arc::new(gallery::scene(scene).unwrap()));
    Film { path: path.into(), bytes: None, place: Some(place) }
}

fn replay(path: &Path, scene: &str) -> Engine {
    let mut engine = Engine::default();
    engine.command(Command::Replay { film: film(path, scene), run: false });
    assert_eq!(engine.trouble(), None);
    engine
}

/// Arrivals are shown if the file has them: by a column, or by agents that leave.
#[test]
fn arrivals_are_those_of_the_file() {
    use egui_kittest::kittest::Queryable;
    let folder = tempfile::tempdir().unwrap();
    let rows = |last: [usize; 2]| -> String {
        let row = |k: usize, number: usize| format!("{number},{:.1},{k},0\n", k as f64 * 0.1);
        (0..10).flat_map(|k| (0..2).filter(move |&of| k <= last[of]).map(move |of| row(k, of))).collect()
    };
    for (name, last, says) in [("stay", [9, 9], "–"), ("leave", [9, 5], "1 of 2")] {
        let path = folder.path().join(format!("{name}.csv"));
        std::fs::write(&path, format!("number,time,x,y\n{}", rows(last))).unwrap();
        let mut engine = Engine::default();
        engine.command(Command::Replay { film: Film { path, bytes: None, place: None }, run: false });
        engine.command(Command::Seek(9));
        let shown = settle(&mut engine);
        let harness = egui_kittest::Harness::new_ui(|ui| throng_studio::panels::summary(ui, &shown));
        assert!(harness.query_by_label(says).is_some(), "{name}");
        let mut meters = throng_studio::panels::Meters::default();
        let harness = egui_kittest::Harness::builder()
            .with_size([400.0, 1200.0])
            .build_ui(|ui| _ = throng_studio::panels::plots(ui, &shown, &mut meters));
        let plotted = harness.query_all_by_label_contains("arrived").next().is_some();
        assert_eq!(plotted, name == "leave");
    }
}

#[test]
fn every_moment_is_as_it_was_whichever_way_one_gets_to_it() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["circle", "bottleneck", "boids"] {
        let path = folder.path().join(format!("{name}.csv"));
        let mut frames = written(name, &path);
        // the file has no moments without agents
        frames.retain(|frame| !frame.bodies.is_empty());
        let mut engine = replay(&path, name);
        let last = frames.len() - 1;
        for step in [0, 40, 39, last, 7, 8, last / 2] {
            engine.command(Command::Seek(step as u64));
            let shown = settle(&mut engine);
            assert_eq!(shown.step, step as u64, "{name}");
            let (found, want) = (&shown.frame, &frames[step]);
            assert_eq!(
                (found.time, found.arrived, found.bodies.len()),
                (want.time, want.arrived, want.bodies.len()),
                "{name} at {step}"
            );
            for (found, want) in found.bodies.iter().zip(&want.bodies) {
                assert_eq!((found.number, found.group, found.status), (want.number, want.group, want.status));
                assert_eq!(
                    (found.center(), found.velocity, found.heading),
                    (want.center(), want.velocity, want.heading)
                );
                assert_eq!(found.shape().clearance_radius(), want.shape().clearance_radius());
            }
        }
        engine.command(Command::Step);
        assert_eq!(settle(&mut engine).step, last as u64 / 2 + 1);
        engine.command(Command::Back);
        assert_eq!(settle(&mut engine).step, last as u64 / 2);
        engine.command(Command::Restart);
        assert_eq!(settle(&mut engine).step, 0);
    }
}

#[test]
fn it_plays_to_its_end_and_figures_are_measured() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("circle-2.csv");
    let frames = written("circle", &path);
    let mut engine = replay(&path, "circle");
    let shown = engine.shown().unwrap();
    assert_eq!(shown.setting.goals.len(), 36, "the surroundings are those of the gallery's scene");
    assert_eq!(shown.setting.title, "Ring of 36");
    engine.command(Command::Speed(Speed::Fastest));
    engine.command(Command::Run);
    let shown = settle(&mut engine);
    assert_eq!((shown.step as usize, shown.over, shown.playing), (frames.len() - 1, true, false));
    assert_eq!((shown.frame.arrived, shown.summary.arrived, shown.summary.agents), (36, 36, 36));
    let arrived = Quantity::ALL.iter().position(|&quantity| quantity == Quantity::Arrived).unwrap();
    for sample in shown.series.samples() {
        assert_eq!(sample.values[arrived] as usize, frames[sample.step as usize].arrived);
    }
    assert!(shown.series.samples().len() > 20);
    engine.command(Command::Seek(1 << 40));
    assert_eq!(settle(&mut engine).step as usize, frames.len() - 1, "the last moment is the end");
    engine.command(Command::Run);
    assert_eq!(settle(&mut engine).run, shown.run + 1, "the replay starts again");
}

#[test]
fn a_table_of_another_program_is_replayed_without_a_place() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("circle.csv");
    std::fs::write(&path, "time,number,x,y\n0,5,400000,1\n0.1,5,400000.2,1\n0.2,5,400000.4,1\n0.2,9,400003,7\n")
        .unwrap();
    let mut engine = replay(&path, "circle");
    engine.command(Command::Seek(2));
    let shown = settle(&mut engine);
    assert!(shown.setting.goals.is_empty() && shown.setting.walkable.is_empty(), "the groups differ");
    let bodies: Vec<_> =
        shown.frame.bodies.iter().map(|body| (body.number, body.position.x, body.velocity.x)).collect();
    assert_eq!(bodies.len(), 2);
    assert_eq!((bodies[0].0, bodies[0].1, bodies[1].0), (5, 400_000.4, 9));
    assert!((bodies[0].2 - 2.0).abs() < 1e-3, "two tenths of a metre in a tenth of a second");
    assert!((shown.scene.time.step - 0.1).abs() < 1e-9);
    assert!(shown.bounds.min.x < 400_000.0 && shown.bounds.max.x > 400_003.0);
}

#[test]
fn what_is_no_film_is_told_with_its_line_and_what_was_there_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.csv");
    let mut engine = Engine::default();
    let scene = Arc::new(gallery::scene("headon").unwrap());
    engine.command(Command::Load { name: "headon".into(), scene, run: false });
    let mut wrong = |text: Option<&str>| {
        text.into_iter().for_each(|text| std::fs::write(&path, text).unwrap());
        let path = text.map_or(PathBuf::from("no.csv"), |_| path.clone());
        engine.command(Command::Replay { film: Film { path, ..Film::default() }, run: true });
        let Some(Trouble::Film(says)) = engine.trouble() else { panic!("{:?}", engine.trouble()) };
        assert_eq!(&*settle(&mut engine).name, "headon");
        says
    };
    assert!(wrong(Some("number,time,x,y\n1,0,0,0\n1,0.1,zero,0\n")).contains("a.csv:3: `zero` is no number for x"));
    assert!(wrong(Some("a,b\n")).contains("a.csv:1: there is no column `number`"));
    assert!(wrong(Some("number,time,x,y\n")).contains("the file has no agents"));
    assert!(wrong(None).contains("cannot read no.csv"));
}

#[test]
fn a_recording_of_a_replay_is_the_file_itself() {
    let folder = tempfile::tempdir().unwrap();
    let (path, again) = (folder.path().join("circle.csv"), folder.path().join("again.csv"));
    written("circle", &path);
    let mut player = ThreadedEngine::start(|| {}).unwrap();
    player.command(Command::Replay { film: film(&path, "circle"), run: false });
    let shown = loop {
        match player.shown() {
            Some(shown) => break shown,
            None => std::thread::sleep(Duration::from_millis(2)),
        }
    };
    let take =
        Take { path: again.clone(), choice: Choice::default(), rate: 25.0, speed_up: 1.0, style: Style::default() };
    let mut job = Job::new(&Subject::of(&shown, Which::Both), &take, |path, plan| {
        Recorder::create(path, plan).map_err(|error| error.to_string())
    })
    .unwrap();
    while !job.work(Duration::from_millis(50)).unwrap() {}
    assert!(std::fs::read(&path).unwrap() == std::fs::read(&again).unwrap());
}
