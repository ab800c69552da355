//! Curl noise by its definition, in `f64`: sums over all nearby corners of the lattice, regardless of the simplex of
//! the place, and curls by differences.

use glam::DVec3;
use throng_field::{Octave, Potential};

fn mix(mut bits: u32) -> u32 {
    bits = (bits ^ (bits >> 16)).wrapping_mul(0x7feb_352d);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x846c_a68b);
    bits ^ (bits >> 16)
}

fn mix_again(bits: u32) -> u32 {
    let bits = bits.wrapping_add(0x9e37_79b9).wrapping_mul(0x21f0_aaad);
    let bits = (bits ^ (bits >> 15)).wrapping_mul(0x735a_2d97);
    bits ^ (bits >> 15)
}

/// SplitMix64, as for all random numbers of the library.
fn split_mix(mut z: u64) -> u64 {
    z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The seed of an octave.
fn seed_of(seed: u64, octave: u64) -> u32 {
    const EDDIES: u64 = 10;
    split_mix(split_mix(split_mix(seed ^ 0x7468_726f_6e67)).wrapping_add((octave << 8) | EDDIES)) as u32
}

/// `count` noises; the number of dimensions is that of the coordinates.
pub fn simplex(at: &[f64], seed: u32, count: usize) -> Vec<f64> {
    const FACTORS: [u32; 4] = [0x9e37_79b1, 0x85eb_ca77, 0xc2b2_ae3d, 0x27d4_eb2f];
    let d = at.len();
    let root = (d as f64 + 1.0).sqrt();
    let (skew, unskew) = ((root - 1.0) / d as f64, (1.0 - 1.0 / root) / d as f64);
    let sum: f64 = at.iter().sum();
    let base: Vec<i64> = at.iter().map(|x| (x + sum * skew).floor() as i64).collect();
    let mut out = vec![0.0; count];
    for index in 0..5_usize.pow(d as u32) {
        let cell: Vec<i64> = (0..d).map(|k| base[k] - 2 + (index / 5_usize.pow(k as u32) % 5) as i64).collect();
        let back = cell.iter().sum::<i64>() as f64 * unskew;
        let offset: Vec<f64> = (0..d).map(|k| at[k] - cell[k] as f64 + back).collect();
        let t = 0.5 - offset.iter().map(|x| x * x).sum::<f64>();
        if t <= 0.0 {
            continue;
        }
        let hash = (0..d).fold(seed, |hash, k| hash ^ (cell[k] as u32).wrapping_mul(FACTORS[k]));
        let mut hash = mix(hash);
        for (k, out) in out.iter_mut().enumerate() {
            if k > 0 {
                hash = mix_again(hash);
            }
            let ahead = (0..d).map(|k| (f64::from(hash >> (8 * k) & 0xff) - 127.5) * offset[k]).sum::<f64>();
            *out += t.powi(4) * ahead;
        }
    }
    out
}

/// The integrals that set the speed: the mean square of the velocity over a cell of the lattice, by a sum over a
/// regular grid in it. Each corner contributes its mean over gradients of all directions.
pub fn root_mean_square(potential: Potential) -> f64 {
    let d = if potential == Potential::Plane { 3 } else { 4 };
    let per_axis = if d == 3 { 32_usize } else { 14 };
    let unskew = (1.0 - 1.0 / (d as f64 + 1.0).sqrt()) / d as f64;
    let mut total = 0.0;
    for index in 0..per_axis.pow(d) {
        let skewed: Vec<f64> =
            (0..d).map(|k| ((index / per_axis.pow(k) % per_axis) as f64 + 0.5) / per_axis as f64).collect();
        let sum: f64 = skewed.iter().sum();
        // covariance of the derivatives along two axes
        let mut together = [[0.0; 3]; 3];
        for corner in 0..4_usize.pow(d) {
            let cell: Vec<f64> = (0..d).map(|k| (corner / 4_usize.pow(k) % 4) as f64 - 1.0).collect();
            let back = (sum - cell.iter().sum::<f64>()) * unskew;
            let offset: Vec<f64> = skewed.iter().zip(&cell).map(|(x, cell)| x - cell - back).collect();
            let t = (0.5 - offset.iter().map(|x| x * x).sum::<f64>()).max(0.0);
            let slope = |i: usize, j: usize| t.powi(4) * f64::from(i == j) - 8.0 * t.powi(3) * offset[i] * offset[j];
            for (i, row) in together.iter_mut().enumerate().take(d as usize - 1) {
                for (j, entry) in row.iter_mut().enumerate().take(d as usize - 1) {
                    *entry += (0..d as usize).map(|k| slope(i, k) * slope(j, k)).sum::<f64>();
                }
            }
        }
        let trace = (0..3).map(|i| together[i][i]).sum::<f64>();
        let squares = together.iter().flatten().map(|x| x * x).sum::<f64>();
        total += match potential {
            Potential::Plane => trace,
            Potential::Space => 2.0 * trace,
            Potential::Crossed => trace * trace - squares,
        };
    }
    (total / per_axis.pow(d) as f64).sqrt()
}

/// Curl noise, with a modified potential at a place.
pub struct Reference {
    pub potential: Potential,
    pub octaves: Vec<Octave>,
    pub seed: u64,
}

impl Reference {
    /// The vector potential, summed over all octaves.
    pub fn potential(&self, p: DVec3, time: f64, unit: f64) -> DVec3 {
        let variance = 65_535.0_f64 / 12.0;
        let mut sum = DVec3::ZERO;
        for (index, octave) in self.octaves.iter().enumerate() {
            let (length, t) = (f64::from(octave.length), time / f64::from(octave.period));
            let scale = f64::from(octave.speed) * length / unit / variance.sqrt();
            let (q, seed) = (p / length, seed_of(self.seed, index as u64));
            sum += scale
                * match self.potential {
                    Potential::Plane => DVec3::Z * simplex(&[q.x, q.y, t], seed, 1)[0],
                    Potential::Space => DVec3::from_slice(&simplex(&[q.x, q.y, q.z, t], seed, 3)),
                    Potential::Crossed => {
                        let noise = |q: DVec3| simplex(&[q.x, q.y, q.z, t], seed, 2);
                        let slope = |axis: DVec3| (noise(q + axis * 1e-5)[1] - noise(q - axis * 1e-5)[1]) / 2e-5;
                        noise(q)[0] * DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z)) / variance.sqrt()
                    }
                };
        }
        sum
    }
}

/// The curl of a vector potential at a place.
pub fn curl(potential: impl Fn(DVec3) -> DVec3, p: DVec3, step: f64) -> DVec3 {
    let along = |axis: DVec3| {
        let at = |k: f64| potential(p + axis * (k * step));
        (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step)
    };
    let [x, y, z] = DVec3::AXES.map(along);
    DVec3::new(y.z - z.y, z.x - x.z, x.y - y.x)
}

/// `15/8 r - 10/8 r^3 + 3/8 r^5` between -1 and 1.
pub fn ramp(r: f64) -> f64 {
    let r = r.clamp(-1.0, 1.0);
    1.875 * r - 1.25 * r.powi(3) + 0.375 * r.powi(5)
}
