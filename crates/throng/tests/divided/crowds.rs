//! Random crowds, cut at random into one to nine worlds.

use crate::common::with_settings;
use crate::compare;
use crate::cuts::random_cuts;
use crate::draw::Draw;
use crate::irregular::irregular;
use glam::{DVec2, Vec2, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::agent::Guidance;
use throng::avoid::{Orca, Orca3d, PowerLaw, Vo};
use throng::field::Governed;
use throng::halo::Cuts;
use throng::motion::Holonomic;
use throng::space::surface::{SeenFrom, Sphere};
use throng::steer::Barriers;
use throng::{Agent, Goal, Group, Journey, JourneyId, Obstacle, Stop, SubSteps, Walkable, World};

/// The features of a crowd.
#[derive(Clone, Debug)]
pub struct Kind {
    seed: u64,
    count: usize,
    /// Agents per square metre.
    density: f64,
    /// Number of goals that agents share.
    goals: usize,
    /// Whether agents look ahead.
    looks: bool,
    /// Whether agents have several sizes, speeds, priorities and accelerations.
    mixed: bool,
    /// Whether one group has another local model, and one is governed by a field.
    odd: bool,
    /// Whether some agents are long, turn slowly, follow a script or ignore some layers.
    irregular: bool,
    walls: bool,
    /// Whether some agents fly, and one group is kept out of a ball.
    flies: bool,
    /// Whether no walkable area bounds the ground.
    open: bool,
    /// Whether agents that block each other agree on which of them step aside.
    resolve: bool,
    guard: bool,
    /// Whether some goals are exits and areas to walk through, and some journeys repeat or wait.
    exits: bool,
    enters: bool,
    sub_steps: SubSteps,
    step: f64,
}

pub fn kind() -> impl Strategy<Value = Kind> {
    let density = prop_oneof![0.05f64..1.0, 1.0f64..5.0];
    let step = prop_oneof![Just(0.1), Just(0.25), 0.01f64..0.2];
    let sub_steps = prop_oneof![Just(SubSteps::Fixed(1)), Just(SubSteps::Fixed(3)), Just(SubSteps::Auto)];
    (
        (any::<u64>(), 1usize..250, density, 1usize..20, step),
        (any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>()),
        (
            prop::bool::weighted(0.8),
            (prop::bool::weighted(0.2), any::<bool>()),
            any::<bool>(),
            any::<bool>(),
            any::<bool>(),
            sub_steps,
        ),
    )
        .prop_map(|((seed, count, density, goals, step), (looks, mixed, odd, irregular, walls), rest)| {
            let (guard, (flies, open), resolve, exits, enters, sub_steps) = rest;
            Kind {
                seed,
                count,
                density,
                goals,
                looks,
                mixed,
                odd,
                irregular,
                walls,
                flies,
                open,
                resolve,
                guard,
                exits,
                enters,
                sub_steps,
                step,
            }
        })
}

impl Kind {
    /// Half of the side of the square with the agents, metres.
    fn half(&self) -> f64 {
        0.5 * (self.count as f64 / self.density).sqrt()
    }

    pub fn crowd(&self) -> World {
        let mut draw = Draw::new(self.seed);
        let mut world = with_settings(self.step, self.sub_steps, DVec2::new(100.0, -50.0));
        let middle = world.settings().origin;
        let half = DVec2::splat(self.half());
        let near = |draw: &mut Draw| middle + draw.point(-half, half);
        if self.walls {
            self.add_walls(&mut world, &mut draw);
        }
        let journeys: Vec<JourneyId> = (0..self.goals).map(|_| self.journey(&mut world, &mut draw)).collect();
        let groups = self.groups(&mut world);
        for at in 0..self.count {
            let mut agent = Agent {
                position: near(&mut draw).extend(0.0),
                velocity: draw.point(-DVec2::ONE, DVec2::ONE).as_vec2(),
                journey: draw.one_of(&journeys),
                group: draw.one_of(&groups),
                radius: 0.15,
                preferred_speed: draw.between(1.0, 1.6) as f32,
                user_data: at as u64,
                ..Agent::default()
            };
            if self.mixed {
                agent.radius = draw.one_of(&[0.1, 0.2, 0.2, 0.5]);
                agent.priority = draw.one_of(&[0.0, 0.0, 0.5]);
                let max_acceleration = draw.one_of(&[f32::INFINITY, 2.0]);
                agent.motor = Holonomic { max_acceleration, ..Holonomic::default() }.into();
            }
            if self.flies && draw.index(2) == 0 {
                agent.position.z = draw.between(0.0, 2.0);
            }
            if self.irregular {
                agent = irregular(&mut world, agent, &mut draw, 25);
            }
            // places in walls are refused: those agents are left out
            if self.enters && draw.index(3) == 0 {
                let time = draw.between(0.0, 2.0);
                let _ = world.schedule_agent(time, agent);
            } else {
                let _ = world.add_agent(agent);
            }
        }
        world
    }

    fn groups(&self, world: &mut World) -> Vec<throng::GroupId> {
        let usual = || Group {
            guard: self.guard,
            resolve: self.resolve,
            look_ahead: self.looks,
            neighbour_distance: 4.0,
            model: Arc::new(Orca::default()),
            ..Group::default()
        };
        let mut groups = vec![usual()];
        if self.mixed {
            groups.push(Group { neighbours: 5, neighbour_distance: 2.5, ..usual() });
            groups.push(Group { neighbours: 25, guard: true, ..usual() });
        }
        if self.odd {
            groups.push(Group { model: Arc::new(Vo::default()), ..usual() });
            groups.push(Group { model: Arc::new(PowerLaw::default()), ..usual() });
            let whirl = |place: Vec3, _: f64| place.cross(Vec3::Z).normalize_or_zero();
            let guidance = Guidance::JOURNEY.governed(Governed::new(whirl, 0.5));
            groups.push(Group { guidance, ..usual() });
        }
        if self.flies {
            let model = Arc::new(Orca3d::default());
            let ball = Sphere::new(Vec3::new(100.0, -50.0, 0.3), 1.5).unwrap();
            groups.push(Group { model, solid: Barriers::default().with(ball, SeenFrom::Outside), ..usual() });
        }
        groups.into_iter().map(|group| world.add_group(group).unwrap()).collect()
    }

    /// A square with pillars and walls, with room around the agents.
    fn add_walls(&self, world: &mut World, draw: &mut Draw) {
        let (middle, half) = (world.settings().origin, self.half());
        let corner = DVec2::splat(1.5 * half + 2.0);
        let outer =
            [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| middle + corner * DVec2::new(x, y));
        if !self.open {
            world.set_walkable(vec![Walkable { outer: outer.to_vec(), holes: vec![] }]).unwrap();
        }
        for _ in 0..4 {
            let at = middle + draw.point(DVec2::splat(-half), DVec2::splat(half));
            world.add_obstacle(Obstacle::Circle { center: at, radius: draw.between(0.2, 1.0) }).unwrap();
            let points = vec![at + DVec2::X, at + draw.point(DVec2::splat(-4.0), DVec2::splat(4.0))];
            world.add_obstacle(Obstacle::Wall { points }).unwrap();
        }
    }

    fn journey(&self, world: &mut World, draw: &mut Draw) -> JourneyId {
        let (middle, half) = (world.settings().origin, self.half());
        let reach = DVec2::splat(if self.walls { 1.4 * half + 1.0 } else { 2.0 * half });
        let goals = 1 + if self.exits { draw.index(3) } else { 0 };
        let stops = (0..goals).map(|leg| {
            let at = middle + draw.point(-reach, reach);
            let corners = [(0.0, 0.0), (0.8, 0.0), (0.8, 1.2), (0.0, 1.2)].map(|(x, y)| at + DVec2::new(x, y)).to_vec();
            let goal = match draw.index(3) {
                0 if self.exits => Goal::Exit { corners },
                1 if self.flies => Goal::Air { at: at.extend(1.0), tolerance: 0.2 },
                1 if self.exits && leg + 1 < goals => Goal::Area { corners },
                _ => Goal::Point { at, tolerance: 0.2 },
            };
            let wait = if self.exits { draw.one_of(&[0.0, 0.5]) } else { 0.0 };
            Stop { goal: world.add_goal(goal).unwrap(), wait }
        });
        let stops = stops.collect();
        world.add_journey(Journey { stops, repeat: self.exits && draw.index(4) == 0 }).unwrap()
    }

    /// Cuts the crowd at random.
    pub fn cuts(&self, seed: u64, worlds: usize) -> Cuts {
        let half = Vec2::splat(self.half() as f32);
        random_cuts(&mut Draw::new(seed), worlds, -half, half)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn any_cuts_give_the_bits_of_one_world(kind in kind(), worlds in 1usize..10, seed: u64, every in 1u64..20) {
        // the cuts change from time to time
        let work = compare(kind.crowd(), |step| kind.cuts(seed.wrapping_add(step / every), worlds), 40, |_, _| ());
        prop_assert!(work.is_ok(), "{:?}, {:?}", work, kind);
    }
}
