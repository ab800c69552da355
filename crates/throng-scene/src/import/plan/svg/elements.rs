//! The tree of elements: layers, transforms, visibility.

use super::super::curve::TOLERANCE;
use super::super::drawing::Drawing;
use super::super::layer::{Role, role};
use super::super::overlay::{FARTHEST, THIN};
use super::stroke::painted;
use super::style::{Look, Styles};
use super::viewport::fitted;
use super::{FilePosition, outline};
use crate::error::{Error, Kind};
use crate::geometry::DVec2;
use crate::import::short;
use glam::{DAffine2, DMat2};
use roxmltree::{Document, Node};
use std::collections::BTreeMap;
use std::str::FromStr;
use svgtypes::{AspectRatio, ViewBox};

/// The namespace of Inkscape's labels.
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
const XLINK: &str = "http://www.w3.org/1999/xlink";

/// Maximum nesting depth of copies.
const DEEPEST: usize = 8;
/// Maximum number of enclosing names that are searched for a role.
const NAMES: usize = 48;
/// Maximum number of elements of copies.
const MOST: usize = 500_000;

/// Reads the elements of a document.
pub(super) struct Elements<'t> {
    text: &'t str,
    styles: Styles<'t>,
    root: Node<'t, 't>,
    ids: BTreeMap<&'t str, Node<'t, 't>>,
    /// Metres.
    unit: f64,
}

/// An element that is still to be read.
pub(super) struct Todo<'t> {
    pub node: Node<'t, 't>,
    /// Its properties; before it is read, those of its parent.
    pub look: Look<'t>,
    /// The size of the viewport that contains it.
    pub view: DVec2,
    to: DAffine2,
    /// The names of the enclosing elements, the outermost first.
    layers: Vec<&'t str>,
    /// The number of copies that contain it.
    copies: usize,
    /// The `<use>` element that it is a copy of, which may define its size.
    copy: Option<Node<'t, 't>>,
}

impl<'t> Elements<'t> {
    pub fn new(text: &'t str, document: &'t Document<'t>, unit: f64) -> Self {
        let root = document.root_element();
        let ids = root.descendants().filter_map(|node| Some((node.attribute("id")?, node))).collect();
        Self { text, styles: Styles::of(document), root, ids, unit }
    }

    /// Returns the upper left corner and the size of the picture; 0 for a side that is not given.
    pub fn view(&self) -> Result<[DVec2; 2], Error> {
        if let Some(view) = self.view_box(self.root)? {
            return Ok([DVec2::new(view.x, view.y), DVec2::new(view.w, view.h)]);
        }
        // the page around the picture, which percentages refer to, is unknown
        let side = |name: &str| match self.root.attribute(name) {
            Some(said) if said.trim().ends_with('%') => Ok(0.0),
            _ => self.length(self.root, name, DVec2::ZERO).map(Option::unwrap_or_default),
        };
        Ok([DVec2::ZERO, DVec2::new(side("width")?, side("height")?)])
    }

    fn view_box(&self, node: Node) -> Result<Option<ViewBox>, Error> {
        let Some(said) = node.attribute("viewBox") else { return Ok(None) };
        let view =
            ViewBox::from_str(said).map_err(|error| self.wrong(node, format!("its viewBox is wrong: {error}")))?;
        Ok(Some(view).filter(|view| [view.x, view.y, view.w, view.h].iter().all(|x| x.is_finite())))
    }

    /// Adds the shapes of the document, in the coordinates of the picture.
    pub fn read(&self, drawing: &mut Drawing) -> Result<(), Error> {
        let [_, view] = self.view()?;
        let look = self.styles.look(self.root, None);
        let to = DAffine2::IDENTITY;
        let mut todo = vec![Todo { node: self.root, look, view, to, layers: vec![], copies: 0, copy: None }];
        let mut copied = 0;
        while let Some(mut item) = todo.pop() {
            let node = item.node;
            let symbol = node.tag_name().name() == "symbol" && item.copies > 0;
            if !node.is_element() || (is_for_reference(node) && !symbol) {
                continue;
            }
            item.look = self.styles.look(node, Some(item.look));
            if item.look.is("display", "none") {
                continue;
            }
            item.layers.extend(names(node));
            item.layers.drain(..item.layers.len().saturating_sub(NAMES));
            item.to *= self.transform(node)?;
            copied += usize::from(item.copies > 0);
            if copied > MOST {
                return Err(self.wrong(node, format!("copies (<use>) come to more than {MOST} elements")));
            }
            if symbol || (node.tag_name().name() == "svg" && node != self.root) {
                self.enter(&mut item)?;
            }
            match node.tag_name().name() {
                "svg" | "g" | "a" | "switch" | "symbol" => {
                    let child = |node| Todo { node, layers: item.layers.clone(), copy: None, ..item };
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
                    let length = |name: &str| self.length(node, name, item.view).map(Option::unwrap_or_default);
                    let to = item.to * DAffine2::from_translation(DVec2::new(length("x")?, length("y")?));
                    todo.push(Todo { node: *of, to, copies: item.copies + 1, copy: Some(node), ..item });
                }
                _ => self.shape(&item, drawing)?,
            }
        }
        Ok(())
    }

