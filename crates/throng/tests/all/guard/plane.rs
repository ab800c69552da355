//! The guard's guarantee holds for any targets: random crowds, sizes, speeds and walls, checked by an independent
//! search over the time of the step.

use crate::polygons::apart;
use glam::{DVec2, DVec3, Vec2, Vec3};
use proptest::prelude::*;
use std::f32::consts::{PI, TAU};
use std::ops::Index;
use throng::Obstacle;
use throng::agent::Column;
use throng::guard::{BodyPose, Contacts, Guard, GuardedBodies, Report, Solids, nearest_approach};
use throng::perceive::Grid;
use throng::space::Walls;

#[derive(Clone, Debug, Default)]
pub struct Crowd {
    pub positions: Vec<Vec2>,
    pub altitudes: Column<f32>,
    pub headings: Vec<f32>,
    pub cores: Column<Vec2>,
    pub radii: Column<f32>,
    pub reach: Column<f32>,
    pub guarded: Column<bool>,
    pub targets: Vec<BodyPose>,
}

impl Crowd {
    /// Returns the guard's view of the crowd.
    pub fn bodies<'a>(&'a self, solids: &'a Solids) -> GuardedBodies<'a> {
        GuardedBodies {
            positions: &self.positions,
            altitudes: &self.altitudes,
            headings: &self.headings,
            cores: &self.cores,
            radii: &self.radii,
            reach: &self.reach,
            guarded: &self.guarded,
            solids,
            resting: &[],
        }
    }

    /// Adds a guarded body with a target.
    fn add(&mut self, (position, heading): (Vec2, f32), (core, radius): (Vec2, f32), reach: f32, target: BodyPose) {
        self.positions.push(position);
        self.altitudes.push(0.0);
        self.headings.push(heading);
        self.cores.push(core);
        self.radii.push(radius);
        self.reach.push(reach);
        self.guarded.push(true);
        self.targets.push(target);
    }

    /// Adds a disc.
    fn add_disc(&mut self, position: Vec2, radius: f32, reach: f32, target: Vec2) {
        self.add(
            (position, 0.0),
            (Vec2::ZERO, radius),
            reach,
            BodyPose { position: target, altitude: 0.0, heading: 0.0 },
        );
    }

    fn kept(&self, rows: &[usize]) -> Self {
        fn of<T: Copy, C: Index<usize, Output = T> + FromIterator<T>>(rows: &[usize], all: &C) -> C {
            rows.iter().map(|&row| all[row]).collect()
        }
        Self {
            positions: of(rows, &self.positions),
            altitudes: of(rows, &self.altitudes),
            headings: of(rows, &self.headings),
            cores: of(rows, &self.cores),
            radii: of(rows, &self.radii),
            reach: of(rows, &self.reach),
            guarded: of(rows, &self.guarded),
            targets: of(rows, &self.targets),
        }
    }

