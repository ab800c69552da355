//! Hashes of trajectory files that are written and read.
#[expect(dead_code, reason = "only tests of worlds use the rest")]
#[path = "../../../throng/tests/shared/draw.rs"]
mod draw;
#[path = "../../../throng/tests/shared/kept.rs"]
mod results;

use draw::Draw;
use glam::{DVec2, Vec2};
use results::Results;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use throng::Status;
use throng_record::formats::FORMATS;
use throng_record::formats::rec::Contents;
use throng_record::people::FigureStyle;
use throng_record::{Body, Choice, Column, Format, Frame, Reading, Setting, Trajectories, map, moment};
use throng_scene::gallery;

/// Scenes that together cover all features of a setting and a body.
const SCENES: [&str; 9] = [
    "office",
    "mixed-sizes",
    "vehicle",
    "sliding-door",
    "boids-between-spheres",
    "boids-in-sphere-rectangle",
    "swarm-attack",
    "capture-the-flag",
    "field-anchors",
];

type Recording = (Setting, Vec<Frame>);

/// Returns every fourth of the first steps of a scene.
fn recorded(name: &str) -> Recording {
    let scene = gallery::scene(name).unwrap();
    let (mut world, built) = scene.build().unwrap();
    let setting = moment::setting(&world, &built, name);
    let mut frames = Vec::new();
    for step in 0..60 {
        if step % 4 == 0 {
            let mut frame = Frame::default();
            moment::capture(&world, &mut frame);
            frame.bodies.truncate(25);
            frames.push(frame);
        }
        world.step();
    }
    (setting, frames)
}

/// Returns agents that appear and disappear at uneven times, stand still, turn and jump.
fn restless() -> Recording {
    let mut draw = Draw::new(3);
    let mut number = move |low: f64, high: f64| draw.between(low, high);
    let setting =
        Setting { groups: vec!["=a, \"b\"".into(), String::new()], title: "<&>".into(), ..Setting::default() };
    let mut frames: Vec<Frame> = Vec::new();
    let mut time = -3.0;
    for k in 0..40 {
        let mut bodies = Vec::new();
        for agent in 0..6 {
            let there = k / 7 % 3 != agent % 3;
            let moved = number(-0.1, 0.1);
            let at = DVec2::new(agent as f64 * 3.0 + 0.1 * k as f64, if agent < 2 { 5.0 } else { moved });
            let body = Body {
                number: agent * 1000 + 7,
                group: agent % 2,
                goal: None,
                position: if agent == 5 && k > 20 { at + 100.0 } else { at },
                altitude: if agent == 4 { number(0.0, 2.0) as f32 } else { 0.0 },
                velocity: Vec2::new(number(-2.0, 2.0) as f32, 0.5),
                vertical_velocity: number(-0.1, 0.1) as f32,
                heading: number(-3.1, 3.1) as f32,
                basis: None,
                radius: 0.2 + 0.1 * agent as f32,
                core: if agent == 3 { Vec2::new(0.5, 0.1) } else { Vec2::ZERO },
                preferred_speed: 1.3,
                status: [Status::Walking, Status::Waiting, Status::Arrived, Status::Stranded][agent as usize % 4],
            };
            if there {
                bodies.push(body);
            }
        }
        frames.push(Frame { time, bodies, ..Frame::default() });
        time += if k < 20 { 0.04 } else { number(0.01, 2.0) };
    }
    (setting, frames)
}

/// Returns trajectories as text, without the folder of the file: notes name it.
fn as_text(tracks: &Trajectories, file: &Path) -> String {
    format!("{tracks:?}").replace(&*file.to_string_lossy(), "")
}

fn write((setting, frames): &Recording, choice: &Choice, path: &Path) {
    let format = Format::of(path).unwrap();
    let output = format.output(path).unwrap();
    let mut writer = choice.create(format, output, setting, || false).unwrap().unwrap();
    frames.iter().for_each(|frame| writer.push(frame).unwrap());
    writer.finish().unwrap();
}

fn written(recording: &Recording, choice: &Choice, path: &Path) -> Vec<u8> {
    write(recording, choice, path);
    std::fs::read(path).unwrap()
}

/// Whether all bytes are our own: libraries may change their compression.
fn is_plain(format: &Format) -> bool {
    ["csv", "usda", "glb"].contains(&format.ending)
}

