//! Menge's navigation meshes (`.nav`): the ground, in convex polygons.

use crate::error::{Error, Kind};
use crate::geometry::DVec2;
use crate::import::short;

/// Greater numbers are mistakes.
const FARTHEST: f64 = 1e7;

/// Reads the polygons of a mesh, in metres. The format: the number of vertices and a line for each, the same for edges
/// and obstacles; then groups of nodes, each with a name, a number, and for each node five lines: its centre, its
/// corners, its plane, its edges, its obstacles.
///
/// # Errors
/// The text does not have this format. The error has the line.
pub(super) fn polygons(text: &str) -> Result<Vec<Vec<DVec2>>, Error> {
    let mut lines = Lines { text, lines: text.lines().enumerate() };
    let mut vertices = vec![];
    for _ in 0..lines.count("the number of vertices")? {
        let (words, at) = lines.words("a vertex")?;
        vertices.push(DVec2::new(lines.number(&words, 0, at)?, lines.number(&words, 1, at)?));
    }
    for what in ["the number of edges", "the number of obstacles"] {
        for _ in 0..lines.count(what)? {
            lines.words("an edge")?;
        }
    }
    let mut polygons = vec![];
    // a group begins with its name
    while lines.next().is_some() {
        for _ in 0..lines.count("the number of nodes")? {
            lines.words("the centre of a node")?;
            let (words, at) = lines.words("the corners of a node")?;
            let corner = |k: usize| {
                let place = lines.number(&words, k, at)?;
                let corner = vertices.get(place as usize).filter(|_| place >= 0.0).copied();
                corner.ok_or_else(|| lines.wrong(at, format!("there is no vertex {place} among {}", vertices.len())))
            };
            polygons.push((1..words.len()).map(corner).collect::<Result<Vec<_>, _>>()?);
            for what in ["the plane of a node", "the edges of a node", "the obstacles of a node"] {
                lines.words(what)?;
            }
        }
    }
    if polygons.is_empty() {
        return Err(Error::new(Kind::Geometry, "this navigation mesh has no nodes"));
    }
    Ok(polygons)
}

/// The lines of a text that are not empty.
struct Lines<'t> {
    text: &'t str,
    lines: std::iter::Enumerate<std::str::Lines<'t>>,
}

impl<'t> Lines<'t> {
    fn next(&mut self) -> Option<(usize, &'t str)> {
        self.lines.find(|(_, line)| !line.trim().is_empty())
    }

    /// Returns the words of the next line, and its index.
    fn words(&mut self, what: &str) -> Result<(Vec<&'t str>, usize), Error> {
        match self.next() {
            Some((at, line)) => Ok((line.split_whitespace().collect(), at)),
            None => Err(self.wrong(self.text.lines().count().saturating_sub(1), format!("it ends before {what}"))),
        }
    }

    fn count(&mut self, what: &str) -> Result<usize, Error> {
        let (words, at) = self.words(what)?;
        let count = words[0].parse().ok().filter(|_| words.len() == 1);
        count.ok_or_else(|| self.wrong(at, format!("{what} should be here, not `{}`", short(&words.join(" ")))))
    }

    fn number(&self, words: &[&str], k: usize, at: usize) -> Result<f64, Error> {
        let number = words.get(k).and_then(|word| word.parse().ok()).filter(|number: &f64| number.abs() <= FARTHEST);
        number.ok_or_else(|| self.wrong(at, format!("number {} of this line is none, or beyond {FARTHEST}", k + 1)))
    }

    fn wrong(&self, at: usize, message: String) -> Error {
        let mut error = Error::new(Kind::Syntax, message).hint("it should be a navigation mesh of Menge's");
        error.at = Some((at + 1, 1));
        error.line = self.text.lines().nth(at).map(|line| (line.to_owned(), 1));
        error
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TWO: &str = "6\n0 0\n1 0\n1 1\n0 1\n2 0\n2 1\n1\n1 2 0 1\n1\n0 1 0 1\n\nfloor\n2\n\
        0.5 0.5\n4 0 1 2 3\n0 0 1\n1 0\n1 0\n\n1.5 0.5\n4 1 4 5 2\n0 0 1\n1 0\n0\n";

    #[test]
    fn nodes_become_polygons() {
        let polygons = polygons(TWO).unwrap();
        assert_eq!(polygons.len(), 2);
        assert_eq!(polygons[1], [(1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0)].map(DVec2::from));
    }

    #[test]
    fn errors_have_their_line() {
        let error = |text: &str| polygons(text).unwrap_err();
        assert_eq!(error("").at, Some((1, 1)));
        assert!(error("2\n0 0\n").message.contains("ends before a vertex"));
        assert_eq!(error(&TWO.replace("4 1 4 5 2", "4 1 4 9 2")).message, "there is no vertex 9 among 6");
        assert_eq!(error(&TWO.replace("4 1 4 5 2", "4 1 4 9 2")).at, Some((22, 1)));
        assert!(error(&TWO.replace("1 0\n1 1", "1 x\n1 1")).message.contains("number 2 of this line"));
    }
}