    /// Corners of a core at a part of the step on its way to a target.
    fn corners(&self, row: usize, target: BodyPose, t: f64) -> [DVec2; 4] {
        let (from, to) = (f64::from(self.headings[row]), f64::from(target.heading));
        let turn = (to - from + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
        let center = self.positions[row].as_dvec2().lerp(target.position.as_dvec2(), t);
        let (along, half) = (DVec2::from_angle(from + t * turn), self.cores[row].as_dvec2());
        [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
            .map(|(x, y)| center + along * (x * half.x) + along.perp() * (y * half.y))
    }
}

/// Moves the crowd under guard, and returns the final poses.
fn guarded(crowd: &Crowd, walls: &Walls) -> Vec<BodyPose> {
    reported(crowd, walls).0
}

/// As [`guarded`], with the guard's report.
fn reported(crowd: &Crowd, walls: &Walls) -> (Vec<BodyPose>, Report) {
    let numbers: Vec<u32> = (0..crowd.positions.len() as u32).collect();
    let mut grid = Grid::default();
    grid.rebuild(&crowd.positions, &numbers, 1.0);
    let solids = Solids::default();
    let bodies = crowd.bodies(&solids);
    let mut contacts = Contacts::default();
    contacts.collect(&bodies, &numbers, &grid, walls, |_, _| true, |_| None);
    let mut targets = Vec::new();
    let report = Guard::default().certify(&bodies, &contacts, walls, |row| crowd.targets[row], &mut targets);
    (targets, report)
}

/// Distance from a core to the nearest wall.
fn to_walls(corners: &[DVec2], walls: &Walls) -> f64 {
    let edges = walls.edges().iter().map(|edge| apart(corners, &[edge.start, edge.end]));
    let discs = walls.discs().iter().map(|disc| apart(corners, &[disc.center]) - disc.radius);
    edges.chain(discs).fold(f64::INFINITY, f64::min)
}

/// Checks the guarantee by sampling the time of the step.
fn check(crowd: &Crowd, walls: &Walls, targets: &[BodyPose]) {
    const TIMES: u32 = 64;
    let at = |row: usize| (0..=TIMES).map(move |i| crowd.corners(row, targets[row], f64::from(i) / f64::from(TIMES)));
    let ways: Vec<Vec<[DVec2; 4]>> = (0..targets.len()).map(|row| at(row).collect()).collect();
    let overlap = |a: usize, b: usize| apart(&ways[a][0], &ways[b][0]) < f64::from(crowd.radii[a] + crowd.radii[b]);
    let rows = 0..targets.len();
    let overlapped = |row: usize| rows.clone().filter(|&other| other != row && overlap(row, other)).count();
    // two bodies that each overlap more than six bodies, which only a bad start causes, pass through each other
    let piled: Vec<bool> = rows.clone().map(|row| overlapped(row) > 6).collect();
    for (a, target) in targets.iter().enumerate() {
        let moved = crowd.positions[a].distance(target.position);
        assert!(moved <= crowd.reach[a] * 1.001, "{moved} farther than {}", crowd.reach[a]);
        let size = |row: usize| f64::from(crowd.radii[row] + crowd.cores[row].length());
        for b in 0..a {
            let near = crowd.positions[a].distance(crowd.positions[b]);
            let meet = size(a) + size(b) + f64::from(crowd.reach[a] + crowd.reach[b]);
            if f64::from(near) > meet || !(crowd.guarded[a] || crowd.guarded[b]) || piled[a] && piled[b] {
                continue;
            }
            let radii = f64::from(crowd.radii[a]) + f64::from(crowd.radii[b]);
            let start = apart(&ways[a][0], &ways[b][0]);
            let least = ways[a].iter().zip(&ways[b]).map(|(p, q)| apart(p, q)).fold(f64::INFINITY, f64::min);
            assert!(least >= radii.min(start) - 1.1e-6 * radii, "{a} and {b}: {least} of {radii}, from {start}");
        }
        let radius = f64::from(crowd.radii[a]);
        let start = to_walls(&ways[a][0], walls);
        let least = ways[a].iter().map(|corners| to_walls(corners, walls)).fold(f64::INFINITY, f64::min);
        let held = !crowd.guarded[a] || least >= radius.min(start) - 1.1e-6 * radius;
        assert!(held, "{a} and a wall: {least} of {radius}, from {start}");
    }
}

/// The random values of one body.
type Drawn = ((f32, f32), f32, (f32, f32), (f32, f32), f32);

fn mixed(spread: f32) -> impl Strategy<Value = Crowd> {
    let extent = || prop_oneof![Just(0.0f32), 0.0625f32..0.875];
    let place = (-spread..spread, -spread..spread);
    let core = (extent(), extent());
    let body = (place, 0.03125f32..0.5, core, (0.0f32..2.0, 0.0f32..6.25), -3.125f32..3.125);
    (prop::collection::vec(body, 2..25), prop_oneof![Just(1.0f32), Just(0.05)]).prop_map(|(bodies, haste)| {
        let mut crowd = Crowd::default();
        for ((x, y), radius, (length, width), (way, angle), heading) in bodies as Vec<Drawn> {
            let at = Vec2::new(x, y);
            let position = at + Vec2::from_angle(angle) * way * haste;
            let turned = heading + (angle - PI) * haste;
            let target = BodyPose { position, altitude: 0.0, heading: (turned + PI).rem_euclid(TAU) - PI };
            crowd.add((at, heading), (Vec2::new(length, width), radius), 2.0, target);
        }
        crowd
    })
}

fn crowd(spread: f32) -> impl Strategy<Value = Crowd> {
    let body = (-spread..spread, -spread..spread, 0.05f32..0.8, 0.0f32..3.0, 0.0f32..TAU);
    prop::collection::vec(body, 2..40).prop_map(|bodies| {
        let mut crowd = Crowd::default();
        for (x, y, radius, length, angle) in bodies {
            let at = Vec2::new(x, y);
            crowd.add_disc(at, radius, 2.0, at + Vec2::new(angle.cos(), angle.sin()) * length);
        }
        crowd
    })
}

/// Removes each body that overlaps a body before it, or a wall.
fn parted(crowd: Crowd, walls: &Walls) -> Crowd {
    let mut kept: Vec<usize> = Vec::new();
    let corners = |row: usize| crowd.corners(row, crowd.targets[row], 0.0);
    for row in 0..crowd.positions.len() {
        let radius = |row: usize| f64::from(crowd.radii[row]);
        let free = kept.iter().all(|&k| apart(&corners(k), &corners(row)) >= radius(k) + radius(row));
        if free && to_walls(&corners(row), walls) >= radius(row) {
            kept.push(row);
        }
    }
    crowd.kept(&kept)
}

pub fn room() -> Walls {
    let wall = |points: &[(f64, f64)]| Obstacle::Wall { points: points.iter().map(|&p| DVec2::from(p)).collect() };
    let obstacles = [
        wall(&[(-4.0, -4.0), (4.0, -4.0), (4.0, 4.0), (-4.0, 4.0), (-4.0, -4.0)]),
        wall(&[(0.0, -4.0), (0.0, -0.7)]),
        Obstacle::Circle { center: DVec2::new(2.0, 1.5), radius: 0.7 },
        Obstacle::rectangle(DVec2::new(-2.0, 1.0), DVec2::new(1.5, 0.5), 0.6),
    ];
    Walls::new(&[], &obstacles, DVec2::ZERO)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn no_two_agents_overlap_in_the_open(crowd in crowd(4.0)) {
        let crowd = parted(crowd, &Walls::default());
        check(&crowd, &Walls::default(), &guarded(&crowd, &Walls::default()));
    }

    #[test]
    fn no_two_agents_overlap_in_a_room(crowd in crowd(4.0)) {
        let walls = room();
        let crowd = parted(crowd, &walls);
        check(&crowd, &walls, &guarded(&crowd, &walls));
    }

    #[test]
    fn bodies_of_all_shapes_do_not_overlap_in_the_open(crowd in mixed(4.0)) {
        let crowd = parted(crowd, &Walls::default());
        check(&crowd, &Walls::default(), &guarded(&crowd, &Walls::default()));
    }

    #[test]
    fn bodies_of_all_shapes_do_not_overlap_in_a_room(crowd in mixed(4.0)) {
        let walls = room();
        let crowd = parted(crowd, &walls);
        check(&crowd, &walls, &guarded(&crowd, &walls));
    }

    #[test]
    fn overlapping_bodies_of_all_shapes_come_no_closer(crowd in mixed(1.5)) {
        check(&crowd, &Walls::default(), &guarded(&crowd, &Walls::default()));
    }

    /// A pair is kept apart if one of the two is guarded; unguarded bodies pass through walls and other unguarded
    /// bodies.
    #[test]
    fn the_unguarded_are_held_off_the_guarded_only(crowd in mixed(3.0), unguarded in prop::collection::vec(any::<bool>(), 25)) {
        let walls = room();
        let mut crowd = parted(crowd, &walls);
        crowd.guarded = unguarded.iter().take(crowd.positions.len()).map(|not| !not).collect();
        check(&crowd, &walls, &guarded(&crowd, &walls));
        crowd.guarded = crowd.positions.iter().map(|_| false).collect();
        for (went, wished) in guarded(&crowd, &walls).iter().zip(&crowd.targets) {
            prop_assert!(went.position.distance(wished.position) < 1e-6);
        }
    }

    /// Overlaps at the start do not get worse, except in piles.
    #[test]
    fn overlapping_bodies_come_no_closer(crowd in crowd(2.0)) {
        check(&crowd, &Walls::default(), &guarded(&crowd, &Walls::default()));
    }

    #[test]
    fn free_motion_is_left_alone(offset in 5.0f32..9.0, v in -1.0f32..1.0) {
        let mut crowd = Crowd::default();
        crowd.add_disc(Vec2::ZERO, 0.5, 1.5, Vec2::new(0.3, v));
        let target = BodyPose { position: Vec2::new(offset - 0.4, -v), altitude: 0.0, heading: 0.7 };
        crowd.add((Vec2::new(offset, 0.0), 0.2), (Vec2::new(1.0, 0.3), 0.2), 1.5, target);
        prop_assert_eq!(guarded(&crowd, &Walls::default()), crowd.targets);
    }
}

#[test]
fn a_target_that_is_no_number_means_standing() {
    let mut crowd = Crowd::default();
    crowd.add_disc(Vec2::ZERO, 0.3, 1.0, Vec2::new(f32::NAN, 0.0));
    let nonsense = BodyPose { position: Vec2::new(0.2, f32::INFINITY), altitude: 0.0, heading: f32::NAN };
    crowd.add((Vec2::X, 0.0), (Vec2::new(0.1, 0.0), 0.3), 1.0, nonsense);
    let stood: Vec<Vec2> = guarded(&crowd, &Walls::default()).iter().map(|pose| pose.position).collect();
    assert_eq!(stood, crowd.positions);
}

/// A bar that touches a wall with one end can still turn away from it, and stops when it turns into the wall.
#[test]
fn a_bar_at_a_wall_that_cannot_move_turns_away_from_it_only() {
    let wall = Obstacle::Wall { points: vec![DVec2::new(-5.0, 0.0), DVec2::new(5.0, 0.0)] };
    let walls = Walls::new(&[], &[wall], DVec2::ZERO);
    for (heading, kept) in [(0.29, true), (0.31, false), (-0.5, false)] {
        let mut crowd = Crowd::default();
        // the lower end touches: the bar turns parallel to the wall, or upright
        let at = Vec2::new(0.0, 0.2 + (0.3f32).sin());
        let target = BodyPose { position: at, altitude: 0.0, heading };
        crowd.add((at, 0.3), (Vec2::X, 0.2), 0.0, target);
        let targets = guarded(&crowd, &walls);
        check(&crowd, &walls, &targets);
        assert_eq!(targets[0].heading == heading, kept, "{heading}: {targets:?}");
    }
}

/// The head of a row stops at a wall, then the agent behind it, and so on: the longer the row, the more rounds.
#[test]
fn a_row_that_is_stopped_at_its_head_does_not_overlap() {
    let wall = Obstacle::Wall { points: vec![DVec2::new(0.21, -5.0), DVec2::new(0.21, 5.0)] };
    let walls = Walls::new(&[], &[wall], DVec2::ZERO);
    let mut most = 0;
    for count in [4, 8, 12, 40] {
        let mut crowd = Crowd::default();
        for k in 0..count {
            let at = Vec2::new(-0.401 * k as f32, 0.0);
            crowd.add_disc(at, 0.2, 0.5, at + Vec2::X * 0.5);
        }
        let (targets, report) = reported(&crowd, &walls);
        check(&crowd, &walls, &targets);
        most = most.max(report.rounds);
    }
    assert!(most > 9, "{most} rounds");
}

/// However many rounds a row takes that is stopped at its head, only its agents are clamped.
#[test]
fn a_row_that_is_stopped_at_its_head_does_not_clamp_agents_elsewhere() {
    let mut crowd = Crowd::default();
    for k in 0..40 {
        let at = Vec2::new(-0.401 * k as f32, 0.0);
        crowd.add_disc(at, 0.2, 0.5, at + Vec2::X * if k == 0 { 0.0 } else { 0.5 });
    }
    // pairs that could touch, and walk side by side
    for k in 0..60 {
        let at = Vec2::new(-0.5 * (k / 2) as f32, 3.0 + 0.5 * (k % 2) as f32);
        crowd.add_disc(at, 0.2, 0.5, at + Vec2::Y * 0.25);
    }
    let (targets, report) = reported(&crowd, &Walls::default());
    check(&crowd, &Walls::default(), &targets);
    assert!(report.rounds > 8 && report.clamped <= 40, "{report:?}");
    assert_eq!(targets[40..], crowd.targets[40..], "side by side");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20))]

    /// A dense block of discs wants to go farther than it can, against discs that stand. Clamping spreads through it for
    /// many rounds. No two discs overlap, and the bits are the same on any number of threads.
    #[test]
    fn no_two_agents_overlap_in_a_jam(
        (columns, rows) in prop_oneof![(20usize..60, 1usize..4), (16usize..24, 16usize..24)],
        gap in 0.0f32..0.0625,
        (way, angle) in (0.25f32..1.0, -0.25f32..0.25),
        standing in prop::collection::vec(any::<prop::sample::Index>(), 1..6),
        walled: bool,
    ) {
        let mut crowd = Crowd::default();
        for at in 0..columns * rows {
            let from = Vec2::new((at % columns) as f32, (at / columns) as f32) * (0.375 + gap);
            crowd.add_disc(from, 0.1875, way, from + Vec2::from_angle(angle) * way);
        }
        for at in standing {
            let row = at.index(columns * rows);
            crowd.targets[row].position = crowd.positions[row];
        }
        let ahead = f64::from((columns - 1) as f32 * (0.375 + gap)) + 0.25;
        let wall = Obstacle::Wall { points: vec![DVec2::new(ahead, -30.0), DVec2::new(ahead, 30.0)] };
        let walls = if walled { Walls::new(&[], &[wall], DVec2::ZERO) } else { Walls::default() };
        let [one, two, four] = [1, 2, 4].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| reported(&crowd, &walls))
        });
        check(&crowd, &walls, &one.0);
        let bits = |(poses, report): &(Vec<BodyPose>, Report)| -> (Vec<[u32; 3]>, Report) {
            let of = |pose: &BodyPose| [pose.position.x, pose.position.y, pose.heading].map(f32::to_bits);
            (poses.iter().map(of).collect(), *report)
        };
        prop_assert_eq!(bits(&one), bits(&two));
        prop_assert_eq!(bits(&one), bits(&four));
    }
}

