//! The tree of elements: layers, transforms, what is shown.

use super::super::curve::TOLERANCE;
use super::super::drawing::Drawing;
use super::super::layer::role;
use super::{Place, outline};
use crate::error::{Error, Kind};
use crate::geometry::DVec2;
use crate::import::short;
use glam::{DAffine2, DMat2};
use roxmltree::{Document, Node};
use std::collections::BTreeMap;
use std::str::FromStr;

/// The name space of Inkscape's labels.
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
const XLINK: &str = "http://www.w3.org/1999/xlink";

/// Copies may stand in copies this deep.
const DEEPEST: usize = 8;
/// The most names of what an element is in that are looked at.
const NAMES: usize = 48;
/// The most elements that copies may come to.
const MOST: usize = 500_000;

/// What reads the elements of a document.
pub(super) struct Elements<'t> {
    text: &'t str,
    root: Node<'t, 't>,
    ids: BTreeMap<&'t str, Node<'t, 't>>,
    /// Metres.
    unit: f64,
}

/// An element still to read.
struct Todo<'t> {
    node: Node<'t, 't>,
    to: DAffine2,
    /// The names of what it is in, the outermost first.
    layers: Vec<&'t str>,
    /// How many copies it stands in.
    copies: usize,
}

impl<'t> Elements<'t> {
    pub fn new(text: &'t str, document: &'t Document<'t>, unit: f64) -> Self {
        let root = document.root_element();
        let ids = root.descendants().filter_map(|node| Some((node.attribute("id")?, node))).collect();
        Self { text, root, ids, unit }
    }

    /// The y of the lower edge of the picture, 0 where it does not say.
    pub fn bottom(&self) -> f64 {
        let view = self.root.attribute("viewBox").and_then(|view| svgtypes::ViewBox::from_str(view).ok());
        let height = || self.root.attribute("height").and_then(|height| svgtypes::Length::from_str(height).ok());
        view.map_or_else(|| height().map_or(0.0, |height| height.number), |view| view.y + view.h)
    }

    /// Adds the shapes of the document, as they lie in the picture.
    pub fn read(&self, drawing: &mut Drawing) -> Result<(), Error> {
        let mut todo = vec![Todo { node: self.root, to: DAffine2::IDENTITY, layers: vec![], copies: 0 }];
        let mut copied = 0;
        while let Some(mut item) = todo.pop() {
            let node = item.node;
            let symbol = node.tag_name().name() == "symbol" && item.copies > 0;
            if !node.is_element() || (hidden(node) && !symbol) {
                continue;
            }
            item.layers.extend(names(node));
            item.layers.drain(..item.layers.len().saturating_sub(NAMES));
            item.to *= self.transform(node)?;
            copied += usize::from(item.copies > 0);
            if copied > MOST {
                return Err(self.wrong(node, format!("copies (<use>) come to more than {MOST} elements")));
            }
            match node.tag_name().name() {
                "svg" | "g" | "a" | "switch" | "symbol" => {
                    let child = |node| Todo { node, layers: item.layers.clone(), ..item };
                    let from = todo.len();
                    todo.extend(node.children().map(child));
                    todo[from..].reverse();
                }
                "use" => {
                    let href = node.attribute("href").or(node.attribute((XLINK, "href"))).unwrap_or_default();
                    let Some(of) = self.ids.get(href.trim_start_matches('#')) else { continue };
                    if item.copies >= DEEPEST {
                        return Err(
                            self.wrong(node, format!("copies (<use>) stand in copies more than {DEEPEST} deep"))
                        );
                    }
                    let shift = DVec2::new(self.length(node, "x")?, self.length(node, "y")?);
                    let to = item.to * DAffine2::from_translation(shift);
                    todo.push(Todo { node: *of, to, layers: item.layers, copies: item.copies + 1 });
                }
                _ => self.shape(&item, drawing)?,
            }
        }
        Ok(())
    }

