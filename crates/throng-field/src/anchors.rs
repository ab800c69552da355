//! Fields through velocities sketched at some places: Jin, Xu, Wang, Huang, Zhang, *Interactive control of large-crowd
//! navigation in virtual environments using vector fields*, IEEE CG&A 28(6), 2008.

use super::hull::Hull;
use super::plate::{Center, Kernel, Plate};
use glam::{DMat2, DVec2, Vec2, Vec3};
use throng::Error;
use throng::field::Field;

/// Maximum number of anchors of a field: the time to make it grows with the cube of their number.
const MOST: usize = 4000;
/// Tolerances, as parts of the extent of all anchors. Anchors closer than the first share a place. Anchors at most the
/// second away from a line lie on that line.
const SAME_PLACE: f64 = 1e-9;
const ON_LINE: f64 = 1e-6;

/// A velocity wanted at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// Metres from the origin.
    pub place: DVec2,
    /// Metres a second.
    pub velocity: DVec2,
    /// How many times as far the anchor reaches along its velocity as across it, as a brush stroke does; 1: equally far
    /// in all directions. Limit: 1 to 100; 1 for thin plates, which oscillate where they are stretched in several
    /// directions.
    pub stretch: f64,
}

impl Anchor {
    /// Creates an anchor that reaches equally far in all directions.
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

    /// Returns the metric of distances from the anchor: shorter along its velocity, longer across it.
    fn metric(&self) -> DMat2 {
        let along = self.velocity.normalize_or_zero();
        if along == DVec2::ZERO || self.stretch == 1.0 {
            return DMat2::IDENTITY;
        }
        let root = self.stretch.sqrt();
        DMat2::from_cols(along / root, along.perp() * root).transpose()
    }
}

/// The settings of a field through anchors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sketch {
    /// How the influence of an anchor falls off with distance.
    pub kernel: Kernel,
    /// 0: the field interpolates the anchors; above 0: it approximates them, and more smoothly as the value grows
    /// (ridge on the kernel's matrix, with the anchors scaled to within 1 of their centroid; 1e-6 to 1e-2 smooths
    /// strokes drawn by hand). Limit: >= 0, finite.
    pub smoothing: f64,
    /// Metres beyond the convex hull of the anchors at which the field has fallen to 1/e of its value without fading,
    /// by `exp(-(distance / fade)^2)`; none: a thin plate grows without bound outside the hull. Limit: > 0.
    pub fade: Option<f64>,
    /// Maximum speed of the field, m/s. Limit: > 0.
    pub max_speed: f64,
}

impl Default for Sketch {
    /// Interpolates the anchors by a thin plate, with no fading and no maximum speed.
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

/// A remark about a set of anchors: not an error, but possibly not what was intended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Note {
    /// There are no anchors: the field is zero everywhere.
    Empty,
    /// All anchors are in one place: the field of a thin plate is the same everywhere.
    OnePlace,
    /// All anchors are on one line: the field of a thin plate is the same on both sides of it.
    OnLine,
    /// All anchors are in one plane, in space: the field of a thin plate is the same above and below it.
    OnPlane,
    /// The number of anchors that share a place with an earlier anchor: there the field has their mean velocity.
    Shared(usize),
}

/// A field through velocities given at some places.
///
/// Cost, in the number of anchors: making the field is cubic (1,000: 0.1 s), [changing a velocity](Self::set_velocity)
/// is quadratic, evaluating the field at a place is linear. For a crowd, [sample](super::Sampled) the field: that
/// evaluates many places at once, in single precision (some mm/s off where neighbouring anchors contradict each other).
///
/// ```
/// use glam::DVec2;
/// use throng_field::{Anchor, Anchors, Sketch};
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
    /// The centroid of the anchors, and the distance of the farthest anchor from it. They scale the anchors to within 1
    /// of the origin of the plate.
    middle: DVec2,
    extent: f64,
    /// The index of the plate's centre for each anchor.
    centers: Vec<usize>,
    plate: Plate<DVec2>,
    /// The convex hull of the anchors, relative to their centroid.
    hull: Hull,
    notes: Vec<Note>,
}

impl Anchors {
    /// Creates the field through these anchors.
    ///
    /// # Errors
    /// Values out of their limits; more than 4,000 anchors; anchors that no field interpolates, because they are
    /// stretched too much or too close together.
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
            let limit = "1 where the kernel is a thin plate: use Wendland's kernel";
            Error::unless(stretch == 1.0, "stretch of an anchor", stretch, limit)?;
        }
        let middle = anchors.iter().map(|anchor| anchor.place).sum::<DVec2>() / anchors.len().max(1) as f64;
        let from_middle = || anchors.iter().map(|anchor| anchor.place - middle);
        let extent = from_middle().map(DVec2::length).fold(0.0, f64::max);
        // all anchors in one place: any extent is correct
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

    /// Returns the anchors.
    pub fn anchors(&self) -> &[Anchor] {
        &self.anchors
    }

    /// Returns remarks about the anchors.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// Changes the velocity of an anchor. The anchor stays stretched along the velocity that it had when the field was
    /// made.
    ///
    /// # Errors
    /// A velocity that is not finite; an index without an anchor.
    pub fn set_velocity(&mut self, index: usize, velocity: DVec2) -> Result<(), Error> {
        let anchor = self.anchors.get_mut(index).ok_or(Error::Unknown { what: "anchor", index })?;
        Anchor { velocity, ..*anchor }.check()?;
        anchor.velocity = velocity;
        self.plate.go_through(&self.means());
        Ok(())
    }

    /// Returns the velocity at a place, metres from the origin.
    pub fn at(&self, place: DVec2) -> DVec2 {
        let offset = place - self.middle;
        let velocity = self.plate.velocity(offset / self.extent);
        (velocity * self.left(offset)).clamp_length_max(self.sketch.max_speed)
    }

    /// Returns the factor of the fading at an offset from the centroid.
    fn left(&self, offset: DVec2) -> f64 {
        self.sketch.fade.map_or(1.0, |fade| libm::exp(-(self.hull.distance(offset) / fade).powi(2)))
    }

    /// Returns the mean velocity of each distinct place, which the plate interpolates.
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

/// Returns the index of the first point at each distinct place, and for every point the number of its place.
fn places(all: impl Iterator<Item = DVec2>, same: f64) -> (Vec<usize>, Vec<usize>) {
    let all: Vec<DVec2> = all.collect();
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by(|&a, &b| all[a].x.total_cmp(&all[b].x).then(a.cmp(&b)));
    // for each point the first point, in the sorted order, of its place: itself if it starts a new place
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

/// Returns the directions that the places span. The places are within 1 of the origin, which is their centroid.
fn axes(places: impl Iterator<Item = DVec2> + Clone) -> Vec<DVec2> {
    let farthest = places.clone().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    let along = farthest.unwrap_or_default().normalize_or_zero();
    if along == DVec2::ZERO {
        return Vec::new();
    }
    let across = places.map(|place| along.perp_dot(place).abs()).fold(0.0, f64::max);
    if across <= ON_LINE { vec![along] } else { vec![DVec2::X, DVec2::Y] }
}
