//! Time to collision of a body that keeps its velocity, with another body or a wall. Local models that search velocities
//! use it (Fiorini, Shiller, IJRR 17(7), 1998; van den Berg, Lin, Manocha, Reciprocal velocity obstacles, ICRA 2008).

use crate::simd::Vec2s;
use fearless_simd::Simd;
use fearless_simd::prelude::*;
use glam::Vec2;

/// Returns the seconds until a point that moves with `velocity` comes within `radii` of `offset`; infinite if it never
/// does. A point that is already within and comes nearer collides now.
///
/// ```
/// use throng::space::time_to_disc;
/// # use glam::Vec2;
/// assert_eq!(time_to_disc(Vec2::new(3.0, 0.0), Vec2::new(2.0, 0.0), 1.0), 1.0);
/// assert_eq!(time_to_disc(Vec2::new(3.0, 0.0), Vec2::new(-2.0, 0.0), 1.0), f32::INFINITY);
/// ```
pub fn time_to_disc(offset: Vec2, velocity: Vec2, radii: f32) -> f32 {
    let approach = offset.dot(velocity);
    let gap = offset.length_squared() - radii * radii;
    if approach <= 0.0 {
        return f32::INFINITY;
    }
    if gap <= 0.0 {
        return 0.0;
    }
    let discriminant = approach * approach - velocity.length_squared() * gap;
    // gap / (b + root) is (b - root) / a without the cancellation
    if discriminant < 0.0 { f32::INFINITY } else { gap / (approach + discriminant.sqrt()) }
}

/// [`time_to_disc`] for one disc per element of a SIMD vector.
#[inline(always)]
pub(crate) fn times_to_discs<S: Simd>(simd: S, offset: Vec2s<S>, velocity: Vec2s<S>, radii: S::f32s) -> S::f32s {
    let (zero, never) = (S::f32s::splat(simd, 0.0), S::f32s::splat(simd, f32::INFINITY));
    let approach = offset.dot(velocity);
    let gap = offset.dot(offset) - radii * radii;
    let discriminant = approach * approach - velocity.dot(velocity) * gap;
    let time = gap / (approach + discriminant.sqrt());
    let time = gap.simd_le(zero).select(zero, discriminant.simd_lt(zero).select(never, time));
    approach.simd_le(zero).select(never, time)
}

/// Returns the seconds until a point that moves with `velocity` comes within `radius` of the segment from `start` to
/// `end`; infinite if it never does. A point that is already within and comes nearer collides now.
pub fn time_to_segment(start: Vec2, end: Vec2, velocity: Vec2, radius: f32) -> f32 {
    let along = end - start;
    let length = along.length();
    if length <= 0.0 {
        return time_to_disc(start, velocity, radius);
    }
    let along = along / length;
    // distance from the line, and the speed of approach
    let distance = along.perp_dot(start);
    let approach = along.perp_dot(velocity) * distance.signum();
    let gap = distance.abs() - radius;
    if approach <= 0.0 {
        let ends = || time_to_disc(start, velocity, radius).min(time_to_disc(end, velocity, radius));
        return if gap > 0.0 { f32::INFINITY } else { ends() };
    }
    // where the point comes within the radius of the line: beyond an end, only that end counts
    let time = (gap / approach).max(0.0);
    match along.dot(velocity * time - start) {
        reached if reached < 0.0 => time_to_disc(start, velocity, radius),
        reached if reached > length => time_to_disc(end, velocity, radius),
        _ => time,
    }
}

/// Whether an edge lies between the origin and the point at `offset`.
pub(crate) fn is_between(start: Vec2, end: Vec2, offset: Vec2) -> bool {
    let along = end - start;
    offset.perp_dot(start) * offset.perp_dot(end) < 0.0 && along.perp_dot(-start) * along.perp_dot(offset - start) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::perceive::SimdLevel;
    use crate::simd::{LANES, load, set};
    use fearless_simd::dispatch;
    use proptest::prelude::*;

    fn vector(most: f32) -> impl Strategy<Value = Vec2> {
        (-most..most, -most..most).prop_map(Vec2::from)
    }

    proptest! {
        #[test]
        fn simd_times_to_discs_equal_scalar_times(
            discs in prop::collection::vec((vector(4.0), vector(2.0), 0.0f32..2.0), LANES),
        ) {
            let (mut offsets, mut velocities, mut radii) = ([[0.0; LANES]; 2], [[0.0; LANES]; 2], [0.0; LANES]);
            for (lane, &(offset, velocity, radius)) in discs.iter().enumerate() {
                set(&mut offsets, lane, offset);
                set(&mut velocities, lane, velocity);
                radii[lane] = radius;
            }
            for level in SimdLevel::ALL.into_iter().filter_map(SimdLevel::level) {
                let times = dispatch!(level, simd => {
                    let (offset, velocity) = (Vec2s::load(simd, &offsets), Vec2s::load(simd, &velocities));
                    times_to_discs(simd, offset, velocity, load(simd, &radii)).as_slice().to_vec()
                });
                for (&(offset, velocity, radius), time) in discs.iter().zip(times) {
                    prop_assert_eq!(time, time_to_disc(offset, velocity, radius), "{:?}", level);
                }
            }
        }
    }
}
