//! Sweeps: numbering, rows, fingerprints, tables.

use proptest::prelude::*;
use std::collections::BTreeSet;
use throng_record::sweep::{FileFingerprints, Fingerprint, Plan, Row, RunFolder, collect, run_one};
use throng_record::{Cell, Output};
use throng_scene::Plugins;

fn plan(text: &str) -> Plan {
    Plan::parse("plan.toml", text, "", &Plugins::new()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn fingerprints(plan: &Plan) -> Vec<Fingerprint> {
    let files = FileFingerprints::default();
    plan.runs().map(|run| Fingerprint::of(&run, &files)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// The oracle: nested loops, the seed innermost.
    #[test]
    fn runs_are_all_combinations_in_order(scenes in 1usize..3, horizons in 1usize..4, distances in 1usize..4, seeds in 0usize..4) {
        let names = &["headon", "circle"][..scenes];
        let list = |count: usize| (1..=count).map(|k| k.to_string()).collect::<Vec<_>>().join(", ");
        let mut text = format!("scenes = {names:?}\n");
        if seeds > 0 {
            text += &format!("seeds = [{}]\n", list(seeds));
        }
        text += &format!("[[vary]]\navoid.orca.time_horizon = [{}]\n", list(horizons));
        text += &format!("[[vary]]\navoid.orca.neighbour_distance = [{}]\n", list(distances));
        let plan = plan(&text);
        let mut want = Vec::new();
        for (k, scene) in names.iter().enumerate() {
            for horizon in 1..=horizons {
                for distance in 1..=distances {
                    let own = plan.scenes[k].scene.seed;
                    let seeds = if seeds == 0 { vec![own] } else { (1..=seeds as u64).collect() };
                    want.extend(seeds.into_iter().map(|seed| ((*scene).to_owned(), horizon, distance, seed)));
                }
            }
        }
        prop_assert_eq!(plan.len(), want.len());
        for (index, (run, (scene, horizon, distance, seed))) in plan.runs().zip(want).enumerate() {
            let cells: Vec<Cell> = run.parameters().into_iter().map(|parameter| parameter.cell).collect();
            prop_assert_eq!(cells, vec![Cell::from(horizon), Cell::from(distance)]);
            prop_assert_eq!((run.index, &run.scene.name, run.seed()), (index, &scene, seed));
            let avoid = run.scene().unwrap().to_toml().unwrap();
            prop_assert!(avoid.contains(&format!("time_horizon = {horizon}\n")), "{}", avoid);
        }
        prop_assert!(plan.run(plan.len()).is_none());
        // two runs with equal fingerprints would be equal runs
        let all = fingerprints(&plan);
        prop_assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), all.len());
    }
}

#[test]
fn a_fingerprint_is_of_all_that_a_result_depends_on() {
    let text = "scenes = 'headon'\nseeds = [4]\nlimit = 2\n[[vary]]\nbody.radius = [0.2]\n[record]\ninterval = 0.2\n";
    let own = fingerprints(&plan(text));
    for (from, to) in
        [("4", "5"), ("2\n[[", "3\n[["), ("radius = [0.2]", "radius = [0.25]"), ("0.2\n", "0.3\n"), ("headon", "ring")]
    {
        assert_ne!(fingerprints(&plan(&text.replacen(from, to, 1))), own, "{from}");
    }
    let same = format!("title = 'x'\n{}", text.replace("[[vary]]\nbody.radius = [0.2]", "[set]\nbody.radius = 0.2"));
    assert_eq!(fingerprints(&plan(&same)), own);
    assert_eq!(fingerprints(&plan(&text.replace("[0.2]", "[0.25, 0.2]")))[1..], own);
    let words = text.replace("[[vary]]", "[set]\nabout.see = 'Two people.'\n[[vary]]");
    assert_eq!(fingerprints(&plan(&words)), own, "words do not change a run");
}

#[test]
fn rows_are_the_same_from_a_folder_and_in_any_order() {
    let place = tempfile::tempdir().unwrap();
    let plan = plan("scenes = ['headon', 'soccer']\nseeds = '1..2'\nlimit = 1\n[record]\npeople = true\n");
    let folder = RunFolder::create(place.path().join("runs")).unwrap();
    let mut rows: Vec<Row> = plan.runs().map(|run| run_one(&run, || true).unwrap()).collect();
    let all = fingerprints(&plan);
    rows.iter().zip(&all).for_each(|(row, fingerprint)| folder.keep(row, *fingerprint).unwrap());
    let read: Vec<Row> =
        plan.runs().zip(&all).map(|(run, fingerprint)| folder.row(&run, *fingerprint).unwrap()).collect();
    let bytes = |rows: Vec<Row>, name: &str| {
        let (table, path) = (collect(&plan, rows), place.path().join(name));
        let output = Output::create(&path).unwrap();
        match name {
            "a.csv" => table.write_csv(output),
            "a.json" => table.write_json(output),
            _ => table.write_parquet(output),
        }
        .unwrap();
        std::fs::read(path).unwrap()
    };
    rows.reverse();
    for name in ["a.csv", "a.json", "a.parquet"] {
        assert!(bytes(read.clone(), name) == bytes(rows.clone(), name), "{name}");
    }
    let table = collect(&plan, read);
    assert!(table.names().any(|name| name.starts_with("figures.")), "what the rules of soccer count");
    assert_eq!(table.cell(0, "scene"), Some(&Cell::Text(Some("headon".into()))));
    let figure = table.names().find(|name| name.starts_with("figures.")).unwrap().to_owned();
    assert!(table.cell(0, &figure).is_none() && table.cell(2, &figure).is_some());
}

#[test]
fn an_ended_run_has_no_row() {
    let plan = plan("scenes = 'headon'");
    let mut steps = 0;
    let row = run_one(&plan.run(0).unwrap(), || {
        steps += 1;
        steps < 5
    });
    assert_eq!((row, steps), (None, 5));
}
