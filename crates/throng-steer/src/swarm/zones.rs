//! Concentric zones: repulsion by close insects, alignment with near insects, attraction to far insects.

use super::guide::{Guide, GuideOutput, check_amount};
use glam::Vec3;
use throng::Error;
use throng::parameters::{Value, parameters};
use throng::steer::{GroupFilter, SteeringInput};

/// Repulsion, alignment and attraction in nested zones around the agent (Wang et al. 2015).
///
/// The widths of the zones determine whether a
/// swarm mills about, flies as one, or scatters.
///
/// Wang, Ren, Jin, Manocha, *BSwarm: biologically-plausible dynamics model of insect swarms*, SCA 2015. There the zones
/// are forces; here they are velocities, as all guides are. The weight is 0 at the borders of a zone, so that nothing
/// jumps.
#[parameters(check = <Self as Guide>::check)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zones {
    /// Outer radius of each zone, the innermost first, metres. Limit: >= 0, ascending.
    #[parameter(default = [0.08, 0.3, 0.8], unit = "m")]
    pub reach: [f32; 3],
    /// Speed of the repulsion at distance 0, m/s.
    #[parameter(default = 1.0, unit = "m/s", least = 0)]
    pub repulsion: f32,
    /// Part of the difference of velocities that it makes up.
    #[parameter(default = 0.5, least = 0)]
    pub alignment: f32,
    /// Speed of the attraction in the middle of the outermost zone, m/s.
    #[parameter(default = 0.5, unit = "m/s", least = 0)]
    pub attraction: f32,
}

/// Returns the weight of an insect at a distance in a zone: 0 at both borders, 1 in the middle.
fn between(distance: f32, low: f32, high: f32) -> f32 {
    if distance <= low || distance >= high {
        return 0.0;
    }
    let part = (distance - low) / (high - low);
    4.0 * part * (1.0 - part)
}

impl Guide for Zones {
    fn reach(&self) -> f32 {
        self.reach[2]
    }

    fn guide(&self, view: &SteeringInput<'_>, _: &mut [f32], chosen: &mut GuideOutput) {
        let [close, near, far] = self.reach;
        let (mut away, mut along, mut to) = (Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
        let (mut aligned, mut attracted) = (0.0, 0.0);
        for other in view.neighbours.iter().filter(|other| GroupFilter::OwnGroup.counts(view, other)) {
            let distance = other.offset.length();
            if distance < close {
                away -= other.offset.normalize_or_zero() * (1.0 - distance / close);
            }
            let weight = between(distance, close, near);
            (along, aligned) = (along + (other.velocity - view.velocity()) * weight, aligned + weight);
            let weight = between(distance, near, far);
            (to, attracted) = (to + other.offset.normalize_or_zero() * weight, attracted + weight);
        }
        // a weighted mean, but smaller if the weights sum to less than 1
        let mean = |sum: Vec3, weight: f32| sum / weight.max(1.0);
        chosen.velocity +=
            away * self.repulsion + mean(along, aligned) * self.alignment + mean(to, attracted) * self.attraction;
    }

    fn check(&self) -> Result<(), Error> {
        let [close, near, far] = self.reach;
        check_amount("zone of repulsion", close)?;
        Error::unless(near >= close, "zone of alignment", near, "at least that of repulsion")?;
        Error::unless(far >= near && far.is_finite(), "zone of attraction", far, "at least that of alignment, finite")?;
        self.check_limits()
    }
}
