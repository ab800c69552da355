//! Measures the bytes per agent and frame of each file format, and the time of writing.
//!
//! `cargo run --release -p throng-record --example sizes [SCENE [SECONDS [FOLDER]]]`: every step of a gallery scene.
//! Files stay if a folder is named.
#![allow(clippy::print_stdout)]

use std::path::PathBuf;
use std::time::{Duration, Instant};
use throng_record::formats::FORMATS;
use throng_record::{Choice, Frame, moment};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let name = words.next().unwrap_or_else(|| "doorway".into());
    let seconds: f64 = words.next().map_or(Ok(60.0), |word| word.parse())?;
    let temporary = tempfile::tempdir()?;
    let folder = words.next().map_or_else(|| temporary.path().to_path_buf(), PathBuf::from);

    let scene = throng_scene::gallery::scene(&name)?;
    let (mut world, built) = scene.build()?;
    let setting = moment::setting(&world, &built, &scene.title);
    let mut files = Vec::new();
    for format in FORMATS.iter().filter(|format| format.is_written() && format.is_read()) {
        let path = folder.join(&name).with_extension(format.ending);
        let writer = Choice::default()
            .create(format, format.output(&path)?, &setting, || false)
            .ok_or("it is not written")??;
        files.push((format, path, writer, Duration::ZERO));
    }
    let (mut frame, mut rows, mut moments, mut stepping) = (Frame::default(), 0, 0, Duration::ZERO);
    while world.time() < seconds {
        moment::capture(&world, &mut frame);
        rows += frame.bodies.len();
        moments += 1;
        for (_, _, writer, spent) in &mut files {
            let start = Instant::now();
            writer.push(&frame)?;
            *spent += start.elapsed();
        }
        let start = Instant::now();
        world.step();
        stepping += start.elapsed();
    }
    println!("{name}: {moments} frames, {rows} agent-frames, {:.0} ms of stepping", 1e3 * stepping.as_secs_f64());
    for (format, path, writer, spent) in files {
        let start = Instant::now();
        writer.finish()?;
        let (size, end) = (std::fs::metadata(path)?.len(), start.elapsed());
        println!(
            "  .{:8} {:6.2} bytes and {:6.0} ns per agent-frame, {:6.0} ms at the end",
            format.ending,
            size as f64 / rows as f64,
            spent.as_secs_f64() * 1e9 / rows as f64,
            end.as_secs_f64() * 1e3
        );
    }
    Ok(())
}