/// Removed walls and agents are no contacts any more.
#[test]
fn contacts_are_those_of_the_last_collection() {
    let mut crowd = Crowd::default();
    for x in [-0.3, 0.3] {
        crowd.add_disc(Vec2::new(x, -3.7), 0.25, 0.5, Vec2::ZERO);
    }
    let numbers = [0, 1];
    let mut grid = Grid::default();
    grid.rebuild(&crowd.positions, &numbers, 1.0);
    let solids = Solids::default();
    let bodies = crowd.bodies(&solids);
    let mut contacts = Contacts::default();
    contacts.collect(&bodies, &numbers, &grid, &room(), |_, _| true, |_| None);
    assert_eq!((contacts.of(0), contacts.of(1)), (&[1][..], &[0][..]));
    assert!(!contacts.is_off_walls(0) && !contacts.edges_of(1).is_empty());
    contacts.collect_walls_only(&bodies, &room());
    assert!(contacts.of(0).is_empty() && !contacts.is_off_walls(0));
    contacts.collect(&bodies, &numbers, &grid, &Walls::default(), |_, _| true, |_| None);
    assert!(contacts.of(0) == [1] && contacts.is_off_walls(0) && contacts.edges_of(1).is_empty());
}

#[test]
fn a_bullet_does_not_pass_through_a_thin_wall() {
    let wall = Obstacle::Wall { points: vec![DVec2::new(1.0, -5.0), DVec2::new(1.0, 5.0)] };
    let walls = Walls::new(&[], &[wall], DVec2::ZERO);
    for core in [Vec2::ZERO, Vec2::new(0.3, 0.1)] {
        let mut crowd = Crowd::default();
        let target = BodyPose { position: Vec2::new(40.0, 3.0), altitude: 0.0, heading: 0.0 };
        crowd.add((Vec2::ZERO, 0.0), (core, 0.1), 50.0, target);
        let targets = guarded(&crowd, &walls);
        check(&crowd, &walls, &targets);
        let nose = targets[0].position.x + core.x;
        assert!(nose <= 0.9 && nose > 0.5, "{targets:?}");
    }
}

