//! Checks that all numbers of a scene are within their limits.

use super::limits::{Limit, check, check_number, check_point, check_some, check_spot};
use super::motor::check_motor;
use super::steer::check_steering;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::registry::Models;
use crate::scene::{
    Body, Camera, Expect, Goal, Group, Mover, Obstacle, Place, Point, PointGoal, Rectangle, Region, Scene, Shape,
    Sides, Stop, SubSteps, View, WrapAround,
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
        check_group(&Path::of("group").index(i), group, &scene.plugins.models).map_err(|mut problem| {
            let name = Group::name_at(&group.name, i);
            problem.message = format!("group `{name}`: {}", problem.message);
            problem
        })?;
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

fn check_obstacle(path: &Path, obstacle: &Obstacle) -> Checked {
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
    check_place(&path.key("place"), &group.place)?;
    if let Some(goal) = &group.goal {
        check_goal(&path.key("goal"), goal, false)?;
    }
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
    if group.altitude.is_some() && (matches!(group.place, Place::Sphere(_)) || !matches!(group.body, Body::Radius(_))) {
        let message = match group.place {
            Place::Sphere(_) => "place.sphere and altitude both set the start height",
            _ => "only discs have an altitude: other bodies reach up without end",
        };
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

fn check_place(path: &Path, place: &Place) -> Checked {
    match place {
        Place::Point(point) => check_point(&path.key("point"), point),
        Place::Points(points) => check_points(&path.key("points"), points),
        Place::Line(line) => {
            check_point(&path.key("line.from"), &line.from)?;
            check_point(&path.key("line.to"), &line.to)
        }
        Place::Ring(ring) => {
            check_point(&path.key("ring.center"), &ring.center)?;
            check(&path.key("ring.radius"), ring.radius, Limit::UpTo(super::limits::MAX_COORDINATE))?;
            check(&path.key("ring.start"), ring.start, Limit::Finite)
        }
        Place::Sphere(sphere) => {
            let path = path.key("sphere");
            check_spot(&path.key("center"), &sphere.center)?;
            check(&path.key("radius"), sphere.radius, Limit::UpTo(super::limits::HIGHEST))?;
            check(&path.key("radius"), sphere.radius, Limit::UpTo(sphere.center[2])).map_err(|problem| {
                problem.hint("all of the sphere must be above the ground: put its center higher, or make it smaller")
            })
        }
        Place::Grid(grid) => {
            check_point(&path.key("grid.center"), &grid.center)?;
            check(&path.key("grid.columns"), grid.columns as f64, Limit::UpTo(super::MAX_AGENTS as f64))?;
            check(&path.key("grid.rows"), grid.rows as f64, Limit::UpTo(super::MAX_AGENTS as f64))?;
            check(&path.key("grid.spacing"), grid.spacing, Limit::UpTo(super::limits::MAX_COORDINATE))?;
            check(&path.key("grid.rotation"), grid.rotation, Limit::Finite)
        }
        Place::Disc(disc) => {
            check_point(&path.key("disc.center"), &disc.center)?;
            check(&path.key("disc.radius"), disc.radius, Limit::UpTo(super::limits::MAX_COORDINATE))?;
            check(&path.key("disc.gap"), disc.gap, Limit::NotNegative)
        }
        Place::Rectangle(r) => {
            let plain = Rectangle { center: r.center, size: r.size, rotation: r.rotation };
            check_rectangle(&path.key("rectangle"), &plain)?;
            check(&path.key("rectangle.gap"), r.gap, Limit::NotNegative)
        }
        Place::Polygon(polygon) => {
            check_points(&path.key("polygon.corners"), &polygon.corners)?;
            super::ground::check_polygon(&path.key("polygon.corners"), &polygon.corners, "the place")?;
            check(&path.key("polygon.gap"), polygon.gap, Limit::NotNegative)
        }
        Place::Walkable(walkable) => check(&path.key("walkable.gap"), walkable.gap, Limit::NotNegative),
    }
}

fn check_goal(path: &Path, goal: &Goal, inner: bool) -> Checked {
    let tolerance = |path: &Path, x: f64| check(&path.key("tolerance"), x, Limit::Positive);
    match goal {
        Goal::Point(PointGoal { at, tolerance: t }) => {
            check_point(&path.key("point"), at)?;
            tolerance(&path.key("point"), *t)
        }
        Goal::Air(goal) => {
            check_spot(&path.key("air.at"), &goal.at)?;
            tolerance(&path.key("air"), goal.tolerance)
        }
        Goal::Points(goal) => {
            check_points(&path.key("points.at"), &goal.at)?;
            tolerance(&path.key("points"), goal.tolerance)
        }
        Goal::Opposite(goal) => {
            if let Some(center) = &goal.center {
                check_point(&path.key("opposite.center"), center)?;
            }
            tolerance(&path.key("opposite"), goal.tolerance)
        }
        Goal::Shift(goal) => {
            check_point(&path.key("shift.by"), &goal.by)?;
            check(&path.key("shift.rise"), goal.rise, Limit::Finite)?;
            tolerance(&path.key("shift"), goal.tolerance)
        }
        Goal::Area(region) => check_region(&path.key("area"), region),
        Goal::Exit(region) => check_region(&path.key("exit"), region),
        Goal::Journey(stops) => check_stops(&path.key("journey"), stops, inner),
        Goal::Cycle(stops) => check_stops(&path.key("cycle"), stops, inner),
        Goal::Lap(_) if inner => {
            let message = "laps are without end, so that they cannot be a stop";
            Err(Problem::new(&path.key("lap"), Kind::Conflict, message).hint("give the group goal.lap alone"))
        }
        Goal::Lap(lap) => super::annulus::check_lap(&path.key("lap"), lap),
        Goal::Nearest(goals) => {
            let path = path.key("nearest");
            not_empty(&path, goals.len())?;
            goals.iter().enumerate().try_for_each(|(i, goal)| check_goal(&path.index(i), goal, inner))
        }
        Goal::Choice(goals) => {
            let path = path.key("choice");
            not_empty(&path, goals.len())?;
            for (i, choice) in goals.iter().enumerate() {
                check(&path.index(i).key("weight"), choice.weight, Limit::Between(0.0, 1e9))?;
                check_goal(&path.index(i).key("goal"), &choice.goal, inner)?;
            }
            if goals.iter().all(|choice| choice.weight == 0.0) {
                return Err(Problem::new(&path, Kind::OutOfRange, "all weights are 0: nothing can be chosen"));
            }
            Ok(())
        }
    }
}

fn not_empty(path: &Path, length: usize) -> Checked {
    if length == 0 {
        return Err(
            Problem::new(path, Kind::MissingKey, "there is nothing in this list").hint("give at least one goal")
        );
    }
    Ok(())
}

fn check_stops(path: &Path, stops: &[Stop], inner: bool) -> Checked {
    if inner {
        return Err(
            Problem::new(path, Kind::Conflict, "a journey inside a journey").hint("write all the stops into one list")
        );
    }
    not_empty(path, stops.len())?;
    for (i, stop) in stops.iter().enumerate() {
        check_goal(&path.index(i).key("goal"), &stop.goal, true)?;
        if let Some(wait) = &stop.wait {
            check_number(&path.index(i).key("wait"), wait, Limit::NotNegative)?;
        }
    }
    Ok(())
}

pub(super) fn check_region(path: &Path, region: &Region) -> Checked {
    match region {
        Region::Disc(disc) => {
            check_point(&path.key("disc.center"), &disc.center)?;
            check(&path.key("disc.radius"), disc.radius, Limit::UpTo(super::limits::MAX_COORDINATE))
        }
        Region::Rectangle(r) => check_rectangle(&path.key("rectangle"), r),
        Region::Polygon(corners) => {
            check_points(&path.key("polygon"), corners)?;
            super::ground::check_polygon(&path.key("polygon"), corners, "the goal's area")
        }
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
    check_some(&path.key("fps"), view.fps, Limit::Between(0.001, 1000.0))?;
    check_some(&path.key("moment"), view.moment, Limit::NotNegative)?;
    check_some(&path.key("trails"), view.trails, Limit::NotNegative)
}

fn check_camera(path: &Path, camera: &Camera) -> Checked {
    for (key, spot) in [("eye", &camera.eye), ("target", &camera.target)] {
        if let Some(spot) = spot {
            check_spot(&path.key(key), spot)?;
        }
    }
    if camera.eye.is_some() && camera.eye == camera.target {
        let message = "the camera's eye and target are the same point";
        return Err(Problem::new(&path.key("eye"), Kind::Conflict, message).hint("move one of eye and target"));
    }
    check_some(&path.key("field_of_view"), camera.field_of_view, Limit::Between(1.0, 170.0))?;
    check_some(&path.key("orbit"), camera.orbit, Limit::Between(-3600.0, 3600.0))
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
