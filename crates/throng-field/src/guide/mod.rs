//! The routes of swarms through space: to a target, or along a smooth curve to it.

mod description;
mod spine;
mod voxels;
mod way;

pub(super) use description::ThroughSpace;
pub use spine::{Smoothing, Spine};
pub use voxels::{VoxelSettings, Voxels};

use super::cost;
use super::eikonal::{Front, march};
use super::slope::slope;
use glam::Vec3;
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::field::{Field, FieldSpine};
use throng::parallel;

/// Distance from the target, in cubes, within which a front starts at its exact distance where the target is visible.
const BAND: f32 = 5.0;
/// Cosine of the angle between directions below which they belong to different routes.
const SAME_WAY: f32 = 0.5;

/// How a swarm follows a [`Spine`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    /// Distance from the spine, metres, within which the swarm follows it; beyond, the field leads directly to the
    /// target. Limit: > 0.
    pub radius: f32,
    /// Pull back to the spine, in parts of the speed for each metre of distance. Limit: >= 0.
    pub pull: f32,
}

impl Default for Tube {
    fn default() -> Self {
        Self { radius: 1.0, pull: 1.0 }
    }
}

/// The global field of a swarm: to a target down the slope of the time to it, or along a [`Spine`]. This is the
/// preprocessing of Wang, Jin, Deng, Zhou, *Inherent noise-aware insect swarm simulation*, Computer Graphics Forum
/// 33(6), 2014. The paper does not give its energies; these are similar.
///
/// The velocity is zero where no route leads to the target, beyond the box, and at the target. The field keeps the
/// clearance that the costs of the voxels give. It does not keep an agent that leaves its route, for example because of
/// noise, away from obstacles.
///
/// ```
/// use glam::Vec3;
/// use std::sync::Arc;
/// use throng::field::Field;
/// use throng_field::{Smoothing, SwarmGuide, Tube, VoxelSettings, Voxels};
/// use throng::space::surface::{Sphere, Surface};
/// let ball: Arc<dyn Surface> = Arc::new(Sphere::new(Vec3::new(5.0, 2.1, 2.0), 1.0)?);
/// let space = Voxels::of(&[ball], VoxelSettings { high: Vec3::new(10.0, 4.0, 4.0), ..VoxelSettings::default() })?;
/// let guide = SwarmGuide::new(Arc::new(space), Vec3::new(9.0, 2.0, 2.0), 0.2, 2.0)?;
/// let spine = guide.spine(Vec3::new(1.0, 2.0, 2.0), Smoothing::default())?;
/// assert!(spine.length() < 9.0 && spine.clearance() > 0.49);
/// let guide = guide.along(spine, Tube::default())?;
/// assert!(guide.velocity(Vec3::new(1.2, 2.0, 2.0), 0.0).x > 1.5);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone)]
pub struct SwarmGuide {
    space: Arc<Voxels>,
    target: Vec3,
    tolerance: f32,
    speed: f32,
    /// The cost of the route from each cube to the target, metres; infinite where no route leads there.
    lengths: Vec<f32>,
    /// Unit vectors; zero where no route leads on.
    directions: Vec<Vec3>,
    spine: Option<Arc<SpineFollower>>,
}

/// A spine, and its nearest piece for each cube in its tube.
#[derive(Debug)]
struct SpineFollower {
    spine: Spine,
    tube: Tube,
    /// [`NONE`] beyond the tube, or where the spine is not visible.
    pieces: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl SwarmGuide {
    /// Creates a field that leads to a target at a speed, m/s. The target counts as reached within the tolerance,
    /// metres.
    ///
    /// # Errors
    /// Values that are not finite; a tolerance below 0; a speed that is not greater than 0; a target beyond the box,
    /// inside an obstacle, or visible from no free cube.
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
            return fail("it is inside an obstacle".into());
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
                "no nearby cube of {cell} m visible from it has room for a body of radius {radius} m"
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

    /// Returns the same field, but along a spine within its tube: the direction is the tangent plus `pull` times the
    /// offset to the nearest point of the spine, at the same speed.
    ///
    /// # Errors
    /// A radius that is not greater than 0 and finite, a pull that is not at least 0 and finite.
    pub fn along(self, spine: Spine, tube: Tube) -> Result<Self, Error> {
        Error::unless_positive("radius of the tube round a way", tube.radius)?;
        let holds = tube.pull >= 0.0 && tube.pull.is_finite();
        Error::unless(holds, "pull towards a way", tube.pull, "at least 0 and finite")?;
        let space = &self.space;
        let mut pieces = vec![NONE; space.cost.len()];
        // every point of a cube is closer to its centre than 0.87 of its width
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
        Ok(Self { spine: Some(Arc::new(SpineFollower { spine, tube, pieces })), ..self })
    }

    /// Returns the voxels of the field.
    pub fn space(&self) -> &Arc<Voxels> {
        &self.space
    }

    /// Returns the cost of the route from the centre of each cube, metres; infinite where no route leads to the target.
    pub fn lengths(&self) -> &[f32] {
        &self.lengths
    }

    /// Returns the cost of the route from a place to the target, metres; none where no route leads there.
    pub fn length_from(&self, place: Vec3) -> Option<f32> {
        self.by(place).map(|by| by.1)
    }

    /// Returns the cubes around a place, each with its trilinear weight and the cost of the route through its centre.
    /// The cost is infinite where the centre is not visible or no route leads on.
    fn around(&self, place: Vec3) -> [(usize, f32, f32); 8] {
        let around = self.space.around(place);
        let nearest = around.iter().map(|&(cell, _)| self.space.distances()[cell]).fold(f32::INFINITY, f32::min);
        // no point between the centres is farther from all of them than half a diagonal
        let clear = nearest > 0.867 * self.space.cell();
        around.map(|(cell, part)| {
            let middle = self.space.middle(cell);
            let counts = self.lengths[cell].is_finite() && (clear || self.space.is_clear(place, middle, 0.0));
            let length = || self.lengths[cell] + self.space.cost[cell] * place.distance(middle);
            (cell, part, if counts { length() } else { f32::INFINITY })
        })
    }

    /// Returns the cube around a place through which the route costs least, and that cost.
    fn by(&self, place: Vec3) -> Option<(usize, f32)> {
        self.space.cell_at(place)?;
        let all = self.around(place).into_iter().map(|(cell, _, length)| (cell, length));
        all.reduce(|best, by| if by.1 < best.1 { by } else { best }).filter(|by| by.1.is_finite())
    }

    /// Returns the direction to the target, a unit vector: down the slope, interpolated trilinearly between cubes.
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

impl Field for SwarmGuide {
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

    fn spine(&self) -> Option<FieldSpine> {
        let follower = self.spine.as_deref()?;
        Some(FieldSpine { points: follower.spine.points().to_vec(), radius: follower.tube.radius })
    }
}

impl fmt::Debug for SwarmGuide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Guide").field("target", &self.target).field("speed", &self.speed).finish_non_exhaustive()
    }
}