#[test]
fn nearest_approach_is_the_least_over_time() {
    for i in 0..500 {
        let t = f64::from(i);
        let offset = DVec3::new((t * 0.7).sin(), (t * 1.3).cos(), (t * 1.9).cos()) * 3.0;
        let motion = DVec3::new((t * 2.1).cos(), (t * 0.9).sin(), (t * 0.4).sin()) * (t * 0.01);
        let sampled =
            (0..=10_000).map(|k| (offset + motion * (f64::from(k) / 10_000.0)).length()).fold(f64::INFINITY, f64::min);
        let exact = nearest_approach(offset, motion);
        assert!(exact <= sampled + 1e-12 && exact >= sampled - 1e-3, "{exact} {sampled}");
    }
}

/// Returns the motions of two bodies with this core and 0.3 m round it, given their places and the motions that they
/// choose.
fn two(core: Vec2, both: [(Vec3, Vec3); 2], reach: f32) -> [Vec3; 2] {
    let mut crowd = Crowd::default();
    for (place, motion) in both {
        let target = BodyPose { position: (place + motion).truncate(), altitude: (place + motion).z, heading: 0.0 };
        crowd.add((place.truncate(), 0.0), (core, 0.3), reach, target);
    }
    crowd.altitudes = both.iter().map(|(place, _)| place.z).collect();
    let targets = guarded(&crowd, &Walls::default());
    [0, 1].map(|row| targets[row].position.extend(targets[row].altitude) - both[row].0)
}

