//! Local models, as options name them.

use crate::failure::Failure;
use throng_scene::Model;

/// The models that are named, in order; `option` is which says so.
///
/// # Errors
/// There is no such model, it has no such key, or it comes twice.
pub fn models(option: &str, texts: &[String]) -> Result<Vec<Model>, Failure> {
    let mut models: Vec<Model> = Vec::new();
    for text in texts {
        let model: Model = text.parse().map_err(|mut error: throng_scene::Error| {
            error.file = Some(format!("{option} {}", text.trim()).into());
            error
        })?;
        if models.iter().any(|other| other.label() == model.label()) {
            return Err(Failure::hint(format!("{option}: {model} is given twice"), "leave one of the two out"));
        }
        models.push(model);
    }
    Ok(models)
}
