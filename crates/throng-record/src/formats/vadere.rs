//! Trajectories of Vadere (`.traj`).
//!
//! Columns separated by blanks, under a line of names. A name may end in the processor that wrote the column
//! (`startX-PID1`):
//!
//! | names | a line is |
//! |---|---|
//! | `pedestrianId simTime endTime startX startY endX endY ..` | a footstep, from one place and time to another |
//! | `timeStep pedestrianId x y ..` (before 1.0) | a pedestrian at a time step; the file does not state the length of a step |
//!
//! Footsteps start and end at individual times. They are sampled at common times, [`RATE`] or [`Reading::rate`] per
//! second. Between start and end of a footstep, pedestrians move along a straight line; then they stand until the next
//! footstep. Units are metres.

use super::text::{Fields, lines, people, rate, text, walker};
use super::{Format, FormatFlaw, Reading};
use crate::trajectories::{Sample, Trajectories};
use glam::DVec2;

/// Read only.
pub(super) const FORMAT: Format = Format {
    ending: "traj",
    title: "trajectories of Vadere",
    kept: false,
    columns: false,
    styles: &[],
    create: None,
    read: Some(read),
    figures: None,
    sniff: None,
};

const HINT: &str = "a .traj file begins with names of columns: pedestrianId simTime endTime startX startY endX endY, or \
                    timeStep pedestrianId x y";
/// Samples per second of footsteps, unless the reading states a rate.
const RATE: f64 = 10.0;
/// Greatest mean number of samples per footstep; pedestrians with more stand for hours.
const MOST: usize = 1000;

fn read(bytes: &[u8], reading: &Reading) -> Result<Trajectories, FormatFlaw> {
    let text = text(bytes);
    let mut lines = lines(&text);
    let names = lines.next().ok_or_else(|| FormatFlaw { line: None, why: "it is empty".into(), hint: Some(HINT) })?;
    let unit = reading.unit.unwrap_or(1.0);
    let column = |name: &str| names.fields.iter().position(|field| field.split('-').next() == Some(name));
    let needed = |name: &str| column(name).ok_or_else(|| names.flaw(format!("there is no column `{name}`"), HINT));
    let person = needed("pedestrianId")?;
    if column("timeStep").is_some() {
        let columns = [needed("timeStep")?, needed("x")?, needed("y")?];
        let rate = rate(None, reading)?;
        let spot = |fields: Fields| {
            let [step, x, y] = values(&fields, columns)?;
            Ok(walker(fields.person(person, HINT)?, step / rate, DVec2::new(x, y) * unit))
        };
        return people(lines.map(spot).collect::<Result<_, FormatFlaw>>()?, false);
    }
    let names = ["simTime", "endTime", "startX", "startY", "endX", "endY"];
    let mut columns = [0; 6];
    for (column, name) in columns.iter_mut().zip(names) {
        *column = needed(name)?;
    }
    let mut footsteps = Vec::new();
    for fields in lines {
        let [start, end, x0, y0, x1, y1] = values(&fields, columns)?;
        let number = fields.person(person, HINT)?;
        if end < start {
            return Err(fields.flaw(format!("a footstep ends at {end} s, before it starts at {start} s"), HINT));
        }
        let knots = [(start, DVec2::new(x0, y0) * unit), (end, DVec2::new(x1, y1) * unit)];
        footsteps.push((number, knots));
    }
    people(sampled(footsteps, rate(Some(RATE), reading)?)?, false)
}

fn values<const N: usize>(fields: &Fields, columns: [usize; N]) -> Result<[f64; N], FormatFlaw> {
    let mut out = [0.0; N];
    for (value, at) in out.iter_mut().zip(columns) {
        *value = fields.number(at, "a column", HINT)?;
    }
    Ok(out)
}

