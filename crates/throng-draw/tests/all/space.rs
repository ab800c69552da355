//! The contents of pictures in perspective.

use super::common::elements;
use glam::{DVec2, DVec3, Vec2, Vec3};
use throng::motion::{Basis, Locomotion, Vehicle};
use throng::steer::Target;
use throng::{Agent, Goal, Group, Obstacle, Settings, World};
use throng_draw::{
    Chase, Color, ColorBy, Following, Image, Look, Motion, Painter, Projection, Style, Viewpoint, palette, ramp,
};
use throng_record::{Body, Frame, Setting};
use throng_steer::Seek;

fn setting() -> Setting {
    Setting { in_space: true, obstacles: Vec::new(), goals: Vec::new(), ..crate::common::setting() }
}

/// Returns a style with a view from the south, twelve metres away, five metres up.
fn style() -> Style {
    let viewpoint = Viewpoint {
        eye: Some(DVec3::new(0.0, -12.0, 5.0)),
        target: Some(DVec3::new(0.0, 0.0, 4.0)),
        ..Viewpoint::default()
    };
    Style { width: 320, height: 240, view: None, viewpoint, ..crate::common::style() }
}

fn body(number: u32, at: DVec3) -> Body {
    let body = crate::common::moment(0).bodies[0];
    Body { number, group: number, goal: None, position: at.truncate(), altitude: at.z as f32, ..body }
}

fn frame(bodies: &[Body]) -> Frame {
    Frame { bodies: bodies.to_vec(), ..Frame::default() }
}

fn paint(setting: &Setting, style: &Style, frame: &Frame) -> (Painter, Image) {
    let mut painter = Painter::new(setting, style, frame).unwrap();
    let image = painter.paint(frame).clone();
    (painter, image)
}

fn at(painter: &Painter, image: &Image, point: DVec3) -> Color {
    let pixel = painter.pixel(point).expect("the point is visible");
    image.pixel(pixel.x as u32, pixel.y as u32)
}

/// Returns the number of differing pixels.
fn changed(a: &Image, b: &Image) -> usize {
    a.data().chunks_exact(4).zip(b.data().chunks_exact(4)).filter(|(a, b)| a != b).count()
}

fn apart(a: Color, b: Color) -> i32 {
    [(a.r, b.r), (a.g, b.g), (a.b, b.b)].iter().map(|&(a, b)| (i32::from(a) - i32::from(b)).abs()).sum()
}

/// Returns a document without the bytes of its pictures.
fn shapes_of(svg: &str) -> String {
    let mut parts = svg.split("base64,");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.filter_map(|part| part.split_once('"')).fold(first, |text, (_, rest)| text + rest)
}

#[test]
fn in_space_high_is_up_and_far_is_small_and_pale() {
    let (near, far) = (DVec3::new(-2.0, 0.0, 4.0), DVec3::new(-2.0, 40.0, 4.0));
    let size = |place: DVec3| {
        let (mut painter, image) = paint(&setting(), &style(), &frame(&[body(0, place)]));
        changed(&image, painter.paint(&Frame::default()))
    };
    assert!(size(near) > 4 * size(far), "{} and {} pixels", size(near), size(far));
    let both = frame(&[body(0, near), Body { group: 0, ..body(1, far) }]);
    let (mut painter, image) = paint(&setting(), &style(), &both);
    let empty = painter.paint(&Frame::default()).clone();
    let shown = |place: DVec3| apart(at(&painter, &image, place), at(&painter, &empty, place));
    assert!(shown(near) > shown(far) + 20, "{} and {}", shown(near), shown(far));
    let pixel = |z: f64| painter.pixel(DVec3::new(0.0, 0.0, z)).unwrap();
    assert!(pixel(5.0).y < pixel(4.0).y - 10.0 && pixel(4.0) == Vec2::new(160.0, 120.0));
    assert_eq!(painter.pixel(DVec3::new(0.0, -13.0, 5.0)), None, "the point is behind the viewpoint");
}

#[test]
fn near_bodies_cover_far_ones_and_obstacles_hide_bodies() {
    let eye = style().viewpoint.eye.unwrap();
    let behind = DVec3::new(0.0, 6.0, 4.0);
    let before = eye.lerp(behind, 0.6);
    let shown = |first: DVec3, second: DVec3, setting: &Setting| {
        let bodies = [body(0, first), Body { radius: 0.2, ..body(1, second) }];
        let (painter, image) = paint(setting, &style(), &frame(&bodies));
        at(&painter, &image, before)
    };
    let is = |color: Color, group: usize| apart(color, palette(group)) < apart(color, palette(1 - group));
    assert!(is(shown(before, behind, &setting()), 0) && is(shown(behind, before, &setting()), 1));
    let tower = |y: f64| {
        let corners = Obstacle::rectangle(DVec2::new(0.0, y), DVec2::new(3.0, 0.5), 0.0);
        Setting { obstacles: vec![corners], ..setting() }
    };
    // As high as the flying agents: seen from above, it hides little behind it.
    let high = body(2, DVec3::new(6.0, 20.0, 9.0));
    let hidden = |y: f64| {
        let picture = |bodies: &[Body]| {
            let (painter, image) = paint(&tower(y), &style(), &frame(bodies));
            at(&painter, &image, behind)
        };
        picture(&[body(0, behind), high]) == picture(&[high])
    };
    assert!(hidden(0.0) && !hidden(12.0));
}

