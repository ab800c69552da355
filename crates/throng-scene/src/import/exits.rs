//! Exits of imported files: often thinner than a body, or outside the ground.

use super::notes::Notes;
use crate::assemble::has_room;
use crate::geometry::{DVec2, Solid, grown};
use crate::scene::Region;

/// Returns the region of an exit, or of a stop. If the centre of a body has no room in it, it is made larger, with a
/// note.
pub(crate) fn roomy(solid: &Solid, corners: &[DVec2], radius: f64, what: &str, notes: &mut Notes) -> Region {
    let enough = has_room(solid, corners, radius);
    let larger = if enough { corners.to_vec() } else { grown(corners, radius * 1.1) };
    if !enough {
        let how = if has_room(solid, &larger, radius) { "made larger" } else { "no agent can enter" };
        notes.about(what, format!("no room for the centre of a body of radius {radius}: {how}"));
    }
    Region::Polygon(larger.iter().map(DVec2::to_array).collect())
}
