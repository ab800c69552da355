//! Heat maps of density and speed on the ground.

use super::derived::Derived;
use super::geometry::{Geometry, GroundPicture};
use super::kernel::{Raster, Sums};
use crate::play::RunMoment;
use eframe::egui::Context;
use std::collections::VecDeque;
use std::sync::Arc;
use throng_draw::{Color, ramp};

/// The quantity of a heat map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Heat {
    /// No heat map.
    #[default]
    None,
    /// Density of the crowd.
    Density,
    /// Speed of the crowd.
    Speed,
}

impl Heat {
    /// All quantities.
    pub const ALL: [Self; 3] = [Self::None, Self::Density, Self::Speed];

    /// Returns the label.
    pub fn label(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Density => "density",
            Self::Speed => "speed",
        }
    }

    /// Returns the colour of a share of the maximum, 0 to 1. Speeds have the colours of agents. High density has the
    /// strongest contrast to the ground.
    pub fn color(self, part: f32, dark: bool) -> Color {
        ramp(if self == Self::Density && !dark { 1.0 - part } else { part })
    }
}

/// The settings of a heat map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heating {
    /// The quantity.
    pub heat: Heat,
    /// The averaging window, seconds. 0 for the current state only.
    pub window: f32,
    /// The maximum of the colour scale: agents per square metre, or m/s.
    pub most: f32,
    /// Whether the ground is dark.
    pub dark: bool,
}

/// The most states averaged in a window.
const STATES: f64 = 32.0;
/// The opacity where agents are.
const OPACITY: f32 = 0.78;
/// The density at which the opacity reaches 63 % of its maximum, agents per square metre. A single agent has 0.3 at its
/// position.
const FAINT: f32 = 0.12;

/// The heat map as drawn last.
#[derive(Default)]
pub struct HeatMap {
    run: u64,
    past: VecDeque<Arc<Sums>>,
    made: Derived<(u64, u64, Heating), HeatSheet>,
}

/// The result of the background computation.
struct HeatSheet {
    sums: Arc<Sums>,
    layer: Arc<Geometry>,
}

impl HeatMap {
    /// Returns the heat map of a moment. While it is computed, returns the previous one.
    pub fn layer(&mut self, shown: &RunMoment, heating: Heating, ctx: &Context) -> Arc<Geometry> {
        if heating.heat == Heat::None || self.run != shown.run {
            *self = Self { run: shown.run, ..Self::default() };
        }
        if heating.heat == Heat::None {
            return Arc::default();
        }
        let (raster, origin) = (Raster::over(shown.bounds), shown.setting.origin);
        let (frame, past) = (shown.frame.clone(), self.past.clone());
        let make = move || {
            let agents = frame.bodies.iter().map(|body| (body.position, body.velocity.length()));
            let sums = Arc::new(Sums::of(&raster, frame.time, agents));
            let since = frame.time - f64::from(heating.window);
            let mut all: Vec<&Sums> = past.iter().map(|sums| &**sums).collect();
            all.retain(|other| (since..frame.time).contains(&other.time));
            all.push(&sums);
            let corners = raster.corners().map(|corner| corner - origin);
            let picture = GroundPicture::new(corners, raster.size(), colors(&all, heating).into_iter());
            let layer = Arc::new(Geometry { picture: Some(picture), ..Geometry::default() });
            HeatSheet { sums, layer }
        };
        let Some(sheet) = self.made.of((shown.run, shown.step, heating), ctx, make) else { return Arc::default() };
        self.remember(&sheet.sums, f64::from(heating.window));
        sheet.layer.clone()
    }

    fn remember(&mut self, sums: &Arc<Sums>, window: f64) {
        let now = sums.time;
        // drops later states, because the run may have gone back
        self.past.retain(|other| (now - window..=now).contains(&other.time));
        if self.past.back().is_none_or(|last| now >= last.time + window / STATES && now > last.time) {
            self.past.push_back(sums.clone());
        }
    }
}

/// Returns the colour of each cell, averaged over several moments.
fn colors(moments: &[&Sums], heating: Heating) -> Vec<Color> {
    let Heating { heat, most, dark, .. } = heating;
    let mean = |k: usize| {
        let add = |[density, flow]: [f32; 2], sums: &&Sums| [density + sums.densities[k], flow + sums.flows[k]];
        let [density, flow] = moments.iter().fold([0.0; 2], add);
        [density / moments.len() as f32, flow / density.max(f32::MIN_POSITIVE)]
    };
    let cells = moments.first().map_or(0, |sums| sums.densities.len());
    let cell = |k: usize| {
        let [density, speed] = mean(k);
        let amount = if heat == Heat::Speed { speed } else { density };
        heat.color(amount / most, dark).alpha(OPACITY * (1.0 - (-density / FAINT).exp()))
    };
    (0..cells).map(cell).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_over_a_window_counts_everybody_as_long_as_they_were_there() {
        let sums =
            |time: f64, density: f32, speed: f32| Sums { time, densities: vec![density], flows: vec![density * speed] };
        let (one, two) = (sums(0.0, 1.0, 2.0), sums(1.0, 3.0, 1.0));
        let heating = |heat: Heat, most: f32| Heating { heat, window: 2.0, most, dark: true };
        let [density] = colors(&[&one, &two], heating(Heat::Density, 4.0))[..] else { panic!() };
        let [speed] = colors(&[&one, &two], heating(Heat::Speed, 2.0))[..] else { panic!() };
        assert_eq!(density.alpha(1.0), ramp(2.0 / 4.0));
        // three of four agent-moments have 1 m/s
        assert_eq!(speed.alpha(1.0), ramp(1.25 / 2.0));
        assert_eq!(colors(&[&sums(0.0, 0.0, 0.0)], heating(Heat::Speed, 2.0))[0].a, 0);
    }

    #[test]
    fn a_window_has_few_states_none_of_them_from_later() {
        let mut map = HeatMap::default();
        let at = |time: f64| Arc::new(Sums { time, densities: Vec::new(), flows: Vec::new() });
        (0..500).for_each(|step| map.remember(&at(f64::from(step) * 0.04), 10.0));
        assert!((30..=34).contains(&map.past.len()), "{}", map.past.len());
        assert!(map.past.iter().all(|sums| sums.time > 9.9));
        map.remember(&at(15.0), 10.0);
        assert!(map.past.iter().all(|sums| sums.time <= 15.0) && !map.past.is_empty());
        map.remember(&at(16.0), 0.0);
        assert_eq!(map.past.len(), 1);
    }
}