/// The sun is high, and to the left behind the viewpoint.
#[test]
fn a_shadow_lies_below_and_away_from_the_sun() {
    let body = body(0, DVec3::new(1.0, 2.0, 5.0));
    let style = Style { goals: false, ..style() };
    let (mut painter, image) = paint(&setting(), &style, &frame(&[body]));
    let empty = painter.paint(&Frame::default()).clone();
    let points = (-40..80).flat_map(|x| (-40..120).map(move |y| DVec3::new(f64::from(x), f64::from(y), 0.0) * 0.1));
    let dark = |point: &DVec3| {
        painter.pixel(*point).is_some_and(|pixel| pixel.cmpge(Vec2::ZERO).all() && pixel.x < 320.0 && pixel.y < 240.0)
            && at(&painter, &image, *point).r.saturating_add(16) < at(&painter, &empty, *point).r
    };
    let shadow: Vec<DVec3> = points.filter(dark).collect();
    let middle = shadow.iter().sum::<DVec3>() / shadow.len() as f64;
    let off = (middle - body.center()).truncate();
    assert!(
        !shadow.is_empty() && off.x > 0.5 && off.y > 0.5 && off.length() < 3.0,
        "{} places about {off}",
        shadow.len()
    );
}

#[test]
fn vehicles_show_how_they_climb_and_bank() {
    let of = |basis: Option<Basis>| {
        let body = Body { basis, ..body(0, DVec3::new(0.0, 0.0, 4.0)) };
        paint(&setting(), &style(), &frame(&[body])).1
    };
    let level = Basis::facing(Vec3::X);
    let banked = level.turned_to(Vec3::X, Vec3::new(0.0, -1.0, 1.0));
    let pictures = [None, Some(level), Some(Basis::facing(Vec3::new(1.0, 0.0, 1.0))), Some(banked)].map(of);
    for (k, a) in pictures.iter().enumerate() {
        for b in &pictures[..k] {
            assert!(changed(a, b) > 60, "{} pixels", changed(a, b));
        }
    }
}

#[test]
fn the_eye_orbits_and_the_same_moments_give_the_same_picture() {
    let viewpoint = Viewpoint { motion: Motion::Orbit(90.0), ..style().viewpoint };
    let style = Style { viewpoint, legend: true, trails: 1.0, ..style() };
    let moment = |k: u32| {
        let bodies = [body(0, DVec3::new(2.0, f64::from(k) * 0.1, 4.0)), body(1, DVec3::new(0.0, 0.0, 3.0))];
        Frame { time: f64::from(k) * 0.1, ..frame(&bodies) }
    };
    let mut painter = Painter::new(&setting(), &style, &moment(0)).unwrap();
    let mut other = Painter::new(&setting(), &style, &moment(0)).unwrap();
    let east = DVec3::new(3.0, 0.0, 4.0);
    let start = painter.pixel(east).unwrap();
    for k in 0..10 {
        painter.follow(&moment(k));
        other.paint(&moment(k));
    }
    assert_eq!(painter.paint(&moment(10)), other.paint(&moment(10)));
    let quarter = painter.pixel(east).unwrap();
    assert!(start.x > 200.0 && (quarter.x - 160.0).abs() < 1e-2, "in the middle, seen from the east: {quarter}");
    let svg = painter.svg(&moment(10));
    assert!(svg.contains("<image") && elements(&svg) > 5);
    assert!(!shapes_of(&svg).contains("NaN") && !shapes_of(&svg).contains("inf"));
}

