//! Writes tables.

use crate::formats::{Column, Writer};
use crate::{Body, Frame, Output, OutputError, Setting};
use std::fmt::{Display, Write};
use std::path::Path;
use throng::Status;

/// The default columns, in order; the last two are for scenes with flying agents.
const COLUMNS: [Column; 12] = [
    Column::Number,
    Column::Group,
    Column::Time,
    Column::X,
    Column::Y,
    Column::Vx,
    Column::Vy,
    Column::Heading,
    Column::Radius,
    Column::Status,
    Column::Z,
    Column::Vz,
];

/// Writes trajectories during a run. The [module](super) describes the columns.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run.csv");
/// use throng_record::csv::CsvWriter;
/// use throng_record::{Frame, Setting, Writer};
/// let mut writer = CsvWriter::create(&path, &Setting::default())?;
/// writer.push(&Frame::default())?;
/// writer.finish()?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct CsvWriter {
    output: Output,
    columns: Vec<Column>,
    /// The names of the groups as fields.
    groups: Vec<String>,
    /// The line under construction.
    line: String,
}

impl CsvWriter {
    /// Starts the file `path` with the line of names.
    ///
    /// # Errors
    /// The errors of [`Output::create`].
    pub fn create(path: impl AsRef<Path>, setting: &Setting) -> Result<Self, OutputError> {
        Self::new(Output::create(path)?, setting, &[])
    }

    /// Starts a table with the line of names of these columns; without columns, those of the [module](super).
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub fn new(mut output: Output, setting: &Setting, columns: &[Column]) -> Result<Self, OutputError> {
        let own = if setting.in_space { &COLUMNS[..] } else { &COLUMNS[..10] };
        let columns = if columns.is_empty() { own } else { columns }.to_vec();
        output.put((columns.iter().map(|column| column.name()).collect::<Vec<_>>().join(",") + "\n").as_bytes())?;
        let groups = (0..setting.groups.len() as u32).map(|group| field(&setting.group_name(group))).collect();
        Ok(Self { output, columns, groups, line: String::new() })
    }

    fn describe(&mut self, body: &Body, time: &str) {
        let line = &mut self.line;
        for (k, column) in self.columns.iter().enumerate() {
            if k > 0 {
                line.push(',');
            }
            match column {
                // writing to a string does not fail
                Column::Number => drop(write!(line, "{}", body.number)),
                Column::Group => match self.groups.get(body.group as usize) {
                    Some(name) => line.push_str(name),
                    None => drop(write!(line, "{}", body.group)),
                },
                Column::Time => line.push_str(time),
                Column::X => number(line, body.position.x),
                Column::Y => number(line, body.position.y),
                Column::Status => line.push_str(status_name(body.status)),
                _ => column.single().into_iter().for_each(|value| number(line, value(body))),
            }
        }
        line.push('\n');
    }

    /// Gives the complete file its name.
    ///
    /// # Errors
    /// The errors of [`Output::finish`].
    pub fn finish(self) -> Result<(), OutputError> {
        self.output.finish()
    }
}

impl Writer for CsvWriter {
    fn push(&mut self, frame: &Frame) -> Result<(), OutputError> {
        let mut time = String::new();
        number(&mut time, frame.time);
        frame.bodies.iter().try_for_each(|body| {
            self.line.clear();
            self.describe(body, &time);
            self.output.put(self.line.as_bytes())
        })
    }

    fn finish(self: Box<Self>) -> Result<(), OutputError> {
        Self::finish(*self)
    }
}

/// Returns a text as a field.
fn field(text: &str) -> String {
    let text = if is_formula(text) { format!("'{text}") } else { text.into() };
    let plain = !text.contains([',', '"', '\n', '\r']);
    if plain { text } else { format!("\"{}\"", text.replace('"', "\"\"")) }
}

/// Whether a spreadsheet takes a text, without leading apostrophes, for a formula.
pub(super) fn is_formula(text: &str) -> bool {
    text.trim_start_matches('\'').starts_with(['=', '+', '-', '@', '\t', '\r'])
}

/// Appends a number as `Display` writes it, several times as fast.
fn number(line: &mut String, value: impl ryu::Float + Display + Into<f64>) {
    let mut memory = ryu::Buffer::new();
    let text = memory.format(value);
    match text.split_once('.') {
        Some((_, decimals)) if !text.contains('e') && !is_halfway(value.into(), decimals.len()) => {
            line.push_str(text.strip_suffix(".0").unwrap_or(text));
        }
        _ => drop(write!(line, "{value}")),
    }
}

