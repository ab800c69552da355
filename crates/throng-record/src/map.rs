//! Maps of data sets: the walls of UCY's and ETH's data, in OpenTraj's `map.xml`.

use crate::formats::FormatFlaw;
use glam::DVec2;
use roxmltree::{Document, Node, ParsingOptions};
use throng::Obstacle;

const HINT: &str = "such a map has <Line x1=\"..\" y1=\"..\" x2=\"..\" y2=\"..\"/> below <obstacles>, metres";
/// Greatest number of XML nodes; a map has some dozens.
const MOST: u32 = 1_000_000;

/// Returns the walls of a map. They are thin. A line that starts where the line before it ends continues its wall.
/// Other elements are ignored.
///
/// ```
/// let text = "<Trial><obstacles><Lines>
///     <Line x1='6' y1='2' x2='0' y2='2'/> <Line x1='0' y1='2' x2='0' y2='0'/>
/// </Lines></obstacles></Trial>";
/// let walls = throng_record::map(text.as_bytes())?;
/// let corners = [(6.0, 2.0), (0.0, 2.0), (0.0, 0.0)].map(glam::DVec2::from).to_vec();
/// assert_eq!(walls, [throng::Obstacle::Wall { points: corners }]);
/// # Ok::<(), throng_record::FormatFlaw>(())
/// ```
///
/// # Errors
/// The text is not XML, a line has no length, a coordinate is not a number (all with the line in the file), or the map
/// has no walls.
pub fn map(bytes: &[u8]) -> Result<Vec<Obstacle>, FormatFlaw> {
    let flaw = |line, why: String| FormatFlaw { line, why, hint: Some(HINT) };
    let text = std::str::from_utf8(bytes).map_err(|_| flaw(None, "the file is not text".into()))?;
    let options = ParsingOptions { nodes_limit: MOST, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options)
        .map_err(|error| flaw(Some(error.pos().row as usize), format!("the file is not XML: {error}")))?;
    let place = |node: Node| document.text_pos_at(node.range().start).row as usize;
    let end = |node: Node, x: &str, y: &str| {
        let coordinate = |name: &str| {
            let Some(written) = node.attribute(name) else {
                return Err(flaw(Some(place(node)), format!("a line has no {name}")));
            };
            let value = written.trim().parse().ok().filter(|value: &f64| value.is_finite());
            value.ok_or_else(|| flaw(Some(place(node)), format!("{name}=\"{written}\" is no number")))
        };
        Ok(DVec2::new(coordinate(x)?, coordinate(y)?))
    };
    let mut walls: Vec<Vec<DVec2>> = Vec::new();
    for node in document.descendants().filter(|node| node.tag_name().name() == "Line") {
        let (from, to) = (end(node, "x1", "y1")?, end(node, "x2", "y2")?);
        if from == to {
            return Err(flaw(Some(place(node)), "a line begins where it ends".into()));
        }
        match walls.last_mut() {
            Some(wall) if wall.last() == Some(&from) => wall.push(to),
            _ => walls.push(vec![from, to]),
        }
    }
    if walls.is_empty() {
        return Err(flaw(None, "the file has no walls".into()));
    }
    Ok(walls.into_iter().map(|points| Obstacle::Wall { points }).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAP: &str = r#"<?xml version="1.0" encoding="utf-8"?>
<Trial xmlns="https://example.org">
  <obstacles>
    <Lines>
      <Line x1="6.000" y1="2.000" x2="0.000" y2="2.000" thickness="1" />
      <Line x1="0" y1="2" x2="0" y2="0" />
      <Line x1="-7.5e0" y1="11.5" x2="-5.0" y2="11.5" />
    </Lines>
    <Points />
  </obstacles>
</Trial>
"#;

    #[test]
    fn lines_that_go_on_are_one_wall() {
        let walls = map(MAP.as_bytes()).unwrap();
        let corners = |wall: &Obstacle| match wall {
            Obstacle::Wall { points } => points.len(),
            _ => 0,
        };
        assert_eq!(walls.iter().map(corners).collect::<Vec<_>>(), [3, 2]);
    }

    #[test]
    fn mistakes_have_lines() {
        let wrong = |from: &str, to: &str| map(MAP.replace(from, to).as_bytes()).unwrap_err();
        assert_eq!(wrong("-7.5e0", "x").line, Some(7));
        assert_eq!(wrong("-7.5e0", "inf").why, "x1=\"inf\" is no number");
        assert_eq!(wrong(r#"y2="0""#, "").why, "a line has no y2");
        assert_eq!(wrong(r#"x2="0" y2="0""#, r#"x2="0" y2="2""#).line, Some(6));
        assert_eq!(wrong("</Lines>", "").line, Some(10));
        assert_eq!(wrong("Line ", "Lime ").why, "the file has no walls");
        assert!(map(b"").is_err() && map(b"\xff\xfe").is_err());
    }

    #[test]
    fn broken_maps_are_errors_or_read() {
        let mut state = 3u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize
        };
        let pieces: [&[u8]; 10] = [
            b"<",
            b">",
            b"\"",
            b"&amp;",
            b"&x;",
            b"<!DOCTYPE a [<!ENTITY b \"c\">]>",
            b"</",
            b"1e999",
            b"\xff",
            b"<Line/>",
        ];
        for _ in 0..20_000 {
            let mut bytes = MAP.as_bytes().to_vec();
            for _ in 0..=draw() % 4 {
                let at = draw() % (bytes.len() + 1);
                match draw() % 4 {
                    0 => bytes.truncate(at),
                    1 => drop(bytes.splice(at..at, pieces[draw() % pieces.len()].iter().copied())),
                    2 => drop(bytes.splice(at..(at + draw() % 9).min(bytes.len()), [])),
                    _ => bytes.get_mut(at).into_iter().for_each(|byte| *byte = draw() as u8),
                }
            }
            match map(&bytes) {
                Ok(walls) => assert!(walls.len() < bytes.len()),
                Err(flaw) => assert!(flaw.line.is_none_or(|line| line <= 2 + bytes.len())),
            }
            // the same text as a list of groups
            let _ = crate::pedestrian::groups(&bytes);
        }
        let deep = "<a>".repeat(100_000);
        assert!(map(deep.as_bytes()).is_err());
    }
}
