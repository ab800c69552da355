//! Velocities without divergence, from noise potentials.

use super::Amplitude;
use super::octave::{Octave, check_count};
use super::simplex::{Jets, VARIANCE, Wide, individual, simplex};
use super::wall::{Influence, NoiseWall, influences};
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::{DVec2, Vec2, Vec3};
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::parameters::parameters;
use throng::random::{Purpose, bits};
use throng::simd::{LANES, Vec3s, get3, load, set3};

/// The root mean square velocity of noise of unit length with gradients of unit variance in each component: integrals
/// over a cell of the lattice.
const PLANE: f64 = 0.039_540_563_930_1;
const SPACE: f64 = 0.049_629_325_054_3;
const CROSSED: f64 = 0.001_184_754_340_8;

/// The potential of which the noise is the curl.
#[parameters]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Potential {
    /// A flow along the ground.
    ///
    /// It is the same at every height: `(d psi / dy, -d psi / dx)` of one noise `psi`.
    #[default]
    Plane,
    /// A flow in space.
    ///
    /// It is the curl of three noises.
    Space,
    /// A flow in space that is faster and less uniform.
    ///
    /// It is the cross product of the gradients of two noises: calm in most places and strong in some, as a product of two
    /// noises is. DeWolf, *Divergence-free noise*, 2005.
    Crossed,
}

/// Curl noise: a random velocity that varies smoothly in space and time, has no sources or sinks, and flows along
/// walls.
///
/// Bridson, Hourihan, Nordenstam, *Curl-noise for procedural fluid flow*, SIGGRAPH 2007: the velocity is the curl of a
/// potential, so every change of the potential leaves it free of divergence. Near walls the potential is multiplied by
/// a ramp `a` of the distance that is zero on the wall. In space this scales the whole potential, while the paper keeps
/// its component along the normal. The velocity is `a curl psi + grad a x psi`; on the wall `a = 0` and `grad a` is
/// along the normal, so nothing flows through. This needs only the gradient of the distance, which every surface has.
/// On moving walls the potential becomes that of the wall's motion. Gradients of the noise are exact, not finite
/// differences.
///
/// Curl noise does not keep agents apart: agents that follow it can meet.
///
/// Octaves are independent noises, as are different seeds and [individuals](Self::velocities_of_individuals).
/// [`Amplitude`]s may vary freely. To add other fields, use [`Sum`](crate::Sum). The velocity is zero where
/// a place or the time is not finite.
///
/// ```
/// use glam::Vec3;
/// use throng::field::Field;
/// use throng_field::{CurlNoise, NoiseWall, Octave, Potential};
/// use throng::space::surface::Sphere;
/// let octaves = Octave::turbulence(0.5, 0.6, 0.3, 2)?;
/// let lamp = NoiseWall::new(Sphere::new(Vec3::ZERO, 0.2)?, 0.5)?;
/// let noise = CurlNoise::new(Potential::Space, &octaves, 7)?.with_wall(lamp);
/// let on_the_lamp = noise.velocity(Vec3::X * 0.2, 3.0);
/// assert!(on_the_lamp.x.abs() < 1e-6, "nothing flows into it");
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone)]
pub struct CurlNoise {
    potential: Potential,
    eddies: Vec<Eddies>,
    amplitude: Option<Arc<dyn Amplitude>>,
    walls: Vec<NoiseWall>,
}

/// An octave with its precomputed factors.
#[derive(Clone, Copy, Debug)]
struct Eddies {
    octave: Octave,
    seed: u32,
    /// Inverse length, per metre; inverse period, per second.
    per_length: f64,
    per_period: f64,
    /// Factors of the derivatives and of the values of the noise.
    speed: f32,
    potential: f32,
}

impl CurlNoise {
    /// Creates noise of these octaves.
    ///
    /// # Errors
    /// No octaves or more than 16; an octave out of its limits.
    pub fn new(potential: Potential, octaves: &[Octave], seed: u64) -> Result<Self, Error> {
        check_count(octaves.len())?;
        octaves.iter().try_for_each(Octave::check)?;
        let unit = match potential {
            Potential::Plane => PLANE * VARIANCE.sqrt(),
            Potential::Space => SPACE * VARIANCE.sqrt(),
            Potential::Crossed => CROSSED * VARIANCE,
        };
        let eddies = |(index, &octave): (usize, &Octave)| Eddies {
            octave,
            seed: bits(seed, index as u32, 0, Purpose::Eddies) as u32,
            per_length: 1.0 / f64::from(octave.length),
            per_period: 1.0 / f64::from(octave.period),
            speed: (f64::from(octave.speed) / unit) as f32,
            potential: (f64::from(octave.speed) / unit * f64::from(octave.length)) as f32,
        };
        let eddies = octaves.iter().enumerate().map(eddies).collect();
        Ok(Self { potential, eddies, amplitude: None, walls: Vec::new() })
    }

