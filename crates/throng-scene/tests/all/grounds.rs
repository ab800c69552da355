//! The ground of floor plans: the walkable area without obstacles.

use throng_scene::import::plan::{PlanGround, PlanOptions, ground};
use throng_scene::{Kind, PlanFile, Scene, Walkable};

/// 20 m by 10 m, a wall along x = 10, a round column, an exit.
const GEOJSON: &str = r#"{ "type": "FeatureCollection", "features": [
    { "type": "Feature", "properties": { "layer": "floor" }, "geometry": { "type": "Polygon", "coordinates":
        [[[0, 0], [12, 0], [12, 10], [0, 10], [0, 0]]] } },
    { "type": "Feature", "properties": { "layer": "floor" }, "geometry": { "type": "Polygon", "coordinates":
        [[[8, 0], [20, 0], [20, 10], [8, 10], [8, 0]], [[17, 7], [19, 7], [19, 9], [17, 9], [17, 7]]] } },
    { "type": "Feature", "properties": { "layer": "walls" }, "geometry": { "type": "LineString", "coordinates":
        [[10, 0], [10, 4]] } },
    { "type": "Feature", "properties": { "type": "column" }, "geometry": { "type": "Polygon", "coordinates":
        [[[14, 4], [15, 4], [15, 5], [14, 5], [14, 4]]] } } ] }"#;
const SVG: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="2000" height="1000">
    <path class="floor" fill-rule="evenodd" d="M0 0H2000V1000H0Z M1700 100H1900V300H1700Z"/>
    <g id="walls"><line x1="1000" y1="1000" x2="1000" y2="600"/><rect x="1400" y="500" width="100" height="100"/></g></svg>"#;
const DXF: &str = "0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 ENTITIES \
    0 LWPOLYLINE 8 floor 70 1 10 0 20 0 10 20000 20 0 10 20000 20 10000 10 0 20 10000 \
    0 LINE 8 walls 10 10000 20 0 11 10000 21 4000 0 SOLID 8 column 10 14000 20 4000 11 15000 21 4000 12 14000 22 5000 13 15000 23 5000 \
    0 SOLID 8 column 10 17000 20 7000 11 19000 21 7000 12 17000 22 9000 13 19000 23 9000 0 ENDSEC";
const WKT: &str = "POLYGON ((0 0, 9.99 0, 9.99 4.01, 10.01 4.01, 10.01 0, 20 0, 20 10, 0 10, 0 0), \
    (14 4, 15 4, 15 5, 14 5, 14 4), (17 7, 19 7, 19 9, 17 9, 17 7))";

/// A file in a folder that is removed at the end.
struct File {
    folder: tempfile::TempDir,
    name: String,
}

impl File {
    fn new(name: &str, text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(name), text).unwrap();
        Self { folder, name: name.into() }
    }

    fn ground(&self, unit: Option<f64>) -> Result<PlanGround, throng_scene::Error> {
        ground(self.folder.path().join(&self.name), &PlanOptions { unit, ..PlanOptions::default() })
    }

    /// Returns a scene beside the file.
    fn scene(&self, file: &str) -> Scene {
        let path = self.folder.path().join("scene.toml");
        let people = "[[group]]\ncount = 20\nplace.walkable = {}\ngoal.point = [19.5, 5]\n";
        std::fs::write(&path, format!("walkable.file = {file}\n{people}")).unwrap();
        Scene::load(path).unwrap_or_else(|error| panic!("{error}"))
    }
}

fn plans() -> [File; 4] {
    let dxf = DXF.split_whitespace().collect::<Vec<_>>().join("\n") + "\n";
    [("a.geojson", GEOJSON), ("a.svg", SVG), ("a.dxf", dxf.as_str()), ("a.wkt", WKT)]
        .map(|(name, text)| File::new(name, text))
}

