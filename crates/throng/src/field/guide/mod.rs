//! Where swarms go through space: straight to a target, or along a smooth way there.

mod spine;
mod voxels;
mod way;

pub use spine::{Smoothing, Spine};
pub use voxels::{Scan, Voxels};

use super::eikonal::{Front, march};
use super::slope::slope;
use super::{Field, cost};
use crate::Error;
use crate::parallel;
use glam::Vec3;
use std::fmt;
use std::sync::Arc;

/// Cubes from the target within which a front starts at its exact distance, where it is seen.
const BAND: f32 = 5.0;
/// Cosine of the angle between directions from which on they do not belong to the same way.
const SAME_WAY: f32 = 0.5;

/// How a swarm keeps to a [`Spine`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    /// Metres from the spine within which it leads; beyond, the field leads to the target on its own. Limit: > 0.
    pub radius: f32,
    /// How fast it pulls back to the spine: so much of the speed a metre beside it. Limit: >= 0.
    pub pull: f32,
}

impl Default for Tube {
    fn default() -> Self {
        Self { radius: 1.0, pull: 1.0 }
    }
}

/// The global field of a swarm's ways: to a target, down the slope of the time to it, or along a [`Spine`]. Wang, Jin, Deng, Zhou, *Inherent
/// noise-aware insect swarm simulation*, Computer Graphics Forum 33(6), 2014, the preprocessing; the paper's energies are not known, these
/// are like them.
///
/// Zero where no way leads to the target, beyond the box, and at the target. It keeps off what is solid as the voxels' clearance asks; near
/// it, and for noise, obstacles are the swarm's own affair.
///
/// ```
/// use glam::Vec3;
/// use std::sync::Arc;
/// use throng::field::{Field, Guide, Scan, Smoothing, Tube, Voxels};
/// use throng::space::surface::{Sphere, Surface};
/// let ball: Arc<dyn Surface> = Arc::new(Sphere::new(Vec3::new(5.0, 2.1, 2.0), 1.0)?);
/// let space = Voxels::of(&[ball], Scan { high: Vec3::new(10.0, 4.0, 4.0), ..Scan::default() })?;
/// let guide = Guide::new(Arc::new(space), Vec3::new(9.0, 2.0, 2.0), 0.2, 2.0)?;
/// let spine = guide.spine(Vec3::new(1.0, 2.0, 2.0), Smoothing::default())?;
/// assert!(spine.length() < 9.0 && spine.clearance() > 0.49);
/// let guide = guide.along(spine, Tube::default())?;
/// assert!(guide.velocity(Vec3::new(1.2, 2.0, 2.0), 0.0).x > 1.5);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone)]
pub struct Guide {
    space: Arc<Voxels>,
    target: Vec3,
    tolerance: f32,
    speed: f32,
    /// Metres to the target, each as dear as it is; infinite where no way leads there.
    lengths: Vec<f32>,
    /// Unit vectors.
    directions: Vec<Vec3>,
    spine: Option<Arc<Along>>,
}

/// A spine, and which piece of it is nearest to each cube in its tube.
#[derive(Debug)]
struct Along {
    spine: Spine,
    tube: Tube,
    /// [`NONE`] beyond the tube, or where the spine is not seen.
    pieces: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Guide {
    /// A field that leads to a target at a speed, m/s; there is who is within the tolerance, metres.
    ///
    /// # Errors
    /// Numbers that are not finite, a tolerance below 0, a speed that is not greater than 0; a target beyond the box, inside something
    /// solid, or where no free cube sees it.
    pub fn new(space: Arc<Voxels>, target: Vec3, tolerance: f32, speed: f32) -> Result<Self, Error> {
        Error::unless_finite("place of a target", f64::from(target.element_sum()))?;
        let holds = tolerance >= 0.0 && tolerance.is_finite();
        Error::unless(holds, "tolerance of a target", tolerance, "at least 0 and finite")?;
        Error::unless_positive("speed of a guide", speed)?;
        let fail = |why: String| Err(Error::Shape { what: format!("the target at {target}"), why });
        if space.cell_at(target).is_none() {
            return fail("it is beyond the box of space".into());
        }
        if space.nearest(target).is_inside() {
            return fail("it is inside something solid".into());
        }
        let count = space.cost.len();
        let mut lengths = vec![f32::INFINITY; count];
        let band = BAND * space.cell();
        let starts: Vec<u32> = (0..count as u32)
            .filter(|&cell| {
                let middle = space.middle(cell as usize);
                let close = middle.distance_squared(target) <= band * band;
                close && space.is_open(cell as usize) && space.is_clear(middle, target, 0.0)
            })
            .collect();
        if starts.is_empty() {
            let (cell, radius) = (space.cell(), space.radius);
            return fail(format!(
                "no cube of {cell} m close to it has room for a body of radius {radius} m and sees it"
            ));
        }
        for &start in &starts {
            let middle = space.middle(start as usize);
            let there = |part: f64| space.cell_at(middle.lerp(target, part as f32)).map(|cell| space.cost[cell]);
            let there = |part: f64| there(part).filter(|cost| cost.is_finite());
            let length = f64::from(middle.distance(target));
            lengths[start as usize] = cost::straight(length, space.lattice.cell, there) as f32;
        }
        let front = (&space.links[..], &space.cost[..]);
        march(&space.lattice, front, starts.iter().copied(), &mut lengths, &mut Front::default());
        let mut directions = vec![Vec3::ZERO; count];
        parallel::rows(&mut directions[..], |(): &mut (), cell, direction| {
            if lengths[cell].is_finite() {
                let (slope, _) = slope(&space.lattice, front, &lengths, cell);
                *direction = -Vec3::from(slope).normalize_or_zero();
            }
        });
        for start in starts {
            directions[start as usize] = (target - space.middle(start as usize)).normalize_or_zero();
        }
        Ok(Self { space, target, tolerance, speed, lengths, directions, spine: None })
    }

    /// The same, along a spine where the swarm is in its tube: its velocity there is the tangent, and the way to the nearest point of the
    /// spine times the pull, at the same speed.
    ///
    /// # Errors
    /// A radius that is not greater than 0 and finite, a pull that is not at least 0 and finite.
    pub fn along(self, spine: Spine, tube: Tube) -> Result<Self, Error> {
        Error::unless_positive("radius of the tube round a way", tube.radius)?;
        let holds = tube.pull >= 0.0 && tube.pull.is_finite();
        Error::unless(holds, "pull towards a way", tube.pull, "at least 0 and finite")?;
        let space = &self.space;
        let mut pieces = vec![NONE; space.cost.len()];
        // whoever is in a cube is closer than that to its middle
        let reach = tube.radius + 0.87 * space.cell();
        let (low, high) = spine
            .points()
            .iter()
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &at| (low.min(at), high.max(at)));
        let (low, high) = (low - reach, high + reach);
        parallel::rows(&mut pieces[..], |(): &mut (), cell, out| {
            let middle = space.middle(cell);
            let close = middle.cmpge(low).all() && middle.cmple(high).all() && space.distances()[cell] > 0.0;
            if !close {
                return;
            }
            let (piece, far) = spine.piece(middle);
            if far <= reach && space.is_clear(middle, spine.nearest_from(middle, piece).0, 0.0) {
                *out = piece as u32;
            }
        });
        Ok(Self { spine: Some(Arc::new(Along { spine, tube, pieces })), ..self })
    }

