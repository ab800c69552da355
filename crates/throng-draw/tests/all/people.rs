//! People in pictures in perspective.

use glam::{DVec2, DVec3, Vec2};
use std::sync::Arc;
use throng_draw::{Color, Image, Motion, Painter, Projection, Style, Viewpoint, palette};
use throng_figure::{Build, Character, Joint, Level, Mesh, RestBody, Skeleton};
use throng_record::people::Walks;
use throng_record::{Body, Frame, Moments, Sample, Setting, Trajectories};

fn style() -> Style {
    let viewpoint = Viewpoint {
        eye: Some(DVec3::new(0.0, -9.0, 1.6)),
        target: Some(DVec3::new(0.0, 0.0, 0.9)),
        ..Viewpoint::default()
    };
    let projection = Some(Projection::Perspective);
    Style { width: 320, height: 240, projection, viewpoint, trails: 0.0, ..crate::common::style() }
}

fn setting() -> Setting {
    Setting { in_space: false, obstacles: Vec::new(), goals: Vec::new(), ..crate::common::setting() }
}

fn body(number: u32, group: u32, at: DVec2) -> Body {
    Body {
        number,
        group,
        goal: None,
        position: at,
        altitude: 0.0,
        velocity: Vec2::ZERO,
        vertical_velocity: 0.0,
        heading: 0.4,
        basis: None,
        radius: 0.25,
        core: Vec2::ZERO,
        ..crate::common::moment(0).bodies[0]
    }
}

fn frame(bodies: &[Body]) -> Frame {
    Frame { bodies: bodies.to_vec(), ..Frame::default() }
}

/// Returns the pixels that are not the same in two pictures, without shadows: those with a changed hue.
fn changed(a: &Image, b: &Image) -> Vec<(u32, u32)> {
    let hue = |color: Color| (i32::from(color.r) - i32::from(color.b), i32::from(color.g) - i32::from(color.b));
    let cells = (0..a.height()).flat_map(|y| (0..a.width()).map(move |x| (x, y)));
    let apart = |&(x, y): &(u32, u32)| {
        let ((p, q), (r, s)) = (hue(a.pixel(x, y)), hue(b.pixel(x, y)));
        (p - r).abs() + (q - s).abs() > 24
    };
    cells.filter(apart).collect()
}

#[test]
fn agents_are_as_tall_as_people_and_stand_where_they_are() {
    for (x, radius, heights) in [(0.0, 0.25, 1.45..1.95), (1.5, 0.13, 1.4..1.95), (-1.5, 0.08, 1.05..1.25)] {
        let body = Body { radius, ..body(7, 0, DVec2::new(x, 0.0)) };
        let mut painter = Painter::new(&setting(), &style(), &frame(&[body])).unwrap();
        let image = painter.paint(&frame(&[body])).clone();
        let cells = changed(&image, painter.paint(&Frame::default()));
        let (top, low) = (cells.iter().map(|at| at.1).min().unwrap(), cells.iter().map(|at| at.1).max().unwrap());
        let pixel = |z: f64| painter.pixel(DVec3::new(x, 0.0, z)).unwrap();
        let scale = f64::from(pixel(0.0).y - pixel(1.0).y);
        let tall = f64::from(low - top) / scale;
        assert!(heights.contains(&tall), "{tall} m, radius {radius} m");
        assert!((f64::from(low) - f64::from(pixel(0.0).y)).abs() < 0.2 * scale, "it stands on the ground");
        let middle = cells.iter().map(|at| at.0 as f32).sum::<f32>() / cells.len() as f32;
        assert!((middle - pixel(0.0).x).abs() < 0.25 * scale as f32);
    }
}

/// Returns a body of a file: throng's man, larger, and green from head to foot.
fn green_giant(height: f64) -> Character {
    let (mesh, skeleton) = (Mesh::new(Build::Man, Level::Medium), Skeleton::scaled(Build::Man, height));
    let count = mesh.positions.len();
    let body = RestBody {
        joints: skeleton.world(&skeleton.rest()).map(|joint| Some(joint.position)),
        positions: mesh.positions.iter().map(|position| position.as_dvec3() * height).collect(),
        normals: Vec::new(),
        numbers: mesh.joints,
        weights: mesh.weights,
        colours: vec![[20, 200, 20]; count],
        triangles: mesh.triangles,
    };
    Character::new(&body).unwrap()
}