#[test]
fn every_kind_of_plan_has_the_same_ground() {
    // expected: the floor without the column, the hole, and a wall of 2 cm
    let free = |x: f64, y: f64| {
        let within = |low: [f64; 2], high: [f64; 2]| x > low[0] && x < high[0] && y > low[1] && y < high[1];
        within([0.0, 0.0], [20.0, 10.0])
            && !within([14.0, 4.0], [15.0, 5.0])
            && !within([17.0, 7.0], [19.0, 9.0])
            && !within([9.99, -0.01], [10.01, 4.01])
    };
    for plan in plans() {
        let ground = plan.ground(None).unwrap_or_else(|error| panic!("{error}"));
        let size: f64 = ground.areas.iter().map(size).sum();
        assert!((size - (200.0 - 1.0 - 4.0 - 0.02 * 4.01)).abs() < 1e-5, "{}: {size}", plan.name);
        for (i, k) in (0..800).flat_map(|i| (0..110).map(move |k| (i, k))) {
            let (x, y) = (f64::from(i) * 0.026 - 0.4003, f64::from(k) * 0.1 - 0.4003);
            let inside = ground.areas.iter().any(|area| area.contains(glam::DVec2::new(x, y)));
            assert_eq!(inside, free(x, y), "{}: {x}, {y}", plan.name);
        }
    }
}

fn size(area: &throng::Walkable) -> f64 {
    let ring = |ring: &Vec<glam::DVec2>| {
        let next = ring.iter().cycle().skip(1);
        (ring.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() * 0.5).abs()
    };
    ring(&area.outer) - area.holes.iter().map(ring).sum::<f64>()
}

#[test]
fn scenes_take_every_kind_of_plan() {
    for plan in plans() {
        let scene = plan.scene(&format!("{:?}", plan.name));
        let laid = scene.plan().unwrap_or_else(|error| panic!("{}: {error}", plan.name));
        assert_eq!(laid.walkable, plan.ground(None).unwrap().areas);
        // notes report what was left out or assumed
        assert_eq!(laid.notes.iter().any(|note| note.contains("in a scene `unit`")), plan.name == "a.svg");
        let (mut world, _) = scene.build().unwrap();
        while !scene.time.over(&world) {
            world.step();
        }
        let summary = world.summary();
        assert!(summary.arrived == 20 && summary.least_wall_separation >= 0.9999, "{}: {summary:?}", plan.name);
    }
}

#[test]
fn a_scene_says_the_unit_of_its_plan() {
    let [_, svg, ..] = plans();
    let scene = svg.scene("{ name = \"a.svg\", unit = 0.02 }");
    assert_eq!(scene.walkable, Some(Walkable::File(PlanFile { name: "a.svg".into(), unit: Some(0.02), level: None })));
    let laid = scene.plan().unwrap();
    assert!(laid.walkable[0].outer.iter().any(|p| p.distance(glam::DVec2::new(40.0, 20.0)) < 1e-6), "{laid:?}");
    for file in ["\"a.svg\"", "{ name = \"a.svg\", unit = 0.02 }"] {
        let scene = svg.scene(file);
        assert_eq!(scene.to_toml().unwrap().parse::<Scene>().unwrap(), scene);
    }
}

#[test]
fn errors_in_the_plan_of_a_scene_have_its_file() {
    let says = |plan: &File, file: &str, kind: Kind, expected: &[&str]| {
        let error = plan.scene(file).plan().unwrap_err();
        let text = error.to_string();
        assert!(error.kind == kind && expected.iter().all(|part| text.contains(part)), "{text}");
    };
    let svg = File::new("a.svg", SVG);
    says(&svg, "\"b.svg\"", Kind::File, &["scene.toml:1:17", "there is no file", "b.svg"]);
    says(&svg, "{ name = \"a.svg\", unit = 0 }", Kind::OutOfRange, &["scene.toml:1:", "unit is 0, but must be more"]);
    says(
        &svg,
        "\"scene.toml\"",
        Kind::NotAScene,
        &["scene.toml:1:17", "scene.toml is not a floor plan", "plans end in"],
    );
    let walls = File::new("a.svg", &SVG.replace("floor", "wall"));
    says(&walls, "\"a.svg\"", Kind::Geometry, &["a.svg: nothing of this plan can be walked on", "`walkable`"]);
    let crossed = File::new("a.wkt", "POLYGON ((0 0, 20 10, 20 0, 0 10, 0 0))");
    says(&crossed, "\"a.wkt\"", Kind::Geometry, &["a.wkt: polygon 1: this outline crosses itself at (10.000, 5.000)"]);
    let error = "walkable.file = { file = \"a\" }\n".parse::<Scene>().unwrap_err().to_string();
    assert!(error.contains("expected the name of a floor plan, or { name = .., unit = .., level = .. }"), "{error}");
}
