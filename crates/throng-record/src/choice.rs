//! Selects the part of a recording that is written.

use crate::formats::{Column, Format, Writer};
use crate::people::FigureStyle;
use crate::resample::{Beat, Resampled, SLACK};
use crate::{Frame, Output, OutputError, Setting};
use std::ops::RangeInclusive;

/// The part of a recording that is written; by default, all of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// Time of the first frame, seconds.
    pub from: f64,
    /// Time of the last frame, seconds.
    pub to: f64,
    /// Frames per second, the first at [`from`](Self::from), or else at a multiple of the interval. Positions between
    /// steps are interpolated linearly. `None`: every step.
    pub rate: Option<f64>,
    /// The numbers of the agents that are written; empty: all agents.
    pub agents: Vec<RangeInclusive<u32>>,
    /// The names of the groups that are written; empty: all groups. The name of a group without a name is its index.
    pub groups: Vec<String>,
    /// The columns of a table, in this order; empty: those of the format.
    pub columns: Vec<Column>,
    /// How people are written to formats that have figures.
    pub figures: FigureStyle,
}

/// An error of a choice.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ChoiceError {
    /// There is no group of this name.
    #[error("there is no group `{name}`\n  hint: the groups are: {}", groups.join(", "))]
    Group {
        /// The name.
        name: String,
        /// The names of all groups.
        groups: Vec<String>,
    },
    /// A column is named twice.
    #[error("the column `{column}` is named twice\n  hint: name it once")]
    Twice {
        /// The column.
        column: Column,
    },
    /// The format has no columns to choose.
    #[error("the columns of .{ending} cannot be chosen\n  hint: only tables have columns to choose: {}", tables())]
    Columns {
        /// The ending of its names.
        ending: &'static str,
    },
    /// The format has no figures of this style.
    #[error("people in .{ending} cannot be written as `{style}`\n  hint: formats with `{style}`: {}", formats(*style))]
    Figures {
        /// The ending of its names.
        ending: &'static str,
        /// The style.
        style: FigureStyle,
    },
    /// The agents of the scene fly, and figures walk.
    #[error("the agents of this scene fly, and figures walk\n  hint: leave `--figures {style}` out")]
    Fly {
        /// The style.
        style: FigureStyle,
    },
}

impl Default for Choice {
    fn default() -> Self {
        Self {
            from: f64::NEG_INFINITY,
            to: f64::INFINITY,
            rate: None,
            agents: Vec::new(),
            groups: Vec::new(),
            columns: Vec::new(),
            figures: FigureStyle::Auto,
        }
    }
}

impl Choice {
    /// Checks that the chosen groups and columns exist.
    ///
    /// ```
    /// use throng_record::{Choice, Format, Setting};
    /// let setting = Setting { groups: vec!["left".into(), "right".into()], ..Setting::default() };
    /// let choice = Choice { groups: vec!["up".into()], ..Choice::default() };
    /// let csv = Format::of("run.csv").unwrap();
    /// assert!(choice.check(&setting, [csv]).unwrap_err().to_string().contains("left, right"));
    /// ```
    ///
    /// # Errors
    /// A group does not exist, a column occurs twice, one of the formats has no columns to choose or no figures of the
    /// chosen style, or agents fly that should be figures.
    pub fn check<'a>(&self, setting: &Setting, kinds: impl IntoIterator<Item = &'a Format>) -> Result<(), ChoiceError> {
        if let Some(name) = self.groups.iter().find(|name| !names(setting).any(|own| own == **name)) {
            return Err(ChoiceError::Group { name: name.clone(), groups: names(setting).collect() });
        }
        let twice = (1..self.columns.len()).find(|&k| self.columns[..k].contains(&self.columns[k]));
        if let Some(column) = twice.map(|k| self.columns[k]) {
            return Err(ChoiceError::Twice { column });
        }
        let style = self.figures;
        if matches!(style, FigureStyle::Skins | FigureStyle::Baked) && setting.in_space {
            return Err(ChoiceError::Fly { style });
        }
        let kinds: Vec<&Format> = kinds.into_iter().collect();
        if let Some(kind) = kinds.iter().find(|kind| !self.columns.is_empty() && !kind.has_columns()) {
            return Err(ChoiceError::Columns { ending: kind.ending });
        }
        // a format without figures may be written beside one that has them
        let lacks = |kind: &Format| style != FigureStyle::Auto && !kind.figure_styles().contains(&style);
        let odd = kinds.iter().find(|kind| lacks(kind) && !kind.figure_styles().is_empty());
        let none = kinds.first().filter(|_| kinds.iter().all(|kind| lacks(kind)));
        if let Some(kind) = odd.or(none) {
            return Err(ChoiceError::Figures { ending: kind.ending, style });
        }
        Ok(())
    }

    /// Parses agent numbers as users write them: a number, or the first and the last of a range.
    ///
    /// ```
    /// use throng_record::Choice;
    /// assert_eq!((Choice::numbers("7"), Choice::numbers("10-20")), (Ok(7..=7), Ok(10..=20)));
    /// assert!(Choice::numbers("20-10").is_err());
    /// ```
    ///
    /// # Errors
    /// The text is neither; the error says what to write.
    pub fn numbers(text: &str) -> Result<RangeInclusive<u32>, String> {
        let (first, last) = text.split_once('-').unwrap_or((text, text));
        let range = first.trim().parse().ok().zip(last.trim().parse().ok()).map(|(first, last)| first..=last);
        range.filter(|range| !range.is_empty()).ok_or_else(|| "write numbers and ranges, such as 1,5,10-20".into())
    }

    /// Starts a file that receives only the chosen part; `None` if the format cannot be [written](Format::is_written).
    /// Interpolated frames are skipped as soon as `stop` returns true.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub fn create(
        &self,
        format: &Format,
        output: Output,
        setting: &Setting,
        stop: fn() -> bool,
    ) -> Option<Result<Box<dyn Writer>, OutputError>> {
        let writer = match format.create(output, setting, self)? {
            Ok(writer) => self.members(writer, setting),
            Err(error) => return Some(Err(error)),
        };
        Some(Ok(match self.beat() {
            Some(beat) => Box::new(Resampled::new(writer, beat, stop)),
            None => writer,
        }))
    }

    /// Whether the frame at `time` is needed, where `before` and `after` are the times of its neighbours, seconds.
    pub fn needs(&self, before: f64, time: f64, after: f64) -> bool {
        match self.beat() {
            Some(beat) => beat.needs(before, after),
            None => time > self.from - SLACK && time < self.to + SLACK,
        }
    }

    fn beat(&self) -> Option<Beat> {
        self.rate.map(|rate| Beat { from: self.from, to: self.to, rate })
    }

    /// Returns a writer that writes only the chosen agents.
    fn members(&self, writer: Box<dyn Writer>, setting: &Setting) -> Box<dyn Writer> {
        if self.agents.is_empty() && self.groups.is_empty() {
            return writer;
        }
        let groups = names(setting).map(|name| self.groups.is_empty() || self.groups.contains(&name)).collect();
        Box::new(Members { writer, agents: self.agents.clone(), groups, frame: Frame::default() })
    }
}

