//! Joins lines that meet end to end.

use crate::geometry::DVec2;
use std::collections::BTreeMap;

/// Ends that are nearer than this meet, metres.
const MEET: f64 = 1e-3;

/// Joins lines at points where exactly two ends meet. Returns each line, and whether it has become a closed outline. A
/// closed outline does not repeat its first point.
pub(super) fn chain(lines: Vec<Vec<DVec2>>) -> Vec<(Vec<DVec2>, bool)> {
    let key = |p: DVec2| (p / MEET).round().to_array().map(|x| x as i64);
    // the lines that end at each point
    let mut ends: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
    for (i, line) in lines.iter().enumerate() {
        for end in [line.first(), line.last()].into_iter().flatten() {
            ends.entry(key(*end)).or_default().push(i);
        }
    }
    let mut used = vec![false; lines.len()];
    // the unused line that continues from an end where two lines meet
    let next = |end: DVec2, used: &[bool]| {
        let meeting = ends.get(&key(end)).filter(|meeting| meeting.len() == 2)?;
        meeting.iter().copied().find(|i| !used[*i])
    };
    let mut out = vec![];
    for i in 0..lines.len() {
        if std::mem::replace(&mut used[i], true) {
            continue;
        }
        let mut joined = lines[i].clone();
        // first to the end, then from the start in the other direction
        for _ in 0..2 {
            while let Some(k) = joined.last().and_then(|end| next(*end, &used)) {
                used[k] = true;
                let mut more = lines[k].clone();
                if joined.last().is_some_and(|end| key(*end) != key(more[0])) {
                    more.reverse();
                }
                joined.extend(more.into_iter().skip(1));
            }
            joined.reverse();
        }
        let closed = joined.len() > 3 && joined.first().map(|p| key(*p)) == joined.last().map(|p| key(*p));
        if closed {
            joined.pop();
        }
        out.push((joined, closed));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().map(|p| DVec2::from(*p)).collect()
    }

    #[test]
    fn lines_round_a_square_become_an_outline() {
        // in any order and direction
        let lines = vec![
            line(&[(0.0, 0.0), (4.0, 0.0)]),
            line(&[(0.0, 3.0), (4.0, 3.0)]),
            line(&[(4.0, 0.0), (4.0, 3.0)]),
            line(&[(0.0, 3.0), (0.0, 0.0)]),
        ];
        let joined = chain(lines);
        assert_eq!(joined.len(), 1);
        assert!(joined[0].1 && joined[0].0.len() == 4, "{joined:?}");
    }

    #[test]
    fn a_line_that_is_begun_in_its_middle_goes_both_ways() {
        let lines =
            vec![line(&[(1.0, 0.0), (2.0, 0.0)]), line(&[(3.0, 1.0), (2.0, 0.0)]), line(&[(0.0, 1.0), (1.0, 0.0)])];
        let joined = chain(lines);
        assert_eq!(joined, [(line(&[(0.0, 1.0), (1.0, 0.0), (2.0, 0.0), (3.0, 1.0)]), false)]);
    }

    #[test]
    fn where_three_meet_nothing_is_joined() {
        let lines =
            vec![line(&[(0.0, 0.0), (1.0, 0.0)]), line(&[(1.0, 0.0), (2.0, 0.0)]), line(&[(1.0, 0.0), (1.0, 1.0)])];
        assert_eq!(chain(lines).len(), 3);
    }
}
