//! Placement of labels without overlaps.

use super::sheet::Rect;
use glam::Vec2;

/// The occupied parts of a panel.
pub(super) struct Labels {
    room: Rect,
    taken: Vec<Rect>,
}

impl Labels {
    pub(super) fn new(room: Rect) -> Self {
        Self { room, taken: Vec::new() }
    }

    /// Keeps labels away from a square around `center`.
    pub(super) fn keep(&mut self, center: Vec2, half: f32) {
        self.taken.push(Rect::around(center, Vec2::splat(half)));
    }

    /// Keeps labels off a line.
    pub(super) fn keep_line(&mut self, from: Vec2, to: Vec2, half: f32) {
        let count = (from.distance(to) / (2.0 * half)).ceil().clamp(1.0, 500.0);
        for k in 0..=count as usize {
            self.keep(from.lerp(to, k as f32 / count), half);
        }
    }

    /// Whether a label of this size fits around `center`.
    pub(super) fn fits(&self, center: Vec2, half: Vec2) -> bool {
        let label = Rect::around(center, half);
        self.room.contains(&label) && !self.taken.iter().any(|other| other.overlaps(&label))
    }

    /// Returns the first of the centres where a label of this size fits, and marks the space as occupied.
    pub(super) fn place(&mut self, half: Vec2, centers: impl IntoIterator<Item = Vec2>) -> Option<Vec2> {
        let center = centers.into_iter().find(|&center| self.fits(center, half))?;
        self.taken.push(Rect::around(center, half));
        Some(center)
    }
}

/// Returns centres for a label beside a point: nearest first, and at the same distance those closest to `direction`
/// first.
pub(super) fn beside(point: Vec2, half: Vec2, gap: f32, direction: Vec2) -> impl Iterator<Item = Vec2> {
    // At the middle of a side, or at a corner.
    let mut ways: Vec<Vec2> = [-1.0f32, 0.0, 1.0]
        .into_iter()
        .flat_map(|x| [Vec2::new(x, -1.0), Vec2::new(x, 1.0)])
        .chain([Vec2::X, Vec2::NEG_X])
        .collect();
    ways.sort_by(|a, b| b.normalize().dot(direction).total_cmp(&a.normalize().dot(direction)));
    [1.0, 1.6, 2.5, 4.0].into_iter().flat_map(move |far| {
        let center = move |way: Vec2| {
            let corner = way.x != 0.0 && way.y != 0.0;
            let x = way.x * if corner { half.x } else { half.x + far * gap };
            point + Vec2::new(x, way.y * (half.y + far * gap))
        };
        ways.clone().into_iter().map(center)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_labels_overlap_and_all_are_within() {
        let room = Rect { low: Vec2::ZERO, high: Vec2::splat(200.0) };
        let mut labels = Labels::new(room);
        let (point, half) = (Vec2::new(60.0, 100.0), Vec2::new(20.0, 8.0));
        labels.keep(point, 5.0);
        let placed: Vec<Vec2> = (0..8).filter_map(|_| labels.place(half, beside(point, half, 8.0, Vec2::X))).collect();
        assert!(placed.len() >= 5 && placed[0].x > point.x, "{placed:?}");
        for (i, a) in placed.iter().enumerate() {
            assert!(room.contains(&Rect::around(*a, half)));
            for b in &placed[..i] {
                assert!(!Rect::around(*a, half).overlaps(&Rect::around(*b, half)), "{a} {b}");
            }
        }
    }
}
