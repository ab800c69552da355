//! Velocity obstacles and reciprocal ones: the time to a collision against small steps of time, the chosen velocities
//! against what their papers say.

use glam::Vec2;
use proptest::prelude::*;
use std::sync::Arc;
use throng::avoid::{
    Forbidden, Hrvo, Line, LocalModel, Neighbour, Outline, Rvo, Unavoiding, View, Vo, Workspace, closest_outside, time_to_disc,
    time_to_segment,
};
use throng::{Agent, Goal, Group, Journey, Settings, Stop, World};

fn vector(range: f32) -> impl Strategy<Value = Vec2> {
    (-range..range, -range..range).prop_map(|(x, y)| Vec2::new(x, y))
}

const STEP: f32 = 1e-3;
const LONG: usize = 8000;

/// The first of many moments at which `distance` is within `radius`; infinite if it never is.
fn first_touch(radius: f32, distance: impl Fn(Vec2) -> f32, velocity: Vec2) -> f32 {
    let touches = (0..LONG).find(|&i| distance(velocity * (i as f32 * STEP)) <= radius);
    touches.map_or(f32::INFINITY, |i| i as f32 * STEP)
}

/// Equal to a few steps; glancing touches may be missed by either.
fn agree(exact: f32, stepped: f32) -> bool {
    if exact > 7.0 { stepped > 6.9 } else { (exact - stepped).abs() <= 3.0 * STEP }
}

fn to_segment(a: Vec2, b: Vec2, p: Vec2) -> f32 {
    let along = b - a;
    (a + along * ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0)).distance(p)
}

proptest! {
    #[test]
    fn the_time_to_a_disc_is_when_they_touch(offset in vector(4.0), velocity in vector(2.0), radii in 0.2f32..1.5) {
        prop_assume!(offset.length() > radii + 0.01);
        let closest = (offset - velocity * (offset.dot(velocity) / velocity.length_squared())).length();
        prop_assume!((closest - radii).abs() > 1e-3 && velocity.length() > 0.05);
        let exact = time_to_disc(offset, velocity, radii);
        prop_assert!(agree(exact, first_touch(radii, |p| p.distance(offset), velocity)), "{exact}");
    }

    #[test]
    fn the_time_to_a_segment_is_when_they_touch(
        a in vector(4.0), b in vector(4.0), velocity in vector(2.0), radius in 0.1f32..0.6,
    ) {
        prop_assume!(a.distance(b) > 0.1 && to_segment(a, b, Vec2::ZERO) > radius + 0.01 && velocity.length() > 0.05);
        let nearest = (0..LONG).map(|i| to_segment(a, b, velocity * (i as f32 * STEP))).fold(f32::INFINITY, f32::min);
        prop_assume!((nearest - radius).abs() > 1e-3);
        let exact = time_to_segment(a, b, velocity, radius);
        prop_assert!(agree(exact, first_touch(radius, |p| to_segment(a, b, p), velocity)), "{exact}");
    }

    /// Alone or not, a free preferred velocity is taken as it is; a doomed one never is while another is free.
    #[test]
    fn what_is_chosen_is_free(offset in vector(5.0), other in vector(1.5), wish in vector(1.5)) {
        prop_assume!(offset.length() > 0.6);
        prop_assume!(wish.length() > 0.01);
        let wish = wish.clamp_length_max(1.45);
        let vo = Vo::default();
        let neighbours = [neighbour(offset, other, 1.0)];
        let chosen = choose(&vo, Vec2::ZERO, wish, &neighbours);
        let free = |v: Vec2| time_to_disc(offset, v - other, 0.4) >= vo.time_horizon * 0.999;
        if free(wish) {
            prop_assert_eq!(chosen, wish);
        } else {
            // what the search promises: as good as every velocity of its first, coarse pattern
            let coarse = (0..16).map(|i| Vec2::from_angle(i as f32 * std::f32::consts::TAU / 16.0).rotate(wish.normalize()) * 1.5);
            let best = coarse.filter(|&v| free(v)).map(|v| v.distance(wish)).fold(f32::INFINITY, f32::min);
            if best.is_finite() {
                prop_assert!(free(chosen), "{chosen} is doomed");
                prop_assert!(chosen.distance(wish) <= best + 1e-3, "{} {best}", chosen.distance(wish));
            }
        }
    }
}