    /// The space that it leads through.
    pub fn space(&self) -> &Arc<Voxels> {
        &self.space
    }

    /// How long the way is from the middle of each cube, in metres that are as dear as they are; infinite where none leads to the target.
    pub fn lengths(&self) -> &[f32] {
        &self.lengths
    }

    /// How long the way to the target is, in metres that are as dear as they are; none where no way leads there.
    pub fn length_from(&self, place: Vec3) -> Option<f32> {
        self.by(place).map(|by| by.1)
    }

    /// The cubes round a place whose middles it sees, from which ways lead on, each with its part of the place and how long the way is by
    /// it; infinite where it does not count.
    fn around(&self, place: Vec3) -> [(usize, f32, f32); 8] {
        let around = self.space.around(place);
        let nearest = around.iter().map(|&(cell, _)| self.space.distances()[cell]).fold(f32::INFINITY, f32::min);
        // no point between the middles is farther from all of them than half a diagonal
        let clear = nearest > 0.867 * self.space.cell();
        around.map(|(cell, part)| {
            let middle = self.space.middle(cell);
            let counts = self.lengths[cell].is_finite() && (clear || self.space.is_clear(place, middle, 0.0));
            let length = || self.lengths[cell] + self.space.cost[cell] * place.distance(middle);
            (cell, part, if counts { length() } else { f32::INFINITY })
        })
    }

    /// The cube round a place by which the way is shortest, and its length.
    fn by(&self, place: Vec3) -> Option<(usize, f32)> {
        self.space.cell_at(place)?;
        let all = self.around(place).into_iter().map(|(cell, _, length)| (cell, length));
        all.reduce(|best, by| if by.1 < best.1 { by } else { best }).filter(|by| by.1.is_finite())
    }

    /// The direction to the target, a unit vector: down the slope, between cubes trilinearly.
    fn downhill(&self, place: Vec3) -> Option<Vec3> {
        let to = self.target - place;
        if to.length() < 2.0 * self.space.cell() && self.space.is_clear(place, self.target, 0.0) {
            return to.try_normalize();
        }
        let around = self.around(place);
        let best = around.iter().reduce(|best, by| if by.2 < best.2 { by } else { best })?;
        if best.2.is_infinite() {
            return None;
        }
        let own = self.directions[best.0];
        let same = around.iter().filter(|by| by.2.is_finite() && self.directions[by.0].dot(own) >= SAME_WAY);
        let mixed: Vec3 = same.map(|&(cell, part, _)| self.directions[cell] * part).sum();
        mixed.try_normalize().or_else(|| own.try_normalize())
    }
}

impl Field for Guide {
    fn velocity(&self, place: Vec3, _: f64) -> Vec3 {
        let Some(cell) = self.space.cell_at(place) else { return Vec3::ZERO };
        if place.distance(self.target) <= self.tolerance {
            return Vec3::ZERO;
        }
        if let Some(along) = self.spine.as_deref().filter(|along| along.pieces[cell] != NONE) {
            let (nearest, tangent) = along.spine.nearest_from(place, along.pieces[cell] as usize);
            let beside = nearest - place;
            if beside.length() <= along.tube.radius {
                return (tangent + beside * along.tube.pull).normalize_or_zero() * self.speed;
            }
        }
        self.downhill(place).unwrap_or_default() * self.speed
    }
}

impl fmt::Debug for Guide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Guide").field("target", &self.target).field("speed", &self.speed).finish_non_exhaustive()
    }
}
