//! Noise along walls: no flow through walls, and the potential of the definition, by distances in `f64`.

use super::reference::{Reference, curl, ramp};
use super::{ALL, Chance, UNIT, unit};
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::space::surface::{Capsule, Cuboid, Cylinder, Moved, Pose, Prism, Sphere, Surface, Union};
use throng_field::{CurlNoise, NoiseWall, Octave, Potential, Rigid};

const CENTER: Vec3 = Vec3::new(3.0, -2.0, 1.5);

const CORNERS: [(f32, f32); 5] = [(2.0, -3.0), (5.0, -3.0), (5.0, 0.0), (4.0, -1.5), (2.0, 0.0)];

fn moved(surface: impl Surface + 'static) -> Arc<dyn Surface> {
    let pose = Pose::new(CENTER, Quat::from_xyzw(0.3, -0.2, 0.5, 0.8)).unwrap();
    Arc::new(Moved::new(surface, pose))
}

/// Solids round the same place.
fn solids() -> Vec<Arc<dyn Surface>> {
    let corners = CORNERS.map(Vec2::from);
    let ball = |offset: f32| Sphere::new(CENTER + Vec3::X * offset, 1.0).unwrap();
    vec![
        Arc::new(ball(0.0)),
        moved(Cuboid::new(Vec3::new(2.0, 1.0, 3.0)).unwrap()),
        Arc::new(Capsule::new(CENTER, CENTER + Vec3::new(1.0, 2.0, 0.5), 0.7).unwrap()),
        moved(Cylinder::new(-Vec3::Z, Vec3::Z, 0.8).unwrap()),
        Arc::new(Prism::new(&corners, 0.0, 2.5).unwrap()),
        Arc::new(Prism::ground(&corners).unwrap()),
        Arc::new(Union::new(vec![Arc::new(ball(-0.6)), Arc::new(ball(0.6))]).unwrap()),
    ]
}

fn noise(potential: Potential) -> CurlNoise {
    CurlNoise::new(potential, &Octave::turbulence(0.8, 1.0, 1.0, 2).unwrap(), 21).unwrap()
}

/// Places on a surface, and the normals there; on an edge, one of the normals. On the union of two overlapping solids
/// the nearest point to a place inside may lie within the other solid: such points are left out.
fn on_it(surface: &dyn Surface, chance: &mut Chance, count: usize) -> Vec<(Vec3, Vec3)> {
    let mut near = || {
        let place = surface.query(CENTER + chance.place(3.0)).point;
        (place, surface.query(place))
    };
    let all = std::iter::repeat_with(&mut near).filter(|(_, near)| near.distance.abs() < 1e-5);
    all.take(count).map(|(place, near)| (place, near.normal)).collect()
}

/// From both sides, with other walls so near that their influences overlap. Along the ground, surfaces that are not
/// upright are cut at the height of the place.
#[test]
fn nothing_flows_through_walls() {
    let mut chance = Chance(5);
    for potential in ALL {
        for solid in solids() {
            let wall = NoiseWall::new(solid.clone(), 0.5).unwrap();
            let beside = NoiseWall::new(Sphere::new(CENTER + Vec3::new(0.0, 2.1, 0.0), 0.6).unwrap(), 0.9).unwrap();
            for field in [noise(potential).with_wall(wall.clone()), noise(potential).with_wall(beside).with_wall(wall)]
            {
                let (mut most, mut along) = (0.0_f32, 0.0);
                for (place, normal) in on_it(&*solid, &mut chance, 300) {
                    let velocity = field.velocity(place, 10.0 * chance.unit());
                    most = most.max(velocity.dot(normal).abs());
                    along += velocity.length() / 300.0;
                }
                assert!(most < 1e-5 && along > 0.1, "{potential:?}, {solid:?}: {most}, along it {along}");
            }
        }
    }
}

