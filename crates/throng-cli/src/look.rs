//! Options for the look of pictures.

use crate::failure::Failure;
use crate::field::FieldArgs;
use crate::source::parse_four;
use clap::{Args, ValueEnum};
use glam::DVec2;
use throng_draw::{ColorBy, Projection, Style, WorldBox, columns, title_height};
use throng_scene::Scene;

/// The largest size of a sheet without a given size, pixels; such a sheet is about twice as wide as high.
const LARGEST: [f64; 2] = [1920.0, 1440.0];
const ASPECT: f64 = 2.0;
/// The maximum number of panels: more would be too small.
const MOST: usize = 9;

/// Options for the look of pictures.
#[derive(Args, Debug)]
#[command(next_help_heading = "Pictures")]
pub struct LookArgs {
    /// Width and height of the picture, pixels [default: the scene's `view.size`, else 960 wide and as high as needed]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,

    /// The part of the world to show, metres: two opposite corners [default: everything]
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = parse_four, allow_hyphen_values = true)]
    pub camera: Option<[f64; 4]>,

    /// Whether the world is drawn in plan view or in perspective [default: the scene's `view.projection`, else in
    /// perspective if agents fly]
    #[arg(long, value_enum, value_name = "HOW")]
    pub projection: Option<ProjectionArg>,

    /// Length of the trails behind agents, seconds; 0 for none
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative)]
    pub trails: Option<f64>,

    /// What the colour of an agent shows
    #[arg(long, value_enum, value_name = "WHAT", default_value_t = ColorArg::Group)]
    pub color: ColorArg,

    /// Leaves out the notch that marks the heading of an agent
    #[arg(long)]
    pub no_headings: bool,

    /// How fields are drawn.
    #[command(flatten)]
    pub field: FieldArgs,
}

/// The projections.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ProjectionArg {
    /// From straight above, true to scale
    Plan,
    /// From a viewpoint: distant objects are small and pale
    Perspective,
}

/// The quantities that colours of agents show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ColorArg {
    /// Its group
    Group,
    /// Its speed
    Speed,
    /// Its goal
    Goal,
    /// Its altitude
    Altitude,
    /// The number of agents within 1.5 m
    Density,
    /// The time to its goal on a straight line
    TimeToGoal,
}

impl LookArgs {
    /// Returns the style: the options, else the values of the scene's `[view]`, else the defaults. `bounds` are the
    /// corners of the scene.
    ///
    /// # Errors
    /// The camera's view is empty.
    pub fn style(&self, scene: &Scene, bounds: [DVec2; 2]) -> Result<Style, Failure> {
        let said = Style::said(scene);
        let given = self.camera.map(|[x0, y0, x1, y1]| {
            let (a, b) = (DVec2::new(x0, y0), DVec2::new(x1, y1));
            WorldBox { min: a.min(b), max: a.max(b) }
        });
        let shown = given.or(said.view);
        if let Some(shown) = shown.filter(|shown| (shown.max - shown.min).min_element() <= 0.0) {
            let text = format!("the camera sees {} by {} m", shown.max.x - shown.min.x, shown.max.y - shown.min.y);
            return Err(Failure::hint(text, "give two opposite corners, such as --camera=-10,-5,10,5"));
        }
        let extent = shown.map_or(bounds[1] - bounds[0], |shown| shown.max - shown.min);
        let (width, height) = self.size.or(scene.view.size.map(Into::into)).unwrap_or_else(|| shaped_like(extent));
        Ok(Style {
            width,
            height,
            view: shown,
            projection: self.projection.map(ProjectionArg::projection).or(said.projection),
            trails: self.trails.map_or(said.trails, |seconds| seconds as f32),
            color_by: match self.color {
                ColorArg::Group => ColorBy::Group,
                ColorArg::Speed => ColorBy::Speed { max: None },
                ColorArg::Goal => ColorBy::Goal,
                ColorArg::Altitude => ColorBy::Altitude,
                ColorArg::Density => ColorBy::Density,
                ColorArg::TimeToGoal => ColorBy::TimeToGoal,
            },
            flow: self.field.style(),
            headings: !self.no_headings,
            ..said
        })
    }

    /// Returns the style of a sheet of `count` panels of this style, and the number of panels side by side. A given
    /// size is the size of the whole sheet. `bounds` are the corners of the scene, `what` names the panels in messages.
    ///
    /// # Errors
    /// There are more panels than fit.
    pub fn side_by_side(
        &self,
        mut style: Style,
        count: usize,
        what: &str,
        bounds: [DVec2; 2],
    ) -> Result<(Style, usize), Failure> {
        if count > MOST {
            let text = format!("{count} {what} are too many for one picture: there is room for {MOST}");
            return Err(Failure::hint(text, "leave some out, or write a page (.html)"));
        }
        let (width, height) = (f64::from(style.width), f64::from(style.height));
        let columns = match self.size {
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
        Ok((style, columns))
    }
}

impl ProjectionArg {
    fn projection(self) -> Projection {
        match self {
            Self::Plan => Projection::Plan,
            Self::Perspective => Projection::Perspective,
        }
    }
}

/// Returns the picture size for a scene of this extent: 960 pixels wide, from 280 to 720 high by the scene's aspect
/// ratio.
fn shaped_like(extent: DVec2) -> (u32, u32) {
    // Painters do not enlarge scenes that are less than 4 m wide or high.
    let extent = extent.max(DVec2::splat(4.0));
    // Title and legend take 28 pixels at the sides and about 110 above and below.
    let height = 932.0 * extent.y / extent.x + 110.0;
    (960, height.clamp(280.0, 720.0) as u32 / 2 * 2)
}

/// Parses width and height.
pub fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let size = text.split_once(['x', 'X', '×']).and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    size.filter(|(w, h)| (16..=16384).contains(w) && (16..=16384).contains(h))
        .ok_or_else(|| "write width x height in pixels, each from 16 to 16384, such as 1280x720".into())
}

/// Parses a finite number that is at least 0.
pub fn parse_not_negative(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|x: &f64| *x >= 0.0 && x.is_finite()).ok_or_else(|| "write a number, at least 0".into())
}

/// Parses a finite number that is greater than 0.
pub fn parse_positive(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|x: &f64| *x > 0.0 && x.is_finite()).ok_or_else(|| "write a number greater than 0".into())
}
