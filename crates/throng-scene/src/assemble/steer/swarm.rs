//! Swarms of insects.

use super::super::limits::{Limit, check, check_some};
use super::{BehaviourContext, BuildBehaviour, or, refused};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::steer::*;
use std::sync::Arc;
use throng::steer::BoxedBehaviour;
use throng_field::FadeOut;
use throng_steer::swarm::{self, Guide};

impl BuildBehaviour for Swarm {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let mut made = swarm::Swarm::default();
        if let Some(noise) = &self.noise {
            made.noise = Some(Arc::new(making.flows.noise(noise, at.key("noise"), making.group)?));
        }
        made.own_noise = self.own_noise.unwrap_or(made.own_noise);
        if let Some(KeepApart { distance, speed }) = &self.apart {
            check_some(&at.key("apart.distance"), *distance, Limit::NotNegative)?;
            check_some(&at.key("apart.speed"), *speed, Limit::NotNegative)?;
            made.apart.distance = or(*distance, made.apart.distance);
            made.apart.speed = or(*speed, made.apart.speed);
        }
        if let Some(KeepOff { obstacles, distance, speed }) = &self.keep_off {
            let at = at.key("keep_off");
            check_some(&at.key("distance"), *distance, Limit::Positive)?;
            check_some(&at.key("speed"), *speed, Limit::NotNegative)?;
            made.keep_off.barriers =
                making.around.sides(obstacles, &at.key("obstacles"), "leave out `keep_off` for nothing")?;
            made.keep_off.distance = or(*distance, made.keep_off.distance);
            made.keep_off.speed = or(*speed, made.keep_off.speed);
        }
        for (i, guide) in self.guides.iter().flatten().enumerate() {
            made.guides.push(making.guide(guide, &at.key("guides").index(i))?);
        }
        Ok(made.into())
    }
}

/// Checks and returns a guide.
fn checked(guide: impl Guide + 'static, at: &Path) -> Result<Arc<dyn Guide>, Problem> {
    guide.check().map_err(|error| refused(at, &error))?;
    Ok(Arc::new(guide))
}

impl BehaviourContext<'_> {
    fn guide(&self, guide: &SwarmGuide, at: &Path) -> Result<Arc<dyn Guide>, Problem> {
        match guide {
            SwarmGuide::Flow(said) => {
                let at = at.key("flow");
                let field = self.flows.make(&said.flow, at.key("flow"), self.group)?.field;
                checked(swarm::Flow { field, weight: or(said.weight, 1.0) }, &at)
            }
            SwarmGuide::Aggregate(said) => {
                let at = at.key("aggregate");
                let standard = swarm::Aggregate::from(self.target(&said.marker, &at.key("marker"))?);
                let (rate, beyond) = (or(said.rate, standard.rate), or(said.beyond, standard.beyond));
                checked(swarm::Aggregate { rate, beyond, ..standard }, &at)
            }
            SwarmGuide::Phototaxis(said) => {
                let at = at.key("phototaxis");
                let standard = swarm::Phototaxis::from(self.target(&said.light, &at.key("light"))?);
                let made = swarm::Phototaxis {
                    power: or(said.power, standard.power),
                    threshold: or(said.threshold, standard.threshold),
                    speed: or(said.speed, standard.speed),
                    orbit: or(said.orbit, standard.orbit),
                    noise: or(said.agitation, standard.noise),
                    ..standard
                };
                checked(made, &at)
            }
            SwarmGuide::Sedation(said) => self.sedation(said, &at.key("sedation")),
            SwarmGuide::Attack(said) => {
                let at = at.key("attack");
                let standard = swarm::Attack::from(self.target(&said.prey, &at.key("prey"))?);
                let made = swarm::Attack {
                    within: or(said.within, standard.within),
                    speed: or(said.speed, standard.speed),
                    near: or(said.near, standard.near),
                    calm: or(said.calm, standard.calm),
                    leaders: or(said.leaders, standard.leaders),
                    follow: or(said.follow, standard.follow),
                    ..standard
                };
                checked(made, &at)
            }
            SwarmGuide::Migrate(said) => {
                let at = at.key("migrate");
                let path = self.path(&said.path, &at)?;
                checked(swarm::Migrate { path, speed: or(said.speed, 1.5), rate: or(said.rate, 1.0) }, &at)
            }
            SwarmGuide::Align(said) => {
                let made = swarm::Align { distance: or(said.distance, 0.5), weight: or(said.weight, 0.5) };
                checked(made, &at.key("align"))
            }
            SwarmGuide::HeightBand(said) => {
                let (low, high) = (said.low as f32, said.high as f32);
                checked(swarm::HeightBand { low, high, rate: or(said.rate, 1.0) }, &at.key("height_band"))
            }
            SwarmGuide::Escape(said) => {
                let at = at.key("escape");
                let standard = swarm::Escape::from(self.target(&said.predator, &at.key("predator"))?);
                let made = swarm::Escape {
                    within: or(said.within, standard.within),
                    speed: or(said.speed, standard.speed),
                    memory: or(said.memory, standard.memory),
                    ..standard
                };
                checked(made, &at)
            }
            SwarmGuide::Zones(said) => {
                let standard = swarm::Zones::default();
                let made = swarm::Zones {
                    reach: said.reach.map_or(standard.reach, |reach| reach.map(|reach| reach as f32)),
                    repulsion: or(said.repulsion, standard.repulsion),
                    alignment: or(said.alignment, standard.alignment),
                    attraction: or(said.attraction, standard.attraction),
                };
                checked(made, &at.key("zones"))
            }
        }
    }

    fn sedation(&self, said: &Sedation, at: &Path) -> Result<Arc<dyn Guide>, Problem> {
        let found = self.around.surfaces.iter().find(|(name, _)| *name == said.smoke);
        let (_, side) = found.ok_or_else(|| {
            let message = format!("there is no surface `{}`", said.smoke);
            Problem::new(&at.key("smoke"), Kind::UnknownKey, message).hint("smoke is the inside of a [[surface]]")
        })?;
        let rim = said.rim.unwrap_or(0.3);
        check(&at.key("rim"), rim, Limit::Positive)?;
        let smoke = FadeOut::new(side.surface.clone(), rim as f32).map_err(|error| refused(at, &error))?;
        let made = swarm::Sedation {
            smoke: Arc::new(smoke),
            uptake: or(said.uptake, 0.5),
            recovery: or(said.recovery, 0.1),
            sink: or(said.sink, 0.5),
            landing: or(said.landing, 0.02),
            floors: vec![],
        };
        checked(made, at)
    }
}
