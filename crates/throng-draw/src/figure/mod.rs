//! The figure that explains why an agent chooses its velocity, like the figures in papers on velocity obstacles.
//!
//! Left the agent and what is near it, to scale; right its velocity space: the velocities that each neighbour and each
//! wall forbids, those that remain, and the agent's current, preferred and resulting velocity. See van den Berg, Guy,
//! Lin, Manocha, Reciprocal n-body collision avoidance, ISRR 2009, figures 2 and 4.

mod arrow;
mod labels;
mod near;
mod region;
mod sheet;
mod tint;
mod velocities;
mod words;

pub(crate) use arrow::arrow;
pub(crate) use region::{clip, forbidden};

use crate::picture::Picture;
use crate::primitive::Primitive;
use crate::sink::Kind;
use crate::text::{Type, Typeface};
use crate::{Color, Error, Image, Style, raster, svg};
use sheet::FigureLayout;
use std::path::Path;
use throng::Explanation;
use throng_record::{Frame, Output, Setting};

/// The size of letters in a figure of 1200 by 760 pixels, pixels.
const LETTERS: f32 = 14.0;

/// A finished figure.
///
/// ```
/// use throng::{Agent, Settings, World};
/// use throng_draw::{Figure, Style};
/// use throng_record::{Frame, Setting};
/// let mut world = World::new(Settings::default())?;
/// let id = world.add_agent(Agent::default())?;
/// let why = world.explain(id).expect("the agent is in the world");
/// let figure = Figure::explain(&Setting::of(&world, "Alone"), &Frame::of(&world), &why, &Style::default())?;
/// assert!(figure.svg().contains("Alone"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Figure {
    size: (u32, u32),
    base: Color,
    typeface: Typeface,
    marks: Vec<Primitive>,
}

impl Figure {
    /// Creates a picture of primitives on a ground of one colour, in the default typeface.
    ///
    /// # Errors
    /// [`Error::Size`] if width or height is out of the limits of pictures.
    pub fn of((width, height): (u32, u32), base: Color, marks: Vec<Primitive>) -> Result<Self, Error> {
        Error::check_size(width, height)?;
        Ok(Self { size: (width, height), base, typeface: Typeface::default(), marks })
    }

    /// Draws an explanation: `frame` is the world at its time, `setting` the place. Of the style, only size, theme and
    /// typeface matter. A figure of 1200 by 760 pixels has room for everything.
    ///
    /// # Errors
    /// [`Error::Size`] if the style's width or height is out of its limits.
    pub fn explain(setting: &Setting, frame: &Frame, why: &Explanation, style: &Style) -> Result<Self, Error> {
        let unit = (style.width as f32 / 1200.0).min(style.height as f32 / 760.0).max(0.05);
        Self::explain_at(setting, frame, why, style, unit)
    }

    /// As [`explain`](Self::explain), with letters of a given size, pixels: what they leave of the picture is the room
    /// of the drawings. Where that is little, the key is left out, and in a narrow figure the surroundings.
    ///
    /// # Errors
    /// As [`explain`](Self::explain).
    pub fn explain_in_letters(
        setting: &Setting,
        frame: &Frame,
        why: &Explanation,
        style: &Style,
        letters: f32,
    ) -> Result<Self, Error> {
        Self::explain_at(setting, frame, why, style, letters / LETTERS)
    }

    /// Draws an explanation at a scale: 1 for letters of [`LETTERS`] pixels.
    fn explain_at(
        setting: &Setting,
        frame: &Frame,
        why: &Explanation,
        style: &Style,
        unit: f32,
    ) -> Result<Self, Error> {
        Error::check_size(style.width, style.height)?;
        let key = velocities::key(why);
        let sheet = FigureLayout::new(style, unit, words::caption(why), key);
        let [near, scale] = match sheet.near.is_empty() {
            true => Default::default(),
            false => near::marks(setting, frame, why, &sheet),
        };
        let [plot, numbers] = velocities::marks(why, &sheet);
        let mut marks = vec![sheet.near.clip(near), sheet.plot.clip(plot)];
        marks.extend([scale, numbers].concat());
        marks.extend(sheet.frame(words::title(setting, why)));
        let typeface = style.typeface.clone();
        Ok(Self { size: (style.width, style.height), base: style.theme.ground, typeface, marks })
    }

    /// Returns the figure as pixels.
    pub fn image(&self) -> Image {
        let mut image = Image::new(self.size.0, self.size.1, self.base);
        raster::draw(&mut image, &mut Type::of(&self.typeface), &self.marks);
        image
    }

    /// Returns the figure as an SVG document.
    pub fn svg(&self) -> String {
        svg::picture(self.size, self.base, &self.marks)
    }

    /// Writes the figure, a `.png` or `.svg` by the ending of the name.
    ///
    /// # Errors
    /// [`Error::Still`] if the name has another ending; or the file cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let path = path.as_ref();
        let picture = match Kind::of(path) {
            Ok(Kind::Png) => Picture::Pixels(self.image()),
            Ok(Kind::Svg) => Picture::Vector(self.svg()),
            _ => return Err(Error::Still { path: path.to_path_buf() }),
        };
        picture.write(Output::create(path)?)
    }
}
