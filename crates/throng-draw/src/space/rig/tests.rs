//! Tests of moving viewpoints.

use super::*;
use crate::WorldBox;
use throng_record::Setting;

/// Returns how far from the edges of a room all points are, pixels: the least.
fn inside(lens: &Lens, points: &[DVec3], (low, high): (Vec2, Vec2)) -> f32 {
    let pixel = |point: &DVec3| lens.pixel(*point).expect("the point is before the viewpoint");
    points.iter().map(pixel).fold(f32::INFINITY, |least, at| least.min((at - low).min(high - at).min_element()))
}

#[test]
fn everything_is_in_the_picture_all_the_way_round() {
    let room = (Vec2::splat(20.0), Vec2::new(620.0, 460.0));
    let ground = WorldBox { min: DVec2::new(10.0, -3.0), max: DVec2::new(40.0, 2.0) };
    for (height, orbit) in [(0.0, 0.0), (12.0, 0.0), (90.0, 0.0), (12.0, 20.0)] {
        let setting = Setting {
            in_space: true,
            walkable: vec![throng::Walkable { outer: vec![DVec2::ZERO; 3], ..Default::default() }],
            ..Setting::default()
        };
        let body = Body { altitude: height as f32, radius: 0.0, ..body(DVec2::new(20.0, 0.0)) };
        let extent = Extent::of(ground, true, &setting, &Frame { bodies: vec![body], ..Frame::default() });
        let motion = if orbit == 0.0 { Motion::Still } else { Motion::Orbit(orbit) };
        let mut rig = Rig::new(&Viewpoint { motion, ..Viewpoint::default() }, &extent, 480, room);
        let least = (0..18).map(|time| {
            let lens = rig.turn(&Frame { time: f64::from(time), ..Frame::default() });
            inside(&lens, &extent.points(false), room)
        });
        let tightest = least.fold(f32::INFINITY, f32::min);
        assert!((-1e-3..60.0).contains(&tightest), "{height} m high, {orbit} degrees a second: {tightest} pixels");
    }
}

fn body(position: DVec2) -> Body {
    Body { position, velocity: Vec2::ZERO, radius: 0.25, ..crate::harness::body() }
}

#[test]
fn a_crowd_fills_the_picture_wherever_it_goes() {
    let room = (Vec2::splat(20.0), Vec2::new(620.0, 460.0));
    let moment = |time: f64| {
        let spread = 3.0 + 0.5 * time;
        let bodies = (0..12).map(|k| {
            let out = DVec2::from_angle(f64::from(k));
            let velocity = if time < 20.0 { out * 0.5 + DVec2::X * 1.2 } else { DVec2::ZERO };
            let at = out * spread + DVec2::X * 1.2 * time;
            Body { velocity: velocity.as_vec2(), ..body(at) }
        });
        Frame { time, bodies: bodies.collect(), ..Frame::default() }
    };
    let ground = WorldBox { min: DVec2::splat(-90.0), max: DVec2::splat(90.0) };
    let extent = Extent::of(ground, true, &Setting::default(), &moment(0.0));
    let mut rig = Rig::new(&Viewpoint { motion: Motion::Crowd, ..Viewpoint::default() }, &extent, 480, room);
    for k in 0..500 {
        let frame = moment(f64::from(k) / 25.0);
        let lens = rig.turn(&frame);
        let least = inside(&lens, &people(&frame, 0.0).collect::<Vec<_>>(), room);
        assert!((-8.0..90.0).contains(&least), "{least} pixels after {} s", frame.time);
    }
    let rest = rig.turn(&Frame { time: 30.0, ..moment(20.0) });
    let least = inside(&rest, &people(&moment(20.0), 0.0).collect::<Vec<_>>(), room);
    assert!((-1.0..8.0).contains(&least), "{least} pixels at rest");
}

