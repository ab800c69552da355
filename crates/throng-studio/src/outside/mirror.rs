//! The controls of the studio as elements of the page, for screen readers and tests.
//!
//! The studio draws its controls on a canvas, which screen readers cannot read. The mirror puts an invisible element over
//! each control, with its role, name and value (WAI-ARIA 1.2). The pointer goes through the elements to the canvas. A
//! screen reader that activates an element, or sets its value, operates the control.

use eframe::egui::accesskit::{Action, ActionData, ActionRequest, Node, NodeId, Role, Toggled, TreeId, TreeUpdate};
use eframe::egui::mutex::Mutex;
use eframe::egui::{self, Context, Event, FullOutput, RawInput};
use std::collections::BTreeMap;
use std::sync::Arc;
use wasm_bindgen::JsCast;
use wasm_bindgen::closure::Closure;
use web_sys::{Document, Element, HtmlInputElement};

/// The element that contains the elements of the controls.
const CONTAINER: &str = "controls";

/// The element that says in its text which control has the focus.
const FOCUS: &str = "focus";

/// What the id of an element begins with. The number of the control follows.
const PREFIX: &str = "control-";

/// The description of a control.
#[derive(Clone, Debug, PartialEq)]
struct Described {
    role: &'static str,
    name: String,
    /// Left, top, width and height, pixels of the page.
    place: [i32; 4],
    checked: Option<&'static str>,
    /// Least, greatest and present value.
    value: Option<[f64; 3]>,
    text: Option<String>,
    disabled: bool,
}

/// The mirror of the controls. It is a plug-in of egui.
pub struct Mirror {
    shown: Vec<(u64, Described)>,
    focus: Option<u64>,
    asked: Arc<Mutex<Vec<ActionRequest>>>,
}

impl Mirror {
    /// Creates the mirror of a studio.
    ///
    /// # Errors
    /// The page has no element for it.
    pub fn new(ctx: &Context) -> Result<Self, String> {
        ctx.enable_accesskit();
        let asked = Arc::default();
        let container = page()
            .and_then(|page| page.get_element_by_id(CONTAINER))
            .ok_or_else(|| format!("the page has no element `{CONTAINER}`"))?;
        for kind in ["click", "change"] {
            listen(&container, kind, ctx, &asked).map_err(|error| format!("{error:?}"))?;
        }
        Ok(Self { shown: Vec::new(), focus: None, asked })
    }

    /// Changes the elements of the page as the controls have changed. Returns `None` if the page lacks the container.
    fn show(&mut self, next: Vec<(u64, Described)>) -> Option<()> {
        if next == self.shown {
            return Some(());
        }
        let page = page()?;
        let container = page.get_element_by_id(CONTAINER)?;
        let before: BTreeMap<u64, &Described> = self.shown.iter().map(|(id, described)| (*id, described)).collect();
        let same = self.shown.iter().map(|(id, _)| id).eq(next.iter().map(|(id, _)| id));
        if !same {
            let kept: BTreeMap<u64, _> = next.iter().map(|(id, described)| (*id, described.role)).collect();
            let gone = self.shown.iter().filter(|(id, described)| kept.get(id) != Some(&described.role));
            gone.filter_map(|(id, _)| element(&page, *id)).for_each(|element| element.remove());
        }
        for (id, described) in &next {
            let old = before.get(id).copied().filter(|old| old.role == described.role);
            if same && old == Some(described) {
                continue;
            }
            let Some(element) =
                element(&page, *id).filter(|_| old.is_some()).or_else(|| created(&page, *id, described))
            else {
                continue;
            };
            if old != Some(described) {
                // fails only for names of attributes that are no names
                let _ = describe(&element, described);
            }
            if !same || old.is_none() {
                // an element that is in the page moves to the end
                let _ = container.append_child(&element);
            }
        }
        self.shown = next;
        Some(())
    }

    /// Says which control has the focus.
    fn say_focus(&mut self, focus: u64) {
        if self.focus.replace(focus) == Some(focus) {
            return;
        }
        let described = self.shown.iter().find(|(id, _)| *id == focus).map(|(_, described)| described);
        let says = described.map_or_else(String::new, |described| {
            [&described.name, described.role, described.checked.unwrap_or_default()].join(" ")
        });
        if let Some(element) = page().and_then(|page| page.get_element_by_id(FOCUS)) {
            element.set_text_content(Some(&says));
        }
    }
}

impl egui::Plugin for Mirror {
    fn debug_name(&self) -> &'static str {
        "mirror"
    }

    fn input_hook(&mut self, _: &Context, input: &mut RawInput) {
        input.events.extend(self.asked.lock().drain(..).map(Event::AccessKitActionRequest));
    }

    fn output_hook(&mut self, ctx: &Context, output: &mut FullOutput) {
        let Some(tree) = output.platform_output.accesskit_update.take() else { return };
        // without the container there is nothing to show
        let _ = self.show(controls(&tree, ctx.zoom_factor()));
        self.say_focus(tree.focus.0);
    }
}

/// Returns the described controls of a tree in its order.
fn controls(tree: &TreeUpdate, zoom: f32) -> Vec<(u64, Described)> {
    let nodes: BTreeMap<u64, &Node> = tree.nodes.iter().map(|(id, node)| (id.0, node)).collect();
    let mut found = Vec::new();
    let mut left: Vec<u64> = tree.tree.iter().map(|info| info.root.0).collect();
    while let Some(id) = left.pop() {
        let Some(node) = nodes.get(&id) else { continue };
        found.extend(described(node, zoom, &nodes).map(|described| (id, described)));
        left.extend(node.children().iter().rev().map(|child| child.0));
    }
    found
}

