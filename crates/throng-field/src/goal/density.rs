//! The density of agents in the cells of a terrain.

use super::terrain::Terrain;
use glam::{DVec2, Vec2};
use throng::Error;

/// Units of an agent that are counted: whole numbers, so that the sum does not depend on the order of the agents.
const PARTS: f64 = (1 << 20) as f64;

/// The density in every cell of a terrain, agents a square metre, row by row.
///
/// ```
/// use glam::{DVec2, Vec2};
/// use throng_field::{Density, Terrain, TerrainSettings};
/// let ground = Terrain::of(|_| false, TerrainSettings { high: DVec2::splat(20.0), ..TerrainSettings::default() })?;
/// let people = (0..400).map(|k| Vec2::new((k % 20) as f32 + 0.5, (k / 20) as f32 + 0.5));
/// let mut density = Density::empty(&ground);
/// let now = Density::of(&ground, people, 2.0)?;
/// let middle = ground.cell_at(DVec2::splat(10.0)).unwrap();
/// assert!((now.cells()[middle] - 1.0).abs() < 0.05);
/// density.follow(&now, 0.25);
/// assert_eq!(density.cells()[middle], 0.25 * now.cells()[middle]);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Density(Vec<f32>);

impl Density {
    /// Returns a density of zero everywhere.
    pub fn empty(terrain: &Terrain) -> Self {
        Self(vec![0.0; terrain.cost().len()])
    }

    /// Returns the density of agents at these positions, metres from the origin. Each agent counts 1, spread
    /// over the cells within `radius` metres that are not solid, by the kernel `(1 - (d / radius)^2)^2`. Agents off the
    /// terrain do not count. The order of the agents does not matter.
    ///
    /// # Errors
    /// A radius that is not greater than 0 and finite.
    pub fn of(terrain: &Terrain, people: impl IntoIterator<Item = Vec2>, radius: f64) -> Result<Self, Error> {
        let holds = radius > 0.0 && radius.is_finite();
        Error::unless(holds, "radius of a density", radius, "greater than 0 and finite")?;
        let mut parts = vec![0u64; terrain.cost().len()];
        let mut kernel: Vec<(usize, f64)> = Vec::new();
        for person in people {
            let person = person.as_dvec2();
            let Some(own) = terrain.cell_at(person) else { continue };
            kernel.clear();
            terrain.within((person - radius, person + radius), |cell| {
                let far = terrain.middle(cell).distance_squared(person) / (radius * radius);
                if far < 1.0 && !terrain.is_solid(cell) {
                    kernel.push((cell, (1.0 - far) * (1.0 - far)));
                }
            });
            let sum: f64 = kernel.iter().map(|&(_, part)| part).sum();
            for &(cell, part) in &kernel {
                parts[cell] += (part / sum * PARTS) as u64;
            }
            // the kernel is narrower than the cells
            if kernel.is_empty() {
                parts[own] += PARTS as u64;
            }
        }
        let cell = terrain.cell();
        let density = |parts: u64| (parts as f64 / (PARTS * cell * cell)) as f32;
        Ok(Self(parts.into_iter().map(density).collect()))
    }

    /// Moves this density towards another by a part (0 to 1) of the difference: short-lived changes are smoothed.
    ///
    /// # Panics
    /// Never. Cells that `now` lacks keep their values.
    pub fn follow(&mut self, now: &Self, part: f32) {
        now.lead(&mut self.0, part);
    }

    /// Moves the values of other cells towards these, as [`follow`](Self::follow) does.
    pub(crate) fn lead(&self, cells: &mut [f32], part: f32) {
        cells.iter_mut().zip(&self.0).for_each(|(old, now)| *old += (now - *old) * part);
    }

    /// Returns the density of each cell, agents a square metre.
    pub fn cells(&self) -> &[f32] {
        &self.0
    }
}

impl Terrain {
    /// Calls `inside` with the cells that have their centres in a box.
    fn within(&self, corners: (DVec2, DVec2), inside: impl FnMut(usize)) {
        super::cover::within(corners, (self.low + 0.5 * self.cell(), &self.lattice), inside);
    }
}