#[test]
fn groups_with_bodies_of_files_are_drawn_with_them() {
    let bodies = [body(7, 0, DVec2::new(-1.2, 0.0)), body(8, 1, DVec2::new(1.2, 0.0))];
    let groups = vec!["giants".to_owned(), "people".to_owned()];
    let setting = Setting { groups, characters: vec![Some(Arc::new(green_giant(2.3)))], ..setting() };
    let mut painter = Painter::new(&setting, &style(), &frame(&bodies)).unwrap();
    let image = painter.paint(&frame(&bodies)).clone();
    let empty = painter.paint(&Frame::default()).clone();
    let scale = f64::from(painter.pixel(DVec3::ZERO).unwrap().y - painter.pixel(DVec3::Z).unwrap().y);
    let cells = changed(&image, &empty);
    let of = |left: bool| cells.iter().copied().filter(move |&(x, _)| (x < 160) == left);
    let tall = |left: bool| {
        let rows = || of(left).map(|(_, y)| y);
        f64::from(rows().max().unwrap() - rows().min().unwrap()) / scale
    };
    assert!((2.1..2.4).contains(&tall(true)), "{} m", tall(true));
    assert!((1.4..2.0).contains(&tall(false)), "{} m", tall(false));
    let green = |(x, y): (u32, u32)| {
        let color = image.pixel(x, y);
        color.g > color.r.max(color.b)
    };
    let share = |left: bool| of(left).filter(|&at| green(at)).count() as f64 / of(left).count() as f64;
    assert!(share(true) > 0.9 && share(false) < 0.5, "{} {}", share(true), share(false));
}

/// A person that walks on and turns by a right angle within one moment: only with its whole way known, its steps prepare the
/// turn. Pictures then show the planned joints, whatever was drawn before.
#[test]
fn people_with_known_ways_walk_as_planned() {
    let place = |time: f64| DVec2::new((1.3 * time).min(1.3) - 0.7, (1.3 * (time - 1.0)).max(0.0) - 0.7);
    let spot = |moment: u32| {
        let time = 0.04 * f64::from(moment);
        let heading = if time < 1.0 { 0.0 } else { std::f32::consts::FRAC_PI_2 };
        let known = body(7, 0, place(time));
        let Body { number, group, radius, status, .. } = known;
        Sample {
            number,
            group,
            time,
            place: place(time).extend(0.0),
            velocity: glam::Vec3::ZERO,
            heading,
            radius,
            status,
        }
    };
    let spots = (0..51).map(spot).collect();
    let character = Arc::new(green_giant(1.75));
    let setting = Setting { characters: vec![Some(character.clone())], ..setting() };
    let mut moments = Moments::of(Trajectories { setting, spots, ..Trajectories::default() });
    let frames = |moments: &Moments| -> Vec<Frame> {
        let capture = |moment: usize| {
            let mut frame = Frame::default();
            moments.capture(moment, &mut frame);
            frame
        };
        (0..moments.count()).map(capture).collect()
    };
    let frames = frames(&moments);
    let walks = Arc::new(Walks::of(&moments).unwrap());
    let live = Painter::new(&moments.setting, &style(), &frames[0]).unwrap();
    moments.setting.walks = Some(walks.clone());
    let planned = Painter::new(&moments.setting, &style(), &frames[0]).unwrap();
    let [mut live, mut planned] = [live, planned];
    let (walk, mut differ) = (walks.get(7).unwrap(), 0);
    let skeleton = character.skeleton(walk.person().height);
    for frame in &frames {
        let (image, extrapolated) = (planned.paint(frame).clone(), live.paint(frame).clone());
        let mut anew = Painter::new(&moments.setting, &style(), frame).unwrap();
        assert!(changed(&image, anew.paint(frame)).is_empty(), "at {} s", frame.time);
        let empty = anew.paint(&Frame { time: frame.time, ..Frame::default() }).clone();
        let cells = changed(&image, &empty);
        for joint in [Joint::Head, Joint::LeftFoot, Joint::RightFoot, Joint::LeftLeg, Joint::RightLeg] {
            let at = skeleton.world(&walk.pose(frame.time))[joint.index()].position;
            let at = planned.pixel(at).unwrap();
            let near = |&(x, y): &(u32, u32)| (Vec2::new(x as f32, y as f32) - at).length() < 4.0;
            assert!(cells.iter().any(near), "{joint:?} at {} s", frame.time);
        }
        differ += usize::from(changed(&image, &extrapolated).len() > 20);
    }
    assert!(differ > 5, "only {differ} pictures differ from those of people that know only what has been");
}

