//! Models and behaviours from outside that decide for several agents together: the same bits as one agent at a time.

use crate::world::common::{Draw, journey_to, with_settings};
use crate::world::determinism::{bits, with_threads};
use glam::{DVec2, Vec2, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use throng::avoid::{
    AvoidanceBatch, AvoidanceInput, Crowd, CrowdModel, LocalModel, NoAvoidance, Orca, Orca3d, Workspace,
};
use throng::motion::{Locomotion, Steering, Vehicle};
use throng::perceive::SimdLevel;
use throng::steer::{
    Behaviour, BoxedBehaviour, FlockBatch, MOST_IN_BATCH, SteeringBatch, SteeringInput, TraceRecorder,
};
use throng::{Agent, Body, Group, Obstacle, SubSteps, World};
use throng_steer::Flocking;

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

/// Chooses as ORCA does, for all agents together.
#[derive(Debug, Default)]
struct OrcaTogether {
    orca: Orca,
    /// The number of times that it chose.
    calls: AtomicUsize,
}

impl CrowdModel for OrcaTogether {
    fn choose(&self, crowd: &mut Crowd<'_>) {
        self.calls.fetch_add(1, Ordering::Relaxed);
        let mut workspace = Workspace::default();
        for k in 0..crowd.len() {
            assert!(k == 0 || crowd.number(k - 1) < crowd.number(k));
            let input = crowd.input(k);
            assert_eq!(crowd.neighbour_numbers(k).len(), input.neighbours.len());
            let velocity = self.orca.velocity_in_space(&input, &mut workspace);
            crowd.set(k, velocity);
        }
    }
}

impl LocalModel for OrcaTogether {
    fn velocity(&self, _: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        panic!("it chooses for all agents together");
    }

    fn together(&self) -> Option<&dyn CrowdModel> {
        Some(self)
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        self.orca.wall_range(radius, max_speed)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    #[test]
    fn a_model_that_chooses_for_all_agents_together_gets_what_one_agent_gets(
        seed: u64, count in 1usize..150, (long, mixed, same) in any::<(bool, bool, bool)>(), threads in 1usize..4,
    ) {
        let together = || Arc::new(OrcaTogether::default());
        let ours = together();
        let others = |ours: &Arc<OrcaTogether>| -> Arc<dyn LocalModel> {
            if same { ours.clone() } else if mixed { together() } else { Arc::new(Orca::default()) }
        };
        let run = |model: Arc<dyn LocalModel>, others| {
            let mut world = crowd(model, others, seed, count, long);
            with_threads(threads, || (0..15).for_each(|_| world.step()));
            bits(&world)
        };
        prop_assert_eq!(run(ours.clone(), others(&ours)), run(Arc::new(Orca::default()), Arc::new(Orca::default())));
        // small crowds may have no agent with the model
        let calls = ours.calls.load(Ordering::Relaxed);
        prop_assert!(calls == 15 || calls == 0 && count < 20, "{calls} calls in 15 sub-steps");
    }

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

/// Flies in waves. Counts its steps, rests in some of them, and looks aside in others.
#[derive(Debug)]
struct Waves {
    /// Of how many agents of a batch it steers one together with the others; 0: none.
    together: usize,
    /// Agents steered together, and agents steered one at a time.
    steered: [AtomicUsize; 2],
}

impl Waves {
    fn steering(view: &SteeringInput<'_>, memory: &mut [f32], wave: f32) -> Option<Steering> {
        memory[0] += 1.0;
        let steps = memory[0] as u32 + view.rng.number;
        let facing = (steps % 7 < 2).then_some(Vec3::Y);
        (!steps.is_multiple_of(5)).then(|| Steering { facing, ..view.reach(Vec3::new(1.0, wave, 0.5 * wave)) })
    }

    fn wave(place: Vec3, number: u32, time: f64) -> f32 {
        (place.x + number as f32 * 0.3 + time as f32).fract()
    }
}

impl Behaviour for Waves {
    fn memory(&self) -> usize {
        1
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        self.steered[1].fetch_add(1, Ordering::Relaxed);
        Self::steering(view, memory, Self::wave(view.position(), view.rng.number, view.time))
    }

    fn steer_many(&self, batch: &mut SteeringBatch<'_>) {
        assert!((1..=MOST_IN_BATCH).contains(&batch.count()));
        let steered = |index: &usize| self.together > 0 && index.is_multiple_of(self.together);
        for index in (0..batch.count()).filter(steered) {
            let wave = Self::wave(batch.position(index), batch.number(index), batch.time());
            self.steered[0].fetch_add(1, Ordering::Relaxed);
            batch.steer(index, |view, memory| Self::steering(view, memory, wave));
            batch.steer(index, |_, _| panic!("it has been steered"));
        }
    }
}

/// Waves that count for the test too.
#[derive(Debug)]
struct Shared(Arc<Waves>);

impl Behaviour for Shared {
    fn memory(&self) -> usize {
        self.0.memory()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        self.0.steer(view, memory, why)
    }

    fn steer_many(&self, batch: &mut SteeringBatch<'_>) {
        self.0.steer_many(batch);
    }
}

/// A flock from outside, which may leave its birds to be steered one at a time.
#[derive(Debug)]
struct Outside {
    flocking: Flocking,
    together: bool,
}

impl Behaviour for Outside {
    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        self.flocking.steer(view, memory, why)
    }

    fn is_flock(&self) -> bool {
        true
    }

    fn steer_flock(&self, batch: &mut FlockBatch<'_>) {
        if self.together {
            self.flocking.steer_flock(batch);
        }
    }
}

/// Returns agents that fly by behaviours, the first of every three by the last behaviour, the others by the first.
fn flyers(seed: u64, count: usize, group: impl Fn(BoxedBehaviour) -> Group, all: Vec<BoxedBehaviour>) -> World {
    let mut draw = Draw::new(seed);
    let mut world = with_settings(0.05, SubSteps::Fixed(1), DVec2::ZERO);
    let groups: Vec<_> = all.into_iter().map(|behaviour| world.add_group(group(behaviour)).unwrap()).collect();
    let half = DVec2::splat(0.6 * (count as f64).sqrt());
    for number in 0..count {
        let position = draw.point(-half, half).extend(3.0 + f64::from(number as u32 % 10) * 0.3);
        let agent = Agent { position, radius: 0.05, ..Agent::default() }.motor(vehicle());
        world.add_agent(agent.group(groups[if number % 3 == 0 { groups.len() - 1 } else { 0 }])).unwrap();
    }
    world
}

fn vehicle() -> Vehicle {
    Vehicle { max_speed: 3.0, max_force: 10.0, locomotion: Locomotion::Level, ..Vehicle::default() }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    #[test]
    fn a_behaviour_that_steers_agents_together_steers_them_the_same(
        seed: u64, count in 1usize..150, together in 1usize..4,
        (guard, mixed, avoids) in any::<(bool, bool, bool)>(),
    ) {
        let run = |together: usize, level: SimdLevel| {
            let waves = Arc::new(Waves { together, steered: Default::default() });
            let model: Arc<dyn LocalModel> = if avoids { Arc::new(Orca3d::default()) } else { Arc::new(NoAvoidance) };
            let group = |steering| Group { guard, model: model.clone(), ..Group::steered(steering) };
            let mut all = vec![Shared(waves.clone()).into()];
            if mixed {
                all.push(Flocking::default().into());
            }
            let mut world = flyers(seed, count, group, all);
            world.set_simd_level(level);
            (0..30).for_each(|_| world.step());
            let [many, each] = waves.steered.each_ref().map(|count| count.load(Ordering::Relaxed));
            (world.save(), many, each)
        };
        let ((plain, none, all), (fast, many, left)) = (run(0, SimdLevel::Best), run(together, SimdLevel::Best));
        prop_assert!(plain == fast && plain == run(together, SimdLevel::Plain).0);
        prop_assert_eq!((none, many + left), (0, all));
        prop_assert!(many > 0 || count < 2);
    }

    #[test]
    fn a_flock_from_outside_flies_as_a_flock(seed: u64, count in 1usize..150, (guard, together) in any::<(bool, bool)>()) {
        let run = |behaviour: &dyn Fn() -> BoxedBehaviour, level: SimdLevel| {
            let group = |steering| Group {
                guard, neighbours: Group::ALL_NEIGHBOURS, neighbour_distance: 2.0, ..Group::steered(steering)
            };
            let mut world = flyers(seed, count, group, vec![behaviour(), Flocking::default().into()]);
            world.set_simd_level(level);
            (0..30).for_each(|_| world.step());
            world.save()
        };
        let (own, outside) = (|| Flocking::default().into(), || Outside { flocking: Flocking::default(), together }.into());
        let expected = run(&own, SimdLevel::Best);
        prop_assert!(expected == run(&outside, SimdLevel::Best) && expected == run(&outside, SimdLevel::Plain));
    }
}