/// In space and in the plane: rotation, translation, or both; beside a wall at rest, and a wall with another motion.
#[test]
fn moving_walls_take_along_what_is_before_them() -> Result<(), Error> {
    let mut chance = Chance(6);
    for potential in ALL {
        for (surface, in_plane) in [
            (Arc::new(Sphere::new(Vec3::ZERO, 1.0)?) as Arc<dyn Surface>, false),
            (Arc::new(Cuboid::new(Vec3::new(2.0, 1.0, 0.7))?), false),
            (Arc::new(Cylinder::new(-5.0 * Vec3::Z, 5.0 * Vec3::Z, 0.8)?), true),
            (Arc::new(Prism::ground(&[Vec2::new(-1.0, -1.0), Vec2::new(1.0, -0.5), Vec2::new(0.0, 1.0)])?), true),
        ] {
            if potential == Potential::Plane && !in_plane {
                continue;
            }
            let (velocity, spin) = (Vec3::new(0.4, -0.3, 0.0), Vec3::Z * 0.8);
            // the test evaluates single moments: every moment has the same pose
            let pose = Pose::on_ground(CENTER, 0.7)?;
            let moving = NoiseWall::moving(surface.clone(), 0.6, move |_: f64| Rigid { pose, velocity, spin })?;
            let rest = NoiseWall::new(Sphere::new(CENTER + Vec3::new(0.0, 2.3, 0.0), 0.6)?, 0.9)?;
            let other = |_: f64| Rigid {
                pose: Pose::at(CENTER - Vec3::X * 2.2).expect("it is finite"),
                velocity: Vec3::Y,
                spin: Vec3::ZERO,
            };
            let other = NoiseWall::moving(Sphere::new(Vec3::ZERO, 0.5)?, 0.8, other)?;
            let field = noise(potential).with_wall(rest).with_wall(moving).with_wall(other);
            let here = Moved::new(surface, pose);
            for (place, normal) in on_it(&here, &mut chance, 300) {
                let expected = (velocity + spin.cross(place - CENTER)).dot(normal);
                let found = field.velocity(place, 3.0).dot(normal);
                let off = (found - expected).abs();
                assert!(off < 2e-5 * (1.0 + expected.abs()), "{potential:?}, {here:?}: {found}, {expected}");
            }
        }
    }
    Ok(())
}

/// A surface, and its distance in `f64`.
type Solid = (Arc<dyn Surface>, fn(DVec3) -> f64);

fn distances() -> Vec<Solid> {
    fn beside(beyond: DVec2) -> f64 {
        beyond.max(DVec2::ZERO).length() + beyond.max_element().min(0.0)
    }
    vec![
        (Arc::new(Sphere::new(Vec3::ZERO, 1.0).unwrap()), |p| p.length() - 1.0),
        (Arc::new(Cuboid::new(Vec3::new(2.0, 1.0, 3.0)).unwrap()), |p| {
            let beyond = p.abs() - DVec3::new(1.0, 0.5, 1.5);
            beyond.max(DVec3::ZERO).length() + beyond.max_element().min(0.0)
        }),
        (Arc::new(Capsule::new(Vec3::ZERO, Vec3::X, 0.5).unwrap()), |p| {
            p.distance(DVec3::X * p.x.clamp(0.0, 1.0)) - 0.5
        }),
        (Arc::new(Cylinder::new(-Vec3::Z, Vec3::Z, 0.75).unwrap()), |p| {
            beside(DVec2::new(p.truncate().length() - 0.75, p.z.abs() - 1.0))
        }),
    ]
}

