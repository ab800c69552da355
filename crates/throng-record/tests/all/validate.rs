//! Tests that the experiments and the random families are scenes that can be run and measured.

use throng_record::validate::families::{FAMILIES, Trial, TrialFlaw};
use throng_record::validate::{Case, EXPERIMENTS, Run};

#[test]
fn every_case_can_be_run_and_measured() {
    for experiment in EXPERIMENTS {
        let cases = experiment.cases();
        assert!(cases.iter().any(|case| case.quick), "{}", experiment.name);
        for case in &cases {
            let mut scene = case.scene(3).unwrap_or_else(|error| panic!("{} {}: {error}", experiment.name, case.name));
            scene.time.limit = 0.4;
            let run = Run::of(&scene, case.interval, |_| true);
            let run = run.unwrap_or_else(|error| panic!("{} {}: {error}", experiment.name, case.name)).unwrap();
            assert_eq!(case.measure(&run).len(), case.figures.len(), "{} {}", experiment.name, case.name);
        }
        if let Some(overall) = &experiment.overall {
            let values: Vec<Vec<f64>> = cases.iter().map(|case| vec![1.0; case.figures.len()]).collect();
            assert_eq!(overall.measure(&values).len(), overall.figures().len(), "{}", experiment.name);
        }
    }
}

/// Tolerances must include the results of pedestrians. Ranges must overlap, with a margin of 2 % for rounding.
#[test]
fn tolerances_include_the_results_of_pedestrians() {
    let mut compared = 0;
    for experiment in EXPERIMENTS {
        for figure in experiment.cases().iter().flat_map(|case| &case.figures) {
            let (from, to) = figure.people.split_once('–').unwrap_or((figure.people, figure.people));
            let (Some([low, high]), Ok(from), Ok(to)) = (figure.tolerance, from.parse::<f64>(), to.parse::<f64>())
            else {
                continue;
            };
            let meet = from <= 1.02 * high && to >= 0.98 * low || from.abs() < 0.05;
            assert!(meet, "{} {}: {from} to {to}", experiment.name, figure.name);
            compared += 1;
        }
    }
    assert!(compared > 12, "{compared}");
}

/// Figures that the engine meets with margin in every run; `throng validate` measures all of them over more runs.
#[test]
fn people_are_met() {
    for (name, case, figures) in [
        ("head-on", "0.2 m", &["passes"][..]),
        ("single-file", "1.45", &["v"]),
        ("single-file", "2.24", &["v"]),
        ("door", "0.8 m", &["J/b", "rho", "stuck", "back", "a p99"]),
        ("door", "2.4 m", &["J/b", "rho", "a p99"]),
        ("corridor", "2.4-2.4-2.4", &["J"]),
        ("bidirectional", "1.5 per", &["phi", "stuck", "back", "a p99"]),
        ("loop", "1 per", &["v", "stuck", "back", "a p99"]),
    ] {
        let experiment = EXPERIMENTS.iter().find(|experiment| experiment.name == name).expect(name);
        let cases = experiment.cases();
        let case = cases.iter().find(|found| found.name.contains(case)).expect(case);
        let values = measured(case, 2);
        for figure in figures {
            let index = case.figures.iter().position(|found| found.name == *figure).expect(figure);
            let value = values[index];
            assert_eq!(case.figures[index].is_met(value), Some(true), "{name} {}: {figure} = {value}", case.name);
        }
    }
}

fn measured(case: &Case, seed: u64) -> Vec<f64> {
    let run = case.scene(seed).and_then(|scene| Run::of(&scene, case.interval, |_| true));
    case.measure(&run.unwrap_or_else(|error| panic!("{}: {error}", case.name)).unwrap())
}

#[test]
fn trials_follow_from_their_seed_and_index() {
    assert_eq!(Trial::new(7, 12), Trial::new(7, 12));
    assert!(Trial::new(7, 12).text != Trial::new(7, 20).text && Trial::new(7, 12).text != Trial::new(8, 12).text);
    for index in 0..8 * FAMILIES.len() as u64 {
        let trial = Trial::new(1, index);
        let plan = trial.scene().and_then(|scene| scene.plan());
        let plan = plan.unwrap_or_else(|error| panic!("{}: {error}\n{}", trial.name(), trial.text));
        assert!(plan.agents.len() > 1, "{}", trial.name());
    }
}

/// Returns the violated requirements of trials, a line per trial.
fn flaws(seed: u64, indices: std::ops::Range<u64>, counts: impl Fn(&TrialFlaw) -> bool) -> String {
    let flaws = |index: u64| {
        let trial = Trial::new(seed, index);
        let found = trial
            .scene()
            .and_then(|scene| Trial::check(&scene, |_| true))
            .unwrap_or_else(|error| panic!("{}: {error}", trial.name()));
        let found: Vec<String> = found.unwrap().iter().filter(|flaw| counts(flaw)).map(ToString::to_string).collect();
        (!found.is_empty()).then(|| format!("{}: {}\n", trial.name(), found.join(", ")))
    };
    indices.filter_map(flaws).collect()
}

#[test]
fn bodies_overlap_in_no_family() {
    let found = flaws(1, 0..FAMILIES.len() as u64, |flaw| matches!(flaw, TrialFlaw::Overlaps(_)));
    assert!(found.is_empty(), "{found}");
}

/// Without restlessness, 27 of the long bodies of the first scene and 2 of the second never move again.
#[test]
fn a_crowd_in_its_own_way_dissolves() {
    for index in [95, 399] {
        let found = flaws(1, index..index + 1, |_| true);
        assert!(found.is_empty(), "{found}");
    }
}

/// For nightly runs: `cargo test -p throng-record everything_holds -- --ignored`.
#[test]
#[ignore = "takes many minutes"]
fn everything_holds_in_500_random_scenes() {
    let found = flaws(1, 0..500, |_| true);
    assert!(found.is_empty(), "{} of 500 failed:\n{found}", found.lines().count());
}