    /// Sets the amplitude; by default it is 1 everywhere.
    pub fn with_amplitude(self, amplitude: impl Amplitude + 'static) -> Self {
        Self { amplitude: Some(Arc::new(amplitude)), ..self }
    }

    /// Adds a wall. Where walls are closer to each other than their widths, both count.
    pub fn with_wall(mut self, wall: NoiseWall) -> Self {
        self.walls.push(wall);
        self
    }

    /// Returns the potential of the velocities.
    pub fn potential(&self) -> Potential {
        self.potential
    }

    /// Returns the octaves.
    pub fn octaves(&self) -> impl ExactSizeIterator<Item = Octave> + '_ {
        self.eddies.iter().map(|eddies| eddies.octave)
    }

    /// Computes the velocities at many places. The result equals that of [`velocity`](Field::velocity) at each place,
    /// and is faster.
    pub fn velocities(&self, places: &[Vec3], time: f64, out: &mut [Vec3]) {
        self.velocities_at(Level::new(), (places, None), time, out);
    }

    /// Computes the velocities of individuals at their places. Each individual has its own noise, given by its number.
    ///
    /// ```
    /// use glam::Vec3;
    /// use throng_field::{CurlNoise, Octave, Potential};
    /// let octaves = Octave::turbulence(0.5, 0.6, 0.3, 1)?;
    /// let noise = CurlNoise::new(Potential::Space, &octaves, 7)?;
    /// let mut out = [Vec3::ZERO; 3];
    /// noise.velocities_of_individuals(&[Vec3::X; 3], &[0, 1, 0], 2.0, &mut out);
    /// assert!(out[0] != out[1] && out[0] == out[2]);
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn velocities_of_individuals(&self, places: &[Vec3], numbers: &[u32], time: f64, out: &mut [Vec3]) {
        self.velocities_at(Level::new(), (places, Some(numbers)), time, out);
    }

    /// As [`velocities`](Self::velocities), with this instruction set. The shortest list sets the number of places.
    pub(crate) fn velocities_at(
        &self,
        level: Level,
        (places, numbers): (&[Vec3], Option<&[u32]>),
        time: f64,
        out: &mut [Vec3],
    ) {
        let count = places.len().min(out.len()).min(numbers.map_or(usize::MAX, <[u32]>::len));
        let (places, out) = (&places[..count], &mut out[..count]);
        dispatch!(level, simd => self.all(simd, (places, numbers), time, out));
    }

    #[inline(always)]
    fn all<S: Simd>(&self, simd: S, (places, numbers): (&[Vec3], Option<&[u32]>), time: f64, out: &mut [Vec3]) {
        for start in (0..places.len()).step_by(S::f32s::LEN) {
            let part = start..(start + S::f32s::LEN).min(places.len());
            let numbers = numbers.map(|all| &all[part.clone()]);
            self.vector(simd, (&places[part.clone()], numbers), time, &mut out[part]);
        }
    }

    /// Computes at most one SIMD vector of velocities; with `numbers`, each individual has its own noise.
    #[inline(always)]
    pub(crate) fn vector<S: Simd>(
        &self,
        simd: S,
        (places, numbers): (&[Vec3], Option<&[u32]>),
        time: f64,
        out: &mut [Vec3],
    ) {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let mut columns = [[0.0; LANES]; 3];
        for (lane, place) in places.iter().enumerate() {
            set3(&mut columns, lane, *place);
        }
        let place = Vec3s::load(simd, &columns);
        let seed = match numbers {
            None => S::u32s::splat(simd, 0),
            Some(numbers) => {
                let mut padded = [0; LANES];
                padded[..numbers.len()].copy_from_slice(numbers);
                individual(simd, S::u32s::from_slice(simd, &padded[..S::u32s::LEN]))
            }
        };
        let zero = Vec3s::splat(simd, Vec3::ZERO);
        let (mut potential, mut curl) = (zero, zero);
        for eddies in &self.eddies {
            let (psi, v) = eddies.at(simd, self.potential, place, time, seed);
            potential = potential + psi * splat(eddies.potential);
            curl = curl + v * splat(eddies.speed);
        }
        let velocity = if self.walls.is_empty() && self.amplitude.is_none() {
            curl
        } else {
            let mut all = [Influence::NONE; LANES];
            self.influence(places, time, &mut all);
            let (mut slope, mut more, mut factor) = ([[0.0; LANES]; 3], [[0.0; LANES]; 3], [0.0; LANES]);
            for (lane, one) in all.iter().enumerate() {
                set3(&mut slope, lane, one.slope);
                set3(&mut more, lane, one.more);
                factor[lane] = one.factor;
            }
            curl * load(simd, &factor) + Vec3s::load(simd, &slope).cross(potential) + Vec3s::load(simd, &more)
        };
        let is_finite = velocity.x.is_finite() & velocity.y.is_finite() & velocity.z.is_finite();
        Vec3s::select(is_finite, velocity, zero).store(&mut columns);
        out.iter_mut().enumerate().for_each(|(lane, out)| *out = get3(&columns, lane));
    }

    /// Computes the influence of the walls and the amplitude on the potential.
    #[inline(never)]
    fn influence(&self, places: &[Vec3], time: f64, out: &mut [Influence; LANES]) {
        influences(&self.walls, places, time, self.potential == Potential::Plane, out);
        if let Some(amplitude) = &self.amplitude {
            for (&place, out) in places.iter().zip(out) {
                let (factor, slope) = amplitude.at(place, time);
                let slope = if self.potential == Potential::Plane { slope.with_z(0.0) } else { slope };
                out.scale((factor, slope));
            }
        }
    }
}

