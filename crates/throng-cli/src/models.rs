//! Parses the local models that options name.

use crate::failure::Failure;
use throng_scene::Model;

/// Returns the named models, in order; `option` is the option's name, for messages.
///
/// # Errors
/// A model does not exist, has no such key, or is given twice.
pub fn models(option: &str, texts: &[String]) -> Result<Vec<Model>, Failure> {
    let models = texts.iter().map(|text| model(option, text)).collect::<Result<Vec<_>, _>>()?;
    distinct(option, models.iter().map(Model::label))?;
    Ok(models)
}

/// Returns the named model.
///
/// # Errors
/// The model does not exist or has no such key.
pub fn model(option: &str, text: &str) -> Result<Model, Failure> {
    text.parse().map_err(|mut error: throng_scene::Error| {
        error.file = Some(format!("{option} {}", text.trim()).into());
        error.into()
    })
}

/// Checks that no two models have the same label.
///
/// # Errors
/// A model is given twice.
pub fn distinct<'a>(option: &str, labels: impl Iterator<Item = &'a str>) -> Result<(), Failure> {
    let mut seen: Vec<&str> = Vec::new();
    for label in labels {
        if seen.contains(&label) {
            return Err(Failure::hint(format!("{option}: {label} is given twice"), "leave one of the two out"));
        }
        seen.push(label);
    }
    Ok(())
}
