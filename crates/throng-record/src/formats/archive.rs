//! Text files of the Pedestrian Dynamics Data Archive (Forschungszentrum Jülich), as PeTrack writes them.
//!
//! A line holds a pedestrian at a frame, in columns separated by blanks: `id frame x y z`. `z` is optional: it is the
//! height of the head, not of the ground. Comments begin with `#` and may state the frame rate (`framerate: 25`) and
//! the unit (`x/cm`, `in metres`).
//!
//! If no unit is stated, lengths are centimetres if the fastest hundredth of all displacements within a second is
//! longer than ten units: 10 m/s is faster than any runner, 10 cm/s slower than any walker. Frame rates are never
//! guessed.

use super::text::{comments, lines, people, rate, text, walker};
use super::{Format, FormatFlaw, Reading};
use crate::trajectories::{Sample, Trajectories};
use glam::DVec2;

/// Read only.
pub(super) const FORMAT: Format = Format {
    ending: "txt",
    title: "people's trajectories as text: the Pedestrian Dynamics Data Archive's",
    columns: false,
    styles: &[],
    create: None,
    read: Some(read),
    figures: None,
    kept: false,
    sniff: None,
};

const HINT: &str = "such a file has lines of `id frame x y z`, and comments after #";
/// Greatest displacement of a pedestrian within a second, metres.
const FASTEST: f64 = 10.0;

fn read(bytes: &[u8], reading: &Reading) -> Result<Trajectories, FormatFlaw> {
    let text = text(bytes);
    let rate = rate(comments(&text).find_map(said_rate), reading)?;
    let mut spots = Vec::new();
    for fields in lines(&text) {
        let number = |at, what| fields.number(at, what, HINT);
        let time = number(1, "the frame")? / rate;
        let place = DVec2::new(number(2, "x")?, number(3, "y")?);
        spots.push(walker(fields.person(0, HINT)?, time, place));
    }
    let unit = reading.unit.or_else(|| comments(&text).find_map(said_unit));
    let unit = unit.unwrap_or_else(|| if are_centimetres(&mut spots) { 0.01 } else { 1.0 });
    spots.iter_mut().for_each(|spot| spot.place *= unit);
    Ok(Trajectories { unit: Some(unit), ..people(spots, false)? })
}

/// Returns the first number after the word `framerate`.
fn said_rate(comment: &str) -> Option<f64> {
    let comment = comment.to_ascii_lowercase();
    let (_, behind) = comment.split_once("framerate").or_else(|| comment.split_once("frame rate"))?;
    let number = behind.trim_start_matches([':', '=', ' ', '\t', '"']);
    let end = number.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(number.len());
    number[..end].parse().ok()
}

/// Returns the unit that a comment names, metres.
fn said_unit(comment: &str) -> Option<f64> {
    let comment = comment.to_ascii_lowercase();
    let mut words = comment.split(|c: char| !c.is_ascii_alphabetic() && c != '/');
    let unit = |word: &str| match word {
        "m" | "meter" | "meters" | "metre" | "metres" => Some(1.0),
        "cm" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => Some(0.01),
        "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" => Some(0.001),
        _ => None,
    };
    let mut before = "";
    words.find_map(|word| {
        let named = word.strip_prefix("x/").or((matches!(before, "in" | "unit")).then_some(word));
        if !word.is_empty() {
            before = word;
        }
        named.and_then(unit)
    })
}

/// Whether displacements within a second are too long for metres. Sorts the samples by agent and time.
fn are_centimetres(spots: &mut [Sample]) -> bool {
    spots.sort_by(|a, b| a.number.cmp(&b.number).then(a.time.total_cmp(&b.time)));
    let mut ways = Vec::new();
    for own in spots.chunk_by(|a, b| a.number == b.number) {
        let mut last = own[0];
        for spot in own {
            if spot.time >= last.time + 1.0 {
                ways.push(spot.place.distance(last.place) / (spot.time - last.time));
                last = *spot;
            }
        }
    }
    let rank = ways.len() * 99 / 100;
    !ways.is_empty() && *ways.select_nth_unstable_by(rank, f64::total_cmp).1 > FASTEST
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_and_units_are_found_in_comments() {
        let rates = [" framerate: 25 fps", "framerate:16", " Framerate=12.5", " frame rate 30.00"].map(said_rate);
        assert_eq!(rates, [Some(25.0), Some(16.0), Some(12.5), Some(30.0)]);
        assert_eq!((said_rate("frames"), said_rate("framerate: unknown")), (None, None));
        let units =
            [" id frame x/cm y/cm z/cm", " id frame x/m y/m", "X,Y,Z: the agents coordinates (in metres)", "unit: mm"];
        assert_eq!(units.map(said_unit), [Some(0.01), Some(1.0), Some(1.0), Some(0.001)]);
        assert_eq!((said_unit("ID frame X Y Z"), said_unit("the main minimum x/y")), (None, None));
    }

    #[test]
    fn an_unstated_unit_is_found_by_speeds() {
        let file = |scale: f64| {
            let line = |k: i32| format!("7 {k} {} -1\n", f64::from(k) * 0.05 * scale);
            "#framerate: 25\n".to_owned() + &(0..100).map(line).collect::<String>()
        };
        for scale in [1.0, 100.0] {
            let tracks = read(file(scale).as_bytes(), &Reading::default()).unwrap();
            let last = tracks.spots.last().unwrap();
            assert!((last.place.x - 4.95).abs() < 1e-9 && (last.time - 99.0 / 25.0).abs() < 1e-12);
            assert_eq!(tracks.unit, Some(1.0 / scale));
            assert!((last.velocity.x - 1.25).abs() < 1e-5 && last.heading == 0.0);
        }
        let said = Reading { unit: Some(0.5), rate: Some(1.0) };
        let last = read(file(1.0).as_bytes(), &said).unwrap().spots[99];
        assert!(
            (last.place.x - 2.475).abs() < 1e-12 && last.time == 99.0,
            "the reading's unit and rate take precedence"
        );
    }

    #[test]
    fn mistakes_are_named_with_their_lines() {
        let wrong = |text: &str| read(text.as_bytes(), &Reading::default()).unwrap_err();
        assert!(wrong("1 0 0 0 0\n").why.contains("does not state the frame rate"));
        assert!(wrong("1 0 0 0 0\n").hint.unwrap().contains("--frame-rate"));
        let rest = |text: &str| wrong(&format!("#framerate: 25\n\n{text}"));
        assert_eq!(rest("1 0 0 0\n1 1 0").line, Some(4));
        assert_eq!(rest("1 0 x 0\n").why, "`x` is no number for x");
        assert_eq!(rest("1.5 0 0 0\n").why, "`1.5` is not an agent number");
        assert_eq!(rest("-1 0 0 0\n").line, Some(3));
        assert_eq!(rest("1 0 1e999 0\n").line, Some(3));
        assert_eq!(rest("").why, "the file has no agents");
        assert!(read(b"\xff\xfe\x00\x00", &Reading { rate: Some(1.0), unit: None }).is_err());
    }
}
