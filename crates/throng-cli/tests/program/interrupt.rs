//! Ctrl-C ends a run cleanly.

use crate::shared::{call, folder, names, stderr};
use serde_json::Value;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Interrupts the program with these arguments once `begun` returns true. Returns its output as JSON.
fn interrupted(folder: &Path, arguments: &str, begun: impl Fn() -> bool) -> Value {
    serde_json::from_slice(&output(folder, arguments, begun).stdout).unwrap()
}

/// Interrupts the program with these arguments once `begun` returns true. Returns its output.
fn output(folder: &Path, arguments: &str, begun: impl Fn() -> bool) -> Output {
    let child = Command::new(env!("CARGO_BIN_EXE_throng"))
        .current_dir(folder)
        .args(arguments.split_whitespace())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begin = Instant::now();
    while !begun() {
        assert!(begin.elapsed() < Duration::from_secs(20), "the run does not begin");
        std::thread::sleep(Duration::from_millis(10));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{output:?}");
    output
}

#[test]
fn an_interrupted_comparison_finishes_its_files() {
    let folder = folder();
    let files = "-o a/ -o a.mp4 -o a.html -o a.csv --size 320x240";
    let arguments = format!("compare circle -m vo,orca --seeds 1..3 {files} --json --duration 100000");
    let all = interrupted(folder.path(), &arguments, || folder.path().join("a/frame_000009.png").exists());
    assert_eq!(names(folder.path()), ["a", "a.csv", "a.html", "a.mp4"]);
    assert_eq!(all["interrupted"], true);
    for model in all["models"].as_array().unwrap() {
        let runs = model["runs"].as_array().unwrap();
        assert_eq!((runs.len(), &runs[0]["seed"], &runs[0]["interrupted"]), (1, &Value::from(1), &Value::from(true)));
    }
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(read("a.csv").lines().count(), 3);
    let page = read("a.html");
    assert!(page.contains("Interrupted: figures cover the time until then.") && page.ends_with("</html>\n"));
}

#[test]
fn an_interrupted_run_finishes_its_files() {
    let folder = folder();
    let files = "-o a.mp4 -o a.csv --size 160x120";
    // Files grow under other names until they are complete.
    let grown = |entry: std::fs::DirEntry| entry.metadata().is_ok_and(|m| m.len() > 50_000);
    let begun = || std::fs::read_dir(folder.path()).unwrap().flatten().any(grown);
    let report = interrupted(folder.path(), &format!("run circle {files} --json --duration 100000"), begun);
    assert_eq!(names(folder.path()), ["a.csv", "a.mp4"]);
    assert_eq!(report["interrupted"], true);
    let steps = report["steps"].as_u64().unwrap();
    let table = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    assert!(table.ends_with('\n'));
    assert_eq!(table.lines().count() as u64, 1 + (steps + 1) * 36, "all agents at every step");
    let video = std::fs::read(folder.path().join("a.mp4")).unwrap();
    assert!(holds(&video, b"moov") && holds(&video, b"mdat"), "the video has its index");
}

/// Starts an endless run that writes a file, and waits until the folder holds a part of it.
#[cfg(unix)]
fn endless(folder: &Path, file: &str) -> Child {
    let child = Command::new(env!("CARGO_BIN_EXE_throng"))
        .current_dir(folder)
        .args(format!("run circle -o {file} -q --duration 100000").split_whitespace())
        .spawn()
        .unwrap();
    let begin = Instant::now();
    let grown = |entry: std::fs::DirEntry| entry.metadata().is_ok_and(|file| file.len() > 100_000);
    while !std::fs::read_dir(folder).unwrap().flatten().any(grown) {
        assert!(begin.elapsed() < Duration::from_secs(20), "the run does not begin");
        std::thread::sleep(Duration::from_millis(10));
    }
    child
}

/// Ends a run with a signal that it cannot catch.
#[cfg(unix)]
fn kill(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

#[cfg(unix)]
#[test]
fn a_second_run_into_the_same_record_is_refused() {
    let folder = folder();
    let first = endless(folder.path(), "a.rec");
    let second = call(folder.path(), "run headon -q --no-expect -o a.rec");
    kill(first);
    let message = stderr(&second.code(2));
    assert!(message.contains("cannot write a.rec: another process is writing it; wait"), "{message}");
    let tracks = throng_record::Trajectories::read(folder.path().join("a.rec.part")).unwrap();
    assert_eq!(tracks.moments(0).next().unwrap().1.len(), 36, "the first run");
    // The remains of a killed run do not block the next run.
    call(folder.path(), "run headon -q --no-expect -o a.rec").success();
    assert_eq!(names(folder.path()), ["a.rec"]);
    let tracks = throng_record::Trajectories::read(folder.path().join("a.rec")).unwrap();
    assert_eq!(tracks.setting.groups, ["left", "right"], "the other run");
}

#[cfg(unix)]
#[test]
fn the_next_run_removes_the_remains_of_a_killed_one() {
    let folder = folder();
    kill(endless(folder.path(), "a.csv"));
    let left = names(folder.path());
    assert!(left.len() == 1 && left[0].starts_with(".throng-"), "{left:?}");
    let file = std::fs::File::open(folder.path().join(&left[0])).unwrap();
    file.set_modified(std::time::SystemTime::now() - Duration::from_mins(2)).unwrap();
    call(folder.path(), "run headon -q --no-expect -o b.csv").success();
    assert_eq!(names(folder.path()), ["b.csv"]);
}

#[cfg(unix)]
#[test]
fn a_killed_run_keeps_what_it_wrote() {
    let folder = folder();
    let part = folder.path().join("a.rec.part");
    kill(endless(folder.path(), "a.rec"));
    assert_eq!(names(folder.path()), ["a.rec.part"]);
    let tracks = throng_record::Trajectories::read(&part).unwrap();
    let moments: Vec<_> = tracks.moments(0).collect();
    assert!(moments.len() > 100 && moments.iter().all(|(_, people)| people.len() == 36));
    let even = |(k, (time, _)): (usize, &(f64, _))| (time - moments[1].0 * k as f64).abs() < 1e-6;
    assert!(moments.iter().enumerate().all(even), "no moment is missing");
}

/// A plan of 24 runs.
const SWEEP: &str = "scenes = \"bottleneck\"\nseeds = \"1..12\"\nlimit = 12\n[[vary]]\nspeed.preferred = [1.0, 1.4]\n";

/// Returns the names, the contents and the times of the files of finished runs, if there are any.
fn finished(folder: &Path) -> Vec<(String, Vec<u8>, std::time::SystemTime)> {
    let entries = std::fs::read_dir(folder.join("plan.runs")).into_iter().flatten().flatten();
    let file = |entry: std::fs::DirEntry| {
        let name = entry.file_name().into_string().unwrap();
        let time = entry.metadata().ok()?.modified().unwrap();
        // the program renames a file when it is complete: one that is gone by now was not finished
        let text = name.ends_with(".json").then(|| std::fs::read(entry.path()).ok())??;
        Some((name, text, time))
    };
    let mut files: Vec<_> = entries.filter_map(file).collect();
    files.sort();
    files
}

/// Asserts that a sweep that was stopped goes on with the runs that are missing, to the same table as an undisturbed one.
fn goes_on(folder: &Path) {
    let before = finished(folder);
    assert!((3..24).contains(&before.len()), "{}", before.len());
    assert!(!folder.join("plan.parquet").exists());
    let report = call(folder, "sweep plan.toml --json").success();
    let report: Value = serde_json::from_slice(&report.get_output().stdout).unwrap();
    let kept = before.len() as u64;
    assert_eq!((report["made"].as_u64(), report["kept"].as_u64()), (Some(24 - kept), Some(kept)));
    let after = finished(folder);
    assert!(before.iter().all(|file| after.contains(file)), "finished runs are not made again");
    assert_eq!(names(folder), ["plan.parquet", "plan.runs", "plan.toml"]);
    let undisturbed = self::folder();
    std::fs::write(undisturbed.path().join("plan.toml"), SWEEP).unwrap();
    call(undisturbed.path(), "sweep plan.toml -q").success();
    let table = |folder: &Path| std::fs::read(folder.join("plan.parquet")).unwrap();
    assert!(table(folder) == table(undisturbed.path()));
}

#[cfg(unix)]
#[test]
fn a_killed_sweep_goes_on() {
    let folder = folder();
    std::fs::write(folder.path().join("plan.toml"), SWEEP).unwrap();
    let child = Command::new(env!("CARGO_BIN_EXE_throng"))
        .current_dir(folder.path())
        .args(["sweep", "plan.toml", "-q", "--threads", "2"])
        .spawn()
        .unwrap();
    let begin = Instant::now();
    while finished(folder.path()).len() < 3 {
        assert!(begin.elapsed() < Duration::from_secs(60), "no run is finished");
        std::thread::sleep(Duration::from_millis(5));
    }
    kill(child);
    // remains of files that were being written are removed once no process can still write them
    for entry in
        std::fs::read_dir(folder.path()).unwrap().chain(std::fs::read_dir(folder.path().join("plan.runs")).unwrap())
    {
        let path = entry.unwrap().path();
        if path.file_name().unwrap().to_str().unwrap().starts_with(".throng-") {
            let file = std::fs::File::options().append(true).open(path).unwrap();
            file.set_modified(std::time::SystemTime::now() - Duration::from_mins(2)).unwrap();
        }
    }
    goes_on(folder.path());
}

#[test]
fn an_interrupted_sweep_goes_on() {
    let folder = folder();
    std::fs::write(folder.path().join("plan.toml"), SWEEP).unwrap();
    let output = output(folder.path(), "sweep plan.toml", || finished(folder.path()).len() >= 3);
    let message = String::from_utf8(output.stderr).unwrap();
    let told = "of 24 runs are finished and kept in plan.runs: the same command makes the rest";
    assert!(message.contains("interrupted; ") && message.contains(told), "{message}");
    goes_on(folder.path());
}

fn holds(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}

#[test]
fn an_interrupted_measurement_writes_its_figures() {
    let folder = folder();
    let begin = Instant::now();
    let arguments = "bench crossing --agents 50 --threads 1 --steps 1000 --repeat 1000 --json -o a.md";
    // Long enough for one repeat on a busy machine, and much shorter than all repeats.
    let runs = interrupted(folder.path(), arguments, || begin.elapsed() > Duration::from_secs(3));
    let repeats = runs[0]["repeats"].as_u64().unwrap();
    assert!((1..1000).contains(&repeats), "{runs}");
    assert_eq!(names(folder.path()), ["a.md"]);
}

#[test]
fn an_interrupted_replay_finishes_its_files() {
    let folder = folder();
    let mut text = "# framerate: 10\n".to_owned();
    for frame in 0..200_000u32 {
        let (x, y) = (f64::from(frame % 20_000) * 0.05, f64::from(frame / 20_000));
        text += &format!("{} {frame} {x} {y}\n", frame / 20_000);
    }
    std::fs::write(folder.path().join("long.txt"), text).unwrap();
    let begun = || folder.path().join("f/frame_000009.png").exists();
    let all = interrupted(folder.path(), "replay long.txt -o f/ -o a.csv --size 320x240 --json", begun);
    assert_eq!(names(folder.path()), ["a.csv", "f", "long.txt"]);
    assert_eq!((&all["interrupted"], &all["predicted"]), (&Value::from(true), &Value::Null));
    assert!(std::fs::read_to_string(folder.path().join("a.csv")).unwrap().ends_with('\n'));
}

/// A recording with a gap of nearly a day, which pictures and moments fill.
#[test]
fn an_interrupt_ends_a_long_gap() {
    let folder = folder();
    let path = folder.path();
    std::fs::write(path.join("gap.csv"), "number,time,x,y\n1,0,0,0\n1,0.1,0,0\n1,80000,1,0\n1,80000.1,1,0\n").unwrap();
    output(path, "render gap.csv -o f/ --size 64x64", || path.join("f/frame_000009.png").exists());
    let written = names(&path.join("f")).len();
    assert!((10..1_000_000).contains(&written), "{written}");
    // A file grows under another name until it is complete.
    let grown = |entry: std::fs::DirEntry| entry.metadata().is_ok_and(|m| m.is_file() && m.len() > 10_000);
    let begun = || std::fs::read_dir(path).unwrap().flatten().any(grown);
    output(path, "convert gap.csv -o a.csv --rate 100", begun);
    let rows = std::fs::read_to_string(path.join("a.csv")).unwrap().lines().count();
    assert!((100..8_000_000).contains(&rows), "{rows}");
}
