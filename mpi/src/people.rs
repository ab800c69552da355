//! People from Parquet files: each rank keeps a share of them.

use crate::failure::Failure;
use crate::ranks::Ranks;
use glam::DVec2;
use parquet::column::reader::ColumnReader;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use throng::{Agent, Goal, GroupId, Journey, JourneyId, Stop, World};
use throng_scene::Scene;

/// Half of the side of the square at a goal in which people leave, metres.
const EXIT: f64 = 0.75;
/// Distance from a goal at which people have arrived, metres.
const TOLERANCE: f32 = 0.5;

/// The columns of a file.
const COLUMNS: [&str; 7] = ["x", "y", "goal_x", "goal_y", "time", "leaves", "speed"];
/// How many of them every file must have.
const NEEDED: usize = 4;

/// The rows of a row group, by column; columns that are not there are empty.
type Rows = [Vec<f64>; COLUMNS.len()];

/// People that are added to the worlds of all ranks.
pub struct People<'a> {
    scene: &'a Scene,
    group: GroupId,
    ranks: &'a Ranks,
    /// The number of people in all files.
    all: u64,
    /// People with equal goals share a journey.
    journeys: BTreeMap<[u64; 3], JourneyId>,
}

impl<'a> People<'a> {
    /// Adds the people of files to a world without agents: to that of each rank an equal share of those that are there from
    /// the start, and to all ranks those that enter later. They face their goals.
    ///
    /// # Errors
    /// A file is not a table of people, or the world refuses a person; the file and the row are named.
    pub fn add(
        files: &[PathBuf],
        scene: &'a Scene,
        group: GroupId,
        ranks: &'a Ranks,
        world: &mut World,
    ) -> Result<(), Failure> {
        let open = files.iter().map(|path| open(path)).collect::<Result<Vec<_>, _>>()?;
        let all: u64 = open.iter().map(|file| file.metadata().file_metadata().num_rows().max(0) as u64).sum();
        if all >= u64::from(u32::MAX) {
            let text = format!("the files hold {all} people, and a crowd has at most 4,294,967,294");
            return Err(Failure::hint(text, "use fewer people"));
        }
        let mut people = Self { scene, group, ranks, all, journeys: BTreeMap::new() };
        world.reserve(all as usize / ranks.count() + 1);
        let mut number = 0;
        for (path, file) in files.iter().zip(open) {
            let columns = columns(path, &file)?;
            for index in 0..file.num_row_groups() {
                let group = file.get_row_group(index).map_err(|error| damaged(path, &error))?;
                let rows = rows(path, &*group, &columns)?;
                people.add_rows(path, &rows, number, world)?;
                number += rows[0].len() as u32;
            }
        }
        Ok(())
    }

    fn add_rows(&mut self, path: &Path, rows: &Rows, first: u32, world: &mut World) -> Result<(), Failure> {
        for row in 0..rows[0].len() {
            let [x, y, goal_x, goal_y, time, leaves, speed] =
                std::array::from_fn(|column| rows[column].get(row).copied());
            let number = first + row as u32;
            let refused = |error: throng::Error| {
                Failure::Here(format!(
                    "{}: the world refuses person {number} (row {row} of a row group): {error}",
                    path.display()
                ))
            };
            let (at, goal) = (pair(x, y), pair(goal_x, goal_y));
            // every rank knows all journeys, in the same order
            let journey = self.journey(goal, leaves.is_some_and(|leaves| leaves != 0.0), world).map_err(refused)?;
            let enters = time.filter(|&time| time > 0.0);
            let owner = u64::from(number) * self.ranks.count() as u64 / self.all.max(1);
            if enters.is_none() && owner != self.ranks.rank() as u64 {
                continue;
            }
            let agent = self.scene.agent_of(0, number as usize);
            let ahead = goal - at;
            let is_disc = agent.core == glam::Vec2::ZERO;
            let heading = agent.heading.or(is_disc.then(|| libm::atan2(ahead.y, ahead.x) as f32));
            let preferred_speed = speed.map_or(agent.preferred_speed, |speed| speed as f32);
            let agent = Agent {
                position: at.extend(0.0),
                group: self.group,
                journey,
                number: Some(number),
                preferred_speed,
                heading,
                ..agent
            };
            match enters {
                Some(time) => world.schedule_agent(time, agent),
                None => world.add_agent(agent).map(|_| ()),
            }
            .map_err(refused)?;
        }
        Ok(())
    }

