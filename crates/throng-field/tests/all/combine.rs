//! Fields made of fields, compared with their parts.

use glam::{DVec2, Vec2, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::field::Field;
use throng::space::Walls;
use throng::{Error, Obstacle};
use throng_field::{
    Anchor, Anchors, AroundWalls, Blend, Brush, FieldPart, Keyframes, Map, Sampled, Sketch, Sum, Uniform,
};

fn vector() -> impl Strategy<Value = Vec3> {
    (-3.0f32..3.0, -3.0f32..3.0).prop_map(|(x, y)| Vec3::new(x, y, 0.0))
}

fn whirl(place: Vec3, _: f64) -> Vec3 {
    Vec3::Z.cross(place)
}

proptest! {
    #[test]
    fn a_sum_adds_up(a in vector(), b in vector(), wa in -2.0f32..2.0, wb in -2.0f32..2.0, place in vector()) {
        let sum = Sum::new(vec![FieldPart::new(Uniform(a), wa), FieldPart::new(whirl, wb), FieldPart::new(Uniform(b), 1.0)]).unwrap();
        let expected = a * wa + Vec3::new(-place.y, place.x, 0.0) * wb + b;
        prop_assert!(sum.velocity(place, 3.0).distance(expected) < 1e-5);
    }

    /// Half of each part: the mean speed, in the direction between, in either order.
    #[test]
    fn a_blend_is_between_its_parts(a in vector(), b in vector()) {
        prop_assume!(a.length() > 0.01 && b.length() > 0.01);
        let (from, to) = (a.truncate().as_dvec2(), b.truncate().as_dvec2());
        let angle = from.perp_dot(to).atan2(from.dot(to));
        prop_assume!(angle.abs() < 3.1);
        let of = |first: Vec3, second: Vec3| Blend::new(vec![FieldPart::new(Uniform(first), 2.0), FieldPart::new(Uniform(second), 2.0)]).unwrap();
        let expected = (DVec2::from_angle(0.5 * angle).rotate(from.normalize()) * 0.5 * (from.length() + to.length())).as_vec2();
        for blend in [of(a, b), of(b, a)] {
            prop_assert!(blend.velocity(Vec3::ZERO, 0.0).truncate().distance(expected) < 1e-4);
        }
    }

    /// Between two keyframes the field through moving velocities is the field through the interpolated velocities.
    #[test]
    fn anchors_between_keyframes_are_anchors(
        anchors in prop::collection::vec((vector(), vector(), vector()), 3..12), part in 0.0f64..1.0, at in vector(),
    ) {
        let of = |velocity: &dyn Fn(Vec3, Vec3) -> Vec3| {
            let all: Vec<Anchor> = anchors.iter().map(|&(place, from, to)| {
                Anchor::new(place.truncate().as_dvec2() * 5.0, velocity(from, to).truncate().as_dvec2())
            }).collect();
            Anchors::new(&all, Sketch { smoothing: 1e-4, ..Sketch::default() }).unwrap()
        };
        let frames = vec![(5.0, Arc::new(of(&|from, _| from)) as Arc<dyn Field>), (9.0, Arc::new(of(&|_, to| to)))];
        let keyframes = Keyframes::new(frames, None).unwrap();
        let between = of(&|from, to| from.lerp(to, part as f32));
        let time = 5.0 + 4.0 * part;
        let most = 1.0 + between.velocity(at, 0.0).length();
        prop_assert!(keyframes.velocity(at, time).distance(between.velocity(at, 0.0)) < 1e-3 * most);
        let mut row = [Vec2::ZERO; 3];
        let (first, step) = (at.truncate().as_dvec2(), 0.7);
        keyframes.row((first, step), 0, time, &mut row);
        for (index, said) in row.into_iter().enumerate() {
            let one = keyframes.velocity(at + Vec3::X * (0.7 * index as f32), time).truncate();
            prop_assert!(said.distance(one) < 1e-3 * (1.0 + one.length()));
        }
    }

    /// Round discs: no flow into the wall, the original field far away, and the same speed everywhere.
    #[test]
    fn near_walls_a_field_leads_along_them(
        center in vector(), radius in 0.3f64..3.0, width in 0.2f64..2.0, angle in 0.0f64..std::f64::consts::TAU, out in 0.0f64..3.0, flow in vector(),
    ) {
        prop_assume!(flow.length() > 0.1);
        let center = center.truncate().as_dvec2() * 10.0;
        let walls = Walls::new(&[], &[Obstacle::Circle { center, radius }], DVec2::ZERO);
        let field = AroundWalls::new(Arc::new(Uniform(flow)), walls, width).unwrap();
        let normal = DVec2::from_angle(angle);
        let at = |out: f64| field.velocity((center + normal * (radius + out)).as_vec2().extend(0.0), 0.0).truncate().as_dvec2();
        let before = flow.truncate().as_dvec2();
        let wall = at(0.0);
        prop_assert!(wall.dot(normal) > -1e-3 * before.length(), "{} into the wall", wall.dot(normal));
        let near = at(out);
        if near != DVec2::ZERO {
            prop_assert!((near.length() - before.length()).abs() < 1e-4 * before.length());
        }
        prop_assert!(near.normalize_or_zero().dot(normal) >= before.normalize().dot(normal) - 1e-5);
        if out > width + 1e-3 {
            prop_assert_eq!(near.as_vec2(), flow.truncate());
        }
    }

    /// A brush sets the velocity along the stroke and nothing beyond its radius, and moves with the stroke.
    #[test]
    fn a_stroke_is_painted_where_it_is(
        from in vector(), angle in 0.0f64..std::f64::consts::TAU, length in 4.0f64..20.0, radius in 0.8f64..3.0, speed in 0.2f64..2.0, strength in 0.1f64..1.0,
        along in 0.2f64..0.8, aside in -2.0f64..2.0,
    ) {
        let from = from.truncate().as_dvec2();
        let way = DVec2::from_angle(angle);
        let mut field = Sampled::over(DVec2::splat(-30.0), DVec2::splat(30.0), 0.05 * radius).unwrap();
        let brush = Brush { radius, strength, hardness: 0.5 };
        field.paint(&brush, &[from, from + way * length], speed).unwrap();
        let at = from + way * (along * length) + way.perp() * (aside * radius);
        let said = field.velocity(at.as_vec2().extend(0.0), 0.0).truncate().as_dvec2();
        let part = ((aside.abs() - 0.5) / 0.5).clamp(0.0, 1.0);
        let cover = 1.0 - part * part * (3.0 - 2.0 * part);
        prop_assert!(said.distance(way * (speed * strength * cover)) < 0.02 * speed, "{said} at {aside}");
    }
}

#[test]
fn maps_say_how_much_and_where() {
    let mut map = Map::over(DVec2::splat(-5.0), DVec2::splat(5.0), 0.5).unwrap();
    map.paint(&Brush { radius: 1.0, strength: 1.0, hardness: 1.0 }, &[DVec2::ZERO], 0.5).unwrap();
    let part = FieldPart { map: Some(Arc::new(map)), ..FieldPart::new(Uniform(Vec3::X), 2.0) };
    let sum = Sum::new(vec![part.clone()]).unwrap();
    assert_eq!([0.0, 3.0, 50.0].map(|x| sum.velocity(Vec3::X * x, 0.0).x), [1.0, 0.0, 0.0]);
    // a single part that is not 0 is not blended
    let blend = Blend::new(vec![part, FieldPart::new(Uniform(Vec3::Y), 1.0)]).unwrap();
    assert_eq!(blend.velocity(Vec3::X * 3.0, 0.0), Vec3::Y);
    let both = blend.velocity(Vec3::ZERO, 0.0);
    assert!(both.distance(Vec3::new(1.0, 1.0, 0.0).normalize()) < 1e-6, "{both}");
}

#[test]
fn what_is_against_each_other_does_not_cancel_out() {
    let blend =
        Blend::new(vec![FieldPart::new(Uniform(Vec3::X), 1.0), FieldPart::new(Uniform(Vec3::NEG_X), 1.0)]).unwrap();
    assert!(blend.velocity(Vec3::ZERO, 0.0).distance(Vec3::Y) < 1e-6);
    let up =
        Blend::new(vec![FieldPart::new(Uniform(Vec3::Z), 1.0), FieldPart::new(Uniform(Vec3::NEG_Z), 1.0)]).unwrap();
    assert!((up.velocity(Vec3::ZERO, 0.0).length() - 1.0).abs() < 1e-6);
}

#[test]
fn keyframes_come_again_with_a_period() {
    let frames = [(2.0, Vec3::X), (4.0, Vec3::Y)].map(|(time, v)| (time, Arc::new(Uniform(v)) as Arc<dyn Field>));
    let tide = Keyframes::new(frames.to_vec(), Some(8.0)).unwrap();
    let at = |time| tide.velocity(Vec3::ZERO, time);
    assert_eq!([at(2.0), at(3.0), at(4.0)], [Vec3::X, Vec3::new(0.5, 0.5, 0.0), Vec3::Y]);
    // six seconds back to the first keyframe
    assert!(at(7.0).distance(Vec3::new(0.5, 0.5, 0.0)) < 1e-6);
    for time in [-7.5, 0.3, 5.5, 9.9] {
        assert!(at(time).distance(at(time + 16.0)) < 1e-5, "{time}");
    }
}

#[test]
fn what_has_been_rubbed_out_says_nothing() {
    let mut field = Sampled::of(&Uniform(Vec3::X), DVec2::splat(-5.0), DVec2::splat(5.0), 0.25, 0.0).unwrap();
    let brush = Brush { radius: 2.0, strength: 1.0, hardness: 0.9 };
    field.rub_out(&brush, &[DVec2::new(0.0, -5.0), DVec2::new(0.0, 5.0)]).unwrap();
    assert_eq!([0.0, 1.5, 3.0].map(|x| field.velocity(Vec3::new(x, 1.0, 0.0), 0.0).x), [0.0, 0.0, 1.0]);
}

/// In a corner of two walls the field is 0: it leads into neither wall.
#[test]
fn in_a_corner_it_ends() {
    let points = vec![DVec2::new(0.0, 10.0), DVec2::ZERO, DVec2::new(10.0, 0.0)];
    let walls = Walls::new(&[], &[Obstacle::Wall { points }], DVec2::ZERO);
    let field = AroundWalls::new(Arc::new(Uniform(Vec3::new(-1.0, -1.0, 0.0))), walls, 1.0).unwrap();
    let near = field.velocity(Vec3::new(0.02, 0.02, 0.0), 0.0);
    assert!(near.x > -1e-2 && near.y > -1e-2 || near == Vec3::ZERO, "{near}");
    let aside = field.velocity(Vec3::new(0.01, 5.0, 0.0), 0.0);
    assert!(aside.x > -1e-3 && (aside.y + 2f32.sqrt()).abs() < 1e-3, "{aside}");
}

#[test]
fn a_thin_wall_corrects_as_the_face_of_a_block_does() {
    let flow = Vec3::new(1.0, 0.3, 0.0);
    let beside = |obstacle: Obstacle, out: f32| {
        let walls = Walls::new(&[], &[obstacle], DVec2::ZERO);
        AroundWalls::new(Arc::new(Uniform(flow)), walls, 1.5).unwrap().velocity(Vec3::new(2.0 - out, 0.4, 0.0), 0.0)
    };
    for out in [0.05, 0.3, 0.75, 1.2] {
        let thin = beside(Obstacle::Wall { points: vec![DVec2::new(2.0, -9.0), DVec2::new(2.0, 9.0)] }, out);
        let block = beside(Obstacle::rectangle(DVec2::new(4.0, 0.0), DVec2::new(4.0, 18.0), 0.0), out);
        assert!(thin.distance(block) < 1e-5, "{out} m: {thin} beside a thin wall, {block} beside a block");
        let part = f64::from(out) / 1.5;
        let into = f64::from(flow.x) * part * part * (3.0 - 2.0 * part);
        let expected = DVec2::new(into, f64::from(flow.y)).normalize() * f64::from(flow.length());
        assert!(thin.truncate().as_dvec2().distance(expected) < 1e-5, "{out} m: {thin}, not {expected}");
    }
}

/// Beyond the end of a wall or the corner of a block both of its edges are nearest: they count once.
#[test]
fn a_corner_counts_once() {
    let wall = Obstacle::Wall { points: vec![DVec2::ZERO, DVec2::X * 4.0, DVec2::new(8.0, -4.0)] };
    let block = Obstacle::rectangle(DVec2::new(2.0, -2.0), DVec2::splat(4.0), 0.0);
    for (obstacle, corner) in [(wall, DVec2::X * 4.0), (block, DVec2::ZERO)] {
        let walls = Walls::new(&[], &[obstacle], DVec2::ZERO);
        let out = if corner == DVec2::ZERO { DVec2::new(-0.6, 0.8) } else { DVec2::new(0.1, 1.0).normalize() };
        let flow = -out.as_vec2().rotate(Vec2::from_angle(0.4));
        let field = AroundWalls::new(Arc::new(Uniform(flow.extend(0.0))), walls, 1.0).unwrap();
        let found = field.velocity((corner + out * 0.5).as_vec2().extend(0.0), 0.0).truncate().as_dvec2();
        let (into, along) = (flow.as_dvec2().dot(out), flow.as_dvec2().dot(out.perp()));
        let expected = (out * (0.5 * into) + out.perp() * along).normalize();
        assert!(found.distance(expected) < 1e-5, "{found}, not {expected}");
    }
}

#[test]
fn mistakes_are_told() {
    let limit = |result: Result<(), Error>, what: &str| match result {
        Err(Error::Limit { what: said, .. }) => assert_eq!(said, what),
        other => panic!("{what}: {other:?}"),
    };
    limit(Sum::new(vec![FieldPart::new(Uniform(Vec3::X), f32::NAN)]).map(drop), "weight of a field");
    limit(Blend::new(vec![FieldPart::new(Uniform(Vec3::X), -1.0)]).map(drop), "weight of a field");
    let mut field = Sampled::over(DVec2::ZERO, DVec2::ONE, 0.1).unwrap();
    let line = [DVec2::ZERO, DVec2::ONE];
    let brush = Brush::default();
    limit(field.paint(&Brush { radius: 0.0, ..brush }, &line, 1.0), "radius of a brush");
    limit(field.paint(&Brush { strength: 1.1, ..brush }, &line, 1.0), "strength of a brush");
    limit(field.paint(&Brush { hardness: f64::NAN, ..brush }, &line, 1.0), "hardness of a brush");
    limit(field.paint(&brush, &[DVec2::NAN], 1.0), "point of a stroke");
    limit(field.paint(&brush, &[DVec2::ZERO, DVec2::X * 1e9], 1.0), "length of a stroke");
    limit(field.paint(&brush, &line, f64::INFINITY), "speed of a stroke");
    limit(AroundWalls::new(Arc::new(whirl), Walls::default(), 0.0).map(drop), "width of a field's margin");
    let frame = |time: f64| (time, Arc::new(Uniform(Vec3::X)) as Arc<dyn Field>);
    limit(Keyframes::new(vec![frame(0.0), frame(5.0)], Some(5.0)).map(drop), "period of a field");
    for frames in
        [vec![], vec![frame(1.0), frame(1.0)], vec![frame(f64::NAN), frame(1.0)], vec![frame(f64::NEG_INFINITY)]]
    {
        assert!(matches!(Keyframes::new(frames, None), Err(Error::Shape { .. })));
    }
}

/// Beside a straight wall the component into the wall is removed by a smooth step of the distance, and the speed stays.
#[test]
fn what_is_taken_out_falls_smoothly_with_the_distance() {
    let corners = [(-50.0, -9.0), (50.0, -9.0), (50.0, 0.0), (-50.0, 0.0)].map(DVec2::from).to_vec();
    let walls = Walls::new(&[], &[Obstacle::Polygon { corners }], DVec2::ZERO);
    let flow = DVec2::new(1.2, -0.9);
    let field = AroundWalls::new(Arc::new(Uniform(flow.as_vec2().extend(0.0))), walls, 0.8).unwrap();
    for distance in [0.1, 0.2, 0.4, 0.6, 0.75] {
        let part: f64 = distance / 0.8;
        let left = DVec2::new(flow.x, flow.y * (3.0 * part.powi(2) - 2.0 * part.powi(3)));
        let found = field.velocity(Vec3::new(3.0, distance as f32, 0.0), 0.0).truncate().as_dvec2();
        assert!(found.distance(left.normalize() * 1.5) < 1e-5, "{found} at {distance}");
    }
}
