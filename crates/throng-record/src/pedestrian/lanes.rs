//! Lane formation of two-way pedestrian flows.

use super::people::{People, PeopleMoment, PersonRow};
use glam::DVec2;

/// Greatest lateral distance of two pedestrians in a lane, metres.
pub const WIDTH: f64 = 0.3;

/// The direction of every pedestrian along the main axis of motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Directions {
    axis: DVec2,
    /// By walk: 1, -1, or 0 for a pedestrian that returns to its start.
    signs: Vec<f64>,
}

impl Directions {
    /// Computes directions from the displacements between first and last positions. The axis is the mean axis of the
    /// displacements, weighted by their length; opposite displacements have the same axis.
    pub fn of(people: &People) -> Self {
        let way = |places: &[DVec2]| match places {
            [first, .., last] => *last - *first,
            _ => DVec2::ZERO,
        };
        let ways: Vec<DVec2> = people.walks.iter().map(|walk| way(&walk.places)).collect();
        // doubled angles map opposite displacements to the same angle
        let doubled: DVec2 = ways.iter().map(|way| way.length() * DVec2::from_angle(2.0 * way.to_angle())).sum();
        let axis = DVec2::from_angle(0.5 * doubled.to_angle());
        let sign = |way: &DVec2| if way.dot(axis) == 0.0 { 0.0 } else { way.dot(axis).signum() };
        Self { axis, signs: ways.iter().map(sign).collect() }
    }

    /// Returns the number of pedestrians in each direction.
    pub fn counts(&self) -> [usize; 2] {
        [1.0, -1.0].map(|which| self.signs.iter().filter(|&&sign| sign == which).count())
    }

    /// Returns the direction of a pedestrian.
    fn sign(&self, here: PersonRow) -> f64 {
        self.signs[here.walk]
    }
}

/// Returns the lane order parameter at a time: the mean over pedestrians of ((same - opposite) / (same + opposite))²,
/// where same and opposite count the directions of other pedestrians at a lateral distance of at most [`WIDTH`]. It is
/// 1 for lanes, and about 0 for a mixture. Returns `None` unless both directions are present. S. Nowak, A.
/// Schadschneider, *Quantitative analysis of pedestrian counterflow in a cellular automaton model*, Phys. Rev. E 85,
/// 2012, after Rex and Löwen.
pub fn order(people: &People, moment: &PeopleMoment, directions: &Directions) -> Option<f64> {
    let across = directions.axis.perp();
    let walker = |&here: &PersonRow| (people.place(here).dot(across), directions.sign(here));
    let mut all: Vec<(f64, f64)> = moment.here.iter().map(walker).filter(|(_, sign)| *sign != 0.0).collect();
    if [1.0, -1.0].iter().any(|&way| all.iter().all(|&(_, sign)| sign != way)) {
        return None;
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let (mut first, mut end, mut balance) = (0, 0, 0.0);
    let (mut sum, mut count) = (0.0, 0u32);
    for &(side, sign) in &all {
        while end < all.len() && all[end].0 < side + WIDTH {
            balance += all[end].1;
            end += 1;
        }
        while all[first].0 <= side - WIDTH {
            balance -= all[first].1;
            first += 1;
        }
        // without the pedestrian itself
        let others = (end - first - 1) as f64;
        if others > 0.0 {
            sum += ((balance - sign) / others).powi(2);
            count += 1;
        }
    }
    (count > 0).then(|| sum / f64::from(count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pedestrian::Walk;

    #[test]
    fn lanes_are_told_from_a_mixture_as_by_counting_all_pairs() {
        let mut draw = 9u64;
        let mut next = || {
            draw = draw.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (draw >> 11) as f64 / (1u64 << 53) as f64
        };
        for mixed in [false, true] {
            let walks: Vec<Walk> = (0..200u32)
                .map(|number| {
                    let (x, y) = (20.0 * next(), 4.0 * next());
                    let right = if mixed { next() < 0.5 } else { y.rem_euclid(2.0) < 1.0 };
                    let places = vec![DVec2::new(x, y), DVec2::new(if right { x + 9.0 } else { x - 9.0 }, y)];
                    Walk { number, radius: 0.2, times: vec![0.0, 9.0], places }
                })
                .collect();
            let here = (0..200).map(|walk| PersonRow { walk, row: 0 }).collect();
            let people = People { walks, moments: vec![PeopleMoment { time: 0.0, here }] };
            let directions = Directions::of(&people);
            let found = order(&people, &people.moments[0], &directions).unwrap();
            let one = |a: usize| {
                let near = |b: &usize| (people.walks[a].places[0].y - people.walks[*b].places[0].y).abs() < WIDTH;
                let others = (0..200).filter(|b| *b != a).filter(near);
                let signs: Vec<f64> = others.map(|b| directions.signs[b] * directions.signs[a]).collect();
                (!signs.is_empty()).then(|| (signs.iter().sum::<f64>() / signs.len() as f64).powi(2))
            };
            let all: Vec<f64> = (0..200).filter_map(one).collect();
            assert!((found - all.iter().sum::<f64>() / all.len() as f64).abs() < 1e-9);
            assert!(if mixed { found < 0.1 } else { found > 0.5 }, "{found}");
        }
    }
}
