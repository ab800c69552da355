//! Self-contained HTML pages: their plots, which also make a picture, and the player.

mod player;
mod plot;
mod sheet;

pub use player::{Player, Scenery};
pub use plot::{Dots, Height, Plot, TIME};
pub use sheet::figure;

const DOCUMENT: &str = include_str!("document.html");
const STYLE: &str = include_str!("style.css");

/// Returns a page with a title, a body and a script, all given as HTML.
pub fn document(title: &str, body: &str, script: &str) -> String {
    let parts = [("title", title), ("style", STYLE), ("body", body), ("script", script)];
    fill(DOCUMENT, &parts.map(|(name, part)| (name, part.to_owned())))
}

/// Returns a table with the names of the rows in its first column.
pub fn table(head: &[String], rows: &[Vec<String>]) -> String {
    let heads: String = head.iter().map(|head| format!("<th>{}</th>", escape(head))).collect();
    let row = |cells: &Vec<String>| {
        let tag = |k: usize| if k == 0 { "th" } else { "td" };
        let cell = |(k, cell): (usize, &String)| format!("<{0}>{1}</{0}>", tag(k), escape(cell));
        format!("<tr>{}</tr>\n", cells.iter().enumerate().map(cell).collect::<String>())
    };
    let rows: String = rows.iter().map(row).collect();
    format!("<table>\n<thead><tr>{heads}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n")
}

/// Replaces the `{{names}}` in a template. Inserted text is not searched for names.
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

/// Escapes text for HTML, between tags and in attributes.
pub fn escape(text: &str) -> String {
    crate::svg::escape(text).replace('"', "&quot;")
}

/// Returns the line sample of a model for legends.
pub fn swatch(model: usize) -> String {
    let line = format!("<path class=\"line m{}\" d=\"M1 4H25\"/>", model % 8);
    format!("<svg class=\"swatch\" viewBox=\"0 0 26 8\">{line}</svg>")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inserted_text_is_not_searched_again() {
        let parts = [("a", "{{b}}".to_owned()), ("b", "B".to_owned())];
        assert_eq!(fill("x{{a}}y{{b}}{{c}}z", &parts), "x{{b}}yBz");
        assert_eq!(fill("x{{", &parts), "x");
    }
}