#[test]
fn agents_that_meet_come_as_near_as_their_skins_and_no_nearer() {
    for core in [Vec2::ZERO, Vec2::new(0.0, 0.4)] {
        let (left, right) = (Vec3::new(-0.5, 0.0, 0.0), Vec3::new(0.5, 0.0, 0.0));
        let [first, second] = two(core, [(left, Vec3::X * 0.4), (right, Vec3::X * -0.3)], 0.5);
        let gap = 1.0 - first.x + second.x - 0.6;
        assert!((0.0..0.0075).contains(&gap), "{first} {second}: they end {gap} m apart");
        // both share the excess
        assert!((first.x - 0.25).abs() < 0.01 && (second.x + 0.15).abs() < 0.01, "{first} {second}");
    }
}

#[test]
fn agents_that_graze_slide_past_each_other() {
    let (at, beside) = (Vec3::new(-0.7, 0.0, 0.0), Vec3::new(0.0, 0.4, 0.0));
    let [walks, stands] = two(Vec2::ZERO, [(at, Vec3::X * 1.4), (beside, Vec3::ZERO)], 2.0);
    assert!((walks.x - 1.4).abs() < 0.02 && stands.x.abs() < 0.02, "{walks} {stands}");
    assert!(walks.y < -0.1 && stands.y > 0.1, "{walks} {stands}");
}