/// Near walls, at rest and moving, the velocity is the curl of the potential by definition, so it is free of divergence
/// there too.
#[test]
fn near_walls_velocities_are_curls_too() -> Result<(), Error> {
    let mut chance = Chance(8);
    let octaves = vec![UNIT, Octave { length: 0.5, period: 0.5, speed: 0.6 }];
    for potential in [Potential::Plane, Potential::Space] {
        for (solid, distance) in distances() {
            let (velocity, spin) = (Vec3::new(0.5, -0.4, 0.3), Vec3::new(0.2, 0.1, -0.6));
            for moves in [false, true] {
                let rigid = move |_: f64| Rigid { pose: Pose::at(Vec3::ZERO).expect("it is finite"), velocity, spin };
                let (width, beside) = (0.7, Vec3::new(0.3, 0.0, 2.5));
                let wall = if moves {
                    NoiseWall::moving(solid.clone(), width, rigid)?
                } else {
                    NoiseWall::new(solid.clone(), width)?
                };
                let second = NoiseWall::new(Sphere::new(beside, 1.2)?, 0.9)?;
                let field = CurlNoise::new(potential, &octaves, 4)?.with_wall(wall).with_wall(second);
                let reference = Reference { potential, octaves: octaves.clone(), seed: 4 };
                for _ in 0..40 {
                    let place = chance.place(2.0);
                    let off_crease = |p: Vec3| p.abs().min_element() > 0.02 && distance(p.as_dvec3()) > 0.0;
                    if !off_crease(place) {
                        continue;
                    }
                    let time = 5.0 * chance.unit();
                    let all = |p: DVec3| {
                        let p = if potential == Potential::Plane { p.with_z(place.z.into()) } else { p };
                        let first = ramp(distance(p) / f64::from(width));
                        let second = ramp((p.distance(beside.as_dvec3()) - f64::from(1.2_f32)) / f64::from(0.9_f32));
                        let of_noise = reference.potential(p, time, unit(potential)) * first * second;
                        if !moves || first == 1.0 {
                            return of_noise;
                        }
                        let (velocity, spin) = (velocity.as_dvec3(), spin.as_dvec3());
                        let rigid = if potential == Potential::Plane {
                            let stream = velocity.x * p.y - velocity.y * p.x;
                            DVec3::Z * (stream - 0.5 * spin.z * p.truncate().length_squared())
                        } else {
                            0.5 * velocity.cross(p) - 0.5 * p.length_squared() * spin
                        };
                        // by the shares of the two walls in the part that is not noise
                        let (one, two) = ((1.0 - first) * second * second, (1.0 - second.abs()) * first * first);
                        of_noise + (1.0 - (first * second).abs()) * one / (one + two) * rigid
                    };
                    let expected = curl(all, place.as_dvec3(), 1e-4);
                    let found = field.velocity(place, time).as_dvec3();
                    let off = found.distance(expected) / (1.0 + expected.length());
                    // distances are in single precision, and jump where the nearest point changes
                    assert!(off < 1e-4, "{potential:?}, {solid:?}, {place}: {found} is not {expected}");
                }
            }
        }
    }
    Ok(())
}

/// Ten minutes of points that the field alone moves, in steps of a 60th of a second: round a lamp, a box and a pillar,
/// and in a room. Rounding and finite steps carry them less than a millimetre into a wall.
#[test]
fn moved_points_stay_on_their_side() -> Result<(), Error> {
    let mut chance = Chance(9);
    let room = Cuboid::new(Vec3::new(8.0, 8.0, 5.0))?;
    let solids: Vec<Arc<dyn Surface>> = vec![
        Arc::new(Sphere::new(Vec3::new(1.0, 1.0, 0.0), 0.5)?),
        moved(Cuboid::new(Vec3::ONE)?),
        Arc::new(Cylinder::new(Vec3::new(-2.0, 1.0, -1.0), Vec3::new(-2.0, 1.5, 2.0), 0.6)?),
    ];
    let mut field = CurlNoise::new(Potential::Space, &Octave::turbulence(0.6, 0.8, 0.8, 2)?, 3)?;
    for solid in &solids {
        field = field.with_wall(NoiseWall::new(solid.clone(), 0.4)?);
    }
    field = field.with_wall(NoiseWall::new(room.clone(), 0.4)?);
    let depth = |p: Vec3| solids.iter().map(|solid| -solid.query(p).distance).fold(room.query(p).distance, f32::max);
    let mut places: Vec<Vec3> = Vec::new();
    while places.len() < 64 {
        let place = chance.place(3.9) * Vec3::new(1.0, 1.0, 0.6);
        if depth(place) < -0.01 {
            places.push(place);
        }
    }
    let (seconds, mut deepest) = (1.0 / 60.0, f32::NEG_INFINITY);
    let [mut first, mut second] = [(); 2].map(|()| vec![Vec3::ZERO; places.len()]);
    for step in 0..36_000 {
        let time = f64::from(step) * f64::from(seconds);
        field.velocities(&places, time, &mut first);
        let half: Vec<Vec3> = places.iter().zip(&first).map(|(place, v)| place + v * (0.5 * seconds)).collect();
        field.velocities(&half, time + f64::from(0.5 * seconds), &mut second);
        places.iter_mut().zip(&second).for_each(|(place, v)| *place += v * seconds);
        deepest = places.iter().map(|&place| depth(place)).fold(deepest, f32::max);
    }
    assert!(deepest < 1e-3, "{deepest}");
    let moved = places.iter().filter(|place| place.length() > 1.0).count();
    assert!(moved > 32, "they are everywhere");
    Ok(())
}

#[test]
fn widths_out_of_their_limits_are_said() {
    for width in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let ball = Sphere::new(Vec3::ZERO, 1.0).unwrap();
        let error = NoiseWall::new(ball, width).unwrap_err().to_string();
        assert!(error.starts_with("the width of a wall's influence is"), "{error}");
    }
}
