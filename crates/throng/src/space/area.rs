//! provisional
use super::Walkable;
/// The union, as disjoint areas.
pub fn disjoint(areas: Vec<Walkable>) -> Vec<Walkable> {
    areas
}
