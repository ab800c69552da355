//! Writes JuPedSim's database.

use super::ground;
use crate::formats::{Writer, describe, rate::Rate};
use crate::{Frame, Output, OutputError, Setting};
use glam::DVec2;
use rusqlite::{Connection, OpenFlags, params};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Write};

/// The version of the layout.
const VERSION: u32 = 2;

/// Rows per transaction.
const ROWS: usize = 1 << 16;

/// SQLite's file access without locks: the output has locked the file already.
const WITHOUT_LOCKS: &str = if cfg!(windows) { "win32-none" } else { "unix-none" };

const TABLES: &str = "
    PRAGMA journal_mode = OFF;
    PRAGMA synchronous = OFF;
    BEGIN;
    CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT NULL, pos_y REAL NOT NULL,
        ori_x REAL NOT NULL, ori_y REAL NOT NULL);
    CREATE INDEX frame_id_idx ON trajectory_data(frame, id);
    CREATE TABLE metadata (key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);
    CREATE TABLE geometry (hash INTEGER NOT NULL, wkt TEXT NOT NULL);
    CREATE UNIQUE INDEX geometry_hash ON geometry(hash);
    CREATE TABLE frame_data (frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);
    CREATE TABLE throng_moment (frame INTEGER PRIMARY KEY, time REAL NOT NULL);
    CREATE TABLE throng_agent (id INTEGER PRIMARY KEY, name TEXT NOT NULL, radius REAL NOT NULL);";

/// Writes trajectories during a run. The [module](super) describes the tables.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run.sqlite");
/// use throng_record::formats::sqlite::SqliteWriter;
/// use throng_record::{Frame, Output, Setting, Writer};
/// let mut writer = SqliteWriter::new(Output::create(&path)?, &Setting::default())?;
/// writer.push(&Frame::default())?;
/// Box::new(writer).finish()?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SqliteWriter {
    /// Declared before the output, so that it is closed before the file is removed.
    database: Connection,
    output: Output,
    setting: Setting,
    frame: i64,
    rate: Rate,
    /// Agents that have a row in `throng_agent`.
    known: BTreeSet<u32>,
    /// Corners of the bounding box of all positions.
    seen: [DVec2; 2],
    /// Rows of the current transaction.
    rows: usize,
}

impl SqliteWriter {
    /// Starts a database in the file of `output`.
    ///
    /// # Errors
    /// A system error, such as a full disk; [`OutputError::Io`] if `output` is not a regular file.
    pub fn new(output: Output, setting: &Setting) -> Result<Self, OutputError> {
        let no_file = || io::Error::new(io::ErrorKind::Unsupported, "a database needs a file; name one");
        let path = output.own_file().ok_or_else(|| output.error(no_file()))?;
        let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let database = Connection::open_with_flags_and_vfs(path, flags, WITHOUT_LOCKS)
            .and_then(|database| database.execute_batch(TABLES).map(|()| database))
            .map_err(|error| failed(&output, error))?;
        Ok(Self {
            database,
            output,
            setting: setting.clone(),
            frame: 0,
            rate: Rate::default(),
            known: BTreeSet::new(),
            seen: [DVec2::INFINITY, DVec2::NEG_INFINITY],
            rows: 0,
        })
    }

    fn add(&mut self, frame: &Frame) -> rusqlite::Result<()> {
        let database = &self.database;
        database.execute("INSERT INTO throng_moment VALUES (?, ?)", params![self.frame, frame.time])?;
        let mut row = database.prepare("INSERT INTO trajectory_data VALUES (?, ?, ?, ?, ?, ?)")?;
        let mut agent = database.prepare("INSERT INTO throng_agent VALUES (?, ?, ?)")?;
        for body in &frame.bodies {
            if self.known.insert(body.number) {
                let name = self.setting.group_name(body.group);
                agent.execute(params![body.number, name, body.shape().clearance_radius()])?;
            }
            let (at, facing) = (body.position, DVec2::from_angle(f64::from(body.heading)));
            row.execute(params![self.frame, body.number, at.x, at.y, facing.x, facing.y])?;
            self.seen = [self.seen[0].min(at), self.seen[1].max(at)];
        }
        self.rows += frame.bodies.len() + 1;
        if self.rows > ROWS {
            self.rows = 0;
            database.execute_batch("COMMIT; BEGIN;")?;
        }
        self.rate.push(frame.time);
        self.frame += 1;
        Ok(())
    }

    /// Writes the data that depend on all frames.
    fn describe(&self) -> rusqlite::Result<()> {
        let database = &self.database;
        let wkt = ground::free(&self.setting, self.seen);
        let hash = i64::from(crc32fast::hash(wkt.as_bytes()));
        database.execute("INSERT INTO geometry VALUES (?, ?)", params![hash, wkt])?;
        database.execute("INSERT INTO frame_data SELECT frame, ? FROM throng_moment", [hash])?;
        let [low, high] = bounds(&wkt).unwrap_or(self.seen);
        // a single frame has no rate, but readers require one
        let rate = self.rate.mean().unwrap_or(1.0);
        let theirs = [("version", f64::from(VERSION)), ("fps", rate)];
        let bounds = [("xmin", low.x), ("xmax", high.x), ("ymin", low.y), ("ymax", high.y)];
        let theirs = theirs.into_iter().chain(bounds).map(|(key, value)| (key, value.to_string()));
        let mut pair = database.prepare("INSERT INTO metadata VALUES (?, ?)")?;
        for (key, value) in theirs.chain(describe::pairs(&self.setting)) {
            pair.execute([key, &value])?;
        }
        database.execute_batch("COMMIT")
    }
}

impl Writer for SqliteWriter {
    fn push(&mut self, frame: &Frame) -> Result<(), OutputError> {
        self.add(frame).map_err(|error| failed(&self.output, error))
    }

    fn finish(self: Box<Self>) -> Result<(), OutputError> {
        self.describe().map_err(|error| failed(&self.output, error))?;
        let Self { database, output, .. } = *self;
        database.close().map_err(|(_, error)| failed(&output, error))?;
        output.finish()
    }
}

/// Returns the corners of the bounding box of a geometry.
fn bounds(wkt: &str) -> Option<[DVec2; 2]> {
    let (areas, _) = crate::formats::place::read(wkt).ok()?;
    let corners = areas.iter().flat_map(|area| &area.outer).copied();
    corners.map(|p| [p, p]).reduce(|[low, high], [p, _]| [low.min(p), high.max(p)])
}

/// Converts an error of SQLite to an error of the output.
fn failed(output: &Output, error: rusqlite::Error) -> OutputError {
    use rusqlite::ErrorCode::{DiskFull, PermissionDenied, ReadOnly, SystemIoFailure};
    output.error(match error.sqlite_error_code() {
        Some(DiskFull) => io::ErrorKind::StorageFull.into(),
        Some(PermissionDenied | ReadOnly) => io::ErrorKind::PermissionDenied.into(),
        Some(SystemIoFailure) => refusal(output).unwrap_or_else(|| io::Error::other(error)),
        _ => io::Error::other(error),
    })
}

/// Returns the system's error when the file grows: SQLite does not report why a file cannot grow.
fn refusal(output: &Output) -> Option<io::Error> {
    let mut file = File::options().append(true).open(output.own_file()?).ok()?;
    file.write_all(&[0; 1 << 16]).err()
}
