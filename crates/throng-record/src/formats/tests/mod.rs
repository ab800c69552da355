//! Tests of all formats: written files are read back, and damaged files are errors.

mod crowd;

use super::{FORMATS, Format, FormatFlaw, Reading, Writer, rec};
use crate::trajectories::{Sample, Trajectories};
use crate::{Choice, Frame, Output, OutputError, Setting};
use crowd::{Times, crowd};
use glam::DVec3;
use proptest::prelude::*;
use std::path::Path;

/// Greatest errors of data that were written and read.
struct Errors {
    place: f64,
    velocity: f32,
    heading: f32,
    radius: f32,
    /// Whether uneven times are kept exactly.
    uneven: bool,
    /// Whether a file that is cut off is read up to the cut.
    cut: bool,
    /// Whether altitudes are lost.
    flat: bool,
    /// Whether velocities are stored; else they are displacements over time.
    speeds: bool,
    /// Whether the status is stored.
    status: bool,
}

const EXACT: Errors = Errors {
    place: 0.0,
    velocity: 0.0,
    heading: 0.0,
    radius: 0.0,
    uneven: true,
    cut: false,
    flat: false,
    speeds: true,
    status: true,
};
/// The error of an `f32` up to 1024 m from the origin.
const SINGLE: f64 = 0.031e-3;

fn errors(format: &Format) -> Errors {
    match format.ending {
        "parquet" => EXACT,
        "rec" => Errors { place: 0.051e-3, velocity: 0.51e-3, heading: 0.39e-3, radius: 0.051e-3, cut: true, ..EXACT },
        "sqlite" => Errors { heading: 1e-5, flat: true, speeds: false, status: false, ..EXACT },
        // times within an animation are `f32`; the times of the frames are not
        "glb" => Errors { place: 1e-3 + SINGLE, heading: 0.4f32.to_radians(), speeds: false, status: false, ..EXACT },
        "usda" => Errors {
            place: 0.05e-3 + SINGLE,
            velocity: 0.51e-3,
            heading: 0.06f32.to_radians(),
            radius: 0.051e-3,
            status: false,
            ..EXACT
        },
        // altitudes are `f32`: their decimals differ from those of the `f64`
        "csv" => Errors { place: 1e-6, cut: true, ..EXACT },
        other => panic!("what error has .{other}?"),
    }
}

/// Returns the bytes of a file with these frames.
fn written(format: &Format, setting: &Setting, frames: &[Frame]) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run").with_extension(format.ending);
    write(format, &path, setting, frames);
    std::fs::read(path).unwrap()
}

fn write(format: &Format, path: &Path, setting: &Setting, frames: &[Frame]) {
    try_write(format, path, setting, frames).unwrap();
}

fn try_write(format: &Format, path: &Path, setting: &Setting, frames: &[Frame]) -> Result<(), OutputError> {
    let mut writer = format.create(Output::create(path)?, setting, &Choice::default()).unwrap()?;
    frames.iter().try_for_each(|frame| writer.push(frame))?;
    writer.finish()
}

fn read(format: &Format, bytes: &[u8]) -> Result<Trajectories, FormatFlaw> {
    format.reader().unwrap()(bytes, &Reading::default())
}

/// Returns the samples of frames, as a file should return them.
fn spots(frames: &[Frame]) -> Vec<Sample> {
    let of = |frame: &Frame| {
        let time = frame.time;
        frame
            .bodies
            .iter()
            .map(move |body| Sample {
                number: body.number,
                group: body.group,
                time,
                place: body.center(),
                velocity: body.velocity.extend(body.vertical_velocity),
                heading: body.heading,
                radius: body.shape().clearance_radius(),
                status: body.status,
            })
            .collect::<Vec<_>>()
    };
    let mut tracks = Trajectories { spots: frames.iter().flat_map(of).collect(), ..Trajectories::default() };
    tracks.sort();
    tracks.spots
}

fn both() -> impl Iterator<Item = &'static Format> {
    FORMATS.iter().filter(|format| format.is_written() && format.reader().is_some())
}