#[test]
fn the_film_cuts_when_an_agent_is_moved_out_of_the_picture() {
    let room = (Vec2::splat(20.0), Vec2::new(620.0, 460.0));
    let moment = |time: f64, away: f64| {
        let bodies = (0..5).map(|k| Body {
            number: k,
            ..body(DVec2::from_angle(f64::from(k)) * 4.0 + if k == 0 { DVec2::X * away } else { DVec2::ZERO })
        });
        Frame { time, bodies: bodies.collect(), ..Frame::default() }
    };
    let ground = WorldBox { min: DVec2::splat(-90.0), max: DVec2::splat(90.0) };
    let extent = Extent::of(ground, true, &Setting::default(), &moment(0.0, 0.0));
    let rig = || Rig::new(&Viewpoint { motion: Motion::Crowd, ..Viewpoint::default() }, &extent, 480, room);
    let least = |rig: &mut Rig, frame: &Frame| inside(&rig.turn(frame), &people(frame, 0.0).collect::<Vec<_>>(), room);
    let mut cut = rig();
    assert!(least(&mut cut, &moment(0.0, 0.0)) > -1.0);
    assert!(least(&mut cut, &moment(0.1, 60.0)) > -1.0, "all are in the picture at once");
    // a small step within the picture does not cut
    let (mut slow, mut fresh) = (rig(), rig());
    slow.turn(&moment(0.0, 0.0));
    slow.turn(&moment(0.1, -2.0));
    fresh.turn(&moment(0.1, -2.0));
    let [eye, cut_to] = [&slow, &fresh].map(|rig| rig.now.unwrap().0.eye);
    assert!(eye.distance(cut_to) > 0.1, "it approaches: {eye} {cut_to}");
}

#[test]
fn beside_an_agent_the_viewpoint_keeps_its_direction_and_lags_by_the_way_of_a_second() {
    let room = (Vec2::splat(20.0), Vec2::new(620.0, 460.0));
    let viewpoint = Viewpoint {
        eye: Some(DVec3::new(0.0, -30.0, 20.0)),
        target: Some(DVec3::ZERO),
        motion: Motion::Beside(0),
        ..Viewpoint::default()
    };
    let ground = WorldBox { min: DVec2::splat(-90.0), max: DVec2::splat(90.0) };
    let mut rig = Rig::new(&viewpoint, &Extent::of(ground, true, &Setting::default(), &Frame::default()), 480, room);
    for k in 0..=1000 {
        let at = DVec2::X * 0.05 * f64::from(k);
        rig.turn(&Frame { time: 0.01 * f64::from(k), bodies: vec![body(at)], ..Frame::default() });
    }
    let (sight, _) = rig.now.unwrap();
    assert!((sight.eye - sight.target).distance(DVec3::new(0.0, -30.0, 20.0)) < 1e-6);
    assert!((50.0 - sight.target.x - 5.0).abs() < 0.05, "5 m/s: {}", sight.target.x);
}

/// Returns the distance of the viewpoint from a small group of agents of a size, metres.
fn distance_from(radius: f32, flies: bool) -> f64 {
    let basis = flies.then(throng::motion::Basis::default);
    let spread = 4.0 * f64::from(radius);
    let bodies = (0..6).map(|k| {
        let at = DVec2::from_angle(f64::from(k)) * spread;
        Body { radius, basis, altitude: if flies { 2.0 } else { 0.0 }, ..body(at) }
    });
    let frame = Frame { bodies: bodies.collect(), ..Frame::default() };
    let ground = WorldBox { min: DVec2::splat(-9.0), max: DVec2::splat(9.0) };
    let extent = Extent::of(ground, true, &Setting::default(), &frame);
    let viewpoint = Viewpoint { motion: Motion::Crowd, ..Viewpoint::default() };
    let mut rig = Rig::new(&viewpoint, &extent, 480, (Vec2::splat(20.0), Vec2::new(620.0, 460.0)));
    rig.turn(&frame);
    let (sight, _) = rig.now.expect("the viewpoint follows the crowd");
    sight.eye.distance(sight.target)
}

#[test]
fn the_least_distance_is_that_of_the_size_of_the_agents() {
    for (radius, flies, least) in [(0.2, false, 6.0), (0.4, true, 6.0), (0.01, true, 0.5), (0.005, true, 0.25)] {
        let distance = distance_from(radius, flies);
        assert!((distance - least).abs() < 0.5 * least, "{distance} m from agents of {radius} m");
        assert!(distance >= least - 1e-6, "{distance} m from agents of {radius} m");
    }
}
