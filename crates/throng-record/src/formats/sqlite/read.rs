//! JuPedSim's database read.

use crate::formats::names::Names;
use crate::formats::{Flaw, Reading, describe, place};
use crate::tracks::{RADIUS, Spot, Tracks};
use glam::{DVec3, Vec3};
use rusqlite::types::ValueRef;
use rusqlite::{Connection, Row};
use std::collections::HashMap;
use throng::Status;

const HINT: &str = "what is read are JuPedSim's trajectories, versions 1 and 2, with the tables trajectory_data, metadata and geometry, as \
                    `throng run -o NAME.sqlite` writes them";

/// Reads a database, ours or JuPedSim's.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<Tracks, Flaw> {
    parse(bytes, reading).map_err(|Wrong(why)| Flaw { line: None, why, hint: Some(HINT) })
}

struct Wrong(String);

impl From<rusqlite::Error> for Wrong {
    fn from(error: rusqlite::Error) -> Self {
        Self(format!("it is no SQLite database, or a broken one: {error}"))
    }
}

impl From<String> for Wrong {
    fn from(why: String) -> Self {
        Self(why)
    }
}

/// Of one agent what does not change.
type Agents = HashMap<u32, (u32, f32)>;

fn parse(bytes: &[u8], reading: &Reading) -> Result<Tracks, Wrong> {
    if !bytes.starts_with(b"SQLite format 3\0") {
        return Err(Wrong("it does not begin as SQLite databases do".to_owned()));
    }
    if size(bytes).is_none_or(|size| size > bytes.len() as u64) {
        return Err(Wrong("it is cut: a part is missing".to_owned()));
    }
    let mut database = Connection::open_in_memory()?;
    database.deserialize_read_exact("main", bytes, bytes.len(), true)?;
    // what a file says of itself is not run
    database.execute_batch("PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON;")?;

    let mut names = Names::default();
    let metadata = metadata(&database, bytes.len())?;
    let value = |key: &str| metadata.get(key).cloned();
    let mut tracks = Tracks { setting: describe::setting(value, &mut names)?, ..Tracks::default() };
    if let Some(version) = value("version").filter(|version| !["1", "2"].contains(&version.as_str())) {
        return Err(Wrong(format!("it is of version {version}")));
    }
    if tracks.setting.walkable.is_empty() && !metadata.contains_key(crate::formats::keys::WALKABLE) {
        tracks.setting.walkable = ground(&database)?;
    }
    let rate = reading.rate.or_else(|| value("fps")?.parse().ok()).filter(|rate| *rate > 0.0);
    let (times, agents) = (times(&database, bytes.len())?, agents(&database, &mut names, bytes.len())?);
    let unit = reading.unit.unwrap_or(1.0);
    let mut query = database.prepare("SELECT frame, id, pos_x, pos_y, ori_x, ori_y FROM trajectory_data")?;
    let mut rows = query.query([])?;
    while let Some(row) = rows.next()? {
        few(tracks.spots.len(), bytes.len())?;
        let (frame, number): (f64, u32) = (number_of(row, 0)?, row.get(1)?);
        let time = times.get(&(frame as i64)).copied().or(rate.map(|rate| frame / rate));
        let time = time.ok_or_else(|| "it does not say how many frames are a second".to_owned())?;
        let place = DVec3::new(number_of(row, 2)?, number_of(row, 3)?, 0.0) * unit;
        let (group, radius) = match agents.get(&number) {
            Some(&agent) => agent,
            None => (names.index(""), RADIUS),
        };
        tracks.spots.push(Spot {
            number,
            group,
            time,
            place,
            velocity: Vec3::ZERO,
            heading: number_of(row, 5)?.atan2(number_of(row, 4)?) as f32,
            radius,
            status: Status::Walking,
        });
    }
    tracks.setting.groups = names.into_names();
    tracks.sort();
    tracks.complete(true, false);
    Ok(tracks)
}

/// How many bytes a database says it has.
fn size(bytes: &[u8]) -> Option<u64> {
    let page = u16::from_be_bytes(bytes.get(16..18)?.try_into().ok()?);
    // what does not fit into two bytes is said so
    let page = if page == 1 { 1 << 16 } else { u64::from(page) };
    let pages = u32::from_be_bytes(bytes.get(28..32)?.try_into().ok()?);
    Some(page * u64::from(pages))
}

/// That a file of so many bytes may have another row: a view can make any number of them.
fn few(rows: usize, bytes: usize) -> Result<(), Wrong> {
    if rows < bytes { Ok(()) } else { Err(Wrong("it has more rows than fit into a file of this size".to_owned())) }
}

/// A number that is one.
fn number_of(row: &Row<'_>, column: usize) -> Result<f64, Wrong> {
    let value = match row.get_ref(column)? {
        ValueRef::Integer(value) => value as f64,
        ValueRef::Real(value) => value,
        _ => f64::NAN,
    };
    if value.is_finite() { Ok(value) } else { Err(Wrong("a value of trajectory_data is no number".to_owned())) }
}

/// Whether there is such a table.
fn has(database: &Connection, table: &str) -> Result<bool, Wrong> {
    let query = "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = ?";
    Ok(database.query_row(query, [table], |row| row.get::<_, i64>(0))? > 0)
}

fn metadata(database: &Connection, bytes: usize) -> Result<HashMap<String, String>, Wrong> {
    let mut pairs = HashMap::new();
    let mut query = database.prepare("SELECT key, CAST(value AS TEXT) FROM metadata")?;
    let mut rows = query.query([])?;
    while let Some(row) = rows.next()? {
        few(pairs.len(), bytes)?;
        pairs.insert(row.get(0)?, row.get(1)?);
    }
    Ok(pairs)
}

/// The areas of all geometries.
fn ground(database: &Connection) -> Result<Vec<throng::Walkable>, Wrong> {
    let mut areas = Vec::new();
    if has(database, "geometry")? {
        let mut query = database.prepare("SELECT wkt FROM geometry")?;
        let mut rows = query.query([])?;
        while let Some(row) = rows.next()? {
            areas.extend(place::read(&row.get::<_, String>(0)?)?.0);
        }
    }
    Ok(areas)
}

/// The times of frames, where the file has our table of them.
fn times(database: &Connection, bytes: usize) -> Result<HashMap<i64, f64>, Wrong> {
    let mut times = HashMap::new();
    if has(database, "throng_moment")? {
        let mut query = database.prepare("SELECT frame, time FROM throng_moment")?;
        let mut rows = query.query([])?;
        while let Some(row) = rows.next()? {
            few(times.len(), bytes)?;
            times.insert(row.get(0)?, number_of(row, 1)?);
        }
    }
    Ok(times)
}

/// Groups and radii, where the file has our table of them.
fn agents(database: &Connection, names: &mut Names, bytes: usize) -> Result<Agents, Wrong> {
    let mut agents = HashMap::new();
    if has(database, "throng_agent")? {
        let mut query = database.prepare("SELECT id, name, radius FROM throng_agent")?;
        let mut rows = query.query([])?;
        while let Some(row) = rows.next()? {
            few(agents.len(), bytes)?;
            let group = names.index(&row.get::<_, String>(1)?);
            agents.insert(row.get(0)?, (group, number_of(row, 2)? as f32));
        }
    }
    Ok(agents)
}
