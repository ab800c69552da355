//! The still of a scene at a typical moment.

use crate::failure::Failure;
use crate::field::FieldArgs;
use crate::interrupt;
use crate::look::{ColorArg, LookArgs, ProjectionArg};
use crate::source::Loaded;
use throng_draw::{Painter, Style};
use throng_record::{Frame, moment};
use throng_scene::Scene;

/// The length of trails without a given length, seconds.
const TRAILS: f64 = 3.0;

/// What all stills have in common.
pub struct Look {
    /// Width and height, pixels.
    pub panel: (u32, u32),
    /// The moment, if all stills show the same.
    pub at: Option<f64>,
    /// The length of trails, if it is the same in all stills, seconds.
    pub trails: Option<f64>,
    /// The projection, if it is the same in all stills.
    pub projection: Option<ProjectionArg>,
    /// How fields are drawn.
    pub field: FieldArgs,
}

/// Runs the scene to its moment, or to its end if that comes first. Returns a painter that has followed the run, and
/// the last frame.
///
/// # Errors
/// The scene cannot be built, or the program was interrupted.
pub fn still(loaded: &Loaded, look: &Look) -> Result<(Painter, Frame), Failure> {
    let scene = &loaded.scene;
    let (mut world, built) = loaded.build(true)?;
    let style = Style { legend: false, ..style(scene, look).style(scene, built.bounds)? };
    let mut frame = Frame::default();
    moment::capture(&world, &mut frame);
    let setting = loaded.setting(&world, &built)?;
    let mut painter = Painter::new(&setting, &style, &frame)?;
    let end = look.at.unwrap_or_else(|| scene.moment());
    while world.time() + 0.5 * scene.time.step < end && !scene.time.over(&world) {
        if interrupt::asked() {
            return Err(Failure::Interrupted);
        }
        painter.follow(&frame);
        world.step();
        moment::capture(&world, &mut frame);
        moment::capture_obstacles(&world, scene, &setting, &mut frame);
    }
    painter.follow(&frame);
    Ok((painter, frame))
}

fn style(scene: &Scene, look: &Look) -> LookArgs {
    LookArgs {
        size: Some(look.panel),
        camera: None,
        projection: look.projection,
        trails: look.trails.or(scene.view.trails).or(Some(TRAILS)),
        color: ColorArg::Group,
        no_headings: false,
        no_captions: false,
        dark: false,
        field: look.field.clone(),
    }
}
