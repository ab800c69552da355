//! Curl noise, compared with its definition in `f64`, and with its documented properties.

mod reference;
mod statistics;
mod walls;

use glam::{DVec2, DVec3, Vec2, Vec3};
use proptest::prelude::*;
use reference::{Reference, curl, root_mean_square};
use throng::field::Field;
use throng::space::surface::Sphere;
use throng_field::{Amplitude, CurlNoise, FadeOut, Octave, Potential};

pub const ALL: [Potential; 3] = [Potential::Plane, Potential::Space, Potential::Crossed];

/// One octave of length, period and speed 1.
pub const UNIT: Octave = Octave { length: 1.0, period: 1.0, speed: 1.0 };

/// A linear congruential generator, independent of the library's.
pub struct Chance(pub u64);

impl Chance {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A place in a cube round the origin.
    pub fn place(&mut self, half: f64) -> Vec3 {
        let mut axis = || ((2.0 * self.unit() - 1.0) * half) as f32;
        Vec3::new(axis(), axis(), axis())
    }

    pub fn direction(&mut self) -> Vec3 {
        loop {
            let place = self.place(1.0);
            if (0.01..=1.0).contains(&place.length_squared()) {
                return place.normalize();
            }
        }
    }
}

fn octave() -> impl Strategy<Value = Octave> {
    let period = prop_oneof![4 => 0.05f32..20.0, 1 => Just(f32::INFINITY)];
    (0.03f32..5.0, period, 0.0f32..3.0).prop_map(|(length, period, speed)| Octave { length, period, speed })
}

fn fastest(octaves: &[Octave]) -> f64 {
    octaves.iter().map(|octave| f64::from(octave.speed)).sum()
}

/// Root mean square of the velocity from potentials of unit length and gradients of variance 1.
pub fn unit(potential: Potential) -> f64 {
    match potential {
        Potential::Plane => 0.039_540_563_9,
        Potential::Space => 0.049_629_325_1,
        Potential::Crossed => 0.001_184_754_34,
    }
}

