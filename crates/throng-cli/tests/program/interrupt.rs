//! Ctrl-C ends a run cleanly.

use crate::shared::{folder, names};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

#[test]
fn an_interrupted_run_finishes_its_files() {
    let folder = folder();
    let child = Command::new(env!("CARGO_BIN_EXE_throng"))
        .current_dir(folder.path())
        .args(["run", "circle", "-o", "a.mp4", "-o", "a.csv", "--json", "--duration", "100000", "--size", "160x120"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Files grow under other names until they are complete.
    let begin = Instant::now();
    let grown = |entry: std::fs::DirEntry| entry.metadata().is_ok_and(|m| m.len() > 50_000);
    while !std::fs::read_dir(folder.path()).unwrap().flatten().any(grown) {
        assert!(begin.elapsed() < Duration::from_secs(20), "the run does not begin");
        std::thread::sleep(Duration::from_millis(10));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{output:?}");
    assert_eq!(names(folder.path()), ["a.csv", "a.mp4"]);

    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["interrupted"], true);
    let steps = report["steps"].as_u64().unwrap();
    let table = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    assert!(table.ends_with('\n'));
    assert_eq!(table.lines().count() as u64, 1 + (steps + 1) * 36, "everybody at every step");
    let video = std::fs::read(folder.path().join("a.mp4")).unwrap();
    assert!(holds(&video, b"moov") && holds(&video, b"mdat"), "the video has its index");
}

fn holds(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}
