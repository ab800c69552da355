//! People that follow the agents of a run.

use glam::{DVec2, DVec3, Vec4};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;
use throng_figure::{Build, Level, Live, Mesh, Person, Sample, Skeleton};
use throng_record::{Body, Frame, moment};
use throng_scene::{Scene, gallery};
use throng_studio::play::{Command, Engine, Film, Joints, Poses, RunMoment, Speed, person};

/// Returns an engine with people in a scene, paused at its start.
fn engine(name: &str, scene: Scene) -> Engine {
    let mut engine = Engine::default();
    engine.command(Command::Load { name: name.into(), scene: Arc::new(scene), run: false });
    assert_eq!(engine.trouble(), None);
    engine.command(Command::People(true));
    engine
}

fn settle(engine: &mut Engine) -> Arc<RunMoment> {
    while engine.idle().is_some() {
        engine.work(Duration::from_millis(50));
    }
    engine.work(Duration::from_millis(50));
    engine.shown().unwrap()
}

fn step(engine: &mut Engine) -> Arc<RunMoment> {
    engine.command(Command::Step);
    settle(engine)
}

/// Moves a vertex as the shader does, relative to the origin of the world.
fn moved(joints: &Joints, mesh: &Mesh, vertex: usize) -> DVec3 {
    let at = Vec4::from((mesh.positions[vertex], 1.0));
    let place = |joint: u8| {
        let rows = &joints[3 * usize::from(joint)..][..3];
        DVec3::from_array([0, 1, 2].map(|row| f64::from(Vec4::from_array(rows[row]).dot(at))))
    };
    let ([a, b, ..], weight) = (mesh.joints[vertex], f64::from(mesh.weights[vertex][0]));
    place(a) * weight + place(b) * (1.0 - weight)
}

/// Returns the middle of the ankles, as the joints move them.
fn between_feet(joints: &Joints) -> DVec2 {
    feet(joints).into_iter().sum::<DVec2>() / 2.0
}

/// Returns where the feet are: the mean of the vertices that only a foot moves.
fn feet(joints: &Joints) -> [DVec2; 2] {
    let mesh = Mesh::new(Build::Man, Level::Blocks);
    [throng_figure::Joint::LeftFoot, throng_figure::Joint::RightFoot].map(|foot| {
        let own = |vertex: &usize| {
            let (joints, weights) = (mesh.joints[*vertex], mesh.weights[*vertex]);
            joints[0] as usize == foot.index() && weights[0] > 0.99
        };
        let own: Vec<usize> = (0..mesh.positions.len()).filter(own).collect();
        assert!(!own.is_empty());
        own.iter().map(|&vertex| moved(joints, &mesh, vertex).truncate()).sum::<DVec2>() / own.len() as f64
    })
}

#[test]
fn the_matrices_move_bodies_as_live_people_move() {
    let mut scene = gallery::scene("circle").unwrap();
    scene.seed = 5;
    let (mut world, built) = scene.build().unwrap();
    let setting = moment::setting(&world, &built, "");
    let mut engine = engine("circle", scene);
    let mut frame = Frame::default();
    let mut lives: BTreeMap<u32, Live> = BTreeMap::new();
    let sample = |time: f64, body: &Body| Sample { time, position: body.position, heading: body.heading.into() };
    let mut shown = settle(&mut engine);
    for moment in 0..60 {
        moment::capture(&world, &mut frame);
        for body in &frame.bodies {
            let sample = sample(frame.time, body);
            if moment == 0 {
                lives.insert(body.number, Live::new(Person::new(0, body.number.into()), sample).unwrap());
            } else {
                lives.get_mut(&body.number).unwrap().step(sample).unwrap();
            }
        }
        assert_eq!(shown.people.len(), 2, "the steps of the scene are short");
        let poses = shown.people.last().unwrap();
        assert_eq!(poses.people.len(), 36);
        if moment % 12 == 5 {
            for ((number, person), joints) in poses.people.iter().zip(&poses.joints) {
                let mesh = Mesh::new(person.build, Level::Coarse);
                let skeleton = Skeleton::new(person);
                let placed = skeleton.world(&lives[number].pose());
                for (vertex, exact) in mesh.posed(&skeleton, person.height, &placed).into_iter().enumerate() {
                    let found = moved(joints, &mesh, vertex) + setting.origin.extend(0.0);
                    assert!(found.distance(exact) < 1e-5, "agent {number}, vertex {vertex}: {found} is not {exact}");
                }
            }
        }
        world.step();
        shown = step(&mut engine);
    }
}

