//! Floor plans of JuPedSim become scenes. Their licence keeps them out of the repository: they are read from `shared/data`.

#[path = "../../../throng/tests/shared/outside.rs"]
#[allow(dead_code, reason = "these tests need no program")]
mod outside;
#[path = "../all/run.rs"]
mod run;

use outside::{Need, data};
use run::{files, run};
use throng_scene::{PointGoal, Scene, import, open};

fn main() {
    let plans = [Need::Data("geometry")];
    outside::run(vec![
        outside::test("every_floor_plan_reads", &plans, every_floor_plan_reads),
        outside::test("people_walk_on_every_floor_plan", &plans, people_walk_on_every_floor_plan),
        outside::test(
            "the_drawings_of_jupedsim_become_scenes_that_run",
            &plans,
            the_drawings_of_jupedsim_become_scenes_that_run,
        ),
    ]);
}

fn people_walk_on_every_floor_plan() {
    let folder = data("geometry");
    for path in files(&folder).into_iter().filter(|path| path.extension().is_some_and(|e| e == "wkt")) {
        let what = path.display().to_string();
        let anywhere =
            format!("walkable.file = {what:?}\ntime.limit = 20\n[[group]]\ncount = 10\nplace.walkable = {{}}\n");
        let mut scene: Scene = anywhere.parse().unwrap();
        // all agents go to the start of the first agent
        let at = scene.plan().unwrap().agents[0].agent.position;
        scene.groups[0].goal = Some(PointGoal::from(at.truncate().to_array()).into());
        run(&what, &scene);
    }
}

fn every_floor_plan_reads() {
    let folder = data("geometry");
    for path in files(&folder).into_iter().filter(|path| path.extension().is_some_and(|e| e == "wkt")) {
        let text = std::fs::read_to_string(&path).unwrap();
        let areas = import::wkt::areas(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        if path.ends_with("SiB2023_entrance_jupedsim.wkt") {
            assert_eq!(areas.iter().map(|area| area.holes.len()).sum::<usize>(), 81);
        }
        let scene: Scene =
            format!("walkable.file = {:?}\n[[group]]\ncount = 20\nplace.walkable = {{}}\n", path.display().to_string())
                .parse()
                .unwrap();
        let plan = scene.plan().unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert_eq!(plan.agents.len(), 20);
    }
}

fn the_drawings_of_jupedsim_become_scenes_that_run() {
    let folder = data("geometry");
    for (name, groups, people) in [("ISO-Corner.dxf", 1, 20), ("ISO-Office.dxf", 12, 13)] {
        let imported = open(folder.join(name)).unwrap_or_else(|error| panic!("{error}"));
        let count: u64 = imported.scene.groups.iter().filter_map(|group| group.count).sum();
        assert_eq!((imported.scene.groups.len(), count), (groups, people), "{name}: {:?}", imported.notes);
        let (mut world, _) = imported.scene.build().unwrap_or_else(|error| panic!("{name}: {error}"));
        while !imported.scene.time.over(&world) {
            world.step();
        }
        let summary = world.summary();
        assert_eq!(summary.arrived, summary.agents, "{name}: {:?}", world.stranded());
        assert!(summary.least_separation >= 0.9999, "{name}: {summary:?}");
    }
}