#[test]
fn what_is_written_is_as_kept() {
    let folder = tempfile::tempdir().unwrap();
    let mut results = Results::default();
    let recordings: Vec<(&str, Recording)> =
        SCENES.iter().map(|name| (*name, recorded(name))).chain([("restless", restless())]).collect();
    let part = Choice { from: -2.5, to: 4.0, rate: Some(7.0), ..Choice::default() };
    for format in FORMATS {
        results.add(
            "formats",
            &(format.ending, format.title, format.is_read(), format.is_written(), format.has_columns()),
        );
    }
    for format in FORMATS.iter().filter(|format| format.is_written() && format.is_read()) {
        for (what, recording) in &recordings {
            for (choice, words) in [(&Choice::default(), ""), (&part, ", a part")] {
                let (name, path) = (format!("{} of {what}{words}", format.ending), folder.path().join("run"));
                let path = path.with_extension(format.ending);
                let bytes = written(recording, choice, &path);
                let tracks = Trajectories::read(&path).unwrap();
                results.add(&name, &as_text(&tracks, &path));
                if is_plain(format) {
                    results.add(&name, &bytes);
                }
            }
        }
    }
    for (what, recording) in recordings.iter().filter(|(_, (setting, _))| !setting.in_space) {
        let baked = Choice { figures: FigureStyle::Baked, ..Choice::default() };
        let path = folder.path().join("run.glb");
        results.add(&format!("baked people of {what}"), &written(recording, &baked, &path));
        let people = tempfile::tempdir().unwrap();
        write(recording, &Choice::default(), &people.path().join("*.bvh"));
        let numbers: BTreeSet<u32> =
            recording.1.iter().flat_map(|frame| &frame.bodies).map(|body| body.number).collect();
        for number in numbers {
            let file = std::fs::read(people.path().join(format!("{number}.bvh")));
            results.add(&format!("bvh of {what}"), &file.ok());
        }
    }
    let columns = Choice { columns: Column::ALL.to_vec(), ..Choice::default() };
    for format in FORMATS.iter().filter(|format| format.has_columns()) {
        let path = folder.path().join("columns").with_extension(format.ending);
        written(&recordings[0].1, &columns, &path);
        results.add(&format!("all columns of {}", format.ending), &as_text(&Trajectories::read(&path).unwrap(), &path));
    }
    results.assert_kept("all/kept-written.txt");
}

/// Returns the seed files of the fuzzer, by kind.
fn corpus() -> Vec<(String, PathBuf)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../throng-fuzz/corpus");
    let listed = |folder: &Path| {
        let mut all: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        all.sort();
        all
    };
    let folders = listed(&root).into_iter().filter(|path| path.is_dir());
    let files = folders.flat_map(|folder| {
        let kind = folder.file_name().unwrap().to_string_lossy().into_owned();
        listed(&folder).into_iter().map(move |file| (kind.clone(), file))
    });
    files
        .filter(|(_, file)| Format::of(file).is_some() || file.extension().is_some_and(|ending| ending == "xml"))
        .collect()
}

/// Returns a file, and copies of it with a part missing, doubled or changed.
fn damaged(bytes: &[u8], draw: &mut Draw) -> Vec<Vec<u8>> {
    let mut all = vec![bytes.to_vec()];
    let mut place = || draw.index(bytes.len());
    for _ in 0..12 {
        let (a, b) = (place(), place());
        let (start, end) = (a.min(b), (a.max(b)).min(a.min(b) + 40));
        all.push(bytes[..a].to_vec());
        all.push([&bytes[..start], &bytes[end..]].concat());
        all.push([&bytes[..end], &bytes[start..]].concat());
        let mut changed = bytes.to_vec();
        changed[start] = b"0-9a;,\n"[b % 7];
        all.push(changed);
    }
    all
}

#[test]
fn what_is_read_is_as_kept() {
    let mut results = Results::default();
    for (kind, file) in corpus() {
        let bytes = std::fs::read(&file).unwrap();
        if bytes.is_empty() {
            continue;
        }
        let name = format!("{kind}/{}", file.file_name().unwrap().to_string_lossy());
        let mut draw = Draw::new(1);
        for input in damaged(&bytes, &mut draw) {
            for reading in [Reading::default(), Reading { rate: Some(25.0), unit: Some(0.01) }] {
                match (Trajectories::of_file(&file, &input, &reading), kind.as_str()) {
                    (Ok(tracks), _) => results.add(&name, &as_text(&tracks, &file)),
                    // these messages come from libraries
                    (Err(_), "parquet" | "sqlite" | "hdf5") => results.add(&name, &"refused"),
                    (Err(error), _) => results.add(&name, &error.to_string().replace(&*file.to_string_lossy(), "")),
                }
            }
            if kind == "rec"
                && let Ok(contents) = Contents::of(&input)
            {
                results.add(&name, &contents.between(0.3, 0.9));
            }
            if kind == "map" {
                results.add(&name, &map(&input));
            }
        }
    }
    results.assert_kept("all/kept-read.txt");
}
