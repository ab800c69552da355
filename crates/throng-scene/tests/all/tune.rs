//! Scenes that change into others while their worlds run.

use throng::AgentRef;
use throng_scene::{Avoid, Number, Scene, gallery};

fn avoid(text: &str) -> Option<Avoid> {
    Some(toml::from_str(text).unwrap())
}

/// The oracle is a world that was built from the other scene and loaded the state.
#[test]
fn a_world_goes_on_as_the_other_scene_says() {
    for (name, model) in [("circle", "hrvo = {}"), ("crossing", "orca = { time_horizon = 0.7 }"), ("headon", "vo = {}")]
    {
        let scene = gallery::scene(name).unwrap();
        let (mut world, mut built) = scene.build().unwrap();
        (0..40).for_each(|_| world.step());
        let mut other = scene.clone();
        for group in &mut other.groups {
            group.avoid = avoid(model);
            group.resolve = Some(false);
        }
        let (mut always, _) = other.build().unwrap();
        always.load(&world.save()).unwrap();
        assert!(other.tune(&scene, &mut world, &mut built).unwrap(), "{name}");
        for _ in 0..60 {
            world.step();
            always.step();
        }
        assert_eq!(world.state_hash(), always.state_hash(), "{name}");
    }
}

#[test]
fn people_have_the_speeds_that_they_would_have_been_given() {
    let mut scene = gallery::scene("circle").unwrap();
    scene.groups[0].speed.preferred = Number::Uniform([0.8, 1.2]);
    let (mut world, mut built) = scene.build().unwrap();
    world.step();
    let mut other = scene.clone();
    other.groups[0].speed.preferred = Number::Uniform([1.3, 1.5]);
    let (expected, _) = other.build().unwrap();
    assert!(other.tune(&scene, &mut world, &mut built).unwrap());
    for id in world.agent_ids() {
        let number = world.relative_columns().number[world.row(id).unwrap()] as usize;
        let wanted = expected.agent(expected.agent_ids()[number]).map(AgentRef::to_agent).unwrap().preferred_speed;
        assert_eq!(world.agent(id).map(AgentRef::to_agent).unwrap().preferred_speed, wanted);
    }
}

#[test]
fn another_look_leaves_the_world_as_it_is() {
    let scene = gallery::scene("circle").unwrap();
    let (mut world, mut built) = scene.build().unwrap();
    world.step();
    // the world is no longer what the scene says
    world.adjust(|_, agent| agent.preferred_speed = 0.7).unwrap();
    let hash = world.state_hash();
    let mut other = scene.clone();
    other.view.camera = Some(toml::from_str("keys = [{ time = 1, eye = [0, -9, 5], target = [0, 0, 0] }]").unwrap());
    assert!(other.has_the_world_of(&scene) && other.tune(&scene, &mut world, &mut built).unwrap());
    assert_eq!(world.state_hash(), hash);
    other.groups[0].guard = Some(false);
    assert!(!other.has_the_world_of(&scene));
}

#[test]
fn other_places_need_another_world() {
    let scene = gallery::scene("circle").unwrap();
    let (mut world, mut built) = scene.build().unwrap();
    let hash = world.state_hash();
    let changes: [fn(&mut Scene); 4] = [
        |scene| scene.seed += 1,
        |scene| scene.groups[0].count = Some(12),
        |scene| scene.groups.push(scene.groups[0].clone()),
        |scene| scene.time.step *= 0.5,
    ];
    for change in changes {
        let mut other = scene.clone();
        change(&mut other);
        assert!(!other.tune(&scene, &mut world, &mut built).unwrap());
    }
    assert_eq!(world.state_hash(), hash);
}
