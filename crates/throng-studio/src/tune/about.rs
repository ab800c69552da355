//! Parses the doc line of a key: its unit, its limits and its default.

/// A parsed doc line of a key.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct About {
    /// The whole text.
    pub text: String,
    /// The abbreviated unit.
    pub unit: Option<String>,
    /// The minimum, if there is one.
    pub low: Option<f64>,
    /// The maximum, if there is one.
    pub high: Option<f64>,
    /// The default, if the line states one.
    pub without: Option<f64>,
}

/// Units in doc lines, longer ones first, and their abbreviations.
const UNITS: [(&str, &str); 9] = [
    ("m/s²", "m/s²"),
    ("m/s", "m/s"),
    ("degrees a second", "°/s"),
    ("degrees per square root of a second", "°/√s"),
    ("degrees", "°"),
    ("metres", "m"),
    ("seconds", "s"),
    ("a second", "/s"),
    ("kilograms", "kg"),
];

impl About {
    /// Parses a doc line.
    pub fn new(text: &str) -> Self {
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let lower = text.to_lowercase();
        let first = |(words, unit): &(&str, &'static str)| Some((lower.find(words)?, words.len(), *unit));
        // the unit that appears first; among units that start there, the longest
        let unit = UNITS.iter().filter_map(first).min_by_key(|&(at, length, _)| (at, std::cmp::Reverse(length)));
        let (low, high) = text.split_once("Limit: ").map_or((None, None), |(_, limit)| limits(limit));
        let without = text.split_once("Without it, ").and_then(|(_, rest)| {
            let named = || rest.split_once("default (").and_then(|(_, rest)| number(rest));
            number(rest).or_else(named)
        });
        Self { unit: unit.map(|(_, _, unit)| unit.to_owned()), low, high, without, text }
    }
}

impl About {
    /// Returns what holds without the key, if the line says so.
    pub(super) fn otherwise(&self) -> Option<String> {
        let (_, rest) = self.text.split_once("Without it, ")?;
        Some(rest.split(['.', ',', ':']).next().unwrap_or_default().to_owned())
    }

    /// Returns a usual value, for a key without default.
    pub(super) fn first(&self) -> f64 {
        let usual: f64 = match self.unit.as_deref() {
            Some("°/s") => 180.0,
            Some("°") => 90.0,
            Some("m/s²") => 5.0,
            _ => 1.0,
        };
        usual.max(self.low.unwrap_or(f64::MIN)).min(self.high.unwrap_or(f64::MAX))
    }
}

/// Returns the minimum and the maximum of a limit: `a to b`, `> a`, `>= a`, `> a, at most b`.
fn limits(limit: &str) -> (Option<f64>, Option<f64>) {
    let most = limit.split_once("at most ").and_then(|(_, rest)| number(rest));
    if let Some(rest) = limit.strip_prefix(">= ").or_else(|| limit.strip_prefix("> ")) {
        return (number(rest), most);
    }
    match limit.split_once(" to ") {
        Some((low, high)) => (number(low), number(high)),
        None => (None, most),
    }
}

/// Returns the number at the start of a text.
fn number(text: &str) -> Option<f64> {
    let end = text.find(|c: char| !(c.is_ascii_digit() || "-.,eE+".contains(c))).unwrap_or(text.len());
    text[..end].trim_end_matches(['.', ',']).replace(',', "").parse().ok()
}

#[cfg(test)]
mod tests {
    use super::About;

    #[test]
    fn lines_are_read() {
        for (text, unit, low, high, without) in [
            ("How far, metres. Without it, 2.5. Limit: > 0.", Some("m"), Some(0.0), None, Some(2.5)),
            (
                "Degrees to the\nright. Without it, 5, or 0. Limit: -28 to 28.",
                Some("°"),
                Some(-28.0),
                Some(28.0),
                Some(5.0),
            ),
            ("Greatest change of velocity, m/s². Limit: > 0.", Some("m/s²"), Some(0.0), None, None),
            ("A speed, m/s. Limit: >= 0, at most 1000.", Some("m/s"), Some(0.0), Some(1000.0), None),
            ("How soon. Without it, the library's default (5). Limit: > 0.", None, Some(0.0), None, Some(5.0)),
            ("How fast, degrees a second. Without it, no limit.", Some("°/s"), None, None, None),
            ("How many. Limit: 1 to 20,000,000.", None, Some(1.0), Some(2e7), None),
            ("How much of it.", None, None, None, None),
        ] {
            let about = About::new(text);
            assert_eq!(
                (about.unit.as_deref(), about.low, about.high, about.without),
                (unit, low, high, without),
                "{text}"
            );
        }
    }
}