#[test]
fn clothes_show_groups_where_there_are_several() {
    let shown = |groups: &[u32]| {
        let bodies: Vec<Body> = groups
            .iter()
            .zip(0..)
            .map(|(&group, k)| body(k, group, DVec2::new(2.0 * f64::from(k) - 1.0, 0.0)))
            .collect();
        let mut painter = Painter::new(&setting(), &style(), &frame(&bodies)).unwrap();
        let image = painter.paint(&frame(&bodies)).clone();
        let chest = |k: usize| {
            let at = painter.pixel(bodies[k].center() + DVec3::Z * 1.1).unwrap();
            image.pixel(at.x as u32, at.y as u32)
        };
        [chest(0), chest(1)]
    };
    // light changes brightness; shares of red and blue stay
    let near = |a: Color, b: Color| {
        let share =
            |part: u8, color: Color| f32::from(part) / (f32::from(color.r) + f32::from(color.g) + f32::from(color.b));
        (share(a.r, a) - share(b.r, b)).abs() + (share(a.b, a) - share(b.b, b)).abs()
    };
    let two = shown(&[0, 1]);
    for (k, shown) in two.into_iter().enumerate() {
        let (own, other) = (near(shown, palette(k)), near(shown, palette(1 - k)));
        assert!(2.0 * own < other, "{shown:?} is group {k}: {own} from its colour, {other} from the other");
    }
    assert_ne!(shown(&[0, 0]), two, "people of one group have clothes of their own");
}

#[test]
fn people_walk_along_with_their_agents() {
    let moment = |k: u32| {
        let time = f64::from(k) / 25.0;
        let walks = Body { velocity: Vec2::X * 1.3, heading: 0.0, ..body(3, 0, DVec2::new(1.3 * (time - 0.5), 0.0)) };
        Frame { time, ..frame(&[walks]) }
    };
    let mut painter = Painter::new(&setting(), &style(), &moment(0)).unwrap();
    let ground = Painter::new(&setting(), &style(), &Frame::default()).unwrap().paint(&Frame::default()).clone();
    let scale = painter.pixel(DVec3::X).unwrap().x - painter.pixel(DVec3::ZERO).unwrap().x;
    let (mut middles, mut legs) = (Vec::new(), Vec::new());
    for k in 0..=25 {
        let cells = changed(painter.paint(&moment(k)), &ground);
        middles.push(cells.iter().map(|at| at.0 as f32).sum::<f32>() / cells.len() as f32 / scale);
        let low = cells.iter().map(|at| at.1).max().unwrap() as f32;
        let below: Vec<u32> = cells.iter().filter(|at| low - (at.1 as f32) < 0.4 * scale).map(|at| at.0).collect();
        legs.push((below.iter().max().unwrap() - below.iter().min().unwrap()) as f32 / scale);
    }
    assert!((middles[25] - middles[0] - 1.3).abs() < 0.1, "{middles:?} m");
    // Two steps: shins are side by side, and apart.
    let (least, most) =
        legs.iter().fold((f32::INFINITY, 0.0f32), |(low, high), wide| (low.min(*wide), high.max(*wide)));
    assert!(least < 0.5 && most > least + 0.25, "{legs:?} m");
}

#[test]
fn a_camera_that_keeps_the_crowd_in_the_picture_fills_it() {
    let bodies: Vec<Body> =
        (0..9).map(|k| body(k, 0, DVec2::from_angle(f64::from(k)) * 3.0 + DVec2::X * 40.0)).collect();
    let viewpoint = Viewpoint { motion: Motion::Crowd, ..Viewpoint::default() };
    let mut painter = Painter::new(&setting(), &Style { viewpoint, ..style() }, &frame(&bodies)).unwrap();
    painter.paint(&frame(&bodies));
    let pixels =
        bodies.iter().flat_map(|body| [0.0, 1.7].map(|z| painter.pixel(body.center() + DVec3::Z * z).unwrap()));
    let (low, high) = pixels.fold((Vec2::INFINITY, Vec2::ZERO), |(low, high), at| (low.min(at), high.max(at)));
    assert!(low.min_element() > 0.0 && high.x < 320.0 && high.y < 240.0, "{low} to {high}");
    assert!((high - low).x > 200.0 || (high - low).y > 150.0, "{low} to {high}");
}
