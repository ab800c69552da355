//! Trajectory files: read, written and read again.

use super::scratch;
use std::path::Path;
use throng_record::formats::FORMATS;
use throng_record::formats::rec::{Contents, RecWriter};
use throng_record::pedestrian::People;
use throng_record::people::Figures;
use throng_record::{Choice, Format, Frame, Moments, Reading, Sample, Trajectories, Writer};

/// Greatest number of rows of files that are written again.
const FEW: usize = 5000;
/// Number of parts of a `.rec` that are read.
const PARTS: usize = 8;
/// The frame rate of files that state none.
const READING: Reading = Reading { rate: Some(25.0), unit: None };

/// Reads a file of an ending.
pub(super) fn read(ending: &str, bytes: &[u8]) -> Result<(), String> {
    let name = format!("input.{ending}");
    let tracks = Trajectories::of_file(&name, bytes, &READING).map_err(|error| error.to_string())?;
    let ordered = tracks.spots.is_sorted_by(|a, b| (a.time, a.number) <= (b.time, b.number));
    assert!(ordered, "rows are not sorted by time and number");
    let groups = tracks.setting.groups.len();
    assert!(
        tracks.spots.iter().all(|spot| (spot.group as usize) < groups),
        "an agent is in none of the {groups} groups"
    );
    // as `throng info` does
    let people = People::of(&tracks, |_| true);
    std::hint::black_box(people.interval());
    if tracks.spots.len() <= FEW {
        let own = Format::of(&name).filter(|format| format.is_written());
        own.into_iter().for_each(|format| drop(written(&tracks, format)));
        as_table(&tracks);
    }
    Ok(())
}

/// Reads the people of a file, and their joints at its first and last second.
pub(super) fn people(ending: &str, bytes: &[u8]) -> Result<(), String> {
    let figures = Figures::of_file(format!("input.{ending}"), bytes).map_err(|error| error.to_string())?;
    for figure in &figures.all {
        for second in figure.seconds {
            std::hint::black_box(figure.joints(second));
        }
    }
    Ok(())
}

/// Reads a body of a file.
pub(super) fn figure(bytes: &[u8]) -> Result<(), String> {
    throng_record::people::character(bytes).map(|body| _ = std::hint::black_box(body)).map_err(|flaw| flaw.to_string())
}

/// Reads a `.rec` whole and in parts, and appends to it.
pub(super) fn rec(bytes: &[u8]) -> Result<(), String> {
    let contents = Contents::of(bytes).map_err(|flaw| flaw.to_string())?;
    for key in contents.keys.iter().take(PARTS) {
        // the index may be wrong even if the records are not
        let _ = contents.between(key.time, key.time + 1.0);
    }
    read("rec", bytes)?;
    let last = contents.between(f64::NEG_INFINITY, f64::INFINITY).map_err(|flaw| flaw.to_string())?;
    let time = last.spots.last().map_or(0.0, |spot| spot.time) + 1.0;
    scratch::file("going-on.rec", bytes, |path| {
        let mut writer = RecWriter::append(path).map_err(|error| error.to_string())?;
        writer.push(&Frame { time, ..Frame::default() }).expect("another frame");
        Box::new(writer).finish().expect("an appended file");
        let bytes = std::fs::read(path).expect("the file");
        let longer = Trajectories::of_file(path, &bytes, &READING).expect("an appended file can be read");
        assert_eq!(longer.spots.len(), last.spots.len(), "rows of an appended file");
        Ok(())
    })
}

/// Writes trajectories as a table and reads it. All values must be equal to the bit, except the vertical velocities of
/// agents on the ground.
fn as_table(tracks: &Trajectories) {
    let again = written(tracks, &FORMATS[0]);
    assert_eq!(again.spots.len(), tracks.spots.len(), "rows of the written table");
    for (spot, again) in tracks.spots.iter().zip(&again.spots) {
        let plane =
            |spot: &Sample| (spot.number, spot.time, spot.place.truncate(), spot.velocity.truncate(), spot.status);
        assert_eq!(plane(again), plane(spot), "a row of the written table");
        let body = |spot: &Sample| (spot.place.z as f32, spot.heading, spot.radius);
        assert_eq!(body(again), body(spot), "a row of the written table");
    }
}

/// Returns trajectories after they were written in a format and read.
fn written(tracks: &Trajectories, format: &Format) -> Trajectories {
    let moments = Moments::of(tracks.clone());
    scratch::file("again", &[], |path: &Path| {
        let path = path.with_extension(format.ending);
        let output = format.output(&path).expect("a file");
        let writer =
            Choice::default().create(format, output, &moments.setting, || false).expect("a format that can be written");
        let mut writer = writer.expect("a writer");
        let mut frame = Frame::default();
        for k in 0..moments.count() {
            moments.capture(k, &mut frame);
            writer.push(&frame).unwrap_or_else(|error| panic!("frame {k} as .{}: {error}", format.ending));
        }
        writer.finish().unwrap_or_else(|error| panic!("the end as .{}: {error}", format.ending));
        Trajectories::read(&path).unwrap_or_else(|error| panic!("a written .{} cannot be read: {error}", format.ending))
    })
}

#[cfg(test)]
mod tests {
    use crate::TARGETS;
    use throng_record::formats::FORMATS;

    #[test]
    fn every_format_that_can_be_read_is_a_target() {
        let kinds = |ending: &str| FORMATS.iter().filter(|kind| kind.is_read() && kind.ending == ending).count();
        for kind in FORMATS.iter().filter(|kind| kind.is_read()) {
            let targets = TARGETS
                .iter()
                .filter(|target| target.ending == kind.ending && target.about.starts_with("trajectories"));
            assert_eq!(targets.count(), kinds(kind.ending), ".{}: {}", kind.ending, kind.title);
        }
    }
}
