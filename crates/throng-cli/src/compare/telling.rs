//! The moment at which the models differ most, for single pictures.

use super::race::ModelRun;
use crate::failure::Failure;
use glam::DVec2;
use std::collections::VecDeque;
use std::sync::Arc;
use throng_draw::Film;
use throng_record::Frame;

/// The least time before the moment that the picture follows, seconds: footfalls need it, and trails if they are shorter.
const BEFORE: f64 = 2.0;

/// A moment of all models.
type Moment = Vec<Arc<Frame>>;

/// A picture of the moment at which the models differ most: the one with the greatest [`difference`], the first of
/// several. If they never differ, the last moment.
pub struct TellingPicture {
    film: Film,
    /// The time before the moment that the picture follows, seconds.
    before: f64,
    /// The last moments.
    recent: VecDeque<Moment>,
    /// The greatest difference so far, and the moments that lead to it.
    best: (f64, Vec<Moment>),
}

impl TellingPicture {
    /// Creates the picture in an unfinished film of one picture. `trails` is the length of trails, seconds.
    ///
    /// # Errors
    /// The size of the panels is outside its limits.
    pub fn new(mut film: Film, trails: f32, runs: &[ModelRun]) -> Result<Self, Failure> {
        film.fit_to(&runs.iter().map(|run| &*run.frame).collect::<Vec<_>>())?;
        let before = f64::from(trails).max(BEFORE);
        Ok(Self { film, before, recent: VecDeque::new(), best: (0.0, Vec::new()) })
    }

    /// Takes the current moment of the models.
    pub fn push(&mut self, runs: &[ModelRun]) {
        let moment: Moment = runs.iter().map(|run| run.frame.clone()).collect();
        let time = latest(&moment);
        self.recent.push_back(moment);
        while self.recent.front().is_some_and(|first| latest(first) < time - self.before) {
            self.recent.pop_front();
        }
        let difference = self.recent.back().map_or(0.0, |moment| difference(moment));
        if difference > self.best.0 {
            self.best = (difference, self.recent.iter().cloned().collect());
        }
    }

    /// Writes the picture.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn finish(mut self) -> Result<(), Failure> {
        let moments = if self.best.1.is_empty() { self.recent.into() } else { self.best.1 };
        for moment in &moments {
            self.film.push_all(&moment.iter().map(|frame| &**frame).collect::<Vec<_>>())?;
        }
        Ok(self.film.finish()?)
    }
}

fn latest(moment: &Moment) -> f64 {
    moment.iter().map(|frame| frame.time).fold(f64::NEG_INFINITY, f64::max)
}

/// Returns how much the models differ at a moment, metres: the mean over all agents of the distance from where the models
/// have an agent to the middle of these places (root mean square). An agent that only one model still has counts as 0.
fn difference(moment: &[Arc<Frame>]) -> f64 {
    let mut bodies: Vec<(u32, DVec2)> =
        moment.iter().flat_map(|frame| &frame.bodies).map(|body| (body.number, body.position)).collect();
    bodies.sort_by_key(|(number, _)| *number);
    let spread = |places: &[(u32, DVec2)]| {
        let count = places.len() as f64;
        let middle = places.iter().map(|(_, place)| *place).sum::<DVec2>() / count;
        (places.iter().map(|(_, place)| place.distance_squared(middle)).sum::<f64>() / count).sqrt()
    };
    let sum: f64 = bodies.chunk_by(|a, b| a.0 == b.0).map(spread).filter(|spread| spread.is_finite()).sum();
    let agents = moment.iter().map(|frame| frame.total).max().unwrap_or(0);
    sum / agents.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng::{Agent, Settings, World};

    fn frame(places: &[(u32, f64)]) -> Arc<Frame> {
        let mut world = World::new(Settings::default()).unwrap();
        for &(number, x) in places {
            let agent = Agent { number: Some(number), ..Agent::at([x, f64::from(number)]) };
            world.add_agent(agent).unwrap();
        }
        Arc::new(Frame { total: 4, ..Frame::of(&world) })
    }

    #[test]
    fn the_difference_is_the_mean_distance_of_an_agent_from_the_middle_of_its_places() {
        let same = frame(&[(0, 0.0), (1, 5.0)]);
        assert_eq!(difference(&[same.clone(), same.clone()]), 0.0);
        // agent 0 is 1 m from the middle in both models, agent 1 at the same place, agent 2 in one model only
        let other = frame(&[(0, 2.0), (1, 5.0), (2, 90.0)]);
        assert!((difference(&[same.clone(), other]) - 1.0 / 4.0).abs() < 1e-6);
        assert_eq!(difference(&[same]), 0.0);
    }
}
