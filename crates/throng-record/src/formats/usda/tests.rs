//! Tests of what is particular to USD; the tests of all formats are in `formats/tests`.

use super::{FORMAT, figures, layer};
use crate::formats::{FormatFlaw, Reading};
use crate::people::FigureStyle;
use crate::people::samples::{self, assert_feet_stand, hard, planned, seldom, walkers};
use crate::trajectories::Trajectories;
use crate::{Body, Choice, Frame, Output, Setting};
use glam::{DVec2, DVec3, Quat, Vec3};
use throng::motion::Basis;

/// A file as other programs write it, with syntax that throng does not write.
const THEIRS: &str = r##"#usda 1.0
(
    "a note"
    customLayerData = {
        string a = "}}}" # not the end
    }
    doc = """made
of "all" ]"""
    metersPerUnit = 0.5
    timeCodesPerSecond = 10
    upAxis = "Z"
    subLayers = [@./a(b.usda@]
)

over "Other" (
    prepend references = @x.usda@</Y>
)
{
    reorder nameChildren = ["A", "B"]
}

def Scope "Top" {
    custom string[] throng:groups = ["a", 'b "c"']
    double3 xformOp:translate = (1, 2, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    variantSet "v" = {
        "one" {
            def PointInstancer "No" {}
        }
    }

    def PointInstancer "People"
    {
        int[] protoIndices = [1, 0]
        point3f[] positions
        point3f[] positions.timeSamples = {
            0: [(0, 0, 0), (10, 0, 0)],
            2.5: [
                (1, 0, 0),
                (10, 1, 0),
            ],
        }
        int64[] invisibleIds.timeSamples = { 0: [1], 2.5: [] }
        rel prototypes = [<A>, <B>] ( customData = { int a = 1 } )
        quatf[] orientations = [(0.70710678, 0, 0, 0.70710678), (1, 0, 0, 0)]; float[] x = [1]
    }
}
"##;

fn read(text: &str) -> Result<Trajectories, FormatFlaw> {
    FORMAT.reader().unwrap()(text.as_bytes(), &Reading::default())
}

#[test]
fn files_of_other_programs_are_read() {
    let tracks = read(THEIRS).unwrap();
    let found: Vec<_> = tracks.spots.iter().map(|spot| (spot.time, spot.number, spot.place)).collect();
    let at = |x: f64, y: f64| DVec3::new(x, y, 1.5);
    assert_eq!(found, [(0.0, 0, at(0.5, 1.0)), (0.25, 0, at(1.0, 1.0)), (0.25, 1, at(5.5, 1.5))]);
    assert_eq!(tracks.spots[1].velocity, Vec3::X * 2.0);
    assert!((tracks.spots[0].heading - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
    let groups: Vec<_> = tracks.spots.iter().map(|spot| tracks.setting.groups[spot.group as usize].as_str()).collect();
    assert_eq!(groups, ["b \"c\"", "b \"c\"", "a"]);
}

#[test]
fn errors_name_their_line() {
    let wrong = |from: &str, to: &str| {
        assert!(THEIRS.contains(from), "{from}");
        let flaw = read(&THEIRS.replacen(from, to, 1)).unwrap_err();
        (flaw.line.unwrap(), flaw.why)
    };
    assert_eq!(wrong("(10, 0, 0)]", "(ten, 0, 0)]"), (37, "`ten` is no number".to_owned()));
    assert_eq!(wrong(", (10, 0, 0)]", "]"), (37, "the list has 1 values, but there are 2 ids".to_owned()));
    assert_eq!(wrong("[(0, 0, 0), (10, 0, 0)]", "None"), (37, "`None` is no number".to_owned()));
    assert_eq!(wrong("= \"Z\"", "= \"Y\""), (11, "\"Y\" is up, but only stages with z up are supported".to_owned()));
    assert_eq!(
        wrong("2.5: [\n", "-1: [\n"),
        (38, "a time code is missing, or not later than the one before".to_owned())
    );
    assert_eq!(wrong("[1, 0]", "[1, 0, 2]").1, "the list has 2 values, but there are 3 ids");
    assert_eq!(wrong("[1, 0]", "[1, 0.5]").1, "0.5 is not a whole number from 0");
    assert_eq!(wrong("PointInstancer \"People\"", "Xform \"People\"").1, "there is no PointInstancer");
    assert_eq!(
        wrong("xformOp:translate = (1, 2, 3)", "xformOp:scale = (1, 2, 3)").1,
        "xformOp:scale is not supported, only constant translations"
    );
    assert_eq!(wrong("0: [1], 2.5: [] }", "0: [1), 2.5: [] }").1, "a bracket closes none that is open");
    assert_eq!(wrong("= 0.5", "= 0").1, "the value is 0, but must be more than 0");
    assert_eq!(wrong("#usda", "#sdf").1, "the file does not begin with #usda 1.0");
    let deep = format!("#usda 1.0\n{}", "def \"A\" {\n".repeat(1000));
    assert_eq!(read(&deep).unwrap_err().why, "prims are nested too deeply");
    assert!(FORMAT.reader().unwrap()(b"#usda 1.0\n\xff", &Reading::default()).unwrap_err().why.contains("not text"));
}

#[test]
fn flying_agents_keep_their_whole_rotation() {
    let basis = Basis::default().turned_to(Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 1.0, 1.0));
    let body = Body { basis: Some(basis), heading: basis.heading(), ..Body::walking(7, DVec2::ZERO) };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.usda");
    let setting = Setting { in_space: true, ..Setting::default() };
    let mut writer = FORMAT.create(Output::create(&path).unwrap(), &setting, &Choice::default()).unwrap().unwrap();
    writer.push(&Frame { bodies: vec![body], ..Frame::default() }).unwrap();
    writer.finish().unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    let stage = layer::parse(&text).unwrap();
    let agents = stage.children[0].children.iter().find(|prim| prim.kind == "PointInstancer").unwrap();
    let turn = agents.attribute("orientations").unwrap().samples[0].1.numbers(4).unwrap();
    let [w, x, y, z] = turn[..] else { panic!("{turn:?}") };
    let turn = Quat::from_xyzw(x as f32, y as f32, z as f32, w as f32).normalize();
    assert!(turn.angle_between(basis.rotation()) < 0.01f32.to_radians());
}

/// Returns the bytes of a file with people of a style.
fn people(frames: &[Frame], figures: FigureStyle) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.usda");
    samples::write(&path, &Setting::default(), &Choice { figures, ..Choice::default() }, frames).unwrap();
    std::fs::read(path).unwrap()
}

#[test]
fn joints_of_a_file_are_those_of_the_walk() {
    let frames = walkers();
    let found = figures::read(&people(&frames, FigureStyle::Auto)).unwrap();
    assert_eq!((found.all.len(), (found.period * 1e3).round()), (3, 40.0));
    assert_feet_stand(&found);
    for figure in &found.all {
        for (time, want) in planned(figure, figure.number, &frames) {
            for (found, want) in figure.joints(time).unwrap().iter().zip(&want) {
                assert!(found.position.distance(want.position) < 1e-4, "{time}: {found:?} {want:?}");
                assert!(found.rotation.angle_between(want.rotation) < 1e-4, "{time}: {found:?} {want:?}");
            }
        }
    }
}

/// A body of a file is in the stage once, with all joints of its vertices, and its people walk on its legs.
#[cfg(feature = "glb")]
#[test]
fn bodies_from_files_are_written_and_walk() {
    let dressed = samples::Dressed::new();
    let text = String::from_utf8(dressed.written("run.usda")).unwrap();
    assert_eq!(text.matches("def SkelRoot \"figure_1\"").count(), 1);
    assert_eq!(text.matches("prepend references = </World/People/Bodies/figure_1_0>").count(), 1);
    let found = figures::read(text.as_bytes()).unwrap();
    let figure = found.all.iter().find(|figure| figure.number == 1).unwrap();
    assert!(figure.person.legs == dressed.walk.person().legs && figure.person.height == dressed.body.height());
    dressed.assert_walks(figure, 3.0, 1e-4);
    let wrong = text.replace("custom double[] throng:legs = [", "custom double[] throng:legs = [1, ");
    assert!(figures::read(wrong.as_bytes()).unwrap_err().why.contains("legs have 8 lengths"));
}

/// Skeletons change nothing of what is read of the agents.
#[test]
fn joints_are_no_agents() {
    for frames in hard().into_iter().chain([walkers()]) {
        let [with, without] = [FigureStyle::Skins, FigureStyle::None].map(|style| people(&frames, style));
        let [mut with, without] =
            [with, without].map(|bytes| FORMAT.reader().unwrap()(&bytes, &Reading::default()).unwrap());
        // moments that were added for poses
        with.spots.retain(|spot| frames.iter().any(|frame| frame.time == spot.time));
        assert_eq!(with, without);
        assert_eq!(with.spots.len(), frames.iter().map(|frame| frame.bodies.len()).sum::<usize>());
    }
}

#[test]
fn people_are_invisible_while_they_are_away() {
    for frames in hard() {
        let found = figures::read(&people(&frames, FigureStyle::Auto)).unwrap();
        for figure in &found.all {
            for frame in &frames {
                let there = frame.bodies.iter().any(|body| body.number == figure.number);
                let joints = figure.joints(frame.time + 1e-6);
                assert_eq!(joints.is_some(), there, "{} at {}", figure.number, frame.time);
                let joints = joints.into_iter().flatten();
                assert!(joints.into_iter().all(|joint| joint.position.is_finite() && joint.rotation.is_finite()));
            }
        }
    }
}

#[test]
fn damaged_people_are_errors() {
    let text = String::from_utf8(people(&walkers()[..3], FigureStyle::Auto)).unwrap();
    let flaw = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        figures::read(text.replacen(from, to, 1).as_bytes()).unwrap_err().why
    };
    let last = text.rfind("uniform token[] joints").unwrap();
    let lost = text[..last].to_owned() + &text[last..].replacen("LeftFoot\"", "LeftPaw\"", 1);
    assert_eq!(figures::read(lost.as_bytes()).unwrap_err().why, "the SkelRoot Agent_2 has no joint LeftFoot");
    assert_eq!(flaw("int64 throng:number", "int64 throng:nummer"), "the SkelRoot Agent_0 has no throng:number");
    assert_eq!(
        flaw("throng:build = \"", "throng:build = \"giant"),
        "the SkelRoot Agent_0 has no throng:build of woman, man or child"
    );
    assert_eq!(flaw("76: [(1, 0, 0, 0), ", "76: ["), "there are 72 numbers where 76 are expected");
    assert!(figures::read(&people(&walkers()[..3], FigureStyle::None)).unwrap_err().why.contains("no SkelRoot"));
    for end in (0..text.len()).step_by(1009) {
        assert!(figures::read(&text.as_bytes()[..end]).is_err(), "{end} of {} bytes", text.len());
    }
}

/// A recording of 2.5 frames a second gets poses in between.
#[test]
fn people_of_a_coarse_recording_stand_on_planted_feet() {
    let found = figures::read(&people(&seldom(&walkers(), 10), FigureStyle::Auto)).unwrap();
    assert_eq!((found.all.len(), (found.period * 1e3).round()), (3, 20.0));
    assert_feet_stand(&found);
}