#[test]
fn an_agent_that_grazes_a_pillar_or_a_corner_slides_past_it() {
    let mut crowd = Crowd::default();
    crowd.add_disc(Vec2::new(-0.7, 0.0), 0.2, 2.0, Vec2::new(0.7, 0.0));
    let pillar = Obstacle::Circle { center: DVec2::new(0.0, 0.6), radius: 0.5 };
    let corner = Obstacle::Wall { points: vec![DVec2::new(0.0, 0.1), DVec2::new(0.0, 3.0)] };
    for obstacle in [pillar, corner] {
        let walls = Walls::new(&[], &[obstacle], DVec2::ZERO);
        let targets = guarded(&crowd, &walls);
        check(&crowd, &walls, &targets);
        let at = targets[0].position;
        assert!((at.x - 0.7).abs() < 0.02 && at.y < -0.09, "{at}");
    }
}

#[test]
fn agents_that_would_pass_through_each_other_stay_on_their_sides() {
    let (left, right) = (Vec3::new(-0.5, 0.0, 0.0), Vec3::new(0.5, 0.1, 0.0));
    let [first, second] = two(Vec2::ZERO, [(left, Vec3::X * 2.0), (right, Vec3::X * -2.0)], 2.0);
    let offset = right + second - left - first;
    assert!(offset.x > 0.0, "{first} {second}");
}

#[test]
fn agents_that_overlap_are_parted_a_little_in_a_step() {
    let (left, right) = (Vec3::new(-0.2, 0.0, 0.0), Vec3::new(0.2, 0.0, 0.0));
    let [first, second] = two(Vec2::ZERO, [(left, Vec3::ZERO), (right, Vec3::ZERO)], 0.2);
    let parted = second.x - first.x;
    // an eighth of the sum of their reaches
    assert!((0.045..0.055).contains(&parted), "{first} {second}");
}

#[test]
fn an_agent_on_the_ground_walks_on_when_a_ball_comes_down_on_it() {
    let (below, above) = (Vec3::ZERO, Vec3::new(0.3, 0.0, 0.8));
    let [walker, ball] = two(Vec2::ZERO, [(below, Vec3::X * 0.3), (above, Vec3::Z * -0.3)], 0.3);
    assert!(ball.z > -0.25, "{ball}: nothing was in the way");
    assert!(walker.z == 0.0 && walker.x > 0.2999, "{walker} {ball}");
}
