//! Surfaces and paths that behaviours steer by.

use super::ground::GroundError;
use super::limits::{Limit, check};
use super::steer::refused;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::DVec2;
use crate::import::obj;
use crate::scene::steer::{ObstacleNames, Position};
use crate::scene::{self, Form, Rod, Scene};
use glam::{Quat, Vec2, Vec3};
use std::sync::Arc;
use throng::space::Pathway;
use throng::space::surface::{
    Barrier, Capsule, Cuboid, Cylinder, HeightField, Moved, Plane, Pose, Prism, SeenFrom, Sphere, Surface,
};

/// Returns the surfaces of a scene, relative to an origin.
pub(super) fn surfaces(scene: &Scene, origin: DVec2) -> Result<Vec<Barrier<Arc<dyn Surface>>>, GroundError> {
    let one = |(i, surface): (usize, &scene::Surface)| {
        let path = Path::of("surface").index(i);
        check_name(&path, &surface.name, scene.surfaces[..i].iter().map(|other| &other.name))?;
        barrier(scene, surface, origin, &path).map_err(|wrong| match wrong {
            GroundError::Problem(problem) => GroundError::Problem(of("surface", &surface.name, problem)),
            error => error,
        })
    };
    scene.surfaces.iter().enumerate().map(one).collect()
}

/// Returns the paths of a scene, relative to an origin.
pub(super) fn paths(scene: &Scene, origin: DVec2) -> Result<Vec<Arc<Pathway>>, Problem> {
    let one = |(i, pathway): (usize, &scene::Pathway)| {
        let path = Path::of("path").index(i);
        check_name(&path, &pathway.name, scene.paths[..i].iter().map(|other| &other.name))?;
        let made = self::pathway(pathway, origin, &path).map_err(|problem| of("path", &pathway.name, problem))?;
        Ok(Arc::new(made))
    };
    scene.paths.iter().enumerate().map(one).collect()
}

/// Adds the name of a surface or path to a problem.
fn of(what: &str, name: &str, problem: Problem) -> Problem {
    Problem { message: format!("{what} `{name}`: {}", problem.message), ..problem }
}

/// Checks that a name is not empty, reserved or taken.
pub(super) fn check_name<'a>(
    path: &Path,
    name: &str,
    mut others: impl Iterator<Item = &'a String>,
) -> Result<(), Problem> {
    let path = path.key("name");
    if name.is_empty() {
        return Err(Problem::new(&path, Kind::MissingKey, "this name is empty").hint("behaviours find it by its name"));
    }
    if [ObstacleNames::EVERYTHING, ObstacleNames::OBSTACLES].contains(&name) {
        let message = format!("the name `{name}` means something else");
        return Err(Problem::new(&path, Kind::Conflict, message).hint("give it another name"));
    }
    if others.any(|other| other == name) {
        let message = format!("the name `{name}` is taken");
        return Err(Problem::new(&path, Kind::Conflict, message).hint("give each a name of its own"));
    }
    Ok(())
}

fn barrier(
    scene: &Scene,
    said: &scene::Surface,
    origin: DVec2,
    path: &Path,
) -> Result<Barrier<Arc<dyn Surface>>, GroundError> {
    let at = position(said.at, origin, &path.key("at"))?;
    let angles = [("heading", said.heading), ("pitch", said.pitch), ("roll", said.roll)];
    for (key, angle) in angles {
        check(&path.key(key), angle, Limit::Finite)?;
    }
    let turned = Pose::new(at, rotation(said)).map_err(|error| refused(path, &error))?;
    let moved: Arc<dyn Surface> = Arc::new(Moved::new(form(scene, said, &path.key("shape"))?, turned));
    let seen_from = match said.seen_from {
        scene::SeenFrom::Outside => SeenFrom::Outside,
        scene::SeenFrom::Inside => SeenFrom::Inside,
        scene::SeenFrom::Both => SeenFrom::Both,
    };
    Ok(Barrier::new(moved, seen_from))
}

/// Returns the rotation: first the roll, then the pitch, then the heading.
fn rotation(said: &scene::Surface) -> Quat {
    let half = |degrees: f64| libm::sincosf(0.5 * degrees.to_radians() as f32);
    let ((roll, r), (pitch, p), (heading, h)) = (half(said.roll), half(-said.pitch), half(said.heading));
    Quat::from_xyzw(
        roll * p * h - r * pitch * heading,
        r * pitch * h + roll * p * heading,
        r * p * heading - roll * pitch * h,
        r * p * h + roll * pitch * heading,
    )
}

