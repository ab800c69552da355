//! docs/errors.md: what users get wrong and what they are told, by the program itself.
//!
//! The page is written from the program's answers; the test fails where they differ. After a change of a message,
//! read the new page: `UPDATE=1 cargo test -p throng-cli --test program errors`.

use crate::shared::folder;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Something a user gets wrong.
struct Case {
    what: &'static str,
    /// Files that are there: names and texts.
    files: &'static [(&'static str, &'static str)],
    /// What is typed.
    command: &'static str,
    code: i32,
}

const HEAD: &str = "\
# What goes wrong, and what the program says

Made by the program: a test runs every command below and compares (`crates/throng-cli/tests/program/errors.rs`).

Messages go to standard error and name the file, the line and the column, what is wrong, and how to mend it. Nothing is
written under the name of an output that is not complete.

| exit code | meaning |
|---|---|
| 0 | done; also when the reader of standard output has gone |
| 1 | the scene ran and did not show what its `[expect]` says |
| 2 | an error: nothing ran, or a file could not be written |
| 130 | interrupted with Ctrl-C; the files are complete up to there |
";

const WALL: &str = "\
[[group]]
place.point = [0, 0]
goal.point = [5, 0]

[[obstacle]]
name = \"pillar\"
shape.circle = { center = [5, 0], radius = 1 }
";

const CLOSED: &str = "\
[[group]]
name = \"guests\"
place.point = [0, 0]
goal.point = [5, 0]

# round the goal, without a door
[[obstacle]]
shape.wall = [[3, -2], [7, -2], [7, 2], [3, 2], [3, -2]]

[expect]
arrived = \"all\"
";

