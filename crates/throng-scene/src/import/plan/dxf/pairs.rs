//! A DXF text as pairs of a group code and a value, in sections and entities.

use crate::error::{Error, Kind};
use crate::geometry::DVec2;
use crate::import::short;
use std::collections::BTreeMap;
use std::ops::Range;

/// A group code and its value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<'t> {
    pub code: i32,
    pub value: &'t str,
    /// The line of the value, from 1.
    pub line: usize,
}

/// An entity: the pairs from a pair of code 0 to before the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entity<'p, 't> {
    pub kind: &'t str,
    pub pairs: &'p [Pair<'t>],
    pub line: usize,
}

/// All pairs of a file, and the ranges of its sections.
#[derive(Debug)]
pub(super) struct Pairs<'t> {
    pairs: Vec<Pair<'t>>,
    sections: BTreeMap<&'t str, Range<usize>>,
}

impl<'t> Pairs<'t> {
    pub fn read(text: &'t str) -> Result<Self, Error> {
        let mut pairs = vec![];
        let mut lines = text.lines().enumerate();
        while let Some((i, code)) = lines.next() {
            let code = code.trim();
            if code.is_empty() && lines.clone().all(|(_, line)| line.trim().is_empty()) {
                break;
            }
            let number = code.parse().map_err(|_| {
                let shown: String = code.chars().take(20).collect();
                let mut error = Error::new(Kind::Syntax, format!("a group code should be here, not `{shown}`"));
                error.at = Some((i + 1, 1));
                error.hint("a DXF text has lines in pairs: a whole number, then a value")
            })?;
            let (line, value) = lines.next().unwrap_or((i + 1, ""));
            pairs.push(Pair { code: number, value: value.trim(), line: line + 1 });
        }
        let mut sections = BTreeMap::new();
        let mut open: Option<(&str, usize)> = None;
        for (i, pair) in pairs.iter().enumerate().filter(|(_, pair)| pair.code == 0) {
            match pair.value {
                "SECTION" => {
                    let name = pairs.get(i + 1).filter(|name| name.code == 2);
                    open = name.map(|name| (name.value, i + 2));
                }
                "ENDSEC" => {
                    if let Some((name, from)) = open.take() {
                        sections.entry(name).or_insert(from..i);
                    }
                }
                _ => {}
            }
        }
        if !sections.contains_key("ENTITIES") {
            let message = "this is not a whole DXF drawing: it has no section ENTITIES that ends";
            return Err(Error::new(Kind::Syntax, message).hint("export the plan as ASCII DXF again"));
        }
        Ok(Self { pairs, sections })
    }

    /// Returns the value of a variable of the header.
    pub fn header(&self, name: &str) -> Option<Pair<'t>> {
        let header = self.section("HEADER");
        let at = header.iter().position(|pair| pair.code == 9 && pair.value == name)?;
        header.get(at + 1).copied()
    }

    /// Returns the entities of a section, in order.
    pub fn entities(&self, section: &str) -> Vec<Entity<'_, 't>> {
        let pairs = self.section(section);
        let starts: Vec<usize> = (0..pairs.len()).filter(|i| pairs[*i].code == 0).collect();
        let ends = starts.iter().skip(1).copied().chain([pairs.len()]);
        let entity = |(from, to): (&usize, usize)| Entity {
            kind: pairs[*from].value,
            pairs: &pairs[from + 1..to],
            line: pairs[*from].line,
        };
        starts.iter().zip(ends).map(entity).collect()
    }

    fn section(&self, name: &str) -> &[Pair<'t>] {
        self.sections.get(name).map_or(&[], |range| &self.pairs[range.clone()])
    }
}

impl<'t> Entity<'_, 't> {
    /// Returns the first value with a code.
    pub fn text(&self, code: i32) -> Option<&'t str> {
        self.pairs.iter().find(|pair| pair.code == code).map(|pair| pair.value)
    }

    /// Returns the first number with a code, or else `otherwise`.
    ///
    /// # Errors
    /// It is not a finite number.
    pub fn number(&self, code: i32, otherwise: f64) -> Result<f64, Error> {
        self.pairs.iter().find(|pair| pair.code == code).map_or(Ok(otherwise), Pair::number)
    }

    /// Returns the point with the x coordinate of this code. The code of y is greater by ten.
    ///
    /// # Errors
    /// A coordinate is not a finite number.
    pub fn point(&self, code: i32) -> Result<DVec2, Error> {
        Ok(DVec2::new(self.number(code, 0.0)?, self.number(code + 10, 0.0)?))
    }

    /// Returns all numbers with a code.
    ///
    /// # Errors
    /// A number is not finite.
    pub fn numbers(&self, code: i32) -> Result<Vec<f64>, Error> {
        self.pairs.iter().filter(|pair| pair.code == code).map(Pair::number).collect()
    }

    /// Returns all points with the x coordinate of this code.
    ///
    /// # Errors
    /// A coordinate is not a finite number.
    pub fn points(&self, code: i32) -> Result<Vec<DVec2>, Error> {
        let mut points: Vec<DVec2> = vec![];
        for pair in self.pairs {
            match points.last_mut() {
                _ if pair.code == code => points.push(DVec2::new(pair.number()?, 0.0)),
                Some(at) if pair.code == code + 10 => at.y = pair.number()?,
                _ => {}
            }
        }
        Ok(points)
    }

    /// Returns the corners of a light polyline, each with the bulge of the line after it.
    ///
    /// # Errors
    /// A number is not finite.
    pub fn corners(&self) -> Result<Vec<(DVec2, f64)>, Error> {
        let mut corners: Vec<(DVec2, f64)> = vec![];
        for pair in self.pairs {
            match (pair.code, corners.last_mut()) {
                (10, _) => corners.push((DVec2::new(pair.number()?, 0.0), 0.0)),
                (20, Some((at, _))) => at.y = pair.number()?,
                (42, Some((_, bulge))) => *bulge = pair.number()?,
                _ => {}
            }
        }
        Ok(corners)
    }

    /// Returns the flags with a code; 0 if there are none.
    pub fn flags(&self, code: i32) -> i64 {
        self.text(code).and_then(|text| text.parse().ok()).unwrap_or_default()
    }
}

impl Pair<'_> {
    /// Returns the value as a number.
    ///
    /// # Errors
    /// It is not a finite number.
    pub fn number(&self) -> Result<f64, Error> {
        self.value.parse().ok().filter(|number: &f64| number.is_finite()).ok_or_else(|| {
            let shown = short(self.value);
            let mut error = Error::new(Kind::Syntax, format!("`{shown}` is no number (group code {})", self.code));
            error.at = Some((self.line, 1));
            error
        })
    }
}
