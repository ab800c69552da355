//! Vector fields on grids: tables, and Menge's text files.

use crate::error::{Error, Kind};
use crate::scene::Point;
use glam::Vec2;

/// Velocities at the corners of square cells, row by row from the lower left corner, towards +x, then +y.
#[derive(Clone, Debug, PartialEq)]
pub struct Vectors {
    /// The lower left corner, metres.
    pub low: Point,
    /// The width of cells, metres.
    pub cell: f64,
    /// The number of corners in a row.
    pub columns: usize,
    /// The velocities, m/s.
    pub velocities: Vec<Vec2>,
}

/// Reads a vector field of Menge: the numbers of rows and columns, the width of cells, the lower left corner of the
/// first cell, then the velocities of cells, row by row from the bottom. In Menge, velocities apply at the centres of
/// cells; those at the edge extend to the edge.
///
/// # Errors
/// The text is not such a file. The error names the wrong number.
pub fn menge(text: &str) -> Result<Vectors, Error> {
    let wrong = |what: String| {
        let hint = "a vector field of Menge's has: rows, columns, width of cells, x and y of the corner, then two numbers a cell";
        Error::new(Kind::Syntax, what).hint(hint)
    };
    let mut words = text.split_whitespace();
    let mut read = 0usize;
    let mut number = |what: &str| -> Result<f64, Error> {
        let word = words.next().ok_or_else(|| wrong(format!("it ends after {read} numbers, before {what}")))?;
        read += 1;
        let number = word.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| wrong(format!("number {read}, {what}, is `{word}`")))
    };
    let mut count = |what: &str| -> Result<usize, Error> {
        let count = number(what)?;
        let whole = (1.0..=1e5).contains(&count) && count.fract() == 0.0;
        if whole { Ok(count as usize) } else { Err(wrong(format!("{what} is {count}, but must be 1 to 100000"))) }
    };
    let (rows, columns) = (count("the number of rows")?, count("the number of columns")?);
    let cell = number("the width of cells")?;
    let low = [number("x of the corner")?, number("y of the corner")?];
    if rows * columns > 1 << 24 {
        return Err(wrong(format!("{rows} by {columns} cells are more than {}", 1 << 24)));
    }
    let mut cells = Vec::with_capacity(rows * columns);
    for _ in 0..rows * columns {
        cells.push(Vec2::new(number("a velocity along x")? as f32, number("a velocity along y")? as f32));
    }
    if let Some(word) = words.next() {
        return Err(wrong(format!("after {rows} by {columns} velocities comes `{word}`")));
    }
    let clamp = |at: usize, count: usize| at.saturating_sub(1).min(count - 1);
    let corners = (0..rows + 2).flat_map(|row| (0..columns + 2).map(move |column| (row, column)));
    let velocities = corners.map(|(row, column)| cells[clamp(row, rows) * columns + clamp(column, columns)]).collect();
    Ok(Vectors { low: low.map(|x| x - 0.5 * cell), cell, columns: columns + 2, velocities })
}

/// Reads a table with the columns x, y, vx and vy, in any order, one place a line. The places are all corners of a grid
/// with square cells, in any order.
///
/// # Errors
/// The text is not such a table, or its places are not a grid. The error has the line.
pub fn csv(text: &str) -> Result<Vectors, Error> {
    let hint = "a table has a first line `x,y,vx,vy`, then a place and a velocity a line";
    let wrong = |line: u64, what: String| {
        let mut error = Error::new(Kind::Syntax, what).hint(hint);
        error.at = (line > 0).then_some((line as usize, 1));
        error
    };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(text.as_bytes());
    let headers = reader.headers().map_err(|error| wrong(1, error.to_string()))?.clone();
    let column = |name: &str| {
        let found = headers.iter().position(|header| header.eq_ignore_ascii_case(name));
        found.ok_or_else(|| wrong(1, format!("there is no column `{name}`")))
    };
    let columns = [column("x")?, column("y")?, column("vx")?, column("vy")?];
    let mut rows = vec![];
    for record in reader.records() {
        let record =
            record.map_err(|error| wrong(error.position().map_or(0, csv::Position::line), error.to_string()))?;
        let line = record.position().map_or(0, csv::Position::line);
        let mut row = [0.0f64; 4];
        for (out, at) in row.iter_mut().zip(columns) {
            let word = record.get(at).unwrap_or_default();
            let number = word.parse().ok().filter(|number: &f64| number.is_finite());
            *out = number.ok_or_else(|| wrong(line, format!("`{word}` is no number in column `{}`", &headers[at])))?;
        }
        rows.push((row, line));
    }
    grid(rows).map_err(|(line, what)| Error { kind: Kind::Geometry, ..wrong(line, what) })
}

/// Sorts places into the order of a grid. If they are not a grid, returns the wrong line and the error.
fn grid(mut rows: Vec<([f64; 4], u64)>) -> Result<Vectors, (u64, String)> {
    rows.sort_by(|(a, _), (b, _)| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])));
    let Some((first, last)) = rows.first().zip(rows.last()) else { return Err((0, "it has no places".into())) };
    let columns = rows.iter().take_while(|(row, _)| row[1] == first.0[1]).count();
    if columns < 2 || !rows.len().is_multiple_of(columns) || rows.len() < 2 * columns {
        let what = format!("its {} places are no grid of two or more rows of {columns}", rows.len());
        return Err((first.1, what));
    }
    let count = rows.len() / columns;
    let cell = (rows[columns - 1].0[0] - first.0[0]) / (columns - 1) as f64;
    let tall = (last.0[1] - first.0[1]) / (count - 1) as f64;
    if (cell - tall).abs() > 1e-3 * cell {
        return Err((first.1, format!("its cells are {cell} m wide and {tall} m high: they are not square")));
    }
    for (at, (row, line)) in rows.iter().enumerate() {
        let place = [first.0[0] + (at % columns) as f64 * cell, first.0[1] + (at / columns) as f64 * cell];
        if (row[0] - place[0]).abs().max((row[1] - place[1]).abs()) > 1e-2 * cell {
            let what =
                format!("({}, {}) is no corner of the grid; ({}, {}) would be", row[0], row[1], place[0], place[1]);
            return Err((*line, what));
        }
    }
    let velocities = rows.iter().map(|(row, _)| Vec2::new(row[2] as f32, row[3] as f32)).collect();
    Ok(Vectors { low: [first.0[0], first.0[1]], cell, columns, velocities })
}
