//! Trajectories as a table of comma-separated values.
//!
//! One line an agent and moment, moment after moment, under a line of names:
//!
//! | column | what | unit |
//! |---|---|---|
//! | `number` | the agent's own number | |
//! | `group` | the name of its group; its index where it has no name | |
//! | `time` | time since the start | s |
//! | `x`, `y` | centre, world coordinates | m |
//! | `vx`, `vy` | velocity | m/s |
//! | `heading` | direction of the body, counter-clockwise from +x | rad |
//! | `radius` | radius of the body; of one that is no disc, half of its narrower side | m |
//! | `status` | `walking`, `waiting`, `arrived` or `stranded` | |
//!
//! Numbers are written with as many digits as it takes to read the same bits back. Text is UTF-8, quoted where it
//! holds commas, quotes or line breaks; lines end in a line feed.

use crate::{Body, Frame, Output, OutputError, Setting};
use std::fmt::Write;
use std::io;
use std::path::Path;
use throng::Status;

/// The names of the columns, in order.
pub const COLUMNS: [&str; 10] = ["number", "group", "time", "x", "y", "vx", "vy", "heading", "radius", "status"];

/// Writes trajectories as they happen. See the [module](self) for the columns.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run.csv");
/// use throng_record::{csv::CsvWriter, Frame, Setting};
/// let mut writer = CsvWriter::create(&path, &Setting::default())?;
/// writer.push(&Frame::default())?;
/// writer.finish()?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct CsvWriter {
    lines: Option<csv::Writer<Output>>,
    path: std::path::PathBuf,
    groups: Vec<String>,
    text: String,
}

impl CsvWriter {
    /// Begins the file `path` with the line of names.
    ///
    /// # Errors
    /// Those of [`Output::create`].
    pub fn create(path: impl AsRef<Path>, setting: &Setting) -> Result<Self, OutputError> {
        let output = Output::create(&path)?;
        let mut writer = Self {
            lines: Some(csv::Writer::from_writer(output)),
            path: path.as_ref().to_path_buf(),
            groups: setting.groups.clone(),
            text: String::new(),
        };
        writer.lines(|lines| lines.write_record(COLUMNS))?;
        Ok(writer)
    }

    /// Writes everybody of one moment.
    ///
    /// # Errors
    /// The system's, such as a full disk.
    pub fn push(&mut self, frame: &Frame) -> Result<(), OutputError> {
        let (groups, mut text) = (std::mem::take(&mut self.groups), std::mem::take(&mut self.text));
        let result = self
            .lines(|lines| frame.bodies.iter().try_for_each(|body| line(lines, &groups, frame.time, body, &mut text)));
        (self.groups, self.text) = (groups, text);
        result
    }

    /// Gives the complete file its name.
    ///
    /// # Errors
    /// Those of [`Output::finish`].
    pub fn finish(mut self) -> Result<(), OutputError> {
        let lines = self.lines.take().expect("the writer is there until finish");
        let output = lines.into_inner().map_err(|e| OutputError::new(&self.path, e.into_error()))?;
        output.finish()
    }

    fn lines(&mut self, write: impl FnOnce(&mut csv::Writer<Output>) -> csv::Result<()>) -> Result<(), OutputError> {
        let lines = self.lines.as_mut().expect("the writer is there until finish");
        write(lines).map_err(|error| {
            let source = match error.into_kind() {
                csv::ErrorKind::Io(source) => source,
                other => io::Error::other(format!("{other:?}")),
            };
            OutputError::new(&self.path, source)
        })
    }
}

fn line(
    lines: &mut csv::Writer<Output>,
    groups: &[String],
    time: f64,
    body: &Body,
    text: &mut String,
) -> csv::Result<()> {
    let mut field = |lines: &mut csv::Writer<Output>, value: &dyn std::fmt::Display| {
        text.clear();
        write!(text, "{value}").expect("writing to a string does not fail");
        lines.write_field(&*text)
    };
    field(lines, &body.number)?;
    match groups.get(body.group as usize) {
        Some(name) if !name.is_empty() => lines.write_field(name)?,
        _ => field(lines, &body.group)?,
    }
    for value in [time, body.position.x, body.position.y] {
        field(lines, &value)?;
    }
    for value in [body.velocity.x, body.velocity.y, body.heading, body.shape().girth()] {
        field(lines, &value)?;
    }
    lines.write_field(status_name(body.status))?;
    lines.write_record(None::<&[u8]>)
}

/// How a status is called in files.
pub fn status_name(status: Status) -> &'static str {
    match status {
        Status::Walking => "walking",
        Status::Waiting => "waiting",
        Status::Arrived => "arrived",
        Status::Stranded => "stranded",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, Vec2};

    fn body(number: u32, group: u32) -> Body {
        Body {
            number,
            group,
            goal: None,
            position: DVec2::new(-1800.123456789, 0.1 + 0.2),
            velocity: Vec2::new(1.3, -0.25),
            heading: 0.1,
            radius: 0.2,
            core: Vec2::ZERO,
            preferred_speed: 1.3,
            status: Status::Waiting,
        }
    }

    #[test]
    fn what_is_written_reads_back_to_the_same_bits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        let setting = Setting { groups: vec!["red, \"quick\"".into()], ..Setting::default() };
        let mut writer = CsvWriter::create(&path, &setting).unwrap();
        for k in 0..3 {
            writer
                .push(&Frame { time: f64::from(k) * 0.1, bodies: vec![body(7, 0), body(9, 4)], ..Frame::default() })
                .unwrap();
        }
        writer.finish().unwrap();

        let mut reader = csv::Reader::from_path(&path).unwrap();
        assert_eq!(reader.headers().unwrap().iter().collect::<Vec<_>>(), COLUMNS);
        let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
        assert_eq!(rows.len(), 6);
        assert_eq!(&rows[0][1], "red, \"quick\"");
        assert_eq!(&rows[1][1], "4", "a group without a name is its index");
        for (n, row) in rows.iter().enumerate() {
            let want = body(if n % 2 == 0 { 7 } else { 9 }, 0);
            assert_eq!(row[0].parse::<u32>().unwrap(), want.number);
            assert_eq!(row[2].parse::<f64>().unwrap(), (n / 2) as f64 * 0.1);
            assert_eq!(row[3].parse::<f64>().unwrap(), want.position.x);
            assert_eq!(row[4].parse::<f64>().unwrap(), want.position.y);
            assert_eq!(row[5].parse::<f32>().unwrap(), want.velocity.x);
            assert_eq!(row[7].parse::<f32>().unwrap(), want.heading);
            assert_eq!(row[8].parse::<f32>().unwrap(), want.radius);
            assert_eq!(&row[9], "waiting");
        }
    }

    #[test]
    fn nothing_is_there_before_finish() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        let mut writer = CsvWriter::create(&path, &Setting::default()).unwrap();
        writer.push(&Frame { bodies: vec![body(1, 0)], ..Frame::default() }).unwrap();
        drop(writer);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
