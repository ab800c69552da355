//! Convex hulls.

use glam::DVec2;
use throng::space::nearest_on_segment;

/// The convex hull of some points, counter-clockwise.
#[derive(Clone, Debug, Default)]
pub(super) struct Hull {
    corners: Vec<DVec2>,
}

impl Hull {
    /// Returns the hull of these points, by Andrew's monotone chain.
    pub fn of(places: impl IntoIterator<Item = DVec2>) -> Self {
        let mut places: Vec<DVec2> = places.into_iter().collect();
        places.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        places.dedup();
        if places.len() < 3 {
            return Self { corners: places };
        }
        let mut corners: Vec<DVec2> = Vec::new();
        let mut chain = |places: &mut dyn Iterator<Item = DVec2>| {
            let first = corners.len();
            for place in places {
                while let &[.., a, b] = &corners[first..]
                    && (b - a).perp_dot(place - a) <= 0.0
                {
                    corners.pop();
                }
                corners.push(place);
            }
            // the last point is the first of the other chain
            corners.pop();
        };
        chain(&mut places.iter().copied());
        chain(&mut places.iter().rev().copied());
        Self { corners }
    }

    /// Returns how far a point is outside the hull; 0 inside, infinite if the hull is empty.
    pub fn distance(&self, place: DVec2) -> f64 {
        let corners = &self.corners;
        let edges = || (0..corners.len()).map(|at| (corners[at], corners[(at + 1) % corners.len()]));
        if corners.len() > 2 && edges().all(|(a, b)| (b - a).perp_dot(place - a) >= 0.0) {
            return 0.0;
        }
        edges().map(|(a, b)| nearest_on_segment(a, b, place).distance(place)).fold(f64::INFINITY, f64::min)
    }
}
