//! Makes a film of a world with steered agents: `cargo run --release --example steering -- flock film.mp4`.

use glam::{DVec2, DVec3, Vec3};
use std::sync::Arc;
use throng::avoid::Orca;
use throng::motion::{Locomotion, Vehicle};
use throng::steer::Target;
use throng::{Agent, Error, Group, GroupId, Obstacle, Settings, SubSteps, World};
use throng_draw::{Annotation, Film, Motion, Projection, Still, Style, Theme, Viewpoint};
use throng_record::{Frame, Setting};
use throng_steer::{Evade, Flocking, Pursue, Seek, Separation, UnalignedAvoidance, Wander, WeightedSum};

const STEP: f64 = 1.0 / 30.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let name = words.next().unwrap_or_else(|| "flock".into());
    let path = words.next().unwrap_or_else(|| format!("{name}.png"));
    let mut style = Style { width: 960, height: 640, ..Style::default() };
    let mut seconds = 8.0;
    for word in words {
        match word.as_str() {
            "plan" => style.projection = Some(Projection::Plan),
            "perspective" => style.projection = Some(Projection::Perspective),
            "dark" => style.theme = Theme::dark(),
            "orbit" => style.viewpoint.motion = Motion::Orbit(12.0),
            "near" => {
                style.viewpoint = Viewpoint {
                    eye: Some(DVec3::new(-30.0, -45.0, 62.0)),
                    target: Some(DVec3::new(4.0, 4.0, 50.0)),
                    ..Viewpoint::default()
                };
            }
            "annotate" => style.annotations.kinds = Annotation::ALL.to_vec(),
            "few" => style.annotations.agents = Some(vec![0, 1, 17, 42]),
            number => seconds = number.parse()?,
        }
    }
    let mut world = match name.as_str() {
        "flock" => flock(300)?,
        "towers" => towers()?,
        "chase" => chase()?,
        _ => return Err(format!("unknown world: {name}").into()),
    };
    world.request_traces(style.annotations.asked());
    let mut film = Film::create(path, &Setting::of(&world, name), &style, 30.0)?.still(Still::Last);
    for _ in 0..(seconds / STEP) as usize {
        world.step();
        film.push(&Frame::of(&world))?;
    }
    film.finish()?;
    Ok(())
}

fn world() -> Result<World, Error> {
    World::new(Settings { step: STEP, sub_steps: SubSteps::Fixed(1), ..Settings::default() })
}

fn agent(at: DVec3, group: GroupId, vehicle: &Vehicle) -> Agent {
    Agent { position: at, group, preferred_speed: vehicle.max_speed, motor: (*vehicle).into(), ..Agent::default() }
}

/// Returns a flock of birds that stays around a point 60 m high.
fn flock(count: u32) -> Result<World, Error> {
    let mut world = world()?;
    let vehicle = Vehicle { locomotion: Locomotion::Banking, max_speed: 9.0, max_force: 27.0, ..Vehicle::default() };
    let home = Seek { target: Target::Point(Vec3::new(0.0, 0.0, 60.0)) };
    let steering =
        WeightedSum(vec![(1.0, Flocking::default().into()), (0.3, Wander::default().into()), (0.1, home.into())]);
    let group = Group { name: "birds".into(), neighbour_distance: 9.0, neighbours: 20, ..Group::steered(steering) };
    let group = world.add_group(group)?;
    for k in 0..count {
        let at = DVec3::new(f64::from(k % 7), f64::from(k / 7 % 5), 20.0 + f64::from(k / 35)) * 2.0;
        world.add_agent(Agent { heading: Some(k as f32), ..agent(at, group, &vehicle) })?;
    }
    Ok(world)
}

/// Returns two flocks among towers, low above the ground.
fn towers() -> Result<World, Error> {
    let mut world = world()?;
    let vehicle = Vehicle { locomotion: Locomotion::Banking, max_speed: 6.0, max_force: 18.0, ..Vehicle::default() };
    for (k, name) in ["starlings", "swallows"].into_iter().enumerate() {
        let middle = Vec3::new([-6.0, 8.0][k], [5.0, -4.0][k], 9.0);
        let home = Seek { target: Target::Point(middle) };
        let steering =
            WeightedSum(vec![(1.0, Flocking::default().into()), (0.4, Wander::default().into()), (0.3, home.into())]);
        let group = Group { name: name.into(), neighbour_distance: 6.0, ..Group::steered(steering) };
        let group = world.add_group(group)?;
        for n in 0..60 {
            let offset = DVec3::new(f64::from(n % 5), f64::from(n / 5 % 4), f64::from(n / 20)) * 1.4;
            world.add_agent(agent(middle.as_dvec3() + offset - 3.0, group, &vehicle))?;
        }
    }
    for (x, y, side) in [(-14.0, -9.0, 5.0), (0.0, 0.0, 3.0), (12.0, 10.0, 6.0), (-9.0, 13.0, 4.0)] {
        world.add_obstacle(Obstacle::rectangle(DVec2::new(x, y), DVec2::splat(side), 0.3 * x))?;
    }
    world.add_obstacle(Obstacle::Circle { center: DVec2::new(13.0, -10.0), radius: 2.5 })?;
    Ok(world)
}

/// Returns pairs of pursuers and evaders that also avoid each other.
fn chase() -> Result<World, Error> {
    let mut world = world()?;
    let (slow, fast) = (Vehicle::default(), Vehicle { max_speed: 2.4, ..Vehicle::default() });
    let roam = |target| {
        WeightedSum(vec![
            (1.0, Wander::default().into()),
            (1.0, Evade::new(Target::Agent(target)).into()),
            (1.5, Seek { target: Target::Point(Vec3::ZERO) }.into()),
            (1.0, Separation::default().into()),
            (2.0, UnalignedAvoidance::default().into()),
        ])
    };
    for k in 0..6u32 {
        let quarry = Group { model: Arc::new(Orca::default()), guard: true, ..Group::steered(roam(2 * k + 1)) };
        let pursuer = Group::steered(Pursue::new(Target::Agent(2 * k)));
        let pursuer = Group { model: Arc::new(Orca::default()), guard: true, ..pursuer };
        for (n, (group, vehicle)) in [(quarry, slow), (pursuer, fast)].into_iter().enumerate() {
            let name = ["quarry", "pursuers"][n];
            let group = world.add_group(Group { name: name.into(), ..group })?;
            let at = DVec2::from_angle(f64::from(k) * 1.05 + n as f64 * 0.4) * (4.0 + 3.0 * n as f64);
            world.add_agent(Agent { number: Some(2 * k + n as u32), ..agent(at.extend(0.0), group, &vehicle) })?;
        }
    }
    world.add_obstacle(Obstacle::Circle { center: DVec2::new(4.0, -1.0), radius: 0.8 })?;
    world.add_obstacle(Obstacle::rectangle(DVec2::new(-3.0, 3.0), DVec2::new(2.0, 1.0), 0.5))?;
    Ok(world)
}