/// Samples footsteps at common times, `rate` per second, from the start of each pedestrian's first footstep to the end
/// of the last one.
fn sampled(mut footsteps: Vec<(u32, [(f64, DVec2); 2])>, rate: f64) -> Result<Vec<Sample>, FormatFlaw> {
    footsteps.sort_by(|a, b| a.0.cmp(&b.0).then(a.1[0].0.total_cmp(&b.1[0].0)));
    let most = footsteps.len().saturating_mul(MOST) as f64;
    let mut spots = Vec::new();
    for own in footsteps.chunk_by(|a, b| a.0 == b.0) {
        let knots: Vec<(f64, DVec2)> = own.iter().flat_map(|footstep| footstep.1).collect();
        let (first, last) = (knots[0].0, knots.iter().map(|knot| knot.0).fold(f64::NEG_INFINITY, f64::max));
        // the margin keeps samples that rounding would lose
        let [from, to] = [(first * rate - 1e-9).ceil(), (last * rate + 1e-9).floor()];
        if spots.len() as f64 + (to - from) > most || !(-1e15..1e15).contains(&from) {
            let why = format!(
                "agent {} is present from {first} to {last} s: too long for {rate} samples per second",
                own[0].0
            );
            return Err(FormatFlaw { line: None, why, hint: Some("read fewer, such as --frame-rate 1") });
        }
        let mut next = 1;
        for frame in from as i64..=to as i64 {
            let time = frame as f64 / rate;
            while next + 1 < knots.len() && knots[next].0 < time {
                next += 1;
            }
            let ((t0, a), (t1, b)) = (knots[next - 1], knots[next]);
            let share = if t1 > t0 { ((time - t0) / (t1 - t0)).clamp(0.0, 1.0) } else { 1.0 };
            spots.push(walker(own[0].0, time, a.lerp(b, share)));
        }
    }
    Ok(spots)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn footsteps_are_read_at_common_moments() {
        let text = b"#IDXCOL=2,DATACOL=6,SEP=' '\n\
            pedestrianId simTime endTime-PID1 startX-PID1 startY-PID1 endX-PID1 endY-PID1 targetId-PID2\n\
            3 0.05 0.45 0 0 0.4 0 1\n4 0.1 0.5 9 9 9 8 1\n3 0.65 1.05 0.4 0 0.8 0.4 1\n";
        let tracks = read(text, &Reading::default()).unwrap();
        let own: Vec<&Sample> = tracks.spots.iter().filter(|spot| spot.number == 3).collect();
        let at = |k: usize| (own[k].time, own[k].place.truncate());
        assert_eq!((own.len(), at(0).0, at(9).0), (10, 0.1, 1.0));
        assert!(at(0).1.distance(DVec2::new(0.05, 0.0)) < 1e-12);
        assert!((4..6).all(|k| at(k).1.distance(DVec2::new(0.4, 0.0)) < 1e-12), "stands between footsteps");
        assert!(at(9).1.distance(DVec2::new(0.75, 0.35)) < 1e-12);
        assert_eq!(read(text, &Reading { rate: Some(2.0), unit: None }).unwrap().spots.len(), 3);
    }

    #[test]
    fn older_files_count_steps() {
        let text = b"timeStep pedestrianId x y targetId\n1 1 0.5 2 1\n2 1 0.7 2 1\n";
        assert!(read(text, &Reading::default()).unwrap_err().hint.unwrap().contains("--frame-rate"));
        let tracks = read(text, &Reading { rate: Some(2.5), unit: None }).unwrap();
        assert_eq!((tracks.spots[1].time, tracks.spots[1].place.x), (0.8, 0.7));
    }

    #[test]
    fn mistakes_are_named() {
        let wrong = |text: &str| read(text.as_bytes(), &Reading::default()).unwrap_err();
        let names = "pedestrianId simTime endTime startX startY endX endY\n";
        assert!(wrong("1 2 3\n").why.contains("no column `pedestrianId`"));
        assert_eq!(wrong(&format!("{names}1 0 1 0 0 1\n")).line, Some(2));
        assert!(wrong(&format!("{names}1 5 1 0 0 1 1\n")).why.contains("ends at 1 s"));
        assert!(wrong(&format!("{names}1 0 1e14 0 0 1 1\n")).why.contains("too long"));
        assert_eq!(wrong("").why, "it is empty");
    }
}
