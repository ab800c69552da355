//! Concentric zones: repulsion by close insects, alignment with near insects, attraction to far insects.

use super::guide::{Guide, GuideOutput, check_amount};
use glam::Vec3;
use throng::Error;
use throng::steer::{GroupFilter, SteeringInput};

/// Three concentric zones about each insect: repulsion, alignment and attraction. Their widths determine whether a
/// swarm mills about, flies as one, or scatters.
///
/// Wang, Ren, Jin, Manocha, *BSwarm: biologically-plausible dynamics model of insect swarms*, SCA 2015. There the zones
/// are forces; here they are velocities, as all guides are. The weight is 0 at the borders of a zone, so that nothing
/// jumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zones {
    /// Outer radius of each zone, metres, the innermost first. Limit: >= 0, none less than the one before it.
    pub reach: [f32; 3],
    /// Speed of repulsion at distance 0, m/s. Limit: >= 0.
    pub repulsion: f32,
    /// Factor on the difference of velocities. Limit: >= 0.
    pub alignment: f32,
    /// Speed to insects in the middle of the zone of attraction, m/s. Limit: >= 0.
    pub attraction: f32,
}

impl Default for Zones {
    fn default() -> Self {
        Self { reach: [0.08, 0.3, 0.8], repulsion: 1.0, alignment: 0.5, attraction: 0.5 }
    }
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
        check_amount("repulsion", self.repulsion)?;
        check_amount("alignment", self.alignment)?;
        check_amount("attraction", self.attraction)
    }
}
