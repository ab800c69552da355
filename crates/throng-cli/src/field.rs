//! Options for drawing the fields that lead groups.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use throng_draw::{FlowLayer, FlowStyle};

/// Options for drawing the fields that lead groups.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "Pictures")]
pub struct FieldArgs {
    /// Draws the fields that lead groups, in plan view: the default layers (lic, streamlines, anchors, critical), or
    /// these [default: the scene's `view.field`]
    #[arg(long, value_name = "LAYER,...", value_parser = layers(), value_delimiter = ',', num_args = 0.., require_equals = true)]
    pub field: Option<Vec<FlowLayer>>,
}

/// Returns the parser of layer names.
fn layers() -> impl TypedValueParser<Value = FlowLayer> {
    let names = PossibleValuesParser::new(FlowLayer::ALL.map(FlowLayer::name));
    names.try_map(|name| FlowLayer::ALL.into_iter().find(|layer| layer.name() == name).ok_or("no such layer"))
}

impl FieldArgs {
    /// Returns the style of fields; `None` if fields are not drawn.
    pub fn style(&self) -> Option<FlowStyle> {
        let layers = self.field.as_ref()?;
        Some(if layers.is_empty() { FlowStyle::default() } else { FlowStyle::of(layers.clone()) })
    }
}