/// Returns the shape about its own origin.
fn form(scene: &Scene, said: &scene::Surface, path: &Path) -> Result<Arc<dyn Surface>, GroundError> {
    fn shared<S: Surface + 'static>(
        path: &Path,
        made: Result<S, throng::Error>,
    ) -> Result<Arc<dyn Surface>, GroundError> {
        made.map(|surface| Arc::new(surface) as Arc<dyn Surface>).map_err(|error| refused(path, &error).into())
    }
    let vector = |[x, y, z]: [f64; 3]| Vec3::new(x as f32, y as f32, z as f32);
    let flat = |[x, y]: [f64; 2]| Vec2::new(x as f32, y as f32);
    let ends = |rod: &Rod| (vector(rod.from), vector(rod.to), rod.radius as f32);
    match &said.shape {
        Form::Sphere(ball) => shared(&path.key("sphere"), Sphere::new(Vec3::ZERO, ball.radius as f32)),
        Form::Box(block) => shared(&path.key("box"), Cuboid::new(vector(block.size))),
        Form::Plane(plane) => shared(&path.key("plane"), Plane::new(Vec3::ZERO, vector(plane.normal))),
        Form::Rectangle(sheet) => shared(&path.key("rectangle"), Cuboid::rectangle(flat(sheet.size))),
        Form::Cylinder(rod) => {
            let (from, to, radius) = ends(rod);
            shared(&path.key("cylinder"), Cylinder::new(from, to, radius))
        }
        Form::Capsule(rod) => {
            let (from, to, radius) = ends(rod);
            shared(&path.key("capsule"), Capsule::new(from, to, radius))
        }
        Form::Prism(column) => {
            let corners: Vec<Vec2> = column.corners.iter().copied().map(flat).collect();
            let bottom = column.bottom.map_or(f32::NEG_INFINITY, |z| z as f32);
            let top = column.top.map_or(f32::INFINITY, |z| z as f32);
            shared(&path.key("prism"), Prism::new(&corners, bottom, top))
        }
        Form::HeightField(field) => {
            let heights = field.heights.iter().map(|height| *height as f32).collect();
            let made = HeightField::new(Vec2::ZERO, field.cell as f32, field.columns as usize, heights);
            shared(&path.key("height_field"), made)
        }
        Form::Mesh(mesh) => {
            let up = match mesh.up {
                scene::Up::Y => obj::ObjUp::Y,
                scene::Up::Z => obj::ObjUp::Z,
            };
            let file = scene.origin.folder.join(&mesh.file);
            // errors in the file have their line in that file
            if !file.is_file() {
                let path = path.key("mesh.file");
                let problem = Problem::new(&path, Kind::File, format!("there is no file {}", file.display()));
                return Err(problem.hint("relative names refer to the scene file's folder").into());
            }
            obj::load(&file, up)
                .map(|mesh| Arc::new(mesh) as Arc<dyn Surface>)
                .map_err(|error| GroundError::Error(Box::new(error)))
        }
    }
}

fn pathway(said: &scene::Pathway, origin: DVec2, path: &Path) -> Result<Pathway, Problem> {
    let points = said.points.iter().enumerate();
    let points: Vec<Vec3> =
        points.map(|(i, at)| position(*at, origin, &path.key("points").index(i))).collect::<Result<_, _>>()?;
    match (said.radius, &said.radii) {
        (Some(radius), None) => Pathway::new(&points, radius as f32, said.cyclic),
        (None, Some(radii)) => {
            Pathway::with_radii(&points, &radii.iter().map(|radius| *radius as f32).collect::<Vec<_>>(), said.cyclic)
        }
        (both, _) => {
            let message = if both.is_some() { "there is a radius, and radii" } else { "there is no radius" };
            return Err(Problem::new(path, Kind::Conflict, message)
                .hint("give `radius = 1.0`, or `radii` with one for each segment"));
        }
    }
    .map_err(|error| refused(path, &error))
}

/// Converts a point of the scene to the coordinates of the world.
fn position(Position([x, y, z]): Position, origin: DVec2, path: &Path) -> Result<Vec3, Problem> {
    [x, y, z].iter().enumerate().try_for_each(|(i, x)| check(&path.index(i), *x, Limit::Finite))?;
    Ok((DVec2::new(x, y) - origin).as_vec2().extend(z as f32))
}