    /// Enters a nested viewport.
    fn enter(&self, item: &mut Todo) -> Result<(), Error> {
        let node = item.node;
        let length = |of: Node, name: &str| self.length(of, name, item.view);
        let side = |name: &str, whole: f64| -> Result<f64, Error> {
            let copied = item.copy.map_or(Ok(None), |copy| length(copy, name))?;
            Ok(copied.map_or_else(|| length(node, name), |side| Ok(Some(side)))?.unwrap_or(whole))
        };
        let room = DVec2::new(side("width", item.view.x)?, side("height", item.view.y)?);
        let at = DVec2::new(length(node, "x")?.unwrap_or_default(), length(node, "y")?.unwrap_or_default());
        item.to *= DAffine2::from_translation(at);
        match self.view_box(node)? {
            Some(view) if room.min_element() > 0.0 => {
                let ratio = node.attribute("preserveAspectRatio").unwrap_or("xMidYMid");
                let ratio = AspectRatio::from_str(ratio)
                    .map_err(|error| self.wrong(node, format!("its preserveAspectRatio is wrong: {error}")))?;
                item.to *= fitted(&view, room, ratio);
                item.view = DVec2::new(view.w, view.h);
            }
            _ => item.view = room,
        }
        Ok(())
    }

    fn shape(&self, item: &Todo, drawing: &mut Drawing) -> Result<(), Error> {
        let (to, node, look) = (item.to, item.node, &item.look);
        if look.is("visibility", "hidden") || look.is("visibility", "collapse") {
            return Ok(());
        }
        let wide = to.matrix2.x_axis.length().max(to.matrix2.y_axis.length()).max(1e-9);
        let tolerance = TOLERANCE / self.unit / wide;
        let Some(mut forms) = outline::of(self, item, tolerance)? else {
            if matches!(node.tag_name().name(), "image" | "text" | "foreignObject") {
                drawing.notes.about(&format!("<{}>", node.tag_name().name()), "left out");
            }
            return Ok(());
        };
        // the innermost name with a known role, or else the innermost name
        let layer = item.layers.iter().rev().find(|name| role(name).is_some()).or(item.layers.last());
        let layer = layer.copied().unwrap_or_default();
        if look.is("fill", "none") && look.is("stroke", "none") {
            drawing.notes.about(&format!("layer `{layer}`"), "shapes without fill and stroke are invisible: left out");
            return Ok(());
        }
        let pen =
            look.of("stroke").filter(|stroke| *stroke != "none").and(Some(look.of("stroke-width").unwrap_or("1")));
        if let Some(pen) = pen.filter(|_| role(layer) == Some(Role::Obstacle)) {
            let width = self.pixels(node, "stroke-width", pen, item.view)?;
            if width > FARTHEST {
                return Err(self.wrong(node, format!("its stroke is more than {FARTHEST} units wide")));
            }
            if width * wide * self.unit > 2.0 * THIN {
                forms = painted(forms, look, width, tolerance);
            }
        }
        let line = self.text[..node.range().start].matches('\n').count() + 1;
        for mut form in forms {
            form.each(|p| to.transform_point2(p));
            drawing.add(layer, form, FilePosition::Line(line));
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

    /// Returns a length in pixels, if it is given, in a viewport of a size.
    pub fn length(&self, node: Node, name: &str, view: DVec2) -> Result<Option<f64>, Error> {
        node.attribute(name).map(|said| self.pixels(node, name, said, view)).transpose()
    }

    fn pixels(&self, node: Node, name: &str, said: &str, view: DVec2) -> Result<f64, Error> {
        use svgtypes::LengthUnit as Unit;
        let length = svgtypes::Length::from_str(said).ok().filter(|length| length.number.is_finite());
        let length =
            length.ok_or_else(|| self.wrong(node, format!("`{name}` is `{}`, which is no length", short(said))))?;
        let whole = match name {
            "x" | "x1" | "x2" | "cx" | "rx" | "width" => view.x,
            "y" | "y1" | "y2" | "cy" | "ry" | "height" => view.y,
            _ => view.length() * std::f64::consts::FRAC_1_SQRT_2,
        };
        let pixels = match length.unit {
            Unit::None | Unit::Px => 1.0,
            Unit::In => 96.0,
            Unit::Cm => 96.0 / 2.54,
            Unit::Mm => 96.0 / 25.4,
            Unit::Pt => 96.0 / 72.0,
            Unit::Pc => 16.0,
            Unit::Percent if whole > 0.0 => whole / 100.0,
            Unit::Percent => {
                let message = format!("`{name}` is `{}` of a picture without a size", short(said));
                return Err(self.wrong(node, message).hint("give the picture a viewBox"));
            }
            Unit::Em | Unit::Ex => {
                let message =
                    format!("`{name}` is `{}`: only lengths in px, %, mm, cm, in, pt and pc are read", short(said));
                return Err(self.wrong(node, message));
            }
        };
        Ok(length.number * pixels)
    }

    /// Returns an error about an element, with its position.
    pub fn wrong(&self, node: Node, message: String) -> Error {
        let start = node.range().start;
        let tag = node.tag_name().name();
        Error::new(Kind::Geometry, format!("<{tag}>: {message}")).place(self.text, start..start + tag.len() + 1)
    }
}

/// Returns the names of an element: its class, and its label or else its id.
fn names<'t>(node: Node<'t, 't>) -> impl Iterator<Item = &'t str> {
    let label = node.attribute((INKSCAPE, "label")).or_else(|| node.attribute("data-name"));
    // the first has the lowest precedence
    [node.attribute("class"), node.attribute("id"), label].into_iter().flatten()
}

/// Whether an element is not drawn where it is defined.
fn is_for_reference(node: Node) -> bool {
    let name = node.tag_name().name();
    matches!(
        name,
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