/// Whether a number lies halfway between two numbers with `decimals` decimals. There `Display` rounds away from zero,
/// `ryu` to even.
fn is_halfway(value: f64, decimals: usize) -> bool {
    let scaled = value * f64::from(2u32 << decimals.min(30));
    // a multiple of one half, but not a whole number
    let halves = scaled as i64;
    halves as f64 == scaled && halves % 2 != 0
}

/// Returns the name of a status in files.
pub fn status_name(status: Status) -> &'static str {
    match status {
        Status::Walking => "walking",
        Status::Waiting => "waiting",
        Status::Arrived => "arrived",
        Status::Stranded => "stranded",
    }
}

/// Returns the status with a name in files.
pub(in crate::formats) fn status_of(name: &str) -> Option<Status> {
    [Status::Walking, Status::Waiting, Status::Arrived, Status::Stranded]
        .into_iter()
        .find(|&status| status_name(status) == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, Vec2};
    use proptest::prelude::*;

    fn body(number: u32, group: u32) -> Body {
        Body {
            number,
            group,
            goal: None,
            position: DVec2::new(-1800.123456789, 0.1 + 0.2),
            altitude: 2.7,
            velocity: Vec2::new(1.3, -0.25),
            vertical_velocity: -0.3,
            heading: 0.1,
            basis: None,
            radius: 0.2,
            core: Vec2::ZERO,
            preferred_speed: 1.3,
            status: Status::Waiting,
        }
    }

    #[test]
    fn written_numbers_are_read_back_exactly() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        let setting = Setting { groups: vec!["red, \"quick\"".into()], in_space: true, ..Setting::default() };
        let mut writer = CsvWriter::create(&path, &setting).unwrap();
        for k in 0..3 {
            writer
                .push(&Frame { time: f64::from(k) * 0.1, bodies: vec![body(7, 0), body(9, 4)], ..Frame::default() })
                .unwrap();
        }
        writer.finish().unwrap();

        let mut reader = csv::Reader::from_path(&path).unwrap();
        assert_eq!(reader.headers().unwrap().iter().collect::<Vec<_>>(), COLUMNS.map(Column::name));
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
            assert_eq!(
                (row[10].parse::<f32>().unwrap(), row[11].parse::<f32>().unwrap()),
                (want.altitude, want.vertical_velocity)
            );
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2_000))]

        #[test]
        fn numbers_are_written_as_they_are_displayed(double: f64, single: f32, bits: u64) {
            let local = f64::from(((bits >> 40) as i32 - (1 << 23)) as f32 * 1e-4) + 4096.0;
            for value in [double, f64::from_bits(bits), f64::from(single), local, (bits as i32 as f64) / 8192.0] {
                let mut text = String::new();
                number(&mut text, value);
                prop_assert_eq!(text, value.to_string());
            }
            for value in [single, f32::from_bits(bits as u32)] {
                let mut text = String::new();
                number(&mut text, value);
                prop_assert_eq!(text, value.to_string());
            }
        }
    }

    #[test]
    fn tables_of_the_plane_have_no_third_axis() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        let mut writer = CsvWriter::create(&path, &Setting::default()).unwrap();
        writer.push(&Frame { bodies: vec![body(1, 0)], ..Frame::default() }).unwrap();
        writer.finish().unwrap();
        let mut reader = csv::Reader::from_path(&path).unwrap();
        assert_eq!(reader.headers().unwrap().iter().collect::<Vec<_>>(), COLUMNS.map(Column::name)[..10]);
        assert_eq!(reader.records().next().unwrap().unwrap().len(), 10);
    }

    #[test]
    fn columns_can_be_chosen() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        let columns = [Column::Y, Column::Number, Column::Vz];
        let mut writer = CsvWriter::new(Output::create(&path).unwrap(), &Setting::default(), &columns).unwrap();
        writer.push(&Frame { bodies: vec![body(7, 0)], ..Frame::default() }).unwrap();
        writer.finish().unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "y,number,vz\n0.30000000000000004,7,-0.3\n");
    }

    #[test]
    fn no_file_is_left_without_finish() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        let mut writer = CsvWriter::create(&path, &Setting::default()).unwrap();
        writer.push(&Frame { bodies: vec![body(1, 0)], ..Frame::default() }).unwrap();
        drop(writer);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
