//! Common parts of the experiments' scene files.

/// The free speeds of the participants of the HERMES experiments in straight corridors.
pub const HERMES: &str = "speed = { preferred = { normal = { mean = 1.55, deviation = 0.18 } }, max = 2.3 }";
/// The free speeds of pedestrians (Weidmann 1993).
pub const WEIDMANN: &str = "speed = { preferred = { normal = { mean = 1.34, deviation = 0.26 } }, max = 2.3 }";

/// A scene file that ends when the last agent has arrived, or at `limit` seconds.
pub fn until_empty(title: &str, limit: f64, rest: &str) -> String {
    format!("title = {title:?}\ntime = {{ step = 0.04, until = \"empty\", limit = {limit} }}\n{rest}")
}

/// A scene file that ends at `limit` seconds.
pub fn until(title: &str, limit: f64, rest: &str) -> String {
    format!("title = {title:?}\ntime = {{ step = 0.04, until = \"limit\", limit = {limit} }}\n{rest}")
}

/// A rectangle as scene files write it, from its lower left to its upper right corner.
pub fn rectangle([x, y]: [f64; 2], [to_x, to_y]: [f64; 2]) -> String {
    let (center, size) = ([0.5 * (x + to_x), 0.5 * (y + to_y)], [to_x - x, to_y - y]);
    format!("{{ center = [{:.4}, {:.4}], size = [{:.4}, {:.4}] }}", center[0], center[1], size[0], size[1])
}
