//! The reference works by name.

use crate::mixed::{PEDESTRIAN, flock_in_scene, mix};
use crate::place::{bricks, sort, uniform};
use crate::{Crowd, Dice, Flock, Insects, Person, building, city, floor};
use glam::DVec2;
use throng::motion::Holonomic;
use throng::{Error, Group, World};

/// A crowd on which speed is measured, of any size.
pub struct Work {
    /// The name.
    pub name: &'static str,
    /// A description, in a line.
    pub about: &'static str,
    /// The default sizes.
    pub sizes: &'static [usize],
    kind: Kind,
}

/// The kind of agents.
enum Kind {
    Crowd {
        crowd: fn(usize) -> Crowd,
        /// Whether agents have throng's interaction rules and a limited acceleration.
        interaction: bool,
    },
    /// A crowd with interaction rules, some vehicles and doors.
    Mixed(fn(usize) -> Crowd),
    Flock(fn(usize) -> Flock),
    /// A flock above pedestrians with interaction rules and goals of their own.
    FlockInScene(fn(usize) -> Flock),
    Insects(fn(usize) -> Insects),
}

/// All works.
pub const WORKS: &[Work] = &[
    Work {
        name: "crossing",
        about: "0.25 agents per m2, bound far away in random directions; added in spatial order",
        sizes: &[1_000, 10_000, 100_000],
        kind: Kind::Crowd { crowd: |count| crossing(count, true), interaction: false },
    },
    Work {
        name: "crossing-shuffled",
        about: "the same, added in random order",
        sizes: &[1_000, 10_000, 100_000],
        kind: Kind::Crowd { crowd: |count| crossing(count, false), interaction: false },
    },
    Work {
        name: "crossing-rules",
        about: "the same with keeping right, detours, standoffs and accelerations, as throng does by default",
        sizes: &[10_000],
        kind: Kind::Crowd { crowd: |count| crossing(count, false), interaction: true },
    },
    Work {
        name: "mixed",
        about: "crossing-rules with one vehicle in 500 agents and one door in 2000",
        sizes: &[10_000],
        kind: Kind::Mixed(|count| crossing(count, false)),
    },
    Work {
        name: "shared-goals",
        about: "crossing-rules with two goals, far away on either side, that all agents share",
        sizes: &[10_000],
        kind: Kind::Crowd { crowd: two_goals, interaction: true },
    },
    Work {
        name: "own-goals",
        about: "crossing-rules with a goal of its own, far away, for each agent",
        sizes: &[10_000, 100_000],
        kind: Kind::Crowd { crowd: own_goals, interaction: true },
    },
    Work {
        name: "evacuation",
        about: "from rooms of 24 agents, 0.5 per m2, through doors and corridors to shared exits, with interaction rules",
        sizes: &[1_000, 10_000, 100_000],
        kind: Kind::Crowd { crowd: building::evacuation, interaction: true },
    },
    Work {
        name: "city",
        about: "0.25 per m2 in streets of 12 m between blocks of 60 m, to goals of their own some blocks away, with rules",
        sizes: &[10_000, 100_000],
        kind: Kind::Crowd { crowd: city::city, interaction: true },
    },
    density("density-0.1", "0.1 per m2, bodies of 0.2 m, bound far away in random directions", |n| packed(n, 0.1)),
    density("density-0.25", "the same, 0.25 per m2", |n| packed(n, 0.25)),
    density("density-0.5", "the same, 0.5 per m2", |n| packed(n, 0.5)),
    density("density-1", "the same, 1 per m2", |n| packed(n, 1.0)),
    density("density-2", "the same, 2 per m2", |n| packed(n, 2.0)),
    density("density-4", "the same, 4 per m2", |n| packed(n, 4.0)),
    density("density-6", "the same, 6 per m2", |n| packed(n, 6.0)),
    Work {
        name: "one-spot",
        about: "all agents within 5 cm, bound far away in random directions",
        sizes: &[1_000],
        kind: Kind::Crowd { crowd: one_spot, interaction: false },
    },
    Work {
        name: "at-rest",
        about: "1 agent per m2, all of them stand and have no goal",
        sizes: &[10_000],
        kind: Kind::Crowd { crowd: at_rest, interaction: false },
    },
    Work {
        name: "flock",
        about: "OpenSteer's boids in space, three or four neighbours within 9 m of each",
        sizes: &[1_000, 10_000, 100_000],
        kind: Kind::Flock(loose_flock),
    },
    Work {
        name: "flock-dense",
        about: "the same in a sphere of 100 m, however many: 16 within 9 m of each of 1,000, more than 100 of 10,000",
        sizes: &[1_000, 10_000],
        kind: Kind::Flock(|count| Flock::in_sphere(count, 50.0)),
    },
    Work {
        name: "flock-in-scene",
        about: "flock with one agent in ten a pedestrian on the ground, as in own-goals",
        sizes: &[1_000, 10_000],
        kind: Kind::FlockInScene(|count| loose_flock(count - count / PEDESTRIAN)),
    },
    Work {
        name: "swarm",
        about: "midges in space with a noise for each, 1,000 per m3, one within 6 cm of each, that keep apart",
        sizes: &[10_000, 100_000],
        kind: Kind::Insects(|count| Insects::in_sphere(count, 1000.0, true)),
    },
    Work {
        name: "swarm-alone",
        about: "the same, without neighbours",
        sizes: &[10_000, 100_000, 1_000_000],
        kind: Kind::Insects(|count| Insects::in_sphere(count, 1000.0, false)),
    },
    Work {
        name: "hall",
        about: "to and fro in an empty hall with 20 m2 for five agents, with interaction rules",
        sizes: &[500],
        kind: Kind::Crowd { crowd: floor::hall, interaction: true },
    },
    Work {
        name: "rooms",
        about: "the same on a floor of rooms of 20 m2, with doors, desks and pillars",
        sizes: &[500],
        kind: Kind::Crowd { crowd: floor::rooms, interaction: true },
    },
];

