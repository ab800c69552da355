//! Tests of video that the program ffmpeg encodes.

#[path = "../all/common.rs"]
#[allow(dead_code, reason = "other tests use the rest")]
mod common;
#[path = "../../../throng/tests/shared/outside.rs"]
#[allow(dead_code, reason = "these tests need no data")]
mod outside;

use common::{moment, setting, style};
use outside::Need;
use std::path::Path;
use std::process::Command;
use throng_draw::Film;

const FRAMES: usize = 20;

fn main() {
    let ffmpeg = [Need::Program("ffmpeg"), Need::Program("ffprobe")];
    outside::run(vec![
        outside::test("other_videos_go_through_ffmpeg", &ffmpeg, other_videos_go_through_ffmpeg),
        outside::test("a_video_that_is_dropped_leaves_nothing", &ffmpeg, a_video_that_is_dropped_leaves_nothing),
        outside::test("an_mp4_is_played_by_other_programs", &ffmpeg, an_mp4_is_played_by_other_programs),
    ]);
}

/// Writes a film of [`FRAMES`] pictures, 25 per second.
fn film(path: &Path) {
    let mut film = Film::create(path, &setting(), &style(), 25.0).unwrap();
    (0..FRAMES).for_each(|k| film.push(&moment(k)).unwrap());
    film.finish().unwrap();
}

/// Returns width, height, and the number of pictures that ffprobe decodes.
fn probed(path: &Path) -> String {
    let entries = "stream=width,height,nb_read_frames";
    let options = ["-v", "error", "-count_frames", "-show_entries", entries, "-of", "csv=p=0"];
    let output = Command::new("ffprobe").args(options).arg(path).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().trim().to_owned()
}

fn other_videos_go_through_ffmpeg() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.avi");
    film(&path);
    assert_eq!(&std::fs::read(&path).unwrap()[..4], b"RIFF");
    assert_eq!(probed(&path), "160,120,20");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

fn a_video_that_is_dropped_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut film = Film::create(folder.path().join("film.avi"), &setting(), &style(), 25.0).unwrap();
    (0..5).for_each(|k| film.push(&moment(k)).unwrap());
    drop(film);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

fn an_mp4_is_played_by_other_programs() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    film(&path);
    assert_eq!(probed(&path), "160,120,20");
}