proptest! {
    /// ClearPath against a dense search over velocities.
    #[test]
    fn clearpath_finds_the_best_of_all(
        cones in prop::collection::vec((vector(1.5), 0.0..std::f32::consts::TAU, 0.2f32..2.8), 0..6),
        planes in prop::collection::vec((0.0..std::f32::consts::TAU, -1.0f32..0.5), 0..3),
        preferred in vector(1.5),
    ) {
        let cones = cones.into_iter().map(|(apex, axis, opening)| Forbidden::Cone {
            apex,
            right: Vec2::from_angle(axis - opening / 2.0),
            left: Vec2::from_angle(axis + opening / 2.0),
        });
        let planes = planes.into_iter().map(|(angle, distance)| {
            let direction = Vec2::from_angle(angle);
            Forbidden::RightOf(Line { point: direction.perp() * distance, direction })
        });
        let regions: Vec<Forbidden> = planes.chain(cones).collect();
        let chosen = closest_outside(&regions, 1.5, preferred);
        let preferred = preferred.clamp_length_max(1.5);
        let free = |v: Vec2| regions.iter().all(|region| region.depth(v) <= 0.0);
        let grid = (-75..=75).flat_map(|i| (-75..=75).map(move |j| Vec2::new(i as f32, j as f32) * 0.02));
        let best = grid.filter(|&v| v.length() <= 1.5 && free(v)).map(|v| v.distance(preferred)).fold(f32::INFINITY, f32::min);
        prop_assert!(chosen.length() <= 1.5 * 1.001);
        if best.is_finite() {
            prop_assert!(regions.iter().all(|region| region.depth(chosen) <= 2e-4), "{chosen} is forbidden");
            prop_assert!(chosen.distance(preferred) <= best + 1e-3, "{} {best}", chosen.distance(preferred));
        }
    }

    /// MODELS 1.3: two who both leave their hybrid obstacles by the nearest way do not collide, and pass on one side.
    #[test]
    fn two_hybrids_agree(offset in vector(4.0), a in vector(1.4), aside in -0.99f32..0.99, speed in 0.2f32..2.8) {
        prop_assume!(offset.length() > 0.5 && aside.abs() > 1e-2);
        // on a collision course, somewhere in the cone
        let course = Vec2::from_angle(aside * (0.4 / offset.length()).asin()).rotate(offset.normalize()) * speed;
        let b = a - course;
        let model = Hrvo::default();
        let new_a = choose_freely(&model, a, a, &[neighbour(offset, b, 0.5)]);
        let new_b = choose_freely(&model, b, b, &[neighbour(-offset, a, 0.5)]);
        prop_assert_eq!(time_to_disc(offset, new_a - new_b, 0.4 * 0.995), f32::INFINITY);
        prop_assert!(offset.perp_dot(new_a - new_b) * offset.perp_dot(a - b) > 0.0, "they changed sides");
    }
}

/// As [`choose`], with no limit of speed in the way.
fn choose_freely(model: &dyn LocalModel, velocity: Vec2, preferred: Vec2, neighbours: &[Neighbour]) -> Vec2 {
    let view = View { velocity, preferred, max_speed: 100.0, step: 0.04, neighbours, ..View::default() };
    model.velocity(&view, &mut Workspace::default())
}

fn neighbour(offset: Vec2, velocity: Vec2, share: f32) -> Neighbour {
    Neighbour { offset, velocity, radii: 0.4, share, room: 1.0, aside: Vec2::X, outline: Outline::POINT }
}

fn choose(model: &dyn LocalModel, velocity: Vec2, preferred: Vec2, neighbours: &[Neighbour]) -> Vec2 {
    let view = View { velocity, preferred, max_speed: 1.5, step: 0.04, neighbours, ..View::default() };
    model.velocity(&view, &mut Workspace::default())
}

/// Two who meet, a little off the line of each other, with nothing but their models: how much their headings change in
/// all, radians.
fn turning(model: Arc<dyn LocalModel>) -> Result<f64, throng::Error> {
    let mut world = World::new(Settings { step: 0.04, ..Settings::default() })?;
    let group = world.add_group(Group { model, keep_right: 0.0, detour: false, ..Group::default() })?;
    for side in [-1.0, 1.0] {
        let goal = world.add_goal(Goal::Point { at: glam::DVec2::new(5.0 * side, 0.05 * side), tolerance: 0.1 })?;
        let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false })?;
        let position = glam::DVec2::new(-5.0 * side, 0.05 * side);
        let agent = Agent { position, group, journey, max_acceleration: 1000.0, ..Agent::default() };
        world.add_agent(agent)?;
    }
    let mut turned = 0.0;
    while !world.finished() && world.time() < 60.0 {
        let before = world.agents().velocity.clone();
        world.step();
        let turns = before.iter().zip(&world.agents().velocity).filter(|(a, b)| a.length() > 0.5 && b.length() > 0.5);
        turned += turns.map(|(a, b)| f64::from(a.angle_to(*b).abs())).sum::<f64>();
    }
    assert!(world.finished());
    Ok(turned)
}

/// The reason why there are reciprocal velocity obstacles (van den Berg, Lin, Manocha, section III).
#[test]
fn vo_oscillates_and_rvo_does_not() -> Result<(), throng::Error> {
    let (vo, rvo) = (turning(Arc::new(Vo::default()))?, turning(Arc::new(Rvo::default()))?);
    assert!(vo > 2.0 * rvo, "VO turned {vo:.2} rad, RVO {rvo:.2} rad");
    Ok(())
}

/// With a share of one a reciprocal velocity obstacle is a velocity obstacle: the present velocity does not matter.
#[test]
fn a_full_share_forgets_the_present_velocity() {
    let neighbours = [neighbour(Vec2::new(2.0, 0.1), Vec2::new(-1.0, 0.0), 1.0)];
    let wish = Vec2::new(1.4, 0.0);
    let model = Rvo::default();
    let still = choose(&model, Vec2::ZERO, wish, &neighbours);
    let moving = choose(&model, Vec2::new(1.0, 0.7), wish, &neighbours);
    assert!(still.distance(moving) < 0.1, "{still} {moving}");
}

#[test]
fn none_takes_the_preferred_velocity() {
    let neighbours = [neighbour(Vec2::new(0.5, 0.0), Vec2::ZERO, 0.5)];
    assert_eq!(choose(&Unavoiding, Vec2::ZERO, Vec2::X, &neighbours), Vec2::X);
    assert!(choose(&Unavoiding, Vec2::ZERO, Vec2::X * 9.0, &neighbours).length() <= 1.5 + 1e-6);
}