/// In every way of following, the followed agent stays in view, and the viewpoint stays where it is once the agent is
/// gone.
#[test]
fn an_eye_follows_an_agent() {
    let moment = |k: u32| {
        let way = f64::from(k) * 0.2;
        Frame { time: way, ..frame(&[body(0, DVec3::ZERO), body(7, DVec3::new(way, 30.0 + way, 0.0))]) }
    };
    for chase in [Chase::Distance, Chase::Offset, Chase::PointOfView, Chase::Down] {
        let motion = Motion::Follow(Following { number: 7, chase, aside: 30.0 });
        let style = Style { viewpoint: Viewpoint { motion, ..style().viewpoint }, ..style() };
        let mut painter = Painter::new(&setting(), &style, &moment(0)).unwrap();
        for k in 0..40 {
            let now = moment(k);
            painter.paint(&now);
            // From its own point of view the agent is not visible, but the point ahead of it is.
            let away = if chase == Chase::PointOfView { 20.0 * f64::from(now.bodies[1].radius) } else { 0.0 };
            let pixel = painter.pixel(now.bodies[1].center() + DVec3::X * away).expect("the point is visible");
            assert!(pixel.distance(Vec2::new(160.0, 120.0)) < 90.0, "{chase:?} at {k}: {pixel}");
        }
        let before = painter.pixel(DVec3::new(8.0, 38.0, 0.0));
        painter.paint(&Frame { time: 9.0, ..frame(&[body(0, DVec3::ZERO)]) });
        assert_eq!(painter.pixel(DVec3::new(8.0, 38.0, 0.0)), before);
    }
}

#[test]
fn colours_show_density_and_time_to_goal() {
    let crowd: Vec<Body> = (0..5).map(|k| body(k, DVec3::new(0.3 * f64::from(k), 0.0, 0.0))).collect();
    let lone = body(9, DVec3::new(20.0, 0.0, 0.0));
    let all = Frame { bodies: [&crowd[..], &[lone]].concat(), ..Frame::default() };
    let look = |color_by, frame: &Frame| Look::new(&setting(), &Style { color_by, ..style() }, frame);
    let dense = look(ColorBy::Density, &all);
    // Five agents within 1.5 m.
    let area = std::f32::consts::PI * 1.5 * 1.5;
    assert_eq!((dense.color(&crowd[2]), dense.color(&lone)), (ramp(5.0 / area / 4.0), ramp(1.0 / area / 4.0)));
    let goals = vec![Goal::Point { at: DVec2::new(0.0, 10.0), tolerance: 0.1 }];
    let to = |y: f64| Body { goal: Some(0), preferred_speed: 2.0, ..body(0, DVec3::new(0.0, y, 0.0)) };
    let setting = Setting { goals, ..setting() };
    let style = Style { color_by: ColorBy::TimeToGoal, ..style() };
    let look = Look::new(&setting, &style, &frame(&[to(0.0)]));
    assert_eq!((look.color(&to(0.0)), look.color(&to(5.0)), look.color(&to(10.0))), (ramp(1.0), ramp(0.5), ramp(0.0)));
}

#[test]
fn invalid_numbers_and_any_viewpoint_do_not_panic() {
    let mut broken = body(0, DVec3::NAN);
    broken.radius = f32::INFINITY;
    let setting = Setting {
        obstacles: vec![
            Obstacle::Wall { points: Vec::new() },
            Obstacle::Polygon { corners: vec![DVec2::NAN; 3] },
            Obstacle::Circle { center: DVec2::ZERO, radius: -1.0 },
        ],
        ..setting()
    };
    let spot = DVec3::new(0.0, 0.0, 5.0);
    for (eye, target) in [(spot, spot), (spot, DVec3::ZERO), (DVec3::ZERO, spot)] {
        let viewpoint = Viewpoint { eye: Some(eye), target: Some(target), ..Viewpoint::default() };
        let style = Style { viewpoint, legend: true, trails: 1.0, ..style() };
        let (mut painter, _) = paint(&setting, &style, &frame(&[broken, body(1, spot), body(2, spot - 1.0)]));
        let svg = shapes_of(&painter.svg(&frame(&[broken, body(1, spot)])));
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
    }
    let flat = Style { projection: Some(Projection::Perspective), ..Style::default() };
    paint(&Setting::default(), &flat, &Frame::default());
}

#[test]
fn frames_hold_the_bases_of_flying_vehicles() {
    let mut world = World::new(Settings::default()).unwrap();
    let seek = Seek { target: Target::Point(Vec3::new(9.0, 9.0, 20.0)) };
    let group = world.add_group(Group { guard: true, ..Group::steered(seek) }).unwrap();
    for (k, locomotion) in [Locomotion::Banking, Locomotion::Ground].into_iter().enumerate() {
        let vehicle = Vehicle { locomotion, ..Vehicle::default() };
        let position = DVec3::new(0.0, 4.0 * k as f64, if k == 0 { 8.0 } else { 0.0 });
        world.add_agent(Agent { position, group, ..Agent::default() }.motor(vehicle)).unwrap();
    }
    (0..60).for_each(|_| world.step());
    let bodies = Frame::of(&world).bodies;
    let basis = bodies[0].basis.expect("the vehicle flies");
    assert!(basis.forward.z > 0.2 && bodies[1].basis.is_none(), "{basis:?}");
}
