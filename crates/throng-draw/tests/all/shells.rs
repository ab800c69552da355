//! Surfaces and paths in pictures: solids are opaque, containers are transparent, and paths lie on the ground.

use super::common::{moment, setting};
use glam::{DVec2, DVec3, Vec3};
use std::sync::Arc;
use throng::space::Pathway;
use throng::space::surface::{Barrier, Bounds, Cuboid, Moved, Pose, SeenFrom, Sphere, Surface};
use throng_draw::{Color, Painter, Projection, Style, Theme, Viewpoint, WorldBox};
use throng_record::{Frame, Setting, Shell};

const ORIGIN: DVec2 = DVec2::new(100.0, -30.0);
const WITHIN: Bounds = Bounds { low: Vec3::splat(-9.0), high: Vec3::splat(9.0) };

fn shell(surface: impl Surface + 'static, at: Vec3, seen_from: SeenFrom) -> Shell {
    let moved: Arc<dyn Surface> = Arc::new(Moved::new(surface, Pose::at(at).unwrap()));
    Shell::of(&Barrier::new(moved, seen_from), &WITHIN)
}

/// Returns a bowl on the left, a ball inside it, a box on the right, and a path in front of them.
fn place() -> Setting {
    let path = Pathway::new(&[Vec3::new(-7.0, -4.0, 0.0), Vec3::new(7.0, -4.0, 0.0)], 0.8, false).unwrap();
    Setting {
        obstacles: Vec::new(),
        goals: Vec::new(),
        origin: ORIGIN,
        shells: vec![
            shell(Sphere::new(Vec3::ZERO, 0.5).unwrap(), Vec3::new(-3.0, 1.0, 3.0), SeenFrom::Outside),
            shell(Sphere::new(Vec3::ZERO, 3.0).unwrap(), Vec3::new(-3.0, 1.0, 3.0), SeenFrom::Inside),
            shell(Cuboid::new(Vec3::new(2.0, 3.0, 4.0)).unwrap(), Vec3::new(4.0, 1.0, 2.0), SeenFrom::Outside),
        ],
        paths: vec![Arc::new(path)],
        ..setting()
    }
}

fn empty() -> Frame {
    Frame { bodies: Vec::new(), ..moment(0) }
}

/// Returns a function for the colour of a point, metres from the origin.
fn looker(setting: &Setting, style: &Style) -> impl Fn([f64; 3]) -> Color + use<> {
    let mut painter = Painter::new(setting, style, &empty()).unwrap();
    let image = painter.paint(&empty()).clone();
    move |point| {
        let pixel = painter.pixel(DVec3::from(point) + ORIGIN.extend(0.0)).expect("the point is visible");
        image.pixel(pixel.x as u32, pixel.y as u32)
    }
}

fn apart(a: Color, b: Color) -> i32 {
    [(a.r, b.r), (a.g, b.g), (a.b, b.b)].iter().map(|&(a, b)| (i32::from(a) - i32::from(b)).abs()).sum()
}

fn plan() -> Style {
    let half = DVec2::new(8.0, 6.0);
    let view = Some(WorldBox { min: ORIGIN - half, max: ORIGIN + half });
    Style { width: 640, height: 480, view, projection: Some(Projection::Plan), ..crate::common::style() }
}

#[test]
fn from_above_solids_are_filled_and_containers_are_outlines() {
    let look = looker(&place(), &plan());
    let Theme { ground, obstacle, .. } = Theme::light();
    // Lines of the bowl can cover both.
    assert!(apart(look([-3.0, 1.0, 0.0]), obstacle) < 10, "the ball");
    assert_eq!(look([4.0, 1.0, 0.0]), obstacle, "the box");
    assert_eq!(look([4.9, 2.4, 0.0]), obstacle, "to its corner");
    assert!(apart(look([-3.0, 2.5, 0.0]), ground) < 10, "in the bowl");
    assert_eq!(look([0.5, 3.0, 0.0]), ground, "beside everything");
    assert!((0..100).any(|k| apart(look([-0.1 + 0.002 * f64::from(k) - 0.05, 1.0, 0.0]), ground) > 60), "its rim");
    let tube = look([1.0, -4.5, 0.0]);
    assert!((6..60).contains(&apart(tube, ground)), "the path is faint: {tube:?}");
    assert_eq!(look([1.0, -5.0, 0.0]), ground, "beyond its radius");
    let spine = (0..40).map(|k| apart(look([1.0, -4.04 + 0.002 * f64::from(k), 0.0]), ground)).max();
    assert!(spine > Some(apart(tube, ground) + 20), "its spine is darker");
}

#[test]
fn in_perspective_containers_are_transparent_and_solids_are_opaque() {
    let viewpoint = Viewpoint {
        eye: Some((ORIGIN + DVec2::new(0.0, -25.0)).extend(6.0)),
        target: Some(ORIGIN.extend(2.0)),
        ..Viewpoint::default()
    };
    let style = Style { projection: Some(Projection::Perspective), viewpoint, ..plan() };
    let look = looker(&place(), &style);
    let bare = looker(&Setting { shells: Vec::new(), ..place() }, &style);
    assert!(apart(look([-3.0, 0.5, 3.0]), bare([-3.0, 0.5, 3.0])) > 40, "the ball in the bowl");
    assert!(apart(look([4.0, -0.5, 1.5]), bare([4.0, -0.5, 1.5])) > 40, "the front of the box");
    assert!(apart(look([4.0, -0.5, 1.5]), look([4.0, 1.0, 4.0])) > 10, "its top is lighter");
    let clear = |dx: f64| {
        let point = [-3.0 + dx, -1.0, 4.2];
        apart(look(point), bare(point)) == 0
    };
    let seen = (0..60).filter(|&k| clear(-1.5 + 0.05 * f64::from(k))).count();
    assert!((30..60).contains(&seen), "through the bowl but for its lines: {seen} of 60");
    let open = [1.0, -4.5, 0.0];
    assert!(apart(look(open), Theme::light().ground) > 5, "the path lies on the ground");
}

#[test]
fn surfaces_and_paths_are_in_view() {
    let all = WorldBox::of(&place(), &empty()).unwrap();
    assert!((all.min - ORIGIN).distance(DVec2::new(-7.8, -4.8)) < 0.01, "{all:?}");
    assert!((all.max - ORIGIN).distance(DVec2::new(7.8, 4.0)) < 0.06, "{all:?}");
}
