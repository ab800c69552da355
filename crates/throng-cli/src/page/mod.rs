//! Pages of one file without network, the plots on them, which make a picture too, and the player.

mod player;
mod plot;
mod sheet;

pub use player::{Player, Scenery};
pub use plot::{Height, Plot, TIME};
pub use sheet::figure;

/// How pages look.
pub const STYLE: &str = include_str!("style.css");

/// A template with its `{{names}}` replaced; what is put in is not looked at again.
pub fn fill(template: &str, parts: &[(&str, String)]) -> String {
    let mut out = String::with_capacity(template.len() + parts.iter().map(|part| part.1.len()).sum::<usize>());
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        out.push_str(before);
        out.push_str(parts.iter().find(|part| part.0 == name).map_or("", |part| &part.1));
        rest = after;
    }
    out.push_str(rest);
    out
}

/// Text as it may stand in HTML, between tags and in attributes.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// The line of a model in plots.
pub fn swatch(model: usize) -> String {
    let line = format!("<path class=\"line m{}\" d=\"M1 4H25\"/>", model % 8);
    format!("<svg class=\"swatch\" viewBox=\"0 0 26 8\">{line}</svg>")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_put_in_is_not_looked_at_again() {
        let parts = [("a", "{{b}}".to_owned()), ("b", "B".to_owned())];
        assert_eq!(fill("x{{a}}y{{b}}{{c}}z", &parts), "x{{b}}yBz");
        assert_eq!(fill("x{{", &parts), "x");
    }
}
