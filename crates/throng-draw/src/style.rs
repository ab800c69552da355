//! The style of pictures.

use crate::color::{PALETTE, PALETTE_ON_DARK};
use crate::{Annotations, Color, FlowStyle, MotionBlur, Shape, Sun, Typeface, Viewpoint, WorldBox};
use glam::{DVec2, DVec3};

/// The style of pictures. The default is a light picture of 640 by 480 pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    /// The width of the picture, pixels, 16 to 16384.
    pub width: u32,
    /// The height of the picture, pixels, 16 to 16384.
    pub height: u32,
    /// The part of the world to show; `None` for everything in the setting and the first frame. In perspective, the
    /// part of the ground that a viewpoint without position shows.
    pub view: Option<WorldBox>,
    /// The projection; `None` for perspective if agents fly, and for plan view otherwise.
    pub projection: Option<Projection>,
    /// The viewpoint in perspective.
    pub viewpoint: Viewpoint,
    /// The length of trails, seconds; 0 for none.
    pub trails: f32,
    /// The quantity that colours of agents show.
    pub color_by: ColorBy,
    /// The colours of groups, by index; the palette applies to groups without one.
    pub groups: Vec<Option<Color>>,
    /// The forms of agents, by group; [`AgentShape::Body`] applies to groups without one.
    pub forms: Vec<AgentShape>,
    /// The exposure time of pictures of insects, seconds. The streak of an insect is its way in this time; 0 for no
    /// streaks.
    pub shutter: f32,
    /// The motion blur of films; `None` for sharp pictures.
    pub blur: Option<MotionBlur>,
    /// The annotations of agents.
    pub annotations: Annotations,
    /// The style of the fields that lead groups, in plan view; `None` hides them.
    pub flow: Option<FlowStyle>,
    /// Whether agents have a notch that marks their heading.
    pub headings: bool,
    /// Whether goals are drawn.
    pub goals: bool,
    /// Whether agents on the ground of the size of people are drawn as people, in perspective.
    pub people: bool,
    /// The sun, in perspective.
    pub sun: Sun,
    /// The distance at which haze has taken 63 % of the colour of things, in perspective, metres; `None` for 4.5 times the
    /// distance of the farthest things.
    pub haze: Option<f64>,
    /// The positions of lamps that shine, in perspective. Their light is drawn for a dark theme.
    pub lamps: Vec<DVec3>,
    /// Whether title, time, counts, the key of colours and a scale bar are drawn.
    pub legend: bool,
    /// Lines on the ground, in world coordinates, such as the markings of a field.
    pub lines: Vec<Vec<DVec2>>,
    /// The colours of everything except agents.
    pub theme: Theme,
    /// The typeface of titles, counts and keys.
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
            blur: None,
            annotations: Annotations::default(),
            flow: None,
            headings: true,
            goals: true,
            people: true,
            sun: Sun::default(),
            haze: None,
            lamps: Vec::new(),
            legend: true,
            lines: Vec::new(),
            theme: Theme::light(),
            typeface: Typeface::default(),
        }
    }
}

/// The form of an agent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum AgentShape {
    /// By its body: in plan view a disc or an oblong; in perspective a ball, a block or, if it flies as a vehicle, a
    /// dart.
    #[default]
    Body,
    /// A ball: round, without a mark of its heading.
    Ball,
    /// An insect: a thin body with two beating wings. It leaves a [streak](Style::shutter) instead of a
    /// [trail](Style::trails).
    Insect,
    /// A shape of flat faces, such as a walking figure, for any body.
    Shaped(Shape),
}

/// The projections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// Plan view: from straight above, true to scale.
    Plan,
    /// From a viewpoint: distant objects are small and pale.
    Perspective,
}

/// The quantities that colours of agents show.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ColorBy {
    /// Its group.
    #[default]
    Group,
    /// Its speed, from 0 to `max` m/s; `None` for the greatest preferred speed of the first frame.
    Speed {
        /// The speed at the end of the ramp, greater than 0.
        max: Option<f32>,
    },
    /// Its altitude, up to the greatest altitude of the first frame and of all goals.
    Altitude,
    /// The density within 1.5 m, up to 4 people per square metre.
    Density,
    /// The time to its goal on a straight line at its preferred speed, up to the longest of the first frame.
    TimeToGoal,
    /// Its goal: a colour for each goal. If there are more goals than the palette has colours, the direction of the
    /// goal from the middle of all goals.
    Goal,
}

/// The colours of the place and of the type.
#[derive(Clone, Debug, PartialEq)]
pub struct Theme {
    /// Ground that is not walkable.
    pub outside: Color,
    /// Walkable ground.
    pub ground: Color,
    /// Obstacles.
    pub obstacle: Color,
    /// Edges of obstacles and of the ground, and thin walls.
    pub edge: Color,
    /// Goals.
    pub goal: Color,
    /// Type.
    pub text: Color,
    /// Secondary type.
    pub quiet: Color,
    /// The notch that marks the heading.
    pub notch: Color,
    /// The colours of groups and goals without their own, in order.
    pub palette: [Color; 8],
}