#[test]
fn a_jump_in_time_leaves_people_on_their_way() {
    let mut engine = engine("crossing", gallery::scene("crossing").unwrap());
    for goal in [200, 120, 121, 60, 300] {
        engine.command(Command::Seek(goal));
        let shown = settle(&mut engine);
        let poses = shown.people.last().unwrap();
        let mut apart = 0;
        let mut moving = 0;
        for (body, joints) in shown.frame.bodies.iter().zip(&poses.joints) {
            let middle = between_feet(joints) + shown.setting.origin;
            assert!(middle.distance(body.position) < 0.45, "step {goal}, agent {}: feet at {middle}", body.number);
            if body.speed() > 1.0 {
                moving += 1;
                let [left, right] = feet(joints);
                apart += i32::from(left.distance(right) > 0.3);
            }
        }
        // a walker at 1.3 m/s has its feet farther apart than 0.3 m for two thirds of the time
        assert!(moving > 20 && 3 * apart > moving, "step {goal}: {apart} of {moving} in the middle of a step");
    }
}

#[test]
fn legs_do_not_spin_after_a_jump_and_in_a_run() {
    let mut engine = engine("crossing", gallery::scene("crossing").unwrap());
    let mut last: Option<Arc<Poses>> = None;
    for (goal, jump) in
        [(150, true), (90, true), (91, false), (92, false), (60, true), (61, false), (62, false), (63, false)]
    {
        engine.command(if jump { Command::Seek(goal) } else { Command::Step });
        let shown = settle(&mut engine);
        let now = shown.people.last().unwrap().clone();
        if let Some(last) = last.filter(|_| !jump) {
            assert!(Arc::ptr_eq(&last, &shown.people[0]), "the poses go on from the last ones");
            for ((number, _), (before, after)) in now.people.iter().zip(last.joints.iter().zip(&now.joints)) {
                for (a, b) in feet(before).into_iter().zip(feet(after)) {
                    assert!(a.distance(b) < 0.04 * 8.0, "agent {number}: a foot moves {} m in a step", a.distance(b));
                }
            }
        }
        last = Some(now);
    }
}

#[test]
fn poses_are_the_same_bits_for_any_number_of_threads() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let text = "title = \"Many\"\n[[group]]\nname = \"a\"\ncount = 900\n\
                 place.grid = { columns = 30, rows = 30, spacing = 1.0 }\ngoal.shift = { by = [30.0, 0.0] }\n";
            let mut engine = engine("many", Scene::parse("many.toml", text.to_owned()).unwrap());
            let mut bits = Vec::new();
            for _ in 0..6 {
                let shown = step(&mut engine);
                bits.extend(shown.people.last().unwrap().joints.iter().flatten().flatten().map(|x| x.to_bits()));
            }
            bits
        })
    };
    assert!(run(1) == run(3));
}

#[test]
fn people_come_and_go_with_their_agents() {
    let mut engine = engine("doorway", gallery::scene("doorway").unwrap());
    let mut least = usize::MAX;
    for _ in 0..30 {
        let at = engine.shown().unwrap().step;
        engine.command(Command::Seek(at + 25));
        let shown = settle(&mut engine);
        let numbers = |poses: &Poses| poses.people.iter().map(|(number, _)| *number).collect::<Vec<_>>();
        let agents: Vec<u32> = shown.frame.bodies.iter().map(|body| body.number).collect();
        assert_eq!(numbers(shown.people.last().unwrap()), agents);
        least = least.min(agents.len());
        let next = step(&mut engine);
        let agents: Vec<u32> = next.frame.bodies.iter().map(|body| body.number).collect();
        assert_eq!(numbers(next.people.last().unwrap()), agents);
    }
    assert!(least < 100, "agents leave");
}

