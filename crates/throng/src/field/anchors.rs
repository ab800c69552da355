//! Velocities sketched at some places, and everywhere between them: Jin, Xu, Wang, Huang, Zhang, Interactive control of
//! large-crowd navigation in virtual environments using vector fields, IEEE CG&A 28(6), 2008.

use super::Field;
use super::hull::Hull;
use super::plate::{Center, Kernel, Plate};
use crate::Error;
use glam::{DMat2, DVec2, Vec2, Vec3};

/// Anchors a field has at most: the time that they take grows with the third power of their number.
const MOST: usize = 4000;
/// Anchors are in one place that are closer than this part of the extent of all, and on one line if none is farther from it.
const SAME_PLACE: f64 = 1e-9;
const ON_LINE: f64 = 1e-6;

/// A velocity wanted at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// Metres from the world's origin.
    pub place: DVec2,
    /// Metres a second.
    pub velocity: DVec2,
    /// How many times as far it reaches along its velocity as across, as the strokes of a brush do; 1: as far in all directions.
    /// Limit: 1 to 100; 1 for thin plates, which bend back and forth where they are stretched in several directions.
    pub stretch: f64,
}

impl Anchor {
    /// One that reaches as far in all directions.
    pub fn new(place: DVec2, velocity: DVec2) -> Self {
        Self { place, velocity, stretch: 1.0 }
    }

    fn check(&self) -> Result<(), Error> {
        for (what, v) in [("place of an anchor", self.place), ("velocity of an anchor", self.velocity)] {
            Error::unless_finite(what, v.x)?;
            Error::unless_finite(what, v.y)?;
        }
        Error::unless((1.0..=100.0).contains(&self.stretch), "stretch of an anchor", self.stretch, "1 to 100")
    }

    /// Distances from it: shorter along the way it points, longer across.
    fn metric(&self) -> DMat2 {
        let along = self.velocity.normalize_or_zero();
        if along == DVec2::ZERO || self.stretch == 1.0 {
            return DMat2::IDENTITY;
        }
        let root = self.stretch.sqrt();
        DMat2::from_cols(along / root, along.perp() * root).transpose()
    }
}

/// How a field goes through its anchors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sketch {
    /// How the influence of an anchor falls off.
    pub kernel: Kernel,
    /// 0: through the anchors; more: past them, more and more evenly (ridge on the kernel's matrix, in which the anchors are
    /// within 1 of their middle; 1e-6 to 1e-2 smooths by hand drawn strokes). Limit: >= 0, finite.
    pub smoothing: f64,
    /// Metres beyond the convex hull of the anchors at which the field has fallen to 1/e of what it would be, by
    /// `exp(-(distance / fade)^2)`; none: thin plates grow on and on out there. Limit: > 0.
    pub fade: Option<f64>,
    /// The field is nowhere faster, m/s. Limit: > 0.
    pub max_speed: f64,
}

impl Default for Sketch {
    /// Through the anchors, as evenly as can be, without an end.
    fn default() -> Self {
        Self { kernel: Kernel::ThinPlate, smoothing: 0.0, fade: None, max_speed: f64::INFINITY }
    }
}

impl Sketch {
    pub(super) fn check(&self) -> Result<(), Error> {
        if let Kernel::Wendland { reach } = self.kernel {
            Error::unless(reach > 0.0 && reach.is_finite(), "reach of a kernel", reach, "greater than 0 and finite")?;
        }
        let smoothing = self.smoothing;
        Error::unless((0.0..f64::INFINITY).contains(&smoothing), "smoothing of a field", smoothing, "0 or more")?;
        let fade = self.fade.unwrap_or(1.0);
        Error::unless(fade > 0.0, "fade of a field", fade, "greater than 0")?;
        Error::unless(self.max_speed > 0.0, "max_speed of a field", self.max_speed, "greater than 0")
    }
}

/// What is worth knowing about a set of anchors: nothing is wrong, but it may not be what was meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Note {
    /// There are none: the field says nothing anywhere.
    Empty,
    /// All are in one place: the field of a thin plate is the same everywhere.
    OnePlace,
    /// All are on one line: the field of a thin plate is the same on both sides of it.
    OnLine,
    /// All are in one plane, in space: the field of a thin plate is the same above and below it.
    OnPlane,
    /// So many share their place with another: there the field has their mean.
    Shared(usize),
}

