//! Damaged files of other programs cause an error, never a panic.

use throng_scene::import::plan::{PlanOptions, from_text};
use throng_scene::import::{jupedsim, menge};
use throng_scene::{Error, Imported, Purpose, Random};

const GEOJSON: &str = r#"{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"layer":"floor"},"geometry":{"type":"Polygon","coordinates":[[[0,0],[20,0],[20,10],[0,10],[0,0]],[[4,4],[5,4],[5,5],[4,4]]]}},
{"type":"Feature","properties":{"layer":"wall"},"geometry":{"type":"MultiLineString","coordinates":[[[10,0],[10,4]],[[10,4],[12,4]]]}},
{"type":"Feature","properties":{"layer":"exit"},"geometry":{"type":"Point","coordinates":[19,5]}},
{"type":"Feature","properties":{"layer":"start","people":9},"geometry":{"type":"Polygon","coordinates":[[[1,1],[6,1],[6,9],[1,9],[1,1]]]}}]}"#;

const SVG: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 2000 1000"><defs><g id="p"><circle r="50"/></g></defs>
<g id="floor"><path d="M0 0H2000V1000h-2000z M400 400 q100 0 100 100 t100 100 z"/></g>
<g id="columns" transform="rotate(5) translate(100,100)"><use href="#p" x="1400" y="500"/><ellipse cx="900" cy="300" rx="50" ry="20"/></g>
<g id="exit"><polygon points="1900,400 2000,400 2000,600"/></g><g id="walls"><path d="M1000 1000A50 40 10 0 1 1000 600C900 500 900 400 1000 300"/></g></svg>"##;

const DXF: &str = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nC\n10\n0\n20\n0\n0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n0.5\n0\nENDBLK\n0\nENDSEC\n\
0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\nfloor\n70\n1\n10\n0\n20\n0\n10\n20\n20\n0\n42\n0.3\n10\n20\n20\n10\n10\n0\n20\n10\n0\nINSERT\n8\ncolumns\n2\nC\n10\n9\n20\n5\n70\n2\n44\n2\n\
0\nARC\n8\nwall\n10\n5\n20\n5\n40\n2\n50\n0\n51\n90\n0\nELLIPSE\n8\nwall\n10\n5\n20\n5\n11\n1\n21\n0\n40\n0.5\n0\nLINE\n8\nexit\n10\n19\n20\n4\n11\n19\n21\n6\n0\nENDSEC\n0\nEOF\n";

/// Pairs with spaces between the values.
const CURVES: &str = "0 SECTION 2 ENTITIES 0 SPLINE 8 wall 70 1 71 2 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 2 41 1 10 2 20 4 10 4 20 2 10 6 20 4 \
0 SPLINE 8 wall 11 7 21 7 11 8 21 8 11 9 21 7 0 HATCH 8 floor 91 2 92 2 72 1 73 1 93 3 10 0 20 0 42 0.2 10 20 20 0 10 20 20 10 97 0 \
92 1 93 4 72 1 10 9 20 2 11 11 21 2 72 2 10 11 20 3 40 1 50 270 51 450 73 1 72 3 10 10 20 4 11 1 21 0 40 0.4 50 0 51 180 73 0 \
72 4 94 2 73 0 74 0 95 6 96 3 40 0 40 0 40 0 40 1 40 1 40 1 10 9 20 4 10 8 20 3 10 9 20 2 97 0 75 1 76 1 0 POINT 8 exit 10 18 20 4 0 ENDSEC 0 EOF";

const STYLED: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="20cm" height="50%" viewBox="0 0 2000 1000"><style>
/* walls */ .w, #a > rect:first-child { fill: none; stroke: #000; stroke-width: 20px } svg .h { display: none !important } rect { fill-rule: evenodd }</style>
<rect id="floor" width="100%" height="1000" rx="5%"/><g id="walls" stroke-linejoin="round" stroke-linecap="square" stroke-miterlimit="3">
<polyline class="w" points="1000,1000 1000,600 1100,600"/><rect class="w" x="300" y="300" width="200" height="100" ry="20"/><rect class="h" width="9"/></g>
<svg id="columns" x="10%" y="100" width="400" height="200" viewBox="0 0 40 20" preserveAspectRatio="xMaxYMin slice"><rect width="4" height="2"/></svg>
<symbol id="s" viewBox="0 0 10 10"><circle r="4" cx="50%"/></symbol><use id="pillar" href="#s" x="700" y="700" width="90" height="90"/>
<rect id="exit" x="1900" y="400" width="100" height="200"/></svg>"##;

