//! What tells goals apart.

use crate::geometry::DVec2;
use throng::Goal;

/// The kind and the coordinates of a goal.
#[derive(PartialEq, Eq, Hash)]
pub(super) struct GoalKey(&'static str, Vec<u64>);

impl GoalKey {
    pub fn of(goal: &Goal) -> Self {
        // 0 is -0
        let bits = |numbers: &[f64]| numbers.iter().map(|x| (x + 0.0).to_bits()).collect();
        let corners = |corners: &[DVec2]| bits(&corners.iter().flat_map(DVec2::to_array).collect::<Vec<_>>());
        match goal {
            Goal::Point { at, tolerance } => Self("point", bits(&[at.x, at.y, (*tolerance).into()])),
            Goal::Air { at, tolerance } => Self("air", bits(&[at.x, at.y, at.z, (*tolerance).into()])),
            Goal::Area { corners: area } => Self("area", corners(area)),
            Goal::Exit { corners: exit } => Self("exit", corners(exit)),
        }
    }
}
