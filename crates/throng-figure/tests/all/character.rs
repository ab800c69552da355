//! Characters: throng's own man, modelled in other poses and other places, walks like the man that he is.

use crate::paths::driven;
use glam::{DQuat, DVec3, Vec3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use throng_figure::measure::FeetMeasure;
use throng_figure::{Build, Character, CharacterError, Joint, Level, Look, Mesh, Person, RestBody, Skeleton, Walk};

const HEIGHT: f64 = 1.8;

/// Returns throng's man in a pose: arms turned by an angle (rad) from 45°, up if it is greater than 0; the whole body turned
/// about z, and elsewhere.
fn modelled(arms: f64, yaw: f64, at: DVec3) -> RestBody {
    let (mesh, skeleton) = (Mesh::new(Build::Man, Level::Fine), Skeleton::scaled(Build::Man, HEIGHT));
    let mut pose = skeleton.rest();
    for (joint, sign) in [(Joint::LeftArm, 1.0), (Joint::RightArm, -1.0)] {
        pose.rotations[joint.index()] = DQuat::from_rotation_x(sign * arms);
    }
    let joints = skeleton.world(&pose);
    let turn = DQuat::from_rotation_z(yaw);
    RestBody {
        joints: joints.map(|joint| Some(turn * joint.position + at)),
        positions: mesh.posed(&skeleton, HEIGHT, &joints).into_iter().map(|p| turn * p + at).collect(),
        normals: Vec::new(),
        numbers: mesh.joints.clone(),
        weights: mesh.weights.clone(),
        colours: mesh.colours(&Look::new(0)),
        triangles: mesh.triangles_of(&Look::new(0)),
    }
}

#[test]
fn a_body_walks_alike_in_whichever_pose_it_was_modelled() {
    let (mesh, own) = (Mesh::new(Build::Man, Level::Fine), Skeleton::scaled(Build::Man, HEIGHT));
    let man = Person::new(3, 1).with_build(Build::Man).with_height(HEIGHT);
    let samples = driven(25.0, 6.0, |_| (1.3, 0.0, 0.3));
    let walk = Walk::recorded(&man, &samples).unwrap();
    let at = DVec3::new(30.0, -12.0, 0.7);
    for (arms, yaw, at) in
        [(0.0, 0.0, DVec3::ZERO), (FRAC_PI_4, 0.4, at), (-0.6, FRAC_PI_2, at), (FRAC_PI_4, -2.5, DVec3::ZERO)]
    {
        let character = Character::new(&modelled(arms, yaw, at)).unwrap();
        let lowest = mesh.positions.iter().fold(f32::MAX, |low, position| low.min(position.z));
        let skeleton = character.skeleton(character.height());
        for moment in 0..60 {
            let pose = walk.pose(f64::from(moment) / 10.0);
            let (want, got) = (own.world(&pose), skeleton.world(&pose));
            for joint in Joint::ALL {
                let off = got[joint.index()].position.distance(want[joint.index()].position);
                assert!(off < 1e-6, "{joint:?} is off by {off} m");
            }
            let wanted = mesh.posed(&own, HEIGHT, &want);
            let moved = character.mesh().posed(&skeleton, character.height(), &got);
            for (k, (want, got)) in wanted.iter().zip(&moved).enumerate() {
                // vertices of one joint; where joints share a vertex, the pose of the model counts
                let whole = mesh.weights[k].contains(&1.0);
                let off = if whole { 2e-4 } else { 0.06 };
                assert!(got.distance(*want) < off, "vertex {k}: {got} is not {want}, lowest {lowest}");
            }
            let (shown, normals) = character.mesh().skinned(&skeleton, character.height(), &got, DVec3::ZERO);
            assert!(shown.iter().zip(&moved).all(|(a, b)| a.as_dvec3().distance(*b) < 1e-4));
            assert!(normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-4));
        }
    }
}

#[test]
fn the_legs_are_those_of_the_body() {
    let legs = Character::new(&modelled(0.3, 1.0, DVec3::X)).unwrap().person(Person::new(1, 1)).legs;
    let want = throng_figure::Legs::of(Build::Man);
    let pairs = [
        (legs.thigh, want.thigh),
        (legs.shank, want.shank),
        (legs.ankle, want.ankle),
        (legs.ball, want.ball),
        (legs.toe_height, want.toe_height),
        (legs.hip, want.hip),
    ];
    // the mesh of a man of 1 m is not to the millimetre 1 m tall, and its feet are rounded
    assert!(pairs.iter().all(|(got, want)| (got - want).abs() < 0.002), "{legs:?}");
    assert!((legs.heel - want.heel).abs() < 0.006 && (legs.foot - want.foot).abs() < 0.01, "{legs:?}");
}

