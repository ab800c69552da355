//! Models of repulsion: the limits of their parameters, and conversion to the engine's models.

use super::limits::{Limit, check};
use crate::file::{Path, Problem};
use crate::scene::{AnticipationVelocity, CollisionFreeSpeed, Moussaid2009, PowerLaw, SocialForce};
use throng::avoid;

impl PowerLaw {
    /// Returns the engine's model.
    pub(super) fn built(&self) -> avoid::PowerLaw {
        avoid::PowerLaw {
            strength: self.strength as f32,
            time_horizon: self.time_horizon as f32,
            relaxation_time: self.relaxation_time as f32,
            grazing: self.grazing as f32,
            contact: self.contact as f32,
        }
    }

    /// Checks the parameters, under the path of the model.
    pub(super) fn checked(&self, path: Path) -> Result<Path, Problem> {
        let limits = [
            ("strength", self.strength, Limit::NotNegative),
            ("time_horizon", self.time_horizon, Limit::Positive),
            ("relaxation_time", self.relaxation_time, Limit::Positive),
            ("grazing", self.grazing, Limit::Between(0.01, 0.9)),
            ("contact", self.contact, Limit::NotNegative),
        ];
        limits.into_iter().try_for_each(|(key, value, limit)| check(&path.key(key), value, limit))?;
        Ok(path)
    }
}

impl Moussaid2009 {
    /// Returns the engine's model.
    pub(super) fn built(&self) -> avoid::Moussaid2009 {
        avoid::Moussaid2009 {
            relaxation_time: self.relaxation_time as f32,
            strength: self.strength as f32,
            gamma: self.gamma as f32,
            lambda: self.lambda as f32,
            turning: self.turning as f32,
            braking: self.braking as f32,
            side_preference: self.side_preference as f32,
            strength_obstacles: self.strength_obstacles as f32,
            range_obstacles: self.range_obstacles as f32,
        }
    }

    /// Checks the parameters, under the path of the model.
    pub(super) fn checked(&self, path: Path) -> Result<Path, Problem> {
        let limits = [
            ("relaxation_time", self.relaxation_time, Limit::Positive),
            ("strength", self.strength, Limit::NotNegative),
            ("gamma", self.gamma, Limit::Positive),
            ("lambda", self.lambda, Limit::NotNegative),
            ("turning", self.turning, Limit::NotNegative),
            ("braking", self.braking, Limit::NotNegative),
            ("side_preference", self.side_preference, Limit::Finite),
            ("strength_obstacles", self.strength_obstacles, Limit::NotNegative),
            ("range_obstacles", self.range_obstacles, Limit::Positive),
        ];
        limits.into_iter().try_for_each(|(key, value, limit)| check(&path.key(key), value, limit))?;
        Ok(path)
    }
}

impl SocialForce {
    /// Returns the engine's model.
    pub(super) fn built(&self) -> avoid::SocialForce {
        avoid::SocialForce {
            relaxation_time: self.relaxation_time as f32,
            strength: self.strength as f32,
            range: self.range as f32,
            anticipation_time: self.anticipation_time as f32,
            strength_obstacles: self.strength_obstacles as f32,
            range_obstacles: self.range_obstacles as f32,
            view_angle: self.view_angle.to_radians() as f32,
            out_of_view: self.out_of_view as f32,
        }
    }

    /// Checks the parameters, under the path of the model.
    pub(super) fn checked(&self, path: Path) -> Result<Path, Problem> {
        let limits = [
            ("relaxation_time", self.relaxation_time, Limit::Positive),
            ("strength", self.strength, Limit::NotNegative),
            ("range", self.range, Limit::Positive),
            ("anticipation_time", self.anticipation_time, Limit::NotNegative),
            ("strength_obstacles", self.strength_obstacles, Limit::NotNegative),
            ("range_obstacles", self.range_obstacles, Limit::Positive),
            ("view_angle", self.view_angle, Limit::Between(0.0, 360.0)),
            ("out_of_view", self.out_of_view, Limit::Between(0.0, 1.0)),
        ];
        limits.into_iter().try_for_each(|(key, value, limit)| check(&path.key(key), value, limit))?;
        Ok(path)
    }
}

impl AnticipationVelocity {
    /// Returns the engine's model.
    pub(super) fn built(&self) -> avoid::AnticipationVelocity {
        avoid::AnticipationVelocity {
            time_gap: self.time_gap as f32,
            anticipation_time: self.anticipation_time as f32,
            reaction_time: self.reaction_time as f32,
            strength: self.strength as f32,
            range: self.range as f32,
            wall_buffer: self.wall_buffer as f32,
            wall_pushout: self.wall_pushout as f32,
        }
    }

    /// Checks the parameters, under the path of the model.
    pub(super) fn checked(&self, path: Path) -> Result<Path, Problem> {
        let limits = [
            ("time_gap", self.time_gap, Limit::Positive),
            ("anticipation_time", self.anticipation_time, Limit::NotNegative),
            ("reaction_time", self.reaction_time, Limit::Positive),
            ("strength", self.strength, Limit::NotNegative),
            ("range", self.range, Limit::Positive),
            ("wall_buffer", self.wall_buffer, Limit::NotNegative),
            ("wall_pushout", self.wall_pushout, Limit::NotNegative),
        ];
        limits.into_iter().try_for_each(|(key, value, limit)| check(&path.key(key), value, limit))?;
        Ok(path)
    }
}

impl CollisionFreeSpeed {
    /// Returns the engine's model.
    pub(super) fn built(&self) -> avoid::CollisionFreeSpeed {
        avoid::CollisionFreeSpeed {
            time_gap: self.time_gap as f32,
            strength: self.strength as f32,
            range: self.range as f32,
            strength_obstacles: self.strength_obstacles as f32,
            range_obstacles: self.range_obstacles as f32,
        }
    }

    /// Checks the parameters, under the path of the model.
    pub(super) fn checked(&self, path: Path) -> Result<Path, Problem> {
        let limits = [
            ("time_gap", self.time_gap, Limit::Positive),
            ("strength", self.strength, Limit::NotNegative),
            ("range", self.range, Limit::Positive),
            ("strength_obstacles", self.strength_obstacles, Limit::NotNegative),
            ("range_obstacles", self.range_obstacles, Limit::Positive),
        ];
        limits.into_iter().try_for_each(|(key, value, limit)| check(&path.key(key), value, limit))?;
        Ok(path)
    }
}
