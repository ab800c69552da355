//! The question before unsaved work is lost.

use crate::keep::{Answer, Leaving, Unfinished};
use eframe::egui::{Context, Id, Modal};

/// Shows the question about the unfinished work on `name`. Returns the answer once there is one.
pub fn leaving(ctx: &Context, name: &str, to: &Leaving, of: Unfinished) -> Option<Answer> {
    let modal = Modal::new(Id::unique("leaving")).show(ctx, |ui| {
        ui.set_max_width(360.0);
        ui.label(to.says(of, name));
        ui.add_space(10.0);
        ui.horizontal(|ui| {
            let mut asked = None;
            for (answer, says) in to.answers(of) {
                if ui.button(says).clicked() {
                    asked = Some(answer);
                }
            }
            asked
        })
        .inner
    });
    modal.inner.or_else(|| modal.should_close().then_some(Answer::Keep))
}