#[test]
fn without_joints_that_may_lack_feet_stand_as_well() {
    let mut body = modelled(FRAC_PI_4, 0.0, DVec3::ZERO);
    use Joint::{Head, LeftFoot, LeftHand, LeftToeBase, Neck, RightFoot, RightHand, RightToeBase, Spine, Spine1};
    let lacks = [(Spine, Spine1), (Neck, Head), (LeftToeBase, LeftFoot), (RightToeBase, RightFoot)];
    let lacks = lacks.into_iter().chain([(LeftHand, Joint::LeftForeArm), (RightHand, Joint::RightForeArm)]);
    for (joint, other) in lacks {
        body.joints[joint.index()] = None;
        for number in body.numbers.as_flattened_mut() {
            if usize::from(*number) == joint.index() {
                *number = other.index() as u8;
            }
        }
    }
    let character = Character::new(&body).unwrap();
    let person = character.person(Person::new(2, 2));
    let walk = Walk::recorded(&person, &driven(25.0, 10.0, |_| (1.3, 0.0, 0.0))).unwrap();
    let (skeleton, mut feet) = (character.skeleton(person.height), FeetMeasure::new(&person));
    for moment in 0..1000 {
        let time = f64::from(moment) / 100.0;
        let joints = skeleton.world(&walk.pose(time));
        feet.push(time, &joints);
        let lowest = character.mesh().posed(&skeleton, person.height, &joints);
        assert!(lowest.iter().all(|point| point.z > -0.012), "a vertex is below the ground at {time} s");
    }
    let report = feet.report();
    assert!(report.steps > 15 && report.mean_slide < 0.001 && report.largest_slide < 0.003, "{report:?}");
}

#[test]
fn wrong_bodies_are_errors() {
    let good = modelled(0.0, 0.0, DVec3::ZERO);
    let wrong = |change: &dyn Fn(&mut RestBody)| {
        let mut body = good.clone();
        change(&mut body);
        Character::new(&body).unwrap_err()
    };
    assert_eq!(Character::new(&RestBody::default()), Err(CharacterError::Empty { vertices: 0, triangles: 0 }));
    let lost = wrong(&|body| {
        body.joints[Joint::Head.index()] = None;
        body.joints[Joint::LeftLeg.index()] = None;
        body.joints[Joint::LeftHand.index()] = None;
    });
    assert_eq!(lost.to_string(), "missing joints: Head, LeftLeg");
    let nan = wrong(&|body| body.positions[7].y = f64::NAN).to_string();
    assert_eq!(nan, "the position of vertex 7 is not finite; export the body again");
    let nan = wrong(&|body| body.joints[3] = Some(DVec3::INFINITY)).to_string();
    assert!(nan.starts_with("the position of joint Neck"), "{nan}");
    let nan = wrong(&|body| body.normals = vec![Vec3::NAN; body.positions.len()]).to_string();
    assert!(nan.starts_with("the normal of vertex 0"), "{nan}");
    assert_eq!(wrong(&|body| body.weights[5] = [0.0; 4]), CharacterError::NoWeight { vertex: 5 });
    assert_eq!(wrong(&|body| body.weights[5][1] = -0.5), CharacterError::NoWeight { vertex: 5 });
    assert!(wrong(&|body| body.numbers[5][1] = 19).to_string().contains("vertex 5 names a joint"));
    assert!(wrong(&|body| body.triangles[2][1] = 9999).to_string().contains("triangle 2 names a vertex"));
    let count = Mesh::new(Build::Man, Level::Fine).positions.len();
    let said = format!("{count} vertices, but {} colours", count - 1);
    assert!(wrong(&|body| _ = body.colours.pop()).to_string().contains(&said));
    let tall = wrong(&|body| {
        body.positions.iter_mut().for_each(|position| *position *= 100.0);
    });
    assert!(matches!(tall, CharacterError::Height { height } if height > 170.0));
    let same = wrong(&|body| body.joints[Joint::LeftLeg.index()] = body.joints[Joint::LeftUpLeg.index()]);
    assert_eq!(same, CharacterError::NoLength { from: Joint::LeftUpLeg, to: Joint::LeftLeg });
    let sits = wrong(&|body| {
        let hip = body.joints[Joint::RightUpLeg.index()].unwrap();
        body.joints[Joint::RightLeg.index()] = Some(hip + DVec3::X * 0.4);
    });
    assert_eq!(sits, CharacterError::NotStanding { joint: Joint::RightUpLeg });
    let short = wrong(&|body| {
        for joint in [Joint::RightFoot, Joint::RightToeBase] {
            body.joints[joint.index()].as_mut().unwrap().z += 0.1;
        }
    });
    assert!(matches!(short, CharacterError::Unequal { .. }), "{short}");
    let swapped = wrong(&|body| {
        for (left, right) in [(11, 15), (12, 16), (13, 17), (14, 18)] {
            body.joints.swap(left, right);
        }
    });
    assert_eq!(swapped, CharacterError::Backwards);
}

/// Weights are shares, whatever their sum.
#[test]
fn weights_are_normalised() {
    let mut body = modelled(0.0, 0.0, DVec3::ZERO);
    let want = Character::new(&body).unwrap();
    body.weights.iter_mut().for_each(|weights| *weights = weights.map(|weight| weight * 4.0));
    assert_eq!(Character::new(&body).unwrap(), want);
}
