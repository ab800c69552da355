//! Reads tables.

use super::write::{is_formula, status_of};
use crate::formats::{FormatFlaw, Reading, text};
use crate::limits;
use crate::trajectories::{RADIUS, Sample, Trajectories};
use glam::{DVec3, Vec3};
use std::borrow::Cow;
use throng::Status;

const HINT: &str = "a table of trajectories has the columns number, time, x and y, and may have group and z, as `throng run -o NAME.csv` writes them";

/// Reads a table: a line of names, then a line per agent and frame. The columns `number`, `time`, `x` and `y` are
/// required. Without `group`, all agents are in a single group without a name. Without `z`, they are on the ground.
/// Without `vx` and `vy`, velocities are displacements over time. Without `heading`, bodies face along their velocity.
/// Without `radius`, the radius is 0.2 m. Without `status`, agents walk. Other columns are ignored.
///
/// Names may be in capitals. As in files of PedPy and other programs, `id` stands for the number, and `v_x` and `v_y`
/// for the velocity. If there is no `time`, `frame` counts frames, and the reading must state the frame rate.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<Trajectories, FormatFlaw> {
    let table = CsvTable::open(bytes)?;
    let rate = if table.has("time") { 1.0 } else { text::rate(None, reading)? };
    table.tracks(rate, reading.unit.unwrap_or(1.0))
}

/// Returns an error of a line.
fn flaw(line: usize, why: String) -> FormatFlaw {
    FormatFlaw { line: Some(line), why, hint: Some(HINT) }
}

/// A table after its line of names has been read.
struct CsvTable<'a> {
    names: Vec<Cow<'a, str>>,
    records: CsvRecords<'a>,
}

impl<'a> CsvTable<'a> {
    fn open(bytes: &'a [u8]) -> Result<Self, FormatFlaw> {
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let before = &bytes[..error.valid_up_to()];
            flaw(1 + before.iter().filter(|&&byte| byte == b'\n').count(), "the file is not text".to_owned())
        })?;
        let mut records = CsvRecords { rest: text.strip_prefix('\u{feff}').unwrap_or(text), line: 1 };
        let (_, names) = records.next().ok_or_else(|| flaw(1, "it is empty".to_owned()))?;
        let table = Self { names, records };
        match ["number", "time", "x", "y"]
            .iter()
            .find(|&&name| !(table.has(name) || name == "time" && table.has("frame")))
        {
            Some(name) => Err(flaw(1, format!("there is no column `{name}`"))),
            None => Ok(table),
        }
    }

    fn has(&self, name: &str) -> bool {
        self.column(name).is_some()
    }

    /// Returns the index of a column, by its name or its alias.
    fn column(&self, name: &str) -> Option<usize> {
        let other = match name {
            "number" => "id",
            "vx" => "v_x",
            "vy" => "v_y",
            _ => name,
        };
        let find = |name: &str| self.names.iter().position(|found| found.trim().eq_ignore_ascii_case(name));
        find(name).or_else(|| find(other))
    }

    /// Reads the rows; `rate` is the frame rate (1 if times are seconds), `unit` the unit of length in metres.
    fn tracks(self, rate: f64, unit: f64) -> Result<Trajectories, FormatFlaw> {
        let column = |name: &str| self.column(name);
        let needed = |name: &str| column(name).ok_or_else(|| flaw(1, format!("there is no column `{name}`")));
        let [number, x, y] = [needed("number")?, needed("x")?, needed("y")?];
        let time = column("time").map_or_else(|| needed("frame"), Ok)?;
        let (group, z) = (column("group"), column("z"));
        let [vx, vy, vz] = ["vx", "vy", "vz"].map(column);
        let [heading, radius, status] = ["heading", "radius", "status"].map(column);
        let Self { names, records } = self;
        let mut tracks = Trajectories { unit: Some(unit), ..Trajectories::default() };
        for (line, fields) in records {
            if fields.len() < names.len() {
                return Err(flaw(
                    line,
                    format!("the row has {} fields, but there are {} names", fields.len(), names.len()),
                ));
            }
            let value = |at: usize| {
                let value = fields[at].trim().parse::<f64>().ok().filter(|value| value.is_finite());
                value.ok_or_else(|| flaw(line, format!("`{}` is no number for {}", fields[at], names[at])))
            };
            let length = |at: usize| value(at).map(|value| value * unit);
            let name = group.map_or("", |at| &*fields[at]);
            let name = name.strip_prefix('\'').filter(|name| is_formula(name)).unwrap_or(name);
            let group = tracks.setting.groups.iter().rposition(|other| other == name).unwrap_or_else(|| {
                tracks.setting.groups.push(name.to_owned());
                tracks.setting.groups.len() - 1
            });
            let place = DVec3::new(length(x)?, length(y)?, z.map_or(Ok(0.0), length)?);
            let of = fields[number]
                .trim()
                .parse()
                .map_err(|_| flaw(line, format!("`{}` is not an agent number", fields[number])))?;
            let or = |column: Option<usize>, or: f32| column.map_or(Ok(or), |at| length(at).map(|value| value as f32));
            let status = status.map_or(Ok(Status::Walking), |at| {
                let found = status_of(fields[at].trim());
                found.ok_or_else(|| flaw(line, format!("`{}` is no status", fields[at])))
            })?;
            let spot = Sample {
                number: of,
                group: group as u32,
                time: value(time)? / rate,
                place,
                velocity: Vec3::new(or(vx, 0.0)?, or(vy, 0.0)?, or(vz, 0.0)?),
                heading: heading.map_or(Ok(0.0), value)? as f32,
                radius: or(radius, RADIUS)?,
                status,
            };
            limits::row(&spot).map_err(|flaw| FormatFlaw { line: Some(line), ..flaw })?;
            tracks.spots.push(spot);
        }
        tracks.sort();
        tracks.complete(vx.is_none() || vy.is_none(), heading.is_none());
        Ok(tracks)
    }
}