const CASES: &[Case] = &[
    Case {
        what: "An unknown key",
        files: &[("scene.toml", "[[group]]\nplaec.point = [0, 0]\ngoal.point = [5, 0]\n")],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "A wrong type",
        files: &[("scene.toml", "[[group]]\nplace.point = [0, 0]\nbody.radius = \"wide\"\n")],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "A number out of range",
        files: &[("scene.toml", "[[group]]\nname = \"guests\"\nplace.point = [0, 0]\nbody.radius = -0.2\n")],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "Not a number (NaN)",
        files: &[("scene.toml", "[[group]]\nplace.point = [nan, 0]\n")],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "A key that is missing",
        files: &[("scene.toml", "[[group]]\nplace.ring = { center = [0, 0] }\n")],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "Not TOML",
        files: &[("scene.toml", "[[group]]\ncount == 3\n")],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "Rules that nobody knows",
        files: &[("scene.toml", "rules = \"socer\"\n[[group]]\nplace.point = [0, 0]\n")],
        command: "throng check scene.toml",
        code: 2,
    },
    Case {
        what: "Rules that do not fit the scene",
        files: &[("scene.toml", "rules = \"soccer\"\n[[group]]\nplace.point = [0, 0]\n")],
        command: "throng check scene.toml",
        code: 2,
    },
    Case {
        what: "A figure that the rules do not keep",
        files: &[(
            "scene.toml",
            "rules = \"multiple-pursuit\"\n[[group]]\nname = \"wanderer\"\nplace.point = [0, 0]\n[[group]]\nname = \"pack\"\n\
             place.point = [9, 0]\n[expect]\nfigure = [{ of = \"goals\", at_least = 1 }]\n",
        )],
        command: "throng check scene.toml",
        code: 2,
    },
    Case {
        what: "A behaviour about somebody who is not there",
        files: &[(
            "scene.toml",
            "[[group]]\nname = \"dogs\"\nplace.point = [0, 0]\nsteer.pursue = { quarry = { group = \"hares\" } }\n",
        )],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "A behaviour with a number out of range",
        files: &[(
            "scene.toml",
            "[[group]]\nplace.point = [0, 0]\nsteer.arrive = { target = [5, 0], slowing_distance = -1 }\n",
        )],
        command: "throng run scene.toml",
        code: 2,
    },
    Case { what: "A missing scene file", files: &[("office.toml", "")], command: "throng run offcie.toml", code: 2 },
    Case { what: "An unknown gallery name", files: &[], command: "throng run cirlce", code: 2 },
    Case {
        what: "A missing floor plan",
        files: &[("scene.toml", "walkable.file = \"plan.wkt\"\n\n[[group]]\nplace.point = [0, 0]\n")],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "A file that is no scene",
        files: &[("notes.txt", "hello")],
        command: "throng run notes.txt",
        code: 2,
    },
    Case {
        what: "A polygon that crosses itself",
        files: &[(
            "scene.toml",
            "[walkable.polygon]\nouter = [[0, 0], [9, 9], [9, 0], [0, 9]]\n\n[[group]]\nplace.point = [1, 2]\n",
        )],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "An agent inside a wall",
        files: &[(
            "scene.toml",
            "walkable.rectangle = { center = [0, 0], size = [9, 9] }\n\n[[group]]\nplace.point = [4.4, 0]\n",
        )],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "Two agents in one place",
        files: &[("scene.toml", "[[group]]\nname = \"guests\"\nplace.points = [[0, 0], [1, 0], [1, 0]]\n")],
        command: "throng run scene.toml",
        code: 2,
    },
    Case { what: "A goal in a wall", files: &[("scene.toml", WALL)], command: "throng run scene.toml", code: 2 },
    Case {
        what: "A goal that cannot be reached: before the run",
        files: &[("scene.toml", CLOSED)],
        command: "throng check scene.toml | grep -A 1 warning",
        code: 0,
    },
    Case {
        what: "A goal that cannot be reached: after the run",
        files: &[("scene.toml", CLOSED)],
        command: "throng run scene.toml --no-files | grep -E 'stuck|expect'",
        code: 1,
    },
    Case {
        what: "No agents",
        files: &[("scene.toml", "[[group]]\ncount = 0\nplace.disc = { radius = 5 }\n")],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "No groups",
        files: &[("scene.toml", "title = \"Nobody\"\n")],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "A thousand million agents",
        files: &[("scene.toml", "[[group]]\ncount = 1_000_000_000\nplace.disc = { radius = 5 }\n")],
        command: "throng run scene.toml",
        code: 2,
    },
    Case {
        what: "More agents than fit",
        files: &[("scene.toml", "[[group]]\nname = \"guests\"\ncount = 1000\nplace.disc = { radius = 2 }\n")],
        command: "throng run scene.toml",
        code: 2,
    },
    Case { what: "A `--set` without a value", files: &[], command: "throng run circle --set seed", code: 2 },
    Case {
        what: "A `--set` of an unknown key",
        files: &[],
        command: "throng run circle --set avoid.orca.horizon=3",
        code: 2,
    },
    Case { what: "A `--set` of a wrong type", files: &[], command: "throng run circle --set time.step=fast", code: 2 },
    Case { what: "A `--set` out of range", files: &[], command: "throng run circle --set time.step=0", code: 2 },
    Case {
        what: "A floor plan alone",
        files: &[("room.wkt", "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0))")],
        command: "throng run room.wkt",
        code: 2,
    },
    Case {
        what: "A floor plan that is not WKT",
        files: &[("room.wkt", "POLYGON ((0 0, 10 0, 10 5")],
        command: "throng run room.wkt --exit 9,1,1,2 --people 20",
        code: 2,
    },
    Case {
        what: "An exit in a wall",
        files: &[("room.wkt", "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0))")],
        command: "throng run room.wkt --exit 20,1,1,2 --people 20",
        code: 2,
    },
    Case {
        what: "More people than fit on a floor plan",
        files: &[("room.wkt", "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0))")],
        command: "throng run room.wkt --exit 9,1,1,2 --people 2000",
        code: 2,
    },
    Case {
        what: "A floor plan whose layers say nothing",
        files: &[(
            "hall.svg",
            "<svg xmlns=\"http://www.w3.org/2000/svg\">\n  <g id=\"Ebene 1\"><rect width=\"900\" height=\"500\"/></g>\n  <path d=\"M0 0h900\"/>\n</svg>\n",
        )],
        command: "throng run hall.svg",
        code: 2,
    },
    Case {
        what: "A path of an SVG that is wrong",
        files: &[(
            "hall.svg",
            "<svg xmlns=\"http://www.w3.org/2000/svg\">\n  <path id=\"walls\" d=\"M0 0 H900 W500\"/>\n</svg>\n",
        )],
        command: "throng run hall.svg",
        code: 2,
    },
    Case {
        what: "A drawing (DXF) with a number that is none",
        files: &[(
            "hall.dxf",
            "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\nwalls\n10\n0,5\n20\n0\n11\n9\n21\n0\n0\nENDSEC\n0\nEOF\n",
        )],
        command: "throng run hall.dxf",
        code: 2,
    },
    Case {
        what: "An outline that crosses itself",
        files: &[(
            "hall.geojson",
            "{ \"type\": \"FeatureCollection\", \"features\": [\n  { \"type\": \"Feature\", \"properties\": { \"layer\": \"floor\" }, \"geometry\": {\n    \"type\": \"Polygon\", \"coordinates\": [[[0, 0], [20, 0], [0, 10], [20, 10], [0, 0]]] } }\n] }\n",
        )],
        command: "throng run hall.geojson --exit 9,1,1,2 --people 20",
        code: 2,
    },
    Case {
        what: "A mesh that nobody can walk on",
        files: &[("hall.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 3 2\n")],
        command: "throng run hall.obj --exit 1,1,1,1 --people 5",
        code: 2,
    },
    Case {
        what: "An option of floor plans for a scene",
        files: &[],
        command: "throng run circle --plan-unit 0.01",
        code: 2,
    },
    Case {
        what: "A project of Menge's without its behaviour",
        files: &[("hallS.xml", "<Experiment version=\"2.0\" />\n")],
        command: "throng run hallS.xml",
        code: 2,
    },
    Case {
        what: "A project of Menge's with a number that is none",
        files: &[
            ("hallB.xml", "<BFSM>\n  <State name=\"Walk\" final=\"0\" />\n</BFSM>\n"),
            (
                "hallS.xml",
                "<Experiment version=\"2.0\">\n  <AgentProfile name=\"all\">\n    <Common r=\"wide\" />\n  </AgentProfile>\n</Experiment>\n",
            ),
        ],
        command: "throng run hallS.xml",
        code: 2,
    },
    Case {
        what: "JSON that is no scenario",
        files: &[("config.json", "{ \"exits\": {} }")],
        command: "throng run config.json",
        code: 2,
    },
    Case {
        what: "A missing folder for the output",
        files: &[],
        command: "throng run circle -o films/circle.mp4",
        code: 2,
    },
    Case {
        what: "A name that does not say what to write",
        files: &[],
        command: "throng run circle -o circle.xyz",
        code: 2,
    },
    Case {
        what: "A video that needs ffmpeg, where there is none",
        files: &[],
        command: "throng run circle -o circle.avi",
        code: 2,
    },
    Case { what: "One output twice", files: &[], command: "throng run circle -o a.csv -o a.csv", code: 2 },
    Case { what: "A model that does not exist", files: &[], command: "throng compare circle -m orcs", code: 2 },
    Case { what: "Seeds that are none", files: &[], command: "throng compare circle --seeds 5..1", code: 2 },
    Case { what: "A full disk", files: &[], command: "ln -s /dev/full a.csv; throng run headon -q -o a.csv", code: 2 },
    Case {
        what: "A limit on the size of files",
        files: &[],
        command: "trap '' XFSZ; ulimit -f 8; throng run headon -q -o a.csv",
        code: 2,
    },
    Case {
        what: "A limit on the size of files, and a database",
        files: &[],
        command: "trap '' XFSZ; ulimit -f 8; throng run headon -q -o a.sqlite",
        code: 2,
    },
    Case {
        what: "A record that would grow in another file",
        files: &[],
        command: "ln -s other a.rec.part; throng run headon -q -o a.rec",
        code: 2,
    },
    Case {
        what: "A file that could not be completed, and can be read",
        files: &[],
        command: "trap '' XFSZ; ulimit -f 8; throng run doorway -q -o a.rec",
        code: 2,
    },
    Case { what: "A full disk behind standard output", files: &[], command: "throng list > /dev/full", code: 2 },
    Case { what: "A reader that goes", files: &[], command: "throng schema | head -n 1", code: 0 },
    Case {
        what: "A scene that does not show what it expects",
        files: &[],
        command: "throng run headon -q --no-files --set expect.arrived=3",
        code: 1,
    },
    Case { what: "A group that is not there", files: &[], command: "throng measure flocking --group bees", code: 2 },
    Case {
        what: "A table that holds no trajectories",
        files: &[("run.csv", "number,time,x\n0,0,0\n")],
        command: "throng measure run.csv",
        code: 2,
    },
    Case {
        what: "A place that is too far away",
        files: &[("run.csv", "number,time,x,y\n0,0,0,1e16\n")],
        command: "throng measure run.csv",
        code: 2,
    },
    Case {
        what: "A time far from the others",
        files: &[("run.csv", "number,time,x,y\n0,0,0,0\n0,0.04,0.05,0\n0,1e9,1,0\n")],
        command: "throng render run.csv",
        code: 2,
    },
    Case {
        what: "What is to be solid is not there",
        files: &[("scene.toml", "[[group]]\nplace.point = [0, 0]\nsolid = \"column\"\n")],
        command: "throng check scene.toml",
        code: 2,
    },
    Case { what: "An agent that is not there", files: &[], command: "throng explain circle --agent 99", code: 2 },
    Case { what: "A measurement of nobody", files: &[], command: "throng bench --agents 0", code: 2 },
    Case { what: "A work that does not exist", files: &[], command: "throng bench crosing", code: 2 },
    Case { what: "A contact sheet of nothing there is", files: &[], command: "throng sheet wals", code: 2 },
    Case { what: "An option that does not exist", files: &[], command: "throng run circle --frames 10", code: 2 },
];

