//! The nearest neighbours of points.

use kiddo::{ImmutableKdTree, SquaredEuclidean};
use std::num::NonZero;

/// Returns the neighbours of all places: the start of each list and the end, the rows, and the distances.
pub fn nearest(places: &[[f64; 2]], k: usize, distance: f64) -> (Vec<i64>, Vec<i64>, Vec<f64>) {
    let (mut start, mut rows, mut distances) = (vec![0], vec![], vec![]);
    let most = NonZero::new(k.saturating_add(1).min(places.len().max(1))).unwrap_or(NonZero::<usize>::MIN);
    let Ok(tree) = ImmutableKdTree::<f64, 2>::new_from_slice(places) else {
        return (vec![0; places.len() + 1], rows, distances);
    };
    for (own, place) in places.iter().enumerate() {
        let found = tree.query(place).nearest_n::<SquaredEuclidean<f64>>(most).execute();
        let mut found: Vec<(f64, i64)> = found.iter().map(|near| (near.distance, i64::from(near.item))).collect();
        found.retain(|&(squared, _)| squared <= distance * distance);
        // equal distances in the order of rows
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let others = found.into_iter().filter(|&(_, row)| row != own as i64).take(k);
        for (squared, row) in others {
            rows.push(row);
            distances.push(squared.sqrt());
        }
        start.push(rows.len() as i64);
    }
    (start, rows, distances)
}
