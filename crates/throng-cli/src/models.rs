//! Parses the local models that options name.

use crate::failure::Failure;
use throng_scene::Model;

/// Returns the named models, in order; `option` is the option's name, for messages.
///
/// # Errors
/// A model does not exist, has no such key, or is given twice.
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