#[test]
fn long_steps_have_poses_between() {
    let mut scene = gallery::scene("circle").unwrap();
    scene.time.step = 0.25;
    let mut engine = engine("circle", scene);
    let first = settle(&mut engine);
    let shown = step(&mut engine);
    assert_eq!(shown.people.len(), 6, "five parts of 0.05 s");
    assert!(Arc::ptr_eq(&shown.people[0], &first.people[1]));
    engine.command(Command::People(false));
    assert!(settle(&mut engine).people.is_empty());
}

#[test]
fn which_agents_are_people() {
    let (world, _) = gallery::scene("circle").unwrap().build().unwrap();
    let mut frame = Frame::default();
    moment::capture(&world, &mut frame);
    let body = frame.bodies[0];
    assert_eq!(person(&body), Some(Person::new(0, body.number.into())));
    let child = person(&Body { radius: 0.1, ..body }).unwrap();
    assert_eq!(child.build, Build::Child);
    assert_eq!(person(&Body { radius: 0.6, ..body }), None);
    let door = Body { radius: 0.02, core: glam::Vec2::new(0.6, 0.0), ..body };
    assert_eq!(person(&door), None);
    assert_eq!(person(&Body { altitude: 3.0, ..body }), None);
    // below drones, 48 people walk
    for (name, count) in [("boids", 0), ("drones", 48)] {
        let mut engine = engine(name, gallery::scene(name).unwrap());
        assert!(settle(&mut engine).people.iter().all(|poses| poses.people.len() == count), "{name}");
    }
}

#[test]
fn people_go_on_in_a_run_that_plays() {
    let mut engine = engine("crossing", gallery::scene("crossing").unwrap());
    settle(&mut engine);
    engine.command(Command::Speed(Speed::Fastest));
    engine.command(Command::Run);
    let shown = settle_for(&mut engine, 40);
    let [before, now] = [0, 1].map(|at| shown.people[at].clone());
    assert!(now.joints.iter().flatten().flatten().all(|number| number.is_finite()));
    for (body, joints) in shown.frame.bodies.iter().zip(&now.joints) {
        assert!((between_feet(joints) + shown.setting.origin).distance(body.position) < 0.45, "agent {}", body.number);
    }
    // the poses of a step are those of the steps before it, however it is shown
    let mut paused = self::engine("crossing", gallery::scene("crossing").unwrap());
    settle(&mut paused);
    let mut shown_again = step(&mut paused);
    while shown_again.step < shown.step {
        shown_again = step(&mut paused);
    }
    for (again, first) in shown_again.people.iter().zip([before, now]) {
        assert!(again.joints == first.joints, "step {}", shown.step);
    }
}

/// Lets a run play for a number of steps.
fn settle_for(engine: &mut Engine, steps: u64) -> Arc<RunMoment> {
    loop {
        engine.work(Duration::from_millis(5));
        let shown = engine.shown().unwrap();
        if shown.step >= steps || shown.over {
            return shown;
        }
        std::thread::sleep(engine.idle().unwrap_or_default());
    }
}

#[test]
fn recordings_have_people() {
    let rows = |k: u32| format!("{0},7,{0},2\n{0},9,{1},4\n", f64::from(k) * 0.4, 12.0 - f64::from(k) * 0.5);
    let text: String = (0..30).map(rows).collect();
    let film = Film {
        path: "walk.csv".into(),
        bytes: Some(format!("time,number,x,y\n{text}").into_bytes().into()),
        place: None,
    };
    let mut engine = Engine::default();
    engine.command(Command::Replay { film, run: false });
    assert_eq!(engine.trouble(), None);
    engine.command(Command::People(true));
    engine.command(Command::Seek(20));
    let shown = settle(&mut engine);
    let walks = |joints: &Joints| feet(joints)[0].distance(feet(joints)[1]);
    let poses = shown.people.last().unwrap();
    assert_eq!(poses.people.iter().map(|(number, _)| *number).collect::<Vec<_>>(), [7, 9]);
    let next = step(&mut engine);
    assert_eq!(next.people.len(), 8, "seven parts of 0.057 s");
    let widest = next.people.iter().map(|poses| walks(&poses.joints[0])).fold(0.0, f64::max);
    let narrowest = next.people.iter().map(|poses| walks(&poses.joints[0])).fold(9.0, f64::min);
    assert!(widest > 0.4 && narrowest < 0.35, "{narrowest} to {widest} m between the feet");
}
