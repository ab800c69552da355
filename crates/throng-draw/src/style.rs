//! How a picture should look.

use crate::{Annotations, Color, FlowStyle, Shape, Typeface, Viewpoint, WorldBox};
use glam::DVec2;

/// How a picture should look. The default is a calm light picture of 640 by 480 pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    /// Width of the picture, pixels, 16 to 16384.
    pub width: u32,
    /// Height of the picture, pixels, 16 to 16384.
    pub height: u32,
    /// The part of the world to show; `None`: everything the setting and the first frame hold. In perspective, what must
    /// be seen of the ground, if the eye has no place of its own.
    pub view: Option<WorldBox>,
    /// Whether it is seen from straight above or in perspective; `None`: in perspective where somebody flies.
    pub projection: Option<Projection>,
    /// From where it is seen in perspective.
    pub viewpoint: Viewpoint,
    /// How long a trail is, seconds; 0 for none.
    pub trails: f32,
    /// What the colour of an agent says.
    pub color_by: ColorBy,
    /// The colours of groups, by index; where there is none, the palette's.
    pub groups: Vec<Option<Color>>,
    /// What agents of groups look like, by index; where there is nothing said, as their bodies are.
    pub forms: Vec<Form>,
    /// How long the shutter is open while a picture of insects is taken, seconds: the streak that each leaves is its way in that time;
    /// 0 for none.
    pub shutter: f32,
    /// What is drawn beside agents of what they have in mind.
    pub annotations: Annotations,
    /// How the fields that lead groups are drawn on the ground, from straight above; `None`: not.
    pub flow: Option<FlowStyle>,
    /// Whether agents have a notch that shows their heading.
    pub headings: bool,
    /// Whether goals are drawn.
    pub goals: bool,
    /// Whether title, time, counts, the key of the colours and a scale bar are drawn.
    pub legend: bool,
    /// Lines on the ground: the markings of a field, lanes. World coordinates.
    pub lines: Vec<Vec<DVec2>>,
    /// The colours of everything but the agents.
    pub theme: Theme,
    /// The face of titles, counts and keys.
    pub typeface: Typeface,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            width: 640,
            height: 480,
            view: None,
            projection: None,
            viewpoint: Viewpoint::default(),
            trails: 1.5,
            color_by: ColorBy::Group,
            groups: Vec::new(),
            forms: Vec::new(),
            shutter: 0.16,
            annotations: Annotations::default(),
            flow: None,
            headings: true,
            goals: true,
            legend: true,
            lines: Vec::new(),
            theme: Theme::light(),
            typeface: Typeface::default(),
        }
    }
}

/// What an agent looks like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Form {
    /// As its body is: from above a disc or an oblong, in perspective a ball, a block or, if it flies as a vehicle, a dart.
    #[default]
    Body,
    /// An insect: a thin body with two wings that beat. It leaves a [streak](Style::shutter) in place of a
    /// [trail](Style::trails).
    Insect,
    /// A shape of flat faces, such as a figure that walks, whatever its body is like.
    Shaped(Shape),
}

/// How the world is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// From straight above, true to scale.
    Plan,
    /// By an eye: what is far away is small and pale.
    Perspective,
}

/// What the colour of an agent says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ColorBy {
    /// Its group.
    #[default]
    Group,
    /// How fast it is, from standing to `max` m/s; `None`: to the greatest preferred speed of the first frame.
    Speed {
        /// The speed at the end of the ramp, greater than 0.
        max: Option<f32>,
    },
    /// How high above the ground it is, up to the greatest altitude of the first frame and of all goals.
    Altitude,
    /// How many there are within a metre and a half, over the area: up to 4 people a square metre.
    Density,
    /// How long it has still to go on a straight line at its preferred speed, up to the longest way of the first frame.
    TimeToGoal,
    /// Where it is going: a colour for each goal, or, where there are more than the palette holds, for the direction
    /// in which the goal lies from the middle of all goals.
    Goal,
}

/// The colours of the place and the type.
#[derive(Clone, Debug, PartialEq)]
pub struct Theme {
    /// Where nobody can walk.
    pub outside: Color,
    /// Where people walk.
    pub ground: Color,
    /// Obstacles.
    pub obstacle: Color,
    /// Edges of obstacles and of the ground, and thin walls.
    pub edge: Color,
    /// Goals.
    pub goal: Color,
    /// Type.
    pub text: Color,
    /// Type that steps back.
    pub quiet: Color,
    /// The notch that shows the heading.
    pub notch: Color,
}

impl Theme {
    /// Warm paper greys.
    pub const fn light() -> Self {
        Self {
            outside: Color::rgb(0xe6e4df),
            ground: Color::rgb(0xf6f5f1),
            obstacle: Color::rgb(0xcfccc4),
            edge: Color::rgb(0xa9a59b),
            goal: Color::rgb(0x7d8a99),
            text: Color::rgb(0x33383f),
            quiet: Color::rgb(0x737880),
            notch: Color::rgb(0xffffff),
        }
    }

    /// Blue-black, for a dark room.
    pub const fn dark() -> Self {
        Self {
            outside: Color::rgb(0x14171c),
            ground: Color::rgb(0x20252c),
            obstacle: Color::rgb(0x3a414b),
            edge: Color::rgb(0x5a6471),
            goal: Color::rgb(0x8d9aab),
            text: Color::rgb(0xe3e6ea),
            quiet: Color::rgb(0x98a1ac),
            notch: Color::rgb(0x14171c),
        }
    }
}