/// The records of comma-separated values, with their first lines; empty lines are skipped.
struct CsvRecords<'a> {
    rest: &'a str,
    line: usize,
}

impl<'a> Iterator for CsvRecords<'a> {
    type Item = (usize, Vec<Cow<'a, str>>);

    fn next(&mut self) -> Option<Self::Item> {
        while let Some(rest) = self.rest.strip_prefix("\r\n").or_else(|| self.rest.strip_prefix('\n')) {
            self.rest = rest;
            self.line += 1;
        }
        if self.rest.is_empty() {
            return None;
        }
        let (start, mut fields) = (self.line, Vec::new());
        loop {
            let (field, rest) = field(self.rest);
            self.line += self.rest[..self.rest.len() - rest.len()].matches('\n').count();
            fields.push(field);
            match rest.strip_prefix(',') {
                Some(rest) => self.rest = rest,
                None => {
                    self.rest = rest;
                    return Some((start, fields));
                }
            }
        }
    }
}

/// Returns the first field of a text and the rest after it: a comma, a line end, or nothing.
fn field(text: &str) -> (Cow<'_, str>, &str) {
    let Some(mut quoted) = text.strip_prefix('"') else {
        let end = text.find([',', '\n']).unwrap_or(text.len());
        let (field, rest) = text.split_at(end);
        return (field.strip_suffix('\r').unwrap_or(field).into(), rest);
    };
    let mut value = String::new();
    while let Some((part, after)) = quoted.split_once('"') {
        value.push_str(part);
        match after.strip_prefix('"') {
            Some(after) => {
                value.push('"');
                quoted = after;
            }
            // text between the closing quote and the next comma is ignored
            None => return (value.into(), after.trim_start_matches(|c| c != ',' && c != '\n')),
        }
    }
    (value.into(), "")
}

#[cfg(test)]
mod tests {
    use super::super::CsvWriter;
    use super::*;
    use crate::{Body, Frame, Setting, Writer};

    fn parse(bytes: &[u8]) -> Result<Trajectories, (usize, String)> {
        let tracks = CsvTable::open(bytes).and_then(|table| table.tracks(1.0, 1.0));
        tracks.map_err(|flaw| (flaw.line.unwrap(), flaw.why))
    }

    fn body(number: u32, group: u32, place: DVec3) -> Body {
        Body { group, altitude: place.z as f32, ..Body::walking(number, place.truncate()) }
    }

    #[test]
    fn written_tables_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        for in_space in [false, true] {
            let groups = vec!["a, \"b\"\nc".into(), "midges".into()];
            let setting = Setting { groups: groups.clone(), in_space, ..Setting::default() };
            let mut writer = CsvWriter::create(&path, &setting).unwrap();
            let place = |k: u32| DVec3::new(0.1 * f64::from(k), -2.0, 1.5);
            for k in 0..3 {
                let bodies = vec![body(4, 0, place(k)), body(9, 1, place(k + 5))];
                writer.push(&Frame { time: f64::from(k) * 0.1, bodies, ..Frame::default() }).unwrap();
            }
            writer.finish().unwrap();
            let tracks = Trajectories::read(&path).unwrap();
            assert_eq!(tracks.setting.groups, groups);
            let moments: Vec<_> = tracks.moments(1).collect();
            let want = if in_space { place(6) } else { place(6).with_z(0.0) };
            assert_eq!((moments.len(), &moments[1]), (3, &(0.1, vec![(9, want)])));
        }
    }

