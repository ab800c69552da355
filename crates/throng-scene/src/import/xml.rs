//! Errors of XML.

use crate::error::{Error, Kind};

/// Returns the error for a text that is not XML, with its position.
pub(super) fn no_xml(text: &str, error: &roxmltree::Error) -> Error {
    let at = error.pos();
    let message = error.to_string();
    // the position is in `at`: drop it from the message
    let message = message.split(" at ").next().unwrap_or(&message);
    let mut out = Error::new(Kind::Syntax, format!("this is not XML: {message}"));
    let (row, column) = (at.row.max(1) as usize, at.col.max(1) as usize);
    out.at = Some((row, column));
    out.line = text.lines().nth(row - 1).map(|line| (line.to_owned(), 1));
    out
}
