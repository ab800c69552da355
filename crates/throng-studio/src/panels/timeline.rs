//! The timeline: how far the run has been computed, the shown step, and the keys of the camera.

use super::bar::{Asked, named};
use super::camera_keys::{Rail, camera_keys, lane};
use crate::play::{Command, RunMoment};
use eframe::egui::{Rect, Role, Slider, Ui, vec2};
use throng_scene::CameraKey;

/// The shortest timeline of a run without a known end, seconds.
const SHORTEST: f64 = 10.0;

/// The computed part of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Timeline {
    run: u64,
    /// The farthest computed step.
    computed: u64,
    /// The last step, once the run has reached it.
    end: Option<u64>,
}

impl Timeline {
    /// Follows the run to the shown moment.
    pub fn follow(&mut self, shown: &RunMoment) {
        self.advance(shown.run, shown.step, shown.over);
    }

    fn advance(&mut self, run: u64, step: u64, over: bool) {
        if self.run != run {
            *self = Self { run, ..Self::default() };
        }
        self.computed = self.computed.max(step);
        // a changed scene can go on after its former end
        self.end = if over { Some(step) } else { self.end.filter(|&end| step < end) };
    }

    /// Returns the last step of the timeline, for steps of a length and a time limit, seconds. The end of the run if it is
    /// known, else somewhat more than the computed part and the last key.
    fn last(&self, step: f64, limit: f64, key: f64) -> u64 {
        let steps = |seconds: f64| (seconds / step).round().max(1.0) as u64;
        let mut seconds = SHORTEST;
        while steps(seconds) <= self.computed.max(steps(key)) && seconds < limit {
            seconds *= 2.0;
        }
        self.end.unwrap_or(steps(seconds.min(limit))).max(self.computed).max(1)
    }

    /// Shows the timeline over the whole width, with the keys of the camera above it. A drag seeks to a step.
    pub fn ui(&mut self, ui: &mut Ui, shown: &RunMoment, keys: &[CameraKey], asked: &mut Asked) {
        self.follow(shown);
        let (time, replay) = (&shown.scene.time, shown.reel.is_some());
        let most = (time.limit / time.step).round().max(1.0) as u64;
        let last = if replay {
            most.max(shown.step)
        } else {
            self.last(time.step, time.limit, keys.last().map_or(0.0, |key| key.time))
        };
        let computed = if replay { last } else { self.computed };
        let mut step = shown.step;
        ui.spacing_mut().slider_width = ui.available_width();
        let lane = (!keys.is_empty()).then(|| lane(ui));
        let slider = ui.add(Slider::new(&mut step, 0..=last).show_value(false).step_by(1.0));
        named(&slider, Role::Slider, "step");
        let rail = slider.rect.shrink2(vec2(slider.rect.height() / 2.5, 0.0));
        let right = rail.left() + rail.width() * computed as f32 / last as f32;
        let below = rail.center().y + 0.5 * ui.spacing().slider_rail_height;
        let done = Rect::from_x_y_ranges(rail.left()..=right, below + 1.0..=below + 3.0);
        ui.painter().rect_filled(done, 1.0, ui.visuals().hyperlink_color);
        let end = match self.end {
            Some(end) => format!("the run ends at step {end}"),
            None => format!("computed to step {computed}, of at most {most}"),
        };
        if slider.on_hover_text(format!("step {}; {end}", shown.step)).changed() {
            asked.commands.push(Command::Seek(step));
        }
        if let Some(lane) = lane {
            let rail = Rail { place: Rect::from_x_y_ranges(rail.x_range(), lane.y_range()), step: time.step, last };
            asked.camera = asked.camera.or(camera_keys(ui, &rail, keys, shown.frame.time));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Timeline;

    #[test]
    fn the_timeline_ends_where_the_run_ends() {
        let mut line = Timeline::default();
        line.advance(1, 30, false);
        assert_eq!(line.last(0.04, 120.0, 0.0), 250, "the limit is not the end");
        line.advance(1, 260, false);
        assert_eq!(line.last(0.04, 120.0, 0.0), 500);
        line.advance(1, 437, true);
        line.advance(1, 12, false);
        assert_eq!((line.last(0.04, 120.0, 0.0), line.computed), (437, 437), "stepping back forgets nothing");
        line.advance(1, 440, false);
        assert_eq!(line.last(0.04, 120.0, 0.0), 500, "a changed scene goes on");
        line.advance(2, 0, false);
        assert_eq!((line.last(0.04, 4.0, 0.0), line.computed), (100, 0));
        assert_eq!(line.last(0.04, 120.0, 15.0), 500, "keys are on the timeline");
    }
}