#[test]
fn the_speed_of_unit_potentials_is_the_integral_that_it_should_be() {
    for potential in ALL {
        let (found, expected) = (unit(potential), root_mean_square(potential));
        assert!((found / expected - 1.0).abs() < 1e-6, "{potential:?}: {found}, {expected}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Near the origin and far from it, at the start and after days.
    #[test]
    fn velocities_are_the_curl_of_the_potential_by_definition(
        octaves in prop::collection::vec(octave(), 1..4), seed: u64, chance: u64,
        half in prop_oneof![0.5f64..30.0, Just(1e4)], latest in prop_oneof![Just(10.0), Just(1e6)],
    ) {
        let mut chance = Chance(chance);
        for potential in ALL {
            let unit = unit(potential);
            let noise = CurlNoise::new(potential, &octaves, seed).unwrap();
            let reference = Reference { potential, octaves: octaves.clone(), seed };
            for _ in 0..3 {
                let (place, time) = (chance.place(half), chance.unit() * latest);
                let finest = octaves.iter().map(|octave| f64::from(octave.length)).fold(f64::INFINITY, f64::min);
                let expected = curl(|p| reference.potential(p, time, unit), place.as_dvec3(), 1e-3 * finest);
                let found = noise.velocity(place, time).as_dvec3();
                let off = found.distance(expected);
                prop_assert!(off <= 1e-5 * (fastest(&octaves) + expected.length()), "{found} is not {expected}");
            }
        }
    }

    /// An amplitude multiplies the potential.
    #[test]
    fn amplitudes_scale_the_potential(seed: u64, chance: u64, radius in 0.5f32..3.0, width in 0.5f32..2.0) {
        let mut chance = Chance(chance);
        for potential in ALL {
            let unit = unit(potential);
            let octaves = vec![UNIT, Octave { length: 0.4, period: 0.7, speed: 0.3 }];
            let reference = Reference { potential, octaves: octaves.clone(), seed };
            let middle = chance.place(2.0);
            let cloud = FadeOut::new(Sphere::new(middle, radius).unwrap(), width).unwrap();
            let height = |place: Vec3, _: f64| (1.0 + 0.2 * place.x, Vec3::X * 0.2);
            let both = move |place: Vec3, time: f64| {
                let (a, b) = (cloud.at(place, time), height(place, time));
                (a.0 * b.0, a.1 * b.0 + b.1 * a.0)
            };
            let factor = |p: DVec3| {
                let r = 2.0 * (p.distance(middle.as_dvec3()) - f64::from(radius)) / f64::from(width) - 1.0;
                (0.5 - 0.5 * reference::ramp(r)) * (1.0 + 0.2 * p.x)
            };
            let noise = CurlNoise::new(potential, &octaves, seed).unwrap().with_amplitude(both);
            for _ in 0..3 {
                let distance = radius + width * chance.unit() as f32;
                let (place, time) = (middle + chance.direction() * distance, 7.0 * chance.unit());
                let flat = |p: DVec3| if potential == Potential::Plane { p.with_z(place.z.into()) } else { p };
                let scaled = |p: DVec3| factor(flat(p)) * reference.potential(p, time, unit);
                let expected = curl(scaled, place.as_dvec3(), 1e-3);
                let found = noise.velocity(place, time).as_dvec3();
                prop_assert!(found.distance(expected) < 3e-5 * (1.0 + expected.length()), "{found} is not {expected}");
            }
        }
    }

    /// The batch functions, for individuals and in rows.
    #[test]
    fn many_at_once_are_the_same_as_one_by_one(seed: u64, chance: u64, count in 0usize..70) {
        let mut chance = Chance(chance);
        let places: Vec<Vec3> = (0..count).map(|_| chance.place(9.0)).collect();
        let numbers: Vec<u32> = (0..count as u32).map(|index| index * 77).collect();
        for potential in ALL {
            let noise = CurlNoise::new(potential, &[UNIT, UNIT], seed).unwrap();
            let mut out = vec![Vec3::NAN; count + 2];
            noise.velocities(&places, 1.3, &mut out);
            prop_assert!(out[count..].iter().all(|v| v.is_nan()));
            for (&place, &found) in places.iter().zip(&out) {
                prop_assert_eq!(noise.velocity(place, 1.3), found);
            }
            noise.velocities_of_individuals(&places, &numbers, 1.3, &mut out);
            for at in 0..count {
                let mut alone = [Vec3::ZERO];
                noise.velocities_of_individuals(&places[at..], &numbers[at..=at], 1.3, &mut alone);
                prop_assert_eq!(alone[0], out[at]);
            }
            let mut row = vec![Vec2::ZERO; count];
            noise.row((DVec2::new(-3.0, 2.0), 0.07), 5, 1.3, &mut row);
            for (at, found) in row.into_iter().enumerate() {
                let place = DVec2::new(-3.0 + (at + 5) as f64 * 0.07, 2.0).as_vec2().extend(0.0);
                prop_assert_eq!(found, noise.velocity(place, 1.3).truncate());
            }
        }
    }
}

/// The divergence by differences of the velocities, by the fourth-order formula with two steps to both sides. Larger
/// steps increase the error of the formula, most where a third derivative jumps, at the end of a corner's reach;
/// smaller steps lose the digits of single precision. The greatest error shows both.
#[test]
fn nothing_comes_from_nowhere() {
    let mut chance = Chance(3);
    for potential in ALL {
        let noise = CurlNoise::new(potential, &[UNIT], 11).unwrap();
        let (step, count) = (1.0 / 256.0, 4000);
        let (mut squares, mut most) = (0.0, 0.0_f64);
        for _ in 0..count {
            // places and steps that single precision represents exactly
            let place = (chance.place(2.0) * 1024.0).round() / 1024.0;
            let time = chance.unit() * 9.0;
            let along = |axis: usize| {
                let at = |k: f32| f64::from(noise.velocity(place + Vec3::AXES[axis] * (k * step), time)[axis]);
                (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * f64::from(step))
            };
            let divergence: f64 = (0..3).map(along).sum();
            squares += divergence * divergence;
            most = most.max(divergence.abs());
        }
        let mean = (squares / f64::from(count)).sqrt();
        assert!(mean < 1e-4 && most < 1e-3, "{potential:?}: {mean}, at most {most}");
    }
}

/// By Gauss's theorem, the flow out of a small box over its volume is the mean divergence in it. Unlike differences at
/// a point, the integral over a face averages the rounding of single precision and needs no third derivative.
#[test]
fn nothing_flows_out_of_small_boxes() {
    // nodes and weights of the Gauss-Legendre quadrature on the interval from -1 to 1
    const POINTS: [(f32, f64); 6] = [
        (-0.932_469_5, 0.171_324_492_379_170_35),
        (-0.661_209_4, 0.360_761_573_048_138_6),
        (-0.238_619_2, 0.467_913_934_572_691_04),
        (0.238_619_2, 0.467_913_934_572_691_04),
        (0.661_209_4, 0.360_761_573_048_138_6),
        (0.932_469_5, 0.171_324_492_379_170_35),
    ];
    let mut chance = Chance(5);
    let half = 1.0 / 64.0;
    for potential in ALL {
        let noise = CurlNoise::new(potential, &[UNIT], 12).unwrap();
        for _ in 0..1000 {
            let (middle, time) = ((chance.place(2.0) * 1024.0).round() / 1024.0, chance.unit() * 9.0);
            let through = |axis: usize, side: f32| {
                let [x, y, z] = [0, 1, 2].map(|k| Vec3::AXES[(axis + k) % 3] * half);
                let points = POINTS.iter().flat_map(|&u| POINTS.iter().map(move |&v| (u, v)));
                let speeds = points.map(|((u, wu), (v, wv))| {
                    wu * wv * f64::from(noise.velocity(middle + x * side + y * u + z * v, time)[axis])
                });
                speeds.sum::<f64>() / 4.0
            };
            // mean speeds out of the faces over the side of the box: speed per length
            let out: f64 = (0..3).map(|axis| through(axis, 1.0) - through(axis, -1.0)).sum();
            let divergence = out / f64::from(2.0 * half);
            assert!(divergence.abs() < 1e-4, "{potential:?} at {middle}: {divergence}");
        }
    }
}

#[test]
fn in_the_plane_heights_do_not_matter_and_nothing_goes_up() {
    let noise = CurlNoise::new(Potential::Plane, &[UNIT], 1).unwrap();
    let at = |z: f32| noise.velocity(Vec3::new(3.0, 4.0, z), 5.0);
    assert!(at(0.0) == at(100.0) && at(0.0).z == 0.0 && at(0.0).length() > 0.0);
}

#[test]
fn nothing_of_what_is_not_finite() {
    for potential in ALL {
        let noise = CurlNoise::new(potential, &[UNIT], 1).unwrap();
        for (place, time) in [
            (Vec3::X * f32::NAN, 0.0),
            (Vec3::Y * f32::INFINITY, 0.0),
            (Vec3::ZERO, f64::NAN),
            (Vec3::ZERO, f64::NEG_INFINITY),
        ] {
            assert_eq!(noise.velocity(place, time), Vec3::ZERO, "{potential:?} {place} {time}");
        }
        assert!(noise.velocity(Vec3::splat(f32::MAX), 1e300).is_finite());
        let steep = |_: Vec3, _: f64| (f32::NAN, Vec3::ZERO);
        assert_eq!(noise.with_amplitude(steep).velocity(Vec3::ONE, 0.0), Vec3::ZERO);
    }
}

#[test]
fn what_is_out_of_its_limits_is_said() {
    let message = |octaves: &[Octave]| CurlNoise::new(Potential::Space, octaves, 0).unwrap_err().to_string();
    assert_eq!(message(&[]), "the number of octaves is 0, but must be from 1 to 16");
    assert_eq!(message(&[UNIT; 17]), "the number of octaves is 17, but must be from 1 to 16");
    let length = message(&[Octave { length: 0.0, ..UNIT }]);
    assert_eq!(length, "the length of an octave is 0, but must be greater than 0 and finite");
    for wrong in [f32::NAN, f32::NEG_INFINITY, -1.0] {
        for octave in
            [Octave { length: wrong, ..UNIT }, Octave { period: wrong, ..UNIT }, Octave { speed: wrong, ..UNIT }]
        {
            message(&[UNIT, octave]);
        }
        assert!(FadeOut::new(Sphere::new(Vec3::ZERO, 1.0).unwrap(), wrong).is_err());
    }
    assert!(Octave::turbulence(1.0, 1.0, 1.0, usize::MAX).is_err());
    assert!(Octave::turbulence(1.0, 0.0, 1.0, 1).is_err());
    // the last octave would underflow
    assert!(Octave::turbulence(1e-42, 1.0, 1.0, 16).is_err());
}
