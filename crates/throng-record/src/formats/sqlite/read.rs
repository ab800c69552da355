//! Reads JuPedSim's database.

use crate::formats::names::Names;
use crate::formats::{FormatFlaw, Reading, describe, place};
use crate::trajectories::{RADIUS, Sample, Trajectories};
use glam::{DVec3, Vec3};
use rusqlite::limits::Limit;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, Row};
use std::collections::HashMap;
use throng::Status;

const HINT: &str = "supported are JuPedSim's trajectories, versions 1 to 3, with the tables trajectory_data, metadata and geometry, as \
                    `throng run -o NAME.sqlite` writes them";

/// Reads a database that throng or JuPedSim wrote.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<Trajectories, FormatFlaw> {
    parse(bytes, reading).map_err(|SqliteFlaw(why)| FormatFlaw { line: None, why, hint: Some(HINT) })
}

struct SqliteFlaw(String);

impl From<rusqlite::Error> for SqliteFlaw {
    fn from(error: rusqlite::Error) -> Self {
        Self(format!("the file is not an SQLite database, or is damaged: {error}"))
    }
}

impl From<String> for SqliteFlaw {
    fn from(why: String) -> Self {
        Self(why)
    }
}

/// The group and the radius of each agent.
type Agents = HashMap<u32, (u32, f32)>;

