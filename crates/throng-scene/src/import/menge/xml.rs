//! Elements and attributes, with errors that have their position.

use crate::error::{Error, Kind};
use crate::import::short;
use crate::scene::{Normal, Number};
use roxmltree::{Document, Node, ParsingOptions};

/// The maximum number of elements and texts of a file.
const MOST: u32 = 1_000_000;

/// The text of a file, and its elements.
pub(super) struct Xml<'t> {
    text: &'t str,
    pub document: Document<'t>,
}

impl<'t> Xml<'t> {
    /// # Errors
    /// The text is not XML.
    pub fn parse(text: &'t str) -> Result<Self, Error> {
        let options = ParsingOptions { nodes_limit: MOST, ..ParsingOptions::default() };
        let document =
            Document::parse_with_options(text, options).map_err(|error| super::super::no_xml(text, &error))?;
        Ok(Self { text, document })
    }

    /// Returns the number of an optional attribute.
    ///
    /// # Errors
    /// It is not a finite number.
    pub fn number(&self, node: Node, name: &str) -> Result<Option<f64>, Error> {
        let Some(said) = node.attribute(name) else { return Ok(None) };
        // Menge reads `.3` and `3.`, as Rust does
        let number = said.trim().parse().ok().filter(|number: &f64| number.is_finite());
        number.map(Some).ok_or_else(|| {
            let shown = short(said);
            self.wrong(node, Kind::WrongType, format!("`{name}` is `{shown}`, which is no number"))
        })
    }

    /// Returns the number of a required attribute.
    ///
    /// # Errors
    /// It is missing, or not a finite number.
    pub fn needed(&self, node: Node, name: &str) -> Result<f64, Error> {
        self.number(node, name)?.ok_or_else(|| self.missing(node, name))
    }

    /// Returns the text of a required attribute.
    ///
    /// # Errors
    /// It is missing.
    pub fn text<'n>(&self, node: Node<'n, '_>, name: &str) -> Result<&'n str, Error> {
        node.attribute(name).ok_or_else(|| self.missing(node, name))
    }

    /// Returns the distribution that `dist` and its numbers describe.
    ///
    /// # Errors
    /// Menge has no such distribution, or a number is missing or wrong.
    pub fn distribution(&self, node: Node) -> Result<Number, Error> {
        match self.text(node, "dist")? {
            "c" => Ok(Number::Constant(self.needed(node, "value")?)),
            "u" => {
                let (a, b) = (self.needed(node, "min")?, self.needed(node, "max")?);
                Ok(Number::Uniform([a.min(b), a.max(b)]))
            }
            "n" => {
                let bound = |name: &str| self.number(node, name);
                let (mean, deviation) = (self.needed(node, "mean")?, self.needed(node, "stddev")?.abs());
                if deviation == 0.0 {
                    return Ok(Number::Constant(mean));
                }
                Ok(Number::Normal(Normal { mean, deviation, min: bound("min")?, max: bound("max")? }))
            }
            other => {
                let shown = short(other);
                let error = self.wrong(node, Kind::UnknownKey, format!("there is no distribution `{shown}`"));
                Err(error.hint("it is c (value), u (min, max) or n (mean, stddev)"))
            }
        }
    }

    fn missing(&self, node: Node, name: &str) -> Error {
        self.wrong(node, Kind::MissingKey, format!("<{}> has no `{name}`", node.tag_name().name()))
    }

    /// Returns an error about an element.
    pub fn wrong(&self, node: Node, kind: Kind, message: impl Into<String>) -> Error {
        let start = node.range().start;
        Error::new(kind, message).place(self.text, start..start + node.tag_name().name().len() + 1)
    }
}

/// Returns the child elements with a name.
pub(super) fn children<'n, 't>(node: Node<'n, 't>, name: &'static str) -> impl Iterator<Item = Node<'n, 't>> {
    node.children().filter(move |child| child.is_element() && child.tag_name().name() == name)
}
