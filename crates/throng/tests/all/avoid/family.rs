//! Differences and common properties of the models.

use crate::avoid::common::{choose, grid, other, vector};
use glam::Vec2;
use proptest::prelude::*;
use std::sync::Arc;
use throng::avoid::{Avo, ClearPath, Hrvo, LocalModel, NoAvoidance, Orca, Rvo, Vo, time_to_disc};
use throng::motion::Holonomic;
use throng::{Agent, Goal, Group, Journey, Settings, Stop, SubSteps, World};

proptest! {
    /// A free preferred velocity is chosen as it is; otherwise the nearest free velocity, by a dense search.
    #[test]
    fn vo_takes_the_nearest_free_velocity(
        all in prop::collection::vec((vector(5.0), vector(1.5)), 1..6), preferred in vector(1.4),
    ) {
        prop_assume!(all.iter().all(|(offset, _)| offset.length() > 0.5));
        let preferred = preferred.clamp_length_max(1.499);
        let vo = Vo::default();
        let neighbours: Vec<_> = all.iter().map(|&(offset, velocity)| other(offset, velocity, 0.4, 0.3)).collect();
        let chosen = choose(&vo, Vec2::ZERO, preferred, &neighbours);
        let time = |v: Vec2| all.iter().map(|&(x, u)| time_to_disc(x, v - u, 0.4)).fold(f32::INFINITY, f32::min);
        let best = grid(1.5)
            .filter(|&v| time(v) >= vo.time_horizon)
            .map(|v| v.distance(preferred))
            .fold(f32::INFINITY, f32::min);
        if time(preferred) >= vo.time_horizon * 1.001 {
            prop_assert_eq!(chosen, preferred);
        } else if best.is_finite() {
            // along a leg of a cone the choice touches, within rounding
            let slim = |(x, u): &(Vec2, Vec2)| time_to_disc(*x, chosen - *u, 0.4 * 0.998);
            let time = all.iter().map(slim).fold(f32::INFINITY, f32::min);
            prop_assert!(time >= vo.time_horizon * 0.99, "{chosen} is doomed: {time}");
            prop_assert!(chosen.distance(preferred) <= best + 1e-3);
        }
    }

    /// An agent without neighbours has its preferred velocity, with every model.
    #[test]
    fn without_neighbours_there_is_no_avoidance(velocity in vector(1.5), preferred in vector(1.05)) {
        let models: [&dyn LocalModel; 6] = [
            &Vo::default(), &Rvo::default(), &Hrvo::default(), &ClearPath::default(), &Orca::default(), &NoAvoidance,
        ];
        for model in models {
            prop_assert_eq!(choose(model, velocity, preferred, &[]), preferred, "{:?}", model);
        }
        // AVO's relaxation is part of the model
        let avo = Avo::default();
        let expected = velocity + (preferred - velocity) * (1.0 - (-0.02 / avo.delay).exp());
        prop_assert!(choose(&avo, velocity, preferred, &[]).distance(expected) < 1e-5);
    }
}

/// Two agents that meet a little off the head-on line, with their models only: the total change of their headings,
/// radians.
fn turning(model: Arc<dyn LocalModel>) -> Result<f64, throng::Error> {
    // every velocity is seen: one that changes in every sub-step and back is missed by steps of an even number of them
    let settings = Settings { step: 0.01, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
    let mut world = World::new(settings)?;
    let group = world.add_group(Group { model, look_ahead: false, keep_right: 0.0, ..Group::default() })?;
    for side in [-1.0, 1.0] {
        let goal = world.add_goal(Goal::Point { at: glam::DVec2::new(5.0 * side, 0.05 * side), tolerance: 0.1 })?;
        let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false })?;
        let position = glam::DVec2::new(-5.0 * side, 0.05 * side);
        let agent = Agent {
            position: position.extend(0.0),
            group,
            journey,
            motor: Holonomic { max_acceleration: 1000.0, ..Holonomic::default() }.into(),
            ..Agent::default()
        };
        world.add_agent(agent)?;
    }
    let mut turned = 0.0;
    while !world.finished() && world.time() < 60.0 {
        let before = world.relative_columns().velocity.clone();
        world.step();
        let turns =
            before.iter().zip(&world.relative_columns().velocity).filter(|(a, b)| a.length() > 0.5 && b.length() > 0.5);
        turned += turns.map(|(a, b)| f64::from(a.angle_to(*b).abs())).sum::<f64>();
    }
    assert!(world.finished());
    Ok(turned)
}

/// The reason for reciprocal velocity obstacles (van den Berg, Lin, Manocha, ICRA 2008, section III).
#[test]
fn vo_oscillates_and_rvo_does_not() -> Result<(), throng::Error> {
    let (vo, rvo) = (turning(Arc::new(Vo::default()))?, turning(Arc::new(Rvo::default()))?);
    assert!(vo > 2.0 * rvo, "VO turned {vo:.2} rad, RVO {rvo:.2} rad");
    Ok(())
}

#[test]
fn none_takes_the_preferred_velocity() {
    let neighbours = [other(Vec2::new(0.5, 0.0), Vec2::ZERO, 0.4, 0.5)];
    assert_eq!(choose(&NoAvoidance, Vec2::ZERO, Vec2::X, &neighbours), Vec2::X);
    assert!(choose(&NoAvoidance, Vec2::ZERO, Vec2::X * 9.0, &neighbours).length() <= 1.5 + 1e-6);
}