/// What the program says, both outputs together, and its exit code.
fn answer(case: &Case) -> (String, Option<i32>) {
    let folder = folder();
    for (name, text) in case.files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    // The only programs there are: ours, and those that the commands name.
    let tools = folder.path().join("tools");
    std::fs::create_dir(&tools).unwrap();
    let link = |name: &str, program: &Path| std::os::unix::fs::symlink(program, tools.join(name)).unwrap();
    link("throng", Path::new(env!("CARGO_BIN_EXE_throng")));
    for name in ["grep", "head", "ln"] {
        link(name, &found(name));
    }
    let output = Command::new(found("bash"))
        .args(["-o", "pipefail", "-c", case.command])
        .current_dir(folder.path())
        .env_clear()
        .env("PATH", &tools)
        .output()
        .unwrap();
    let text = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap()).concat();
    (text, output.status.code())
}

/// Where a program of the system is.
fn found(name: &str) -> PathBuf {
    let places = ["/usr/bin", "/bin"].iter().map(|at| Path::new(at).join(name));
    places.into_iter().find(|path| path.exists()).unwrap_or_else(|| panic!("there is no {name}"))
}

fn page() -> String {
    let mut page = HEAD.to_owned();
    let mut table = "\n| bad input | exit code | first line of the answer |\n|---|---|---|\n".to_owned();
    let mut sections = String::new();
    for case in CASES {
        let (text, code) = answer(case);
        assert_eq!(code, Some(case.code), "{}: {text}", case.command);
        assert!(!text.contains("panicked"), "{text}");
        let first = text.lines().next().unwrap_or("").replace('|', "\\|");
        let anchor: String = case.what.to_lowercase().replace(' ', "-");
        let anchor = anchor.replace(|c: char| !(c.is_alphanumeric() || c == '-' || c == '_'), "");
        writeln!(table, "| [{}](#{anchor}) | {} | {first} |", case.what, case.code).unwrap();
        write!(sections, "\n## {}\n", case.what).unwrap();
        for (name, text) in case.files.iter().filter(|(_, text)| !text.is_empty()) {
            let kind = Path::new(name).extension().unwrap().to_str().unwrap();
            write!(sections, "`{name}`:\n```{kind}\n{}\n```\n", text.trim_end()).unwrap();
        }
        write!(sections, "```console\n$ {}\n{text}```\n", case.command).unwrap();
    }
    page.push_str(&table);
    page.push_str(&sections);
    page
}

#[test]
fn the_page_of_errors_is_what_the_program_says() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/errors.md");
    let page = page();
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, &page).unwrap();
        return;
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    for (new, old) in page.lines().zip(written.lines()) {
        assert_eq!(new, old, "docs/errors.md differs; UPDATE=1 writes it anew");
    }
    assert_eq!(page.lines().count(), written.lines().count(), "docs/errors.md differs; UPDATE=1 writes it anew");
}