const OBJ: &str = "v 0 0 0\nv 10 0 0\nv 10 0 -10\nv 0 0 -10\nv 4 0 -4\nv 6 0 -4\nv 6 3 -6\nv 4 3 -6\nf 1 2 3 4\nf 5 6 7 8\nf -1 -2 -3\n";

const WKT: &str = "GEOMETRYCOLLECTION (POLYGON ((0 0, 20 0, 20 10, 0 10, 0 0), (1 1, 2 1, 2 2, 1 1)), MULTIPOLYGON (((5 5, 6 5, 6 6, 5 5))))";

const SCENE: &str = r#"<Experiment version="2.0"><Common time_step="0.1"/>
<AgentProfile name="a"><Common r="0.2" pref_speed="1.1" max_neighbors="8" obstacleSet="1"><Property name="r" dist="n" mean="0.2" stddev="0.01"/></Common></AgentProfile>
<AgentGroup><ProfileSelector type="weighted"><Profile name="a" weight="1"/></ProfileSelector><StateSelector type="const" name="W"/>
<Generator type="rect_grid" anchor_x="1" anchor_y="2" offset_x="1" offset_y="2" count_x="2" count_y="3"/><Generator type="explicit"><Agent p_x="5" p_y="9"/></Generator></AgentGroup>
<ObstacleSet type="explicit" class="1"><Obstacle closed="1"><Vertex p_x="4" p_y="-9"/><Vertex p_x="6" p_y="-9"/><Vertex p_x="6" p_y="-8"/></Obstacle></ObstacleSet>
<ObstacleSet type="nav_mesh" file_name="it.nav" class="1"/></Experiment>"#;

const BEHAVIOR: &str = r#"<BFSM><GoalSet id="0"><Goal type="point" id="0" x="10" y="10" capacity="1"/><Goal type="OBB" id="1" x="12" y="4" width="3" height="2" angle="30"/></GoalSet>
<State name="W" final="0"><GoalSelector type="nearest" goal_set="0"/><VelComponent type="goal"/></State><State name="R" final="0"><VelComponent type="zero"/></State>
<Transition from="W" to="R"><Condition type="goal_reached" distance="0.5"/></Transition>
<Transition from="R"><Condition type="timer" dist="u" min="2" max="4"/><Target type="prob"><State name="W" weight="3"/><State name="R" weight="1"/></Target></Transition></BFSM>"#;

const NAV: &str = "4\n-30 -30\n30 -30\n30 30\n-30 30\n0\n4\n0 1 0 1\n1 2 0 2\n2 3 0 3\n3 0 0 0\n\nall\n1\n0 0\n4 0 1 2 3\n0 0 1\n0\n4 0 1 2 3\n";

const JUPEDSIM: &str = r#"{"walkable_area_wkt":"POLYGON ((0 0, 20 0, 20 5, 0 5, 0 0))","distributions":{"d":{"coordinates":[[0,0],[4,0],[4,5],[0,5]],
"parameters":{"number":10,"radius":0.2,"radius_distribution":"gaussian","radius_std":0.01,"v0":1.2,"use_flow_spawning":true,"flow_end_time":10},
"journey_weights":[{"journey_id":"a","weight":70}]}},"exits":{"e":{"coordinates":[[18,0],[20,0],[20,5],[18,5]]}},
"checkpoints":{"c":{"coordinates":[[9,1],[10,1],[10,2]],"waiting_time":2}},"journeys_v2":[{"id":"a","sequence":["c","e"]}]}"#;

/// The number of times that each text is damaged. `ROUNDS=100000 cargo test -p throng-scene damaged` tests more.
fn rounds() -> u64 {
    std::env::var("ROUNDS").ok().and_then(|rounds| rounds.parse().ok()).unwrap_or(300)
}

