//! Checks that all numbers of a scene are within their limits.

use super::limits::{Limit, check, check_number, check_point, check_some, check_spot};
use super::motor::check_motor;
use super::steer::check_steering;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::registry::{ChosenPlacement, Models};
use crate::scene::{
    Body, Camera, Expect, Group, Mover, Obstacle, Point, Rectangle, Scene, Shape, Sides, SpacePoint, SubSteps, View,
    WrapAround,
};

type Checked = Result<(), Problem>;

/// Checks every number by itself.
pub(super) fn check_scene(scene: &Scene) -> Checked {
    if scene.seed > i64::MAX as u64 {
        let message = format!("seed is {}, but must be at most {}", scene.seed, i64::MAX);
        return Err(Problem::new(&Path::of("seed"), Kind::OutOfRange, message));
    }
    let time = Path::of("time");
    check(&time.key("step"), scene.time.step, Limit::Between(1e-5, 10.0))?;
    check(&time.key("limit"), scene.time.limit, Limit::Positive)?;
    if let SubSteps::Fixed(n) = scene.time.sub_steps {
        check(&time.key("sub_steps"), f64::from(n), Limit::Between(1.0, 1000.0))?;
    }
    for (i, obstacle) in scene.obstacles.iter().enumerate() {
        check_obstacle(&Path::of("obstacle").index(i), obstacle)?;
    }
    for (i, group) in scene.groups.iter().enumerate() {
        check_group(&Path::of("group").index(i), group, &scene.plugins.models)
            .map_err(|problem| in_group(i, group, problem))?;
    }
    for (i, mover) in scene.movers.iter().enumerate() {
        super::movers::check_mover(&Path::of("mover").index(i), mover).map_err(|mut problem| {
            problem.message = format!("mover `{}`: {}", Mover::name_at(&mover.name, i), problem.message);
            problem
        })?;
    }
    check_names(scene)?;
    check_view(&scene.view)?;
    check_expect(&scene.expect)?;
    super::expect::check_groups(scene)
}

/// Returns a problem of a group, with the name of the group.
pub(super) fn in_group(i: usize, group: &Group, problem: Problem) -> Problem {
    Problem { message: format!("group `{}`: {}", Group::name_at(&group.name, i), problem.message), ..problem }
}

/// Checks that only one of the place and the altitude of a group at `path` sets the heights of its agents.
pub(super) fn check_altitude(path: &Path, group: &Group, place: ChosenPlacement) -> Result<ChosenPlacement, Problem> {
    if group.altitude.is_some() && place.sets_altitude {
        let message = format!("place.{} and altitude both set the start height", group.place.name);
        return Err(Problem::new(&path.key("altitude"), Kind::Conflict, message).hint("leave out `altitude`"));
    }
    Ok(place)
}

/// Checks that names of groups are unique: else `--set group.name...` would be ambiguous.
fn check_names(scene: &Scene) -> Checked {
    let names: Vec<String> = scene.groups.iter().enumerate().map(|(i, g)| Group::name_at(&g.name, i)).collect();
    let mut seen = std::collections::HashMap::new();
    for (i, name) in names.iter().enumerate() {
        if let Some(first) = seen.insert(name, i) {
            let path = Path::of("group").index(i).key("name");
            let message = format!("groups {} and {} are both named `{name}`", first + 1, i + 1);
            return Err(Problem::new(&path, Kind::Conflict, message).hint("give each group a name of its own"));
        }
    }
    Ok(())
}

pub(super) fn check_obstacle(path: &Path, obstacle: &Obstacle) -> Checked {
    let path = path.key("shape");
    match &obstacle.shape {
        Shape::Circle(circle) => {
            check_point(&path.key("circle.center"), &circle.center)?;
            check(&path.key("circle.radius"), circle.radius, Limit::Positive)
        }
        Shape::Rectangle(r) => check_rectangle(&path.key("rectangle"), r),
        Shape::Polygon(corners) => check_points(&path.key("polygon"), corners),
        Shape::Wall(points) => {
            let path = path.key("wall");
            check_points(&path, points)?;
            if points.len() < 2 {
                let message = format!("a wall with {} point", points.len());
                return Err(Problem::new(&path, Kind::Geometry, message).hint("a wall has at least two points"));
            }
            Ok(())
        }
    }
}

pub(super) fn check_rectangle(path: &Path, r: &Rectangle) -> Checked {
    check_point(&path.key("center"), &r.center)?;
    check(&path.key("size").index(0), r.size[0], Limit::UpTo(super::limits::MAX_COORDINATE))?;
    check(&path.key("size").index(1), r.size[1], Limit::UpTo(super::limits::MAX_COORDINATE))?;
    check(&path.key("rotation"), r.rotation, Limit::Finite)
}

pub(super) fn check_points(path: &Path, points: &[Point]) -> Checked {
    points.iter().enumerate().try_for_each(|(i, point)| check_point(&path.index(i), point))
}

