//! Fields that lead to goals.

use super::sketch::SPEED;
use crate::assemble::goals::check_region;
use crate::assemble::limits::{Limit, check, check_some};
use crate::file::Problem;
use crate::geometry::{DVec2, points, rectangle};
use crate::registry::{BuildField, FieldContext};
use crate::scene::Region;
use crate::scene::flow::{Destination, Jams, ToGoal};
use std::sync::Arc;
use throng::field::Field;
use throng_field::{RoundJams, Terrain, TerrainSettings};

/// Default margin around the scene that paths may use, metres.
const MARGIN: f64 = 2.0;
/// Default maximum number of cells.
const CELLS: f64 = 1e6;

impl BuildField for ToGoal {
    fn make(&self, at: &FieldContext) -> Result<Arc<dyn Field>, Problem> {
        let Self { speed, radius, clearance, cell, .. } = self;
        check_some(&at.path.key("cell"), *cell, Limit::Positive)?;
        check_some(&at.path.key("radius"), *radius, Limit::NotNegative)?;
        check_some(&at.path.key("clearance"), *clearance, Limit::NotNegative)?;
        let speed = speed.unwrap_or(SPEED);
        check(&at.path.key("speed"), speed, Limit::UpTo(1000.0))?;
        let [low, high] = at.scene.bounds();
        let [low, high] = [low - MARGIN, high + MARGIN].map(|corner| corner.to_array());
        let [low, high] = at.corners(self.min.unwrap_or(low), self.max.unwrap_or(high))?;
        let standard = TerrainSettings::default();
        let size = high - low;
        let survey = TerrainSettings {
            low,
            high,
            cell: cell.unwrap_or_else(|| standard.cell.max((size.x * size.y / CELLS).sqrt())),
            radius: radius.unwrap_or(standard.radius),
            clearance: clearance.map_or(standard.clearance, |clearance| clearance as f32),
            ..standard
        };
        let terrain = Terrain::of_place(at.scene.ground(&at.path)?, at.scene.origin(), survey);
        let mut terrain = terrain.map_err(|error| at.refused(&error))?;
        if let Some(cost) = &self.cost {
            let map = at.key("cost").map(cost)?;
            terrain.paint(|place| 1.0 + map.at(place)).map_err(|error| at.key("cost").refused(&error))?;
        }
        let to = self.to.iter().enumerate().map(|(i, to)| at.key("to").index(i).destination(to));
        let to: Vec<_> = to.collect::<Result<_, _>>()?;
        let flow = throng_field::ToGoal::new(Arc::new(terrain), to, speed as f32);
        let flow = flow.map_err(|error| at.key("to").refused(&error))?;
        let Some(jams) = &self.jams else { return Ok(Arc::new(flow)) };
        let Jams { weary, radius, every, part } = jams;
        let jams = at.key("jams");
        for (key, number) in [("weary", weary), ("radius", radius), ("every", every)] {
            check_some(&jams.path.key(key), *number, Limit::Positive)?;
        }
        check_some(&jams.path.key("part"), *part, Limit::UpTo(1.0))?;
        let standard = RoundJams::new(flow);
        let made = RoundJams {
            weary: weary.map_or(standard.weary, |weary| weary as f32),
            radius: radius.unwrap_or(standard.radius),
            interval: every.unwrap_or(standard.interval),
            part: part.map_or(standard.part, |part| part as f32),
            ..standard
        };
        Ok(Arc::new(made))
    }
}

impl FieldContext<'_> {
    fn destination(&self, said: &Destination) -> Result<throng_field::Destination, Problem> {
        let corners = |corners: Vec<DVec2>| corners.into_iter().map(|corner| corner - self.scene.origin()).collect();
        Ok(match said {
            Destination::Point(point) => {
                let at = self.key("point").place("at", point.at)?;
                throng_field::Destination::Point { at, tolerance: point.tolerance }
            }
            Destination::Area(region) => {
                check_region(&self.path.key("area"), region)?;
                match region {
                    Region::Disc(disc) => {
                        let center = DVec2::from_array(disc.center) - self.scene.origin();
                        throng_field::Destination::Disc { center, radius: disc.radius }
                    }
                    Region::Rectangle(said) => throng_field::Destination::Area { corners: corners(rectangle(said)) },
                    Region::Polygon(said) => throng_field::Destination::Area { corners: corners(points(said)) },
                }
            }
        })
    }
}
