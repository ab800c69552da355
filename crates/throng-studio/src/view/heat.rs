//! Density and speed of the crowd, as colour on the ground.

use super::geometry::{Geometry, Picture};
use super::kernel::{Raster, Sums};
use super::made::Made;
use crate::play::Shown;
use eframe::egui::Context;
use std::collections::VecDeque;
use std::sync::Arc;
use throng_draw::{Color, ramp};

/// What the colour of the ground says of the crowd.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Heat {
    /// Nothing.
    #[default]
    None,
    /// How dense it is.
    Density,
    /// How fast it is.
    Speed,
}

impl Heat {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::None, Self::Density, Self::Speed];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Density => "density",
            Self::Speed => "speed",
        }
    }

    /// The colour of a part of the most, 0 to 1: of a speed as that of agents; a dense crowd is farthest from the ground's own.
    pub fn color(self, part: f32, dark: bool) -> Color {
        ramp(if self == Self::Density && !dark { 1.0 - part } else { part })
    }
}

/// How heat is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heating {
    /// What is seen.
    pub heat: Heat,
    /// Over how many seconds it is the mean; 0: what is now.
    pub window: f32,
    /// The most that colours tell apart: agents a square metre, or m/s.
    pub most: f32,
    /// Whether the ground is dark.
    pub dark: bool,
}

/// The colours stand for so many states in a window at most.
const STATES: f64 = 32.0;
/// How opaque they are where there are people.
const OPACITY: f32 = 0.78;
/// The density at which they have got there for the most part, agents a square metre: alone one is 0.3 where it stands.
const FAINT: f32 = 0.12;

/// The colours of the ground as they were drawn last.
#[derive(Default)]
pub struct HeatMap {
    run: u64,
    past: VecDeque<Arc<Sums>>,
    made: Made<(u64, u64, Heating), Sheet>,
}

/// What is made beside the window.
struct Sheet {
    sums: Arc<Sums>,
    layer: Arc<Geometry>,
}

impl HeatMap {
    /// The colours of a moment; those of the last one until they are there.
    pub fn layer(&mut self, shown: &Shown, heating: Heating, ctx: &Context) -> Arc<Geometry> {
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
            let picture = Picture::new(corners, raster.size(), colors(&all, heating).into_iter());
            let layer = Arc::new(Geometry { picture: Some(picture), ..Geometry::default() });
            Sheet { sums, layer }
        };
        let Some(sheet) = self.made.of((shown.run, shown.step, heating), ctx, make) else { return Arc::default() };
        self.remember(&sheet.sums, f64::from(heating.window));
        sheet.layer.clone()
    }

    fn remember(&mut self, sums: &Arc<Sums>, window: f64) {
        let now = sums.time;
        // the run may have gone back
        self.past.retain(|other| (now - window..=now).contains(&other.time));
        if self.past.back().is_none_or(|last| now >= last.time + window / STATES && now > last.time) {
            self.past.push_back(sums.clone());
        }
    }
}

/// The colour of each cell, in the mean over some moments.
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
        // three quarters of those who were there went at 1 m/s
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
