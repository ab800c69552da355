//! Statistics of noise: speed, duration, independence.

use super::{ALL, Chance, UNIT};
use glam::Vec3;
use throng_field::{CurlNoise, Octave, Potential};

/// Places so far apart that their velocities are independent.
fn places(count: usize, seed: u64) -> Vec<Vec3> {
    let mut chance = Chance(seed);
    (0..count).map(|_| chance.place(3000.0)).collect()
}

fn velocities(noise: &CurlNoise, places: &[Vec3], time: f64) -> Vec<Vec3> {
    let mut out = vec![Vec3::ZERO; places.len()];
    noise.velocities(places, time, &mut out);
    out
}

fn mean_product(one: &[Vec3], other: &[Vec3]) -> f64 {
    one.iter().zip(other).map(|(a, b)| f64::from(a.dot(*b))).sum::<f64>() / one.len() as f64
}

#[test]
fn speeds_are_those_that_were_asked_for() {
    let places = places(200_000, 5);
    for potential in ALL {
        for octaves in
            [vec![Octave { length: 0.3, period: 2.0, speed: 0.7 }], Octave::turbulence(2.0, 1.0, 0.7, 4).unwrap()]
        {
            let all = velocities(&CurlNoise::new(potential, &octaves, 3).unwrap(), &places, 4.0);
            let speed = mean_product(&all, &all).sqrt();
            assert!((speed / 0.7 - 1.0).abs() < 0.01, "{potential:?}: {speed}");
            let mean = all.iter().map(|v| v.as_dvec3()).sum::<glam::DVec3>() / all.len() as f64;
            assert!(mean.length() < 0.008, "{potential:?}: {mean}");
            // all directions are equally likely
            let square = |axis: usize| all.iter().map(|v| f64::from(v[axis]).powi(2)).sum::<f64>() / all.len() as f64;
            let axes = if potential == Potential::Plane { 2 } else { 3 };
            for axis in 0..axes {
                let part = square(axis) * f64::from(axes as u32) / (0.7 * 0.7);
                assert!((part - 1.0).abs() < 0.02, "{potential:?}, axis {axis}: {part}");
            }
        }
    }
}

/// Velocities of other seeds, octaves, individuals, times and places are independent.
#[test]
fn others_are_independent() {
    let places = places(100_000, 6);
    for potential in ALL {
        let noise = |seed: u64| CurlNoise::new(potential, &[UNIT], seed).unwrap();
        let of = |number: u32| {
            let mut out = vec![Vec3::ZERO; places.len()];
            noise(1).velocities_of_individuals(&places, &vec![number; places.len()], 2.0, &mut out);
            out
        };
        let two = CurlNoise::new(potential, &[UNIT, UNIT], 1).unwrap();
        let one = velocities(&noise(1), &places, 2.0);
        let second: Vec<Vec3> =
            velocities(&two, &places, 2.0).iter().zip(&one).map(|(both, first)| both - first).collect();
        let beside: Vec<Vec3> = places.iter().map(|place| place + Vec3::new(0.0, 1.0, 1.1)).collect();
        let all = [
            one,
            second,
            velocities(&noise(2), &places, 2.0),
            velocities(&noise(1), &places, 3.43),
            velocities(&noise(1), &beside, 2.0),
            of(0),
            of(1),
            of(2),
            of(0x8000_0000),
        ];
        for high in 1..all.len() {
            for low in 0..high {
                // in the plane, 1 m to the side is not yet far enough
                if (potential, low, high) == (Potential::Plane, 0, 4) {
                    continue;
                }
                let products = all[low].iter().zip(&all[high]).map(|(a, b)| f64::from(a.dot(*b)));
                let (sum, squares) = products.fold((0.0, 0.0), |(sum, squares), x| (sum + x, squares + x * x));
                // five standard deviations of a mean of zero
                assert!(sum.abs() < 5.0 * squares.sqrt(), "{potential:?} {low} {high}: {}", sum / places.len() as f64);
            }
        }
    }
}

#[test]
fn it_changes_within_its_period_and_its_length() {
    let places = places(50_000, 7);
    for potential in ALL {
        let octave = Octave { length: 0.5, period: 3.0, speed: 1.0 };
        let noise = CurlNoise::new(potential, &[octave], 9).unwrap();
        let now = velocities(&noise, &places, 0.0);
        let later = |periods: f64| mean_product(&now, &velocities(&noise, &places, 3.0 * periods));
        let [soon, half, end] = [0.05, 0.3, 1.42].map(later);
        assert!(soon > 0.95 && (0.2..0.8).contains(&half) && end.abs() < 0.02, "{potential:?}: {soon} {half} {end}");
        let beside = |lengths: f32| {
            let beside: Vec<Vec3> = places.iter().map(|place| place + Vec3::X * (0.5 * lengths)).collect();
            mean_product(&now, &velocities(&noise, &beside, 0.0))
        };
        let [near, apart] = [0.05, 1.42].map(beside);
        assert!(near > 0.9 && apart.abs() < 0.02, "{potential:?}: {near} {apart}");
    }
}

/// Along lines, in steps of a thousandth of a length: neither velocities nor their slopes jump.
#[test]
fn it_is_smooth() {
    let mut chance = Chance(8);
    for potential in ALL {
        let noise = CurlNoise::new(potential, &[UNIT], 2).unwrap();
        for _ in 0..20 {
            let (start, along, time) = (chance.place(1.0), chance.direction() / 1024.0, 9.0 * chance.unit());
            let places: Vec<Vec3> = (0..3000).map(|k| start + along * k as f32).collect();
            let all = velocities(&noise, &places, time);
            for part in all.windows(3) {
                let step = (part[1] - part[0]).length();
                let bend = (part[2] - 2.0 * part[1] + part[0]).length();
                assert!(step < 0.04 && bend < 6e-4, "{potential:?}: {step} {bend}");
            }
        }
    }
}
