//! The choice of the set that the scene is looked at with.

use eframe::egui::Ui;
use throng_scene::Scene;

/// What the user asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SetRequest {
    /// Chooses a file.
    Choose,
    /// Leaves the set out.
    Remove,
}

/// Shows the file of the scene's set, with buttons.
pub fn stage_set(ui: &mut Ui, scene: &Scene) -> Option<SetRequest> {
    let mut asked = None;
    ui.horizontal_wrapped(|ui| {
        let set = scene.view.set.as_ref();
        ui.label("set").on_hover_text("the meshes of a glTF file, such as a room or a street, to look at (view.set)");
        ui.label(set.map_or("none", |set| &set.file));
        if ui.button("Choose...").on_hover_text("a .glb file, or a .gltf file with everything in it").clicked() {
            asked = Some(SetRequest::Choose);
        }
        if set.is_some() && ui.button("Remove set").clicked() {
            asked = Some(SetRequest::Remove);
        }
    });
    asked
}