impl Theme {
    /// Returns a theme of warm greys.
    pub const fn light() -> Self {
        Self {
            outside: Color::rgb(0xe6e4df),
            ground: Color::rgb(0xf6f5f1),
            obstacle: Color::rgb(0xcfccc4),
            edge: Color::rgb(0x827e75),
            goal: Color::rgb(0x5c6877),
            text: Color::rgb(0x33383f),
            quiet: Color::rgb(0x5f646c),
            notch: Color::rgb(0xffffff),
            palette: PALETTE,
        }
    }

    /// Returns the colour of the group or goal `index`: the palette, repeated in three paler rounds.
    pub fn group(&self, index: usize) -> Color {
        let pale = 0.25 * (index / self.palette.len()).min(3) as f32;
        self.palette[index % self.palette.len()].mix(Color::rgb(0xff_ffff), pale)
    }

    /// Returns this colour, mixed with that of the type as little as a contrast of 3 with the ground, and with the ground
    /// outside, needs: WCAG's least contrast of marks.
    pub fn ink(&self, color: Color) -> Color {
        color.legible(&[self.ground, self.outside], self.text, Self::MARKS)
    }

    /// The least contrast of marks and of type with the ground (WCAG 2.2, 1.4.11 and 1.4.3).
    pub(crate) const MARKS: f64 = 3.0;

    /// Whether the ground is darker than the type on it.
    pub fn is_dark(&self) -> bool {
        let light = |color: Color| u32::from(color.r) + u32::from(color.g) + u32::from(color.b);
        light(self.ground) < light(self.text)
    }

    /// Returns a theme of dark blues.
    pub const fn dark() -> Self {
        Self {
            outside: Color::rgb(0x14171c),
            ground: Color::rgb(0x20252c),
            obstacle: Color::rgb(0x3a414b),
            edge: Color::rgb(0x6d7885),
            goal: Color::rgb(0x8d9aab),
            text: Color::rgb(0xe3e6ea),
            quiet: Color::rgb(0x98a1ac),
            notch: Color::rgb(0x14171c),
            palette: PALETTE_ON_DARK,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Look;
    use crate::color::{ramp, wheel};
    use crate::ribbon::Ribbon;
    use throng::Status;
    use throng_record::{Frame, Setting};

    /// WCAG's least contrast of type.
    const TYPE: f64 = 4.5;

    #[test]
    fn everything_with_a_meaning_has_the_contrast_of_wcag_on_both_grounds() {
        for theme in [Theme::light(), Theme::dark()] {
            let mut low = Vec::new();
            let mut check = |what: &str, color: Color, least: f64| {
                for ground in [theme.ground, theme.outside] {
                    let contrast = color.over(ground).contrast(ground);
                    if contrast < least {
                        low.push(format!("{what}, {}: {contrast:.2}", color.hex()));
                    }
                }
            };
            check("type", theme.text, TYPE);
            check("secondary type", theme.quiet, TYPE);
            check("walls, and edges of obstacles and of the ground", theme.edge, Theme::MARKS);
            check("goals", theme.goal, Theme::MARKS);
            check("outlines of goal areas", theme.goal.alpha(crate::place::GOAL), Theme::MARKS);
            check("paths", Ribbon::stroke(&theme, 1.0).color, Theme::MARKS);
            let style = Style { theme: theme.clone(), ..Style::default() };
            let look = Look::new(&Setting::default(), &style, &Frame::default());
            let groups = (0..32).map(|index| theme.group(index));
            let others = (0..=20).flat_map(|k| [ramp(k as f32 / 20.0), wheel(k as f32 / 20.0)]);
            for color in groups.chain(others) {
                // The outline of an agent bounds it; agents that have arrived are pale, because nothing depends on them.
                check("agents", look.coat_of(color, Status::Walking).rim, Theme::MARKS);
                check("agents that cannot reach their goals", look.coat_of(color, Status::Stranded).rim, Theme::MARKS);
                check("trails where they are new", theme.ink(color), Theme::MARKS);
                check("lines of fields", crate::flow::line(color, &theme), Theme::MARKS);
            }
            check("lines of a single field", crate::flow::line(crate::flow::alone(&theme), &theme), Theme::MARKS);
            for kind in crate::Annotation::ALL {
                check(kind.name(), kind.color(&theme), Theme::MARKS);
            }
            check("points that trap agents", crate::flow::warning(&theme), Theme::MARKS);
            assert!(low.is_empty(), "{low:#?}");
        }
    }

    #[test]
    fn the_colours_of_groups_are_visible_inside_as_well_on_dark_ground() {
        let theme = Theme::dark();
        for color in theme.palette {
            assert!(color.contrast(theme.ground) >= Theme::MARKS, "{}", color.hex());
        }
    }
}
