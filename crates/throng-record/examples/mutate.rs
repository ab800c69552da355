//! Broken files, one after the other, for every kind that is read: none may panic, none may take long, none may take more memory than
//! there is (set a limit with `ulimit -v`).
//!
//! `cargo run --release -p throng-record --example mutate [SECONDS [SEED [ENDING]]]`: so many seconds a kind, 10 if it is not said.
#![allow(clippy::print_stdout)]

use glam::{DVec2, Vec2};
use std::path::Path;
use std::time::{Duration, Instant};
use throng::Status;
use throng_record::formats::FORMATS;
use throng_record::{Body, Choice, Format, Frame, Reading, Setting, Tracks};

/// What is written into files where numbers may be.
const TEXTS: [&str; 12] =
    ["nan", "inf", "-1", "0", "1e308", "-1e-320", "99999999999999999999", "", "\n", "\"", "4294967295", "0x1p3"];
/// The same in binary ones.
const WORDS: [u64; 8] = [0, 1, u64::MAX, u64::MAX / 2, 1 << 31, u32::MAX as u64, 0x7ff0_0000_0000_0000, 1 << 40];

/// Random numbers that are the same everywhere: SplitMix64.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let seconds: f64 = words.first().map_or(Ok(10.0), |word| word.parse())?;
    let seed: u64 = words.get(1).map_or(Ok(1), |word| word.parse())?;
    throng_scene::hush();
    let kinds = FORMATS.iter().enumerate().filter(|(_, kind)| kind.is_read());
    for (index, kind) in kinds.filter(|(_, kind)| words.get(2).is_none_or(|ending| ending == kind.ending)) {
        let whole = samples(index, kind)?;
        let name = format!("broken.{}", kind.ending);
        let (mut dice, mut read, mut count, mut slowest) = (Dice(seed), 0, 0, Duration::ZERO);
        let start = Instant::now();
        while start.elapsed().as_secs_f64() < seconds && !whole.is_empty() {
            let broken = mutated(&whole, &mut dice);
            let begin = Instant::now();
            read += u32::from(Tracks::of_file(&name, &broken, &Reading { rate: Some(25.0), unit: None }).is_ok());
            count += 1;
            if begin.elapsed() > slowest {
                slowest = begin.elapsed();
                if slowest > Duration::from_secs(2) {
                    let kept = std::env::temp_dir().join(format!("slow-{count}.{}", kind.ending));
                    std::fs::write(&kept, &broken)?;
                    println!("  {:.1} s: {}", slowest.as_secs_f64(), kept.display());
                }
            }
        }
        let slow = slowest.as_secs_f64() * 1e3;
        println!(
            ".{:8} {count:9} files, {read:8} of them read, the slowest in {slow:.1} ms: {}",
            kind.ending, kind.title
        );
    }
    Ok(())
}

/// A file that has been changed at a few places.
fn mutated(whole: &[Vec<u8>], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = whole[dice.below(whole.len())].clone();
    for _ in 0..=dice.below(4) {
        let (at, length) = (dice.below(bytes.len()), 1 + dice.below(40));
        let end = (at + length).min(bytes.len());
        match dice.below(8) {
            0 => bytes.truncate(at),
            1 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << dice.below(8)),
            2 => drop(bytes.splice(at..end, TEXTS[dice.below(TEXTS.len())].bytes())),
            3 => drop(bytes.drain(at..end)),
            4 => {
                let again = bytes[at..end].to_vec();
                let to = dice.below(bytes.len());
                drop(bytes.splice(to..to, again));
            }
            5 => {
                let word = WORDS[dice.below(WORDS.len())].to_le_bytes();
                let size = [1, 2, 4, 8][dice.below(4)];
                bytes.iter_mut().skip(at).take(size).zip(word).for_each(|(byte, new)| *byte = new);
            }
            6 => bytes.iter_mut().skip(at).take(length).for_each(|byte| *byte = dice.next() as u8),
            _ => {
                let other = &whole[dice.below(whole.len())];
                bytes.truncate(at);
                bytes.extend_from_slice(&other[dice.below(other.len())..]);
            }
        }
    }
    bytes
}

/// Whole files of a kind: written here, by hand, or of recorded people where those are there.
fn samples(index: usize, kind: &Format) -> Result<Vec<Vec<u8>>, Box<dyn std::error::Error>> {
    let recorded = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/trajectories");
    let text = |text: String| vec![text.into_bytes()];
    Ok(match kind.ending {
        _ if kind.is_written() => {
            let folder = tempfile::tempdir()?;
            let path = folder.path().join(format!("run.{}", kind.ending));
            let groups = vec!["left".to_owned(), "right, or so".to_owned()];
            let setting = Setting { title: "broken".into(), groups, ..Setting::default() };
            let mut writer =
                Choice::default().create(kind, kind.output(&path)?, &setting, || false).ok_or("not written")??;
            (0..12).try_for_each(|k| writer.push(&frame(k)))?;
            writer.finish()?;
            vec![std::fs::read(path)?]
        }
        "h5" => std::fs::read(recorded.join("juelich/00_01a.h5")).into_iter().collect(),
        "traj" => text((0..40).fold(
            "pedestrianId simTime endTime-PID1 startX-PID1 startY-PID1 endX-PID1 endY-PID1\n".into(),
            |text, k| {
                format!("{text}{} {} {} {k}.5 2.0 {k}.9 2.1\n", k % 4, f64::from(k) * 0.4, f64::from(k) * 0.4 + 0.4)
            },
        )),
        // the first of two kinds of the same name is told by what is in it
        _ if kind.title.contains("UCY") => text(
            (0..40)
                .fold(String::new(), |text, k| format!("{text}{}.0 {}.0 {k}.5 0.0 2.5 1.2 0.0 -0.1\n", k * 10, k % 3)),
        ),
        "txt" => text((0..40).fold("# framerate: 25\n# id frame x/cm y/cm z/cm\n".into(), |text, k| {
            format!("{text}{} {} {k}.25 13.5 176.0\n", k % 3, k / 3)
        })),
        other => return Err(format!("no samples of .{other}, kind {index}").into()),
    })
}

/// Three who walk, one of whom comes later.
fn frame(k: u32) -> Frame {
    let time = f64::from(k) * 0.04;
    let body = |number: u32| Body {
        number,
        group: number % 2,
        goal: None,
        position: DVec2::new(time, f64::from(number)),
        altitude: 0.0,
        velocity: Vec2::X,
        climb: 0.0,
        heading: 0.1 * k as f32,
        basis: None,
        radius: 0.25,
        core: Vec2::ZERO,
        preferred_speed: 1.3,
        status: Status::Walking,
    };
    Frame { time, bodies: (0..if k < 4 { 2 } else { 3 }).map(body).collect(), ..Frame::default() }
}
