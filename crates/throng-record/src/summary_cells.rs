//! The figures of a world's summary, by name.

use crate::Cell;
use throng::Summary;

/// Returns the figures of a summary under the names that `throng run --help` describes, in that order. A figure that is
/// unknown is NaN.
///
/// ```
/// use throng_record::{Cell, summary_cells};
/// let summary = throng::Summary { agents: 3, ..Default::default() };
/// assert_eq!(summary_cells(&summary)[0], ("agents", Cell::Whole(3)));
/// ```
pub fn summary_cells(summary: &Summary) -> [(&'static str, Cell); 22] {
    let s = summary;
    // The mean is undefined if no agent has arrived.
    let of_arrived = |value: f64| if s.arrived > 0 && value > 0.0 { value } else { f64::NAN };
    [
        ("agents", s.agents.into()),
        ("arrived", s.arrived.into()),
        ("removed", s.removed.into()),
        ("resting", s.resting.into()),
        ("queueing", s.hindered.queueing.into()),
        ("waiting_for_room", s.hindered.waiting_for_room.into()),
        ("blocked", s.hindered.blocked.into()),
        ("oscillating", s.hindered.oscillating.into()),
        ("stranded", s.stranded.into()),
        ("stuck", s.stuck.into()),
        ("without_progress_30s", s.without_progress_30s.into()),
        ("time", s.time.into()),
        ("time_ratio", of_arrived(s.time_ratio).into()),
        ("path_ratio", of_arrived(s.path_ratio).into()),
        ("least_separation", s.least_separation.into()),
        ("overlaps", s.overlaps.into()),
        ("guard_share", s.guard_share.into()),
        ("pushed_share", s.pushed_share.into()),
        ("backwards_share", s.backwards_share.into()),
        ("heading_change_deg_per_s", s.heading_change_deg_per_s.into()),
        ("course_change_deg_per_s", s.course_change_deg_per_s.into()),
        ("steps", s.steps.into()),
    ]
}
