//! README.md and the pages of docs/: their commands run, their links lead to pages and headings, and docs/SUMMARY.md
//! lists every page once.
//!
//! A block of ```sh is run, all blocks of a page in one folder. A block that cannot run in a test is ```sh,no_run. A
//! block of ```toml or ```toml,no_run after a line that ends with "`NAME`:" is the file NAME of the folder.

use crate::shared::{anchor, call, folder, stdout};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

/// The pages with blocks of ```sh,no_run, how many, and why they cannot run in a test.
const SKIPPED: &[(&str, usize, &str)] = &[
    ("README.md", 1, "cargo"),
    ("blender.md", 2, "Blender, cargo"),
    ("compare.md", 2, "minutes, the Python package"),
    ("flocks.md", 1, "cargo, minutes"),
    ("gallery.md", 1, "minutes"),
    ("machines.md", 4, "cargo, MPI"),
    ("papers.md", 3, "minutes"),
    ("peers.md", 1, "the network, minutes"),
    ("performance.md", 1, "cargo, minutes"),
    ("pictures.md", 1, "minutes"),
    ("plugins.md", 2, "cargo, a web build"),
    ("python.md", 2, "cargo, the network"),
    ("quality.md", 1, "cargo, minutes"),
    ("replay.md", 1, "recordings that are not part of the project"),
    ("showing.md", 1, "minutes"),
    ("start.md", 1, "cargo"),
    ("studio.md", 1, "a window"),
    ("sweeps.md", 2, "minutes"),
    ("trajectories.md", 1, "programs of other projects"),
    ("validation.md", 1, "minutes"),
];

/// Generated pages: other tests compare them with the program.
const GENERATED: [&str; 3] = ["commands.md", "errors.md", "scene-format.md"];

/// The languages of blocks that contain no commands. Tests of throng-scene compile the blocks of `rust,ignore`.
const OTHER: [&str; 7] = ["toml", "toml,no_run", "rust", "rust,ignore", "text", "python", "html"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// A page: its path from the root, and its text.
struct Page {
    path: String,
    text: String,
}

impl Page {
    fn name(&self) -> &str {
        self.path.strip_prefix("docs/").unwrap_or(&self.path)
    }

    /// Returns (line of the fence, info string, text, the line before) of every fenced block.
    fn blocks(&self) -> Vec<(usize, &str, String, &str)> {
        let lines: Vec<&str> = self.text.lines().collect();
        let fences: Vec<usize> = (0..lines.len()).filter(|&line| lines[line].starts_with("```")).collect();
        assert!(fences.len().is_multiple_of(2), "{}: a block is not closed", self.path);
        let block = |pair: &[usize]| {
            let before = lines[..pair[0]].iter().rev().find(|line| !line.is_empty());
            let text: String = lines[pair[0] + 1..pair[1]].iter().flat_map(|line| [line, "\n"]).collect();
            (pair[0] + 1, &lines[pair[0]][3..], text, *before.unwrap_or(&""))
        };
        fences.chunks(2).map(block).collect()
    }

    /// Returns the text without blocks.
    fn prose(&self) -> String {
        let parts = self.text.split("\n```").step_by(2);
        // a part after a block begins with the rest of the closing fence
        parts.map(|part| format!("{part}\n")).collect()
    }

    /// Returns the anchors of the headings, and those that the page sets.
    fn anchors(&self) -> Vec<String> {
        let prose = self.prose();
        let headings = prose.lines().filter(|line| line.starts_with('#'));
        let headings = headings.map(|line| anchor(line.trim_start_matches('#').trim()));
        let set = prose.split("<a id=\"").skip(1).filter_map(|rest| rest.split('"').next()).map(str::to_owned);
        headings.chain(set).collect()
    }
}

/// Returns README.md and all pages of docs/.
fn pages() -> Vec<Page> {
    let root = root();
    let docs = std::fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().file_name());
    let mut paths: Vec<String> = docs.map(|name| format!("docs/{}", name.to_str().unwrap())).collect();
    paths.retain(|path| Path::new(path).extension().is_some_and(|ending| ending == "md"));
    paths.push("README.md".into());
    paths.sort();
    let read = |path: String| Page { text: std::fs::read_to_string(root.join(&path)).unwrap(), path };
    paths.into_iter().map(read).collect()
}

