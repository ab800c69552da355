//! All models side by side in one picture.

use super::race::{Plan, Run};
use crate::failure::Failure;
use crate::options::FilmArgs;
use throng_draw::{Sheet, Style, columns, title_height};
use throng_record::moment;

/// More panels than this are too small to see anything.
const MOST: usize = 9;
/// A sheet nobody gave a size is at most this wide and high, pixels, and about twice as wide as high.
const LARGEST: [f64; 2] = [1920.0, 1440.0];
const ASPECT: f64 = 2.0;

/// The panels, a model each, and the look of the sheet.
///
/// # Errors
/// There are more models than fit, or the camera sees nothing.
pub fn sheet(args: &FilmArgs, plan: &Plan, runs: &[Run]) -> Result<(Sheet, Style), Failure> {
    let count = runs.len();
    if count > MOST {
        let text = format!("{count} models are too many for one picture: there is room for {MOST}");
        return Err(Failure::hint(text, "leave some out, or write a page (.html) or a table (.csv, .md)"));
    }
    let panel = |run: &Run| moment::setting(&run.world, &run.built, plan.models[run.model].label());
    let panels = runs.iter().map(panel).collect();
    let title = match plan.seeds.len() {
        1 => plan.loaded.title().to_owned(),
        _ => format!("{}, seed {}", plan.loaded.title(), plan.seeds[0]),
    };
    let bounds = runs[0].built.bounds;
    let mut style = args.look.style(&plan.loaded.scene, bounds)?;
    let (width, height) = (f64::from(style.width), f64::from(style.height));
    let columns = match args.look.size {
        Some(_) => {
            let extent = style.view.map_or(bounds[1] - bounds[0], |view| view.max - view.min);
            columns(count, (extent.x.max(1.0) / extent.y.max(1.0)).clamp(0.2, 5.0), width / height)
        }
        None => {
            let columns = columns(count, width / height, ASPECT);
            let whole = [width * columns as f64, height * count.div_ceil(columns) as f64];
            let fit = (LARGEST[0] / whole[0]).min(LARGEST[1] / whole[1]).min(1.0);
            let even = |pixels: f64| (pixels * fit * 0.5).round() as u32 * 2;
            style.width = even(whole[0]);
            style.height = even(whole[1]) + title_height(style.width);
            columns
        }
    };
    Ok((Sheet { title, panels, columns }, style))
}