/// Returns the work of a name.
pub fn work(name: &str) -> Option<&'static Work> {
    WORKS.iter().find(|work| work.name == name)
}

impl Work {
    /// Returns the pedestrians of a work of pedestrians; the same for the same count.
    pub fn crowd(&self, count: usize) -> Option<Crowd> {
        match self.kind {
            Kind::Crowd { crowd, .. } => Some(crowd(count)),
            Kind::Mixed(_) | Kind::Flock(_) | Kind::FlockInScene(_) | Kind::Insects(_) => None,
        }
    }

    /// Returns the birds of a work of birds; the same for the same count.
    pub fn flock(&self, count: usize) -> Option<Flock> {
        match self.kind {
            Kind::Crowd { .. } | Kind::Mixed(_) | Kind::Insects(_) => None,
            Kind::Flock(flock) | Kind::FlockInScene(flock) => Some(flock(count)),
        }
    }

    /// Returns the insects of a work of insects; the same for the same count.
    pub fn insects(&self, count: usize) -> Option<Insects> {
        match self.kind {
            Kind::Insects(insects) => Some(insects(count)),
            Kind::Crowd { .. } | Kind::Mixed(_) | Kind::Flock(_) | Kind::FlockInScene(_) => None,
        }
    }

    /// Returns the world of a work, with or without the guard.
    ///
    /// # Errors
    /// The errors of [`Crowd::world`], [`Flock::world`] and [`Insects::world`]: the ground of very large crowds exceeds
    /// the limits of a world.
    pub fn world(&self, count: usize, guard: bool) -> Result<World, Error> {
        match self.kind {
            Kind::Crowd { crowd, interaction: true } => {
                crowd(count).world(Group { guard, ..Crowd::interaction() }, Holonomic::default().max_acceleration)
            }
            Kind::Crowd { crowd, interaction: false } => {
                crowd(count).world(Group { guard, ..Crowd::bare() }, f32::INFINITY)
            }
            Kind::Mixed(crowd) => {
                let group = Group { guard, ..Crowd::interaction() };
                let mut world = crowd(count).world(group, Holonomic::default().max_acceleration)?;
                mix(&mut world)?;
                Ok(world)
            }
            Kind::Flock(flock) => flock(count).world(guard),
            Kind::FlockInScene(flock) => flock_in_scene(&flock(count), &own_goals(count / PEDESTRIAN), guard),
            Kind::Insects(insects) => insects(count).world(guard),
        }
    }
}

