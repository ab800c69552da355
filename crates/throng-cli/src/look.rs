//! Options for the look of pictures.

use crate::failure::Failure;
use crate::field::FieldArgs;
use crate::source::parse_four;
use clap::{Args, ValueEnum};
use glam::DVec2;
use throng_draw::{ColorBy, Following, Motion, Projection, Style, Theme, WorldBox, columns, title_height};
use throng_scene::Scene;

/// The largest size of a sheet without a given size, pixels; such a sheet is about twice as wide as high.
const LARGEST: [f64; 2] = [1920.0, 1440.0];
const ASPECT: f64 = 2.0;
/// The maximum number of panels: more would be too small.
const MOST: usize = 9;

/// The angular velocity of a camera that orbits, degrees a second: a round in half a minute.
const ORBIT: f64 = 12.0;

/// Options for the look of pictures.
#[derive(Args, Debug)]
#[command(next_help_heading = "Pictures")]
pub struct LookArgs {
    /// Width and height of the picture, pixels [default: the scene's `view.size`, else 960 wide and as high as needed]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,

    /// The part of the world to show, metres: two opposite corners X0,Y0,X1,Y1 [default: everything]. Or how the camera
    /// moves, in perspective: `crowd` (agents fill the picture), `orbit:12` (degrees a second about the scene),
    /// `follow:3` (agent 3). The scene's `view.camera` can have keys as well
    #[arg(long, value_name = "WHAT", value_parser = parse_camera, allow_hyphen_values = true)]
    pub camera: Option<CameraArg>,

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

    /// Leaves out the title, the time, the counts, the key of colours and the scale
    #[arg(long)]
    pub no_captions: bool,

    /// Light on dark
    #[arg(long)]
    pub dark: bool,

    /// How fields are drawn.
    #[command(flatten)]
    pub field: FieldArgs,
}

/// What a camera shows.
#[derive(Clone, Debug, PartialEq)]
pub enum CameraArg {
    /// The part of the world between two corners.
    Part([f64; 4]),
    /// What its motion leads to.
    Moves(Motion),
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
        let said = Style::themed(scene, if self.dark { Theme::dark() } else { Theme::light() });
        let mut viewpoint = said.viewpoint.clone();
        let mut projection = self.projection.map(ProjectionArg::projection).or(said.projection);
        let given = match &self.camera {
            Some(CameraArg::Part([x0, y0, x1, y1])) => {
                let (a, b) = (DVec2::new(*x0, *y0), DVec2::new(*x1, *y1));
                Some(WorldBox { min: a.min(b), max: a.max(b) })
            }
            Some(CameraArg::Moves(motion)) if projection == Some(Projection::Plan) && self.projection.is_some() => {
                let text = format!("a camera that moves ({}) needs a view in perspective", name(motion));
                return Err(Failure::hint(text, "leave out --projection plan, or give two corners"));
            }
            Some(CameraArg::Moves(motion)) => {
                viewpoint.motion = motion.clone();
                projection = Some(Projection::Perspective);
                None
            }
            None => None,
        };
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
            projection,
            viewpoint,
            trails: self.trails.map_or(said.trails, |seconds| seconds as f32),
            color_by: match self.color {
                ColorArg::Group => ColorBy::Group,
                ColorArg::Speed => ColorBy::Speed { max: None },
                ColorArg::Goal => ColorBy::Goal,
                ColorArg::Altitude => ColorBy::Altitude,
                ColorArg::Density => ColorBy::Density,
                ColorArg::TimeToGoal => ColorBy::TimeToGoal,
            },
            flow: self.field.style().or_else(|| said.flow.clone()),
            headings: !self.no_headings,
            legend: !self.no_captions,
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

/// Parses what a camera shows.
fn parse_camera(text: &str) -> Result<CameraArg, String> {
    let motion = match text.split_once(':').unwrap_or((text, "")) {
        ("crowd", "") => Motion::Crowd,
        ("orbit", rate) => {
            let rate = if rate.is_empty() { Some(ORBIT) } else { rate.parse().ok() };
            Motion::Orbit(
                rate.filter(|rate: &f64| rate.abs() <= 3600.0)
                    .ok_or("write orbit: and degrees a second, such as orbit:12")?,
            )
        }
        ("follow", number) => Motion::Follow(Following::usual(
            number.parse().map_err(|_| "write follow: and the number of an agent, such as follow:3")?,
        )),
        _ => {
            let part = parse_four(text).map_err(|error| format!("{error}; or crowd, orbit:12 or follow:3"))?;
            return Ok(CameraArg::Part(part));
        }
    };
    Ok(CameraArg::Moves(motion))
}

fn name(motion: &Motion) -> &'static str {
    match motion {
        Motion::Crowd => "crowd",
        Motion::Orbit(_) => "orbit",
        Motion::Follow(_) => "follow",
        _ => "keys",
    }
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