/// A field through velocities that are wanted at some places.
///
/// Cost: making it grows with the third power of the number of anchors (1,000: 0.1 s), [changing a
/// velocity](Self::set_velocity) with the second, asking for a velocity with the first. A crowd asks a field that was
/// [sampled](super::Sampled) from it instead: that goes many places at once, in single precision (some mm/s off where anchors
/// side by side contradict each other).
///
/// ```
/// use glam::DVec2;
/// use throng::field::{Anchor, Anchors, Sketch};
/// // up the street, round the corner, on to the right
/// let street = [((0.0, 0.0), (0.0, 1.4)), ((0.0, 20.0), (1.0, 1.0)), ((20.0, 20.0), (1.4, 0.0))];
/// let anchors = street.map(|(place, velocity)| Anchor::new(place.into(), velocity.into()));
/// let mut field = Anchors::new(&anchors, Sketch { fade: Some(10.0), ..Sketch::default() })?;
/// assert!(field.at(DVec2::new(0.0, 20.0)).distance(DVec2::ONE) < 1e-9);
/// assert!(field.at(DVec2::new(5.0, 15.0)).x > 0.3, "half way round");
/// assert!(field.at(DVec2::new(0.0, -50.0)).length() < 1e-6, "far away");
/// field.set_velocity(0, DVec2::ZERO)?;
/// assert!(field.at(DVec2::ZERO).length() < 1e-9);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Anchors {
    anchors: Vec<Anchor>,
    sketch: Sketch,
    /// The middle of the anchors, and how far the farthest is from it: there the plate is within 1 of its origin.
    middle: DVec2,
    extent: f64,
    /// Which centre of the plate each anchor belongs to.
    centers: Vec<usize>,
    plate: Plate<DVec2>,
    /// Of the anchors, from their middle.
    hull: Hull,
    notes: Vec<Note>,
}

impl Anchors {
    /// The field through these anchors.
    ///
    /// # Errors
    /// Numbers out of their limits; more than 4,000 anchors; anchors that no field goes through, because they are stretched too
    /// much or too close together.
    pub fn new(anchors: &[Anchor], sketch: Sketch) -> Result<Self, Error> {
        Error::unless(
            anchors.len() <= MOST,
            "number of anchors",
            anchors.len() as f64,
            "at most 4000: set them farther apart",
        )?;
        anchors.iter().try_for_each(Anchor::check)?;
        sketch.check()?;
        if sketch.kernel == Kernel::ThinPlate {
            let stretch = anchors.iter().map(|anchor| anchor.stretch).fold(1.0, f64::max);
            let limit = "1 where the kernel is a thin plate: take one with a reach";
            Error::unless(stretch == 1.0, "stretch of an anchor", stretch, limit)?;
        }
        let middle = anchors.iter().map(|anchor| anchor.place).sum::<DVec2>() / anchors.len().max(1) as f64;
        let from_middle = || anchors.iter().map(|anchor| anchor.place - middle);
        let extent = from_middle().map(DVec2::length).fold(0.0, f64::max);
        // all in one place: any extent will do
        let extent = if extent > middle.length() * 1e-12 { extent } else { 1.0 };
        let (first, centers) = places(from_middle(), extent * SAME_PLACE);
        let in_place = |&anchor: &usize| (anchors[anchor].place - middle) / extent;
        let axes = axes(first.iter().map(in_place));
        let mut notes = Vec::new();
        match (first.len(), axes.len()) {
            (0, _) => notes.push(Note::Empty),
            (1, _) => notes.push(Note::OnePlace),
            (_, 1) => notes.push(Note::OnLine),
            _ => {}
        }
        if first.len() < anchors.len() {
            notes.push(Note::Shared(anchors.len() - first.len()));
        }
        let center = |anchor: &usize| Center { place: in_place(anchor), metric: anchors[*anchor].metric() };
        let kernel = match sketch.kernel {
            Kernel::Wendland { reach } => Kernel::Wendland { reach: reach / extent },
            Kernel::ThinPlate => Kernel::ThinPlate,
        };
        let plate = Plate::new(kernel, first.iter().map(center).collect(), axes, sketch.smoothing)?;
        let hull = Hull::of(from_middle());
        let mut field = Self { anchors: anchors.to_vec(), sketch, middle, extent, centers, plate, hull, notes };
        let means = field.means();
        field.plate.go_through(&means);
        if sketch.smoothing == 0.0 {
            field.plate.check(&means)?;
        }
        Ok(field)
    }

