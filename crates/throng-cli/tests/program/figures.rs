//! Scenes with bodies of files: `figure` of a group.

#[path = "../../../throng-record/examples/figure/blocks.rs"]
mod blocks;

use crate::shared::{call, folder, stderr, stdout};
use blocks::{Blocks, Names};
use std::path::Path;

const SCENE: &str = "[[group]]\nname = \"blocks\"\nfigure = \"bodies/person.glb\"\nplace.line = { from = [-3, 0], to = [3, 0] }\ncount = 4\ngoal.point = { at = [0, 12] }\n";

/// Writes the scene into a folder of its own, and its figure.
fn write(folder: &Path, figure: &[u8]) {
    std::fs::create_dir_all(folder.join("scenes/bodies")).unwrap();
    std::fs::write(folder.join("scenes/blocks.toml"), SCENE).unwrap();
    std::fs::write(folder.join("scenes/bodies/person.glb"), figure).unwrap();
}

#[test]
fn pictures_and_files_have_the_bodies_of_groups() {
    let folder = folder();
    let blocks = Blocks { drop: 0.6, names: Names::Blender, turned: true, centimetres: true, ..Blocks::default() };
    write(folder.path(), &blocks.glb());
    let picture = |name: &str| {
        let arguments =
            format!("show scenes/blocks.toml --projection perspective --camera crowd --size 320x240 -o {name}");
        call(folder.path(), &arguments).success();
        std::fs::read(folder.path().join(name)).unwrap()
    };
    let with = picture("with.png");
    call(folder.path(), "check scenes/blocks.toml").success();
    call(folder.path(), "run scenes/blocks.toml --no-expect --duration 8 --rate 25 -o run.glb").success();
    let feet = stdout(&call(folder.path(), "measure run.glb --feet --json").success());
    let feet: serde_json::Value = serde_json::from_str(&feet).unwrap();
    let bytes = std::fs::read(folder.path().join("run.glb")).unwrap();
    assert!(bytes.windows(8).any(|part| part == b"figure 1"));
    std::fs::write(folder.path().join("scenes/blocks.toml"), SCENE.replace("figure =", "# figure =")).unwrap();
    assert_ne!(with, picture("without.png"));
    assert_eq!(feet["people"], 4, "{feet}");
    let slide = |key: &str| feet[key].as_f64().unwrap();
    assert!(slide("mean_slide") < 0.003 && slide("largest_slide") < 0.01 && slide("steps") > 20.0, "{feet}");
}

#[test]
fn wrong_figures_are_errors_at_their_key() {
    let folder = folder();
    let refused = |wanted: &[&str]| {
        for command in ["run", "check", "show"] {
            let message = stderr(&call(folder.path(), &format!("{command} scenes/blocks.toml")).code(2));
            let place = Path::new("scenes").join("blocks.toml");
            assert!(message.starts_with(&format!("error: {}:3:", place.display())), "{message}");
            wanted.iter().for_each(|part| assert!(message.contains(part), "{part:?} is not in:\n{message}"));
        }
    };
    write(folder.path(), b"no figure");
    refused(&[
        "bodies/person.glb: the file does not begin like binary glTF",
        "figure = ",
        "hint: a figure is a .glb file",
    ]);
    let (mut json, bin) = Blocks::default().parts();
    json["nodes"][14]["name"] = "Fuss".into();
    write(folder.path(), &blocks::file::packed(&json, &bin));
    refused(&["missing joints: LeftFoot; the joints of the file: Hips, Spine", "Mixamo"]);
    std::fs::remove_file(folder.path().join("scenes/bodies/person.glb")).unwrap();
    refused(&["there is no file", "person.glb"]);
}
