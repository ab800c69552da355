//! Recording from the studio.

use super::App;
use crate::outside;
use crate::panels::{Beside, Recorded};
use crate::play::RunMoment;
use crate::record::{Format, Subject, Take};
use eframe::egui::Context;
use glam::Vec2;
use std::path::PathBuf;
use throng_draw::Style;
use throng_record::Choice;

impl App {
    /// Continues the recording and shows the recording window.
    pub(super) fn record(&mut self, ctx: &Context, shown: &RunMoment) {
        self.go_on_recording(ctx);
        let (size, camera) = (self.size_of_view(ctx), self.camera());
        let share = self.recording.as_ref().map(|(recording, _)| recording.share());
        let beside =
            Beside { shown, size, corner: self.place.right_top(), camera: &camera, share, unused: &outside::unused };
        match self.record.ui(ctx, &beside) {
            Some(Recorded::Begin) => self.begin_recording(ctx, shown, size),
            Some(Recorded::Finish) => self.finish_recording(),
            Some(Recorded::Cancel) => {
                self.recording = None;
                self.record.said = Some(Ok("cancelled: nothing was written".into()));
            }
            None => {}
        }
    }

    fn go_on_recording(&mut self, ctx: &Context) {
        let Some((recording, path)) = &mut self.recording else { return };
        let said = match outside::go_on(recording, ctx) {
            Ok(false) => return,
            Ok(true) => {
                self.record.wish.file.clear();
                Ok(outside::recorded(path))
            }
            Err(says) => Err(format!("nothing was recorded: {says}")),
        };
        self.recording = None;
        match self.after_recording.take() {
            // keeps an error visible
            Some(to) if said.is_ok() => self.go(to),
            _ => {}
        }
        if !self.record.open {
            self.notice = Some(said.clone().unwrap_or_else(|says| says));
        }
        self.record.said = Some(said);
    }

    /// Completes the recording with the frames that exist.
    pub(super) fn finish_recording(&mut self) {
        let Some((recording, _)) = &mut self.recording else { return };
        if let Err(says) = recording.finish() {
            self.recording = None;
            self.record.said = Some(Err(format!("nothing was recorded: {says}")));
        }
    }

    fn begin_recording(&mut self, ctx: &Context, shown: &RunMoment, size: [u32; 2]) {
        let wish = &self.record.wish;
        let path = PathBuf::from(wish.file.trim());
        let span = [wish.from, wish.to.unwrap_or(f64::INFINITY)];
        let begun = Format::of(&path).and_then(|format| {
            let [width, height] = wish.size_beside(shown, size);
            let view = Vec2::new(self.place.width(), self.place.height());
            let style = self.views[0].style(shown, &self.settings, view);
            let typeface = self.options.typeface.clone();
            let style = Style { width, height, legend: wish.legend, typeface, ..style };
            let choice = match format {
                Format::Trajectories => wish.chosen.choice(span, &path)?,
                _ => Choice { from: span[0], to: span[1], ..Choice::default() },
            };
            let take = Take { path: path.clone(), choice, rate: wish.rate, speed_up: wish.speed_up, style };
            outside::record(Subject::of(shown, wish.which()), take, ctx)
        });
        match begun {
            Ok(recording) => self.recording = Some((recording, path)),
            Err(says) => self.record.said = Some(Err(says)),
        }
    }

    /// Returns the width and height of the view in pixels. Both are even, which video encoders require.
    fn size_of_view(&self, ctx: &Context) -> [u32; 2] {
        [self.place.width(), self.place.height()].map(|side| {
            let pixels = (side * ctx.pixels_per_point()).clamp(16.0, 3840.0);
            pixels as u32 / 2 * 2
        })
    }

    /// Describes the camera in words.
    fn camera(&self) -> String {
        let (mode, selected) = (self.views[0].eye.mode(), self.views[0].selected);
        match selected.filter(|_| mode.follows()) {
            Some(number) => format!("{}, with agent {number}", mode.label()),
            None => format!("{}, as it is now", mode.label()),
        }
    }
}