fn compare(format: &Format, setting: &Setting, frames: &[Frame]) -> Result<(), TestCaseError> {
    let tracks = read(format, &written(format, setting, frames)).unwrap();
    let (errors, want) = (errors(format), spots(frames));
    prop_assert_eq!(tracks.spots.len(), want.len());
    for (found, want) in tracks.spots.iter().zip(&want) {
        let want = Sample {
            place: if errors.flat { want.place.with_z(0.0) } else { want.place },
            velocity: if errors.speeds { want.velocity } else { found.velocity },
            status: if errors.status { want.status } else { found.status },
            ..*want
        };
        prop_assert_eq!((found.number, found.status), (want.number, want.status), "{}", format.ending);
        prop_assert_eq!(&tracks.setting.groups[found.group as usize], &setting.groups[want.group as usize]);
        let late = (found.time - want.time).abs();
        prop_assert!(late <= if errors.uneven { 0.0 } else { 1e-9 }, "{}: {late} s late", format.ending);
        let off: DVec3 = (found.place - want.place).abs();
        prop_assert!(off.max_element() <= errors.place, "{}: {off} m off", format.ending);
        let off = (found.velocity - want.velocity).abs().max_element();
        prop_assert!(off <= errors.velocity, "{}: {off} m/s off", format.ending);
        let turned = (found.heading - want.heading).rem_euclid(std::f32::consts::TAU);
        let turned = turned.min(std::f32::consts::TAU - turned);
        prop_assert!(turned <= errors.heading, "{}: {turned} rad off", format.ending);
        prop_assert!((found.radius - want.radius).abs() <= errors.radius);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn written_files_are_read_back((setting, frames) in crowd(Times::Uneven), (even_setting, even) in crowd(Times::Even)) {
        for format in both() {
            if errors(format).uneven {
                compare(format, &setting, &frames)?;
            }
            compare(format, &even_setting, &even)?;
        }
    }

    /// Appending to a `.rec` file that was complete, or was cut off anywhere, gives the same as writing all frames at
    /// once.
    #[test]
    fn a_file_is_appended_to((setting, frames) in crowd(Times::Even), part in 0.0..1.0f64, cut in prop::option::of(0.0..1.0f64)) {
        let format = Format::of("run.rec").unwrap();
        let folder = tempfile::tempdir().unwrap();
        let (path, unfinished) = (folder.path().join("run.rec"), folder.path().join("run.rec.part"));
        let first = (part * frames.len() as f64) as usize;
        write(format, &path, &setting, &frames[..first]);
        let mut kept = first;
        if let Some(cut) = cut {
            let whole = std::fs::read(&path).unwrap();
            // The head is written first: the file less its empty index, the position of the index and the end mark.
            let head = written(format, &setting, &[]).len() - 35;
            let cut = &whole[..head.max((cut * whole.len() as f64) as usize).min(whole.len())];
            std::fs::remove_file(&path).unwrap();
            std::fs::write(&unfinished, cut).unwrap();
            let there = Trajectories::read(&unfinished).unwrap();
            let last = there.spots.last().map(|spot| spot.time);
            kept = frames[..first].iter().take_while(|frame| last.is_some_and(|last| frame.time <= last)).count();
            prop_assume!(frames[..first].iter().all(|frame| !frame.bodies.is_empty()));
        }
        let mut writer = rec::RecWriter::append(&path).unwrap();
        frames[kept..].iter().for_each(|frame| writer.push(frame).unwrap());
        Box::new(writer).finish().unwrap();
        let (found, want) = (std::fs::read(&path).unwrap(), written(format, &setting, &frames));
        prop_assert_eq!(read(format, &found).unwrap(), read(format, &want).unwrap());
        let contents = rec::Contents::of(&found).unwrap();
        prop_assert_eq!(contents.moments, Some(frames.len() as u64));
        // reading can start at every key frame
        for key in &contents.keys {
            let part = contents.between(key.time, f64::INFINITY).unwrap();
            let all = contents.between(f64::NEG_INFINITY, f64::INFINITY).unwrap();
            let later: Vec<Sample> = all.spots.into_iter().filter(|spot| spot.time >= key.time).collect();
            prop_assert_eq!(part.spots, later);
        }
        prop_assert!(!unfinished.exists());
    }

    /// A file with changed bytes is read or is an error, but never a panic.
    #[test]
    fn damaged_files_are_no_panic(
        (setting, frames) in crowd(Times::Even),
        cut in 0.0..1.0f64,
        flips in proptest::collection::vec((0.0..1.0f64, 1u8..), 1..4),
    ) {
        for format in both() {
            let whole = written(format, &setting, &frames);
            let cut = &whole[..(cut * whole.len() as f64) as usize];
            let of_cut = read(format, cut);
            if !errors(format).cut {
                prop_assert!(of_cut.is_err(), "{}: {} of {} bytes", format.ending, cut.len(), whole.len());
            }
            let mut flipped = whole.clone();
            for (at, with) in &flips {
                flipped[(at * whole.len() as f64) as usize] ^= with;
            }
            let _ = read(format, &flipped);
        }
    }
}

/// Needs ten gigabytes of memory and of disk.
#[test]
#[ignore = "minutes"]
fn ten_million_rows_come_back() {
    let (setting, frames) = crowd::large(10_000, 1100);
    assert!(frames.iter().map(|frame| frame.bodies.len()).sum::<usize>() >= 10_000_000);
    for format in both() {
        compare(format, &setting, &frames).unwrap();
    }
}

/// Cuts a small file at every byte and changes every byte; a larger file, at a few thousand bytes.
#[test]
fn every_byte_counts() {
    let (setting, frames) = crowd::small();
    for format in both() {
        let mut whole = written(format, &setting, &frames);
        let step = whole.len().div_ceil(3000);
        for end in (0..whole.len()).step_by(step) {
            let read = read(format, &whole[..end]);
            assert!(errors(format).cut || read.is_err(), "{}: {end} of {} bytes", format.ending, whole.len());
        }
        for at in (0..whole.len()).step_by(step) {
            for turn in [0x01, 0x80, 0xff] {
                whole[at] ^= turn;
                let _ = read(format, &whole);
                whole[at] ^= turn;
            }
        }
    }
}

/// Numbers outside all limits of trajectories.
const ABSURD: [f64; 7] = [1e16, -1e16, 1.1e8, 1e300, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// Changes a number of a frame.
type Change = fn(&mut Frame, f64);

/// Trajectories that are read are within the limits, whatever numbers the file holds.
#[test]
fn numbers_out_of_their_limits_are_refused() {
    let (setting, frames) = crowd::small();
    let folder = tempfile::tempdir().unwrap();
    let fields: [(&str, Change); 6] = [
        ("x", |frame, value| frame.bodies[0].position.x = value),
        ("y", |frame, value| frame.bodies[0].position.y = value),
        ("z", |frame, value| frame.bodies[0].altitude = value as f32),
        ("velocity", |frame, value| frame.bodies[0].velocity.x = value as f32),
        ("heading", |frame, value| frame.bodies[0].heading = value as f32),
        ("radius", |frame, value| frame.bodies[0].radius = value as f32),
    ];
    for format in both() {
        for value in ABSURD {
            for (name, change) in fields {
                let mut frames = frames.clone();
                change(&mut frames[2], value);
                let path = format!("run.{}", format.ending);
                let what = format!("{name} = {value} in {path}");
                let file = folder.path().join(&path);
                if let Err(error) = try_write(format, &file, &setting, &frames) {
                    // SQLite cannot store NaN
                    assert_eq!(format.ending, "sqlite", "{what}: {error}");
                    continue;
                }
                let bytes = std::fs::read(file).unwrap();
                match Trajectories::of_file(&path, &bytes, &Reading::default()) {
                    Ok(tracks) => assert!(crate::limits::tracks(&tracks).is_ok(), "{what}"),
                    Err(error) => assert!(error.to_string().starts_with(&path), "{what}: {error}"),
                }
                // formats that store such coordinates must refuse them
                if matches!(name, "x" | "y") && value.abs() == 1e16 {
                    assert!(Trajectories::of_file(&path, &bytes, &Reading::default()).is_err(), "{what}");
                }
            }
        }
    }
}

/// Formats that are only read, as text: the message names the file, and the row by its agent and time, or by its line.
#[test]
fn rows_out_of_their_limits_are_named() {
    let reading = Reading { rate: Some(10.0), unit: None };
    let message =
        |name: &str, text: &str| Trajectories::of_file(name, text.as_bytes(), &reading).unwrap_err().to_string();
    for (name, text) in [
        ("a.txt", "1 0 0.5 0\n1 5 1e16 0\n"),
        ("a.traj", "timeStep pedestrianId x y\n0 1 0.5 0\n5 1 1e16 0\n"),
        ("a.traj", "pedestrianId simTime endTime startX startY endX endY\n1 0.5 0.5 1e16 0 1e16 0\n"),
        ("obsmat.txt", "0 1 0.5 0 0 0 0 0\n5 1 1e16 0 0 0 0 0\n"),
    ] {
        let message = message(name, text);
        assert!(
            message.starts_with(&format!("{name}: x of agent 1 at 0.5 s is 1e16, but must be from -")),
            "{message}"
        );
        assert!(message.contains("hint: correct or remove the row"), "{message}");
    }
    let table =
        |row: &str| message("a.csv", &format!("number,time,x,y,vx,vy,heading,radius\n1,0,0,0,0,0,0,0.2\n{row}\n"));
    for (row, what) in [
        ("1,0.5,0,-1e16,0,0,0,0.2", "y of agent 1 at 0.5 s is -1e16"),
        ("1,1e11,0,0,0,0,0,0.2", "the time of agent 1 at 100000000000 s is 1"),
        ("1,0.5,0,0,1e30,0,0,0.2", "the velocity along x of agent 1"),
        ("1,0.5,0,0,0,1e300,0,0.2", "the velocity along y of agent 1 at 0.5 s is inf"),
        ("1,0.5,0,0,0,0,1e20,0.2", "the heading of agent 1"),
        ("1,0.5,0,0,0,0,0,1e20", "the radius of agent 1"),
        ("1,0.5,0,0,0,0,0,-0.1", "the radius of agent 1 at 0.5 s is -0.1"),
    ] {
        let message = table(row);
        assert!(message.starts_with(&format!("a.csv:3: {what}")), "{message}");
    }
    assert!(message("a.csv", "number,time,x,y\n1,0,nan,0\n").starts_with("a.csv:2: `nan` is no number for x"));
}
