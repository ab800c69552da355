//! Noise.

use super::{BuildField, BuiltField, FieldContext, Flows};
use crate::assemble::limits::{Limit, check, check_some};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::flow::{Noise, Potential};
use crate::scene::steer::ObstacleNames;
use std::sync::Arc;
use throng::space::surface::Surface;
use throng_field::{CurlNoise, NoiseWall, Octave};

impl BuildField for Noise {
    fn make(&self, at: &FieldContext) -> Result<BuiltField, Problem> {
        Ok(BuiltField::of(self.curl(at)?))
    }
}

impl Flows<'_> {
    /// Builds the noise of a group, by its position.
    pub fn noise(&self, noise: &Noise, path: Path, group: usize) -> Result<CurlNoise, Problem> {
        noise.curl(&self.at(path, group))
    }
}

impl Noise {
    fn curl(&self, at: &FieldContext) -> Result<CurlNoise, Problem> {
        check(&at.path.key("length"), self.length, Limit::Positive)?;
        check(&at.path.key("speed"), self.speed, Limit::Between(0.0, 1000.0))?;
        check_some(&at.path.key("period"), self.period, Limit::Positive)?;
        check_some(&at.path.key("width"), self.width, Limit::Positive)?;
        let octaves = self.octaves.unwrap_or(1);
        check(&at.path.key("octaves"), f64::from(octaves), Limit::Between(1.0, 16.0))?;
        let period = self.period.map_or(f32::INFINITY, |period| period as f32);
        let octaves = Octave::turbulence(self.length as f32, period, self.speed as f32, octaves as usize);
        let potential = match self.potential.unwrap_or_default() {
            Potential::Plane => throng_field::Potential::Plane,
            Potential::Space => throng_field::Potential::Space,
            Potential::Crossed => throng_field::Potential::Crossed,
        };
        let made = octaves.and_then(|octaves| CurlNoise::new(potential, &octaves, self.seed.unwrap_or(0)));
        let mut noise = made.map_err(|error| at.refused(&error))?;
        if let Some(walls) = &self.walls {
            for surface in at.walls(walls)? {
                let wall = NoiseWall::new(surface, self.width.unwrap_or(self.length) as f32);
                noise = noise.with_wall(wall.map_err(|error| at.refused(&error))?);
            }
        }
        Ok(noise)
    }
}

impl FieldContext<'_> {
    /// Returns surfaces by name.
    pub(super) fn walls(&self, walls: &ObstacleNames) -> Result<Vec<Arc<dyn Surface>>, Problem> {
        let path = self.path.key("walls");
        if self.origin != self.flows.origin {
            let problem = Problem::new(&path, Kind::Conflict, "a field that moves with agents has no walls");
            return Err(problem.hint("leave out `walls` in fields of `around`"));
        }
        let sides = self.flows.around.sides(walls, &path, "leave out `walls` for no walls")?;
        Ok(sides.0.into_iter().map(|side| side.surface).collect())
    }
}
