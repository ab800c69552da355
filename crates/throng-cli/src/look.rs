//! How pictures look.

use crate::failure::Failure;
use crate::field::FieldArgs;
use crate::source::parse_four;
use clap::{Args, ValueEnum};
use glam::{DVec2, DVec3};
use throng_draw::{Color, ColorBy, Form, Projection, Style, Viewpoint, WorldBox};
use throng_scene::{Camera, Colour, Scene, View};

/// How pictures look.
#[derive(Args, Debug)]
#[command(next_help_heading = "Pictures")]
pub struct LookArgs {
    /// Width and height of the picture, pixels [default: the scene's `view.size`, else 960 wide and as high as needed]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,

    /// The part of the world to show, metres: two opposite corners; without it, everything
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = parse_four, allow_hyphen_values = true)]
    pub camera: Option<[f64; 4]>,

    /// Whether the world is seen from straight above or in perspective [default: the scene's `view.projection`, else in
    /// perspective where somebody flies]
    #[arg(long, value_enum, value_name = "HOW")]
    pub projection: Option<ProjectionArg>,

    /// How long the trails behind agents are, seconds; 0 for none
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative)]
    pub trails: Option<f64>,

    /// What the colour of an agent says
    #[arg(long, value_enum, value_name = "WHAT", default_value_t = ColorArg::Group)]
    pub color: ColorArg,

    /// Leaves out the notch that shows which way an agent faces
    #[arg(long)]
    pub no_headings: bool,

    /// How fields are drawn.
    #[command(flatten)]
    pub field: FieldArgs,
}

/// How the world is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ProjectionArg {
    /// From straight above, true to scale
    Plan,
    /// By an eye: what is far away is small and pale
    Perspective,
}

/// What the colour of an agent says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ColorArg {
    /// Its group
    Group,
    /// How fast it is
    Speed,
    /// Where it goes
    Goal,
    /// How high it flies
    Altitude,
}

impl LookArgs {
    /// The style: what is said here, else what the scene's `[view]` says, else the default. `bounds` are the corners
    /// of the scene.
    ///
    /// # Errors
    /// The camera sees nothing.
    pub fn style(&self, scene: &Scene, bounds: [DVec2; 2]) -> Result<Style, Failure> {
        let (view, default) = (&scene.view, Style::default());
        let corners = match (self.camera, view.min, view.max) {
            (Some([x0, y0, x1, y1]), ..) => Some(([x0, y0], [x1, y1])),
            (None, Some(min), Some(max)) => Some((min, max)),
            _ => None,
        };
        let shown = corners.map(|(a, b)| {
            let (a, b) = (DVec2::from(a), DVec2::from(b));
            WorldBox { min: a.min(b), max: a.max(b) }
        });
        if let Some(shown) = shown.filter(|shown| (shown.max - shown.min).min_element() <= 0.0) {
            let text = format!("the camera sees {} by {} m", shown.max.x - shown.min.x, shown.max.y - shown.min.y);
            return Err(Failure::hint(text, "give two opposite corners, such as --camera=-10,-5,10,5"));
        }
        let extent = shown.map_or(bounds[1] - bounds[0], |shown| shown.max - shown.min);
        let (width, height) = self.size.or(view.size.map(Into::into)).unwrap_or_else(|| shaped_like(extent));
        let mut theme = default.theme.clone();
        let color = |Colour([r, g, b]): Colour| Color::rgb(u32::from_be_bytes([0, r, g, b]));
        let paint = |place: &mut Color, colour: Option<Colour>| {
            if let Some(colour) = colour {
                *place = color(colour);
            }
        };
        paint(&mut theme.outside, view.background);
        paint(&mut theme.ground, view.ground);
        paint(&mut theme.obstacle, view.obstacles);
        Ok(Style {
            width,
            height,
            view: shown,
            projection: self.projection(view),
            viewpoint: viewpoint(view.camera.unwrap_or_default()),
            trails: self.trails.or(view.trails).map_or(default.trails, |seconds| seconds as f32),
            color_by: match self.color {
                ColorArg::Group => ColorBy::Group,
                ColorArg::Speed => ColorBy::Speed { max: None },
                ColorArg::Goal => ColorBy::Goal,
                ColorArg::Altitude => ColorBy::Altitude,
            },
            groups: scene.groups.iter().map(|group| group.colour.map(color)).collect(),
            forms: scene.groups.iter().map(|group| form(group.mark)).collect(),
            flow: self.field.style(),
            headings: !self.no_headings,
            lines: view.lines.iter().map(|line| line.iter().copied().map(DVec2::from).collect()).collect(),
            goals: view.goals.unwrap_or(default.goals),
            theme,
            ..default
        })
    }
}

impl LookArgs {
    /// How the world is seen, if anybody says so: who places an eye wants to see through it.
    fn projection(&self, view: &View) -> Option<Projection> {
        match (self.projection, view.projection) {
            (Some(ProjectionArg::Plan), _) => Some(Projection::Plan),
            (Some(ProjectionArg::Perspective), _) => Some(Projection::Perspective),
            (None, Some(throng_scene::Projection::Plan)) => Some(Projection::Plan),
            (None, Some(throng_scene::Projection::Perspective)) => Some(Projection::Perspective),
            (None, None) => view.camera.map(|_| Projection::Perspective),
        }
    }
}

/// What those of a group look like.
fn form(said: Option<throng_scene::Mark>) -> Form {
    match said {
        Some(throng_scene::Mark::Insect) => Form::Insect,
        Some(throng_scene::Mark::Body) | None => Form::Body,
    }
}

fn viewpoint(camera: Camera) -> Viewpoint {
    let standard = Viewpoint::default();
    Viewpoint {
        eye: camera.eye.map(DVec3::from),
        target: camera.target.map(DVec3::from),
        field_of_view: camera.field_of_view.unwrap_or(standard.field_of_view),
        orbit: camera.orbit.unwrap_or(standard.orbit),
    }
}

/// A picture 960 pixels wide, at most 720 high, and lower where the scene is wide and low.
fn shaped_like(extent: DVec2) -> (u32, u32) {
    // Painters blow nothing up that is less than 4 m wide or high.
    let extent = extent.max(DVec2::splat(4.0));
    // What title and legend take is 28 pixels at the sides and about 110 above and below.
    let height = 932.0 * extent.y / extent.x + 110.0;
    (960, height.clamp(280.0, 720.0) as u32 / 2 * 2)
}

/// Reads width and height.
pub fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let size = text.split_once(['x', 'X', '×']).and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    size.filter(|(w, h)| (16..=16384).contains(w) && (16..=16384).contains(h))
        .ok_or_else(|| "write width x height in pixels, each from 16 to 16384, such as 1280x720".into())
}

/// Reads a number that is at least 0 and finite.
pub fn parse_not_negative(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|x: &f64| *x >= 0.0 && x.is_finite()).ok_or_else(|| "write a number, at least 0".into())
}

/// Reads a number that is greater than 0 and finite.
pub fn parse_positive(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|x: &f64| *x > 0.0 && x.is_finite()).ok_or_else(|| "write a number greater than 0".into())
}
