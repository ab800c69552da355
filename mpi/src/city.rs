//! `throng-mpi city`: writes a city of any size.
//!
//! Square blocks of buildings with streets between them. Some blocks are open squares, and each square has a station in its
//! middle. People start in the streets and squares. One in five goes to a station, the others to a door two to four blocks
//! away; all leave there.

use crate::args::CityArgs;
use crate::failure::Failure;
use glam::DVec2;
use parquet::basic::{Compression, ZstdLevel};
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::sync::Arc;
use throng::random::SplitMix64;
use throng_record::{Output, OutputError};

/// Side of the blocks of buildings, metres.
const BLOCK: f64 = 60.0;
/// Width of the streets, metres.
const STREET: f64 = 12.0;
/// Blocks between two squares along each axis.
const SQUARES: usize = 4;
/// Distance of people at the start from walls, and of doors from theirs, metres.
const MARGIN: f64 = 1.0;
/// Least distance of two people at the start, metres.
const APART: f64 = 0.55;
/// Rows of a row group.
const ROWS: usize = 1 << 17;

/// A person: its place, its goal, and its preferred speed.
type Person = (DVec2, DVec2, f64);

/// A city with this number of blocks along a side.
#[derive(Clone, Copy)]
struct City {
    across: usize,
}

impl City {
    /// Returns the side of the city, metres. Streets surround it.
    fn side(self) -> f64 {
        self.across as f64 * (BLOCK + STREET) + STREET
    }

    fn is_square(self, [x, y]: [usize; 2]) -> bool {
        x % SQUARES == SQUARES / 2 && y % SQUARES == SQUARES / 2
    }

    fn corner(self, [x, y]: [usize; 2]) -> DVec2 {
        DVec2::new(x as f64, y as f64) * (BLOCK + STREET) + STREET
    }

    /// Returns the block at a place, or the one above it and to its right.
    fn block(self, place: DVec2) -> [usize; 2] {
        place.to_array().map(|x| ((x / (BLOCK + STREET)) as usize).min(self.across - 1))
    }

    /// Whether a person can stand at a place.
    fn is_free(self, place: DVec2) -> bool {
        let inside = place.min_element() > MARGIN && place.max_element() < self.side() - MARGIN;
        let block = self.block(place);
        let from = place - self.corner(block);
        let in_block = from.min_element() > -MARGIN && from.max_element() < BLOCK + MARGIN;
        // the walls of the next blocks are nearer than a street
        let beyond = place + MARGIN;
        let next = self.block(beyond);
        let from = beyond - self.corner(next);
        let in_next = next != block && from.min_element() > 0.0 && from.max_element() < BLOCK + MARGIN;
        inside && (!in_block || self.is_square(block)) && (!in_next || self.is_square(next))
    }

    /// Calls `found` with places about `pitch` metres from each other, row by row.
    fn places(self, pitch: f64, seed: u64, mut found: impl FnMut(DVec2) -> Result<(), Failure>) -> Result<(), Failure> {
        let reach = 0.5 * (pitch - APART);
        let count = (self.side() / pitch) as u64;
        for (row, column) in (0..count).flat_map(|row| (0..count).map(move |column| (row, column))) {
            let mut dice = SplitMix64(seed ^ (row << 32 | column).wrapping_mul(0xd134_2543_de82_ef95));
            let middle = DVec2::new(column as f64 + 0.5, row as f64 + 0.5) * pitch;
            let place = middle + DVec2::new(dice.between(-reach, reach), dice.between(-reach, reach));
            if self.is_free(place) {
                found(place)?;
            }
        }
        Ok(())
    }

    /// Returns the middle of the square that is nearest to a place.
    fn station(self, place: DVec2) -> DVec2 {
        let nearest = |at: usize| {
            let squares = (SQUARES / 2..self.across).step_by(SQUARES);
            squares.min_by_key(|square| square.abs_diff(at)).unwrap_or(0)
        };
        self.corner(self.block(place).map(nearest)) + 0.5 * BLOCK
    }

    /// Returns one of the eight doors of a block that is two to four blocks away along an axis, or less at the edge.
    fn door(self, place: DVec2, dice: &mut SplitMix64) -> DVec2 {
        let from = self.block(place);
        let away = |at: usize, far: usize, dice: &mut SplitMix64| {
            let (below, above) = (at.saturating_sub(far), (at + far).min(self.across - 1));
            if dice.unit() < 0.5 { below } else { above }
        };
        let far = [2 + dice.below(3), dice.below(5)];
        let turned = usize::from(dice.unit() < 0.5);
        let mut block = [away(from[0], far[turned], dice), away(from[1], far[1 - turned], dice)];
        if self.is_square(block) {
            // a square has no doors
            block[0] = if block[0] > 0 { block[0] - 1 } else { 1 };
        }
        let along = if dice.unit() < 0.5 { 0.25 } else { 0.75 } * BLOCK;
        let out = [-MARGIN, BLOCK + MARGIN][dice.below(2)];
        let door = if dice.unit() < 0.5 { DVec2::new(along, out) } else { DVec2::new(out, along) };
        self.corner(block) + door
    }