/// Returns the description of a node, `None` for nodes without a name or a meaning.
fn described(node: &Node, zoom: f32, nodes: &BTreeMap<u64, &Node>) -> Option<Described> {
    let role = match node.role() {
        Role::Button | Role::ComboBox | Role::ColorWell | Role::MenuItem => "button",
        Role::CheckBox | Role::Switch => "checkbox",
        Role::RadioButton => "radio",
        Role::Link => "link",
        Role::Slider => "slider",
        Role::SpinButton => "spinbutton",
        Role::TextInput | Role::MultilineTextInput => "textbox",
        Role::ProgressIndicator => "progressbar",
        Role::Image => "img",
        Role::Label => "note",
        _ => return None,
    };
    let label = node.labelled_by().first().and_then(|by| nodes.get(&by.0)).and_then(|label| label.value());
    let named = label.or_else(|| node.label()).or_else(|| node.placeholder());
    let name = named.or_else(|| node.value().filter(|_| role != "textbox")).filter(|name| !name.trim().is_empty())?;
    let bounds = node.bounds()?;
    let scaled = |at: f64| (at * f64::from(zoom)).round() as i32;
    let (left, top) = (scaled(bounds.x0), scaled(bounds.y0));
    let least = node.min_numeric_value().unwrap_or(f64::MIN);
    let most = node.max_numeric_value().unwrap_or(f64::MAX);
    let toggled = |toggled| match toggled {
        Toggled::True => "true",
        Toggled::False => "false",
        Toggled::Mixed => "mixed",
    };
    Some(Described {
        role,
        name: name.to_owned(),
        place: [left, top, scaled(bounds.x1) - left, scaled(bounds.y1) - top],
        checked: node.toggled().map(toggled),
        value: node.numeric_value().map(|value| [least, most, value]),
        text: node.value().filter(|_| role == "textbox").map(str::to_owned),
        disabled: node.is_disabled(),
    })
}

/// Creates the element of a control.
fn created(page: &Document, id: u64, described: &Described) -> Option<Element> {
    let input = match described.role {
        "slider" if described.value.is_some() => Some("range"),
        "spinbutton" if described.value.is_some() => Some("number"),
        _ => None,
    };
    let element = page.create_element(if input.is_some() { "input" } else { "div" }).ok()?;
    element.set_id(&format!("{PREFIX}{id}"));
    // Tab moves between the controls of the canvas
    element.set_attribute("tabindex", "-1").ok()?;
    match input {
        Some(input) => {
            element.set_attribute("type", input).ok()?;
            element.set_attribute("step", "any").ok()?;
        }
        None if described.role != "note" => element.set_attribute("role", described.role).ok()?,
        None => {}
    }
    Some(element)
}

/// Writes a description into an element.
fn describe(element: &Element, described: &Described) -> Result<(), wasm_bindgen::JsValue> {
    let [left, top, width, height] = described.place;
    element.set_attribute("style", &format!("left:{left}px;top:{top}px;width:{width}px;height:{height}px"))?;
    let set = |name: &str, value: Option<&str>| match value {
        Some(value) => element.set_attribute(name, value),
        None => element.remove_attribute(name),
    };
    set("aria-disabled", described.disabled.then_some("true"))?;
    match described.role {
        "note" => element.set_text_content(Some(&described.name)),
        "textbox" => {
            set("aria-label", Some(&described.name))?;
            element.set_text_content(described.text.as_deref());
        }
        role => {
            set("aria-label", Some(&described.name))?;
            let checks = if matches!(role, "checkbox" | "radio") { "aria-checked" } else { "aria-pressed" };
            set(checks, described.checked.filter(|_| matches!(role, "checkbox" | "radio" | "button")))?;
        }
    }
    let (Some([least, most, value]), Some(input)) = (described.value, element.dyn_ref::<HtmlInputElement>()) else {
        return Ok(());
    };
    if least > f64::MIN && most < f64::MAX {
        set("min", Some(&least.to_string()))?;
        set("max", Some(&most.to_string()))?;
    }
    input.set_value_as_number(value);
    Ok(())
}

/// Makes events of the elements into requests to the controls.
fn listen(
    container: &Element,
    kind: &'static str,
    ctx: &Context,
    asked: &Arc<Mutex<Vec<ActionRequest>>>,
) -> Result<(), wasm_bindgen::JsValue> {
    let (ctx, asked) = (ctx.clone(), asked.clone());
    let heard = Closure::<dyn FnMut(_)>::new(move |event: web_sys::Event| {
        let element = event.target().and_then(|target| target.dyn_into::<Element>().ok());
        let Some(element) = element else { return };
        let id = element.id();
        let Some(id) = id.strip_prefix(PREFIX).and_then(|id| id.parse().ok()) else { return };
        let value = element.dyn_ref::<HtmlInputElement>().map(HtmlInputElement::value_as_number);
        let (action, data) = match (kind, value) {
            ("change", Some(value)) if value.is_finite() => (Action::SetValue, Some(ActionData::NumericValue(value))),
            ("click", None) => (Action::Click, None),
            _ => return,
        };
        asked.lock().push(ActionRequest { action, target_tree: TreeId::ROOT, target_node: NodeId(id), data });
        ctx.request_repaint();
    });
    container.add_event_listener_with_callback(kind, heard.as_ref().unchecked_ref())?;
    // the listener lives as long as the page
    heard.forget();
    Ok(())
}

fn element(page: &Document, id: u64) -> Option<Element> {
    page.get_element_by_id(&format!("{PREFIX}{id}"))
}

fn page() -> Option<Document> {
    web_sys::window()?.document()
}