impl Eddies {
    /// Returns a vector potential, divided by the length, and its curl. Gradients are not normalised: their components
    /// are bytes.
    #[inline(always)]
    fn at<S: Simd>(
        &self,
        simd: S,
        potential: Potential,
        place: Vec3s<S>,
        time: f64,
        seed: S::u32s,
    ) -> (Vec3s<S>, Vec3s<S>) {
        let seed = seed ^ S::u32s::splat(simd, self.seed);
        let scale = S::f64s::splat(simd, self.per_length);
        let wide = |x: S::f32s| -> Wide<S> {
            let (low, high) = x.widen();
            (low * scale, high * scale)
        };
        let time = S::f64s::splat(simd, time * self.per_period);
        let (x, y, z, t) = (wide(place.x), wide(place.y), wide(place.z), (time, time));
        let zero = S::f32s::splat(simd, 0.0);
        match potential {
            Potential::Plane => {
                let Jets { value: [psi], slope: [[dx, dy, _]] } = simplex::<S, 3, 1>(simd, [x, y, t], seed);
                (Vec3s { x: zero, y: zero, z: psi }, Vec3s { x: dy, y: -dx, z: zero })
            }
            Potential::Space => {
                let jets = simplex::<S, 4, 3>(simd, [x, y, z, t], seed);
                let ([x, y, z], [a, b, c]) = (jets.value, jets.slope);
                (Vec3s { x, y, z }, Vec3s { x: c[1] - b[2], y: a[2] - c[0], z: b[0] - a[1] })
            }
            Potential::Crossed => {
                let jets = simplex::<S, 4, 2>(simd, [x, y, z, t], seed);
                let gradient = |[x, y, z, _]: [S::f32s; 4]| Vec3s { x, y, z };
                let [f, g] = jets.slope.map(gradient);
                // the curl of f grad g
                (g * jets.value[0], f.cross(g))
            }
        }
    }
}

impl Field for CurlNoise {
    fn velocity(&self, place: Vec3, time: f64) -> Vec3 {
        let mut out = [Vec3::ZERO];
        self.velocities(&[place], time, &mut out);
        out[0]
    }

    fn row(&self, (first, step): (DVec2, f64), from: usize, time: f64, out: &mut [Vec2]) {
        for (part, out) in out.chunks_mut(LANES).enumerate() {
            let place = |lane: usize| first + DVec2::X * ((from + part * LANES + lane) as f64 * step);
            let places: [Vec3; LANES] = std::array::from_fn(|lane| place(lane).as_vec2().extend(0.0));
            let mut velocities = [Vec3::ZERO; LANES];
            self.velocities(&places[..out.len()], time, &mut velocities);
            out.iter_mut().zip(velocities).for_each(|(out, velocity)| *out = velocity.truncate());
        }
    }
}

impl fmt::Debug for CurlNoise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { potential, walls, .. } = self;
        let octaves: Vec<Octave> = self.octaves().collect();
        let mut all = f.debug_struct("CurlNoise");
        all.field("potential", potential).field("octaves", &octaves).field("walls", walls).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng::perceive::SimdLevel;
    use throng::space::surface::Sphere;

    #[test]
    fn all_instructions_give_the_same_bits() {
        let places: Vec<Vec3> =
            (0..77).map(|k| Vec3::new(0.31 * k as f32 - 9.0, 400.0 - 7.7 * k as f32, 0.05 * k as f32)).collect();
        let octaves = Octave::turbulence(0.7, 0.4, 1.0, 3).unwrap();
        for potential in [Potential::Plane, Potential::Space, Potential::Crossed] {
            let wall = NoiseWall::new(Sphere::new(Vec3::new(3.0, 100.0, 2.0), 50.0).unwrap(), 300.0).unwrap();
            let noise = CurlNoise::new(potential, &octaves, 5).unwrap().with_wall(wall);
            let with = |level: Level| {
                let mut out = vec![Vec3::ZERO; places.len()];
                noise.velocities_at(level, (&places, None), 12.3, &mut out);
                out
            };
            let best = with(Level::new());
            for level in SimdLevel::ALL.into_iter().filter_map(SimdLevel::level) {
                assert_eq!(with(level), best, "{potential:?}, {level:?}");
            }
        }
    }
}
