//! What the user has done to the running scene, and whether to keep it.

use eframe::egui::{Context, Id, Modal, RichText, Ui};
use throng_scene::Intervention;

/// An answer of the user.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeepAnswer {
    /// Write the interventions into the text of the scene.
    Keep,
    /// Start again without them.
    Forget,
}

/// An answer to the question before a restart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RestartAnswer {
    /// Write the interventions into the text, then start again.
    Keep,
    /// Start again without them.
    Forget,
    /// Go on.
    Cancel,
}

/// Asks what becomes of the interventions in a restart. Returns the answer once there is one.
pub fn restarting(ctx: &Context) -> Option<RestartAnswer> {
    let modal = Modal::new(Id::unique("restarting")).show(ctx, |ui| {
        ui.set_max_width(360.0);
        ui.label("A restart forgets what you have done to the running scene.");
        ui.add_space(10.0);
        let answers = [
            ("Keep it in the scene", RestartAnswer::Keep),
            ("Restart without it", RestartAnswer::Forget),
            ("Cancel", RestartAnswer::Cancel),
        ];
        let clicked = |ui: &mut Ui| answers.into_iter().filter(|(says, _)| ui.button(*says).clicked()).last();
        ui.horizontal_wrapped(clicked).inner.map(|(_, answer)| answer)
    });
    modal.inner.or_else(|| modal.should_close().then_some(RestartAnswer::Cancel))
}

/// Shows the number of interventions and the choices. Returns the answer.
pub fn interventions(ui: &mut Ui, made: &[Intervention]) -> Option<KeepAnswer> {
    let mut answer = None;
    ui.horizontal(|ui| {
        let count = made.len();
        ui.label(
            RichText::new(if count == 1 { "1 intervention".into() } else { format!("{count} interventions") }).strong(),
        );
        if ui.button("Keep in the scene").on_hover_text("write them into the text: each run repeats them").clicked() {
            answer = Some(KeepAnswer::Keep);
        }
        if ui.button("Start again").on_hover_text("restart the scene without them (R)").clicked() {
            answer = Some(KeepAnswer::Forget);
        }
    });
    answer
}