    #[test]
    fn no_name_of_a_group_is_a_formula_and_all_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        let names = ["=1+1", "+1", "-1", "@SUM(1)", "\tx", "\r=1", "'=1", "''-", "'quoted'", "a=b", "=\"a\",b"];
        let setting = Setting { groups: names.map(str::to_owned).into(), ..Setting::default() };
        let mut writer = CsvWriter::create(&path, &setting).unwrap();
        let bodies = (0..names.len() as u32).map(|k| body(k, k, DVec3::new(-1.0, 0.0, 0.0))).collect();
        writer.push(&Frame { bodies, ..Frame::default() }).unwrap();
        writer.finish().unwrap();
        let mut cells = csv::Reader::from_path(&path).unwrap();
        for row in cells.records().map(Result::unwrap) {
            assert!(!row[1].starts_with(['=', '+', '-', '@', '\t', '\r']), "{row:?}");
            assert_eq!(&row[3], "-1", "numbers stay as they are");
        }
        assert_eq!(Trajectories::read(&path).unwrap().setting.groups, names);
    }

    #[test]
    fn missing_columns_are_computed() {
        let tracks = parse(b"number,time,x,y\n3,0,0,0\n3,0.5,0,1\n3,1,0,1\n").unwrap();
        let found: Vec<_> = tracks.spots.iter().map(|spot| (spot.velocity, spot.heading)).collect();
        let north = std::f32::consts::FRAC_PI_2;
        assert_eq!(found, [(Vec3::ZERO, 0.0), (Vec3::Y * 2.0, north), (Vec3::ZERO, north)]);
        assert_eq!((tracks.spots[0].radius, tracks.spots[0].status), (RADIUS, Status::Walking));
        let tracks = parse(b"number,time,x,y,status,radius\n3,0,0,0,arrived,0.3\n").unwrap();
        assert_eq!((tracks.spots[0].radius, tracks.spots[0].status), (0.3, Status::Arrived));
        assert!(Trajectories::are_in("a/b.CSV") && !Trajectories::are_in("a.toml") && !Trajectories::are_in("csv"));
    }

    #[test]
    fn frames_are_read_with_a_frame_rate() {
        let bytes = b"ID,Frame,x,y,v_x,v_y\n21,1010,50,-10,100,0\n";
        let missing = read(bytes, &Reading::default()).unwrap_err();
        assert!(missing.hint.unwrap().contains("--frame-rate") && missing.line.is_none());
        let spot = read(bytes, &Reading { rate: Some(25.0), unit: Some(0.01) }).unwrap().spots[0];
        assert_eq!((spot.number, spot.time, spot.place), (21, 40.4, DVec3::new(0.5, -0.1, 0.0)));
        assert_eq!((spot.velocity, spot.radius), (Vec3::X, RADIUS));
    }

    #[test]
    fn mistakes_are_named_with_their_lines() {
        let wrong = |text: &str| parse(text.as_bytes()).unwrap_err();
        assert_eq!(wrong(""), (1, "it is empty".into()));
        assert_eq!(wrong("number,time,x\n"), (1, "there is no column `y`".into()));
        assert_eq!(wrong("number,time,x,y\r\n1,0,0\r\n"), (2, "the row has 3 fields, but there are 4 names".into()));
        assert_eq!(wrong("number,time,x,y\n\n1,0,0,0\n1,nan,0,0\n").0, 4);
        assert!(wrong("number,time,x,y\n-1,0,0,0\n").1.contains("`-1` is not an agent number"));
        let text = "\u{feff}x , y,time,number,group\n1,2,3,4,\"a\nb\"\n5,6,1,4,c";
        let tracks = parse(text.as_bytes()).unwrap();
        assert_eq!(tracks.setting.groups, ["a\nb", "c"]);
        assert_eq!((tracks.spots[0].place, tracks.spots[0].group), (DVec3::new(5.0, 6.0, 0.0), 1));
        assert_eq!(wrong(&format!("{text},,,\n\"x\",1,1,1,1")).0, 5);
        assert!(parse(b"number,time,x,y\n\"").is_err());
        assert_eq!(parse(b"number,time,x,y\n1,0,0,\xff\n"), Err((2, "the file is not text".into())));
        assert!(wrong("number,time,x,y,status\n1,0,0,0,lost\n").1.contains("`lost` is no status"));
        let missing = Trajectories::read("no/such/file.csv").unwrap_err().to_string();
        assert!(missing.starts_with("cannot read no/such/file.csv: "), "{missing}");
    }
}
