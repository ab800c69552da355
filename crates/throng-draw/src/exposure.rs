//! Motion blur: pictures that are exposed for a part of the time between two pictures, as those of a film camera.

use crate::{Image, Projection, color};
use std::sync::LazyLock;
use throng_record::{Body, Frame};

/// The motion blur of films: each picture is the mean, in linear light, of the scene at several times while the shutter
/// is open.
///
/// The shutter is open for half of the time from one picture to the next: the shutter of 180° of film cameras.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionBlur {
    /// The time of the scene from one picture to the next, seconds, greater than 0.
    pub interval: f64,
    /// The number of times at which the scene is drawn for each picture, at least 1; `None` for 8 in plan view and 4 in
    /// perspective, where a picture takes long.
    pub samples: Option<u32>,
}

impl MotionBlur {
    /// The part of the interval for which the shutter is open.
    const OPEN: f64 = 0.5;

    /// Returns the number of samples of pictures in a projection.
    pub(crate) fn count(&self, projection: Projection) -> u32 {
        let usual = if projection == Projection::Plan { 8 } else { 4 };
        self.samples.unwrap_or(usual).max(1)
    }

    /// Returns the time of a sample, of `count`, of a picture; pictures and samples count from 0.
    pub(crate) fn time(&self, start: f64, picture: u64, (sample, count): (u32, u32)) -> f64 {
        let open = Self::OPEN * (f64::from(sample) + 0.5) / f64::from(count);
        start + (picture as f64 + open) * self.interval
    }
}

/// The sum of pictures in linear light.
#[derive(Debug, Default)]
pub(crate) struct Exposure {
    /// The sum of each channel, row by row, without alpha.
    sums: Vec<u32>,
    count: u32,
}

/// The greatest value of linear light.
const LIGHT: f64 = 65_535.0;

/// The linear light of each value of sRGB.
static LINEAR: LazyLock<[u16; 256]> = LazyLock::new(|| color::LIGHT.map(|light| (light * LIGHT).round() as u16));

/// The value of sRGB of linear light: the nearest of the values in [`LINEAR`].
static ENCODED: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let mut value = 0;
    let mut nearest = |light: u32| {
        while value < 255 && 2 * light > u32::from(LINEAR[value]) + u32::from(LINEAR[value + 1]) {
            value += 1;
        }
        value as u8
    };
    (0..=LIGHT as u32).map(&mut nearest).collect()
});

impl Exposure {
    /// Adds a picture. All pictures have the same size.
    pub fn add(&mut self, image: &Image) {
        let pixels = image.data().chunks_exact(4);
        self.sums.resize(3 * pixels.len(), 0);
        for (sum, pixel) in self.sums.chunks_exact_mut(3).zip(pixels) {
            sum.iter_mut().zip(pixel).for_each(|(sum, &value)| *sum += u32::from(LINEAR[usize::from(value)]));
        }
        self.count += 1;
    }

    /// Sets `image` to the mean of the pictures, and begins again.
    pub fn develop(&mut self, image: &mut Image) {
        let count = self.count.max(1);
        for (sum, pixel) in self.sums.chunks_exact_mut(3).zip(image.data_mut().chunks_exact_mut(4)) {
            sum.iter_mut().zip(pixel).for_each(|(sum, value)| {
                *value = ENCODED[((*sum + count / 2) / count) as usize];
                *sum = 0;
            });
        }
        self.count = 0;
    }
}

