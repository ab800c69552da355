//! Changes of single values, as with `--set`.

use throng_scene::{Body, DiscPlace, Kind, Number, Scene, SubSteps, gallery};

fn corridor() -> Scene {
    gallery::scene("corridor").unwrap()
}

#[test]
fn a_value_of_the_scene() {
    let mut scene = corridor();
    scene.set("time.step", "0.1").unwrap();
    scene.set("time.sub_steps", "4").unwrap();
    scene.set("time.until", "limit").unwrap();
    assert_eq!((scene.time.step, scene.time.sub_steps), (0.1, SubSteps::Fixed(4)));
    assert_eq!(scene.time.until, throng_scene::Until::Limit);
}

#[test]
fn a_value_of_every_group() {
    let mut scene = corridor();
    scene.set("avoid.orca.time_horizon", "3").unwrap();
    for group in &scene.groups {
        let avoid = group.avoid.as_ref().unwrap();
        assert_eq!((avoid.name.as_str(), avoid.parameters["time_horizon"].as_integer()), ("orca", Some(3)));
    }
}

#[test]
fn a_value_of_one_group_by_name_or_number() {
    let mut scene = corridor();
    scene.set("groups.eastward.body.radius", "0.25").unwrap();
    scene.set("group.1.body.radius", "{ uniform = [0.2, 0.3] }").unwrap();
    assert_eq!(scene.groups[0].body, Body::Radius(Number::Constant(0.25)));
    assert_eq!(scene.groups[1].body, Body::Radius(Number::Uniform([0.2, 0.3])));
}

#[test]
fn another_choice_replaces_the_old_one() {
    let mut scene = gallery::scene("circle").unwrap();
    scene.set("group.walkers.place.disc.radius", "9").unwrap();
    assert_eq!(scene.groups[0].place.read().map(|disc: DiscPlace| disc.radius), Some(9.0));
    scene.set("speed.preferred.uniform", "[1, 1.5]").unwrap();
    assert_eq!(scene.groups[0].speed.preferred, Number::Uniform([1.0, 1.5]));
}

#[test]
fn an_obstacle_by_name() {
    let mut scene = gallery::scene("box").unwrap();
    scene.set("obstacle.middle.as", "circle").unwrap();
    scene.set("obstacle.middle.shape.rectangle.rotation", "0").unwrap();
    assert!(matches!(scene.plan().unwrap().obstacles[0], throng::Obstacle::Circle { .. }));
}

#[test]
fn an_entry_of_a_list_of_lists() {
    let mut scene = gallery::scene("bottleneck").unwrap();
    scene.set("walkable.polygon.outer.2.1", "-0.9").unwrap();
    assert_eq!(scene.plan().unwrap().walkable[0].outer[2].y, -0.9);
    let mut message = |path: &str| scene.set(path, "1").unwrap_err().to_string();
    assert_eq!(
        message("walkable.polygon.outer.12.1"),
        "--set walkable.polygon.outer.12.1=1: `12` is no entry of the list here\n  hint: its entries are 0 to 11"
    );
    assert!(message("walkable.polygon.outer.2.1.x").contains("the entry `1` of the list here has no keys"));
    assert!(message("walkable.polygon.outer.first").contains("`first` is no entry of the list here"));
}

#[test]
fn changes_add_up_with_changes_in_code() {
    let mut scene = corridor();
    scene.set("seed", "9").unwrap();
    scene.groups[0].count = Some(7);
    scene.set("time.limit", "10").unwrap();
    assert_eq!((scene.seed, scene.groups[0].count, scene.time.limit), (9, Some(7), 10.0));
}

#[test]
fn mistakes_are_named_with_what_there_is() {
    let mut scene = corridor();
    let before = scene.clone();
    let mut message = |path: &str, value: &str| scene.set(path, value).unwrap_err().to_string();
    assert_eq!(
        message("avoid.orca.time_horizn", "3"),
        "--set avoid.orca.time_horizn=3: there is no key `time_horizn` here\n  hint: did you mean `time_horizon`? the \
         keys here are: time_horizon, time_horizon_obstacles, turning_bias, built_from, neighbours, neighbour_distance"
    );
    assert_eq!(
        message("group.lost.count", "3"),
        "--set group.lost.count=3: there is no group `lost`\n  hint: there is: eastward, westward"
    );
    assert_eq!(
        message("time.step", "soon"),
        "--set time.step=\"soon\": this is the wrong type: the text \"soon\", but should be a number\n  \
         hint: `step`: Seconds from one output to the next. Limit: 0.00001 to 10. Default: 0.04."
    );
    let unknown = message("radius", "3");
    assert!(
        unknown.starts_with("--set radius=3: there is no key `radius` here\n  hint: the keys here are: title"),
        "{unknown}"
    );
    assert!(message("group.eastward.bdy.radius", "1").contains("did you mean `body`?"));
    assert!(message("group.eastward", "1").contains("add one of its keys"));
    assert!(message("time..step", "1").contains("is not a path"));
    assert!(message("time.step.x", "1").contains("this is the wrong type: a table"));
    assert_eq!(scene, before);
}

#[test]
fn a_value_out_of_range_is_blamed_on_the_setting() {
    let mut scene = corridor();
    scene.set("body.radius", "-1").unwrap();
    let error = scene.plan().unwrap_err();
    assert_eq!(error.kind, Kind::OutOfRange);
    assert_eq!(
        error.to_string(),
        "--set body.radius=-1: group `eastward`: body.radius is -1, but must be more than 0 and at most 1000\n  \
         hint: `radius`: A disc of this radius, metres. Limit: > 0, at most 1000."
    );
}
