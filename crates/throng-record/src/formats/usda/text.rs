//! Values as text.

use glam::{Quat, Vec3};
use std::fmt::Write as _;

/// Returns a time as a time code, to a millionth.
pub fn code(time: f64, codes: f64) -> f64 {
    (time * codes * 1e6).round() / 1e6
}

/// Returns a list of values as text.
pub fn list<T>(values: impl Iterator<Item = T>, mut entry: impl FnMut(&mut String, T)) -> String {
    let mut out = String::from("[");
    for (k, value) in values.enumerate() {
        if k > 0 {
            out.push_str(", ");
        }
        entry(&mut out, value);
    }
    out.push(']');
    out
}

/// Writes a vector.
pub fn triple(out: &mut String, value: Vec3, decimals: usize) {
    let _ = write!(out, "({:.decimals$}, {:.decimals$}, {:.decimals$})", value.x, value.y, value.z);
}

/// Writes a rotation; a rotation about z has plain zeros for the other axes.
pub fn turn(out: &mut String, rotation: Quat) {
    let [x, y, z, w] = rotation.to_array();
    if x == 0.0 && y == 0.0 {
        let _ = write!(out, "({w:.5}, 0, 0, {z:.5})");
    } else {
        let _ = write!(out, "({w:.5}, {x:.5}, {y:.5}, {z:.5})");
    }
}

/// Returns a text in quotes.
pub fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => out.extend(['\\', letter]),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            other => out.push(other),
        }
    }
    out.push('"');
    out
}

/// Writes a number with at most `decimals` decimals, without trailing zeros.
pub fn number(out: &mut String, value: f64, decimals: usize) {
    let scale = [1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6][decimals.min(6)];
    // no -0
    let _ = write!(out, "{}", (value * scale).round() / scale + 0.0);
}

/// Writes numbers in brackets.
pub fn tuple(out: &mut String, values: impl IntoIterator<Item = f64>, decimals: usize) {
    for (k, value) in values.into_iter().enumerate() {
        out.push_str(if k == 0 { "(" } else { ", " });
        number(out, value, decimals);
    }
    out.push(')');
}

/// Returns a text with its lines indented.
pub fn indented(text: &str, indent: &str) -> String {
    let line = |line: &str| if line.is_empty() { "\n".to_owned() } else { format!("{indent}{line}\n") };
    text.lines().map(line).collect()
}
