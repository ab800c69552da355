//! The guidance of a swarm as files describe it.

use super::{Smoothing, SwarmGuide, Tube, VoxelSettings, Voxels};
use std::sync::Arc;
use throng::Error;
use throng::parameters::{SpacePlace, parameters};
use throng::space::surface::Surface;
use throng::steer::Barriers;

/// The direction of a path to a target through space, clear of obstacles: guides a swarm (Wang et al. 2014).
#[parameters]
pub(crate) struct ThroughSpace {
    /// The target.
    #[parameter(required)]
    to: SpacePlace,
    /// Distance from the target that counts as arrival, metres.
    #[parameter(default = 0.1, unit = "m", least = 0)]
    tolerance: f32,
    /// Speed, m/s.
    #[parameter(default = 1.0, unit = "m/s", above = 0, most = 1000)]
    speed: f32,
    /// Start of the swarm: then the field follows one smooth path from there, and leads onto it from elsewhere.
    from: Option<SpacePlace>,
    /// Distance from that path within which the field leads along it, metres.
    #[parameter(default = Tube::default().radius, unit = "m", above = 0)]
    tube: f32,
    /// Distance of that path from obstacles where there is room, metres.
    #[parameter(default = Smoothing::default().distance, unit = "m", least = 0)]
    distance: f32,
    /// The obstacles: names of surfaces and of obstacles, `"obstacles"`, or `"everything"`. Without it, nothing.
    walls: Barriers,
    /// Radius of the bodies, metres.
    #[parameter(default = VoxelSettings::default().radius, unit = "m", least = 0)]
    radius: f32,
    /// Cost of flying close to obstacles, square metres: at a distance `d` a metre costs `clearance / (d - radius)^2` more.
    #[parameter(default = VoxelSettings::default().clearance, unit = "m²", least = 0)]
    clearance: f32,
    /// Width of the cubes of the search grid, metres.
    #[parameter(default = VoxelSettings::default().cell, unit = "m", above = 0)]
    cell: f32,
    /// The corner of the searched space with the least coordinates.
    #[parameter(required)]
    min: SpacePlace,
    /// The corner of the searched space with the greatest coordinates.
    #[parameter(required)]
    max: SpacePlace,
}

impl TryFrom<ThroughSpace> for SwarmGuide {
    type Error = Error;

    fn try_from(said: ThroughSpace) -> Result<Self, Error> {
        let scan = VoxelSettings {
            low: said.min.into(),
            high: said.max.into(),
            cell: said.cell,
            radius: said.radius,
            clearance: said.clearance,
            ..VoxelSettings::default()
        };
        let walls: Vec<Arc<dyn Surface>> = said.walls.0.into_iter().map(|wall| wall.surface).collect();
        let guide = Self::new(Arc::new(Voxels::of(&walls, scan)?), said.to.into(), said.tolerance, said.speed)?;
        let Some(from) = said.from else { return Ok(guide) };
        let spine = guide.spine(from.into(), Smoothing { distance: said.distance, ..Smoothing::default() })?;
        guide.along(spine, Tube { radius: said.tube, ..Tube::default() })
    }
}
