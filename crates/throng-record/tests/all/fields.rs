//! The fields of scenes, for pictures.

use glam::Vec3;
use throng_record::{Frame, moment};
use throng_scene::gallery;

#[test]
fn the_field_that_a_behaviour_follows_is_part_of_the_setting() {
    let (world, built) = gallery::scene("formation").unwrap().build().unwrap();
    let setting = moment::setting(&world, &built, "");
    assert_eq!(setting.flows.len(), 1);
    let flow = &setting.flows[0];
    assert!(flow.groups == [2] && !flow.governs);
    // fields of a setting take places relative to its origin
    let velocity = flow.field.velocity(Vec3::new(5.0, 0.0, 20.0) - setting.origin.as_vec2().extend(0.0), 0.0);
    assert!(velocity.distance(Vec3::new(0.0, 4.0, 0.0)) < 1e-5, "a whirl: {velocity}");
}

#[test]
fn frames_have_the_present_state_of_fields_that_adapt_to_the_crowd() {
    let (mut world, built) = gallery::scene("field-jam").unwrap().build().unwrap();
    let flow = moment::setting(&world, &built, "").flows.remove(0);
    let mut frame = Frame::default();
    moment::capture(&world, &mut frame);
    assert!(frame.fields.is_empty(), "before the first step there is none");
    world.step();
    moment::capture(&world, &mut frame);
    assert_eq!((frame.fields.len(), frame.fields[0].group), (1, 0));
    // among the crowd the way around it is the shorter one
    let places = (0..20).flat_map(|x| (0..20).map(move |y| Vec3::new(-18.0 + x as f32, -10.0 + y as f32, 0.0)));
    let turned = places.filter(|&place| {
        let [before, now] = [&flow.field, &frame.fields[0].field].map(|field| field.velocity(place, 0.0));
        before.normalize_or_zero().dot(now.normalize_or_zero()) < 0.9
    });
    assert!(turned.count() > 20);
    let (first, step) = (frame.fields.clone(), world.settings().step);
    (0..(0.6 / step) as usize).for_each(|_| world.step());
    moment::capture(&world, &mut frame);
    assert_ne!(frame.fields, first, "it changes with the crowd");
}
