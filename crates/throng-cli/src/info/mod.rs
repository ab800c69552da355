//! `throng info`: reports on a file of trajectories.

pub mod args;

use crate::failure::Failure;
use crate::measure::short;
use crate::out::{Out, note};
use crate::progress::waiting;
use crate::report::number;
use args::InfoArgs;
use glam::DVec3;
use serde_json::{Value, json};
use std::fmt::Write;
use throng_record::pedestrian::{Area, People, median};
use throng_record::swarm::Distribution;
use throng_record::{Format, Trajectories, TrajectoriesError};

/// Writes a report on a file to standard output.
///
/// # Errors
/// The file cannot be read.
pub fn info(args: &InfoArgs, out: &mut Out) -> Result<(), Failure> {
    let path = &args.file;
    let bytes = std::fs::read(path).map_err(|source| TrajectoriesError::File { path: path.clone(), source })?;
    let doing = format!("reading {}", path.display());
    let tracks = waiting(false, &doing, || Trajectories::of_file(path, &bytes, &args.tracks.reading()))?;
    note(&tracks.notes);
    let format = Format::of_file(path, &bytes).map_or("", |format| format.title);
    let info = Info::of(path.display().to_string(), format, &tracks);
    if args.json { out.line(format_args!("{}", info.json())) } else { out.text(info.text().as_bytes()) }
}

/// The report on a file.
struct Info {
    file: String,
    format: &'static str,
    groups: Vec<(String, usize)>,
    people: usize,
    rows: usize,
    moments: usize,
    span: Option<[f64; 2]>,
    interval: f64,
    unit: f64,
    /// The corners of the bounding box of all people.
    extent: [DVec3; 2],
    speed: Distribution,
    median: f64,
    /// The size, number of corners and number of holes of each area.
    walkable: Vec<(f64, usize, usize)>,
    obstacles: usize,
}

impl Info {
    fn of(file: String, format: &'static str, tracks: &Trajectories) -> Self {
        let people = People::of(tracks, |_| true);
        let members = |group: usize| People::of(tracks, |spot| spot.group as usize == group).walks.len();
        let names = tracks.setting.groups.iter().enumerate();
        let mut speed = Distribution::default();
        let speeds: Vec<f64> = tracks.spots.iter().map(|spot| spot.velocity.length().into()).collect();
        speeds.iter().for_each(|&value| speed.add(value));
        let places = tracks.spots.iter().map(|spot| spot.place);
        let start = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let size = |ring: &Vec<glam::DVec2>| Area::new(ring.clone()).map_or(0.0, |area| area.size());
        Self {
            file,
            format,
            groups: names.map(|(group, name)| (name.clone(), members(group))).collect(),
            people: people.walks.len(),
            rows: tracks.spots.len(),
            moments: people.moments.len(),
            span: people.moments.first().zip(people.moments.last()).map(|(first, last)| [first.time, last.time]),
            interval: people.interval(),
            unit: tracks.unit.unwrap_or(1.0),
            extent: places.fold(start, |[low, high], place| [low.min(place), high.max(place)]),
            speed,
            median: median(speeds),
            walkable: (tracks.setting.walkable.iter())
                .map(|area| {
                    let corners = area.outer.len() + area.holes.iter().map(Vec::len).sum::<usize>();
                    (size(&area.outer) - area.holes.iter().map(size).sum::<f64>(), corners, area.holes.len())
                })
                .collect(),
            obstacles: tracks.setting.obstacles.len(),
        }
    }

    fn json(&self) -> Value {
        let [low, high] = self.extent;
        let (extent, height) = ([low.x, low.y, high.x, high.y].map(number), [low.z, high.z].map(number));
        let groups = self.groups.iter().map(|(name, people)| json!({ "name": name, "people": people }));
        let walkable = self
            .walkable
            .iter()
            .map(|&(size, corners, holes)| json!({ "size": number(size), "corners": corners, "holes": holes }));
        json!({
            "file": self.file,
            "format": self.format,
            "people": self.people,
            "groups": groups.collect::<Vec<_>>(),
            "rows": self.rows,
            "moments": self.moments,
            "from": self.span.map(|[from, _]| from),
            "to": self.span.map(|[_, to]| to),
            "frame_rate": number(1.0 / self.interval),
            "unit": self.unit,
            "extent": extent,
            "height": height,
            "speed": {
                "mean": number(self.speed.mean()),
                "sd": number(self.speed.deviation()),
                "least": number(self.speed.least()),
                "most": number(self.speed.most()),
                "median": number(self.median),
            },
            "walkable": walkable.collect::<Vec<_>>(),
            "obstacles": self.obstacles,
        })
    }

    fn text(&self) -> String {
        let mut out = format!("{}: {}\n", self.file, self.format);
        let named: Vec<String> = (self.groups.iter())
            .filter(|(name, _)| !name.is_empty())
            .map(|(name, people)| format!("{name} {people}"))
            .collect();
        let named = if named.is_empty() { String::new() } else { format!(" ({})", named.join(", ")) };
        let [from, to] = self.span.unwrap_or([f64::NAN; 2]);
        let [low, high] = self.extent;
        // Writing to a string does not fail.
        let _ = writeln!(out, "  people     {}{named}", self.people);
        let _ = writeln!(out, "  moments    {} from {from:.2} to {to:.2} s, {} rows", self.moments, self.rows);
        let _ = writeln!(out, "  frames     {} a second", short(1.0 / self.interval));
        let unit = if self.unit == 1.0 { "metres".to_owned() } else { format!("{} m", self.unit) };
        let _ = writeln!(out, "  unit       {unit}");
        let _ = writeln!(out, "  extent     x {:.2} to {:.2} m, y {:.2} to {:.2} m", low.x, high.x, low.y, high.y);
        if low.z != 0.0 || high.z != 0.0 {
            let _ = writeln!(out, "  height     {:.2} to {:.2} m", low.z, high.z);
        }
        let [mean, sd, median, most] =
            [self.speed.mean(), self.speed.deviation(), self.median, self.speed.most()].map(short);
        let _ = writeln!(out, "  speed      mean {mean} m/s (sd {sd}), median {median}, most {most}");
        for (size, corners, holes) in &self.walkable {
            let _ = writeln!(out, "  walkable   {} m², {corners} corners, {holes} holes", short(*size));
        }
        if self.obstacles > 0 {
            let _ = writeln!(out, "  obstacles  {}", self.obstacles);
        }
        out
    }
}
