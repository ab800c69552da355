//! Fields through velocities given at some places in space.

use super::plate::{Center, Plate};
use super::{Kernel, Note, Sketch};
use glam::{DVec3, Vec3};
use throng::Error;
use throng::field::Field;

/// Maximum number of anchors of a field.
const MOST: usize = 4000;
/// Tolerances, as parts of the extent of all anchors. Anchors closer than the first share a place; anchors do not span
/// a direction along which their extent is at most the second.
const SAME_PLACE: f64 = 1e-9;
const THIN: f64 = 1e-6;

/// As [`Anchors`](super::Anchors), in space: for flying agents. Thin plates are biharmonic in space: the field is the
/// sum of a linear part and a multiple of the distance from each anchor. Beyond the box that holds the anchors the
/// field fades.
///
/// ```
/// use glam::{DVec3, Vec3};
/// use throng::field::Field;
/// use throng_field::{AnchorsInSpace, Sketch};
/// // up, over the roof, and down again
/// let way = [([0.0, 0.0, 0.0], [0.0, 0.0, 2.0]), ([0.0, 0.0, 9.0], [2.0, 0.0, 0.0]), ([20.0, 0.0, 9.0], [0.0, 0.0, -2.0])];
/// let way = way.map(|(place, velocity)| (DVec3::from(place), DVec3::from(velocity)));
/// let field = AnchorsInSpace::new(&way, Sketch::default())?;
/// assert!(field.velocity(Vec3::Z * 9.0, 0.0).distance(Vec3::X * 2.0) < 1e-6);
/// assert!(field.velocity(Vec3::Z * 5.0, 0.0).z > 0.5);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct AnchorsInSpace {
    sketch: Sketch,
    /// The centroid of the anchors, and the distance of the farthest anchor from it.
    middle: DVec3,
    extent: f64,
    /// Lower and upper corner of the box that holds the anchors.
    bounds: (DVec3, DVec3),
    plate: Plate<DVec3>,
    notes: Vec<Note>,
}

impl AnchorsInSpace {
    /// Creates the field through these pairs of place (metres from the origin) and velocity. Anchors that share
    /// a place have their mean velocity there.
    ///
    /// # Errors
    /// Values that are not finite or out of the limits of the sketch; more than 4,000 anchors; anchors that no field
    /// interpolates.
    pub fn new(anchors: &[(DVec3, DVec3)], sketch: Sketch) -> Result<Self, Error> {
        let count = anchors.len();
        Error::unless(count <= MOST, "number of anchors", count as f64, "at most 4000: set them farther apart")?;
        for (place, velocity) in anchors {
            Error::unless_finite("place of an anchor", place.element_sum())?;
            Error::unless_finite("velocity of an anchor", velocity.element_sum())?;
        }
        sketch.check()?;
        let middle = anchors.iter().map(|anchor| anchor.0).sum::<DVec3>() / count.max(1) as f64;
        let offsets = || anchors.iter().map(|anchor| anchor.0 - middle);
        let extent = offsets().map(DVec3::length).fold(0.0, f64::max);
        let extent = if extent > middle.length() * 1e-12 { extent } else { 1.0 };
        let bounds = offsets().fold((DVec3::ZERO, DVec3::ZERO), |(low, high), at| (low.min(at), high.max(at)));
        // for each distinct place: the place, then the sum and the number of its velocities
        let mut places: Vec<(DVec3, DVec3, f64)> = Vec::new();
        for (at, velocity) in offsets().map(|at| at / extent).zip(anchors.iter().map(|anchor| anchor.1)) {
            match places.iter_mut().find(|place| place.0.distance(at) <= SAME_PLACE) {
                Some(place) => (place.1, place.2) = (place.1 + velocity, place.2 + 1.0),
                None => places.push((at, velocity, 1.0)),
            }
        }
        let axes = axes(&places.iter().map(|place| place.0).collect::<Vec<_>>());
        let mut notes = Vec::new();
        match (places.len(), axes.len()) {
            (0, _) => notes.push(Note::Empty),
            (1, _) => notes.push(Note::OnePlace),
            (_, 1) => notes.push(Note::OnLine),
            (_, 2) => notes.push(Note::OnPlane),
            _ => {}
        }
        if places.len() < count {
            notes.push(Note::Shared(count - places.len()));
        }
        let kernel = match sketch.kernel {
            Kernel::Wendland { reach } => Kernel::Wendland { reach: reach / extent },
            Kernel::ThinPlate => Kernel::ThinPlate,
        };
        let centers = places.iter().map(|place| Center { place: place.0, metric: () }).collect();
        let mut plate = Plate::new(kernel, centers, axes, sketch.smoothing)?;
        let means: Vec<DVec3> = places.iter().map(|place| place.1 / place.2).collect();
        plate.go_through(&means);
        if sketch.smoothing == 0.0 {
            plate.check(&means)?;
        }
        Ok(Self { sketch, middle, extent, bounds, plate, notes })
    }

    /// Returns remarks about the anchors.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// Returns the velocity at a place, metres from the origin.
    pub fn at(&self, place: DVec3) -> DVec3 {
        let offset = place - self.middle;
        let beyond = offset.distance(offset.clamp(self.bounds.0, self.bounds.1));
        let left = self.sketch.fade.map_or(1.0, |fade| libm::exp(-(beyond / fade).powi(2)));
        (self.plate.velocity(offset / self.extent) * left).clamp_length_max(self.sketch.max_speed)
    }
}

impl Field for AnchorsInSpace {
    fn velocity(&self, place: Vec3, _: f64) -> Vec3 {
        self.at(place.as_dvec3()).as_vec3()
    }
}

/// Returns the directions that the places span. The places are within 1 of the origin, which is their centroid.
fn axes(places: &[DVec3]) -> Vec<DVec3> {
    let mut axes: Vec<DVec3> = Vec::new();
    while axes.len() < 3 {
        let left = places.iter().map(|&place| axes.iter().fold(place, |left, &axis| left - axis * axis.dot(left)));
        let most = left.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())).unwrap_or_default();
        if most.length() <= THIN {
            return axes;
        }
        axes.push(most.normalize());
    }
    vec![DVec3::X, DVec3::Y, DVec3::Z]
}
