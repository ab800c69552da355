//! Same input, same bits: for any number of threads, any order of insertion, with threads compiled in or not.

use crate::world::scenes::{busy, packed};
use throng::{Hindrance, Status, World};

/// Hash and bits at intervals.
pub type History = Vec<(u64, Vec<[u32; 6]>)>;

/// Position, velocity and heading of all agents, bit for bit, by number.
pub fn bits(world: &World) -> Vec<[u32; 6]> {
    let agents = world.relative_columns();
    let mut all: Vec<[u32; 6]> = (0..agents.len())
        .map(|row| {
            let (p, v) = (agents.position[row], agents.velocity[row]);
            [
                agents.number[row],
                p.x.to_bits(),
                p.y.to_bits(),
                v.x.to_bits(),
                v.y.to_bits(),
                agents.heading[row].to_bits(),
            ]
        })
        .collect();
    all.sort_unstable();
    all
}

/// Two scenes, in this order of insertion: one with all features, and a crush.
fn histories(order: u64) -> [History; 2] {
    [history(busy(order)), history(packed(order))]
}

/// Hash and bits after every ten of 240 steps.
pub fn history(mut world: World) -> History {
    let mut all = Vec::new();
    for step in 1..=240 {
        world.step();
        if step % 10 == 0 {
            all.push((world.state_hash(), bits(&world)));
        }
    }
    all
}

pub fn with_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(work)
}

#[test]
fn the_busy_scene_has_everything_in_it() {
    let mut world = busy(0);
    let (mut hindered, mut waits, mut later) = (0, 0, 0);
    for _ in 0..400 {
        world.step();
        let agents = world.relative_columns();
        hindered += (0..agents.len()).filter(|&row| world.hindrance(row) != Hindrance::None).count();
        waits += agents.status.iter().filter(|&&status| status == Status::Waiting).count();
        later = later.max(agents.entered.iter().filter(|&entered| entered > 0.0).count());
    }
    let summary = world.summary();
    assert!(
        summary.agents > 200 && world.relative_columns().len() > 128,
        "enough for more than one thread: {summary:?}"
    );
    assert!(hindered > 50 && waits > 5 && later > 20, "{hindered} hindered, {waits} waits, {later} entered later");
    assert!(summary.removed > 3 && summary.arrived > 10 && summary.guard_share > 0.0, "{summary:?}");
}

#[test]
fn the_guard_is_at_work_in_the_crush() {
    let mut world = packed(0);
    assert!(world.overlapping().len() > 100);
    for _ in 0..240 {
        world.step();
    }
    assert!(world.summary().guard_share > 0.01, "{:?}", world.summary());
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let one = with_threads(1, || histories(0));
    for threads in [2, 3, 8] {
        let many = with_threads(threads, || histories(0));
        assert_same(&one, &many, &format!("{threads} threads"));
    }
}

#[test]
fn any_order_of_insertion_gives_the_same_bits() {
    let straight = histories(0);
    for order in [1, 77] {
        assert_same(&straight, &histories(order), &format!("order {order}"));
    }
}

fn assert_same(a: &[History; 2], b: &[History; 2], label: &str) {
    for (scene, (a, b)) in a.iter().zip(b).enumerate() {
        let first = a.iter().zip(b).position(|(a, b)| a != b);
        assert_eq!(first, None, "{label}: scene {scene} differs after so many tens of steps");
    }
}

/// The hashes of two runs, kept: they hold on every machine, with the feature `parallel` and without (`.ci/run` tests
/// both). A change that keeps results must not change them. When a model or a rule changes on purpose, check that both
/// builds print the same new values, put them here, and mention it in the changelog.
#[test]
fn the_same_bits_on_every_machine_and_in_every_build() {
    const GOLDEN: [u64; 2] = [0xdcbe_a48a_99a8_7172, 0x83f9_aa94_6771_4bf5];
    let hashes = [busy(0), packed(0)].map(|mut world| {
        for _ in 0..240 {
            world.step();
        }
        world.state_hash()
    });
    assert_eq!(hashes, GOLDEN, "new values: {hashes:#018x?}");
}

#[test]
fn the_seed_and_the_state_matter_to_the_hash() {
    let mut a = busy(0);
    let start = a.state_hash();
    a.step();
    assert_ne!(a.state_hash(), start);
    let mut other = busy(0);
    other.remove_agent(other.id(0));
    assert_ne!(other.state_hash(), start);
}