    fn shape(&self, item: &Todo, drawing: &mut Drawing) -> Result<(), Error> {
        let (to, node) = (item.to, item.node);
        let wide = to.matrix2.x_axis.length().max(to.matrix2.y_axis.length()).max(1e-9);
        let Some(forms) = outline::of(self, node, TOLERANCE / self.unit / wide)? else {
            if matches!(node.tag_name().name(), "image" | "text" | "foreignObject") {
                drawing.notes.about(&format!("<{}>", node.tag_name().name()), "left out");
            }
            return Ok(());
        };
        // the innermost name that says what it is, else the innermost
        let layer = item.layers.iter().rev().find(|name| role(name).is_some()).or(item.layers.last());
        let line = self.text[..node.range().start].matches('\n').count() + 1;
        for mut form in forms {
            form.each(|p| to.transform_point2(p));
            drawing.add(layer.copied().unwrap_or_default(), form, Place::Line(line));
        }
        Ok(())
    }

    fn transform(&self, node: Node) -> Result<DAffine2, Error> {
        let Some(said) = node.attribute("transform") else { return Ok(DAffine2::IDENTITY) };
        let t = svgtypes::Transform::from_str(said)
            .map_err(|error| self.wrong(node, format!("its transform is wrong: {error}")))?;
        Ok(DAffine2::from_mat2_translation(
            DMat2::from_cols(DVec2::new(t.a, t.b), DVec2::new(t.c, t.d)),
            DVec2::new(t.e, t.f),
        ))
    }

    /// A length in pixels; 0 where it is not said.
    pub fn length(&self, node: Node, name: &str) -> Result<f64, Error> {
        use svgtypes::LengthUnit as Unit;
        let Some(said) = node.attribute(name) else { return Ok(0.0) };
        let length = svgtypes::Length::from_str(said).ok().filter(|length| length.number.is_finite());
        let length =
            length.ok_or_else(|| self.wrong(node, format!("`{name}` is `{}`, which is no length", short(said))))?;
        let pixels = match length.unit {
            Unit::None | Unit::Px => 1.0,
            Unit::In => 96.0,
            Unit::Cm => 96.0 / 2.54,
            Unit::Mm => 96.0 / 25.4,
            Unit::Pt => 96.0 / 72.0,
            Unit::Pc => 16.0,
            Unit::Em | Unit::Ex | Unit::Percent => {
                let message =
                    format!("`{name}` is `{}`: only lengths in px, mm, cm, in, pt and pc are read", short(said));
                return Err(self.wrong(node, message));
            }
        };
        Ok(length.number * pixels)
    }

    /// An error about an element, with its place.
    pub fn wrong(&self, node: Node, message: String) -> Error {
        let start = node.range().start;
        let tag = node.tag_name().name();
        Error::new(Kind::Geometry, format!("<{tag}>: {message}")).place(self.text, start..start + tag.len() + 1)
    }
}

/// What an element is called: its label, or else its id, and its class.
fn names<'t>(node: Node<'t, 't>) -> impl Iterator<Item = &'t str> {
    let label = node.attribute((INKSCAPE, "label")).or_else(|| node.attribute("data-name"));
    // the first of them is looked at last
    [node.attribute("class"), node.attribute("id"), label].into_iter().flatten()
}

/// Whether an element is not shown: it says so, or is there to be referred to.
fn hidden(node: Node) -> bool {
    let style = |key: &str, value: &str| {
        let said = node.attribute("style").unwrap_or_default().split(';').filter_map(|part| part.split_once(':'));
        node.attribute(key).is_some_and(|said| said.trim() == value)
            || said.into_iter().any(|(k, v)| k.trim() == key && v.trim() == value)
    };
    style("display", "none")
        || style("visibility", "hidden")
        || matches!(
            node.tag_name().name(),
            "defs"
                | "symbol"
                | "clipPath"
                | "mask"
                | "pattern"
                | "marker"
                | "metadata"
                | "title"
                | "desc"
                | "style"
                | "script"
        )
}
