//! Density and speed of a crowd at every position, by a Gaussian kernel: Johansson, Helbing, Al-Abideen and Al-Bosta,
//! From crowd dynamics to crowd safety: a video-based analysis, Advances in Complex Systems 11 (2008).
//!
//! The density at a position is the sum of f(d) over all agents at distance d, with f(d) = exp(-d² / R²) / (π R²). The
//! integral of f over the ground is 1, so the integral of the density is the number of agents. The speed at a position
//! is the mean of the agents' speeds with the weights f(d).

use glam::DVec2;
use throng_draw::WorldBox;

/// The kernel radius R of the paper, metres.
pub const REACH: f64 = 1.0;
/// The cut-off of the kernel, in R. The kernel is 1e-4 of its peak there.
const END: f64 = 3.0;
/// The most cells.
const MOST: f64 = 65_536.0;
/// The least width of a cell, metres.
const FINEST: f64 = 0.2;

/// Square cells on the ground, in rows from the corner with the least coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Raster {
    low: DVec2,
    cell: f64,
    columns: usize,
    rows: usize,
}

impl Raster {
    /// Creates cells over a box and a margin of the kernel's cut-off around it.
    pub fn over(bounds: WorldBox) -> Self {
        let low = bounds.min - END * REACH;
        let size = (bounds.max - bounds.min + 2.0 * END * REACH).max(DVec2::splat(FINEST));
        let cell = (size.element_product() / MOST).sqrt().max(FINEST);
        // a long narrow strip has at least one cell across
        let [columns, rows] = (size / cell).ceil().to_array().map(|count| (count as usize).clamp(1, MOST as usize));
        Self { low, cell, columns, rows }
    }

    /// Returns the number of cells along x and along y.
    pub fn size(&self) -> [usize; 2] {
        [self.columns, self.rows]
    }

    /// Returns the corners of the raster, world coordinates.
    pub fn corners(&self) -> [DVec2; 2] {
        [self.low, self.low + DVec2::new(self.columns as f64, self.rows as f64) * self.cell]
    }
}

/// The kernel sums of a crowd at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Sums {
    /// The time, seconds.
    pub time: f64,
    /// The density at the centre of each cell, agents per square metre.
    pub densities: Vec<f32>,
    /// The density weighted by speed, agents per square metre times m/s.
    pub flows: Vec<f32>,
}

impl Sums {
    /// Computes the sums of agents, given by position and speed, m/s.
    pub fn of(raster: &Raster, time: f64, agents: impl Iterator<Item = (DVec2, f32)>) -> Self {
        let count = raster.columns * raster.rows;
        let mut sums = Self { time, densities: vec![0.0; count], flows: vec![0.0; count] };
        let (mut across, mut up) = (Vec::new(), Vec::new());
        for (at, speed) in agents.filter(|(at, speed)| at.is_finite() && speed.is_finite()) {
            let at = (at - raster.low) / raster.cell;
            let columns = weights(at.x, raster, raster.columns, &mut across);
            let rows = weights(at.y, raster, raster.rows, &mut up);
            for (row, &above) in rows.clone().zip(&up) {
                let cells = row * raster.columns + columns.start..row * raster.columns + columns.end;
                let sums = sums.densities[cells.clone()].iter_mut().zip(&mut sums.flows[cells]);
                for ((density, flow), &beside) in sums.zip(&across) {
                    let weight = above * beside;
                    *density += weight;
                    *flow += weight * speed;
                }
            }
        }
        sums
    }
}

/// Computes the weights of an agent along one axis. `at` is in cells. Returns the range of cells. The kernel is the
/// product of the weights of both axes.
fn weights(at: f64, raster: &Raster, count: usize, weights: &mut Vec<f32>) -> std::ops::Range<usize> {
    let reach = REACH / raster.cell;
    // the cast saturates negative values to zero
    let first = (at - END * reach).floor() as usize;
    let last = ((at + END * reach).ceil().max(0.0) as usize).min(count);
    let peak = 1.0 / (std::f64::consts::PI.sqrt() * REACH);
    let weight = |cell: usize| peak * (-((cell as f64 + 0.5 - at) / reach).powi(2)).exp();
    weights.clear();
    weights.extend((first..last).map(|cell| weight(cell) as f32));
    first.min(last)..last
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds() -> WorldBox {
        WorldBox { min: DVec2::new(-1803.0, 40.0), max: DVec2::new(-1795.0, 52.0) }
    }

    /// Computes density and speed at one position by the definition.
    fn brute(agents: &[(DVec2, f32)], place: DVec2) -> [f64; 2] {
        let kernel = |at: DVec2| (-place.distance_squared(at)).exp() / std::f64::consts::PI;
        let density = agents.iter().map(|&(at, _)| kernel(at)).sum();
        [density, agents.iter().map(|&(at, speed)| kernel(at) * f64::from(speed)).sum::<f64>() / density]
    }

    #[test]
    fn cells_have_what_the_definition_says() {
        let raster = Raster::over(bounds());
        let place = |k: usize| DVec2::new(-1803.0 + (k * 37 % 80) as f64 * 0.1, 40.0 + (k * 53 % 120) as f64 * 0.1);
        let agents: Vec<(DVec2, f32)> = (0..90).map(|k| (place(k), (k % 7) as f32 * 0.3)).collect();
        let sums = Sums::of(&raster, 0.0, agents.iter().copied());
        let [low, high] = raster.corners();
        let (columns, cell) = (raster.size()[0], (high.x - low.x) / raster.size()[0] as f64);
        let mut seen = 0;
        for k in (0..sums.densities.len()).step_by(17) {
            let middle = low + DVec2::new((k % columns) as f64 + 0.5, (k / columns) as f64 + 0.5) * cell;
            let [density, speed] = brute(&agents, middle);
            // the truncated tail of the kernel, of all 90 agents
            assert!((f64::from(sums.densities[k]) - density).abs() < 90.0 * 4e-5, "{middle}: {density}");
            if density > 0.1 {
                assert!((f64::from(sums.flows[k] / sums.densities[k]) - speed).abs() < 0.01, "{middle}: {speed}");
                seen += 1;
            }
        }
        assert!(seen > 50);
    }

    #[test]
    fn the_integral_of_the_density_is_how_many_there_are() {
        let (raster, far) = (Raster::over(bounds()), DVec2::splat(1e9));
        let agents =
            [DVec2::new(-1800.0, 44.0), DVec2::new(-1796.3, 50.1), bounds().min, bounds().max, far, DVec2::NAN];
        let sums = Sums::of(&raster, 0.0, agents.into_iter().map(|at| (at, 1.0)));
        let [low, high] = raster.corners();
        let cell = (high - low).element_product() / sums.densities.len() as f64;
        let count = sums.densities.iter().sum::<f32>() * cell as f32;
        assert!((count - 4.0).abs() < 1e-3, "{count}");
        assert!(raster.size().into_iter().product::<usize>() < 70_000);
    }
}
