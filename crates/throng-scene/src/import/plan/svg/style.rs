//! The style of elements: presentation attributes, style sheets, `style`, and inheritance.

use roxmltree::{Document, Node};
use simplecss::{AttributeOperator, Declaration, DeclarationTokenizer, PseudoClass, StyleSheet};

/// The properties that are used.
const NAMES: [&str; 9] = [
    "display",
    "visibility",
    "fill",
    "fill-rule",
    "stroke",
    "stroke-width",
    "stroke-linejoin",
    "stroke-linecap",
    "stroke-miterlimit",
];

/// The style of an element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look<'t> {
    /// The values of the properties; `None` for those that are not set.
    said: [Option<&'t str>; NAMES.len()],
}

impl<'t> Look<'t> {
    /// Returns the value of a property.
    pub fn of(&self, name: &str) -> Option<&'t str> {
        NAMES.iter().position(|known| *known == name).and_then(|i| self.said[i])
    }

    /// Whether a property has a value.
    pub fn is(&self, name: &str, value: &str) -> bool {
        self.of(name) == Some(value)
    }
}

/// The style sheets of a document.
pub(super) struct Styles<'t> {
    sheet: StyleSheet<'t>,
}

impl<'t> Styles<'t> {
    pub fn of(document: &'t Document<'t>) -> Self {
        let mut sheet = StyleSheet::new();
        let css = |kind: Option<&str>| kind.is_none_or(|kind| kind.is_empty() || kind == "text/css");
        let styles =
            document.descendants().filter(|node| node.tag_name().name() == "style" && css(node.attribute("type")));
        for text in styles.flat_map(|node| node.children()).filter_map(|node| node.text()) {
            sheet.parse_more(text);
        }
        Self { sheet }
    }

    /// Returns the style of an element with the style of its parent.
    pub fn look(&self, node: Node<'t, 't>, within: Option<Look<'t>>) -> Look<'t> {
        let mut said = [None; NAMES.len()];
        let mut ranks = [0; NAMES.len()];
        // of two declarations of the same rank the later applies: rules are sorted by specificity
        let mut say = |name: &str, value: &'t str, rank: u8| {
            if let Some(i) = NAMES.iter().position(|known| *known == name).filter(|i| ranks[*i] <= rank) {
                (said[i], ranks[i]) = (Some(value.trim()), rank);
            }
        };
        for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
            say(attribute.name(), attribute_text(node, attribute.name()), 1);
        }
        for rule in self.sheet.rules.iter().filter(|rule| rule.selector.matches(&Element(node))) {
            let rank = |declared: &Declaration| if declared.important { 4 } else { 2 };
            rule.declarations.iter().for_each(|declared| say(declared.name, declared.value, rank(declared)));
        }
        for declared in DeclarationTokenizer::from(node.attribute("style").unwrap_or_default()) {
            say(declared.name, declared.value, if declared.important { 5 } else { 3 });
        }
        for (i, (value, name)) in said.iter_mut().zip(NAMES).enumerate() {
            let within = within.filter(|_| name != "display").and_then(|within| within.said[i]);
            match value {
                Some("inherit") | None => *value = within,
                _ => {}
            }
        }
        Look { said }
    }
}

/// Returns the text of an attribute, with the lifetime of the document.
fn attribute_text<'t>(node: Node<'t, 't>, name: &str) -> &'t str {
    node.attribute(name).unwrap_or_default()
}

/// An element for matching selectors.
struct Element<'t>(Node<'t, 't>);

impl simplecss::Element for Element<'_> {
    fn parent_element(&self) -> Option<Self> {
        self.0.parent_element().map(Element)
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        self.0.prev_sibling_element().map(Element)
    }

    fn has_local_name(&self, name: &str) -> bool {
        self.0.tag_name().name() == name
    }

    fn attribute_matches(&self, name: &str, operator: AttributeOperator<'_>) -> bool {
        self.0.attribute(name).is_some_and(|value| operator.matches(value))
    }

    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        matches!(class, PseudoClass::FirstChild) && self.0.prev_sibling_element().is_none()
    }
}
