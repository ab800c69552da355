//! A viewpoint that moves through keys.

use super::{CameraKey, Sight};

/// The precision of the time of a picture, seconds: a picture at the time of a cut is behind the cut.
const PRECISION: f64 = 1e-10;

/// Returns the viewpoint and the field of view, degrees, at a time; `None` without keys. Before the first key it is
/// that of the first, after the last key that of the last. `usual` is the field of view of keys without one.
///
/// Between keys it moves on cubic Hermite curves. The velocity at a key is that from the key before to the key after;
/// it is 0 at the first and last key of a shot, so that movements begin and end softly.
pub(super) fn at(keys: &[CameraKey], time: f64, usual: f64) -> Option<(Sight, f64)> {
    let next = keys.partition_point(|key| key.time <= time + PRECISION);
    let (first, last) = (keys.first()?, keys.last()?);
    let values = |key: &CameraKey| Values {
        sight: Sight { eye: key.eye, target: key.target },
        angle: key.field_of_view.unwrap_or(usual),
    };
    let values_of = |values: Values| (values.sight, values.angle);
    if next == 0 {
        return Some(values_of(values(first)));
    }
    let Some(to) = keys.get(next) else { return Some(values_of(values(last))) };
    let from = &keys[next - 1];
    let span = to.time - from.time;
    if to.cut || span <= 0.0 {
        return Some(values_of(values(from)));
    }
    // The velocity at a key: zero where a shot begins or ends.
    let velocity = |index: usize| {
        let whole = index > 0 && !keys[index].cut && keys.get(index + 1).is_some_and(|after| !after.cut);
        let (before, after) = (keys.get(index.wrapping_sub(1))?, keys.get(index + 1)?);
        let time = after.time - before.time;
        (whole && time > 0.0).then(|| values(after).plus(values(before), -1.0).times(1.0 / time))
    };
    let t = ((time - from.time) / span).clamp(0.0, 1.0);
    let (square, cube) = (t * t, t * t * t);
    let rise = 3.0 * square - 2.0 * cube;
    let mut now = values(from).times(1.0 - rise).plus(values(to), rise);
    for (index, part) in [(next - 1, cube - 2.0 * square + t), (next, cube - square)] {
        if let Some(velocity) = velocity(index) {
            now = now.plus(velocity, part * span);
        }
    }
    Some(values_of(now))
}

/// What moves from key to key.
#[derive(Clone, Copy)]
struct Values {
    sight: Sight,
    angle: f64,
}

impl Values {
    fn times(self, factor: f64) -> Self {
        let Self { sight: Sight { eye, target }, angle } = self;
        Self { sight: Sight { eye: eye * factor, target: target * factor }, angle: angle * factor }
    }

    fn plus(self, other: Self, factor: f64) -> Self {
        let other = other.times(factor);
        let sight = Sight { eye: self.sight.eye + other.sight.eye, target: self.sight.target + other.sight.target };
        Self { sight, angle: self.angle + other.angle }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn key(time: f64, x: f64, cut: bool) -> CameraKey {
        let eye = DVec3::new(x, -10.0, 5.0);
        CameraKey { time, eye, target: DVec3::new(0.5 * x, 0.0, 1.0), field_of_view: (x > 5.0).then_some(20.0), cut }
    }

    fn eye(keys: &[CameraKey], time: f64) -> f64 {
        at(keys, time, 40.0).unwrap().0.eye.x
    }

    #[test]
    fn it_is_at_each_key_at_its_time_and_rests_beyond() {
        let keys = [key(1.0, 0.0, false), key(2.0, 4.0, false), key(4.0, 10.0, false), key(5.0, 3.0, true)];
        for key in keys {
            let (sight, angle) = at(&keys, key.time, 40.0).unwrap();
            assert_eq!((sight.eye, sight.target), (key.eye, key.target));
            assert_eq!(angle, key.field_of_view.unwrap_or(40.0));
        }
        assert_eq!((eye(&keys, -3.0), eye(&keys, 9.0)), (0.0, 3.0));
        assert_eq!(at(&[], 0.0, 40.0), None);
    }

    #[test]
    fn it_moves_smoothly_within_a_shot_and_jumps_at_a_cut() {
        let keys = [key(1.0, 0.0, false), key(2.0, 4.0, false), key(4.0, 10.0, false), key(5.0, 3.0, true)];
        let speed = |time: f64| (eye(&keys, time + 1e-6) - eye(&keys, time - 1e-6)) / 2e-6;
        for time in [1.0, 2.0, 4.0] {
            let (before, after) = (speed(time - 1e-4), speed(time + 1e-4));
            assert!((before - after).abs() < 0.02, "{before} and {after} m/s about {time} s");
        }
        assert!((speed(2.0) - 10.0 / 3.0).abs() < 1e-3, "the velocity from the key before to the key after");
        assert_eq!(eye(&keys, 4.999), 10.0, "it rests until the cut");
        assert_eq!(eye(&keys, 5.0 - 1e-12), 3.0, "times are sums of steps");
        assert_eq!(eye(&keys, 5.0), 3.0);
    }

    #[test]
    fn keys_at_one_time_are_a_cut() {
        let keys = [key(0.0, 0.0, false), key(1.0, 1.0, false), key(1.0, 7.0, false), key(2.0, 8.0, false)];
        assert!((eye(&keys, 1.0 - 1e-9) - 1.0).abs() < 1e-6);
        assert_eq!(eye(&keys, 1.0), 7.0);
    }
}
