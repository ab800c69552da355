//! Hashes of the results of the guard for random crowds.

use crate::draw::Draw;
use crate::guard::plane::{Crowd, room};
use crate::results::Results;
use glam::{DVec2, Quat, Vec2, Vec3};
use throng::Agent;
use throng::agent::Column;
use throng::guard::{BodyPose, Contacts, Guard, Solids, nearest_approach};
use throng::perceive::Grid;
use throng::space::Walls;
use throng::space::surface::{self, Cuboid, Moved, SeenFrom, Sphere};
use throng::steer::Barriers;

/// The settings of a crowd.
#[derive(Clone, Copy)]
struct Kind {
    count: usize,
    /// Half the side of the square in which the agents start, metres.
    spread: f64,
    radii: &'static [f32],
    /// Half lengths and widths of cores.
    cores: &'static [Vec2],
    /// Start heights.
    altitudes: &'static [f32],
    /// Lengths of the chosen motions, metres.
    ways: &'static [f32],
    /// The part of the agents that are guarded.
    guarded: f64,
    walls: bool,
    solids: bool,
}

const DISCS: Kind = Kind {
    count: 60,
    spread: 4.0,
    radii: &[0.2, 0.3],
    cores: &[Vec2::ZERO],
    altitudes: &[0.0],
    ways: &[0.05, 0.0, 0.6],
    guarded: 1.0,
    walls: false,
    solids: false,
};

const LONG: Kind = Kind { cores: &[Vec2::ZERO, Vec2::new(0.5, 0.1), Vec2::new(0.0, 0.3)], count: 35, ..DISCS };

const FLIERS: Kind = Kind { altitudes: &[0.0, 0.3, 1.0, 1.7], count: 80, ..DISCS };

const KINDS: [(&str, Kind); 10] = [
    ("discs", DISCS),
    ("discs of all sizes", Kind { radii: &[0.02, 0.2, 1.1], ..DISCS }),
    ("discs alike in a room", Kind { radii: &[0.25], walls: true, ..DISCS }),
    ("a pile", Kind { spread: 0.6, radii: &[0.3, 0.1], ..DISCS }),
    ("long bodies", LONG),
    ("long bodies in a room", Kind { walls: true, ..LONG }),
    ("fliers", FLIERS),
    ("fliers and long bodies in a room", Kind { walls: true, cores: LONG.cores, count: 50, ..FLIERS }),
    ("fliers beside solids", Kind { solids: true, ..FLIERS }),
    ("long bodies beside solids, some unguarded", Kind { solids: true, guarded: 0.5, walls: true, ..LONG }),
];

impl Kind {
    /// A crowd of this kind, without targets.
    fn crowd(&self, draw: &mut Draw) -> Crowd {
        let mut crowd = Crowd::default();
        for _ in 0..self.count {
            let at = draw.point(DVec2::splat(-self.spread), DVec2::splat(self.spread));
            crowd.positions.push(at.as_vec2());
            crowd.altitudes.push(draw.one_of(self.altitudes));
            crowd.headings.push(draw.between(-3.0, 3.0) as f32);
            crowd.cores.push(draw.one_of(self.cores));
            crowd.radii.push(draw.one_of(self.radii));
            crowd.reach.push(self.ways.iter().copied().fold(0.0, f32::max));
            crowd.guarded.push(draw.between(0.0, 1.0) < self.guarded);
        }
        crowd
    }

    /// The targets of the agents: most lead towards the centre, the rest anywhere.
    fn chosen_velocities(&self, draw: &mut Draw, crowd: &Crowd) -> Vec<BodyPose> {
        let chosen = |row: usize| {
            let at = crowd.positions[row].extend(crowd.altitudes[row]);
            let anywhere = Vec3::new(draw.between(-1.0, 1.0) as f32, draw.between(-1.0, 1.0) as f32, 0.3);
            let towards = if draw.index(3) == 0 { anywhere } else { -at };
            let to = at + towards.normalize_or_zero() * draw.one_of(self.ways);
            let grounded = self.altitudes.len() == 1;
            let heading = if draw.index(2) == 0 { crowd.headings[row] } else { draw.between(-3.0, 3.0) as f32 };
            BodyPose { position: to.truncate(), altitude: if grounded { 0.0 } else { to.z }, heading }
        };
        (0..crowd.positions.len()).map(chosen).collect()
    }
}

fn move_to(crowd: &mut Crowd, targets: &[BodyPose]) {
    crowd.positions = targets.iter().map(|target| target.position).collect();
    crowd.altitudes = targets.iter().map(|target| target.altitude).collect();
    crowd.headings = targets.iter().map(|target| target.heading).collect();
}

/// Runs a crowd, and adds the contacts, the targets and the reports of all steps.
fn run(results: &mut Results, name: &str, kind: &Kind, seed: u64) {
    let mut draw = Draw::new(seed);
    let mut crowd = kind.crowd(&mut draw);
    let numbers: Vec<u32> = (0..kind.count as u32).rev().collect();
    let groups: Column<_> = (0..kind.count).map(|_| Agent::default().group).collect();
    let walls = if kind.walls { room() } else { Walls::default() };
    let mut solids = Solids::default();
    if kind.solids {
        let ball = Sphere::new(Vec3::new(0.5, 0.5, 0.5), 0.9).unwrap();
        let pose = surface::Pose::new(Vec3::new(-1.5, 0.3, 0.4), Quat::from_xyzw(0.0, 0.0, 0.25, 0.97)).unwrap();
        let block = Moved::new(Cuboid::new(Vec3::new(1.0, 0.8, 1.5)).unwrap(), pose);
        let hall = Sphere::new(Vec3::ZERO, 5.0).unwrap();
        let barriers = Barriers::default().with(ball, SeenFrom::Outside).with(block, SeenFrom::Outside);
        solids.add(barriers.with(hall, SeenFrom::Inside).0);
    }
    let (mut grid, mut contacts, mut guard) = (Grid::default(), Contacts::default(), Guard::default());
    let mut targets = Vec::new();
    for _ in 0..8 {
        grid.rebuild(&crowd.positions, &numbers, 1.0);
        let chosen_velocities = kind.chosen_velocities(&mut draw, &crowd);
        let unknown = Solids::default();
        solids.find(&crowd.bodies(&unknown), &groups);
        let bodies = crowd.bodies(&solids);
        contacts.collect(&bodies, &numbers, &grid, &walls, |_, _| true, |_| None);
        for row in 0..kind.count {
            let (others, edges, discs) = (contacts.of(row), contacts.edges_of(row), contacts.discs_of(row));
            results.add(name, &(others, edges, discs, solids.is_near(row), contacts.is_off_walls(row)));
        }
        let report = guard.certify(&bodies, &contacts, &walls, |row| chosen_velocities[row], &mut targets);
        results.add(name, &(report, &targets));
        move_to(&mut crowd, &targets);
    }
}

#[test]
fn guarded_motion_is_as_kept() {
    let mut results = Results::default();
    for (name, kind) in KINDS {
        for seed in 0..12 {
            run(&mut results, name, &kind, seed);
        }
    }
    let mut draw = Draw::new(7);
    let mut vector = || Vec3::from_array([0; 3].map(|_| draw.between(-1.0, 1.0) as f32)).as_dvec3();
    for _ in 0..100 {
        results.add("nearest approach", &nearest_approach(vector(), vector()));
    }
    results.assert_kept("all/guard/kept.txt");
}
