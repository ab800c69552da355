//! Grades as JUnit XML, which the tools of test reports read.

use super::grade::Grades;
use std::fmt::Write;

/// Returns the grades of a scene as a report: a suite for each model, and a case for each seed and measure.
pub fn report(scene: &str, grades: &Grades) -> String {
    let mut suites = String::new();
    let (mut tests, mut failures) = (0, 0);
    for (model, runs) in &grades.models {
        let checks = || runs.iter().flat_map(|run| run.checks.iter().map(|check| (run.seed, check)));
        let (count, failed) = (checks().count(), checks().filter(|(_, check)| !check.passed()).count());
        tests += count;
        failures += failed;
        let (name, class) = (escaped(model), escaped(&format!("{scene}.{model}")));
        let _ = writeln!(
            suites,
            "  <testsuite name=\"{name}\" tests=\"{count}\" failures=\"{failed}\" errors=\"0\" skipped=\"0\">"
        );
        for (seed, check) in checks() {
            let case = escaped(&format!("seed {seed}: {} {}", check.measure, check.bound));
            let _ = write!(suites, "    <testcase classname=\"{class}\" name=\"{case}\"");
            let _ = match check.passed() {
                true => writeln!(suites, "/>"),
                false => writeln!(suites, "><failure message=\"{}\"/></testcase>", escaped(&check.to_string())),
            };
        }
        suites.push_str("  </testsuite>\n");
    }
    let name = escaped(scene);
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{name}\" tests=\"{tests}\" failures=\"{failures}\" errors=\"0\">\n{suites}</testsuites>\n"
    )
}

/// Returns a text as the value of an attribute. XML has no control characters.
fn escaped(text: &str) -> String {
    let escape = |c: char| match c {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => "\u{fffd}".to_owned(),
        c => c.to_string(),
    };
    text.chars().map(escape).collect()
}