/// Writes some of the agents.
struct Members {
    writer: Box<dyn Writer>,
    agents: Vec<RangeInclusive<u32>>,
    /// Whether a group is chosen, by index.
    groups: Vec<bool>,
    /// The chosen agents of the frame.
    frame: Frame,
}

impl Writer for Members {
    fn push(&mut self, frame: &Frame) -> Result<(), OutputError> {
        let Self { agents, groups, .. } = self;
        self.frame.time = frame.time;
        self.frame.bodies.clear();
        self.frame.bodies.extend(frame.bodies.iter().filter(|body| {
            groups.get(body.group as usize).is_none_or(|&chosen| chosen)
                && (agents.is_empty() || agents.iter().any(|range| range.contains(&body.number)))
        }));
        self.writer.push(&self.frame)
    }

    fn finish(self: Box<Self>) -> Result<(), OutputError> {
        self.writer.finish()
    }
}

/// Returns the names of the groups.
fn names(setting: &Setting) -> impl Iterator<Item = String> + '_ {
    (0..setting.groups.len() as u32).map(|group| setting.group_name(group).into_owned())
}

/// Returns the endings of table formats.
fn tables() -> String {
    let tables = crate::formats::FORMATS.iter().filter(|format| format.has_columns());
    tables.map(|format| format!(".{}", format.ending)).collect::<Vec<_>>().join(", ")
}

/// Returns the endings of the formats that have a style of figures.
fn formats(style: FigureStyle) -> String {
    let formats = crate::formats::FORMATS.iter().filter(|format| format.figure_styles().contains(&style));
    formats.map(|format| format!(".{}", format.ending)).collect::<Vec<_>>().join(", ")
}

#[cfg(all(test, feature = "bvh", feature = "glb"))]
mod tests {
    use super::*;

    #[test]
    fn a_style_needs_a_format_that_has_it() {
        let check = |style, names: &[&str], in_space| {
            let choice = Choice { figures: style, ..Choice::default() };
            let kinds = names.iter().map(|name| Format::of(name).unwrap());
            choice.check(&Setting { in_space, ..Setting::default() }, kinds).map_err(|error| error.to_string())
        };
        assert_eq!(check(FigureStyle::Baked, &["a.csv", "a.glb"], false), Ok(()));
        assert_eq!(check(FigureStyle::Auto, &["a.csv"], true), Ok(()));
        assert_eq!(check(FigureStyle::Baked, &[], false), Ok(()));
        let error = check(FigureStyle::Baked, &["a.glb", "a-*.bvh"], false).unwrap_err();
        assert_eq!(error, "people in .bvh cannot be written as `baked`\n  hint: formats with `baked`: .glb");
        assert!(check(FigureStyle::Skins, &["a.csv"], false).unwrap_err().starts_with("people in .csv cannot"));
        assert!(check(FigureStyle::Skins, &["a.glb"], true).unwrap_err().contains("leave `--figures skins` out"));
    }
}