/// Returns two opposite streams in a corridor, 25 frames per second: rows of (person, frame, x, y).
fn streams() -> Vec<(u32, u32, f64, f64)> {
    let person = |number: u32| {
        let (way, lane) = (if number.is_multiple_of(2) { 1.0 } else { -1.0 }, f64::from(number % 4) - 1.5);
        (0..150).map(move |frame| (number, frame + 20 * (number / 2), way * (0.05 * f64::from(frame) - 4.0), lane))
    };
    (0..12).flat_map(person).collect()
}

/// Writes the files that the commands of the pages read: plans and scenarios of the fuzzer's corpus, invented
/// recordings, and a scene and its run.
fn write_files(folder: &Path) {
    let corpus = root().join("crates/throng-fuzz/corpus");
    for (from, names) in [
        ("dxf/room.dxf", &["plan.dxf", "hall.dxf"][..]),
        ("svg/shapes.svg", &["hall.svg"]),
        ("obj/ground.obj", &["mesh.obj"]),
        ("jupedsim-zip/corridor.zip", &["scenario.zip"]),
    ] {
        for name in names {
            std::fs::copy(corpus.join(from), folder.join(name)).unwrap();
        }
    }
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    // a Menge project of several files, each after a line with its name
    let menge = std::fs::read_to_string(corpus.join("menge/walk.txt")).unwrap();
    for (name, text) in menge.split("--- ").skip(1).filter_map(|part| part.split_once('\n')) {
        write(&name.trim().replacen("it", "office", 1), &text.replace("it.nav", "office.nav"));
    }
    write("plan.wkt", "POLYGON ((0 0, 10 0, 10 8, 0 8, 0 0))");
    write("hall.wkt", "POLYGON ((-10 -5, 10 -5, 10 5, -10 5, -10 -5))");
    for name in ["my-scene.toml", "plan.toml"] {
        std::fs::copy(root().join("scenes/headon.toml"), folder.join(name)).unwrap();
    }
    let (mut metres, mut centimetres) = ("# framerate: 25\n# id frame x/m y/m\n".to_owned(), String::new());
    let (mut table, mut frames) = ("number,time,x,y\n".to_owned(), "ID,Frame,x,y\n".to_owned());
    let mut obsmat = vec![];
    for (number, frame, x, y) in streams() {
        let (time, id) = (f64::from(frame) / 25.0, number + 1);
        writeln!(metres, "{id} {frame} {x:.4} {y:.4} 1.7").unwrap();
        writeln!(centimetres, "{id} {frame} {:.2} {:.2} 170", 100.0 * x, 100.0 * y).unwrap();
        writeln!(table, "{number},{time:.2},{x:.4},{y:.4}").unwrap();
        writeln!(frames, "{number},{frame},{x:.4},{y:.4}").unwrap();
        let way = if number.is_multiple_of(2) { 1.25 } else { -1.25 };
        obsmat.push((frame, format!("{frame} {id} {x:.4} 0 {y:.4} {way} 0 0\n")));
    }
    obsmat.sort();
    let centimetres = format!("# framerate: 25\n{centimetres}");
    for name in ["people.txt", "bi_corr.txt", "AO_300_bottleneck.txt", "traj_UNI_CORR_500_01.txt"] {
        write(name, &metres);
    }
    write("hall.txt", &centimetres);
    write("hall.csv", &table);
    write("n34_cam2.csv", &frames);
    let obsmat: String = obsmat.into_iter().map(|(_, line)| line).collect();
    write("obsmat.txt", &obsmat);
    for name in ["docs/replay", "zara01"] {
        std::fs::create_dir_all(folder.join(name)).unwrap();
    }
    write("zara01/obsmat.txt", &obsmat);
    std::fs::copy(corpus.join("map/room.xml"), folder.join("zara01/map.xml")).unwrap();
    std::fs::copy(root().join("docs/replay/corridor.wkt"), folder.join("docs/replay/corridor.wkt")).unwrap();
    call(folder, "run headon -o run.csv -o run.rec -q --rate 5").success();
}