/// Damages a text in some places: drops, doubles, moves or replaces parts of it.
fn damaged(text: &str, round: u64) -> String {
    let pieces = [
        "-",
        "0",
        "nan",
        "1e308",
        "-1e9",
        "[",
        "]",
        "{",
        "<",
        "/>",
        "\"",
        "\n",
        "=",
        ",",
        "é",
        "99999999999999999999",
        "9e6",
        " ",
        "(",
        "null",
    ];
    let mut random = Random::new(3, 1, round, Purpose::Choice);
    let mut pick = |n: usize| (random.bits() % n.max(1) as u64) as usize;
    let mut letters: Vec<char> = text.chars().collect();
    for _ in 0..1 + pick(4) {
        let at = pick(letters.len());
        let most = if pick(5) == 0 { 60 } else { 4 };
        let length = pick(most).min(letters.len() - at);
        match pick(5) {
            0 => drop(letters.drain(at..at + length)),
            1 => {
                let copy: Vec<char> = letters[at..at + length].to_vec();
                let to = pick(letters.len());
                letters.splice(to..to, copy);
            }
            2 if pick(10) == 0 => letters.truncate(at),
            3 => {
                // replaces a number
                let from = (at..letters.len()).find(|i| letters[*i].is_ascii_digit()).unwrap_or(at);
                let end = (from..letters.len()).find(|i| !letters[*i].is_ascii_digit()).unwrap_or(from);
                letters.splice(from..end, pieces[pick(pieces.len())].chars());
            }
            _ => drop(letters.splice(at..at + length, pieces[pick(pieces.len())].chars())),
        }
    }
    letters.into_iter().collect()
}

/// Reads damaged texts, and builds the results. Neither panics, and errors have a message.
fn survives(what: &str, text: &str, read: impl Fn(String) -> Result<Imported, Error>) {
    read(text.to_owned()).unwrap_or_else(|error| panic!("{what}: {error}"));
    let mut wrong = 0;
    for round in 0..rounds() {
        // places a few thousand agents at most
        let few =
            |imported: &Imported| imported.scene.groups.iter().filter_map(|group| group.count).sum::<u64>() < 5000;
        let read = read(damaged(text, round));
        let built = read.and_then(|imported| if few(&imported) { imported.scene.plan().map(|_| ()) } else { Ok(()) });
        if let Err(error) = built {
            wrong += 1;
            assert!(!error.message.is_empty() && error.to_string().len() < 2000, "{what}: {error}");
        }
    }
    assert!(wrong > rounds() / 20, "{what}: only {wrong} of {} were wrong", rounds());
}

#[test]
fn damaged_plans_never_panic() {
    let ask = PlanOptions { people: Some(20), ..PlanOptions::default() };
    let out = PlanOptions { exit: Some([17.0, 2.0, 2.0, 4.0]), ..ask };
    for (name, text, ask) in [
        ("a.geojson", GEOJSON, &ask),
        ("a.svg", SVG, &ask),
        ("a.dxf", DXF, &ask),
        ("b.dxf", &CURVES.replace(' ', "\n"), &ask),
        ("b.svg", STYLED, &ask),
        ("a.obj", OBJ, &PlanOptions { exit: Some([1.0, 1.0, 2.0, 2.0]), level: Some(1), ..ask }),
        ("a.wkt", WKT, &out),
    ] {
        survives(name, text, |text| from_text(name, &text, ask));
    }
}

#[test]
fn damaged_projects_never_panic() {
    let folder = tempfile::tempdir().unwrap();
    let files = [("itS.xml", SCENE), ("itB.xml", BEHAVIOR), ("it.nav", NAV)];
    for (which, (name, text)) in files.iter().enumerate() {
        survives(name, text, |damaged| {
            for (i, (name, text)) in files.iter().enumerate() {
                std::fs::write(folder.path().join(name), if i == which { &damaged } else { *text }).unwrap();
            }
            menge::load(folder.path().join("itS.xml"))
        });
    }
}

#[test]
fn damaged_scenarios_never_panic() {
    survives("JuPedSim", JUPEDSIM, |text| jupedsim::from_text(&text, None));
}