fn parse(bytes: &[u8], reading: &Reading) -> Result<Trajectories, SqliteFlaw> {
    if !bytes.starts_with(b"SQLite format 3\0") {
        return Err(SqliteFlaw("the file does not begin like an SQLite database".to_owned()));
    }
    if size(bytes).is_none_or(|size| size > bytes.len() as u64) {
        return Err(SqliteFlaw("the file is cut off: a part is missing".to_owned()));
    }
    let mut database = Connection::open_in_memory()?;
    database.deserialize_read_exact("main", bytes, bytes.len(), true)?;
    // expressions within the file's schema are not trusted
    database.execute_batch("PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON;")?;

    // No value may have more bytes than the file: a column may compute a value of any size.
    let longest = i32::try_from(bytes.len()).unwrap_or(i32::MAX);
    database.set_limit(Limit::SQLITE_LIMIT_LENGTH, longest)?;
    // the tables must not be views, which may never return a row
    if let Some(table) = ["trajectory_data", "metadata"].iter().find(|table| !has(&database, table).unwrap_or(false)) {
        return Err(SqliteFlaw(format!("the database has no table {table}")));
    }

    let mut names = Names::default();
    let metadata = metadata(&database, bytes.len())?;
    let value = |key: &str| metadata.get(key).cloned();
    let mut tracks = Trajectories { setting: describe::setting(value, &mut names)?, ..Trajectories::default() };
    if let Some(version) = value("version").filter(|version| !["1", "2", "3"].contains(&version.as_str())) {
        return Err(SqliteFlaw(format!("the database has the unsupported version {version}")));
    }
    if tracks.setting.walkable.is_empty() && !metadata.contains_key(crate::formats::keys::WALKABLE) {
        tracks.setting.walkable = ground(&database)?;
    }
    let rate = reading.rate.or_else(|| value("fps")?.parse().ok()).filter(|rate| *rate > 0.0);
    let (times, agents) = (times(&database, bytes.len())?, agents(&database, &mut names, bytes.len())?);
    let unit = reading.unit.unwrap_or(1.0);
    // version 3 has no orientations
    let faces = columns(&database, "trajectory_data", &["ori_x", "ori_y"])?;
    let ways = if faces { "ori_x, ori_y" } else { "1, 0" };
    let mut query = database.prepare(&format!("SELECT frame, id, pos_x, pos_y, {ways} FROM trajectory_data"))?;
    let mut rows = query.query([])?;
    while let Some(row) = rows.next()? {
        few(tracks.spots.len(), bytes.len())?;
        let (frame, number): (f64, u32) = (number_of(row, 0)?, row.get(1)?);
        let time = times.get(&(frame as i64)).copied().or(rate.map(|rate| frame / rate));
        let time = time.ok_or_else(|| "the file does not state its frame rate".to_owned())?;
        let place = DVec3::new(number_of(row, 2)?, number_of(row, 3)?, 0.0) * unit;
        let (group, radius) = match agents.get(&number) {
            Some(&agent) => agent,
            None => (names.index(""), RADIUS),
        };
        tracks.spots.push(Sample {
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
    tracks.complete(true, !faces);
    Ok(tracks)
}

/// Returns the size that a database states, bytes.
fn size(bytes: &[u8]) -> Option<u64> {
    let page = u16::from_be_bytes(bytes.get(16..18)?.try_into().ok()?);
    // 1 stands for 65,536, which does not fit into two bytes
    let page = if page == 1 { 1 << 16 } else { u64::from(page) };
    let pages = u32::from_be_bytes(bytes.get(28..32)?.try_into().ok()?);
    Some(page * u64::from(pages))
}

/// Checks that a file of `bytes` bytes may have another row: a view can produce any number of rows.
fn few(rows: usize, bytes: usize) -> Result<(), SqliteFlaw> {
    if rows < bytes {
        Ok(())
    } else {
        Err(SqliteFlaw("the file has more rows than fit into a file of its size".to_owned()))
    }
}

/// Returns a finite number.
fn number_of(row: &Row<'_>, column: usize) -> Result<f64, SqliteFlaw> {
    let value = match row.get_ref(column)? {
        ValueRef::Integer(value) => value as f64,
        ValueRef::Real(value) => value,
        _ => f64::NAN,
    };
    if value.is_finite() { Ok(value) } else { Err(SqliteFlaw("a value of trajectory_data is no number".to_owned())) }
}

/// Whether a table exists.
fn has(database: &Connection, table: &str) -> Result<bool, SqliteFlaw> {
    let query = "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = ?";
    Ok(database.query_row(query, [table], |row| row.get::<_, i64>(0))? > 0)
}

/// Whether a table has all these columns.
fn columns(database: &Connection, table: &str, names: &[&str]) -> Result<bool, SqliteFlaw> {
    let mut query = database.prepare("SELECT count(*) FROM pragma_table_info(?) WHERE name = ?")?;
    let mut all = true;
    for name in names {
        all &= query.query_row([table, name], |row| row.get::<_, i64>(0))? > 0;
    }
    Ok(all)
}

fn metadata(database: &Connection, bytes: usize) -> Result<HashMap<String, String>, SqliteFlaw> {
    let mut pairs = HashMap::new();
    let mut query = database.prepare("SELECT key, CAST(value AS TEXT) FROM metadata")?;
    let mut rows = query.query([])?;
    while let Some(row) = rows.next()? {
        few(pairs.len(), bytes)?;
        pairs.insert(row.get(0)?, row.get(1)?);
    }
    Ok(pairs)
}

/// Returns the areas of all geometries.
fn ground(database: &Connection) -> Result<Vec<throng::Walkable>, SqliteFlaw> {
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

/// Returns the times of frames; empty unless throng wrote the file.
fn times(database: &Connection, bytes: usize) -> Result<HashMap<i64, f64>, SqliteFlaw> {
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

/// Returns groups and radii; empty unless throng wrote the file.
fn agents(database: &Connection, names: &mut Names, bytes: usize) -> Result<Agents, SqliteFlaw> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::FRAC_PI_2;

    /// Reads JuPedSim's version 3, which lacks `ori_x` and `ori_y`.
    #[test]
    fn agents_without_orientations_face_along_their_velocity() {
        let mut database = Connection::open_in_memory().unwrap();
        let text = "CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT NULL, pos_y REAL NOT NULL);
            CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);
            CREATE TABLE geometry(hash INTEGER NOT NULL, wkt TEXT NOT NULL);
            CREATE TABLE frame_data(frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);
            INSERT INTO metadata VALUES ('version', 3), ('fps', 2.0);
            INSERT INTO geometry VALUES (7, 'POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0))');
            INSERT INTO trajectory_data VALUES (0, 1, 1.0, 1.0), (0, 4, 5.0, 1.0), (1, 1, 1.5, 1.0), (1, 4, 5.0, 1.25);";
        database.execute_batch(text).unwrap();
        let bytes = database.serialize("main").unwrap();
        let tracks = read(&bytes, &Reading::default()).unwrap();
        let seen: Vec<_> =
            tracks.spots.iter().map(|spot| (spot.number, spot.time, spot.place.x, spot.place.y)).collect();
        assert_eq!(seen, [(1, 0.0, 1.0, 1.0), (4, 0.0, 5.0, 1.0), (1, 0.5, 1.5, 1.0), (4, 0.5, 5.0, 1.25)]);
        let last = &tracks.spots[2..];
        assert_eq!([last[0].velocity.x, last[1].velocity.y], [1.0, 0.5]);
        assert!(last[0].heading.abs() < 1e-6 && (last[1].heading - FRAC_PI_2).abs() < 1e-6);
        assert_eq!(tracks.setting.walkable.len(), 1);
    }
}