/// Runs the commands of a page. Returns the first failure.
fn run(page: &Page) -> Result<(), String> {
    let mut skipped = 0;
    let mut place = None;
    for (line, info, text, before) in page.blocks() {
        let at = format!("{}:{line}", page.path);
        match info {
            "sh" => {}
            "sh,no_run" => {
                skipped += 1;
                continue;
            }
            "toml" | "toml,no_run" if before.ends_with("`:") => {}
            _ if OTHER.contains(&info) => continue,
            _ => return Err(format!("{at}: the language `{info}` is not one of sh; sh,no_run; {}", OTHER.join("; "))),
        }
        let folder = place.get_or_insert_with(|| {
            let place = folder();
            write_files(place.path());
            place
        });
        if info.starts_with("toml") {
            let name = before.trim_end_matches("`:").rsplit('`').next().unwrap();
            std::fs::write(folder.path().join(name), text).unwrap();
            continue;
        }
        let program = Path::new(env!("CARGO_BIN_EXE_throng")).parent().unwrap();
        let output = Command::new("bash")
            .args(["-euo", "pipefail", "-c", &text])
            .current_dir(folder.path())
            .env("PATH", format!("{}:/usr/bin:/bin", program.display()))
            .output()
            .unwrap();
        if !output.status.success() {
            let errors = String::from_utf8_lossy(&output.stderr);
            return Err(format!("{at}: {}\n{text}{errors}", output.status));
        }
    }
    let expected = SKIPPED.iter().find(|(name, ..)| *name == page.name()).map_or(0, |(_, count, _)| *count);
    if skipped != expected {
        return Err(format!("{}: {skipped} blocks of sh,no_run, and not {expected} as in SKIPPED", page.path));
    }
    Ok(())
}

#[test]
fn the_commands_of_the_pages_run() {
    let pages: Vec<Page> = pages().into_iter().filter(|page| !GENERATED.contains(&page.name())).collect();
    for (name, ..) in SKIPPED {
        assert!(pages.iter().any(|page| page.name() == *name), "SKIPPED names {name}, which does not exist");
    }
    let (left, failures) = (Mutex::new(pages.iter()), Mutex::new(vec![]));
    let work = || {
        while let Some(page) = { left.lock().unwrap().next() } {
            if let Err(failure) = run(page) {
                failures.lock().unwrap().push(failure);
            }
        }
    };
    std::thread::scope(|scope| (0..2).for_each(|_| drop(scope.spawn(work))));
    let failures = failures.into_inner().unwrap();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Returns the targets of the links and pictures of a text.
fn links(text: &str) -> Vec<&str> {
    let mut links: Vec<&str> = text.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    links.retain(|link| !(link.starts_with("http://") || link.starts_with("https://") || link.starts_with("mailto:")));
    links
}

#[test]
fn the_links_of_the_pages_lead_somewhere() {
    let root = root();
    let mut pages = pages();
    for path in ["ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md"] {
        pages.push(Page { text: std::fs::read_to_string(root.join(path)).unwrap(), path: path.into() });
    }
    let mut dead = vec![];
    for page in &pages {
        let folder = Path::new(&page.path).parent().unwrap();
        let prose = page.prose();
        for link in links(&prose) {
            let (path, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = if path.is_empty() { root.join(&page.path) } else { root.join(folder).join(path) };
            let other =
                pages.iter().find(|page| target.canonicalize().ok() == root.join(&page.path).canonicalize().ok());
            let leads = match other {
                Some(other) => heading.is_empty() || other.anchors().iter().any(|anchor| anchor == heading),
                None => target.exists() && heading.is_empty(),
            };
            if !leads {
                dead.push(format!("{}: {link}", page.path));
            }
        }
    }
    assert!(dead.is_empty(), "links that lead nowhere:\n{}", dead.join("\n"));
}

#[test]
fn the_summary_lists_every_page_once() {
    let pages = pages();
    let summary = pages.iter().find(|page| page.name() == "SUMMARY.md").unwrap();
    let mut listed = links(&summary.text);
    let mut written: Vec<&str> = pages.iter().filter(|page| page.path.starts_with("docs/")).map(Page::name).collect();
    written.retain(|name| *name != "SUMMARY.md");
    listed.sort_unstable();
    written.sort_unstable();
    assert_eq!(listed, written, "docs/SUMMARY.md (left) and the pages of docs/ (right)");
}

#[test]
fn the_page_of_the_gallery_lists_every_scene() {
    let pages = pages();
    let page = pages.iter().find(|page| page.name() == "gallery.md").unwrap();
    let names = stdout(&call(folder().path(), "list --names").success());
    let missing: Vec<&str> = names.lines().filter(|name| !page.text.contains(&format!("`{name}`"))).collect();
    assert!(missing.is_empty(), "docs/gallery.md lacks {missing:?}");
}
