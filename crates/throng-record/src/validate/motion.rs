//! The motion of agents, measured in every case: a crowd may have the flow of pedestrians while its agents do not move
//! like pedestrians.

use super::measure::quantile;
use super::{Figure, Run};
use crate::pedestrian::accelerations;
use glam::DVec2;

/// Returns the figures.
pub(super) fn figures() -> [Figure; 3] {
    [
        Figure::new("stuck", "", "times that an agent walked for 30 s without progress").within(0.0, 0.0),
        Figure::new("back", "", "share of the time in which agents walk away from their goals").within(0.0, 0.01),
        Figure::new("a p99", "m/s²", "99th percentile of the accelerations from one 0.08 s to the next")
            .within(0.0, 3.0)
            .people("1–2.3"),
    ]
}

/// Returns the values of the figures.
pub(super) fn measure(run: &Run) -> [f64; 3] {
    let all = run.people.walks.iter().flat_map(|walk| accelerations(walk, 1)).flatten();
    let acceleration = quantile(all.map(DVec2::length).collect(), 0.99);
    [run.summary.without_progress_30s as f64, run.summary.backwards_share, acceleration]
}
