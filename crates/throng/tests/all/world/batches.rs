//! Models from outside that choose velocities with SIMD: the same bits as one agent at a time.

use crate::world::common::{Draw, journey_to, with_settings};
use crate::world::determinism::bits;
use glam::{DVec2, Vec2};
use proptest::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use throng::avoid::{AvoidanceBatch, AvoidanceInput, LocalModel, Orca, Workspace};
use throng::{Agent, Body, Group, Obstacle, SubSteps, World};

/// Slows down for each neighbour, the more the nearer it is.
#[derive(Debug, Default)]
struct Slow {
    /// Whether it chooses with SIMD, and whether it sees walls there.
    simd: bool,
    walls: bool,
    /// Velocities chosen with SIMD, and velocities chosen one at a time.
    chosen: [AtomicUsize; 2],
}

fn slowed(velocity: Vec2, offset: Vec2, radii: f32) -> Vec2 {
    velocity * ((offset.length() - radii) / 2.0).clamp(0.0, 1.0)
}

impl LocalModel for Slow {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        self.chosen[1].fetch_add(1, Ordering::Relaxed);
        view.neighbours.iter().fold(view.preferred, |velocity, n| slowed(velocity, n.offset, n.radii))
    }

    fn velocities(&self, batch: &mut AvoidanceBatch<'_>) {
        if !self.simd {
            return;
        }
        let sees = |_: &mut _, _, view: &AvoidanceInput<'_>, _: &mut _| {
            assert!(!view.edges.is_empty() && view.neighbours.is_empty());
            self.walls
        };
        batch.with_simd(sees, |input, _| {
            for lane in (0..16).filter(|lane| input.agents >> lane & 1 == 1) {
                self.chosen[0].fetch_add(1, Ordering::Relaxed);
                let own = Vec2::new(input.position[0][lane], input.position[1][lane]);
                let mut velocity = Vec2::new(input.preferred[0][lane], input.preferred[1][lane]);
                let seen = (0..input.most).filter(|&index| input.there[index] >> lane & 1 == 1);
                for neighbour in seen.map(|index| &input.neighbours[index]) {
                    let [x, y, ..] = neighbour.motion[lane];
                    velocity = slowed(velocity, Vec2::new(x, y) - own, neighbour.radii[lane]);
                }
                (input.chosen[0][lane], input.chosen[1][lane]) = (velocity.x, velocity.y);
            }
        });
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        radius + max_speed
    }
}

/// Returns a crowd in two groups, one with this model; `others` gives the model of the other group.
fn crowd(model: Arc<dyn LocalModel>, others: Arc<dyn LocalModel>, seed: u64, count: usize, long: bool) -> World {
    let mut draw = Draw::new(seed);
    let mut world = with_settings(0.1, SubSteps::Fixed(1), DVec2::ZERO);
    let half = DVec2::splat(1.2 * (count as f64).sqrt());
    world.add_obstacle(Obstacle::Wall { points: vec![DVec2::ZERO, half * 0.5] }).unwrap();
    let groups = [model, others].map(|model| world.add_group(Group { model, ..Group::default() }).unwrap());
    for number in 0..count {
        let position = draw.point(-half, half);
        let journey = journey_to(&mut world, draw.point(-half, half));
        let agent = Agent { position: position.extend(0.0), journey, ..Agent::default() };
        let body = if long && number % 9 == 0 { Body::capsule(0.6, 0.3) } else { Body::disc(0.4) };
        // the wall may be in the way
        let _ = world.add_agent(agent.group(groups[usize::from(number % 7 == 0)]).with_body(body));
    }
    world
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    #[test]
    fn a_model_that_chooses_with_simd_chooses_the_same(
        seed: u64, count in 1usize..150, (walls, long, mixed) in any::<(bool, bool, bool)>(),
    ) {
        let run = |simd: bool| {
            let model = Arc::new(Slow { simd, walls, ..Slow::default() });
            let others: Arc<dyn LocalModel> = if mixed { Arc::new(Orca::default()) } else { model.clone() };
            let mut world = crowd(model.clone(), others, seed, count, long);
            (0..20).for_each(|_| world.step());
            (bits(&world), model.chosen[0].load(Ordering::Relaxed), model.chosen[1].load(Ordering::Relaxed))
        };
        let ((plain, none, all), (fast, with_simd, left)) = (run(false), run(true));
        prop_assert_eq!(plain, fast);
        prop_assert_eq!((none, with_simd + left), (0, all));
        // an open crowd of discs is chosen with SIMD
        prop_assert!(long || mixed || !walls || count < 16 || with_simd > left);
    }
}
