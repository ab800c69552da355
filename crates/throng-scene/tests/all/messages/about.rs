//! What a file says to viewers: texts, sliders and presets.

use super::assert_message;
use throng_scene::{Error, Kind, Scene};

/// Reads a scene, and checks what it says to viewers.
fn read(text: &str) -> Result<(), Error> {
    Scene::parse("a.toml", text)?.check_about()
}

/// Returns a scene of one agent that says this to viewers from line 6 on.
fn about(lines: &str) -> String {
    format!("[[group]]\nname = \"walkers\"\nplace.point = [0, 0]\nbody.radius = 0.2\n[about]\n{lines}\n")
}

/// Returns a scene with a slider, in line 6.
fn slider(path: &str, min: &str, max: &str) -> String {
    about(&format!("slider = [{{ name = \"size\", path = \"{path}\", min = {min}, max = {max} }}]"))
}

#[test]
fn a_text_is_one_line_of_some_length() {
    assert_message(
        &about("see = \" \""),
        Kind::OutOfRange,
        r#"
a.toml:6:7: about.see is empty
  6 | see = " "
    |       ^^^
  hint: write one line of 1 to 400 characters, or leave the key out"#,
    );
    assert_message(
        &about("why = \"a\\nb\""),
        Kind::OutOfRange,
        r#"
a.toml:6:7: about.why has the control character \n
  6 | why = "a\nb"
    |       ^^^^^^
  hint: write one line of 1 to 400 characters, or leave the key out"#,
    );
    let longest = "ü".repeat(400);
    assert!(read(&about(&format!("see = \"{longest}\""))).is_ok());
    let error = read(&about(&format!("see = \"{longest}.\""))).unwrap_err();
    assert_eq!(error.message, "about.see has 401 characters, but may have at most 400");
    assert_message(
        "description = \"a scene\"",
        Kind::UnknownKey,
        r#"
a.toml:1:1: there is no key `description` here
  1 | description = "a scene"
    | ^^^^^^^^^^^
  hint: its name is `about.see` now"#,
    );
}

#[test]
fn a_slider_changes_a_number_of_the_file() {
    assert_message(
        &slider("group.walkers.body.raduis", "0.1", "0.5"),
        Kind::UnknownKey,
        r#"
a.toml:6:35: there is no number at `group.walkers.body.raduis`
  6 | slider = [{ name = "size", path = "group.walkers.body.raduis", min = 0.1, max = 0.5 }]
    |                                   ^^^^^^^^^^^^^^^^^^^^^^^^^^^
  hint: write the path of a number as for --set: group.walkers.body.radius"#,
    );
    assert_message(
        &slider("group.walkers.name", "0.1", "0.5"),
        Kind::WrongType,
        r#"
a.toml:6:35: `group.walkers.name` is no number: this is the wrong type: the text "walkers", but should be a number
  6 | slider = [{ name = "size", path = "group.walkers.name", min = 0.1, max = 0.5 }]
    |                                   ^^^^^^^^^^^^^^^^^^^^
  hint: write the path of a number as for --set: group.walkers.body.radius"#,
    );
    assert_message(
        &slider("body.radius", "0.5", "0.1"),
        Kind::OutOfRange,
        r#"
a.toml:6:67: about.slider[0].max is 0.1, but must be more than min, 0.5
  6 | slider = [{ name = "size", path = "body.radius", min = 0.5, max = 0.1 }]
    |                                                                   ^^^
  hint: give the least value as `min`"#,
    );
    // the file leaves these out
    for path in ["group.walkers.time_gap", "time_gap", "avoid.rvo.time_horizon"] {
        assert_eq!(read(&slider(path, "0.5", "2")), Ok(()), "{path}");
    }
    for (text, message) in [
        (slider("body.radius", "0.1", "inf"), "about.slider[0].max is inf, but must be a finite number"),
        (slider("group.others.body.radius", "0.1", "1"), "there is no group `others`"),
        (slider("radius", "0.1", "1"), "there is no key `radius` here"),
        (slider("body..radius", "0.1", "1"), "`body..radius` is not a path to a value"),
    ] {
        assert_eq!(read(&text).unwrap_err().message, message);
    }
}

#[test]
fn names_are_unique_and_few() {
    let preset = |name: &str| format!("{{ name = \"{name}\", with = {{ \"body.radius\" = 0.3 }} }}");
    let presets = |names: &[&str]| {
        let all: Vec<String> = names.iter().map(|name| preset(name)).collect();
        about(&format!("preset = [{}]", all.join(", ")))
    };
    let message = |names: &[&str]| read(&presets(names)).map_err(|error| error.message);
    assert!(message(&["1", "2", "3", "4", "5", "6", "7", "8"]).is_ok());
    assert_eq!(
        message(&["1", "2", "3", "4", "5", "6", "7", "8", "9"]),
        Err("there are more than 8 tables `[[about.preset]]`".into())
    );
    assert_eq!(message(&["wide", "wide"]), Err("entries 1 and 2 of `about.preset` are both named `wide`".into()));
    assert_eq!(message(&[""]), Err("about.preset[0].name is empty".into()));
}

#[test]
fn a_preset_gives_a_scene() {
    assert_message(
        &about("preset = [{ name = \"none\", with = {} }]"),
        Kind::MissingKey,
        r#"
a.toml:6:35: the preset `none` changes nothing
  6 | preset = [{ name = "none", with = {} }]
    |                                   ^^
  hint: give it a path and a value: with = { "body.radius" = 0.3 }"#,
    );
    let text = about("preset = [{ name = \"wide\", with = { \"bdy.radius\" = 0.3 } }]");
    let error = read(&text).unwrap_err();
    assert_eq!((error.at, error.message.as_str()), (Some((6, 52)), "there is no key `bdy` here"));
    assert!(error.hint.unwrap().starts_with("did you mean `body`?"));
}