    fn journey(&mut self, goal: DVec2, leaves: bool, world: &mut World) -> Result<JourneyId, throng::Error> {
        let key = [goal.x.to_bits(), goal.y.to_bits(), leaves.into()];
        if let Some(&known) = self.journeys.get(&key) {
            return Ok(known);
        }
        let corner = |x: f64, y: f64| goal + EXIT * DVec2::new(x, y);
        let goal = match leaves {
            true => {
                Goal::Exit { corners: vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)] }
            }
            false => Goal::Point { at: goal, tolerance: TOLERANCE },
        };
        let stops = vec![Stop { goal: world.add_goal(goal)?, wait: 0.0 }];
        let journey = world.add_journey(Journey { stops, repeat: false })?;
        self.journeys.insert(key, journey);
        Ok(journey)
    }
}

fn pair(x: Option<f64>, y: Option<f64>) -> DVec2 {
    DVec2::new(x.unwrap_or_default(), y.unwrap_or_default())
}

fn open(path: &Path) -> Result<SerializedFileReader<File>, Failure> {
    let file = File::open(path).map_err(|error| Failure::Here(format!("cannot read {}: {error}", path.display())))?;
    SerializedFileReader::new(file).map_err(|error| damaged(path, &error))
}

fn damaged(path: &Path, error: &parquet::errors::ParquetError) -> Failure {
    Failure::hint(format!("{} is no Parquet file, or is damaged: {error}", path.display()), wanted())
}

fn wanted() -> String {
    format!(
        "people are a Parquet table with the columns {}, and maybe {}",
        COLUMNS[..NEEDED].join(", "),
        COLUMNS[NEEDED..].join(", ")
    )
}

/// Returns the indices of the columns of a file.
fn columns(path: &Path, file: &SerializedFileReader<File>) -> Result<[Option<usize>; COLUMNS.len()], Failure> {
    let schema = file.metadata().file_metadata().schema_descr();
    let found = COLUMNS.map(|name| schema.columns().iter().position(|column| column.name() == name));
    match COLUMNS.iter().zip(found).take(NEEDED).find(|(_, found)| found.is_none()) {
        Some((name, _)) => Err(Failure::hint(format!("{} has no column `{name}`", path.display()), wanted())),
        None => Ok(found),
    }
}

fn rows(path: &Path, group: &dyn RowGroupReader, columns: &[Option<usize>; COLUMNS.len()]) -> Result<Rows, Failure> {
    let count = group.metadata().num_rows().max(0) as usize;
    let mut rows = Rows::default();
    for ((rows, column), name) in rows.iter_mut().zip(columns).zip(COLUMNS) {
        let Some(column) = column else { continue };
        let reader = group.get_column_reader(*column).map_err(|error| damaged(path, &error))?;
        *rows = numbers(reader, count).map_err(|error| damaged(path, &error))?;
        if rows.len() != count || rows.iter().any(|number| !number.is_finite()) {
            let text = format!("{}: the column `{name}` has values that are no finite numbers", path.display());
            return Err(Failure::hint(text, "leave such people out"));
        }
    }
    Ok(rows)
}

/// Returns the values of a column; fewer than `count` if it is no column of numbers, or has missing values.
fn numbers(reader: ColumnReader, count: usize) -> Result<Vec<f64>, parquet::errors::ParquetError> {
    macro_rules! read {
        ($reader:expr) => {{
            let (mut reader, mut values, mut defined) = ($reader, Vec::new(), Vec::new());
            reader.read_records(count, Some(&mut defined), None, &mut values)?;
            values.into_iter().map(|value| value as f64).collect()
        }};
    }
    Ok(match reader {
        ColumnReader::DoubleColumnReader(reader) => read!(reader),
        ColumnReader::FloatColumnReader(reader) => read!(reader),
        ColumnReader::Int32ColumnReader(reader) => read!(reader),
        ColumnReader::Int64ColumnReader(reader) => read!(reader),
        _ => Vec::new(),
    })
}