    fn person(self, place: DVec2, dice: &mut SplitMix64) -> Person {
        let to_station = self.across > SQUARES / 2 && dice.unit() < 0.2;
        let goal = if to_station { self.station(place) } else { self.door(place, dice) };
        (place, goal, dice.between(1.1, 1.6))
    }

    fn scene(self, people: u32) -> String {
        let side = self.side();
        let mut text = format!(
            "# A city of {across} by {across} blocks for {people} people: throng-mpi run city.toml --people people.parquet\n\
             title = \"A city\"\n\n[time]\nstep = 0.1\nuntil = \"empty\"\nlimit = 600\n\n[walkable]\nrectangle = {{ center = [{half}, {half}], size = [{side}, {side}] }}\n\n\
             # bodies and habits of the people; their places and goals are in people.parquet\n\
             [[group]]\nname = \"people\"\ncount = 1\nplace.points = [[6, 6]]\n",
            across = self.across,
            half = 0.5 * side,
        );
        let blocks = (0..self.across).flat_map(|y| (0..self.across).map(move |x| [x, y]));
        for block in blocks.filter(|block| !self.is_square(*block)) {
            let DVec2 { x, y } = self.corner(block) + 0.5 * BLOCK;
            // writing to memory cannot fail
            let _ = write!(
                text,
                "\n[[obstacle]]\nshape.rectangle = {{ center = [{x}, {y}], size = [{BLOCK}, {BLOCK}] }}\n"
            );
        }
        text
    }
}

/// Writes a city.
///
/// # Errors
/// A file cannot be written.
pub fn write(args: &CityArgs) -> Result<(), Failure> {
    let made = fs::create_dir_all(&args.output);
    made.map_err(|error| Failure::Here(format!("cannot make the folder {}: {error}", args.output.display())))?;
    let pitch = args.density.sqrt().recip();
    let count = |city: City| {
        let mut count = 0u64;
        city.places(pitch, args.seed, |_| {
            count += 1;
            Ok(())
        })
        .map(|()| count)
    };
    // the smallest city with room for all; its area grows with the square of its side
    let mut city = City { across: ((f64::from(args.people) / args.density / 2500.0).sqrt() as usize).max(3) };
    let mut room = count(city)?;
    while room < u64::from(args.people) {
        city.across += 1;
        room = count(city)?;
    }
    let path = args.output.join("city.toml");
    let mut output = Output::create(&path)?;
    output.write_all(city.scene(args.people).as_bytes()).map_err(|error| OutputError::new(&path, error))?;
    output.finish()?;
    write_people(args, city, pitch, room)?;
    println!(
        "{} people in {} by {} blocks, {:.1} km: {}",
        args.people,
        city.across,
        city.across,
        city.side() / 1000.0,
        args.output.display(),
    );
    Ok(())
}

/// Writes the people: of all places in the city, as many as there are people, evenly.
fn write_people(args: &CityArgs, city: City, pitch: f64, room: u64) -> Result<(), Failure> {
    let path = args.output.join("people.parquet");
    let wrong = |error| failed(&path, error);
    let schema = "message people { required double x; required double y; required double goal_x; required double goal_y; \
                  required double leaves; required double speed; }";
    let schema = parse_message_type(schema).map_err(wrong)?;
    let properties =
        WriterProperties::builder().set_compression(Compression::ZSTD(ZstdLevel::try_new(1).map_err(wrong)?));
    let output = Output::create(&path)?;
    let mut file = SerializedFileWriter::new(output, Arc::new(schema), Arc::new(properties.build())).map_err(wrong)?;
    let mut rows: Vec<Person> = Vec::with_capacity(ROWS);
    let (mut seen, people) = (0u64, u64::from(args.people));
    city.places(pitch, args.seed, |place| {
        let taken = |places: u64| u128::from(places) * u128::from(people) / u128::from(room);
        seen += 1;
        if taken(seen) > taken(seen - 1) {
            let mut dice = SplitMix64(args.seed.wrapping_add(seen.wrapping_mul(0x2545_f491_4f6c_dd1d)));
            rows.push(city.person(place, &mut dice));
            if rows.len() == ROWS {
                write_rows(&mut file, &mut rows).map_err(wrong)?;
            }
        }
        Ok(())
    })?;
    if !rows.is_empty() {
        write_rows(&mut file, &mut rows).map_err(wrong)?;
    }
    Ok(file.into_inner().map_err(wrong)?.finish()?)
}

fn write_rows(file: &mut SerializedFileWriter<Output>, rows: &mut Vec<Person>) -> Result<(), ParquetError> {
    let mut group = file.next_row_group()?;
    let mut write = |value: fn(&Person) -> f64| {
        let values: Vec<f64> = rows.iter().map(value).collect();
        let mut column = group.next_column()?.expect("the schema has the column");
        column.typed::<DoubleType>().write_batch(&values, None, None)?;
        column.close()
    };
    let all: [fn(&Person) -> f64; 6] =
        [|row| row.0.x, |row| row.0.y, |row| row.1.x, |row| row.1.y, |_| 1.0, |row| row.2];
    all.into_iter().try_for_each(&mut write)?;
    group.close()?;
    rows.clear();
    Ok(())
}

fn failed(path: &Path, error: ParquetError) -> Failure {
    Failure::Here(format!("cannot write {}: {error}", path.display()))
}