fn check_group(path: &Path, group: &Group, models: &Models) -> Checked {
    for (i, source) in group.source.iter().enumerate() {
        let path = path.key("source").index(i);
        check(&path.key("start"), source.start, Limit::NotNegative)?;
        check_some(&path.key("end"), source.end, Limit::Finite)?;
        check_some(&path.key("rate"), source.rate, Limit::Positive)?;
        check_some(&path.key("interval"), source.interval, Limit::Positive)?;
    }
    let numbers = [
        ("wait", group.wait.as_ref(), Limit::NotNegative),
        ("speed.preferred", Some(&group.speed.preferred), Limit::Between(0.0, 1000.0)),
        ("speed.max", group.speed.max.as_ref(), Limit::Between(0.0, 1000.0)),
        ("acceleration", group.acceleration.as_ref(), Limit::Positive),
        ("turn_rate", group.turn_rate.as_ref(), Limit::Positive),
        ("time_gap", group.time_gap.as_ref(), Limit::Between(0.05, 10.0)),
        ("tracking_error", group.tracking_error.as_ref(), Limit::Between(0.0, 10.0)),
        ("altitude", group.altitude.as_ref(), Limit::Between(0.0, super::limits::HIGHEST)),
        ("heading", group.heading.as_ref(), Limit::Finite),
        ("start_speed", group.start_speed.as_ref(), Limit::Between(0.0, 1000.0)),
        ("field.ratio", group.field.as_ref().and_then(|field| field.ratio.as_ref()), Limit::Between(0.0, 1.0)),
    ];
    check_body(&path.key("body"), &group.body)?;
    for (key, number, limit) in numbers {
        if let Some(number) = number {
            check_number(&path.key(key), number, limit)?;
        }
    }
    if let Some(max) = &group.speed.max {
        let (most, least) = (max.bounds()[1], group.speed.preferred.bounds()[0]);
        if most < least {
            let message = format!("speed.max is {most}, but speed.preferred is {least}");
            return Err(Problem::new(&path.key("speed.max"), Kind::OutOfRange, message)
                .hint("the greatest speed must be at least the preferred one"));
        }
    }
    if group.altitude.is_some() && !matches!(group.body, Body::Radius(_)) {
        let message = "only discs have an altitude: other bodies reach up without end";
        return Err(Problem::new(&path.key("altitude"), Kind::Conflict, message).hint("leave out `altitude`"));
    }
    check_motor(path, group)?;
    if group.start_speed.is_some() && group.heading.is_none() {
        let message = "start_speed without a heading";
        return Err(
            Problem::new(&path.key("start_speed"), Kind::Conflict, message).hint("add their direction: heading = 90")
        );
    }
    check(&path.key("priority"), group.priority, Limit::Finite)?;
    check_some(&path.key("shoulders"), group.shoulders, Limit::Between(0.0, 10.0))?;
    check_some(&path.key("personal_space"), group.personal_space, Limit::Between(0.0, 10.0))?;
    check_some(&path.key("relaxation_time"), group.relaxation_time, Limit::Between(0.0, 10.0))?;
    check_some(&path.key("keep_right"), group.keep_right, Limit::Between(-28.0, 28.0))?;
    check_layers(&path.key("layers"), &group.layers)?;
    check_layers(&path.key("avoids"), group.avoids.as_deref().unwrap_or_default())?;
    if let Some(WrapAround { center, radius }) = &group.wrap_around {
        let path = path.key("wrap_around");
        check_spot(&path.key("center"), &center.0)?;
        check(&path.key("radius"), *radius, Limit::UpTo(super::limits::HIGHEST))?;
    }
    check_steering(path, group)?;
    models.make(&group.local_model(), &path.key("avoid")).map(drop)
}

pub(super) fn check_layers(path: &Path, layers: &[u8]) -> Checked {
    let mut layers = layers.iter().enumerate();
    layers.try_for_each(|(i, layer)| check(&path.index(i), f64::from(*layer), Limit::Between(0.0, 31.0)))
}

pub(super) fn check_body(path: &Path, body: &Body) -> Checked {
    let limit = Limit::UpTo(1000.0);
    let sides = |path: &Path, sides: &Sides| {
        check_number(&path.key("length"), &sides.length, limit)?;
        check_number(&path.key("width"), &sides.width, limit)
    };
    match body {
        Body::Radius(radius) => check_number(&path.key("radius"), radius, limit),
        Body::Capsule(capsule) => sides(&path.key("capsule"), capsule),
        Body::Rectangle(rectangle) => sides(&path.key("rectangle"), rectangle),
    }
}