/// Returns the agents at a time from `before` to `after`. Agents in both move linearly, except those that have been moved
/// elsewhere; others are where their frame has them.
pub(crate) fn between(before: &Frame, after: &Frame, time: f64) -> Frame {
    let share = ((time - before.time) / (after.time - before.time)).clamp(0.0, 1.0);
    // Equal times: a run that has ended.
    let share = if share.is_nan() { 1.0 } else { share };
    let seconds = after.time - before.time;
    let mut frame = if share < 0.5 { before.clone() } else { after.clone() };
    let mut rest = before.bodies.as_slice();
    let mut bodies: Vec<Body> = Vec::with_capacity(after.bodies.len());
    for body in &after.bodies {
        // Both are sorted by number. Agents that have left stay until the step ends.
        let left = rest.iter().take_while(|other| other.number < body.number).count();
        if share < 1.0 {
            bodies.extend_from_slice(&rest[..left]);
        }
        rest = &rest[left..];
        match rest.split_first() {
            Some((last, others)) if last.number == body.number => {
                rest = others;
                bodies.push(if is_moved(last, body, seconds) {
                    if share < 0.5 { *last } else { *body }
                } else {
                    let basis = if share < 0.5 { last.basis } else { body.basis };
                    Body { basis, status: last.status, ..last.between(body, share) }
                });
            }
            _ if share >= 1.0 => bodies.push(*body),
            _ => {}
        }
    }
    if share < 1.0 {
        bodies.extend_from_slice(rest);
    }
    frame.bodies = bodies;
    frame.time = before.time + seconds * share;
    frame
}

/// Whether an agent has been moved elsewhere instead of moving: it is farther away than three times its speed leads it.
pub(crate) fn is_moved(before: &Body, after: &Body, seconds: f64) -> bool {
    let fast = f64::from(before.speed().max(after.speed()).max(before.preferred_speed));
    before.center().distance(after.center()) > 0.5 + 3.0 * fast * seconds
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Color;
    use glam::DVec2;

    fn body(number: u32, x: f64) -> Body {
        Body { number, position: DVec2::new(x, 0.0), preferred_speed: 1.0, ..crate::harness::body() }
    }

    fn frame(time: f64, bodies: &[(u32, f64)]) -> Frame {
        Frame { time, bodies: bodies.iter().map(|&(number, x)| body(number, x)).collect(), ..Frame::default() }
    }

    #[test]
    fn the_mean_of_pictures_is_that_of_their_light() {
        let mut exposure = Exposure::default();
        let mut image = Image::new(2, 1, Color::rgb(0));
        for value in 0..=255 {
            exposure.add(&Image::new(2, 1, Color { r: value, g: 255 - value, b: 7, a: 255 }));
            exposure.develop(&mut image);
            assert_eq!(
                image.pixel(1, 0),
                Color { r: value, g: 255 - value, b: 7, a: 255 },
                "one picture stays the same"
            );
        }
        [0, 0xff_ffff].into_iter().for_each(|hex| exposure.add(&Image::new(2, 1, Color::rgb(hex))));
        exposure.develop(&mut image);
        // half of the light is 188 in sRGB, not 128
        assert_eq!(image.pixel(0, 0), Color::rgb(0xbc_bcbc));
    }

    #[test]
    fn agents_move_between_frames_unless_they_are_moved() {
        let (before, after) =
            (frame(1.0, &[(1, 0.0), (2, 5.0), (4, 3.0)]), frame(1.5, &[(2, 5.5), (3, 7.0), (4, 90.0)]));
        let places = |time: f64| {
            let frame = between(&before, &after, time);
            assert_eq!(frame.time, time);
            frame.bodies.iter().map(|body| (body.number, body.position.x)).collect::<Vec<_>>()
        };
        assert_eq!(places(1.0), [(1, 0.0), (2, 5.0), (4, 3.0)]);
        assert_eq!(places(1.125), [(1, 0.0), (2, 5.125), (4, 3.0)]);
        assert_eq!(places(1.25), [(1, 0.0), (2, 5.25), (4, 90.0)]);
        assert_eq!(places(1.5), [(2, 5.5), (3, 7.0), (4, 90.0)]);
        assert_eq!(between(&after, &after, 2.0), after, "a run that has ended");
    }

    #[test]
    fn the_shutter_is_open_for_half_of_the_interval() {
        let blur = MotionBlur { interval: 0.1, samples: Some(5) };
        assert_eq!([Projection::Plan, Projection::Perspective].map(|projection| blur.count(projection)), [5, 5]);
        let times: Vec<f64> = (0..5).map(|sample| blur.time(2.0, 3, (sample, 5))).collect();
        assert!((times[0] - 2.305).abs() < 1e-12 && (times[4] - 2.345).abs() < 1e-12, "{times:?}");
    }
}