const fn density(name: &'static str, about: &'static str, crowd: fn(usize) -> Crowd) -> Work {
    Work { name, about, sizes: &[10_000], kind: Kind::Crowd { crowd, interaction: false } }
}

/// Distance of goals so far away that each is a direction, metres.
const DISTANCE: f64 = 15_000.0;

/// Returns a goal far away in a random direction.
fn far_away(rng: &mut Dice) -> DVec2 {
    DVec2::from_angle(rng.between(0.0, std::f64::consts::TAU)) * DISTANCE
}

/// The reference work by which crowd simulators are compared.
fn crossing(count: usize, sorted: bool) -> Crowd {
    const RADIUS: f64 = 0.25;
    let mut places = uniform(count, 0.25, 2.0 * RADIUS, &mut Dice::new(7));
    if sorted {
        sort(&mut places);
    }
    outward(places, RADIUS)
}

/// The same places, with one of two goals for each agent: all goals are shared.
fn two_goals(count: usize) -> Crowd {
    let crowd = crossing(count, false);
    let goals = vec![DVec2::NEG_X * DISTANCE, DVec2::X * DISTANCE];
    let person = |(k, person): (usize, Person)| Person { way: Some(k % 2), ..person };
    Crowd::open(crowd.people.into_iter().enumerate().map(person).collect(), crowd.radius, goals)
}

/// The same places, with a goal in a random direction for each agent.
fn own_goals(count: usize) -> Crowd {
    let crowd = crossing(count, false);
    let mut rng = Dice::new(13);
    let goals = (0..count).map(|_| far_away(&mut rng)).collect();
    let person = |(k, person): (usize, Person)| Person { way: Some(k), ..person };
    Crowd::open(crowd.people.into_iter().enumerate().map(person).collect(), crowd.radius, goals)
}

/// Birds at the density of OpenSteer's demo.
fn loose_flock(count: usize) -> Flock {
    Flock::in_sphere(count, 50.0 * (count as f64 / 200.0).cbrt())
}

/// A crowd of `density` agents per square metre, as far as bodies of 0.2 m can be packed.
fn packed(count: usize, density: f64) -> Crowd {
    const RADIUS: f64 = 0.2;
    outward(bricks(count, density, 2.0 * RADIUS, &mut Dice::new(7)), RADIUS)
}

fn one_spot(count: usize) -> Crowd {
    let mut rng = Dice::new(7);
    outward((0..count).map(|_| rng.in_disc(0.05)).collect(), 0.25)
}

fn at_rest(count: usize) -> Crowd {
    const RADIUS: f64 = 0.25;
    let mut rng = Dice::new(9);
    let people = bricks(count, 1.0, 2.0 * RADIUS, &mut Dice::new(7)).into_iter();
    let people = people.map(|position| Person { position, preferred_speed: rng.between(1.3, 1.5), way: None });
    Crowd::open(people.collect(), RADIUS, vec![])
}

/// Returns agents bound for one of 4096 goals, so far away that each goal is a direction. The goals are few enough to
/// measure millions of agents, and many enough that neighbours rarely share a goal.
fn outward(places: Vec<DVec2>, radius: f64) -> Crowd {
    const GOALS: usize = 4096;
    let mut rng = Dice::new(9);
    let goals = (0..GOALS).map(|_| far_away(&mut rng)).collect();
    let people = places.into_iter().map(|position| {
        let way = Some(rng.below(GOALS));
        Person { position, preferred_speed: rng.between(1.3, 1.5), way }
    });
    Crowd::open(people.collect(), radius, goals)
}
