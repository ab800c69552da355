//! Annotations drawn beside agents.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use throng_draw::{Annotation, Annotations};
use throng_scene::{Annotate, Scene};

/// Options for the annotations of agents.
#[derive(Args, Debug)]
#[command(next_help_heading = "Pictures")]
pub struct AnnotateArgs {
    /// Draws what agents perceive and choose: everything, or these kinds [default: the scene's `view.annotate`]
    #[arg(long, value_name = "KIND,...", value_parser = kinds(), value_delimiter = ',', num_args = 0.., require_equals = true)]
    pub annotate: Option<Vec<Annotation>>,

    /// Draws annotations only for the agents with these numbers
    #[arg(long, value_name = "NUMBER,...", value_delimiter = ',')]
    pub annotate_agents: Option<Vec<u32>>,
}

/// Returns the parser of annotation names.
fn kinds() -> impl TypedValueParser<Value = Annotation> {
    let names = PossibleValuesParser::new(Annotation::ALL.map(Annotation::name));
    names.try_map(|name| Annotation::ALL.into_iter().find(|kind| kind.name() == name).ok_or("no such kind"))
}

impl AnnotateArgs {
    /// Returns the annotations of the options, else of the scene's `[view]`. `--annotate-agents` without `--annotate`
    /// and without kinds in the scene means all kinds.
    pub fn annotations(&self, scene: &Scene) -> Annotations {
        let kinds = match (&self.annotate, &scene.view.annotate) {
            (Some(kinds), _) if !kinds.is_empty() => kinds.clone(),
            (None, Annotate::Kinds(_)) => Annotations::said(scene).kinds,
            (None, Annotate::All(false)) if self.annotate_agents.is_none() => Vec::new(),
            _ => Annotation::ALL.to_vec(),
        };
        Annotations { kinds, agents: self.annotate_agents.clone() }
    }
}
