//! Tests that a program that is killed while it writes leaves a `.rec` file without at most its last second.
//!
//! This binary is separate: it starts itself again, and measures time, which parallel tests would take from its writers.

use glam::{DVec2, Vec2};
use std::io::{BufRead, BufReader, Read, Write};
use std::ops::Range;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use throng::Status;
use throng_record::{Body, Choice, Format, Frame, Setting, Trajectories};

/// Number of parallel processes.
const TOGETHER: u64 = 10;
/// Greatest missing time, seconds: a second, and a frame interval on a busy machine.
const MISSING: f64 = 1.25;

/// Returns 40 agents on a circle.
fn frame(time: f64) -> Frame {
    let body = |number: u32| {
        let angle = 0.3 * time + f64::from(number);
        Body {
            number,
            group: 0,
            goal: None,
            position: DVec2::from_angle(angle) * 10.0,
            altitude: 0.0,
            velocity: Vec2::X,
            vertical_velocity: 0.0,
            heading: angle.sin() as f32,
            basis: None,
            radius: 0.25,
            core: Vec2::ZERO,
            preferred_speed: 1.3,
            status: Status::Walking,
        }
    };
    Frame { time, bodies: (0..40).map(body).collect(), ..Frame::default() }
}

/// Not a test of its own: writes frames in real time and prints their times, until it is killed.
#[test]
#[ignore = "run by the other test, which kills it"]
fn write() {
    let path = std::env::var("REC").expect("set by the other test");
    let format = Format::of(&path).unwrap();
    let mut writer = Choice::default()
        .create(format, format.output(&path).unwrap(), &Setting::default(), || false)
        .unwrap()
        .unwrap();
    let (start, mut said) = (Instant::now(), std::io::stdout().lock());
    loop {
        let time = start.elapsed().as_secs_f64();
        writer.push(&frame(time)).unwrap();
        writeln!(said, "at {time}").unwrap();
        said.flush().unwrap();
        std::thread::sleep(Duration::from_millis(4));
    }
}

/// Starts a writer, kills it after `after` milliseconds, and reads its file.
fn kill(folder: &Path, index: u64, after: u64) {
    let path = folder.join(format!("{index}.rec"));
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "write", "--ignored", "--nocapture", "--test-threads=1"])
        .env("REC", &path)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut out = BufReader::new(child.stdout.take().unwrap());
    let mut said = String::new();
    while !said.contains("at ") {
        assert!(out.read_line(&mut said).unwrap() > 0, "the writer wrote nothing: {said}");
    }
    std::thread::sleep(Duration::from_millis(after));
    // SIGKILL, which a process cannot handle
    child.kill().unwrap();
    child.wait().unwrap();
    out.read_to_string(&mut said).unwrap();
    // the last line may be incomplete
    let whole = &said[..=said.rfind('\n').unwrap()];
    let last = whole.lines().rev().find_map(|line| line.rsplit_once("at ")?.1.parse::<f64>().ok()).unwrap();
    let tracks = Trajectories::read(folder.join(format!("{index}.rec.part"))).unwrap();
    let end = tracks.spots.last().unwrap().time;
    assert!(end > last - MISSING, "killed after {after} ms: the file has {end} s of {last} s");
    assert!(tracks.spots.chunk_by(|a, b| a.time == b.time).all(|moment| moment.len() == 40));
    for spot in &tracks.spots {
        let want = frame(spot.time).bodies[spot.number as usize].position;
        assert!(spot.place.truncate().distance(want) < 1e-4, "{spot:?}, not {want}");
    }
}

#[test]
fn twenty_kills_lose_no_more_than_the_last_second() {
    kills(0..20);
}

#[test]
#[ignore = "slow: half a minute"]
fn slow_eighty_more_kills_lose_no_more_than_the_last_second() {
    kills(20..100);
}

fn kills(indices: Range<u64>) {
    let folder = tempfile::tempdir().unwrap();
    for first in indices.step_by(TOGETHER as usize) {
        std::thread::scope(|scope| {
            for index in first..first + TOGETHER {
                // from 0 to 2.5 s, in random order
                let after = index.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
                let folder = folder.path();
                scope.spawn(move || kill(folder, index, after % 2500));
            }
        });
    }
}