    /// The anchors.
    pub fn anchors(&self) -> &[Anchor] {
        &self.anchors
    }

    /// What is worth knowing about them.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// Gives an anchor another velocity. It stays stretched along the one that it had when the field was made.
    ///
    /// # Errors
    /// A velocity that is not finite, or no such anchor.
    pub fn set_velocity(&mut self, index: usize, velocity: DVec2) -> Result<(), Error> {
        let anchor = self.anchors.get_mut(index).ok_or(Error::Unknown { what: "anchor", index })?;
        Anchor { velocity, ..*anchor }.check()?;
        anchor.velocity = velocity;
        self.plate.go_through(&self.means());
        Ok(())
    }

    /// The velocity at a place, metres from the world's origin.
    pub fn at(&self, place: DVec2) -> DVec2 {
        let offset = place - self.middle;
        let velocity = self.plate.velocity(offset / self.extent);
        (velocity * self.left(offset)).clamp_length_max(self.sketch.max_speed)
    }

    /// What of the velocity is left at an offset from the middle.
    fn left(&self, offset: DVec2) -> f64 {
        self.sketch.fade.map_or(1.0, |fade| libm::exp(-(self.hull.distance(offset) / fade).powi(2)))
    }

    /// The mean velocity of each place, which the plate goes through.
    fn means(&self) -> Vec<DVec2> {
        let mut sums = vec![(DVec2::ZERO, 0.0); self.centers.iter().max().map_or(0, |&last| last + 1)];
        for (&center, anchor) in self.centers.iter().zip(&self.anchors) {
            sums[center].0 += anchor.velocity;
            sums[center].1 += 1.0;
        }
        sums.into_iter().map(|(sum, count)| sum / count).collect()
    }
}

impl Field for Anchors {
    fn velocity(&self, place: Vec3, _: f64) -> Vec3 {
        self.at(place.truncate().as_dvec2()).as_vec2().extend(0.0)
    }

    fn row(&self, (first, step): (DVec2, f64), from: usize, _: f64, out: &mut [Vec2]) {
        let offset = first - self.middle;
        self.plate.row((offset / self.extent, step / self.extent), from, out);
        for (velocity, index) in out.iter_mut().zip(from..) {
            let left = self.left(offset + DVec2::X * (index as f64 * step)) as f32;
            *velocity = (*velocity * left).clamp_length_max(self.sketch.max_speed as f32);
        }
    }
}

/// The first of those in each place, and for all of them which of these places is theirs.
fn places(all: impl Iterator<Item = DVec2>, same: f64) -> (Vec<usize>, Vec<usize>) {
    let all: Vec<DVec2> = all.collect();
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by(|&a, &b| all[a].x.total_cmp(&all[b].x).then(a.cmp(&b)));
    // whose place is whose, the first in order: themselves if it is their own
    let mut of: Vec<usize> = (0..all.len()).collect();
    for (at, &one) in order.iter().enumerate() {
        let left = order[..at].iter().rev().take_while(|&&other| all[one].x - all[other].x <= same);
        if let Some(&other) = left.filter(|&&other| all[other].distance(all[one]) <= same).last() {
            of[one] = of[other];
        }
    }
    let mut index = vec![usize::MAX; all.len()];
    let mut first = Vec::new();
    let centers = of.into_iter().map(|of| {
        if index[of] == usize::MAX {
            index[of] = first.len();
            first.push(of);
        }
        index[of]
    });
    let centers = centers.collect();
    (first, centers)
}

/// Directions in which places lie, that are within 1 of the origin, which is in their middle.
fn axes(places: impl Iterator<Item = DVec2> + Clone) -> Vec<DVec2> {
    let farthest = places.clone().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    let along = farthest.unwrap_or_default().normalize_or_zero();
    if along == DVec2::ZERO {
        return Vec::new();
    }
    let across = places.map(|place| along.perp_dot(place).abs()).fold(0.0, f64::max);
    if across <= ON_LINE { vec![along] } else { vec![DVec2::X, DVec2::Y] }
}
