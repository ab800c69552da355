//! Crowds that cannot be divided are refused, with the group and the reason.

use crate::common::{journey_to, rectangle, with_settings};
use glam::{DVec2, Vec2, Vec3};
use std::sync::Arc;
use throng::agent::Guidance;
use throng::avoid::{AvoidanceInput, Crowd, CrowdModel, LocalModel, Workspace};
use throng::field::{Governed, Interaction};
use throng::halo::{Alone, DividedWorld};
use throng::motion::WrapAround;
use throng::{Agent, Error, Goal, Group, Rules, SubSteps, World};

/// A world without agents.
fn empty() -> World {
    with_settings(0.1, SubSteps::Auto, DVec2::ZERO)
}

/// A group named `odd` that can be divided.
fn odd() -> Group {
    Group { name: "odd".into(), ..Group::default() }
}

fn refusal(world: World) -> String {
    match DividedWorld::new(world, Alone) {
        Err(error @ Error::Undivided { .. }) => error.to_string(),
        Err(other) => panic!("refused for another reason: {other}"),
        Ok(_) => panic!("not refused"),
    }
}

/// Checks that a group with an agent is refused with its name and these words, and without agents is not.
fn assert_refused(group: Group, agent: Agent, words: &str) {
    let mut empty = empty();
    let id = empty.add_group(group).unwrap();
    let mut present = empty.clone();
    let agent = agent.group(id);
    present.add_agent(agent.clone()).unwrap();
    let mut scheduled = empty.clone();
    scheduled.schedule_agent(1.0, agent).unwrap();
    for world in [present, scheduled] {
        let why = refusal(world);
        assert!(why.contains("group `odd`") && why.contains(words), "{why}");
    }
    assert!(DividedWorld::new(empty, Alone).is_ok(), "a group without agents is refused: {words}");
}

#[test]
fn a_plain_group_is_divided() {
    let mut world = empty();
    let group = world.add_group(odd()).unwrap();
    world.add_agent(Agent::at([0.0, 0.0]).goal([5.0, 0.0]).group(group)).unwrap();
    assert!(DividedWorld::new(world, Alone).is_ok());
}

/// A model that chooses for all its agents.
#[derive(Debug)]
struct Together;

impl CrowdModel for Together {
    fn choose(&self, _: &mut Crowd<'_>) {}
}

impl LocalModel for Together {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        view.preferred
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius
    }

    fn together(&self) -> Option<&dyn CrowdModel> {
        Some(self)
    }
}

#[test]
fn properties_of_groups_are_refused() {
    let agent = || Agent::at([0.0, 0.0]);
    let governed = |field: Governed| Group { guidance: Guidance::JOURNEY.governed(field), ..odd() };
    let east = |_: Vec3, _: f64| Vec3::X;
    let mut follows = Governed::new(east, 0.5);
    follows.around.push(Interaction::new(0, east));
    let ball = WrapAround { center: Vec3::ZERO, radius: 9.0 };
    assert_refused(governed(follows), agent(), "give the field a finite reach");
    assert_refused(Group { model: Arc::new(Together), ..odd() }, agent(), "of all its agents together");
    assert_refused(Group { wrap_around: Some(ball), ..odd() }, agent(), "wrap around");
}

#[test]
fn agents_are_refused() {
    let at = || Agent::at([0.0, 0.0]);
    let corners = rectangle(DVec2::new(9.0, 0.0), DVec2::splat(3.0));
    assert_refused(odd(), at().goal(Goal::Area { corners }), "end in an area");
}

/// Rules that do nothing.
#[derive(Debug)]
struct Idle;

impl Rules for Idle {
    fn figures(&self) -> Vec<String> {
        Vec::new()
    }

    fn act(&self, _: &mut World, _: &mut [f64]) -> Result<(), Error> {
        Ok(())
    }
}

#[test]
fn what_concerns_the_whole_world_is_refused() {
    let mut with_rules = empty();
    with_rules.set_rules(Arc::new(Idle)).unwrap();
    assert!(refusal(with_rules).contains("rules see the whole world"));

    let mut with_choice = empty();
    let mut exit = |x: f64| {
        let corners = rectangle(DVec2::new(x, 0.0), DVec2::ONE);
        journey_to(&mut with_choice, Goal::Exit { corners })
    };
    let journeys = [exit(-9.0), exit(9.0)];
    with_choice.add_choice(&journeys).unwrap();
    assert!(refusal(with_choice).contains("choose among goals"));
}

#[test]
fn worlds_that_differ_are_refused() {
    let halos =
        crate::threads::halos(crate::cuts::random_cuts(&mut crate::draw::Draw::new(1), 3, Vec2::NEG_ONE, Vec2::ONE));
    let refusals: Vec<String> = std::thread::scope(|scope| {
        let handles: Vec<_> = halos
            .into_iter()
            .enumerate()
            .map(|(index, halo)| {
                scope.spawn(move || {
                    let mut world = empty();
                    let group = world.add_group(odd()).unwrap();
                    let at = if index == 1 { 1.0 } else { 1.0 + 1e-7 };
                    world.add_agent(Agent::at([at, 0.0]).group(group)).unwrap();
                    DividedWorld::new(world, halo).map(|_| ()).unwrap_err().to_string()
                })
            })
            .collect();
        handles.into_iter().map(|handle| handle.join().unwrap()).collect()
    });
    assert!(refusals.iter().all(|why| why.contains("the worlds differ")), "{refusals:?}");
}