fn check_view(view: &View) -> Checked {
    let path = Path::of("view");
    for (key, corner) in [("min", &view.min), ("max", &view.max)] {
        if let Some(corner) = corner {
            check_point(&path.key(key), corner)?;
        }
    }
    if let (Some(min), Some(max)) = (view.min, view.max)
        && (min[0] >= max[0] || min[1] >= max[1])
    {
        return Err(Problem::new(&path.key("max"), Kind::OutOfRange, "view.max must lie above and right of view.min"));
    }
    for (i, pixels) in view.size.iter().flatten().enumerate() {
        check(&path.key("size").index(i), f64::from(*pixels), Limit::Between(16.0, 16384.0))?;
    }
    for (i, line) in view.lines.iter().enumerate() {
        let path = path.key("lines").index(i);
        check_points(&path, line)?;
        if line.len() < 2 {
            let message = format!("a line with {} point", line.len());
            return Err(Problem::new(&path, Kind::Geometry, message).hint("a line has at least two points"));
        }
    }
    if let Some(camera) = &view.camera {
        check_camera(&path.key("camera"), camera)?;
    }
    for (i, lamp) in view.lamps.iter().enumerate() {
        check_spot(&path.key("lamps").index(i), lamp)?;
    }
    check_some(&path.key("fps"), view.fps, Limit::Between(0.001, 1000.0))?;
    check_some(&path.key("moment"), view.moment, Limit::NotNegative)?;
    check_some(&path.key("sun").key("azimuth"), view.sun.azimuth, Limit::Between(-360.0, 360.0))?;
    check_some(&path.key("sun").key("height"), view.sun.height, Limit::Between(3.0, 90.0))?;
    check_some(&path.key("haze"), view.haze, Limit::Positive)?;
    if let Some(set) = &view.set {
        let path = path.key("set");
        let [x, y, z] = set.at;
        check_point(&path.key("at"), &[x, y])?;
        check(&path.key("at").index(2), z, Limit::Between(-10_000.0, 10_000.0))?;
        check(&path.key("turn"), set.turn, Limit::Between(-360.0, 360.0))?;
        check_some(&path.key("scale"), set.scale, Limit::Between(1e-6, 1e6))?;
    }
    check_some(&path.key("trails"), view.trails, Limit::NotNegative)
}

fn check_camera(path: &Path, camera: &Camera) -> Checked {
    check_sight(path, camera.eye, camera.target, camera.field_of_view)?;
    check_some(&path.key("orbit"), camera.orbit, Limit::Between(-3600.0, 3600.0))?;
    let motions = [
        ("follow", camera.follow.is_some()),
        ("orbit", camera.orbit.is_some()),
        ("crowd", camera.crowd),
        ("keys", !camera.keys.is_empty()),
    ];
    let mut given = motions.into_iter().filter(|(_, given)| *given).map(|(name, _)| name);
    if let (Some(first), Some(second)) = (given.next(), given.next()) {
        let message = format!("the camera has both {first} and {second}, which move it");
        return Err(Problem::new(&path.key(second), Kind::Conflict, message).hint("leave out one of the two"));
    }
    for (i, key) in camera.keys.iter().enumerate() {
        let path = path.key("keys").index(i);
        check_some(&path.key("time"), Some(key.time), Limit::NotNegative)?;
        check_sight(&path, Some(key.eye), Some(key.target), key.field_of_view)?;
        if let Some(before) =
            i.checked_sub(1).map(|before| camera.keys[before].time).filter(|before| *before > key.time)
        {
            let message = format!("a key at {} s follows a key at {before} s", key.time);
            return Err(Problem::new(&path.key("time"), Kind::OutOfRange, message).hint("sort the keys by time"));
        }
    }
    Ok(())
}

/// Checks where a camera is and what it looks at.
fn check_sight(path: &Path, eye: Option<SpacePoint>, target: Option<SpacePoint>, angle: Option<f64>) -> Checked {
    for (key, spot) in [("eye", eye), ("target", target)] {
        if let Some(spot) = spot {
            check_spot(&path.key(key), &spot)?;
        }
    }
    if eye.is_some() && eye == target {
        let message = "the camera's eye and target are the same point";
        return Err(Problem::new(&path.key("eye"), Kind::Conflict, message).hint("move one of eye and target"));
    }
    check_some(&path.key("field_of_view"), angle, Limit::Between(1.0, 170.0))
}

fn check_expect(expect: &Expect) -> Checked {
    let path = Path::of("expect");
    check_some(&path.key("within"), expect.within, Limit::Positive)?;
    check_some(&path.key("least_separation"), expect.least_separation, Limit::NotNegative)?;
    check_some(&path.key("least_wall_separation"), expect.least_wall_separation, Limit::NotNegative)?;
    check_some(&path.key("heading_change"), expect.heading_change, Limit::Positive)?;
    check_some(&path.key("mean_speed"), expect.mean_speed, Limit::NotNegative)?;
    check_some(&path.key("final_speed"), expect.final_speed, Limit::NotNegative)?;
    for (i, flow) in expect.flow.iter().enumerate() {
        let path = path.key("flow").index(i);
        check_point(&path.key("from"), &flow.from)?;
        check_point(&path.key("to"), &flow.to)?;
        check_some(&path.key("at_least"), flow.at_least, Limit::NotNegative)?;
        check_some(&path.key("at_most"), flow.at_most, Limit::NotNegative)?;
    }
    Ok(())
}
