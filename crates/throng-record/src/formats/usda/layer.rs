//! Parses the text of a layer into prims and the texts of their attributes.
//!
//! The parser covers the part of the [grammar](https://openusd.org/release/spec_usda.html) that determines where
//! elements begin and end. Values stay as they are written.

use super::cursor::{Cursor, TextPart, UsdaFlaw};

/// Greatest depth of nested prims.
const DEEPEST: usize = 64;

/// A prim.
#[derive(Debug, Default)]
pub struct Prim<'a> {
    /// The name; empty for the layer.
    pub name: &'a str,
    /// The type; empty if there is none.
    pub kind: &'a str,
    pub attributes: Vec<Attribute<'a>>,
    pub children: Vec<Prim<'a>>,
}

/// An attribute of a prim, or metadata of the layer.
#[derive(Debug)]
pub struct Attribute<'a> {
    /// The name, without its type.
    pub name: &'a str,
    pub value: Option<TextPart<'a>>,
    /// Values at time codes, in order.
    pub samples: Vec<(f64, TextPart<'a>)>,
}

impl<'a> Prim<'a> {
    /// Returns the attribute of a name.
    pub fn attribute(&self, name: &str) -> Option<&Attribute<'a>> {
        // an attribute with samples may also have a declaration, which comes first
        self.attributes.iter().rfind(|attribute| attribute.name == name)
    }

    /// Returns the constant value of an attribute.
    pub fn value(&self, name: &str) -> Option<TextPart<'a>> {
        self.attribute(name)?.value
    }
}

impl<'a> Attribute<'a> {
    /// Returns the value at a time code: that of the sample before it.
    pub fn at(&self, code: f64) -> Option<TextPart<'a>> {
        let behind = self.samples.partition_point(|&(at, _)| at <= code);
        let sample = self.samples.get(behind.saturating_sub(1)).map(|&(_, part)| part);
        sample.or(self.value)
    }
}

/// Parses a layer. Returns a prim: its attributes are the metadata of the layer, its children the prims of the layer.
///
/// # Errors
/// The text is not a layer, or is cut off.
pub fn parse(text: &str) -> Result<Prim<'_>, UsdaFlaw> {
    if !text.starts_with("#usda 1.") {
        return Err((0, "the file does not begin with #usda 1.0".to_owned()));
    }
    let mut cursor = Cursor { text, at: 0 };
    let mut layer = Prim::default();
    cursor.blanks();
    if cursor.takes(b'(') {
        layer.attributes = cursor.statements(b')')?;
    }
    loop {
        cursor.blanks();
        if cursor.peek().is_none() {
            return Ok(layer);
        }
        match cursor.word() {
            "def" | "over" | "class" => layer.children.push(cursor.prim(1)?),
            "reorder" => cursor.skip()?,
            _ => return Err(cursor.wrong("a prim is missing: def, over or class")),
        }
    }
}

impl<'a> Cursor<'a> {
    /// Parses the text after `def`.
    fn prim(&mut self, depth: usize) -> Result<Prim<'a>, UsdaFlaw> {
        if depth > DEEPEST {
            return Err(self.wrong("prims are nested too deeply"));
        }
        self.blanks();
        let kind = self.word();
        self.blanks();
        if !matches!(self.peek(), Some(b'"' | b'\'')) {
            return Err(self.wrong("the name of a prim is missing"));
        }
        let from = self.at + 1;
        self.string()?;
        let name = self.text.get(from..self.at - 1).unwrap_or_default();
        self.blanks();
        if self.peek() == Some(b'(') {
            self.nested()?;
        }
        self.expect(b'{')?;
        let mut prim = Prim { name, kind, ..Prim::default() };
        loop {
            self.blanks();
            if self.takes(b'}') {
                return Ok(prim);
            }
            let from = self.at;
            match self.word() {
                "def" | "over" | "class" => prim.children.push(self.prim(depth + 1)?),
                "variantSet" => self.skip()?,
                "" => return Err(self.wrong("the name of an attribute is missing")),
                _ => {
                    self.at = from;
                    prim.attributes.push(self.statement()?);
                }
            }
        }
    }

    /// Parses statements up to a closing bracket, with plain texts between them.
    fn statements(&mut self, end: u8) -> Result<Vec<Attribute<'a>>, UsdaFlaw> {
        let mut statements = Vec::new();
        loop {
            self.blanks();
            if self.takes(end) {
                return Ok(statements);
            }
            match self.peek() {
                Some(b'"' | b'\'') => self.string()?,
                _ => statements.push(self.statement()?),
            }
        }
    }

    /// Parses words, the last of which is a name, then an optional value and optional metadata.
    fn statement(&mut self) -> Result<Attribute<'a>, UsdaFlaw> {
        let mut name = "";
        loop {
            self.spaces();
            let word = self.word();
            if word.is_empty() {
                break;
            }
            name = word;
        }
        if name.is_empty() {
            return Err(self.wrong("a name is missing"));
        }
        let (mut value, mut samples) = (None, Vec::new());
        let plain = name.strip_suffix(".timeSamples");
        if self.takes(b'=') {
            self.blanks();
            match plain {
                Some(_) => samples = self.samples()?,
                None => value = Some(self.value()?),
            }
        }
        self.spaces();
        if self.peek() == Some(b'(') {
            self.nested()?;
        }
        Ok(Attribute { name: plain.unwrap_or(name), value, samples })
    }

    /// Parses values at time codes.
    fn samples(&mut self) -> Result<Vec<(f64, TextPart<'a>)>, UsdaFlaw> {
        self.expect(b'{')?;
        let mut samples: Vec<(f64, TextPart)> = Vec::new();
        loop {
            self.blanks();
            if self.takes(b'}') {
                return Ok(samples);
            }
            let from = self.at;
            let code = self.word().trim_end_matches(':').parse().ok().filter(|code: &f64| code.is_finite());
            let grows = |code: &f64| samples.last().is_none_or(|(last, _)| last < code);
            let code = code.filter(grows).ok_or_else(|| {
                Cursor { at: from, ..*self }.wrong("a time code is missing, or not later than the one before")
            })?;
            self.blanks();
            self.takes(b':');
            self.blanks();
            samples.push((code, self.value()?));
            self.blanks();
            self.takes(b',');
        }
    }

    /// Skips a statement of another kind: up to its `=`, and its value.
    fn skip(&mut self) -> Result<(), UsdaFlaw> {
        loop {
            self.blanks();
            match self.peek() {
                Some(b'=') => break,
                Some(b'"' | b'\'') => self.string()?,
                _ if self.word().is_empty() => return Err(self.wrong("`=` is missing")),
                _ => {}
            }
        }
        self.at += 1;
        self.blanks();
        self.value().map(|_| ())
    }
}
