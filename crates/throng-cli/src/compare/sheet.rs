//! All models side by side in one picture.

use super::race::{ComparePlan, ModelRun};
use crate::failure::Failure;
use crate::options::FilmArgs;
use throng_draw::{Sheet, Style};
use throng_record::Setting;

/// Returns the sheet, with one panel per model, and its style.
///
/// # Errors
/// There are more models than panels fit, or the camera's view is empty.
pub fn sheet(args: &FilmArgs, plan: &ComparePlan, runs: &[ModelRun]) -> Result<(Sheet, Style), Failure> {
    let panel = |run: &ModelRun| {
        let setting = plan.loaded.setting(&run.world, &run.built)?;
        Ok(Setting { title: plan.models[run.model].label().into(), ..setting })
    };
    let panels = runs.iter().map(panel).collect::<Result<_, Failure>>()?;
    let title = match plan.seeds.len() {
        1 => plan.loaded.title().to_owned(),
        _ => format!("{}, seed {}", plan.loaded.title(), plan.seeds[0]),
    };
    let bounds = runs[0].built.bounds;
    let style = args.style(&plan.loaded.scene, bounds)?;
    let (style, columns) = args.look.side_by_side(style, runs.len(), "models", bounds)?;
    Ok((Sheet { title, panels, columns }, style))
}
