//! A program that is killed while it writes leaves a `.rec` in which all is but the last second.

use glam::{DVec2, Vec2};
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use throng::Status;
use throng_record::{Body, Choice, Format, Frame, Setting, Tracks};

const KILLS: u64 = 100;
/// So many at a time.
const TOGETHER: u64 = 10;
/// Seconds that may be missing: one, and what lies between two moments on a machine that has other things to do.
const MISSING: f64 = 1.25;

/// Who walks round a circle, 40 of them.
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
            climb: 0.0,
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

/// Not a test of its own: writes moments at the times at which they are written, and says each, until it is killed.
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

/// Writes, kills after so many milliseconds, and reads.
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
        assert!(out.read_line(&mut said).unwrap() > 0, "it wrote nothing: {said}");
    }
    std::thread::sleep(Duration::from_millis(after));
    // the signal that nothing can be done about
    child.kill().unwrap();
    child.wait().unwrap();
    out.read_to_string(&mut said).unwrap();
    // the last line may be cut
    let whole = &said[..=said.rfind('\n').unwrap()];
    let last = whole.lines().rev().find_map(|line| line.rsplit_once("at ")?.1.parse::<f64>().ok()).unwrap();
    let tracks = Tracks::read(folder.join(format!("{index}.rec.part"))).unwrap();
    let end = tracks.spots.last().unwrap().time;
    assert!(end > last - MISSING, "killed after {after} ms: of {last} s there are {end} s");
    assert!(tracks.spots.chunk_by(|a, b| a.time == b.time).all(|moment| moment.len() == 40));
    for spot in &tracks.spots {
        let want = frame(spot.time).bodies[spot.number as usize].position;
        assert!(spot.place.truncate().distance(want) < 1e-4, "{spot:?}, not {want}");
    }
}

#[test]
fn a_hundred_kills_lose_no_more_than_the_last_second() {
    let folder = tempfile::tempdir().unwrap();
    for first in (0..KILLS).step_by(TOGETHER as usize) {
        std::thread::scope(|scope| {
            for index in first..first + TOGETHER {
                // from at once to two seconds and a half, in no order
                let after = index.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
                let folder = folder.path();
                scope.spawn(move || kill(folder, index, after % 2500));
            }
        });
    }
}
